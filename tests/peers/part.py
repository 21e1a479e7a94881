"""Compares the simplification of a machine part with sharp edges. See README.md."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import meshlib.mrmeshpy as meshlib
import numpy

# The part, in millimetres, has a bore, a flange with eight bolt holes, a fillet to a hub, a thin wall of 1 mm on the
# hub, and a groove in the rim. A profile is turned around the axis. Each point of the profile has two numbers: the
# distance from the axis, and the height.
HOLES, HOLE_RADIUS, HOLE_CENTER = 8, 5.0, 45.0
INNER, OUTER = 36.0, 54.0  # The ring of the flange with the holes.
LOW, HIGH = 0.0, 10.0
FINE = int(sys.argv[2]) if len(sys.argv) > 2 else 2
AROUND, RINGS, LAYERS = 288 * FINE, 18 * FINE, 8 * FINE  # Around the axis, around a hole, and along its wall.
CELL = AROUND // HOLES


def line(a, b):
    n = max(1, round(float(numpy.hypot(b[0] - a[0], b[1] - a[1])) * FINE))
    return [(a[0] + (b[0] - a[0]) * i / n, a[1] + (b[1] - a[1]) * i / n) for i in range(n)]


def fillet(center, radius, start, end):
    angles = numpy.radians(numpy.linspace(start, end, 8 * FINE + 1)[:-1])
    return [(center[0] + radius * numpy.cos(a), center[1] + radius * numpy.sin(a)) for a in angles]


def profile():
    """Returns the two parts of the profile beside the ring with the holes: the rim, and the hub with the bore."""
    rim = [(OUTER, LOW), (60, LOW), (60, 4), (58, 4), (58, 6), (60, 6), (60, HIGH), (OUTER, HIGH)]
    rim = [p for a, b in zip(rim, rim[1:]) for p in line(a, b)] + [rim[-1]]
    hub = line((INNER, HIGH), (34, HIGH)) + fillet((34, 14), 4, 270, 180) + line((30, 14), (30, 24))
    hub += line((30, 24), (26, 24)) + line((26, 24), (26, 34)) + line((26, 34), (25, 34)) + line((25, 34), (25, 24))
    hub += line((25, 24), (20, 24)) + line((20, 24), (20, LOW)) + line((20, LOW), (INNER, LOW)) + [(INNER, LOW)]
    return rim, hub


def part():
    """Returns the quadrilaterals of the part. Each quadrilateral has four positions of its own, so common corners occur
    several times."""
    quads = []

    def sheet(rows):
        """Adds quadrilaterals between rows of points."""
        for a, b in zip(rows, rows[1:]):
            quads.extend(zip(a[:-1], a[1:], b[1:], b[:-1]))

    def circle(r, z):
        angles = 2 * numpy.pi * (numpy.arange(AROUND + 1) % AROUND) / AROUND
        return list(zip(r * numpy.cos(angles), r * numpy.sin(angles), numpy.full(AROUND + 1, z)))

    for points in profile():
        sheet([circle(r, z) for r, z in points])
    radii = numpy.linspace(INNER, OUTER, CELL // 2 + 1)
    for hole in range(HOLES):
        first = hole * CELL
        angles = 2 * numpy.pi * ((first + numpy.arange(CELL + 1)) % AROUND) / AROUND
        # Each hole is in one sector of the ring. This is the border of the sector, counter-clockwise from its inner
        # corner at the first angle.
        border = [(r, angles[0]) for r in radii[:-1]] + [(OUTER, a) for a in angles[:-1]]
        border += [(r, angles[-1]) for r in radii[:0:-1]] + [(INNER, a) for a in angles[:0:-1]]
        border = numpy.array([(r * numpy.cos(a), r * numpy.sin(a)) for r, a in border])
        turn = 2 * numpy.pi * (first + CELL / 2) / AROUND
        center = HOLE_CENTER * numpy.array([numpy.cos(turn), numpy.sin(turn)])
        out = border - center
        inner = center + HOLE_RADIUS * out / numpy.linalg.norm(out, axis=1)[:, None]
        for z in (LOW, HIGH):
            rows = [inner + (border - inner) * k / RINGS for k in range(RINGS + 1)]
            rows = [[(*p, z) for p in numpy.vstack([row, row[:1]])] for row in rows]
            sheet(rows if z == LOW else rows[::-1])
        wall = [[(*p, z) for p in numpy.vstack([inner, inner[:1]])] for z in numpy.linspace(HIGH, LOW, LAYERS + 1)]
        sheet(wall)
    return numpy.array(quads)


def run(program, folder, steps):
    recipe = folder / "recipe.ron"
    recipe.write_text(f"(recipe: 1, steps: [{steps}])")
    command = [program, "run", recipe, "--out", folder, "--no-cache", "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)


def read(path):
    lines = [line.split() for line in Path(path).read_text().splitlines()]
    positions = numpy.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
    faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]
    return positions, numpy.array(faces)


def sharp_edges(positions, triangles, above):
    """Returns the ends of all edges whose dihedral angle is larger than `above`, in degrees."""
    corners = positions[triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    sides = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = numpy.lexsort((sides[:, 1], sides[:, 0]))
    faces = numpy.tile(numpy.arange(len(triangles)), 3)[order].reshape(-1, 2)
    sides = sides[order][::2]
    cosine = (normals[faces[:, 0]] * normals[faces[:, 1]]).sum(1)
    return positions[sides[cosine < numpy.cos(numpy.radians(above))]]


def farthest(segments, others, samples=8):
    """Returns the largest distance from a point on `segments` to the nearest segment of `others`."""
    t = numpy.linspace(0, 1, samples)[None, :, None]
    points = (segments[:, :1] * (1 - t) + segments[:, 1:] * t).reshape(-1, 3)
    start, along = others[:, 0], others[:, 1] - others[:, 0]
    largest = 0.0
    for block in numpy.array_split(points, max(1, len(points) // 200)):
        offset = block[:, None] - start
        t = numpy.clip((offset * along).sum(2) / (along * along).sum(1), 0, 1)
        distance = numpy.linalg.norm(offset - t[..., None] * along, axis=2).min(1)
        largest = max(largest, distance.max())
    return largest


def smallest_angles(positions, triangles):
    corners = positions[triangles]
    a, b, c = (numpy.linalg.norm(corners[:, (i + 2) % 3] - corners[:, (i + 1) % 3], axis=1) for i in range(3))
    cosines = [(y * y + z * z - x * x) / (2 * y * z) for x, y, z in ((a, b, c), (b, c, a), (c, a, b))]
    return numpy.degrees(numpy.arccos(numpy.clip(numpy.max(cosines, axis=0), -1, 1)))


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        quads = part()
        points = quads.reshape(-1, 3)
        lines = ["v %r %r %r" % tuple(map(float, p)) for p in points]
        lines += ["f %d %d %d %d" % tuple(range(4 * i + 1, 4 * i + 5)) for i in range(len(quads))]
        (folder / "quads.obj").write_text("\n".join(lines) + "\n")
        steps = f'Load(path: "{folder}/quads.obj"), Weld(distance: 1e-9), Triangulate, Save(path: "part.obj")'
        run(program, folder, steps)
        simplify = "Simplify(ratio: 0.1, features: Sharp(above: 30))"
        run(program, folder, f'Load(path: "{folder}/part.obj"), {simplify}, Save(path: "Meshwright.obj")')
        before = read(folder / "part.obj")
        mesh = meshlib.loadMesh(str(folder / "part.obj"))
        settings = meshlib.DecimateSettings()
        settings.maxDeletedFaces = mesh.topology.numValidFaces() - len(read(folder / "Meshwright.obj")[1])
        settings.maxError = 1e30
        settings.packMesh = True
        meshlib.decimateMesh(mesh, settings)
        meshlib.saveMesh(mesh, str(folder / "MeshLib.obj"))
        diagonal = numpy.linalg.norm(before[0].max(0) - before[0].min(0))
        print(f"{len(before[1])} triangles; distances are relative to the diagonal")
        print("| program | triangles | largest | mean | features | angle below 10 degrees |")
        print("| --- | --- | --- | --- | --- | --- |")
        for name in ("Meshwright", "MeshLib"):
            difference = [program, "diff", folder / "part.obj", folder / f"{name}.obj", "--format", "json"]
            difference = json.loads(subprocess.run(difference, capture_output=True, text=True).stdout)
            distance = difference["objects"][0]["mesh"]["distance"]
            after = read(folder / f"{name}.obj")
            features = [sharp_edges(*mesh, 30) for mesh in (before, after)]
            feature = max(farthest(*features), farthest(*features[::-1]))
            few = (smallest_angles(*after) < 10).mean()
            print(
                f"| {name} | {len(after[1])} | {distance['largest'] / diagonal:.1e} | {distance['mean'] / diagonal:.1e} "
                f"| {feature / diagonal:.1e} | {100 * few:.1f} % |",
                flush=True,
            )


main()
