"""The generated sources are up to date, and every doctest passes."""

import doctest
import importlib
import importlib.util
import pkgutil
from pathlib import Path

import pytest

import meshwright as mw

FOLDER = Path(__file__).resolve().parents[1]


def test_generated_files_are_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("generate", FOLDER / "generate.py")
    assert spec and spec.loader
    generate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generate)
    for name, text in generate.files().items():
        assert (FOLDER / "python" / "meshwright" / name).read_text() == text, "run python crates/python/generate.py"


def test_no_operation_hides_a_member() -> None:
    from meshwright._operations import MeshOperations, SceneOperations

    for kind, operations in ((mw.Mesh, MeshOperations), (mw.Scene, SceneOperations), (mw.Recipe, SceneOperations)):
        own = {name for base in kind.__mro__ if base is not operations and base is not object for name in vars(base)}
        common = {name for name in own & set(vars(operations)) if not name.startswith("_")}
        assert common <= {"save", "load"}


def test_every_operation_has_a_method_and_documentation() -> None:
    from meshwright._ron import operations

    spec = importlib.util.spec_from_file_location("generate", FOLDER / "generate.py")
    assert spec and spec.loader
    generate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generate)
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
