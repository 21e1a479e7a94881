"""Expectations of recipes.

Generated from the schema of the operations by `generate.py`: do not edit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from numpy.typing import NDArray

from ._ron import Arg, Choice, Ron


__all__ = [
    "Area", "Attribute", "AxisMirrors", "BoundaryLoops", "Bounds", "Closed", "Components", "Count", "CubeMotions",
    "CubeRotations", "Digest", "DihedralAngle", "DistanceTo", "EdgeLength", "Edges", "EulerCharacteristic", "Faces",
    "File", "Genus", "HasAttribute", "Manifold", "MeanFaceArea", "MeanMinAngle", "MinAngle", "Not", "Object",
    "Objects", "Output", "Point", "Position", "Same", "SelfIntersections", "SymmetricUnder", "Thickness", "UvOverlap",
    "UvStretch", "Valence", "Vertices", "Volume"
]


def __dir__() -> list[str]:
    return __all__



def Area(
    *,
    eq: float | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
    tolerance: float | Arg | Ron | None = None,
) -> Choice:
    """The sum of the areas of the faces of all meshes.

    :param eq: The value must equal this number within the tolerance.
    :param min: At least this value.
    :param max: At most this value.
    :param tolerance: The allowed deviation from ``eq``. Defaults to ``1e-09``.
    """
    return Choice('Area', eq=eq, min=min, max=max, tolerance=tolerance)



def Attribute(
    *,
    name: str | Arg | Ron,
    of: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
    component: int | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The values of an attribute, for example of an attribute that ``measure()`` stored.

    Every mesh must have the attribute. Fails if no element has a value.

    :param name: The name of the attribute.
    :param of: Which elements. If omitted, all elements of the kind that has the attribute are checked. If several kinds
        have an attribute of this name, the first of these kinds is used: vertices, faces, corners, edges. ``"All"``,
        ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
    :param component: The index of the component of a vector, starting at 0. Required for vectors.
    :param min: Every value is at least this number.
    :param max: Every value is at most this number.
    """
    return Choice('Attribute', name=name, of=of, component=component, min=min, max=max)


AxisMirrors = Choice('AxisMirrors')
"""The 8 combinations of the reflections in the three coordinate planes."""


