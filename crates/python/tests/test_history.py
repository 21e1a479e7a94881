"""The recipe of the steps that made a mesh or a scene."""

import gc
import json
import pickle
import weakref
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice, sel

ASSETS = Path(__file__).resolve().parents[3] / "scenes" / "assets"


def scan() -> mw.Mesh:
    return mw.read(ASSETS / "bunny.obj").mesh()


def several() -> mw.Scene:
    return mw.Scene().cube(name="box", size=3).uv_sphere(name="ball").icosahedron(name="small", radius=0.5)


def flipped() -> mw.Mesh:
    random = sel.Random(count=24, seed=7)
    return scan().flip_edges(edges=random, on_refusal="Skip", id="flips").flip_edges(edges=random, on_refusal="Skip")


def bent() -> mw.Mesh:
    m = scan().measure(of="MeanCurvature", name="curvature")
    return m.tag_vertices(vertices=sel.Where(attribute="curvature", above=np.quantile(m.attributes["curvature"], 0.9)), name="bent")


MADE: list[Callable[[], mw.Mesh | mw.Scene]] = [
    mw.Scene,
    scan,
    flipped,
    bent,
    several,
    lambda: scan().weld(distance=1e-6).simplify(faces=900).smooth(by=choice.Taubin(), passes=3),
    lambda: scan().delete_faces(faces=sel.Faces(np.arange(5, 900, 200))).fill_holes().apply("Transform", scale=np.array([1, 2, 0.5])),
    lambda: several().triangulate(on="box").project(onto="ball", on="box")["box"],
    lambda: several().only("ball", "small").rename("small", "tiny").mesh("tiny").loop_subdivide(levels=1),
    lambda: several().mesh("box").scene().torus(name="ring").weld(distance=1e-6),
    lambda: mw.Scene().with_object(scan()).weld(distance=0.01),
    lambda: mw.read(ASSETS / "goldens" / "scan_to_game_asset.glb").mesh("bunny").reverse(),
    lambda: mw.read(ASSETS / "arm.gltf"),
]


@pytest.mark.parametrize("make", MADE)
def test_a_run_of_the_recipe_gives_the_same_digest(make: Callable[[], mw.Mesh | mw.Scene], tmp_path: Path) -> None:
    made = make()
    recipe = made.recipe()
    assert recipe.check() == () and recipe.run().digest == made.digest
    recipe.save_recipe(tmp_path / "again.ron")
    assert mw.run(tmp_path / "again.ron").digest == made.digest


def test_selections_are_written_as_in_a_recipe(ball: mw.Mesh) -> None:
    ids = np.flatnonzero(ball.face_normals[:, 2] > 0.9)
    built = mw.recipe().icosahedron(name="ball").delete_faces(faces=sel.Faces(ids), id="top").weld(distance=np.float64(0.1))
    assert ball.delete_faces(faces=sel.Faces(ids), id="top").weld(distance=np.float64(0.1)).recipe() == built


def test_files_that_were_written_are_not_steps(tmp_path: Path, ball: mw.Mesh) -> None:
    m = ball.save(tmp_path / "a.obj").picture(tmp_path / "a.png", size=(8, 8)).loop_subdivide(levels=1)
    recipe = m.recipe()
    assert recipe == mw.recipe().icosahedron(name="ball").loop_subdivide(levels=1)
    assert recipe.save("b.obj").run(out=tmp_path).digest == m.digest and (tmp_path / "b.obj").exists()


def edited(m: mw.Mesh) -> mw.Mesh:
    with m.edit() as e:
        e.poke(0)
    return e.mesh


LOST: list[tuple[Callable[[mw.Mesh], mw.Mesh | mw.Scene], str]] = [
    (lambda m: mw.Mesh.from_arrays(m.vertices, m.triangles).weld(distance=1), r"make a mesh from arrays.*\. Save"),
    (lambda m: m.reverse().with_vertices(2 * m.vertices).reverse(), r"`with_vertices\(\)` after the step `Reverse\(\)`\. Save"),
    (lambda m: m.with_attribute("x", m.vertices[:, 0], "vertex").with_vertices(m.vertices), r"`with_attribute\(\)` after"),
    (lambda m: m.measure(of="Area").without_attribute("area"), r"`without_attribute\(\)` after the step `Measure\(of: Area\)`"),
    (edited, r"`edit\(\)` after the step `Icosahedron"),
    (lambda m: m.project(m.reverse()), r"`project\(\)` with a mesh as an argument.*one scene"),
    (lambda m: m.scene().with_object(m, name="b"), r"`with_object\(\)`.*one scene"),
    (lambda m: m.scene().placed(), r"`placed\(\)`.*Bake"),
    (lambda m: m.recipe().run().mesh(), r"the result of a recipe.*Add further steps to that recipe"),
    (lambda m: pickle.loads(pickle.dumps(m)), r"bytes"),
    (lambda m: mw.read_bytes(m.scene().to_bytes("ply"), "a.ply"), r"bytes"),
]


@pytest.mark.parametrize(("change", "text"), LOST)
def test_a_change_that_no_recipe_can_repeat_is_named(change: Callable[[mw.Mesh], mw.Mesh | mw.Scene], text: str, ball: mw.Mesh) -> None:
    with pytest.raises(ValueError, match=f"^no recipe can .*{text}") as info:
        change(ball).recipe()
    assert len(str(info.value)) < 250


def test_a_mesh_of_a_scene_with_a_camera_has_no_recipe(tmp_path: Path, ball: mw.Mesh) -> None:
    ball.scene().octahedron(name="gem").save(tmp_path / "a.gltf")
    data = json.loads((tmp_path / "a.gltf").read_text())
    data["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
    data["nodes"].append({"camera": 0})
    data["scenes"][0]["nodes"].append(len(data["nodes"]) - 1)
    (tmp_path / "a.gltf").write_text(json.dumps(data))
    scene = mw.read(tmp_path / "a.gltf")
    assert scene.weld(distance=0, on="ball").recipe().run().digest == scene.weld(distance=0, on="ball").digest
    for part in (scene["ball"], scene.only("ball", "gem")):
        with pytest.raises(ValueError, match="lacks nodes, cameras or lights.*Bake"):
            part.recipe()


def test_old_meshes_are_freed(ball: mw.Mesh) -> None:
    first = ball.loop_subdivide(levels=1)
    gone = weakref.ref(first)
    last = first.weld(distance=1e-6)
    del first
    gc.collect()
    assert gone() is None and len(last.recipe().run().steps) == 3
    for _ in range(2000):
        last = last.reverse()
    assert len(last._history.steps()) == 2003
