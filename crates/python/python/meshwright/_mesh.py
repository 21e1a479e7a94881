"""Meshes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Sized
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _ron
from ._arrays import frozen, indices, numeric, points, view
from ._convert import MeshConversions
from ._history import History
from ._names import snake
from ._operations import MeshOperations
from ._progress import Progress
from ._ron import Choice, Ron
from .errors import Error, of_method

if TYPE_CHECKING:
    from ._editor import Editor
    from ._recipe import Recipe
    from ._scene import Scene
    from ._view import View

Domain = Literal["vertex", "corner", "edge", "face"]
Rule = Literal["interpolate", "normal", "copy", "drop"]
DOMAINS: tuple[Domain, ...] = ("vertex", "corner", "edge", "face")


class HalfEdges(NamedTuple):
    """The connectivity of a mesh, as read-only arrays of `uint32` without a copy.

    The two halves of edge ``e`` are the half-edges ``2 * e`` and ``2 * e + 1``. For a half-edge ``h``, the other half
    is ``h ^ 1``, and the edge is ``h >> 1``. 4294967295 stands for a missing face or half-edge.
    """

    #: For each half-edge, the next half-edge around its face. On the boundary, the next half-edge around the hole.
    next: NDArray[np.uint32]
    #: For each half-edge, the vertex at which it starts.
    origin: NDArray[np.uint32]
    #: For each half-edge, its face, or 4294967295 if the half-edge is on the boundary.
    face: NDArray[np.uint32]
    #: For each vertex, a half-edge that starts at the vertex. At a boundary vertex, this is a boundary half-edge.
    of_vertex: NDArray[np.uint32]
    #: For each face, one of its half-edges.
    of_face: NDArray[np.uint32]


class OneSided(NamedTuple):
    """The distances from the points of one surface to another surface, in scene units."""

    #: The largest distance that was found. It is exact or too low.
    largest: float
    #: An upper bound of the distances of all points.
    at_most: float
    #: The mean distance over the area of the surface, computed from samples.
    mean: float


class Distance(NamedTuple):
    """The distances between two surfaces, in scene units. See :meth:`Mesh.distance_to`."""

    #: From the points of the first surface to the second.
    forth: OneSided
    #: From the points of the second surface to the first.
    back: OneSided

    @property
    def largest(self) -> float:
        """The Hausdorff distance: the larger of the two largest distances. If it is not exact, it is too low."""
        return max(self.forth.largest, self.back.largest)

    @property
    def at_most(self) -> float:
        """An upper bound of the Hausdorff distance."""
        return max(self.forth.at_most, self.back.at_most)

    @property
    def mean(self) -> float:
        """The larger of the two mean distances."""
        return max(self.forth.mean, self.back.mean)


class Attributes(Mapping[str, NDArray[Any]]):
    """The attributes of a mesh by name, as read-only arrays: one row for each vertex, corner, edge or face.

    If several domains have an attribute named "uv", ``attributes["uv"]`` is the first of them, in the order vertices,
    corners, edges, faces. ``attributes["corner", "uv"]`` names the domain.
    """

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        self._kinds = {(domain, name): (kind, rule) for domain, name, kind, rule in mesh._core.attributes()}
        self._values: dict[tuple[str, str], NDArray[Any]] = {}

    def domain(self, name: str) -> Domain:
        """The domain of an attribute: vertex, corner, edge or face."""
        for domain in DOMAINS:
            if (domain, name) in self._kinds:
                return domain
        known = ", ".join(f'"{n}"' for n in self) or "none"
        raise KeyError(f'no attribute is named "{name}"; attributes: {known}')

    def rule(self, name: str, domain: Domain | None = None) -> Rule:
        """The rule by which edits change the values of an attribute: interpolate, normal, copy or drop."""
        rule: Any = self._kinds[domain or self.domain(name), name][1]
        return rule  # type: ignore[no-any-return]

    def __getitem__(self, key: str | tuple[Domain, str]) -> NDArray[Any]:
        domain, name = key if isinstance(key, tuple) else (self.domain(key), key)
        if (domain, name) not in self._kinds:
            raise KeyError(f'no {domain} attribute is named "{name}"')
        if (domain, name) not in self._values:
            self._values[domain, name] = view(self._mesh._core.attribute(domain, name))
        return self._values[domain, name]

    def __contains__(self, key: object) -> bool:
        return key in self._kinds or any(name == key for _, name in self._kinds)

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(name for _, name in self._kinds))

    def __len__(self) -> int:
        return len({name for _, name in self._kinds})

    def items_by_domain(self) -> Iterator[tuple[Domain, str, NDArray[Any]]]:
        """The domain, the name and the values of every attribute."""
        for domain, name in self._kinds:
            yield domain, name, self[domain, name]  # type: ignore[misc, index]

    def __repr__(self) -> str:
        lines = (f"{domain} {name}: {kind}" for (domain, name), (kind, _) in self._kinds.items())
        return f"Attributes({', '.join(lines)})"


class Mesh(MeshConversions, MeshOperations):
    """A mesh of polygons, with attributes and materials. A mesh never changes: operations return new meshes.

    Read one with :func:`meshwright.read`, or build one with :meth:`from_arrays`:

    >>> import meshwright as mw
    >>> m = mw.Mesh.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> m
    Mesh("mesh": 3 vertices, 3 edges, 1 face)
    >>> m.loop_subdivide(levels=2).n_faces
    16

    Every operation on one mesh is a method, such as :meth:`smooth`. Many methods have some of these parameters:

    - a selection, such as the parameter `faces`, is a word such as ``"Boundary"``, or a value of :mod:`meshwright.sel`;
    - `id` is any text. A different text gives different random choices, for example of ``sel.Random``. Defaults to the
      name of the operation;
    - `progress` is `True` for a bar of tqdm, or a callable. It is called with the operation, the task, the number of
      finished parts and the total number of parts. If it raises an exception, the operation is cancelled.

    The report of an operation is in the :attr:`notes` of its result.
    """

    def __init__(self, scene: _core.Scene, name: str, notes: tuple[str, ...], history: History) -> None:
        self._scene = scene
        self._name = name
        self._core = scene.mesh(name)
        self._notes = notes
        self._history = history

    @classmethod
    def from_arrays(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike | Sequence[ArrayLike],
        *,
        face_starts: ArrayLike | None = None,
        name: str = "mesh",
        repair: bool = True,
    ) -> Self:
        """Builds a mesh from points and polygons.

        >>> import meshwright as mw
        >>> mw.Mesh.from_arrays([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]).n_edges
        4

        :param vertices: The points, of shape (n, 3).
        :param faces: The vertices of each face, counter-clockwise: an array of shape (k, d), a list of lists of any
            lengths, or, with `face_starts`, the corners of all faces one after another.
        :param face_starts: The index of the first corner of each face in `faces`, and the number of all corners as the
            last entry.
        :param name: The name of the object.
        :param repair: Whether the faces are repaired if they do not form a manifold. A repair reverses faces with
            inconsistent orientation, splits edges with more than two faces, and drops faces with fewer than three
            corners. `notes` lists the repairs. If false, a mesh that needs a repair raises `ValueError`.
        """
        return cls._built(vertices, faces, face_starts, name, repair)[0]

    @classmethod
    def _built(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike | Sequence[ArrayLike],
        face_starts: ArrayLike | None,
        name: str,
        repair: bool = True,
    ) -> tuple[Self, NDArray[np.uint32], NDArray[np.uint32]]:
        """Returns a mesh of points and polygons. Also returns two arrays: for each vertex, the index of its point, and
        for each face, the index of its polygon."""
        positions = points(vertices)
        starts, corners = polygons(faces, face_starts)
        core, repairs, point_of_vertex, polygon_of_face = _core.from_arrays(positions, starts, corners, repair)
        history = History().lost("make a mesh from arrays or from a mesh of another package")
        mesh = cls(_core.Scene().with_mesh(name, core), name, tuple(repairs), history)
        return mesh, view(point_of_vertex), view(polygon_of_face)

    # ---- Arrays

    @cached_property
    def vertices(self) -> NDArray[np.float64]:
        """The positions, of shape (n, 3), without a copy."""
        return view(self._core.array("positions"))

    @cached_property
    def _polygons(self) -> tuple[NDArray[np.uint32], NDArray[np.uint64]]:
        corners, starts = self._core.polygons()
        return view(corners), view(starts)

    @property
    def corners(self) -> NDArray[np.uint32]:
        """The vertex of each corner, face by face. The corners of face i are
        ``corners[face_starts[i]:face_starts[i + 1]]``."""
        return self._polygons[0]

    @property
    def face_starts(self) -> NDArray[np.uint64]:
        """The index in :attr:`corners` of the first corner of each face, and the number of corners as the last
        entry."""
        return self._polygons[1]

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """The vertices of the triangles, of shape (k, 3). Raises `ValueError` if a face is not a triangle."""
        corners, starts = self._polygons
        degrees = np.diff(starts)
        wrong = np.flatnonzero(degrees != 3)
        if len(wrong):
            raise ValueError(
                f"face {wrong[0]} has {degrees[wrong[0]]} corners; use triangulate() first, or corners and face_starts"
            )
        return corners.reshape(-1, 3)

    @property
    def faces(self) -> list[NDArray[np.uint32]]:
        """The vertices of each face. This property is slow for large meshes. The arrays :attr:`triangles` and
        :attr:`corners` are faster."""
        corners, starts = self._polygons
        return np.split(corners, starts[1:-1].astype(np.int64)) if len(starts) > 1 else []

    @cached_property
    def face_normals(self) -> NDArray[np.float64]:
        """The unit normals of the faces, of shape (n_faces, 3). The normal of a face without an area is zero.

        The normals of vertices are an attribute, which :meth:`vertex_normals` computes.

        >>> import meshwright as mw
        >>> mw.Scene().cube(name="box").mesh().face_normals[:2].tolist()
        [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]
        """
        corners, starts = self._polygons
        if not len(corners):
            return frozen(np.zeros((0, 3)))
        first = starts[:-1].astype(np.int64)
        points = self.vertices[corners]
        # The points of a face are taken relative to its first corner, because cross products lose digits far from the
        # origin.
        points -= np.repeat(points[first], np.diff(starts).astype(np.int64), axis=0)
        following = np.arange(1, len(corners) + 1)
        following[starts[1:].astype(np.int64) - 1] = first
        # The sum of the cross products of consecutive corners is twice the area vector of a face, even if the face is
        # not flat.
        areas = np.add.reduceat(np.cross(points, points[following]), first, axis=0)
        lengths = np.linalg.norm(areas, axis=1, keepdims=True)
        return frozen(np.divide(areas, lengths, out=np.zeros_like(areas), where=lengths > 0))

    @cached_property
    def half_edges(self) -> HalfEdges:
        """The connectivity."""
        parts = ("next", "origin", "face", "vertex_half_edge", "face_half_edge")
        return HalfEdges(*(view(self._core.array(part)) for part in parts))

    @cached_property
    def edges(self) -> NDArray[np.uint32]:
        """The two vertices of each edge, of shape (n, 2), without a copy."""
        return self.half_edges.origin.reshape(-1, 2)

    @cached_property
    def attributes(self) -> Attributes:
        """The attributes by name."""
        return Attributes(self)

    def attribute(self, name: str, domain: Domain | None = None) -> NDArray[Any]:
        """The values of an attribute."""
        return self.attributes[domain, name] if domain else self.attributes[name]

    def tag(self, domain: Domain, name: str) -> NDArray[np.bool_]:
        """The values of a tag, which is a named selection: for each element, whether the tag selects it."""
        values = self.attributes[domain, name]
        if values.dtype != np.bool_:
            raise TypeError(f'"{name}" is an attribute of type {values.dtype}, expected a tag')
        return values

    @property
    def tags(self) -> list[tuple[str, str]]:
        """The domain and the name of each tag."""
        return [(domain, name) for domain, name, kind, _ in self._core.attributes() if kind == "tag"]

    def select(self, selection: str | Choice | Ron, domain: Literal["vertex", "edge", "face"] | None = None) -> NDArray[np.uint32]:
        """Returns the ids of the vertices, edges or faces that a selection matches.

        >>> import meshwright as mw
        >>> from meshwright import sel
        >>> m = mw.Scene().cube(name="box").mesh()
        >>> edges = m.select(sel.Sharp(above=30))
        >>> m.edges[edges].shape
        (12, 2)
        >>> m.select("All", "face")
        array([0, 1, 2, 3, 4, 5], dtype=uint32)

        :param selection: A word such as ``"Boundary"``, or a value of :mod:`meshwright.sel`.
        :param domain: vertex, edge or face. Required only if the selection is valid for several of them.
        """
        kinds = [d for d in ("Vertex", "Edge", "Face") if domain in (None, d.lower())]
        schema = {"anyOf": [{"$ref": f"#/$defs/{kind}Selection"} for kind in kinds]}
        others: dict[int, tuple[str, Mesh]] = {}
        text = _ron.write(self._named(selection, others), schema)
        try:
            return view(self._with(others).select(self._name, text, domain))
        except Error as error:
            raise of_method(error, "select") from None

    def with_attribute(
        self, name: str, values: ArrayLike, domain: Domain | None = None, *, rule: Rule | None = None
    ) -> Self:
        """Returns the mesh with an attribute, in place of any attribute of the same domain and name.

        >>> import meshwright as mw, numpy as np
        >>> m = mw.Mesh.from_arrays(np.eye(3), [[0, 1, 2]]).with_attribute("heat", [0.0, 0.5, 1.0], "vertex")
        >>> m.attributes["heat"]
        array([0. , 0.5, 1. ])

        :param name: The name.
        :param values: One row for each element: numbers, rows of 2 to 4 numbers, whole numbers from -2^31 to 2^31 - 1,
            or flags, which make a tag.
        :param domain: vertex, corner, edge or face. If omitted, the only domain that has as many elements as there are
            values.
        :param rule: How edits compute the values of new elements. Defaults to "copy" for whole numbers and flags, and
            to "interpolate" for other values.
        """
        array = numeric(values, f"the values of {name!r}")
        if array.ndim not in (1, 2) or array.ndim == 2 and not 1 <= array.shape[1] <= 4:
            raise ValueError(f"the values of {name!r} have the shape {array.shape}, expected (n,) or (n, 1 to 4)")
        columns = 1 if array.ndim == 1 else array.shape[1]
        if array.dtype.kind == "b" and columns == 1:
            packed: NDArray[Any] = np.ascontiguousarray(array, np.uint8)
        elif array.dtype.kind in "iu" and columns == 1 and rule != "interpolate":
            if array.size and (int(array.min()) < -(2**31) or int(array.max()) >= 2**31):
                raise ValueError(f"the values of {name!r} do not fit into 32 bits")
            packed = np.ascontiguousarray(array, np.int32)
        else:
            packed = np.ascontiguousarray(array, np.float64)
        if domain is None:
            domain = self._domain_of(len(array), name)
        rule = rule or ("interpolate" if packed.dtype == np.float64 else "copy")
        core = self._core.with_attribute(domain, name, packed.reshape(-1), columns, rule)
        return self._with_core(core, "with_attribute()")

    def _domain_of(self, n: int, name: str) -> Domain:
        counts = dict(zip(DOMAINS, (self.n_vertices, len(self.corners), self.n_edges, self.n_faces), strict=True))
        fitting = [domain for domain in DOMAINS if counts[domain] == n]
        if len(fitting) != 1:
            listed = ", ".join(f"{count} for {domain}" for domain, count in counts.items())
            reason = "fits several domains" if fitting else "fits no domain"
            raise ValueError(f"{name!r} has {n} values, which {reason} ({listed}): pass domain=")
        return fitting[0]

    def without_attribute(self, name: str, domain: Domain | None = None) -> Self:
        """Returns the mesh without an attribute."""
        core = self._core.without_attribute(domain or self.attributes.domain(name), name)
        return self._with_core(core, "without_attribute()")

    def with_vertices(self, vertices: ArrayLike) -> Self:
        """Returns the mesh with other positions, of shape (n, 3). Normals are removed."""
        return self._with_core(self._core.with_positions(points(vertices)), "with_vertices()")

    # ---- Facts

    @property
    def name(self) -> str:
        """The name of the object."""
        return self._name

    @property
    def n_vertices(self) -> int:
        """The number of vertices."""
        return self._core.counts()[0]

    @property
    def n_edges(self) -> int:
        """The number of edges."""
        return self._core.counts()[1]

    @property
    def n_faces(self) -> int:
        """The number of faces."""
        return self._core.counts()[2]

    @property
    def materials(self) -> list[str]:
        """The names of the materials. The face attribute "material" contains indices into this list."""
        return self._scene.materials(self._name)

    @property
    def notes(self) -> tuple[str, ...]:
        """The report of the last operation or conversion: repairs, losses and other facts. :meth:`with_attribute`,
        :meth:`without_attribute`, :meth:`with_vertices` and :meth:`edit` keep the notes."""
        return self._notes

    @property
    def is_closed(self) -> bool:
        """Whether every edge has two faces, so that the mesh is watertight. Every mesh is a manifold: each edge has one
        or two faces, and two faces of an edge are oriented consistently."""
        return self._core.is_closed()

    @property
    def area(self) -> float:
        """The sum of the areas of all faces.

        >>> import meshwright as mw
        >>> box = mw.Scene().cube(name="box", size=2).mesh()
        >>> box.area, round(box.volume, 9), box.bounds.tolist()
        (24.0, 8.0, [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
        """
        return self._core.area()

    @property
    def volume(self) -> float:
        """The volume inside the mesh, which is negative if the faces are oriented inward. Raises `ValueError` if the mesh
        is not closed."""
        if not self.is_closed:
            raise ValueError("the mesh has a boundary, so it has no volume; fill_holes() closes holes")
        return self._core.volume()

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The minimum and the maximum of the coordinates, of shape (2, 3). Raises `ValueError` if the mesh has no
        vertices."""
        bounds = self._core.bounds()
        if bounds is None:
            raise ValueError("the mesh has no vertices, so it has no bounds")
        return np.array(bounds)

    @property
    def euler_characteristic(self) -> int:
        """The number of vertices minus edges plus faces."""
        return self._core.euler_characteristic()

    @property
    def n_bytes(self) -> int:
        """The memory of all arrays, in bytes."""
        return self._core.bytes()

    def distance_to(self, other: Mesh, *, tolerance: float | None = None) -> Distance:
        """Measures the distances between the surfaces of two meshes, in both directions and in scene units. The
        transforms of nodes that place the meshes in a scene are ignored; ``scene.placed()`` applies them.

        >>> import meshwright as mw
        >>> ball = mw.Scene().uv_sphere(name="ball").mesh()
        >>> distance = ball.distance_to(ball.transform(move=(0, 0, 0.5)))
        >>> round(distance.largest, 3), distance.forth.mean < 0.5
        (0.5, True)

        The expectation ``expect.DistanceTo(..)`` of a recipe holds if ``distance.at_most`` is below its limit.

        :param tolerance: The largest allowed difference between ``largest`` and ``at_most``, in scene units. Defaults
            to 0.00001 of the diagonal of the bounding box of both meshes. The search can stop before it reaches a very
            small tolerance.
        :raises ValueError: If one of the meshes has no faces.
        """
        if not isinstance(other, Mesh):
            raise TypeError(f"other is of the type {type(other).__name__}, expected Mesh")
        if tolerance is not None and not tolerance >= 0:
            raise ValueError(f"the tolerance is {tolerance}, expected at least 0")
        found = self._core.distance(other._core, tolerance)
        if found is None:
            raise ValueError("a distance needs two meshes with faces")
        forth, back = (OneSided(*numbers) for numbers in found)
        return Distance(forth, back)

    def defects(self) -> list[str]:
        """Describes each violated invariant of the mesh. The list is empty, unless this package has a bug."""
        return self._core.defects()

    @cached_property
    def digest(self) -> str:
        """The digest of a scene that has only this object."""
        return self._scene.digest()

    # ---- Changes

    def edit(self) -> Editor:
        """Starts edits of single elements. Use the returned editor in a `with` block. Its `mesh` is the edited mesh.

        >>> import meshwright as mw
        >>> m = mw.Scene().icosahedron(name="ball").mesh()
        >>> with m.edit() as e:
        ...     e.flip(e.edge(*m.edges[0]))
        ...     middle = e.split(7, at=0.25)
        >>> e.mesh.n_vertices
        13
        """
        from ._editor import Editor

        return Editor(self)

    def scene(self) -> Scene:
        """Returns the scene that has only this object."""
        from ._scene import Scene

        return Scene(self._scene, (), self._history)

    def recipe(self) -> Recipe:
        """Returns a recipe with the steps that made the mesh. The first step loads a file or creates a shape. A run of
        the recipe gives a mesh with the same :attr:`digest`.

        >>> import meshwright as mw
        >>> m = mw.Scene().icosahedron(name="ball").mesh().loop_subdivide(levels=2)
        >>> print(m.weld(distance=0.001).recipe())
        (
            recipe: 1,
            steps: [
                Icosahedron(name: "ball"),
                LoopSubdivide(levels: 2),
                Weld(distance: 0.001),
            ],
        )

        The recipe has no steps that write files, even if you called :meth:`save`. Add such steps to the recipe:
        ``m.recipe().save("a.glb").save_recipe("clean.ron")``. Paths of input files stay as they were given. Relative
        paths in a recipe are relative to the folder of its file, so save the recipe in the working directory.

        :raises ValueError: If the mesh was made from arrays, was made by an operation with another mesh as an argument,
            or was changed by :meth:`with_attribute`, :meth:`with_vertices` or :meth:`edit`. The error message names
            this cause.
        """
        return self.scene().recipe()

    def render(self, **options: Any) -> bytes:
        """Draws the mesh and returns the bytes of a PNG file. The options are the parameters of :meth:`picture`."""
        return self.scene().render(**options)

    def _repr_png_(self) -> bytes:
        return self.render(size=(640, 480))

    def view(
        self,
        *,
        color_by: str | Choice | Mapping[str, Any] | None = None,
        wireframe: bool | None = None,
        height: int = 480,
    ) -> View:
        """Returns an interactive view for notebooks: drag to turn, scroll to zoom. It needs no network.

        :param color_by: What the colors show, as in :meth:`picture`: a quantity such as ``"MeanCurvature"``, the name
            of an attribute of vertices or faces, or a mapping with the keys ``"of"`` and ``"range"``.
        :param wireframe: Whether edges are drawn at first. If omitted, edges are drawn for meshes of at most 20,000
            faces.
        :param height: The height in pixels.
        """
        from ._view import View

        return View(self, color_by, wireframe, height)

    def apply(self, operation: str, /, *, progress: bool | Progress | None = None, **parameters: Any) -> Self:
        """Runs an operation by its name in recipes: ``m.apply("LoopSubdivide", levels=2)`` is
        ``m.loop_subdivide(levels=2)``."""
        return self._apply(operation, parameters, None, None, progress)

    def _apply(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        progress: bool | Progress | None = None,
    ) -> Self:
        from ._scene import Scene

        others: dict[int, tuple[str, Mesh]] = {}
        replaced = {name: self._named(value, others) for name, value in fields.items()}
        only_this = [self._name] if others else None
        history = self._history
        if others:
            advice = "Put both objects into one scene, and use the method of the scene with `on`."
            history = history.lost(f"repeat `{snake(operation)}()` with a mesh as an argument", advice)
        done = Scene(self._with(others), (), history)._apply(operation, replaced, only_this, id, progress)
        result = done._core.only([n for n in done if n not in [name for name, _ in others.values()]])
        names = result.names()
        if len(names) != 1 or result.kind(names[0]) != "mesh":
            raise TypeError(
                f"{operation} gives {len(names)} objects; use mesh.scene() and the method of the scene instead"
            )
        return type(self)(result, names[0], done.notes, done._history)

    def _named(self, value: Any, others: dict[int, tuple[str, Mesh]]) -> Any:
        """Replaces each mesh in `value` by the name that the object of this mesh gets. Adds the names and the meshes to
        `others`."""
        if isinstance(value, Mesh):
            name = value.name if value.name != self._name else f"{value.name} (other)"
            taken = {n for key, (n, _) in others.items() if key != id(value)}
            while name in taken or name == self._name:
                name += " (other)"
            return others.setdefault(id(value), (name, value))[0]
        if isinstance(value, Choice):
            made = Choice(value.name)
            made.args = tuple(self._named(v, others) for v in value.args)
            made.fields = {k: self._named(v, others) for k, v in value.fields.items()}
            return made
        if isinstance(value, list | tuple):
            return type(value)(self._named(v, others) for v in value)
        return value

    def _with(self, others: dict[int, tuple[str, Mesh]]) -> _core.Scene:
        """Returns a scene with this mesh and the other meshes, which are renamed to the names in `others`."""
        scene = self._scene
        for name, other in others.values():
            scene = scene.joined(other._scene, {other.name: name})
        return scene

    def _with_core(self, core: _core.Mesh, method: str) -> Self:
        scene = self._scene.with_mesh(self._name, core)
        return type(self)(scene, self._name, self._notes, self._history.lost(f"repeat `{method}`"))

    # ---- Python

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mesh) and self._name == other._name and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __reduce__(self) -> tuple[Any, ...]:
        from ._scene import _unpickle_mesh

        return (_unpickle_mesh, (self.scene().to_bytes("mws"), self._name))

    def __repr__(self) -> str:
        vertices, edges, faces = self._core.counts()
        parts = (_count(vertices, "vertex", "vertices"), _count(edges, "edge", "edges"), _count(faces, "face", "faces"))
        return f'Mesh("{self._name}": {", ".join(parts)})'


def _count(n: int, one: str, many: str) -> str:
    return f"{n} {one if n == 1 else many}"


def polygons(
    faces: ArrayLike | Sequence[ArrayLike], face_starts: ArrayLike | None
) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
    """Converts faces to two arrays: the index of the first corner of each face, and the corners of all faces."""
    if face_starts is not None:
        starts, corners = indices(face_starts, "face_starts"), indices(faces, "faces")  # type: ignore[arg-type]
        if starts.ndim != 1 or corners.ndim != 1:
            raise ValueError("with face_starts, faces and face_starts must have one dimension")
        return starts, corners
    if not isinstance(faces, np.ndarray) and isinstance(faces, Sequence):
        lengths = [len(face) if isinstance(face, Sized) else -1 for face in faces]
        if any(n < 0 for n in lengths):
            raise ValueError("faces must be lists of vertices; for corners in one list, pass face_starts")
        if len(set(lengths)) > 1:
            flat = [v for face in faces for v in np.asarray(face).tolist()]
            starts = np.concatenate([[0], np.cumsum(lengths)])
            return indices(starts, "face_starts"), indices(np.asarray(flat), "faces")
    array = indices(faces, "faces")  # type: ignore[arg-type]
    if array.ndim == 1 and array.size == 0:
        array = array.reshape(0, 3)
    if array.ndim != 2:
        raise ValueError(f"faces have the shape {array.shape}, expected (k, corners)")
    starts = np.arange(array.shape[0] + 1, dtype=np.uint64) * array.shape[1]
    return indices(starts, "face_starts"), array.reshape(-1)
