"""A plugin of pytest that collects recipes as tests: `pytest --recipes scenes/` runs every recipe (`*.ron`) below the folder
that states expectations. Outputs are not kept."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the option."""
    parser.getgroup("meshwright").addoption("--recipes", action="store_true", help="collect recipes (*.ron) as tests")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collects a recipe."""
    is_given = file_path.suffix == ".ron" and not file_path.name.endswith(".sweep.ron")
    if is_given and parent.config.getoption("--recipes"):
        made: pytest.Collector = RecipeFile.from_parent(parent, path=file_path)
        return made
    return None


class RecipeFile(pytest.File):
    """The file of a recipe."""

    def collect(self) -> Iterator[pytest.Item]:
        """The test of a recipe with expectations. A recipe that cannot be read is a test that fails."""
        from meshwright import Recipe

        core = Recipe.load(self.path)._core()
        if core.n_expectations() or any(p["severity"] == "error" for p in core.problems()):
            yield RecipeTest.from_parent(self, name=self.path.stem)


class RecipeTest(pytest.Item):
    """The test of a recipe: every step succeeds, and every expectation holds."""

    def runtest(self) -> None:
        """Runs the recipe."""
        from meshwright import Recipe

        Recipe.load(self.path).run(keep_outputs=False)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The diagnostics of the recipe."""
        from meshwright import Error

        if isinstance(excinfo.value, Error):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """The recipe."""
        return self.path, 0, f"recipe {self.name}"
