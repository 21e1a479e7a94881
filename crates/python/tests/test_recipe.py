"""Recipes: built, loaded, checked and run."""

import pickle
import re
import runpy
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice, expect, sel

ROOT = Path(__file__).resolve().parents[3]
SCENES = ROOT / "scenes"


def program(*arguments: str) -> str:
    run = subprocess.run([sys.executable, "-m", "meshwright", *arguments], capture_output=True, text=True, check=True)
    return run.stdout


def test_the_digest_is_that_of_the_program(tmp_path: Path) -> None:
    recipe = (
        mw.recipe()
        .icosahedron(name="ball")
        .flip_edges(edges=sel.Random(count=4, seed=7), on_refusal="Skip")
        .split_edges(edges=sel.Longest(count=3), id="cut")
        .loop_subdivide(levels=mw.arg("levels", int, default=2))
        .expect("Manifold", expect.Faces(min=100))
    )
    file = tmp_path / "a.ron"
    recipe.save_recipe(file)
    printed = program("run", str(file), "--out", str(tmp_path / "out"), "--set", "levels=3")
    (digest,) = re.findall(r"digest ([0-9a-f]{32})", printed)
    outcome = recipe.run(levels=3)
    assert outcome.digest == digest == outcome.scene.digest
    assert outcome.checked == 2 and [s.name for s in outcome.steps][2] == "cut"
    assert mw.Recipe.load(file).run(levels=3).digest == digest


def test_methods_and_steps_give_the_same_bytes() -> None:
    by_steps = mw.recipe().icosahedron(name="ball").flip_edges(edges=sel.Random(count=4, seed=7)).run().mesh()
    by_methods = mw.Scene().icosahedron(name="ball").mesh().flip_edges(edges=sel.Random(count=4, seed=7))
    assert by_steps == by_methods


@pytest.mark.parametrize("name", ["teapot", "cube"])
def test_recorded_digests(name: str) -> None:
    digests = dict(line.split() for line in (ROOT / "tests" / "digests.txt").read_text().splitlines())
    if name not in digests:
        pytest.skip("not a scene")
    assert mw.run(SCENES / f"{name}.ron", keep_outputs=False).digest == digests[name]


def test_every_error_has_its_place() -> None:
    recipe = mw.Recipe('(recipe: 1, steps: [\n    Cube(name: "a"),\n    LoopSubdivid(levels: 1),\n    Weld(distance: -1),\n])')
    with pytest.raises(mw.RecipeError) as info:
        recipe.check()
    places = [(p.file, p.line, p.column) for p in info.value.problems]
    assert places == [("recipe.ron", 3, 5), ("recipe.ron", 4, 20)]
    assert "LoopSubdivide" in (info.value.problems[0].help or "")
    assert "3 │     LoopSubdivid" in str(info.value)
    assert recipe.problems() == info.value.problems


def test_a_failed_run_names_the_step(tmp_path: Path) -> None:
    recipe = mw.recipe().cube(name="a").save("a.obj").expect(expect.Faces(eq=7))
    with pytest.raises(mw.RecipeError, match="Faces"):
        recipe.run(out=tmp_path)
    assert list(tmp_path.iterdir()) == []
    assert mw.recipe().cube(name="a").save("a.obj").run(out=tmp_path).files == (str(tmp_path / "a.obj"),)


def test_expectations_can_be_about_some_objects_after_a_step() -> None:
    recipe = mw.recipe().cube(name="a", id="first").cube(name="b")
    with pytest.raises(mw.RecipeError, match="Faces"):
        recipe.expect(expect.Faces(eq=6)).run()
    recipe = recipe.expect(expect.Faces(eq=6), "Closed", on="a").expect(expect.Faces(eq=6), after="first")
    assert '(on: ["a"], that: [Faces(eq: 6), Closed])' in recipe.to_ron()
    assert recipe.run().checked == 3


def test_values_are_written_as_recipes_write_them() -> None:
    text = (
        mw.recipe()
        .cube(name="a")
        .transform(scale=np.array([1, 2, 3.5]))
        .split_edges(edges=sel.And([sel.Sharp(above=30), sel.Not(sel.Between(0, 1))]), on="a")
        .picture("a.png", size=(64, 64), camera=choice.Fit(from_="Front", up="Z"))
        .to_ron()
    )
    assert "Transform(scale: (1, 2, 3.5))" in text
    assert '(run: SplitEdges(edges: And([Sharp(above: 30), Not(Between(0, 1))])), on: ["a"])' in text
    assert 'Picture(path: "a.png", size: (64, 64), camera: Fit(from: Front, up: Z))' in text
    assert mw.Recipe(text).check() == ()


def test_every_example_of_an_operation_can_be_read() -> None:
    from meshwright._schema import operations

    for entry in operations().values():
        recipe = mw.Recipe(f"(recipe: 1, steps: [{entry['example']}])")
        wrong = [p for p in recipe.problems() if "unknown" in p.message]
        assert wrong == []


def test_parameters() -> None:
    recipe = mw.recipe().cube(name=mw.arg("name", str, default="a")).loop_subdivide(levels=mw.arg("n", int, default=1, max=3))
    assert [(p.name, p.type, p.value) for p in recipe.parameters] == [("name", "Text", "a"), ("n", "Int", "1")]
    with pytest.raises(mw.RecipeError, match="3"):
        recipe.check(n=4)
    with pytest.raises(ValueError, match="declared twice"):
        recipe.loop_subdivide(levels=mw.arg("n", int, default=2))
    assert pickle.loads(pickle.dumps(recipe)) == recipe


