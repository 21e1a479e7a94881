"""Compares the remeshing of several programs. See README.md."""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
import pymeshlab

RUNS = 5
# The target lengths, relative to the mean edge length of the model.
LENGTHS = [1, 0.45]


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


def edges(triangles):
    sides = numpy.sort(numpy.vstack([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), 1)
    return numpy.unique(sides, axis=0)


def lengths(positions, triangles):
    ends = positions[edges(triangles)]
    return numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)


def by_meshwright(program, folder, source, target, length):
    recipe = folder / "recipe.ron"
    steps = f'Load(path: "{source}"), Remesh(length: {length!r}), Save(path: "{target.name}")'
    recipe.write_text(f"(recipe: 1, steps: [{steps}])")
    command = [program, "run", recipe, "--out", folder, "--no-cache", "--format", "json"]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    events = [json.loads(line) for line in lines]
    return [event["milliseconds"] for event in events if event["event"] == "done"][1] / 1000


def by_pymeshlab(source, target, length):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(source))
    start = time.perf_counter()
    # An angle of 180 degrees means that no edge is kept as a sharp feature, as in the runs of the other programs.
    meshes.meshing_isotropic_explicit_remeshing(
        iterations=10, targetlen=pymeshlab.PureValue(length), featuredeg=180
    )
    seconds = time.perf_counter() - start
    meshes.save_current_mesh(str(target))
    return seconds


def by_cgal(program, source, target, length):
    command = [program, source, target, repr(length)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measure(program, source, target, length):
    difference = subprocess.run([program, "diff", source, target, "--format", "json"], capture_output=True, text=True)
    distance = json.loads(difference.stdout)["objects"][0]["mesh"]["distance"]
    before = read(source)[0]
    diagonal = numpy.linalg.norm(before.max(0) - before.min(0))
    positions, triangles = read(target)
    corners = positions[triangles]
    angles = []
    for i in range(3):
        a, b = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        cosine = (a * b).sum(1) / (numpy.linalg.norm(a, axis=1) * numpy.linalg.norm(b, axis=1))
        angles.append(numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1))))
    smallest = numpy.min(angles, axis=0)
    valences = numpy.bincount(edges(triangles).ravel())
    relative = lengths(positions, triangles) / length
    in_range = ((relative >= 0.8) & (relative <= 4 / 3)).mean()
    return (
        f"{len(triangles)} | {smallest.mean():.1f}° | {smallest.min():.1f}° | {(valences == 6).mean():.0%} | "
        f"{in_range:.1%} | {relative.max():.2f} | "
        f"{distance['largest'] / diagonal:.1e} | {distance['mean'] / diagonal:.1e}"
    )


def main():
    root, program = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    models = [Path(model).resolve() for model in sys.argv[3:]] or [root / "scenes/assets/bunny.obj"]
    cgal = root / "target/peers/remesh_cgal"
    columns = ["model", "program", "seconds", "faces", "mean angle", "smallest", "valence 6", "edges in range"]
    columns += ["longest edge", "largest distance", "mean"]
    print(f"| {' | '.join(columns)} |")
    print("| --- " * len(columns) + "|")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for model in models:
            for share in LENGTHS:
                length = float(lengths(*read(model)).mean()) * share
                programs = [
                    ("Meshwright", lambda target: by_meshwright(program, folder, model, target, length)),
                    ("pymeshlab", lambda target: by_pymeshlab(model, target, length)),
                ]
                if cgal.exists():
                    programs.append(("CGAL", lambda target: by_cgal(cgal, model, target, length)))
                for name, remesh in programs:
                    target = folder / f"{name}.obj"
                    seconds = statistics.median(remesh(target) for _ in range(RUNS))
                    measured = measure(program, model, target, length)
                    print(f"| {model.stem} | {name} | {seconds:.2f} | {measured} |", flush=True)


main()
