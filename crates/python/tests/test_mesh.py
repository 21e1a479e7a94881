"""Meshes: arrays, attributes, operations, edits."""

import copy
import gc
import pickle
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice, expect, sel

SCENES = Path(__file__).resolve().parents[3] / "scenes"


def test_arrays_are_read_only_views(ball: mw.Mesh) -> None:
    assert ball.vertices.shape == (12, 3) and ball.vertices.dtype == np.float64
    assert ball.triangles.shape == (20, 3) and ball.triangles.dtype == np.uint32
    for array in (ball.vertices, ball.triangles, ball.corners, ball.face_starts, *ball.half_edges):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array.flags.writeable = True
    assert ball.half_edges.origin.base is not None


def test_positions_are_not_copied(ball: mw.Mesh) -> None:
    first = np.frombuffer(ball._core.array("positions"))
    second = np.frombuffer(ball._core.array("positions"))
    assert first.__array_interface__["data"] == second.__array_interface__["data"]


def test_views_outlive_their_mesh() -> None:
    vertices = mw.Scene().uv_sphere(name="ball").mesh().vertices
    expected = vertices.copy()
    gc.collect()
    big = [mw.Scene().uv_sphere(name="ball").mesh().vertices for _ in range(20)]
    assert (vertices == expected).all() and len(big) == 20


def test_half_edges_obey_the_rules_of_the_kernel(ball: mw.Mesh) -> None:
    h = np.arange(2 * ball.n_edges)
    next_, origin, face = ball.half_edges.next, ball.half_edges.origin, ball.half_edges.face
    assert (origin[next_] == origin[h ^ 1]).all()
    assert (face[next_] == face).all()
    assert (np.sort(next_) == h).all()


def test_polygons(box: mw.Mesh) -> None:
    assert box.face_starts.tolist() == list(range(0, 25, 4))
    assert [len(f) for f in box.faces] == [4] * 6
    with pytest.raises(ValueError, match="face 0 has 4 corners"):
        _ = box.triangles
    again = mw.Mesh.from_arrays(box.vertices, box.corners, face_starts=box.face_starts, name="box")
    assert (again.corners == box.corners).all()
    assert (mw.Mesh.from_arrays(box.vertices, box.faces).corners == box.corners).all()


def test_faces_of_different_lengths() -> None:
    m = mw.Mesh.from_arrays([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]], [[0, 1, 2, 3], [1, 4, 2]])
    assert m.face_starts.tolist() == [0, 4, 7] and m.defects() == []


def test_an_empty_mesh() -> None:
    m = mw.Mesh.from_arrays([], [])
    assert (m.n_vertices, m.n_faces, m.vertices.shape, m.triangles.shape) == (0, 0, (0, 3), (0, 3))


def test_repairs_are_noted_or_refused() -> None:
    points, faces = np.eye(5, 3), [[0, 1, 2], [0, 1, 3], [0, 1, 4]]
    assert any("edge" in note for note in mw.Mesh.from_arrays(points, faces).notes)
    with pytest.raises(ValueError, match="manifold"):
        mw.Mesh.from_arrays(points, faces, repair=False)


def test_attributes_of_every_domain_come_back(box: mw.Mesh) -> None:
    rng = np.random.default_rng(0)
    for domain, n in (("vertex", 8), ("corner", 24), ("edge", 12), ("face", 6)):
        for values in (
            rng.random(n),
            rng.random((n, 2)),
            rng.random((n, 3)),
            rng.random((n, 4)),
            rng.integers(-5, 5, n),
            rng.random(n) > 0.5,
        ):
            m = box.with_attribute("x", values, domain)  # type: ignore[arg-type]
            assert m.attributes.domain("x") == domain
            assert np.array_equal(m.attributes["x"], values)
            assert "x" not in m.without_attribute("x").attributes
    assert len(box.attributes) == 0


def test_the_domain_follows_from_the_number_of_values(box: mw.Mesh) -> None:
    assert box.with_attribute("x", np.zeros(24)).attributes.domain("x") == "corner"
    with pytest.raises(ValueError, match="fits no domain"):
        box.with_attribute("x", np.zeros(7))


