"""Values of parameters that have parameters themselves.

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
    "Angles", "Attribute", "Denoise", "Direction", "Distance", "DistanceTo", "EdgeLength", "Fit", "Geodesic", "Image",
    "Implicit", "Laplacian", "LimitDistance", "LookAt", "Noise", "Occlusion", "Offset", "Perspective", "Plain",
    "Point", "PrincipalCurvature", "Random", "Rotate", "Scale", "Tag", "Taubin", "To", "Winding"
]


def __dir__() -> list[str]:
    return __all__



def Angles(*, azimuth: float | Arg | Ron, elevation: float | Arg | Ron) -> Choice:
    """From the direction that the two angles give.

    For ``choice.Fit(from_=..)``.

    :param azimuth: The angle from the front towards the right, in degrees.
    :param elevation: The angle above the horizontal plane, in degrees.
    """
    return Choice('Angles', azimuth=azimuth, elevation=elevation)



def Attribute(*, name: str | Arg | Ron, component: int | Arg | Ron | None = None) -> Choice:
    """The meaning depends on the parameter.

    - In ``displace(by=..)``, as ``choice.Attribute(name=..)``: A vertex attribute that holds one number for each
      vertex.
    - In ``picture(color_by=..)``, as ``choice.Attribute(name=.., component=..)``: An attribute. If several kinds of
      elements have an attribute of this name, the first kind in this order is used: vertices, faces, corners, edges.

    :param name: The name of the attribute.
    :param component: The index of the component of a vector, counted from 0. If omitted, the length of the vector is
        used.
    """
    return Choice('Attribute', name=name, component=component)



def Denoise(*, angle: float | Arg | Ron | None = None) -> Choice:
    """Filters the normals of the faces, so that similar normals of nearby faces become nearly equal.

    Then moves the vertices so that the faces fit the filtered normals.

    For ``smooth(by=..)``.

    :param angle: Normals that differ by more than this angle hardly affect each other, so edges sharper than this angle
        are kept. From 0 to 180 degrees. Defaults to 30.
    """
    return Choice('Denoise', angle=angle)



def Direction(value: Sequence[float] | NDArray[Any] | Arg | Ron, /) -> Choice:
    """Moves to the first point of the surface in this direction.

    For ``project(along=..)``.
    """
    return Choice('Direction', value)



def Distance(
    value: float | Arg | Ron | None = None,
    /,
    *,
    to: Mesh | str | Arg | Ron | None = None,
    signed: bool | Arg | Ron | None = None,
) -> Choice:
    """The meaning depends on the parameter.

    - In ``extrude_faces(by=..)``, as ``choice.Distance(value)``: The distance along the normal of each region, in scene
      units. A region consists of selected faces that are connected by edges. Its normal is the mean of the normals of
      these faces, weighted by area. A negative distance moves the faces inwards.
    - In ``move_vertices(by=..)``, as ``choice.Distance(value)``: Moves each vertex by this distance along its normal,
      in scene units. A negative distance moves vertices inwards.
    - In ``measure(of=..)``, as ``choice.Distance(to=.., signed=..)``: The distance from each vertex to the nearest
      point of another mesh, in scene units. An operation without ``on`` computes the distances for all meshes except
      the other mesh itself.

    :param to: The mesh to which distances are measured. For a scene or a recipe, the name of its object.
    :param signed: Whether distances are negative inside the other mesh, that is, where its winding number is more than
        1/2 or less than -1/2. Defaults to ``False``.
    """
    return Choice('Distance', *(() if value is None else (value,)), to=to, signed=signed)



def DistanceTo(value: str | Arg | Ron, /) -> Choice:
    """The distance of each vertex from the nearest point of the meshes in another file, in scene units.

    The path of the file is relative to the folder of the recipe.

    For ``picture(color_by=..)``.
    """
    return Choice('DistanceTo', value)



def EdgeLength(*, below: float | Arg | Ron) -> Choice:
    """Stops as soon as all edges are shorter than ``below``.

    For ``loop_subdivide(until=..)``, ``catmull_clark(until=..)``, ``midpoint(until=..)``, ``butterfly(until=..)``,
    ``sqrt3(until=..)`` and ``doo_sabin(until=..)``.

    :param below: The length, in scene units.
    """
    return Choice('EdgeLength', below=below)



def Fit(
    *,
    from_: Literal['Front', 'Back', 'Left', 'Right', 'Top', 'Bottom', 'Isometric', 'ThreeQuarter'] | Choice | Arg | Ron | None = None,
    up: Literal['Y', 'Z', 'Auto'] | Arg | Ron | None = None,
    projection: Literal['Orthographic'] | Choice | Arg | Ron | None = None,
    margin: float | Arg | Ron | None = None,
    steady: bool | Arg | Ron | None = None,
) -> Choice:
    """Looks at the scene from a given side.

    The distance of the camera is chosen so that the whole scene fits into the picture.

    For ``picture(camera=..)`` and ``picture(views=[..])``.

    :param from_: The side from which the camera looks. Defaults to ``"ThreeQuarter"``.
        ``"Front"``: From the front.
        ``"Back"``: From the back, which is opposite to the front.
        ``"Left"``: From the side where x is small.
        ``"Right"``: From the side where x is large.
        ``"Top"``: From above.
        ``"Bottom"``: From below.
        ``"Isometric"``: From the front, right and above, so that the three axes are equally long in the picture.
        ``"ThreeQuarter"``: From the front, but turned by 30 degrees towards the side where x is large, and raised by 22
            degrees.
        ``choice.Angles(..)``: From the direction that the two angles give.
    :param up: The axis that points upwards. Defaults to ``"Y"``.
        ``"Y"``: The y axis, as in glTF.
        ``"Z"``: The z axis, as in most CAD programs.
        ``"Auto"``: The z axis if the scene stands on the plane z = 0 but not on the plane y = 0; else the y axis.
    :param projection: The projection.
        ``"Orthographic"``: Parallel projection: the size of an object does not depend on its distance.
        ``choice.Perspective(..)``: Perspective projection, as in a photograph.
    :param margin: The empty margin at each border of the picture, as a fraction of the width (left and right) or height
        (top and bottom). Defaults to ``0.05``.
    :param steady: Whether the picture has the same scale for every direction of the camera. Set this for an animation
        in which the camera turns around the scene. Defaults to ``False``.
    """
    return Choice('Fit', from_=from_, up=up, projection=projection, margin=margin, steady=steady)



def Geodesic(*, from_: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron) -> Choice:
    """The distance along the surface from each vertex to the nearest selected vertex, in scene units.

    It is computed by the heat method (Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013; Sharp, Crane, 2020). On
    fine meshes of smooth surfaces, the mean error is below 1 % of the largest distance. If no path of edges joins a
    vertex to a selected vertex, the distance of this vertex is not defined.

    For ``measure(of=..)``.

    :param from_: The vertices from which distances are measured. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value
        of ``meshwright.sel``.
    """
    return Choice('Geodesic', from_=from_)



def Image(*, path: str | Arg | Ron, uv: str | Arg | Ron | None = None) -> Choice:
    """The brightness of an image (a height map), from 0 (black) to 1 (white), at the texture coordinates of the vertex.

    Brightness is the mean of red, green and blue as they are stored in the file. Between the centers of pixels, the
    brightness is interpolated. Where the texture coordinates are less than 0 or more than 1, the image is repeated. A
    vertex on a seam has several texture coordinates; its value is the mean of the values at its corners. Gray PNG files
    with 16 bits per pixel give smoother surfaces than files with 8 bits.

    For ``displace(by=..)``.

    :param path: The path of the PNG or JPEG file. A relative path is relative to the working directory; in a recipe, to
        the folder of the recipe.
    :param uv: The name of the attribute that holds the texture coordinates. Defaults to ``uv``.
    """
    return Choice('Image', path=path, uv=uv)



def Implicit(*, time: float | Arg | Ron) -> Choice:
    """Moves the surface by mean curvature flow.

    Each pass is one time step of length ``time``, and is stable for any length. Details smaller than the square root of
    the time disappear, regardless of how dense the vertices are.

    For ``smooth(by=..)``.

    :param time: The time, in squares of the scene unit.
    """
    return Choice('Implicit', time=time)



def Laplacian(
    *,
    weights: Literal['Uniform', 'Cotangent'] | Arg | Ron | None = None,
    factor: float | Arg | Ron | None = None,
) -> Choice:
    """Moves each vertex towards the mean of its neighbors.

    For ``smooth(by=..)``.

    :param weights: The weights of the neighbors. Defaults to ``"Uniform"``.
        ``"Uniform"``: All vertices that share an edge with the vertex have the same weight.
        ``"Cotangent"``: The weights depend on the angles of the faces (cotangent weights).
    :param factor: The distance of the movement, as a fraction of the distance from the vertex to the mean of its
        neighbors. From 0 to 1. Defaults to 0.5.
    """
    return Choice('Laplacian', weights=weights, factor=factor)



def LimitDistance(*, below: float | Arg | Ron) -> Choice:
    """Stops as soon as the distance of every vertex to its limit position is less than ``below``.

    Available only for Loop and Catmull-Clark subdivision.

    For ``loop_subdivide(until=..)``, ``catmull_clark(until=..)``, ``midpoint(until=..)``, ``butterfly(until=..)``,
    ``sqrt3(until=..)`` and ``doo_sabin(until=..)``.

    :param below: The distance, in scene units.
    """
    return Choice('LimitDistance', below=below)



def LookAt(
    *,
    from_: Sequence[float] | NDArray[Any] | Arg | Ron,
    to: Sequence[float] | NDArray[Any] | Arg | Ron,
    up: Literal['Y', 'Z', 'Auto'] | Arg | Ron | None = None,
    projection: Literal['Orthographic'] | Choice | Arg | Ron | None = None,
) -> Choice:
    """Looks from one point to another point.

    For ``picture(camera=..)`` and ``picture(views=[..])``.

    :param from_: The position of the camera, ``(x, y, z)``, in scene units.
    :param to: The point in the middle of the picture, ``(x, y, z)``, in scene units.
    :param up: The axis that points upwards. Defaults to ``"Y"``.
        ``"Y"``: The y axis, as in glTF.
        ``"Z"``: The z axis, as in most CAD programs.
        ``"Auto"``: The z axis if the scene stands on the plane z = 0 but not on the plane y = 0; else the y axis.
    :param projection: The projection. With ``Orthographic``, the scale is the same as the scale at the point ``to`` in
        a perspective picture with a field of view of 30 degrees.
        ``"Orthographic"``: Parallel projection: the size of an object does not depend on its distance.
        ``choice.Perspective(..)``: Perspective projection, as in a photograph.
    """
    return Choice('LookAt', from_=from_, to=to, up=up, projection=projection)



def Noise(*, scale: float | Arg | Ron, seed: int | Arg | Ron | None = None) -> Choice:
    """Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002).

    At a vertex, the value depends only on the position of the vertex, so vertices at the same position have the same
    value.

    For ``displace(by=..)``.

    :param scale: The size of the waves of the noise, in scene units.
    :param seed: The seed. A different seed gives different noise. The same seed gives the same noise in every step.
        Defaults to 0.
    """
    return Choice('Noise', scale=scale, seed=seed)



def Occlusion(*, rays: int | Arg | Ron | None = None, seed: int | Arg | Ron | None = None) -> Choice:
    """The ambient occlusion of each vertex.

    Rays start at the vertex, and the value is the fraction of rays that hit the mesh, from 0 (open) to 1 (enclosed).
    The density of the rays is proportional to the cosine of their angle to the normal.

    For ``measure(of=..)``.

    :param rays: The number of rays from each vertex. At most 4096. Defaults to 64.
    :param seed: The seed of the rays. Defaults to 0.
    """
    return Choice('Occlusion', rays=rays, seed=seed)



def Offset(value: Sequence[float] | NDArray[Any] | Arg | Ron, /) -> Choice:
    """The meaning depends on the parameter.

    - In ``extrude_faces(by=..)``: The offset along x, y and z, in scene units.
    - In ``move_vertices(by=..)``: Moves by this offset along x, y and z, in scene units.
    """
    return Choice('Offset', value)



def Perspective(*, angle: float | Arg | Ron) -> Choice:
    """Perspective projection, as in a photograph.

    For ``choice.Fit(projection=..)`` and ``choice.LookAt(projection=..)``.

    :param angle: The vertical field of view, in degrees.
    """
    return Choice('Perspective', angle=angle)



def Plain(value: str | Arg | Ron, /) -> Choice:
    """The meaning depends on the parameter.

    - In ``picture(style={"shading": ..})``: No lighting: the colors are unchanged.
    - In ``picture(style={"background": ..})``: One color for the whole background.
    """
    return Choice('Plain', value)



def Point(a: float | Arg, b: float | Arg, c: float | Arg, /) -> Choice:
    """A point with the coordinates x, y, z.

    For ``transform(about=..)``.
    """
    return Choice('Point', a, b, c)



def PrincipalCurvature(value: Literal['Largest', 'Smallest'] | Arg | Ron, /) -> Choice:
    """A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of the curvature tensor of Cohen-Steiner
    and Morvan, 2003.

    On a cylinder of radius r, the two principal curvatures are 0 and 1 / r.

    For ``measure(of=..)``.
    """
    return Choice('PrincipalCurvature', value)



def Random(*, seed: int | Arg | Ron | None = None) -> Choice:
    """A random number from -1 to 1 for each vertex.

    The number depends only on the seed and on the id of the vertex.

    For ``displace(by=..)``.

    :param seed: The seed. A different seed gives different numbers. The same seed gives the same numbers in every step.
        Defaults to 0.
    """
    return Choice('Random', seed=seed)



def Rotate(*, axis: Literal['X', 'Y', 'Z'] | Arg | Ron, angle: float | Arg | Ron) -> Choice:
    """Rotates around an axis through the mean of the positions of the selected vertices.

    For ``move_vertices(by=..)``.

    :param axis: The direction of the axis.
        ``"X"``: The x axis.
        ``"Y"``: The y axis.
        ``"Z"``: The z axis.
    :param angle: The angle in degrees, counter-clockwise when the axis points towards the viewer.
    """
    return Choice('Rotate', axis=axis, angle=angle)



def Scale(value: Sequence[float] | NDArray[Any] | Arg | Ron, /) -> Choice:
    """Scales along x, y and z about the mean of the positions of the selected vertices.

    A factor of 0 along an axis gives all selected vertices the same coordinate along this axis.

    For ``move_vertices(by=..)``.
    """
    return Choice('Scale', value)



def Tag(value: str | Arg | Ron, /) -> Choice:
    """Two parts: the first part has the faces with the tag of this name, and the second part has all other faces.

    A part without faces is left out.

    For ``separate(by=..)``.
    """
    return Choice('Tag', value)



def Taubin(
    *,
    weights: Literal['Uniform', 'Cotangent'] | Arg | Ron | None = None,
    factor: float | Arg | Ron | None = None,
    pass_band: float | Arg | Ron | None = None,
) -> Choice:
    """Moves each vertex towards the mean of its neighbors, and then away from this mean with a slightly larger factor.

    This method removes noise, but keeps larger shapes and the volume nearly unchanged. One pass consists of both
    movements.

    For ``smooth(by=..)``.

    :param weights: The weights of the neighbors. Defaults to ``"Uniform"``.
        ``"Uniform"``: All vertices that share an edge with the vertex have the same weight.
        ``"Cotangent"``: The weights depend on the angles of the faces (cotangent weights).
    :param factor: The distance of the movement towards the mean, as a fraction of the distance from the vertex to the
        mean. From 0 to 1, exclusive. Values that would amplify noise are refused: with the default ``pass_band``, these
        are values of more than about 0.7. Defaults to 0.33.
    :param pass_band: The frequency below which shapes are kept. The frequencies of a mesh are from 0 (large shapes) to
        2 (noise between neighboring vertices). A lower value smooths more. From 0 to 1, exclusive. Defaults to 0.05.
    """
    return Choice('Taubin', weights=weights, factor=factor, pass_band=pass_band)



def To(value: Sequence[float] | NDArray[Any] | Arg | Ron, /) -> Choice:
    """Moves all selected vertices by the same offset, so that the mean of their positions becomes this point.

    For ``move_vertices(by=..)``.
    """
    return Choice('To', value)



def Winding(*, of: Mesh | str | Arg | Ron) -> Choice:
    """The winding number of another mesh around each vertex (Jacobson, Kavan, Sorkine-Hornung, 2013; Barill, Dickson,
    Schmidt, Levin, Jacobson, 2018).

    It is 1 inside, 0 outside, and between 0 and 1 near gaps of the other mesh. The error is usually below 0.001. An
    operation without ``on`` computes the winding numbers for all meshes except the other mesh itself.

    For ``measure(of=..)``.

    :param of: The mesh whose winding number is computed. For a scene or a recipe, the name of its object.
    """
    return Choice('Winding', of=of)
