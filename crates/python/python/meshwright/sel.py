"""Selections of the elements of a mesh, which are its vertices, edges and faces, and regions of space.

Generated from the schema of the operations by `generate.py`: do not edit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from numpy.typing import NDArray

from ._ron import Arg, Choice, Ron

if TYPE_CHECKING:
    from ._mesh import Mesh


__all__ = [
    "All", "And", "Between", "Boundary", "Box", "Component", "CornersOf", "Degree", "EdgeLoop", "EdgeRing", "Edges",
    "EdgesAround", "EdgesOf", "EdgesWithin", "EndsOf", "Expand", "Expect", "Faces", "FacesAround", "FacesBeside",
    "Facing", "Flat", "Grow", "HalfSpace", "Inside", "InsideOf", "Isolated", "Longer", "Longest", "Material",
    "Nearest", "Not", "Or", "Path", "Random", "SelfIntersecting", "Sharp", "Shorter", "Shrink", "Sphere", "Tagged",
    "Valence", "Vertices", "Where"
]


def __dir__() -> list[str]:
    return __all__


All = Choice('All')
"""All elements."""


def And(
    value: Sequence[Literal['All', 'Boundary', 'Isolated'] | Choice] | NDArray[Any] | Sequence[Literal['All', 'Boundary'] | Choice] | Sequence[Literal['All', 'Boundary', 'SelfIntersecting'] | Choice] | Arg | Ron,
    /,
) -> Choice:
    """The elements in all of these selections.

    An empty list selects all elements.
    """
    return Choice('And', value)



def Between(a: int | Arg, b: int | Arg, /) -> Choice:
    """The edge that joins the two vertices with these ids.

    Refused if no edge joins these two vertices.
    """
    return Choice('Between', a, b)


Boundary = Choice('Boundary')
"""The meaning depends on what is selected.

- As a selection of vertices: Vertices with a boundary edge, which is an edge with a face on one side only.
- As a selection of edges: Boundary edges: edges with a face on one side only.
- As a selection of faces: Faces with at least one boundary edge.
"""


def Box(
    *,
    min: Sequence[float] | NDArray[Any] | Arg | Ron,
    max: Sequence[float] | NDArray[Any] | Arg | Ron,
) -> Choice:
    """An axis-aligned box.

    :param min: The corner with the lowest coordinates.
    :param max: The corner with the highest coordinates.
    """
    return Choice('Box', min=min, max=max)



def Component(value: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The elements of all connected components that contain an element of this selection."""
    return Choice('Component', value)