def test_tags_select(box: mw.Mesh) -> None:
    m = box.with_attribute("top", np.arange(6) == 2, "face")
    assert m.tags == [("face", "top")] and m.tag("face", "top").sum() == 1
    assert m.delete_faces(faces=sel.Tagged("top")).n_faces == 5


def test_operations_return_new_meshes(ball: mw.Mesh) -> None:
    before = ball.digest
    finer = ball.loop_subdivide(levels=2)
    assert (finer.n_faces, ball.n_faces, ball.digest) == (320, 20, before)
    assert finer.simplify(faces=100).n_faces == 100
    assert ball.apply("LoopSubdivide", levels=2) == finer


def test_a_mesh_is_a_parameter(ball: mw.Mesh) -> None:
    big = ball.transform(scale=(2, 2, 2)).loop_subdivide(levels=3)
    moved = ball.project(big)
    assert moved.name == "ball" and moved.n_faces == 20
    assert np.linalg.norm(moved.vertices, axis=1).min() > 1.1 * np.linalg.norm(ball.vertices, axis=1).max()


def test_errors_have_problems(ball: mw.Mesh) -> None:
    with pytest.raises(mw.RecipeError) as info:
        ball.loop_subdivide(levels=99)
    problem = info.value.problems[0]
    assert problem.severity == "error" and problem.line == 2 and problem.help
    with pytest.raises(mw.RecipeError, match="is on the boundary"):
        ball.delete_faces(faces=sel.Faces([0])).flip_edges(edges="Boundary")
    again = pickle.loads(pickle.dumps(info.value))
    assert again.problems == info.value.problems


def test_an_unknown_parameter_is_an_error_of_python(ball: mw.Mesh) -> None:
    with pytest.raises(TypeError):
        ball.loop_subdivide(level=2)  # type: ignore[call-arg]
    with pytest.raises(mw.RecipeError, match="level"):
        ball.apply("LoopSubdivide", level=2)


def test_edits(ball: mw.Mesh) -> None:
    with ball.edit() as e:
        edge = e.edge(*e.edge_vertices(3))
        e.flip(edge)
        vertex = e.split(edge, at=0.25)
        e.move(vertex, [0, 0, 2])
        e.collapse(e.edge(*e.edge_vertices(edge)))
        e.delete([e.extrude([15], [0, 0, 1])[0]])
        e.poke(16)
    assert e.mesh.defects() == [] and e.mesh.n_vertices == 16
    assert ball.n_vertices == 12


def test_a_refused_edit_names_its_reason(ball: mw.Mesh) -> None:
    with ball.edit() as e:
        e.delete([0])
        boundary = int(np.flatnonzero(e.mesh.half_edges.face == 2**32 - 1)[0]) // 2
        with pytest.raises(mw.EditError) as info:
            e.flip(boundary)
        with pytest.raises(mw.EditError):
            e.flip(2**32 - 2)
        for wrong in (-1, 2**32, 2**70):
            with pytest.raises((OverflowError, ValueError)):
                e.flip(wrong)
    assert info.value.reason == "Boundary" and info.value.elements == (f"e{boundary}",)


def test_pickles_and_copies(ball: mw.Mesh) -> None:
    m = ball.with_attribute("heat", np.arange(12.0)).with_attribute("top", np.arange(20) > 3, "face")
    for again in (pickle.loads(pickle.dumps(m)), copy.deepcopy(m)):
        assert again == m and again.name == m.name and (again.attributes["heat"] == m.attributes["heat"]).all()
    scene = m.scene().torus(name="ring")
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_files(tmp_path: Path, ball: mw.Mesh) -> None:
    for extension in ("obj", "ply", "off", "stl", "glb", "gltf", "mws"):
        ball.save(tmp_path / f"a.{extension}")
        again = mw.read(tmp_path / f"a.{extension}").mesh()
        assert again.n_faces == 20
    assert mw.read_bytes(ball.scene().to_bytes("ply"), "a.ply").mesh().n_faces == 20
    with pytest.raises(mw.RecipeError, match="missing.obj"):
        mw.read(tmp_path / "missing.obj")


def test_addresses(ball: mw.Mesh) -> None:
    pytest.importorskip("fsspec")
    ball.save("memory://models/a.glb")
    assert mw.read("memory://models/a.glb").mesh().n_faces == 20