def BoundaryLoops(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of boundary loops: closed loops of boundary edges.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('BoundaryLoops', eq=eq, min=min, max=max)



def Bounds(
    *,
    min: Sequence[float] | NDArray[Any] | Arg | Ron,
    max: Sequence[float] | NDArray[Any] | Arg | Ron,
    tolerance: float | Arg | Ron | None = None,
) -> Choice:
    """The bounding box of all points.

    :param min: The lowest coordinates.
    :param max: The highest coordinates.
    :param tolerance: The allowed deviation of each coordinate. Defaults to ``1e-09``.
    """
    return Choice('Bounds', min=min, max=max, tolerance=tolerance)


Closed = Choice('Closed')
"""There is at least one mesh, and no mesh has boundary edges."""


def Components(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of connected components.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Components', eq=eq, min=min, max=max)



def Count(
    *,
    of: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of elements that a selection matches.

    :param of: Which elements. ``"All"``, ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a value of
        ``meshwright.sel``.
    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Count', of=of, eq=eq, min=min, max=max)


CubeMotions = Choice('CubeMotions')
"""The 48 symmetries of an axis-aligned cube: its rotations and reflections."""

CubeRotations = Choice('CubeRotations')
"""The 24 rotations of an axis-aligned cube."""


def Digest(value: str | Arg | Ron, /) -> Choice:
    """The digest of the scene, as ``meshwright run`` prints it."""
    return Choice('Digest', value)



def DihedralAngle(
    *,
    of: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
    reaches: float | Arg | Ron | None = None,
) -> Choice:
    """The dihedral angle of every selected edge between two faces, in degrees.

    The dihedral angle is the angle between the normals of the two faces: 0 if the faces are coplanar. Edges of a face
    with zero area are skipped. Fails if no selected edge has an angle.

    :param of: Which edges. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
    :param min: The smallest angle is at least this value.
    :param max: The largest angle is at most this value.
    :param reaches: The largest angle is at least this value.
    """
    return Choice('DihedralAngle', of=of, min=min, max=max, reaches=reaches)



def DistanceTo(*, other: Choice | Arg | Ron, below: float | Arg | Ron) -> Choice:
    """The two-sided Hausdorff distance between the surface of the mesh and the surface of another mesh.

    The Hausdorff distance is the largest distance from a point of either surface to the other surface. Fails unless the
    distance is proven to be below the limit ``below``.

    :param other: The mesh to compare with.
        ``expect.Object(..)``: The name of an object of the scene.
        ``expect.File(..)``: The first mesh in a file.
    :param below: The distance must be below this limit, in scene units.
    """
    return Choice('DistanceTo', other=other, below=below)



def EdgeLength(
    *,
    of: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The length, in scene units, of every selected edge.

    Fails if the selection is empty.

    :param of: Which edges. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
    :param min: The shortest edge has at least this length.
    :param max: The longest edge has at most this length.
    """
    return Choice('EdgeLength', of=of, min=min, max=max)



def Edges(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of edges.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Edges', eq=eq, min=min, max=max)



def EulerCharacteristic(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The Euler characteristic: vertices - edges + faces.

    :param eq: Exactly this value.
    :param min: At least this value.
    :param max: At most this value.
    """
    return Choice('EulerCharacteristic', eq=eq, min=min, max=max)



def Faces(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of faces.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Faces', eq=eq, min=min, max=max)



def File(value: str | Arg | Ron, /) -> Choice:
    """The first mesh in a file.

    The value is the path of the file, relative to the recipe's folder.
    """
    return Choice('File', value)



def Genus(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The genus, which is the number of handles: 0 for a sphere, 1 for a torus.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Genus', eq=eq, min=min, max=max)



def HasAttribute(*, domain: Literal['Vertex', 'Corner', 'Edge', 'Face'] | Arg | Ron, name: str | Arg | Ron) -> Choice:
    """There is at least one mesh, and every mesh has this attribute.

    :param domain: The domain of the attribute.
        ``"Vertex"``: Vertices.
        ``"Corner"``: Corners.
        ``"Edge"``: Edges.
        ``"Face"``: Faces.
    :param name: The name of the attribute.
    """
    return Choice('HasAttribute', domain=domain, name=name)


Manifold = Choice('Manifold')
"""There is at least one mesh.

Every mesh is a valid manifold, and no two edges of a mesh join the same vertices. Meshes are always built as manifolds.
The expectation ``Manifold`` checks the meshes once more.
"""


def MeanFaceArea(
    *,
    of: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The mean area of the selected faces, divided by the median area of all faces.

    Fails if the selection is empty.

    :param of: Which faces. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
    :param min: The ratio is at least this value.
    :param max: The ratio is at most this value.
    """
    return Choice('MeanFaceArea', of=of, min=min, max=max)



def MeanMinAngle(
    *,
    of: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The smallest corner angle of each selected face, averaged over these faces, in degrees.

    The smallest corner angle of an equilateral triangle is 60. Fails if the selection is empty.

    :param of: Which faces. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
        ``meshwright.sel``.
    :param min: At least this value.
    :param max: At most this value.
    """
    return Choice('MeanMinAngle', of=of, min=min, max=max)



def MinAngle(
    *,
    of: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The smallest corner angle, in degrees, of all selected faces.

    Fails if the selection is empty.

    :param of: Which faces. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
        ``meshwright.sel``.
    :param min: At least this value.
    :param max: At most this value.
    """
    return Choice('MinAngle', of=of, min=min, max=max)



def Not(value: Literal['Manifold', 'Closed'] | Choice | Arg | Ron, /) -> Choice:
    """The inner expectation must not hold.

    ``Not`` also fails if the inner expectation cannot be checked, for example because a file cannot be read or a
    selection is empty.
    """
    return Choice('Not', value)



def Object(value: str | Arg | Ron, /) -> Choice:
    """The name of an object of the scene."""
    return Choice('Object', value)



def Objects(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of objects.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Objects', eq=eq, min=min, max=max)



def Output(*, path: str | Arg | Ron, as_: str | Arg | Ron, tolerance: int | Arg | Ron | None = None) -> Choice:
    """A file that an operation writes is equal to a reference file.

    ``meshwright test --update`` creates and updates the reference file. Pictures (.png, .apng) are compared pixel by
    pixel. Mesh files are compared by the objects that are read from them, and all other files byte by byte. Differences
    in the recorded provenance, which says how the file was made, are ignored.

    :param path: The path of the written file, relative to the output folder, as in the operation that writes the file.
    :param as_: The path of the reference file, relative to the recipe's folder. The file must be inside this folder.
    :param tolerance: The allowed difference between the colors of two pictures, in steps of 1/255. Defaults to 0.
    """
    return Choice('Output', path=path, as_=as_, tolerance=tolerance)



def Point(
    *,
    index: int | Arg | Ron,
    is_: Sequence[float] | NDArray[Any] | Arg | Ron,
    line: int | Arg | Ron | None = None,
    tolerance: float | Arg | Ron | None = None,
) -> Choice:
    """The position of one point of a polyline.

    The position is in object space, because the nodes of a scene place only meshes.

    :param index: The index of the point in the polyline, starting at 0.
    :param is_: The expected position.
    :param line: The index of the polyline in its object, starting at 0. Defaults to ``0``.
    :param tolerance: The allowed distance from the expected position. Defaults to ``1e-09``.
    """
    return Choice('Point', index=index, is_=is_, line=line, tolerance=tolerance)



def Position(
    *,
    of: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron,
    is_: Sequence[float] | NDArray[Any] | Arg | Ron,
    tolerance: float | Arg | Ron | None = None,
) -> Choice:
    """The position of one vertex.

    :param of: Which vertex. The selection must match exactly one vertex. ``"All"``, ``"Boundary"``, ``"Isolated"``, or
        a value of ``meshwright.sel``.
    :param is_: The expected position.
    :param tolerance: The allowed distance from the expected position. Defaults to ``1e-09``.
    """
    return Choice('Position', of=of, is_=is_, tolerance=tolerance)



def Same(
    *,
    as_: Choice | Arg | Ron,
    tolerance: float | Arg | Ron | None = None,
    connectivity: bool | Arg | Ron | None = None,
) -> Choice:
    """The mesh has the same vertices and faces as another mesh, in any order.

    :param as_: The mesh to compare with.
        ``expect.Object(..)``: The name of an object of the scene.
        ``expect.File(..)``: The first mesh in a file.
    :param tolerance: The allowed distance between two matching vertices. Defaults to ``0.0``.
    :param connectivity: Whether the faces of the two meshes must also be the same. Defaults to ``True``.
    """
    return Choice('Same', as_=as_, tolerance=tolerance, connectivity=connectivity)



def SelfIntersections(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of faces that intersect another face of the same object.

    Neighboring faces intersect only if they have points in common beyond their shared vertices and edges.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('SelfIntersections', eq=eq, min=min, max=max)



def SymmetricUnder(
    *,
    group: Literal['CubeRotations', 'CubeMotions', 'AxisMirrors'] | Arg | Ron,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
    tolerance: float | Arg | Ron | None = None,
    connectivity: bool | Arg | Ron | None = None,
) -> Choice:
    """The number of motions (rotations and reflections) that map the mesh onto itself.

    The motions belong to a symmetry group about the origin. If ``eq``, ``min`` and ``max`` are omitted, all motions of
    the group must map the mesh onto itself.

    :param group: The symmetry group.
        ``"CubeRotations"``: The 24 rotations of an axis-aligned cube.
        ``"CubeMotions"``: The 48 symmetries of an axis-aligned cube: its rotations and reflections.
        ``"AxisMirrors"``: The 8 combinations of the reflections in the three coordinate planes.
    :param eq: Exactly this number of motions, including the identity.
    :param min: At least this number of motions.
    :param max: At most this number of motions.
    :param tolerance: The allowed distance between a moved vertex and the vertex that it must match. Defaults to
        ``1e-09``.
    :param connectivity: Whether each motion must also map every face onto a face. Defaults to ``True``.
    """
    return Choice('SymmetricUnder', group=group, eq=eq, min=min, max=max, tolerance=tolerance, connectivity=connectivity)



def Thickness(
    *,
    of: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
) -> Choice:
    """The thickness of the solid at each selected vertex, in scene units.

    ``measure(of="Thickness", ..)`` measures the thickness in the same way. The thickness is infinite where the surface
    has no opposite side, for example on an open sheet. Fails if the selection is empty.

    :param of: Which vertices. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
        ``meshwright.sel``.
    :param min: At least this value.
    :param max: At most this value.
    """
    return Choice('Thickness', of=of, min=min, max=max)



def UvOverlap(
    *,
    uv: str | Arg | Ron | None = None,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of faces that overlap another face of the same mesh in the texture.

    Faces that only share corners or sides do not overlap. Fails if no mesh has the texture coordinates.

    :param uv: The name of the texture coordinates. Defaults to ``uv``.
    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('UvOverlap', uv=uv, eq=eq, min=min, max=max)



def UvStretch(*, max: float | Arg | Ron, uv: str | Arg | Ron | None = None) -> Choice:
    """The stretch of texture coordinates.

    A small circle on the surface becomes an ellipse in the texture. The stretch is the ratio of the axes of this
    ellipse: 1 where angles are preserved. The value of a mesh is the stretch that is not exceeded on 95 % of the
    surface area. If there are several meshes, the largest of their values is checked. Fails if no mesh has the texture
    coordinates.

    :param max: At most this value.
    :param uv: The name of the texture coordinates. Defaults to ``uv``.
    """
    return Choice('UvStretch', max=max, uv=uv)



def Valence(
    *,
    of: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The valence (number of edges) of every selected vertex.

    Fails if the selection is empty.

    :param of: Which vertices. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
        ``meshwright.sel``.
    :param eq: Each valence is exactly this number.
    :param min: The lowest valence is at least this number.
    :param max: The highest valence is at most this number.
    """
    return Choice('Valence', of=of, eq=eq, min=min, max=max)



def Vertices(
    *,
    eq: int | Arg | Ron | None = None,
    min: int | Arg | Ron | None = None,
    max: int | Arg | Ron | None = None,
) -> Choice:
    """The number of vertices, including the points of polylines, curves and patches.

    :param eq: Exactly this number.
    :param min: At least this number.
    :param max: At most this number.
    """
    return Choice('Vertices', eq=eq, min=min, max=max)



def Volume(
    *,
    eq: float | Arg | Ron | None = None,
    min: float | Arg | Ron | None = None,
    max: float | Arg | Ron | None = None,
    tolerance: float | Arg | Ron | None = None,
) -> Choice:
    """The enclosed volume, summed over all meshes.

    :param eq: The value must equal this number within the tolerance.
    :param min: At least this value.
    :param max: At most this value.
    :param tolerance: The allowed deviation from ``eq``. Defaults to ``1e-09``.
    """
    return Choice('Volume', eq=eq, min=min, max=max, tolerance=tolerance)