def CornersOf(value: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The corners of these faces."""
    return Choice('CornersOf', value)



def Degree(value: int | Arg | Ron, /) -> Choice:
    """Faces with this number of corners."""
    return Choice('Degree', value)



def EdgeLoop(value: Literal['All', 'Boundary'] | Choice | Arg | Ron, /) -> Choice:
    """The given edges and all edge loops through them.

    At an interior vertex with four edges, an edge loop continues with the opposite edge. At all other vertices, the
    loop ends. An edge loop that starts at a boundary edge follows the boundary instead.
    """
    return Choice('EdgeLoop', value)



def EdgeRing(value: Literal['All', 'Boundary'] | Choice | Arg | Ron, /) -> Choice:
    """The given edges and all edge rings through them.

    In a face with four corners, an edge ring passes from an edge to the opposite edge. The ring ends at the boundary,
    and at faces that do not have four corners.
    """
    return Choice('EdgeRing', value)



def Edges(value: Literal['All', 'Boundary'] | Choice | Arg | Ron, /) -> Choice:
    """A selection of edges.

    For ``picture(highlight=..)`` and ``picture(marks=[{"of": ..}])``.
    """
    return Choice('Edges', value)



def EdgesAround(value: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron, /) -> Choice:
    """Edges with at least one end among these vertices."""
    return Choice('EdgesAround', value)



def EdgesOf(value: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The edges of these faces."""
    return Choice('EdgesOf', value)



def EdgesWithin(value: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron, /) -> Choice:
    """Edges with both ends among these vertices."""
    return Choice('EdgesWithin', value)



def EndsOf(value: Literal['All', 'Boundary'] | Choice | Arg | Ron, /) -> Choice:
    """The ends of these edges."""
    return Choice('EndsOf', value)



def Expand(
    *,
    to_angle: float | Arg | Ron,
    of: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
) -> Choice:
    """The given faces, and all faces that are connected to them across nearly flat edges.

    At a nearly flat edge, the normals of the two faces differ by at most the angle ``to_angle``.

    :param to_angle: The largest angle between the normals of two neighboring faces, in degrees, from 0 (flat) to 180.
    :param of: The faces to start from. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
        ``meshwright.sel``.
    """
    return Choice('Expand', to_angle=to_angle, of=of)



def Expect(
    *,
    count: int | Arg | Ron,
    of: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron,
) -> Choice:
    """The elements of the selection ``of``.

    The operation fails with the reason ``Expectation`` unless ``of`` has exactly ``count`` elements.

    :param count: The expected number of elements.
    :param of: The selection to count. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
    """
    return Choice('Expect', count=count, of=of)



def Faces(
    value: Literal['All', 'Boundary', 'SelfIntersecting'] | Sequence[int] | NDArray[Any] | Choice | Arg | Ron,
    /,
) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of faces: The faces with these ids. Refused if a face does not exist.
    - In ``picture(highlight=..)`` and ``picture(marks=[{"of": ..}])``: A selection of faces.
    """
    return Choice('Faces', value)



def FacesAround(value: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron, /) -> Choice:
    """Faces with at least one corner among these vertices."""
    return Choice('FacesAround', value)



def FacesBeside(value: Literal['All', 'Boundary'] | Choice | Arg | Ron, /) -> Choice:
    """Faces with at least one of these edges."""
    return Choice('FacesBeside', value)



def Facing(*, direction: Sequence[float] | NDArray[Any] | Arg | Ron, within: float | Arg | Ron) -> Choice:
    """Faces whose normals differ from a direction by at most the angle ``within``.

    :param direction: The direction. The length of the direction does not matter; a zero vector selects no faces.
    :param within: The largest angle between the normal and the direction, in degrees.
    """
    return Choice('Facing', direction=direction, within=within)



def Flat(*, below: float | Arg | Ron) -> Choice:
    """Edges at which the normals of the two faces differ by less than the angle ``below``.

    :param below: The upper limit of the angle between the normals, in degrees, from 0 (flat) to 180. Boundary edges
        have no angle and are never flat.
    """
    return Choice('Flat', below=below)



def Grow(value: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: This selection and the vertices that share an edge with it.
    - As a selection of edges: This selection and the edges that share a vertex with it.
    - As a selection of faces: This selection and the faces that share a vertex with it.
    """
    return Choice('Grow', value)



def HalfSpace(
    *,
    point: Sequence[float] | NDArray[Any] | Arg | Ron,
    normal: Sequence[float] | NDArray[Any] | Arg | Ron,
) -> Choice:
    """One side of a plane: all points p with (p - point) · normal >= 0.

    :param point: A point on the plane.
    :param normal: The normal of the plane, which points into the region. The length of the normal does not matter.
    """
    return Choice('HalfSpace', point=point, normal=normal)



def Inside(value: Choice | Arg | Ron, /) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: Vertices in a region or on its surface.
    - As a selection of edges: Edges whose vertices all lie in a region or on its surface.
    - As a selection of faces: Faces whose vertices all lie in a region or on its surface.
    """
    return Choice('Inside', value)



def InsideOf(value: Mesh | str | Arg | Ron, /) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: The vertices inside another mesh.
    - As a selection of edges: The edges whose vertices are all inside another mesh.
    - As a selection of faces: The faces whose vertices are all inside another mesh.

    A point is inside if the winding number of the mesh around the point is above 1/2 or below -1/2. Small gaps in the
    mesh are allowed.

    :param value: The mesh. For a scene or a recipe, the name of its object.
    """
    return Choice('InsideOf', value)


Isolated = Choice('Isolated')
"""Isolated vertices: vertices without edges."""


def Longer(*, than: float | Arg | Ron) -> Choice:
    """Edges whose length is greater than ``than``.

    :param than: The length, in scene units.
    """
    return Choice('Longer', than=than)



def Longest(
    *,
    count: int | Arg | Ron | None = None,
    of: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
) -> Choice:
    """The ``count`` longest edges of the selection ``of``.

    If several edges have the same length, the edges with the lowest ids are chosen.

    :param count: The number of edges. If fewer are available, all are selected. Defaults to ``1``.
    :param of: The selection to choose from. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, or a value of
        ``meshwright.sel``.
    """
    return Choice('Longest', count=count, of=of)



def Material(value: str | Arg | Ron, /) -> Choice:
    """Faces with the material of this name.

    Refused if the object has no material of this name.
    """
    return Choice('Material', value)



def Nearest(
    *,
    to: Sequence[float] | NDArray[Any] | Arg | Ron,
    count: int | Arg | Ron | None = None,
    of: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: The vertices nearest to a point. If vertices are equally near, those with the lower
      ids are selected.
    - As a selection of edges: The edges whose midpoints are nearest to a point. If edges are equally near, those with
      the lower ids are selected.
    - As a selection of faces: The faces whose centers (the means of their vertices) are nearest to a point. If faces
      are equally near, those with the lower ids are selected.

    :param to: The point.
    :param count: The number of elements. If fewer are available, all are selected. Defaults to ``1``.
    :param of: The selection to choose from. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
        value of ``meshwright.sel``.
    """
    return Choice('Nearest', to=to, count=count, of=of)



def Not(value: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The elements that are not in this selection."""
    return Choice('Not', value)



def Or(
    value: Sequence[Literal['All', 'Boundary', 'Isolated'] | Choice] | NDArray[Any] | Sequence[Literal['All', 'Boundary'] | Choice] | Sequence[Literal['All', 'Boundary', 'SelfIntersecting'] | Choice] | Arg | Ron,
    /,
) -> Choice:
    """The elements in at least one of these selections.

    An empty list selects no elements.
    """
    return Choice('Or', value)



def Path(*, from_: int | Arg | Ron, to: int | Arg | Ron) -> Choice:
    """The shortest path along edges from one vertex to another.

    Refused if no path exists.

    :param from_: The id of the first vertex.
    :param to: The id of the last vertex.
    """
    return Choice('Path', from_=from_, to=to)



def Random(
    *,
    count: int | Arg | Ron,
    seed: int | Arg | Ron,
    of: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
) -> Choice:
    """A random choice of ``count`` elements from the selection ``of``.

    The same step with the same seed makes the same choice in each run. Two steps with the same seed choose
    independently of each other.

    :param count: The number of elements. If fewer are available, all are selected.
    :param seed: The seed. A different seed gives a different choice.
    :param of: The selection to choose from. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
        value of ``meshwright.sel``.
    """
    return Choice('Random', count=count, seed=seed, of=of)


SelfIntersecting = Choice('SelfIntersecting')
"""Faces that intersect another face of the object.

Two adjacent faces count as intersecting only if they share points other than their common vertices and edges. Vertices
at the same position count as the same vertex.
"""


def Sharp(*, above: float | Arg | Ron) -> Choice:
    """Edges at which the normals of the two faces differ by more than the angle ``above``.

    :param above: The lower limit of the angle between the normals, in degrees, from 0 (flat) to 180. Boundary edges
        have no angle and are never sharp.
    """
    return Choice('Sharp', above=above)



def Shorter(*, than: float | Arg | Ron) -> Choice:
    """Edges whose length is less than ``than``.

    :param than: The length, in scene units.
    """
    return Choice('Shorter', than=than)



def Shrink(value: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron, /) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: This selection without the vertices that share an edge with vertices outside the
      selection.
    - As a selection of edges: This selection without the edges that share a vertex with edges outside the selection.
    - As a selection of faces: This selection without the faces that share a vertex with faces outside the selection.
    """
    return Choice('Shrink', value)



def Sphere(*, center: Sequence[float] | NDArray[Any] | Arg | Ron, radius: float | Arg | Ron) -> Choice:
    """A ball.

    :param center: The center.
    :param radius: The radius, in scene units.
    """
    return Choice('Sphere', center=center, radius=radius)



def Tagged(value: str | Arg | Ron, /) -> Choice:
    """The elements with the tag of this name.

    Refused if no tag of elements has this name.
    """
    return Choice('Tagged', value)



def Valence(value: int | Arg | Ron, /) -> Choice:
    """Vertices with this number of edges."""
    return Choice('Valence', value)



def Vertices(
    value: Literal['All', 'Boundary', 'Isolated'] | Sequence[int] | NDArray[Any] | Choice | Arg | Ron,
    /,
) -> Choice:
    """The meaning depends on what is selected.

    - As a selection of vertices: The vertices with these ids. Refused if a vertex does not exist.
    - In ``picture(highlight=..)`` and ``picture(marks=[{"of": ..}])``: A selection of vertices.
    """
    return Choice('Vertices', value)



def Where(
    *,
    attribute: str | Arg | Ron,
    component: int | Arg | Ron | None = None,
    above: float | Arg | Ron | None = None,
    below: float | Arg | Ron | None = None,
) -> Choice:
    """The elements whose attribute has a value in a range.

    Refused if no attribute of elements has this name.

    For the 10 % of the vertices with the highest values: ``sel.Where(attribute="curvature",
    above=numpy.quantile(m.attributes["curvature"], 0.9))``.

    :param attribute: The name of the attribute.
    :param component: The index of the component of a vector, starting at 0. Required if the attribute is a vector, and
        not allowed if it is a number.
    :param above: Only values above this number. At least one of the bounds ``above`` and ``below`` is required.
    :param below: Only values below this number.
    """
    return Choice('Where', attribute=attribute, component=component, above=above, below=below)
