"""Compares the Python package with trimesh. See README.md."""

import tempfile
import time
from pathlib import Path

import numpy
import trimesh

import meshwright as mw
from meshwright import choice

RUNS = 3
FACES = 62_500


class Clock:
    """Measures steps of several runs. For each step, keeps the lowest elapsed time and the lowest processor time."""

    def __init__(self):
        self.best = {}

    def step(self, name, work):
        begin = numpy.array([time.perf_counter(), time.process_time()])
        result = work()
        seconds = numpy.array([time.perf_counter(), time.process_time()]) - begin
        self.best[name] = numpy.minimum(seconds, self.best.get(name, seconds))
        return result


def by_meshwright(source, target, clock):
    m = clock.step("load", lambda: mw.read(source).mesh())
    m = clock.step("weld", lambda: m.weld(distance=0))
    # trimesh does not keep the normals, so the following steps here also use the mesh without them.
    clock.step("normals", lambda: m.vertex_normals())
    small = clock.step("simplify", lambda: m.simplify(faces=FACES))
    m = clock.step("subdivide twice", lambda: small.midpoint(levels=2))
    clock.step("save PLY", lambda: m.save(f"{target}.ply"))
    clock.step("save GLB", lambda: m.save(f"{target}.glb"))
    return small


def by_trimesh(source, target, clock):
    m = clock.step("load", lambda: trimesh.load_mesh(source, process=False))
    clock.step("weld", lambda: m.merge_vertices())
    clock.step("normals", lambda: numpy.asarray(m.vertex_normals))
    # With the default aggression, 7, the largest distance is 14 times as large.
    simplify = m.simplify_quadric_decimation
    small = clock.step("simplify", lambda: simplify(face_count=FACES, aggression=2))
    m = clock.step("subdivide twice", lambda: small.subdivide().subdivide())
    clock.step("save PLY", lambda: m.export(f"{target}.ply"))
    clock.step("save GLB", lambda: m.export(f"{target}.glb"))
    return mw.Mesh.from_trimesh(small)


def quality(small, original):
    """Describes the distances from the simplified mesh to the original, and the mean of the smallest angles of the
    simplified faces."""
    scene = mw.Scene().with_object(small, name="small").with_object(original, name="original")
    far = scene.measure(of=choice.Distance(to="original"), name="far", on="small")["small"].attributes["far"]
    angles = small.measure(of="MinAngle", name="angle").attributes["angle"]
    return f"mean distance {far.mean():.2e}, largest {far.max():.2e}, mean smallest angle {angles.mean():.1f}"


def main():
    with tempfile.TemporaryDirectory() as folder:
        source = str(Path(folder) / "torus.stl")
        mw.Scene().torus(name="torus", around=1000, across=500).mesh().triangulate().save(source)
        original = mw.read(source).mesh().weld(distance=0)
        times = {}
        for name, run in (("meshwright", by_meshwright), ("trimesh", by_trimesh)):
            clock = Clock()
            target = Path(folder) / name
            for _ in range(RUNS):
                small = run(source, target, clock)
            times[name] = clock.best
            sizes = ", ".join(f"{ending} {(Path(f'{target}.{ending}').stat().st_size) / 1e6:.1f} MB" for ending in ("ply", "glb"))
            print(f"{name}: simplified to {small.n_faces} triangles, {quality(small, original)}; {sizes}")
    for row in times.values():
        row["total"] = sum(row.values())
        row["without simplify"] = row["total"] - row["simplify"]
    for i, title in enumerate(("elapsed time", "time of all processors")):
        print(f"\n{title:24} {'meshwright':>12} {'trimesh':>12}")
        for step in times["meshwright"]:
            ours, theirs = times["meshwright"][step][i], times["trimesh"][step][i]
            print(f"{step:24} {ours:10.3f} s {theirs:10.3f} s {theirs / ours:8.1f} times")


main()
