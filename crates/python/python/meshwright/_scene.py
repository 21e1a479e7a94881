"""Scenes."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from . import _core, _ron, _schema
from ._history import History
from ._mesh import Mesh
from ._operations import SceneOperations
from ._progress import Progress, callback
from .errors import Error, of_method, warn

if TYPE_CHECKING:
    from ._recipe import Recipe

EXTENSIONS = (".obj", ".gltf", ".glb", ".ply", ".stl", ".off", ".dae", ".mws", ".bez", ".bzc")


class Scene(SceneOperations, Mapping[str, Mesh]):
    """Named objects, in order, and the nodes that place them. A scene never changes: operations return new scenes.

    A scene is a mapping from names to meshes:

    >>> import meshwright as mw
    >>> scene = mw.Scene().cube(name="box").torus(name="ring")
    >>> list(scene)
    ['box', 'ring']
    >>> scene["box"].n_faces
    6
    """

    def __init__(
        self, core: _core.Scene | None = None, notes: tuple[str, ...] = (), history: History | None = None
    ) -> None:
        self._core = core if core is not None else _core.Scene()
        self._notes = notes
        self._history = history or History()

    # ---- Objects

    def __getitem__(self, name: str) -> Mesh:
        if name not in self._core.names():
            known = ", ".join(f'"{n}"' for n in self) or "none"
            raise KeyError(f'no object is named "{name}"; objects: {known}')
        if self._core.kind(name) != "mesh":
            raise TypeError(f'the type of "{name}" is {self._core.kind(name)}, expected mesh; tessellate() makes meshes of patches')
        return Mesh(self._core.only([name]), name, self._notes, self._history.only(self._core, [name]))

    def __iter__(self) -> Iterator[str]:
        return iter(self._core.names())

    def __len__(self) -> int:
        return len(self._core.names())

    def mesh(self, name: str | None = None) -> Mesh:
        """Returns the only mesh of the scene, or the mesh with this name. If there are several meshes or none, raises a
        `ValueError` that lists their names."""
        if name is not None:
            return self[name]
        meshes = [n for n in self if self.kind(n) == "mesh"]
        if len(meshes) == 1:
            return self[meshes[0]]
        if not meshes:
            others = ", ".join(f'"{n}" ({self.kind(n)})' for n in self) or "no objects"
            raise ValueError(f"the scene has no mesh: {others}")
        listed = ", ".join(f'"{n}"' for n in meshes)
        raise ValueError(f"the scene has {len(meshes)} meshes, expected one: {listed}; use scene[name] or join()")

    def kind(self, name: str) -> str:
        """The kind of an object: mesh, patches, curve or polylines."""
        return self._core.kind(name)

    def with_object(self, mesh: Mesh, *, name: str | None = None) -> Self:
        """Returns the scene with a mesh as an additional object. The name of the object is `name` or, if `name` is
        omitted, the name of the mesh."""
        if self._history.is_empty and name in (None, mesh.name):
            history = mesh._history
        else:
            history = self._history.lost("repeat `with_object()`", "Make all objects in one scene.")
        return type(self)(self._core.joined(mesh._scene, {mesh.name: name or mesh.name}), self._notes, history)

    def only(self, *names: str) -> Self:
        """Returns the scene with only these objects."""
        for name in names:
            self._core.kind(name)
        return type(self)(self._core.only(list(names)), self._notes, self._history.only(self._core, names))

    def placed(self) -> Self:
        """Returns the scene without nodes: the placements of the nodes are applied to the points of the objects. An
        object that several nodes show becomes several objects."""
        history = self._history.lost("repeat `placed()`", 'Read the file with placements="Bake".')
        return type(self)(self._core.placed(), self._notes, history)

    @property
    def notes(self) -> tuple[str, ...]:
        """The report of the last operation: repairs, losses and other facts, one line each. :meth:`with_object`,
        :meth:`only` and :meth:`placed` keep the notes."""
        return self._notes

    @cached_property
    def digest(self) -> str:
        """The digest of the scene. It is equal for equal scenes on every machine, and the program prints the same
        digest."""
        return self._core.digest()

    # ---- Operations

    def apply(
        self,
        operation: str,
        /,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
        budget: int | None = None,
        **parameters: Any,
    ) -> Self:
        """Runs an operation by its name in recipes: ``scene.apply("Weld", distance=1e-6)`` is
        ``scene.weld(distance=1e-6)``.

        :param operation: The name of the operation.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects that it supports.
        :param id: A text that seeds the random choices of the operation. Defaults to the name of the operation. In a
            recipe, this text is also the id of the step.
        :param progress: A callable that receives the operation, the task, the number of finished parts and the total number of
            parts; or `True` for a bar of tqdm. An exception cancels the operation. For a recipe, see
            :meth:`Recipe.run`.
        :param budget: The memory budget for meshes, in bytes. Defaults to 8 GiB.
        """
        return self._run(operation, parameters, on, id, progress=progress, budget=budget)[0]

    def _apply(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        progress: bool | Progress | None = None,
    ) -> Self:
        path = fields.get("path")
        if operation not in WRITES or not isinstance(path, str | os.PathLike):
            return self._run(operation, fields, on, id, progress=progress)[0]
        text = os.fspath(path)
        if is_address(text):
            name = f"file.{extension_of(text)}"
            done, written = self._run(operation, {**fields, "path": name}, on, id, files={}, progress=progress)
            if len(written) != 1:
                raise ValueError(f"{text} would be several files ({', '.join(written)}): choose .glb or another format that needs only one file")
            write_bytes(text, written[name])
            return done
        file = Path(text)
        here = {**fields, "path": file.name}
        return self._run(operation, here, on, id, output=str(file.parent), progress=progress)[0]

    def _run(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        *,
        output: str = "",
        files: dict[str, bytes] | None = None,
        progress: bool | Progress | None = None,
        budget: int | None = None,
    ) -> tuple[Self, dict[str, bytes]]:
        if operation not in _schema.operations():
            raise AttributeError(f"no operation is named {operation}")
        step = whole_step(operation, fields, on, id)
        text = f"(recipe: 1, steps: [\n{step}\n])"
        try:
            with callback(progress) as show:
                core, about = self._core.run(text, "", output, files, budget, show)
        except Error as error:
            raise of_method(error, operation) from None
        reports = [json.loads(report) for report in about["reports"]]
        if operation == "Save":
            warn_of_losses(os.fspath(fields["path"]), reports)
        notes = [line for report in reports for line in lines_of(report)]
        notes += [warning["message"] for warning in about["warnings"]]
        history = self._history
        if operation not in WRITES:
            history = history.then(step) if files is None else history.lost("read bytes, an address or a pickled object")
        return type(self)(core, tuple(notes), history), about["written"]

    def recipe(self) -> Recipe:
        """Returns the recipe of the steps that made the scene. A run of the recipe gives a scene with the same
        :attr:`digest`. See :meth:`Mesh.recipe`.

        >>> import meshwright as mw
        >>> scene = mw.Scene().cube(name="box").torus(name="ring").weld(distance=1e-6, on="ring")
        >>> scene.recipe().run().digest == scene.digest
        True

        :raises ValueError: If no recipe can repeat one of the changes. The text names the change.
        """
        from ._recipe import Recipe

        return Recipe._of(self._history.steps())

    # ---- Files

    def to_bytes(self, extension: str, **options: Any) -> bytes:
        """Returns the content of a file of this format, such as ``"glb"``. If the format cannot store some of the data,
        a :class:`meshwright.LossWarning` lists them.

        :param extension: The extension of the format.
        :param options: The other parameters of :meth:`save`.
        """
        name = f"scene.{extension.lstrip('.')}"
        written = self._run("Save", {"path": name, **options}, None, None, files={})[1]
        return written[name]

    def render(self, **options: Any) -> bytes:
        """Draws the scene and returns the bytes of a PNG file. The options are the parameters of :meth:`picture`.

        >>> import meshwright as mw
        >>> mw.Scene().cube(name="box").render(size=(64, 48))[:4]
        b'\\x89PNG'
        """
        return self._run("Picture", {"path": "picture.png", **options}, None, None, files={})[1]["picture.png"]

    def _repr_png_(self) -> bytes | None:
        return self.render(size=(640, 480)) if len(self) else None

    # ---- Python

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_unpickle, (self.to_bytes("mws"),))

    def __repr__(self) -> str:
        parts = [repr(self[n]) if self.kind(n) == "mesh" else f'"{n}": {self.kind(n)}' for n in self]
        return f"Scene({', '.join(parts)})"


#: The operations that write a file. The parameter `path` is the path of this file.
WRITES = {"Save", "Picture", "CurveFigure", "HalfEdgeFigure", "UvPicture"}


def whole_step(operation: str, fields: Mapping[str, Any], on: str | Sequence[str] | None, id: str | None) -> str:
    """Writes a step of a recipe, with the fields `id` and `on` if they are given."""
    step = _ron.step(operation, fields)
    if on is None and id is None:
        return step
    envelope = []
    if id is not None:
        envelope.append(f"id: {_ron.quoted(id)}")
    envelope.append(f"run: {step}")
    if on is not None:
        names = [on] if isinstance(on, str) else list(on)
        envelope.append(f"on: [{', '.join(map(_ron.quoted, names))}]")
    return f"({', '.join(envelope)})"


def lines_of(report: Mapping[str, Any]) -> Iterator[str]:
    """Converts the report of a step to lines of text."""
    for refused in report["refused"]:
        yield f"{refused['count']} refused: {refused['first']}"
    yield from map(line_of_loss, report["losses"])
    for change in report["changes"]:
        yield change["message"]
    yield from report["notes"]


def line_of_loss(loss: Mapping[str, str]) -> str:
    """Describes a loss of data in one line of text."""
    object = f'"{loss["object"]}"' if loss["object"] else "the scene"
    return f"{object} lost {loss['what']}: {loss['reason']}" if loss["reason"] else loss["what"]


def warn_of_losses(path: str, reports: Sequence[Mapping[str, Any]]) -> None:
    """Issues one warning that lists the data that a saved file lacks. Rounded positions are not listed."""
    losses = [loss for report in reports for loss in report["losses"] if loss["name"] != "position"]
    if losses:
        warn(f"{path}: {'; '.join(map(line_of_loss, losses))}. An .mws file stores everything; see help(meshwright.LossWarning)")


def is_address(path: str) -> bool:
    """Whether a path is an address such as ``s3://bucket/a.obj``."""
    return "://" in path


