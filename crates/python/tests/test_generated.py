"""The generated sources are up to date, and every doctest passes."""

import doctest
import importlib
import importlib.util
import inspect
import pkgutil
from pathlib import Path
from typing import Any

import pytest

import meshwright as mw
from meshwright._names import TOKEN
from meshwright._schema import operations

FOLDER = Path(__file__).resolve().parents[1]


def generator() -> Any:
    spec = importlib.util.spec_from_file_location("generate", FOLDER / "generate.py")
    assert spec and spec.loader
    generate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generate)
    return generate


def test_generated_files_are_up_to_date() -> None:
    for name, text in generator().files().items():
        assert (FOLDER / "python" / "meshwright" / name).read_text() == text, "run python crates/python/generate.py"


def test_values_of_recipes_are_documented_as_in_python() -> None:
    in_python = generator().in_python
    for ron, python in {
        "Sharp(above: 30)": "sel.Sharp(above=30)",
        'Not(Tagged("a b"))': 'sel.Not(sel.Tagged("a b"))',
        "on_refusal: Skip": 'on_refusal="Skip"',
        "keep_volume: true": "keep_volume=True",
        "quantize: ()": "quantize={}",
        "rotate: [(axis: Z, angle: 90)]": 'rotate=[{"axis": "Z", "angle": 90}]',
        "move: (0, -1e-3, 1)": "move=(0, -1e-3, 1)",
        "LoopSubdivide(levels: 2)": "loop_subdivide(levels=2)",
        "Taubin()": "choice.Taubin()",
        "Stitch": "stitch()",
        "Tagged": "sel.Tagged",
        "Boundary": "Boundary",
        "from": "from_",
        ".obj": None,
        "a[0]": None,
        "(1, 2": None,
    }.items():
        assert in_python(ron) == python, ron


def test_the_examples_of_the_methods_are_those_of_the_operations() -> None:
    """For each method, the example in its documentation makes the same step as the example of the operation."""
    generate = generator()
    for name, entry in operations().items():
        call = generate.in_python(entry["example"])
        assert f"``scene.{call}``" in " ".join(inspect.getdoc(getattr(mw.Scene, generate.snake(name))).split())
        recipe = eval(f"recipe.{call}", {"recipe": mw.recipe(), "sel": mw.sel, "choice": mw.choice})
        step = recipe.to_ron().split("steps: [\n", 1)[1].rsplit(",\n    ],", 1)[0].strip()
        # The tokens are sorted before the comparison, because the two texts can list the parameters in different
        # orders.
        assert sorted(TOKEN.findall(generate.in_python(step))) == sorted(TOKEN.findall(call)), step


def test_no_operation_hides_a_member() -> None:
    from meshwright._operations import MeshOperations, SceneOperations

    for kind, operations in ((mw.Mesh, MeshOperations), (mw.Scene, SceneOperations), (mw.Recipe, SceneOperations)):
        own = {name for base in kind.__mro__ if base is not operations and base is not object for name in vars(base)}
        common = {name for name in own & set(vars(operations)) if not name.startswith("_")}
        assert common <= {"save", "load"}


def test_every_operation_has_a_method_and_documentation() -> None:
    generate = generator()
    for name, entry in operations().items():
        assert getattr(mw.Scene, generate.snake(name)).__doc__
        if entry["takes_on"]:
            assert getattr(mw.Mesh, generate.snake(name)).__doc__


MODULES = [m.name for m in pkgutil.iter_modules(mw.__path__) if m.name not in ("_core", "__main__")]


@pytest.mark.parametrize("name", ["", *MODULES])
def test_doctests(name: str) -> None:
    if name == "matrices":
        pytest.importorskip("scipy")
    module = importlib.import_module(f"meshwright.{name}" if name else "meshwright")
    result = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.failed == 0


def test_the_chapter_of_the_book() -> None:
    chapter = FOLDER.parents[1] / "book" / "src" / "python.md"
    text = "\n".join("" if line.startswith("```") else line for line in chapter.read_text().splitlines())
    test = doctest.DocTestParser().get_doctest(text, {}, chapter.name, str(chapter), 0)
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test)
    assert result.failed == 0 and result.attempted > 20
