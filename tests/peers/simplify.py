"""Compares the simplification of several programs. See README.md."""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import igl
import meshlib.mrmeshpy as meshlib
import meshoptimizer
import numpy

RATIO = 0.1
RUNS = 3


def read(path):
    """Reads the positions and triangles of an OBJ file; cuts polygons into fans."""
    positions, triangles = [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            positions.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            triangles += [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
    return numpy.array(positions), numpy.array(triangles)


def write(path, positions, triangles):
    lines = ["v %r %r %r" % tuple(map(float, p)) for p in positions]
    lines += ["f %d %d %d" % tuple(t + 1) for t in triangles]
    Path(path).write_text("\n".join(lines) + "\n")


def run(program, folder, steps):
    """Runs a recipe. Returns a dictionary with the times of the steps in milliseconds. The keys are the names of the
    operations."""
    recipe = folder / "recipe.ron"
    recipe.write_text(f"(recipe: 1, steps: [{steps}])")
    command = [program, "run", recipe, "--out", folder, "--no-cache", "--format", "json"]
    events = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    events = [json.loads(line) for line in events.splitlines()]
    return {event["operation"]: event["milliseconds"] for event in done(events)}


def done(events):
    names = {event["number"]: event["operation"] for event in events if event["event"] == "step"}
    return [dict(event, operation=names[event["number"]]) for event in events if event["event"] == "done"]


def by_meshwright(program, folder, source, target):
    steps = f'Load(path: "{source}"), Simplify(ratio: {RATIO}), Save(path: "{target.name}")'
    return run(program, folder, steps)["Simplify"] / 1000


def by_meshlib(source, target):
    mesh = meshlib.loadMesh(str(source))
    settings = meshlib.DecimateSettings()
    settings.maxDeletedFaces = int(mesh.topology.numValidFaces() * (1 - RATIO))
    settings.maxError = 1e30
    settings.packMesh = True
    start = time.perf_counter()
    meshlib.decimateMesh(mesh, settings)
    seconds = time.perf_counter() - start
    meshlib.saveMesh(mesh, str(target))
    return seconds


def by_meshoptimizer(source, target):
    positions, triangles = read(source)
    positions = positions.astype(numpy.float32)
    indices = triangles.astype(numpy.uint32).ravel()
    result = numpy.zeros_like(indices)
    goal = int(len(triangles) * RATIO) * 3
    start = time.perf_counter()
    n = meshoptimizer.simplify(
        result, indices, positions, len(indices), len(positions), positions.strides[0], goal, 1e30
    )
    seconds = time.perf_counter() - start
    kept = result[:n].reshape(-1, 3)
    used, numbers = numpy.unique(kept, return_inverse=True)
    write(target, positions[used], numbers.reshape(-1, 3))
    return seconds


def smallest_angles(positions, triangles):
    corners = positions[triangles]
    angles = []
    for i in range(3):
        a, b = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        cosine = (a * b).sum(1) / (numpy.linalg.norm(a, axis=1) * numpy.linalg.norm(b, axis=1) + 1e-300)
        angles.append(numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1))))
    return numpy.min(angles, axis=0)


def measure(program, source, target):
    """Returns the number of triangles, three distances relative to the diagonal (the largest, the mean and the RMS),
    and the first percentile of the smallest angles of the triangles."""
    difference = subprocess.run([program, "diff", source, target, "--format", "json"], capture_output=True, text=True)
    distance = json.loads(difference.stdout)["objects"][0]["mesh"]["distance"]
    before, after = read(source), read(target)
    diagonal = numpy.linalg.norm(before[0].max(0) - before[0].min(0))
    squared = igl.point_mesh_squared_distance(before[0], *after)[0]
    return [
        len(after[1]),
        distance["largest"] / diagonal,
        distance["mean"] / diagonal,
        numpy.sqrt(squared.mean()) / diagonal,
        numpy.percentile(smallest_angles(*after), 1),
    ]


def main():
    root, program = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        models = [Path(model).resolve() for model in sys.argv[3:]]
        if not models:
            torus = 'Torus(around: 1000, across: 500, major: 1, minor: 0.4), Triangulate, Save(path: "torus.obj")'
            run(program, folder, torus)
            models = [folder / "torus.obj", root / "scenes/assets/bunny.obj"]
        print("| model | program | seconds | faces | largest | mean | RMS | 1 % of angles below |")
        print("| --- | --- | --- | --- | --- | --- | --- | --- |")
        for model in models:
            for name, simplify in [
                ("Meshwright", lambda target: by_meshwright(program, folder, model, target)),
                ("MeshLib", lambda target: by_meshlib(model, target)),
                ("meshoptimizer", lambda target: by_meshoptimizer(model, target)),
            ]:
                target = folder / f"{name}.obj"
                seconds = min(simplify(target) for _ in range(RUNS))
                faces, largest, mean, rms, angle = measure(program, model, target)
                print(
                    f"| {model.stem} | {name} | {seconds:.2f} | {faces} | {largest:.2e} | {mean:.2e} | {rms:.2e} | {angle:.1f}° |",
                    flush=True,
                )


main()
