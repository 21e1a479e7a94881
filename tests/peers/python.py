"""Compares the Python package with trimesh. See README.md."""

import tempfile
import time
from pathlib import Path

import numpy
import trimesh

import meshwright as mw

RUNS = 3
FACES = 62_500


class Clock:
    """Keeps the lowest time of each step in several runs."""

    def __init__(self):
        self.best = {}

    def step(self, name, work):
        begin = time.perf_counter()
        result = work()
        seconds = time.perf_counter() - begin
        self.best[name] = min(seconds, self.best.get(name, seconds))
        return result


def by_meshwright(source, target, clock):
    m = clock.step("load", lambda: mw.read(source).mesh())
    m = clock.step("weld", lambda: m.weld(distance=0))
    m = clock.step("normals", lambda: m.vertex_normals())
    m = clock.step("simplify", lambda: m.simplify(faces=FACES))
    m = clock.step("subdivide twice", lambda: m.midpoint(levels=2))
    clock.step("save", lambda: m.save(target))
    return m.n_faces


def by_trimesh(source, target, clock):
    m = clock.step("load", lambda: trimesh.load_mesh(source, process=False))
    clock.step("weld", lambda: m.merge_vertices())
    clock.step("normals", lambda: numpy.asarray(m.vertex_normals))
    m = clock.step("simplify", lambda: m.simplify_quadric_decimation(face_count=FACES))
    m = clock.step("subdivide twice", lambda: m.subdivide().subdivide())
    clock.step("save", lambda: m.export(target))
    return len(m.faces)


def main():
    with tempfile.TemporaryDirectory() as folder:
        source = str(Path(folder) / "torus.stl")
        mw.Scene().torus(name="torus", around=1000, across=500).mesh().triangulate().save(source)
        times = {}
        for name, run in (("meshwright", by_meshwright), ("trimesh", by_trimesh)):
            clock = Clock()
            for _ in range(RUNS):
                faces = run(source, str(Path(folder) / f"{name}.ply"), clock)
            times[name] = clock.best
            print(f"{name}: {faces} triangles at the end")
    print(f"{'':16} {'meshwright':>12} {'trimesh':>12}")
    for step in times["meshwright"]:
        ours, theirs = times["meshwright"][step], times["trimesh"][step]
        print(f"{step:16} {ours:10.3f} s {theirs:10.3f} s {theirs / ours:8.1f} times")
    ours, theirs = (sum(times[name].values()) for name in ("meshwright", "trimesh"))
    print(f"{'total':16} {ours:10.3f} s {theirs:10.3f} s {theirs / ours:8.1f} times")


main()