def test_the_only_mesh_of_a_scene() -> None:
    scene = mw.Scene().cube(name="a").cube(name="b")
    with pytest.raises(ValueError, match='"a", "b"'):
        scene.mesh()
    with pytest.raises(KeyError, match="objects"):
        scene["c"]
    with pytest.raises(TypeError, match="patches"):
        mw.read(SCENES / "assets" / "teapot.bez")["teapot"]


def test_pictures(ball: mw.Mesh) -> None:
    assert ball._repr_png_()[:4] == b"\x89PNG"


def test_threads_run_at_the_same_time() -> None:
    big = mw.Scene().icosahedron(name="ball").mesh().loop_subdivide(levels=6)
    ticks = 0
    done = threading.Event()

    def work() -> None:
        big.loop_subdivide(levels=2)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        ticks += 1
        time.sleep(0.001)
    thread.join()
    assert ticks > 3


def test_progress(ball: mw.Mesh, capsys: pytest.CaptureFixture[str]) -> None:
    calls = []
    ball.loop_subdivide(levels=8, progress=lambda *call: calls.append(call))
    assert calls and all(0 <= done <= total for _, _, done, total in calls)

    def stop(*call: object) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ball.apply("LoopSubdivide", levels=8, progress=stop)
    with pytest.raises(TypeError, match="run()"):
        mw.recipe().cube(name="box", progress=True)
    pytest.importorskip("tqdm")
    mw.Scene().icosahedron(name="ball").loop_subdivide(levels=8, progress=True)
    assert "%|" in capsys.readouterr().err


def test_notes_are_kept() -> None:
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]]
    m = mw.Mesh.from_arrays(points, [[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 0, 1]])
    assert any("split" in note for note in m.notes) and any("dropped" in note for note in m.notes)
    assert m.with_attribute("x", m.vertices[:, 0], "vertex").without_attribute("x").with_vertices(m.vertices).notes == m.notes
    with m.edit() as e:
        e.poke(0)
    assert e.mesh.notes == m.notes


