"""Compares the texture coordinates of two programs. See README.md."""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
import xatlas

PAGE, PADDING, RUNS = 1024, 2, 3


def read(path):
    """Reads positions, texture coordinates and the corners of triangles of an OBJ file; cuts polygons into fans."""
    positions, uvs, corners = [], [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            positions.append([float(word) for word in words[1:4]])
        elif words[:1] == ["vt"]:
            uvs.append([float(word) for word in words[1:3]])
        elif words[:1] == ["f"]:
            face = [[int(number or 0) - 1 for number in (word.split("/") + ["0"])[:2]] for word in words[1:]]
            corners += [[face[0], b, c] for b, c in zip(face[1:], face[2:])]
    return numpy.array(positions), numpy.array(uvs), numpy.array(corners)


def by_meshwright(program, folder, source):
    recipe = folder / "recipe.ron"
    steps = f'Load(path: "{source}"), Unwrap(page: {PAGE}, padding: {PADDING}), Save(path: "out.obj")'
    recipe.write_text(f"(recipe: 1, steps: [{steps}])")
    command = [program, "run", recipe, "--out", folder, "--no-cache", "--format", "json"]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    events = [json.loads(line) for line in lines]
    number = next(e["number"] for e in events if e["event"] == "step" and e["operation"] == "Unwrap")
    done = next(e for e in events if e["event"] == "done" and e["number"] == number)
    positions, uvs, corners = read(folder / "out.obj")
    return done["milliseconds"] / 1000, positions[corners[:, :, 0]], uvs[corners[:, :, 1]]


def by_xatlas(source):
    positions, _, corners = read(source)
    atlas = xatlas.Atlas()
    atlas.add_mesh(positions.astype(numpy.float32), corners[:, :, 0].astype(numpy.uint32))
    options = xatlas.PackOptions()
    # In Meshwright, the distance between two charts is twice the value of `padding`.
    options.resolution, options.padding = PAGE, 2 * PADDING
    start = time.perf_counter()
    atlas.generate(xatlas.ChartOptions(), options)
    seconds = time.perf_counter() - start
    origins, triangles, uvs = atlas[0]
    # If the charts do not fit, xatlas makes the page larger than the requested size.
    uvs = uvs * [atlas.width, atlas.height] / max(atlas.width, atlas.height)
    return seconds, positions[origins][triangles], uvs[triangles]


def n_charts(uvs):
    """Returns the number of charts, which are sets of triangles that are connected in the texture."""
    _, points = numpy.unique(uvs.reshape(-1, 2), axis=0, return_inverse=True)
    points = points.reshape(-1, 3)
    parent = list(range(points.max() + 1))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for a, b, c in points:
        parent[root(a)] = parent[root(b)] = root(c)
    return len({root(i) for i in points[:, 0]})


def measure(positions, uvs):
    """Returns five numbers: the number of charts, the covered part of the page, the aspect, the ratio of the area
    scales, and the fraction of mirrored triangles. The aspect is an upper limit that holds for 95 % of the area. The
    ratio is the largest divided by the smallest area scale; it leaves out the 2.5 % of the area with the largest scales
    and the 2.5 % with the smallest scales."""
    a, b = positions[:, 1] - positions[:, 0], positions[:, 2] - positions[:, 0]
    length = numpy.linalg.norm(a, axis=1)
    area = numpy.linalg.norm(numpy.cross(a, b), axis=1) / 2
    keep = area > 1e-12 * area.max()
    x = (a * b).sum(1)[keep] / length[keep]
    y = 2 * area[keep] / length[keep]
    u, v = (uvs[:, 1] - uvs[:, 0])[keep], (uvs[:, 2] - uvs[:, 0])[keep]
    p = u / length[keep, None]
    q = (v - p * x[:, None]) / y[:, None]
    determinant = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    e, f, g = (p * p).sum(1), (p * q).sum(1), (q * q).sum(1)
    long = numpy.sqrt((e + g) / 2 + numpy.sqrt(((e - g) / 2) ** 2 + f * f))
    aspect = long * long / numpy.maximum(abs(determinant), 1e-300)
    covered = abs(determinant * area[keep]).sum()
    scales = quantile(abs(determinant), area[keep], 0.975) / quantile(abs(determinant), area[keep], 0.025)
    return n_charts(uvs), covered, quantile(aspect, area[keep], 0.95), scales, (determinant < 0).mean()


def quantile(values, areas, share):
    """Returns a limit for the values: the triangles whose values do not exceed this limit cover the given share of the
    area."""
    order = numpy.argsort(values)
    sums = numpy.cumsum(areas[order])
    return values[order][numpy.searchsorted(sums, share * sums[-1])]


def main():
    root, program = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    models = [Path(model).resolve() for model in sys.argv[3:]] or [root / "scenes/assets/bunny.obj"]
    print("| model | program | seconds | charts | covered | aspect of 95 % | scales | mirrored triangles |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for model in models:
            for name, unwrap in [
                ("Meshwright", lambda: by_meshwright(program, folder, model)),
                ("xatlas 0.0.11", lambda: by_xatlas(model)),
            ]:
                seconds, positions, uvs = min((unwrap() for _ in range(RUNS)), key=lambda run: run[0])
                charts, covered, aspect, scales, mirrored = measure(positions, uvs)
                print(
                    f"| {model.stem} | {name} | {seconds:.2f} | {charts} | {covered:.2f} | {aspect:.2f} | {scales:.2f} | {mirrored:.0%} |",
                    flush=True,
                )


main()
