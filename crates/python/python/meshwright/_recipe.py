"""Recipes."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Self, overload

from . import _core, _ron, _schema
from ._history import History
from ._mesh import Mesh
from ._operations import SceneOperations
from ._progress import Progress, callback, numbers
from ._ron import Arg, Choice, Ron
from ._scene import Scene, lines_of, whole_step
from .errors import Problem


@dataclass(frozen=True)
class Step:
    """A step that a run has executed."""

    #: The label of the step: its id, or the name of the operation.
    name: str
    #: The number of vertices of all meshes after the step.
    vertices: int
    #: The number of edges.
    edges: int
    #: The number of faces.
    faces: int
    #: How long the step took.
    seconds: float
    #: The report of the step: refusals, losses and other facts, one line each.
    notes: tuple[str, ...]


class Outcome(Mapping[str, Mesh]):
    """The outcome of a run. Like a scene, it is a mapping from the names of objects to meshes.

    Its attributes are the final `scene`, the `digest` of this scene, the `steps` with their notes and times, the paths
    of the written `files`, and the number `checked` of expectations, which all hold.
    """

    def __init__(self, scene: Scene, about: dict[str, Any]) -> None:
        #: The scene at the end.
        self.scene = scene
        #: The digest of the scene. The program prints the same digest.
        self.digest: str = about["digest"]
        #: The steps.
        self.steps: tuple[Step, ...] = tuple(
            Step(notes=tuple(lines_of(json.loads(s.pop("report")))), **s) for s in about["steps"]
        )
        #: The files that were written.
        self.files: tuple[str, ...] = tuple(about["files"])
        #: The number of expectations, which all hold.
        self.checked: int = about["checked"]

    def mesh(self, name: str | None = None) -> Mesh:
        """Returns the only mesh, or the mesh with this name."""
        return self.scene.mesh(name)

    def __getitem__(self, name: str) -> Mesh:
        return self.scene[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.scene)

    def __len__(self) -> int:
        return len(self.scene)

    def __repr__(self) -> str:
        return f"Outcome({self.scene!r}, {len(self.steps)} steps, digest {self.digest})"


@dataclass(frozen=True)
class Parameter:
    """A parameter of a recipe."""

    #: The name.
    name: str
    #: Int, Float, Bool, Text, Path, Choice or Vector.
    type: str
    #: The value as text.
    value: str
    #: The description.
    doc: str | None


class _Load:
    """The attribute `load`. On the class, `Recipe.load(path)` loads a recipe from its file. On a recipe, `load` returns
    the recipe with an additional step, which loads a model."""

    @overload
    def __get__(self, recipe: None, kind: type[Recipe]) -> Callable[[str | os.PathLike[str]], Recipe]: ...
    @overload
    def __get__(self, recipe: Recipe, kind: type[Recipe]) -> Callable[..., Recipe]: ...
    def __get__(self, recipe: Recipe | None, kind: type[Recipe]) -> Callable[..., Recipe]:
        if recipe is None:
            return load_recipe
        return partial(SceneOperations.load, recipe)


class Recipe(SceneOperations):
    """A recipe: loaded from a file, or built step by step. A recipe never changes: each method returns a new one.

    >>> import meshwright as mw
    >>> r = mw.recipe().octahedron(name="gem").loop_subdivide(levels=mw.arg("levels", int, default=1))
    >>> print(r.to_ron())
    (
        recipe: 1,
        params: {
            "levels": Int(default: 1),
        },
        steps: [
            Octahedron(name: "gem"),
            LoopSubdivide(levels: arg("levels")),
        ],
    )
    >>> r.triangulate().check()
    ()
    """

    def __init__(self, text: str | None = None, *, path: str | os.PathLike[str] = "recipe.ron") -> None:
        """Creates a recipe from its text, or an empty recipe.

        :param text: The text.
        :param path: The path of the recipe file. Messages contain this path. Relative paths in the text start at the
            folder of this file. The file is not read.
        """
        self._text = text
        self._path = os.fspath(path)
        self._steps: tuple[str, ...] = ()
        self._args: dict[str, str] = {}
        self._expect: tuple[str, ...] = ()
        self._about: str | None = None

    load = _Load()

    @classmethod
    def _of(cls, steps: tuple[str, ...]) -> Self:
        made = cls()
        made._steps = steps
        return made

    def _copy(self) -> Self:
        if self._text is not None:
            raise TypeError("a recipe that was loaded from a text cannot be extended; build one with recipe()")
        made = type(self)(path=self._path)
        made._steps, made._args = self._steps, dict(self._args)
        made._expect, made._about = self._expect, self._about
        return made

    def _apply(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        progress: bool | Progress | None = None,
    ) -> Self:
        if progress:
            raise TypeError("a step of a recipe does not run yet: pass progress= to run()")
        made = self._copy()
        for value in fields.values():
            for arg in _ron.arguments(value):
                made._declare(arg)
        made._steps = (*self._steps, whole_step(operation, fields, on, id))
        return made

    def _declare(self, arg: Arg) -> None:
        if arg.declaration:
            known = self._args.setdefault(arg.name, arg.declaration)
            if known != arg.declaration:
                raise ValueError(f'the parameter "{arg.name}" is declared twice: {known} and {arg.declaration}')

    def step(self, operation: str, /, *, on: str | Sequence[str] | None = None, id: str | None = None, **parameters: Any) -> Self:
        """Returns the recipe with an additional step. `operation` is the name of the operation in recipes, such as
        ``LoopSubdivide``."""
        return self._apply(operation, parameters, on, id)

    def expect(
        self,
        *expectations: str | Choice | Ron,
        after: str | None = None,
        on: str | Sequence[str] | None = None,
    ) -> Self:
        """Returns the recipe with additional expectations: words such as ``"Manifold"``, or values of
        :mod:`meshwright.expect`.

        :param after: The id of the step after which the expectations must hold. If omitted, they must hold at the end.
        :param on: The names of the objects to which the expectations apply. If omitted, they apply to all objects.
        """
        made = self._copy()
        schema = _schema.definition("Expectation")
        each = [_ron.write(e, schema) for e in expectations]
        if after is not None or on is not None:
            names = [on] if isinstance(on, str) else on
            fields = [f"after: {_ron.quoted(after)}"] if after is not None else []
            fields += [f"on: [{', '.join(map(_ron.quoted, names))}]"] if names is not None else []
            each = [f"({', '.join(fields)}, that: [{', '.join(each)}])"]
        made._expect = (*self._expect, *each)
        return made

    def about(self, text: str) -> Self:
        """Returns the recipe with another description."""
        made = self._copy()
        made._about = text
        return made

    def to_ron(self) -> str:
        """Returns the text of the recipe. The program `meshwright` can run a file with this text."""
        if self._text is not None:
            return self._text
        lines = ["(", "    recipe: 1,"]
        if self._about is not None:
            lines.append(f"    about: {_ron.quoted(self._about)},")
        if self._args:
            lines.append("    params: {")
            lines += [f"        {_ron.quoted(name)}: {declaration}," for name, declaration in self._args.items()]
            lines.append("    },")
        lines.append("    steps: [")
        lines += [f"        {step}," for step in self._steps]
        lines.append("    ],")
        if self._expect:
            lines.append(f"    expect: [{', '.join(self._expect)}],")
        return "\n".join([*lines, ")"])

    __str__ = to_ron

    def __repr__(self) -> str:
        return f"Recipe({self._path!r}, {len(self._core().steps())} steps)"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Recipe) and (self._path, self.to_ron()) == (other._path, other.to_ron())

    def __hash__(self) -> int:
        return hash((self._path, self.to_ron()))

    def _core(
        self,
        values: Mapping[str, Any] | None = None,
        preset: str | None = None,
        out: str | os.PathLike[str] = "out",
        budget: int | None = None,
    ) -> _core.Recipe:
        return _core.Recipe(self.to_ron(), self._path, numbers(dict(values or {})), preset, os.fspath(out), budget)

    @property
    def path(self) -> str:
        """The path of the recipe file."""
        return self._path

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters with their defaults."""
        return tuple(Parameter(*p) for p in self._core().parameters())

    def problems(
        self,
        values: Mapping[str, Any] | None = None,
        /,
        *,
        preset: str | None = None,
        out: str | os.PathLike[str] = "out",
        budget: int | None = None,
        **more: Any,
    ) -> tuple[Problem, ...]:
        """Returns all errors and warnings, without running a step. Takes the parameters of :meth:`check`."""
        return tuple(Problem(**p) for p in self._core({**(values or {}), **more}, preset, out, budget).problems())

    def check(
        self,
        values: Mapping[str, Any] | None = None,
        /,
        *,
        preset: str | None = None,
        out: str | os.PathLike[str] = "out",
        budget: int | None = None,
        **more: Any,
    ) -> tuple[Problem, ...]:
        """Checks types, ranges, files and memory of the recipe without running a step. Returns the warnings.

        >>> import meshwright as mw
        >>> r = mw.recipe().icosahedron().loop_subdivide(levels=mw.arg("levels", int, default=1))
        >>> r.check(levels=2), r.check({"levels": 2})
        ((), ())

        :param preset: The name of a preset of the recipe.
        :param out: The output folder, as for :meth:`run`.
        :param budget: The memory budget for meshes, in bytes. Defaults to 8 GiB.
        :param values: Values of the parameters of the recipe. A parameter named `out` can only be given here.
        :param more: More values: ``check(levels=3)``.
        :raises RecipeError: All errors at once, with lines and columns.
        """
        core = self._core({**(values or {}), **more}, preset, out, budget)
        core.check()
        return tuple(Problem(**p) for p in core.problems())

    def run(
        self,
        values: Mapping[str, Any] | None = None,
        /,
        *,
        preset: str | None = None,
        out: str | os.PathLike[str] = "out",
        keep_outputs: bool = True,
        progress: bool | Progress | None = None,
        budget: int | None = None,
        **more: Any,
    ) -> Outcome:
        """Checks and runs the recipe. Ctrl-C cancels. Files are written only if every step succeeds and every expectation
        holds. Their paths are relative to the folder `out`. Paths of input files are relative to the folder of the
        recipe; for a recipe that was built in Python, to the working directory.

        >>> import meshwright as mw
        >>> out = mw.recipe().cube(name="box").triangulate().run()
        >>> out.mesh().n_faces, out.steps[1].name
        (12, 'Triangulate')

        :param preset: The name of a preset of the recipe.
        :param out: The output folder, which is created if necessary. It is relative to the working directory, and
            defaults to the folder ``out`` there: ``save("a.glb")`` writes ``out/a.glb``.
        :param keep_outputs: Whether the files that the steps write are kept after the run.
        :param progress: A callable that receives the step, the task, the number of finished parts and the total number of parts; or
            `True` for a bar of tqdm. An exception cancels the run.
        :param budget: The memory budget for meshes, in bytes. Defaults to 8 GiB.
        :param values: Values of the parameters of the recipe. A relative path is relative to the working directory.
        :param more: More values: ``run(levels=3)``.
        :raises RecipeError: If the recipe has errors, a step fails, or an expectation does not hold.
        """
        core = self._core({**(values or {}), **more}, preset, out, budget)
        with callback(progress) as show:
            scene, about = core.run(keep_outputs, show)
        assert scene is not None
        history = History().lost("begin with the result of a recipe", "Add further steps to that recipe.")
        return Outcome(Scene(scene, (), history), about)

    def save_recipe(self, path: str | os.PathLike[str]) -> None:
        """Writes the text of the recipe to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_ron() + "\n")


def recipe() -> Recipe:
    """Returns an empty recipe. Each method for an operation returns a recipe with one more step.

    >>> import meshwright as mw
    >>> mw.recipe().load("a.obj").simplify(faces=5000).save("a.glb").to_ron().splitlines()[3]
    '        Load(path: "a.obj"),'
    """
    return Recipe()


def load_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Loads a recipe from its file."""
    with open(path, encoding="utf-8") as file:
        return Recipe(file.read(), path=path)


