"""Compares nearest points on a surface. See README.md."""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
import open3d

RUNS = 3



def by_meshwright(program, folder, count):
    """Returns the seconds of the step that measures distances, and the arrays of the surface and the points."""
    steps = (
        f'Torus(name: "surface", around: {count}, across: {count // 2}, minor: 0.4), Triangulate(), '
        f'Torus(name: "points", around: {count}, across: {count}, minor: 0.42), '
        '(on: ["points"], run: Transform(rotate: [(axis: Z, angle: 0.1), (axis: X, angle: 0.2)])), '
        '(on: ["points"], run: Measure(of: Distance(to: "surface"), name: "distance")), '
        '(on: ["surface"], run: Save(path: "surface.npz")), (on: ["points"], run: Save(path: "points.npz"))'
    )
    recipe = folder / "recipe.ron"
    recipe.write_text(f"(recipe: 1, steps: [{steps}])")
    command = [program, "run", recipe, "--out", folder, "--no-cache", "--format", "json"]
    milliseconds = []
    for _ in range(RUNS):
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        done = [event for event in map(json.loads, lines) if event["event"] == "done"]
        milliseconds.append(done[4]["milliseconds"])
    return min(milliseconds) / 1000, numpy.load(folder / "surface.npz"), numpy.load(folder / "points.npz")


def by_open3d(surface, triangles, points):
    seconds = []
    for _ in range(RUNS):
        start = time.perf_counter()
        scene = open3d.t.geometry.RaycastingScene()
        scene.add_triangles(open3d.core.Tensor(surface), open3d.core.Tensor(triangles))
        distances = scene.compute_distance(open3d.core.Tensor(points)).numpy()
        seconds.append(time.perf_counter() - start)
    return min(seconds), distances


def main():
    program = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        ours, surface, points = by_meshwright(program, Path(folder), 1000)
    triangles = surface["faces"].astype(numpy.uint32)
    positions = [mesh["vertices"].astype(numpy.float32) for mesh in (surface, points)]
    other, distances = by_open3d(positions[0], triangles, positions[1])
    print(f"{len(triangles)} triangles, {len(positions[1])} points")
    print(f"meshwright {ours:.2f} s, Open3D {other:.2f} s, ratio {ours / other:.2f}")
    print(f"largest difference {numpy.abs(distances - points['vertex/distance']).max():.1e}")


if __name__ == "__main__":
    main()
