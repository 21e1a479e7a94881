"""A plugin of pytest that collects recipes as tests: `pytest --recipes scenes/` runs the recipes (`*.ron`) that
`meshwright test scenes/` runs. Outputs are not kept."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

TESTED = pytest.StashKey[set[Path]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the option `--recipes`."""
    parser.getgroup("meshwright").addoption("--recipes", action="store_true", help="collect recipes (*.ron) as tests")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collects a recipe."""
    if file_path.suffix != ".ron" or not parent.config.getoption("--recipes"):
        return None
    if file_path.resolve() not in tested(parent.config):
        return None
    made: pytest.Collector = RecipeFile.from_parent(parent, path=file_path)
    return made


def tested(config: pytest.Config) -> set[Path]:
    """Returns the recipes that `meshwright test` would run for the files and folders in the arguments of pytest."""
    found: set[Path] | None = config.stash.get(TESTED, None)
    if found is None:
        from meshwright._core import tested_recipes

        given = [config.invocation_params.dir / argument.partition("::")[0] for argument in config.args]
        recipes = tested_recipes([path for path in given if path.is_dir() or path.suffix == ".ron" and path.is_file()])
        found = config.stash[TESTED] = {path.resolve() for path in recipes}
    return found


class RecipeFile(pytest.File):
    """The file of a recipe."""

    def collect(self) -> Iterator[pytest.Item]:
        """Yields the test of the recipe. If the recipe cannot be read, this test fails."""
        yield RecipeTest.from_parent(self, name=self.path.stem)


class RecipeTest(pytest.Item):
    """The test of a recipe. It passes if every step succeeds and every expectation holds."""

    def runtest(self) -> None:
        """Runs the recipe."""
        from meshwright import Recipe

        Recipe.load(self.path).run(keep_outputs=False)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Returns the diagnostics of the recipe as the text of a failure."""
        from meshwright import Error

        if isinstance(excinfo.value, Error):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Returns the path and the title under which pytest reports the recipe."""
        return self.path, 0, f"recipe {self.name}"