def extension_of(path: str) -> str:
    """Returns the extension of a file name. If the name ends in `.gz`, the extension before it is included:
    `obj.gz`."""
    name = path.rsplit("/", 1)[-1]
    stem, _, extension = name.rpartition(".")
    if extension == "gz":
        return f"{stem.rpartition('.')[2]}.gz"
    return extension


def fsspec() -> Any:
    """Imports the package fsspec. If it is missing, the error says how to install it."""
    try:
        import fsspec
    except ImportError as error:
        raise ImportError("addresses such as s3:// need fsspec: pip install fsspec") from error
    return fsspec


def write_bytes(address: str, data: bytes) -> None:
    """Writes a file at an address."""
    # Missing folders are created only for addresses of local files, because object stores such as S3 have no folders.
    options = {"auto_mkdir": True} if address.startswith("file:") else {}
    with fsspec().open(address, "wb", **options) as file:
        file.write(data)


def read(path: str | os.PathLike[str], **options: Any) -> Scene:
    """Reads a file as a scene. `scene.mesh()` is its only mesh. `scene.notes` lists the repairs, and the content that
    was left out.

    :param path: The file: .obj, .gltf, .glb, .ply, .stl, .off, .dae, .mws, .bez or .bzc. Addresses such as `s3://`
        need fsspec, and a file at an address must not refer to other files.
    :param options: The other parameters of :meth:`Scene.load`, such as `non_manifold`.
    """
    text = os.fspath(path)
    if is_address(text):
        with fsspec().open(text, "rb") as file:
            data = file.read()
        return read_bytes(data, text.rsplit("/", 1)[-1], **options)
    return Scene()._run("Load", {"path": text, **options}, None, None)[0]


def read_bytes(data: bytes, name: str, **options: Any) -> Scene:
    """Reads the content of a file as a scene.

    >>> import meshwright as mw
    >>> mw.read_bytes(b"v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n", "a.obj").mesh().n_faces
    1

    :param data: The content.
    :param name: The name of the file, whose extension gives the format.
    :param options: The other parameters of :meth:`Scene.load`.
    """
    return Scene()._run("Load", {"path": name, **options}, None, None, files={name: bytes(data)})[0]


def _unpickle(data: bytes) -> Scene:
    return read_bytes(data, "scene.mws")


def _unpickle_mesh(data: bytes, name: str) -> Mesh:
    return read_bytes(data, "scene.mws")[name]
