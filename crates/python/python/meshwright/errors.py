"""The exceptions and the warning of the package. The package exports them, too: `meshwright.RecipeError`."""

from __future__ import annotations

import re
import sys
import warnings
from dataclasses import dataclass, replace
from typing import Any

__all__ = ["EditError", "Error", "LossWarning", "Problem", "RecipeError"]


@dataclass(frozen=True)
class Problem:
    """An error or a warning about a recipe or a step.

    >>> import meshwright as mw
    >>> try:
    ...     mw.Scene().cube(name="a").loop_subdivide(levels=99)
    ... except mw.RecipeError as error:
    ...     print(error.problems[0].message, error.problems[0].help, sep=": ")
    `levels` is 99, expected at most 16: allowed: 0 to 16
    """

    #: ``"error"`` or ``"warning"``.
    severity: str
    #: What is wrong.
    message: str
    #: How to correct the problem, if this is known.
    help: str | None
    #: The file of the recipe, or ``"step"`` if a method runs a single step.
    file: str | None
    #: The line, counted from 1.
    line: int | None
    #: The column in characters, counted from 1.
    column: int | None


class Error(Exception):
    """The base class of the errors of this package."""


class RecipeError(Error):
    """A recipe or an operation cannot run, or has failed. For a recipe, the text of the error shows the lines of the
    recipe that have problems."""

    #: All errors and warnings, in the order of the text.
    problems: tuple[Problem, ...]

    def __init__(self, text: str, problems: list[dict[str, Any]] | tuple[Problem, ...] = ()) -> None:
        super().__init__(text)
        made = (p if isinstance(p, Problem) else Problem(**p) for p in problems)
        self.problems = tuple(made)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.problems))


class EditError(Error):
    """An edit was refused. The mesh is unchanged."""

    #: The name of the reason, such as ``"Boundary"``.
    reason: str
    #: The elements that the message names, such as ``"e12"`` for edge 12.
    elements: tuple[str, ...]

    def __init__(self, text: str, reason: str = "", elements: list[str] | tuple[str, ...] = ()) -> None:
        super().__init__(text)
        self.reason = reason
        self.elements = tuple(elements)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.reason, self.elements))


class LossWarning(UserWarning):
    """A saved file lacks some of the data, because its format cannot store them. The text lists this data.

    An ``.mws`` file stores everything. If the losses do not matter,
    ``warnings.simplefilter("ignore", mw.LossWarning)`` hides the warnings. With ``"error"`` in place of ``"ignore"``,
    they become exceptions. In both cases, the file is written.
    """


def warn(message: str) -> None:
    """Issues a `LossWarning` that shows the line of the user's code that called the package."""
    frame, level = sys._getframe().f_back, 2
    while frame and str(frame.f_globals.get("__name__", "")).startswith("meshwright."):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, LossWarning, stacklevel=level)


def of_method(error: Error, operation: str) -> Error:
    """Converts an error of a step to an error of the method that runs `operation`. The text uses Python names, and
    shows no lines of a recipe."""
    from ._names import code_in_python, snake, without_steps

    def text(recipe: str) -> str:
        recipe = re.sub(rf"^{operation}(?= )", f"{snake(operation)}()", recipe)
        selections = "`help(meshwright.sel)` lists all selections, such as `sel.Tagged(..)` for a tag"
        python = without_steps(code_in_python(recipe))
        return python.replace("`meshwright ops --selections` lists all selections", selections)

    if not isinstance(error, RecipeError):
        return type(error)(text(str(error)))
    problems = [replace(p, message=text(p.message), help=p.help and text(p.help)) for p in error.problems]
    lines = [p.message + (f"; {p.help}" if p.help else "") for p in problems]
    return RecipeError("\n".join(lines) or str(error), tuple(problems))
