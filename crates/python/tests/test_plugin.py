"""The pytest plugin of the package."""

import re
import subprocess
import sys
from pathlib import Path

SCENES = Path(__file__).resolve().parents[3] / "scenes"

CALLED = """(
    recipe: 1,
    steps: [LoopSubdivide(levels: 1)],
    expect: [Closed],
)
"""
CALLER = """(
    recipe: 1,
    steps: [Cube(name: "box"), Triangulate(), Call(recipe: "lib/called.ron")],
    expect: [Faces(eq: 48)],
)
"""
FAILING = '(recipe: 1, steps: [Cube(name: "box")], expect: [Faces(eq: 7)])'
SILENT = '(recipe: 1, steps: [Cube(name: "box")])'


def run(folder: Path, *arguments: str) -> tuple[int, set[str]]:
    """Runs pytest on recipes. Returns its exit code, and its line for each test."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-rA", "--no-header", "--recipes", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    return done.returncode, set(re.findall(r"^((?:PASSED|FAILED|ERROR) \S+)", done.stdout, re.MULTILINE))


def folder_of_recipes(folder: Path) -> None:
    for path, text in {
        "a.ron": CALLER,
        "lib/called.ron": CALLED,
        "assets/model.ron": FAILING,
        ".hidden/old.ron": FAILING,
        "silent.ron": SILENT,
        "many.sweep.ron": FAILING,
    }.items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text)


def test_the_recipes_are_those_that_the_program_tests(tmp_path: Path) -> None:
    folder_of_recipes(tmp_path)
    assert run(tmp_path, ".") == (0, {"PASSED a.ron::a"})
    assert run(tmp_path) == (0, {"PASSED a.ron::a"})
    assert run(tmp_path, "a.ron::a") == (0, {"PASSED a.ron::a"})
    # If the path of a recipe is given, the recipe is tested even though another recipe calls it. This test fails,
    # because the recipe does not create a mesh.
    assert run(tmp_path, "lib/called.ron") == (1, {"FAILED lib/called.ron::called"})
    (tmp_path / "broken.ron").write_text("(recipe: 1, steps: [Cub()])")
    assert run(tmp_path, ".") == (1, {"PASSED a.ron::a", "FAILED broken.ron::broken"})
    assert run(tmp_path, "missing.ron")[0] == 4


def test_the_scenes_of_the_repository_pass() -> None:
    code, tests = run(SCENES.parent, "scenes/")
    assert code == 0 and len(tests) > 20 and all(test.startswith("PASSED") for test in tests)