def test_measures(box: mw.Mesh, ball: mw.Mesh) -> None:
    a, b, c = (ball.vertices[ball.triangles[:, i]] for i in range(3))
    assert np.isclose(ball.area, np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    assert np.isclose(ball.volume, np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
    assert (ball.bounds == [ball.vertices.min(axis=0), ball.vertices.max(axis=0)]).all()
    with pytest.raises(ValueError, match="boundary"):
        mw.Mesh.from_arrays(np.eye(3), [[0, 1, 2]]).volume
    with pytest.raises(ValueError, match="no vertices"):
        mw.Mesh.from_arrays([], []).bounds


def test_distances(ball: mw.Mesh, box: mw.Mesh) -> None:
    spike = mw.Mesh.from_arrays([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 3]], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    flat = mw.Mesh.from_arrays([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    found = spike.distance_to(flat)
    assert np.allclose([found.forth.largest, found.back.largest, found.back.mean], [3, 0, 0])
    assert (found.largest, found.mean) == (found.forth.largest, found.forth.mean) and 0 < found.mean < 3
    assert found.largest <= found.at_most <= found.largest + 1e-5 * np.linalg.norm([4, 4, 3])
    assert flat.distance_to(spike) == mw.Distance(found.back, found.forth)
    recipe = mw.recipe().icosahedron(name="ball").copy("ball", "fine").loop_subdivide(levels=2, on="fine")
    limit = recipe.run()["ball"].distance_to(recipe.run()["fine"]).at_most
    for factor, holds in ((1.001, True), (0.999, False)):
        expectation = expect.DistanceTo(other=expect.Object("fine"), below=factor * limit)
        problems = []
        try:
            recipe.expect(expectation, on="ball").run()
        except mw.RecipeError as error:
            problems = list(error.problems)
        assert (not problems) == holds
    with pytest.raises(ValueError, match="with faces"):
        ball.distance_to(mw.Mesh.from_arrays([], []))
    with pytest.raises(TypeError, match="Scene, expected Mesh"):
        ball.distance_to(box.scene())  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="tolerance"):
        ball.distance_to(box, tolerance=-1)


def test_simplify_names_the_measured_attributes_that_influence_it() -> None:
    ball = mw.Scene().icosahedron(name="ball").mesh().loop_subdivide(levels=2)
    note = "attributes whose changes count as changes of the surface: curvature"
    assert note in ball.measure(of="MeanCurvature", name="curvature").simplify(faces=100).notes
    assert ball.simplify(faces=100).notes == ()


def test_selections(ball: mw.Mesh) -> None:
    m = ball.with_attribute("top", ball.vertices[:, 1] > 0, "vertex")
    assert (m.select(sel.Tagged("top"), "vertex") == np.flatnonzero(m.tag("vertex", "top"))).all()
    edges = m.select(sel.Not(sel.Longer(than=10)))
    assert edges.dtype == np.uint32 and len(edges) == m.n_edges and m.edges[edges].shape == (30, 2)
    assert len(m.select("Boundary", "edge")) == 0
    assert (m.select(sel.Faces([3, 1])) == [1, 3]).all()
    assert len(m.select(sel.Random(count=5, seed=1), "face")) == 5
    with pytest.raises(mw.RecipeError, match="vertices or edges or faces: specify which"):
        m.select("All")
    with pytest.raises(mw.RecipeError, match="did you mean"):
        m.select(mw.Choice("Shrap", above=30))
    with pytest.raises(ValueError, match="corner"):
        m.select("All", "corner")  # type: ignore[arg-type]


def test_a_mesh_is_the_name_of_another_object(ball: mw.Mesh) -> None:
    far = ball.transform(move=(3, 0, 0))
    m = ball.measure(of=choice.Distance(to=far), name="distance")
    assert m.attributes["distance"].shape == (12,) and m.name == "ball"
    assert ball.measure(of=choice.Winding(of=far)).n_faces == 20
    big = ball.transform(scale=(2, 2, 2))
    assert len(ball.select(sel.InsideOf(big), "vertex")) == 12
    assert len(ball.select(sel.And([sel.InsideOf(big), sel.Not(sel.InsideOf(far))]), "vertex")) == 12
    assert ball.delete_faces(faces=sel.Or([sel.InsideOf(big)])).n_faces == 0


def test_a_save_that_loses_something_warns_once(tmp_path: Path, ball: mw.Mesh) -> None:
    m = ball.with_attribute("top", ball.vertices[:, 1] > 0, "vertex").with_attribute("low", np.arange(20) > 3, "face")
    for save in (m.save, m.scene().save):
        with pytest.warns(mw.LossWarning, match='a.glb.*"top".*"low"') as found:
            save(tmp_path / "a.glb")
        assert len(found) == 1 and found[0].filename == __file__
        assert "An .mws file stores everything; see help(meshwright.LossWarning)" in str(found[0].message)
    with pytest.warns(mw.LossWarning) as found:
        m.scene().to_bytes("stl")
    assert len(found) == 1 and "position" not in str(found[0].message)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        m.save(tmp_path / "a.mws")
        m.save(tmp_path / "a.ply")
        ball.save(tmp_path / "a.stl")
        pickle.dumps(m)
        with pytest.raises(mw.LossWarning):
            m.save(tmp_path / "b.glb")


def test_face_normals(ball: mw.Mesh, box: mw.Mesh) -> None:
    a, b, c = (ball.vertices[ball.triangles[:, i]] for i in range(3))
    expected = np.cross(b - a, c - a)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    assert np.allclose(ball.face_normals, expected, atol=1e-15)
    assert not ball.face_normals.flags.writeable
    with pytest.raises(ValueError):
        ball.face_normals.flags.writeable = True
    assert box.dissolve_vertices(vertices=sel.Vertices([0])).face_normals.shape == (4, 3)
    mixed = mw.Mesh.from_arrays([[1e6, 0, 0], [1e6 + 1, 0, 0], [1e6 + 1, 1, 0], [1e6, 1, 0], [1e6 + 2, 0, 0]], [[0, 1, 2, 3], [1, 4, 2]])
    assert (mixed.face_normals == [[0, 0, 1], [0, 0, 1]]).all()
    assert mw.Mesh.from_arrays([], []).face_normals.shape == (0, 3)
    flat = mw.Mesh.from_arrays([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    assert (flat.face_normals == 0).all()