def run(path: str | os.PathLike[str], **options: Any) -> Outcome:
    """Loads and runs a recipe. See :meth:`Recipe.run`."""
    return load_recipe(path).run(**options)


KINDS = {int: "Int", float: "Float", bool: "Bool", str: "Text", os.PathLike: "Path"}


def arg(name: str, kind: type | None = None, *, default: Any = None, min: float | None = None, max: float | None = None, doc: str | None = None) -> Arg:
    """A parameter of a recipe, in place of a value: ``loop_subdivide(levels=arg("levels", int, default=2))``.

    :param name: The name.
    :param kind: int, float, bool, str, or `os.PathLike` for the path of an input file. If omitted, the type of the
        default; a list or tuple of three numbers is a vector. If `kind` and `default` are both omitted, another
        `arg(..)` of this name in the recipe must give them.
    :param default: The default value.
    :param min: The minimum value.
    :param max: The maximum value.
    :param doc: The description.
    """
    if kind is None and default is None:
        return Arg(name, "")
    if default is None:
        raise ValueError(f'the parameter "{name}" needs a default')
    if kind is None:
        kind = type(default)
    word = "Vector" if kind in (tuple, list) else KINDS.get(kind) or ("Path" if hasattr(default, "__fspath__") else None)
    if word is None:
        raise TypeError(f"parameters cannot have the type {kind.__name__}")
    if word == "Float":
        default = float(default)
    if word == "Vector":
        default = tuple(default)
    fields = {"default": default, "min": min, "max": max, "doc": doc}
    given = [f"{n}: {_ron.write(v, {})}" for n, v in fields.items() if v is not None]
    return Arg(name, f"{word}({', '.join(given)})")