LONG = mw.recipe().icosahedron(name="ball").loop_subdivide(levels=9)


def test_progress_is_reported_and_its_exceptions_cancel() -> None:
    seen: list[tuple[str, str, int, int]] = []
    mw.recipe().icosahedron(name="ball").loop_subdivide(levels=7).run(progress=lambda *part: seen.append(part))
    assert all(total > 0 and 0 <= done <= total for _, _, done, total in seen)

    def stop(*_: object) -> None:
        raise RuntimeError("enough")

    begin = time.monotonic()
    with pytest.raises(RuntimeError, match="enough"):
        LONG.run(progress=stop)
    assert time.monotonic() - begin < 20


def test_ctrl_c_cancels() -> None:
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):
            LONG.run()
    timer.join()


def test_two_threads_run_two_recipes() -> None:
    digests: list[str] = []
    recipe = mw.recipe().icosahedron(name="ball").loop_subdivide(levels=4)
    threads = [threading.Thread(target=lambda: digests.append(recipe.run().digest)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(digests) == 2 and digests[0] == digests[1]


def test_a_forked_process_gets_an_error() -> None:
    code = """
import os, meshwright as mw
m = mw.Scene().cube(name="a").mesh()
pid = os.fork()
if pid == 0:
    try:
        m.triangulate()
    except RuntimeError as error:
        os._exit(7 if "spawn" in str(error) else 1)
    os._exit(2)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
"""
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 7


def test_the_program_is_part_of_the_package() -> None:
    assert "LoopSubdivide" in program("ops")
    wrong = subprocess.run([sys.executable, "-m", "meshwright", "run", "missing.ron"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "missing.ron" in wrong.stderr


def test_importing_changes_nothing() -> None:
    code = "import os, sys; e = dict(os.environ); import meshwright; assert e == dict(os.environ); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"matplotlib", "scipy", "tqdm", "trimesh", "pytest"} & set(loaded)


def test_the_example(tmp_path: Path) -> None:
    import example

    mw.Scene().torus(name="ring").mesh().save(tmp_path / "ring.obj")
    assert example.edit(tmp_path / "ring.obj").defects() == []
    digest = example.run(tmp_path / "ring.obj", tmp_path / "out")
    assert len(digest) == 32 and (tmp_path / "out" / "a.png").exists()


def test_the_sample(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The script `sample.py` with the first steps runs unchanged."""
    monkeypatch.chdir(tmp_path)
    ball = mw.Scene().icosahedron(name="ball").mesh()
    ball.save("bunny.obj").save("scan.ply")
    ball.loop_subdivide(levels=5).save("a.obj")
    mw.recipe().load(mw.arg("input", default=Path("scan.ply"))).loop_subdivide(
        levels=mw.arg("levels", int, default=1)
    ).expect("Manifold").save_recipe("clean.ron")
    made = runpy.run_path(str(Path(__file__).parent / "sample.py"))
    assert made["out"].mesh().n_faces == 1280
    assert made["r"].run().mesh().n_faces == 5000
    assert mw.read("out/a.glb").mesh().n_faces == 5000 and made["m"].n_faces == 320


def test_a_variant_with_one_value_and_with_fields(tmp_path: Path) -> None:
    """The choice `Distance` has two forms: one number in `ExtrudeFaces`, and named fields in `Measure`."""
    box = mw.Scene().cube(name="box", size=2).mesh()
    grown = box.extrude_faces(faces=sel.Facing(direction=(0, 0, 1), within=1), by=choice.Distance(0.5))
    assert grown.vertices[:, 2].max() == 1.5
    scene = mw.Scene().cube(name="box").icosahedron(name="ball")
    measured = scene.measure(of=choice.Distance(to="box"), name="far", on="ball")
    assert measured["ball"].attributes["far"].shape == (12,)


def test_texts_with_control_characters() -> None:
    """JSON has escapes that RON does not have."""
    text = "".join(map(chr, range(1, 256))) + "\u2028\u00e9\U0001f600"
    assert mw.Scene().cube(name=text).mesh().name == text
    assert list(mw.recipe().cube(name=text).about(text).run()) == [text]


def test_a_check_has_the_budget_of_the_run() -> None:
    r = mw.recipe().icosahedron(name="ball").loop_subdivide(levels=5)
    assert not r.problems() and "budget" in r.problems(budget=1000)[0].message
    with pytest.raises(mw.RecipeError, match="budget"):
        r.check(budget=1000)


def test_parameters_with_the_names_of_options_can_be_checked() -> None:
    text = '(recipe: 1, params: {"out": Int(default: 1, max: 3)}, steps: [Icosahedron(name: "a"), LoopSubdivide(levels: arg("out"))])'
    r = mw.Recipe(text)
    assert r.check({"out": 2}) == () and r.run({"out": 2}).mesh().n_faces == 320
    assert "out" in r.problems({"out": 9})[0].message
    with pytest.raises(mw.RecipeError, match="out"):
        r.check({"out": 9})
