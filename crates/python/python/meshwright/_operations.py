"""Every operation as a method.

Generated from the schema of the operations by `generate.py`: do not edit.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Self

from numpy.typing import NDArray

from ._progress import Progress
from ._ron import Arg, Choice, Ron

if TYPE_CHECKING:
    from ._mesh import Mesh


class SceneOperations:
    """The operations on a scene, and the steps of a recipe."""

    def _apply(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        progress: bool | Progress | None,
    ) -> Self:
        raise NotImplementedError

    def load(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        name: str | Arg | Ron | None = None,
        non_manifold: Literal['Split', 'Refuse'] | Arg | Ron | None = None,
        orientation: Literal['Orient', 'Keep'] | Arg | Ron | None = None,
        duplicates: Literal['Keep', 'Drop'] | Arg | Ron | None = None,
        degenerate: Literal['Keep', 'Drop'] | Arg | Ron | None = None,
        isolated: Literal['Keep', 'Drop'] | Arg | Ron | None = None,
        placements: Literal['Keep', 'Bake'] | Arg | Ron | None = None,
        strict: bool | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Reads the objects of a file into the scene.

        Formats: ``.obj``, ``.gltf``, ``.glb``, ``.ply``, ``.stl``, ``.off``, ``.dae``, ``.bez`` (Bezier patches),
        ``.bzc`` (a Bezier curve) and ``.mws`` (a complete scene). A file compressed with gzip has ``.gz`` after its
        extension, as in ``.obj.gz``; ``.glb`` and ``.mws`` files cannot be compressed this way. An OBJ file becomes one
        object of the scene. The objects (``o a``) and groups (``g a``) in the file become the face tags ``o="a"`` and
        ``a``. A glTF file gives an object for each mesh that a node references. The object is named after the node if
        only one node references the mesh. Unless ``placements`` is ``Bake``, the nodes, cameras, lights, skins, morph
        targets and animations of the file are kept. A COLLADA file gives an object for each node with a mesh. The
        report counts and lists the content that the scene cannot hold. Images of materials are read from files next to
        the model. A corner that repeats the previous corner is removed, and a face that still contains a vertex twice
        is left out.

        Example: ``scene.load(path="teapot.bez")``, in a recipe ``Load(path: "teapot.bez")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            folder of the recipe.
        :param name: The name for objects that have no name in the file, and for the object of an ``.mws`` file with
            only one object. If omitted, objects without a name get the name of the file without its extension, and the
            object of an ``.mws`` file keeps its name.
        :param non_manifold: What to do if more than two faces share an edge, or if the faces at a vertex form several
            groups that have no common edge. Defaults to ``"Split"``.
            ``"Split"``: Split edges and vertices until the faces form a manifold, and list the splits.
            ``"Refuse"``: Fail.
        :param orientation: What to do if neighboring faces have opposite orientations. Defaults to ``"Orient"``.
            ``"Orient"``: If possible, reverse faces so that neighbors have the same orientation, and list the reversed
                faces.
            ``"Keep"``: Keep the orientation of every face.
        :param duplicates: What to do with faces that have the same vertices as an earlier face, in either direction.
            Defaults to ``"Keep"``.
            ``"Keep"``: Keep them.
            ``"Drop"``: Leave them out, and list them.
        :param degenerate: What to do with zero-area faces. Defaults to ``"Keep"``.
            ``"Keep"``: Keep them.
            ``"Drop"``: Leave them out, and list them.
        :param isolated: What to do with vertices without a face. Defaults to ``"Keep"``.
            ``"Keep"``: Keep them.
            ``"Drop"``: Leave them out, and list them.
        :param placements: What to do with the nodes of a glTF or ``.mws`` file. If the nodes are kept, steps change a
            mesh in its own space, and each change applies to all nodes that reference the mesh. Defaults to ``"Keep"``.
            ``"Keep"``: Keep the nodes.
            ``"Bake"``: Apply the transforms of nodes to the points.
        :param strict: If true, the operation fails if anything in the file would be left out. Defaults to ``False``.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Load', {'path': path, 'name': name, 'non_manifold': non_manifold, 'orientation': orientation, 'duplicates': duplicates, 'degenerate': degenerate, 'isolated': isolated, 'placements': placements, 'strict': strict}, None, id, progress)

    def save(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        images: Literal['Embed', 'Copy', 'Keep'] | Arg | Ron | None = None,
        compress: Literal['Meshopt'] | Arg | Ron | None = None,
        quantize: Mapping[str, Any] | Arg | Ron | None = None,
        weight_sets: int | Arg | Ron | None = None,
        rows: Literal['Vertices', 'Faces', 'Corners'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Writes objects to a file.

        The extension determines the format: ``.obj``, ``.gltf``, ``.glb``, ``.ply``, ``.stl`` or ``.off`` for meshes,
        ``.bez`` for Bezier patches, ``.bzc`` for a curve, and ``.mws`` for a complete scene without any loss. ``.csv``
        is a table of the positions and attributes of vertices, faces or corners, and ``.npz`` has the arrays of a mesh
        for ``NumPy``. ``load()`` cannot read ``.csv`` and ``.npz`` files. If the name ends with ``.gz``, as in
        ``a.obj.gz``, the file is compressed with gzip. Files in the formats ``.glb``, ``.mws`` and ``.npz`` cannot be
        compressed with gzip. The report lists the content that the format cannot store. A recipe creates the file only
        if all of its steps and expectations succeed.

        Example: ``scene.save(path="a.obj")``, in a recipe ``Save(path: "a.obj")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param images: What to do with the images of materials. If omitted, images are embedded in ``.glb`` files. For
            ``.gltf`` and ``.obj``, images in the folder of the source model are copied to the folder of the output
            file. OBJ cannot embed images, so images that are embedded in the source model are also written to files.
            ``"Embed"``: Store the images in the file or, for ``.gltf``, in its ``.bin`` file.
            ``"Copy"``: Write the images to files in the folder of the written file.
            ``"Keep"``: Write only the paths of the images, as in the original model.
        :param compress: How to compress the geometry of ``.glb`` and ``.gltf`` files without loss. If omitted, the
            geometry is not compressed.
            ``"Meshopt"``: The extension ``EXT_meshopt_compression``.
        :param quantize: The number of bits for each attribute of the geometry in ``.glb`` and ``.gltf`` files. If
            omitted, numbers are stored as 32-bit floats. ``quantize={}`` uses the default number of bits for each
            attribute. The report states the largest errors of positions, of normals and tangents, and of texture
            coordinates.
            ``"position"``: The number of bits of each coordinate of a position. Positions are rounded to the points of
                a grid. The grid covers the bounding box of the object and has the same spacing along all axes. Along
                the longest side of the box, the grid has 2^bits - 1 steps. Positions of objects with joints or morph
                targets are not quantized. Defaults to 16.
            ``"normal"``: The number of bits of each of the two numbers that represent a normal or a tangent. The two
                numbers locate a point on an octahedron. Defaults to 8.
            ``"uv"``: The number of bits of each texture coordinate. A set of texture coordinates is not quantized if a
                coordinate is outside the range from 0 to 1. Defaults to 16.
            ``"color"``: The number of bits of each component of a color. Defaults to 8.
        :param weight_sets: For ``.gltf`` and ``.glb``, the number of sets of four joints that are written for each
            vertex of a skinned mesh. If omitted, the number of sets in the file from which the mesh was read, or 1 if
            this number is not known.
        :param rows: For ``.csv``, the kind of elements that the rows list. If omitted, vertices.
            ``"Vertices"``: Vertices.
            ``"Faces"``: Faces.
            ``"Corners"``: The corners of the faces, face by face.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        :warns meshwright.LossWarning: If the format cannot store some of the data. The text lists what is lost.
        """
        return self._apply('Save', {'path': path, 'images': images, 'compress': compress, 'quantize': quantize, 'weight_sets': weight_sets, 'rows': rows}, on, id, progress)

    def polygons(
        self,
        points: Sequence[Sequence[float] | NDArray[Any]] | NDArray[Any] | Arg | Ron,
        faces: Sequence[Sequence[int] | NDArray[Any]] | NDArray[Any] | Arg | Ron,
        *,
        name: str | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a mesh from points and faces.

        Point i becomes vertex i, and polygon i becomes face i. If the orientations of connected faces do not agree, the
        faces with the less frequent orientation are reversed. Faces are reversed only if all orientations then agree.
        If the faces do not form a manifold, edges and vertices are split: an edge keeps two faces with consistent
        orientations, and a vertex keeps one fan of faces. All other faces at the edge or vertex get copies of its
        vertices. The copies of vertices get the highest ids. The report and the command ``check`` list the reversed and
        split elements.

        Example: ``scene.polygons(name="new", points=[(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces=[[0, 1, 2]])``, in a
        recipe ``Polygons(name: "new", points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])``

        :param points: The points ``(x, y, z)``, in scene units. Points that no face uses become isolated vertices.
        :param faces: The faces. Each face is a list of the indices of its points, counted from 0, in counter-clockwise
            order seen from outside. A face has at least three points, without duplicates.
        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Polygons', {'name': name, 'points': points, 'faces': faces}, None, id, progress)

    def cube(
        self,
        *,
        name: str | Arg | Ron | None = None,
        size: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        triangles: bool | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a cube.

        The cube has 8 vertices and 6 squares. In the order of their ids, the squares are on the sides -z, +z, -y, +x,
        +y and -x. In the same order, the vertices of the squares are (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3,
        7, 5), (3, 2, 6, 7) and (2, 0, 4, 6). The id of a vertex is (x > center) + 2 (y > center) + 4 (z > center),
        where a true comparison counts as 1 and a false comparison as 0.

        Example: ``scene.cube(name="new", size=3, center=(1, 2, 3))``, in a recipe ``Cube(name: "new", size: 3, center:
        (1, 2, 3))``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param size: The length of the edges, in scene units. More than 0. Defaults to ``2.0``.
        :param center: The center of the cube, in scene units.
        :param triangles: Whether to cut each square (a, b, c, d) along its diagonal from a to c into the triangles (a,
            b, c) and (a, c, d). Square f becomes the faces 2 f and 2 f + 1. The diagonals of the squares are 0-3, 4-7,
            0-5, 1-7, 3-6 and 2-4. Defaults to ``False``.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Cube', {'name': name, 'size': size, 'center': center, 'triangles': triangles}, None, id, progress)

    def tetrahedron(
        self,
        *,
        name: str | Arg | Ron | None = None,
        radius: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a regular tetrahedron with 4 vertices and 4 triangles.

        The vertices are four of the eight corners of a cube with the same center. The signs of the coordinates of the
        vertices, relative to the center, are (+, +, +), (-, -, +), (-, +, -) and (+, -, -), in this order.

        Example: ``scene.tetrahedron(name="new")``, in a recipe ``Tetrahedron(name: "new")``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param radius: The distance from the center to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param center: The center of the tetrahedron, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Tetrahedron', {'name': name, 'radius': radius, 'center': center}, None, id, progress)

    def octahedron(
        self,
        *,
        name: str | Arg | Ron | None = None,
        radius: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a regular octahedron with 6 vertices and 8 triangles.

        The vertices are in the directions +x, -x, +y, -y, +z and -z from the center, in this order.

        Example: ``scene.octahedron(name="new")``, in a recipe ``Octahedron(name: "new")``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param radius: The distance from the center to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param center: The center of the octahedron, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Octahedron', {'name': name, 'radius': radius, 'center': center}, None, id, progress)

    def icosahedron(
        self,
        *,
        name: str | Arg | Ron | None = None,
        radius: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a regular icosahedron with 12 vertices and 20 triangles.

        The vertices are the corners of three rectangles with the side ratio 1 : (1 + √5) / 2, one in each coordinate
        plane.

        Example: ``scene.icosahedron(name="new")``, in a recipe ``Icosahedron(name: "new")``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param radius: The distance from the center to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param center: The center of the icosahedron, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Icosahedron', {'name': name, 'radius': radius, 'center': center}, None, id, progress)

    def grid(
        self,
        *,
        name: str | Arg | Ron | None = None,
        columns: int | Arg | Ron | None = None,
        rows: int | Arg | Ron | None = None,
        size: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a flat sheet of squares whose normals point to +z.

        The ids of vertices and faces increase along each row from -x to +x, and from row to row towards +y.

        Example: ``scene.grid(name="new", columns=3, rows=2)``, in a recipe ``Grid(name: "new", columns: 3, rows: 2)``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param columns: The number of squares along x. At least 1. Defaults to 10.
        :param rows: The number of squares along y. At least 1. Defaults to 10.
        :param size: The side length of a square, in scene units. More than 0. Defaults to ``1.0``.
        :param center: The center of the sheet, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Grid', {'name': name, 'columns': columns, 'rows': rows, 'size': size, 'center': center}, None, id, progress)

    def torus(
        self,
        *,
        name: str | Arg | Ron | None = None,
        around: int | Arg | Ron | None = None,
        across: int | Arg | Ron | None = None,
        major: float | Arg | Ron | None = None,
        minor: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a torus of quadrilaterals around the z axis.

        The vertices form ``around`` rings, one for each cross section of the tube. Each ring has ``across`` vertices.
        Vertex j of ring i has the id ``i * across + j``. Ring 0 is in the direction +x, and its vertex 0 is farthest
        from the axis.

        Example: ``scene.torus(name="new", around=7, across=5, major=2, minor=0.5)``, in a recipe ``Torus(name: "new",
        around: 7, across: 5, major: 2, minor: 0.5)``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param around: The number of faces around the z axis. At least 3. Defaults to 32.
        :param across: The number of faces around the tube. At least 3. Defaults to 16.
        :param major: The distance from the z axis to the center of the tube, in scene units. More than 0. Defaults to
            ``1.0``.
        :param minor: The radius of the tube, in scene units. More than 0. If ``minor`` is not less than ``major``, the
            tube intersects itself. Defaults to ``0.25``.
        :param center: The center of the torus, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Torus', {'name': name, 'around': around, 'across': across, 'major': major, 'minor': minor, 'center': center}, None, id, progress)

    def cylinder(
        self,
        *,
        name: str | Arg | Ron | None = None,
        around: int | Arg | Ron | None = None,
        radius: float | Arg | Ron | None = None,
        height: float | Arg | Ron | None = None,
        caps: bool | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a cylinder around the z axis.

        The vertices of the rim at -z come first, and then the vertices of the rim at +z. Each rim is counter-clockwise
        seen from +z and starts in the direction +x. The first ``around`` faces are rectangles. With ``caps``, the last
        two faces are polygons with ``around`` corners, first at -z and then at +z.

        Example: ``scene.cylinder(name="new", around=6, radius=1, height=2, caps=True)``, in a recipe ``Cylinder(name:
        "new", around: 6, radius: 1, height: 2, caps: true)``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param around: The number of sides. At least 3. Defaults to 32.
        :param radius: The distance from the axis to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param height: The height along z, in scene units. More than 0. Defaults to ``2.0``.
        :param caps: Whether the ends are closed. Defaults to ``True``.
        :param center: The center of the cylinder, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Cylinder', {'name': name, 'around': around, 'radius': radius, 'height': height, 'caps': caps, 'center': center}, None, id, progress)

    def uv_sphere(
        self,
        *,
        name: str | Arg | Ron | None = None,
        around: int | Arg | Ron | None = None,
        rings: int | Arg | Ron | None = None,
        radius: float | Arg | Ron | None = None,
        center: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Creates a sphere of meridians and rings, with poles at -z and +z.

        Vertex 0 is the pole at -z. The vertices between the poles follow, circle by circle from -z to +z. Each circle
        starts in the direction +x and is counter-clockwise seen from +z. The last vertex is the pole at +z.

        Example: ``scene.uv_sphere(name="new", around=8, rings=4, radius=2)``, in a recipe ``UvSphere(name: "new",
        around: 8, rings: 4, radius: 2)``

        :param name: The name of the new object. Defaults to the name of the operation in lower case, followed by a
            number if this name is taken.
        :param around: The number of meridians. At least 3. Defaults to 32.
        :param rings: The number of bands of faces from pole to pole. At least 2. Defaults to 16.
        :param radius: The distance from the center to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param center: The center of the sphere, in scene units.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('UvSphere', {'name': name, 'around': around, 'rings': rings, 'radius': radius, 'center': center}, None, id, progress)

    def tessellate(
        self,
        *,
        segments: int | Arg | Ron | None = None,
        faces: Literal['Triangles', 'Quads'] | Arg | Ron | None = None,
        uvs: bool | Arg | Ron | None = None,
        normals: bool | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Turns Bezier patches into a mesh.

        Acts on all objects that consist of patches, or on the objects in ``on``. Each object becomes one mesh of the
        same name. Every patch is divided into ``segments`` x ``segments`` cells. The ids of elements follow the order
        of the patches. Patches share no vertices. If two patches have the same control points on a common side, their
        vertices on this side have bitwise equal positions, so that ``weld(distance=0)`` joins the patches. A side whose
        points coincide, as at the pole of a teapot's lid, becomes one vertex. Zero-area patches give no faces. The
        report counts these patches. The mesh has UVs and normals only if they are requested.

        Example: ``scene.tessellate(segments=3)``, in a recipe ``Tessellate(segments: 3)``

        :param segments: The number of cells along each side of a patch. Defaults to ``8``.
        :param faces: The faces that a cell becomes. Defaults to ``"Triangles"``.
            ``"Triangles"``: Two triangles, divided by the diagonal from the corner with the lowest u and v.
            ``"Quads"``: One quad.
        :param uvs: Whether to store the parameters (u, v) of each patch as UVs of corners. The UVs of each patch cover
            the whole square from 0 to 1. Defaults to ``False``.
        :param normals: Whether to store the exact unit normals of the patches as vertex normals. Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Tessellate', {'segments': segments, 'faces': faces, 'uvs': uvs, 'normals': normals}, on, id, progress)

    def sample_curve(
        self,
        segments: int | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces curves with polylines whose points lie on the curves.

        Each curve becomes one polyline with ``segments`` + 1 points in the plane z = 0, at the parameters 0, 1 /
        segments, 2 / segments and so on, up to 1. The first and the last point are exactly the first and the last
        control point of the curve.

        Example: ``scene.sample_curve(segments=1)``, in a recipe ``SampleCurve(segments: 1)``

        :param segments: The number of straight segments.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('SampleCurve', {'segments': segments}, on, id, progress)

    def curve_levels(
        self,
        t: float | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces curves with the levels of de Casteljau's algorithm.

        A curve with n control points becomes n polylines in the plane z = 0. The first polyline is the control polygon
        with n points. Each of the following polylines has one point fewer than the polyline before it. The last
        polyline has a single point, the point of the curve at ``t``.

        Example: ``scene.curve_levels(t=0)``, in a recipe ``CurveLevels(t: 0)``

        :param t: The parameter of the point, from 0 (the start of the curve) to 1 (its end).
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('CurveLevels', {'t': t}, on, id, progress)

    def move_control_point(
        self,
        index: int | Arg | Ron,
        to: Sequence[float] | NDArray[Any] | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves one control point of curves.

        The other control points do not move. The point of the curve at a parameter t moves by B(t) times the offset of
        the control point, where B is the Bernstein polynomial of the control point.

        Example: ``scene.move_control_point(index=1, to=(2, -3.5))``, in a recipe ``MoveControlPoint(index: 1, to: (2,
        -3.5))``

        :param index: The index of the control point, from 0. Every curve on which the operation acts must have a
            control point with this index.
        :param to: The new position: ``(x, y)`` in the plane z = 0, in scene units.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('MoveControlPoint', {'index': index, 'to': to}, on, id, progress)

    def move_patch_point(
        self,
        index: int | Arg | Ron,
        to: Sequence[float] | NDArray[Any] | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves one control point of Bezier patches.

        Acts on all objects that consist of patches, or on the objects in ``on``. Control points of the same object that
        are at the same position move together, so that patches with a common side stay joined. The point of a patch at
        the parameters (u, v) moves by B(u) C(v) times the offset of the control point, where B and C are the Bernstein
        polynomials of its column and its row. The report counts the objects.

        Example: ``scene.move_patch_point(index=5, to=(1, 2, 0.5))``, in a recipe ``MovePatchPoint(index: 5, to: (1, 2,
        0.5))``

        :param index: The index of the control point, from 0: 16 times the index of the patch, plus 4 times the row,
            plus the column. Every object on which the operation acts must have a control point with this index.
        :param to: The new position ``(x, y, z)``, in scene units.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('MovePatchPoint', {'index': index, 'to': to}, on, id, progress)

    def copy(
        self,
        from_: str | Arg | Ron,
        to: str | Arg | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Copies an object, with its attributes and materials, under a new name.

        The copy is added after all other objects. The elements of the copy have the same ids as in the original. If
        nodes place the object, each of these nodes gets a sibling that places the copy.

        Example: ``scene.copy(from_="mesh", to="new")``, in a recipe ``Copy(from: "mesh", to: "new")``

        :param from_: The name of the object to copy.
        :param to: The name of the new object.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Copy', {'from': from_, 'to': to}, None, id, progress)

    def delete(
        self,
        objects: Sequence[str] | NDArray[Any] | Arg | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Deletes objects.

        The remaining objects keep their order. A node that places a deleted object is also removed, unless it has
        children, a camera or a light, or is a joint of a skin.

        Example: ``scene.delete(objects=["mesh"])``, in a recipe ``Delete(objects: ["mesh"])``

        :param objects: The names of the objects. All of these objects must exist.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Delete', {'objects': objects}, None, id, progress)

    def rename(
        self,
        from_: str | Arg | Ron,
        to: str | Arg | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Renames an object.

        The order of the objects does not change. If a node or mesh of the object has the same name as the object, this
        node or mesh also gets the new name.

        Example: ``scene.rename(from_="mesh", to="new")``, in a recipe ``Rename(from: "mesh", to: "new")``

        :param from_: The current name.
        :param to: The new name.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Rename', {'from': from_, 'to': to}, None, id, progress)

    def join(
        self,
        objects: Sequence[str] | NDArray[Any] | Arg | Ron,
        name: str | Arg | Ron,
        *,
        tag_parts: bool | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Joins meshes into one object.

        Each mesh becomes a part of the result. Vertices, edges and faces are numbered part by part, in the order of the
        list. The parts are not connected, even where they touch. In the scene, the result replaces the first mesh of
        the list. The other meshes of the list are removed. If nodes place a part, the result contains a copy of the
        part for each node, with the transform of the node applied to its points. If there are skinned parts, and they
        all have the same skin and one node each, the result keeps this skin and one of these nodes. If the result keeps
        a skin, the parts without a skin follow the first joint of this skin. If the result does not keep a skin, no
        node places the result. The names and default weights of morph targets are kept if they are the same for all
        parts with morph targets.

        If a part lacks an attribute that another part has, the elements of this part get the value zero. Missing
        material indices become -1 (no material). Normals are dropped and reported as lost unless all parts have them.
        If an attribute of a part has a different type than in earlier parts, the attribute of this part is dropped and
        reported as lost. Equal materials become one material.

        Example: ``scene.join(objects=["mesh", "other"], name="joined")``, in a recipe ``Join(objects: ["mesh",
        "other"], name: "joined")``

        :param objects: The names of the meshes. At least one name, without duplicates.
        :param name: The name of the result. The name of one of the meshes is allowed.
        :param tag_parts: Whether to tag the faces of each part with the name of the part, so that
            ``sel.Tagged("head")`` selects them in later operations. Defaults to ``True``.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Join', {'objects': objects, 'name': name, 'tag_parts': tag_parts}, None, id, progress)

    def separate(
        self,
        object: str | Arg | Ron,
        *,
        by: Literal['Components', 'Material'] | Choice | Arg | Ron | None = None,
        count: int | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits a mesh into several objects.

        The parts of "figure" are named "figure 1", "figure 2" and so on. The first part replaces the object, and the
        other parts are added after all other objects. Elements keep their order and their values, and every part has
        all materials. Vertices without a face are dropped. The report counts them. The operation fails if the mesh has
        no faces.

        Nodes that placed the object place the first part instead. Each of these nodes gets child nodes that place the
        other parts.

        If a connected component is divided, each of its parts gets its own copies of the edges and vertices that the
        parts shared. If the faces of a part around a vertex form several fans, each fan gets a separate copy of the
        vertex.

        Example: ``scene.separate(object="mesh")``, in a recipe ``Separate(object: "mesh")``

        :param object: The name of the mesh.
        :param by: How the faces are grouped into parts. Defaults to ``"Components"``.
            ``"Components"``: One part for each connected component, in order of the lowest face id in each component.
            ``"Material"``: One part for each material that a face has, in order of the materials.
            ``choice.Tag(..)``: The first part has the faces with the tag of this name, and the second part all other
                faces.
        :param count: The expected number of parts. The operation fails if the number of parts is not ``count``. If
            omitted, the names of the parts are not known before the recipe runs, so the object names in later
            operations cannot be checked before the run.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Separate', {'object': object, 'by': by, 'count': count}, None, id, progress)

    def transform(
        self,
        *,
        scale: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        rotate: Sequence[Mapping[str, Any]] | NDArray[Any] | Arg | Ron | None = None,
        move: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        about: Literal['Origin', 'Center'] | Choice | Arg | Ron | None = None,
        space: Literal['Scene', 'Object'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Scales, rotates and moves objects.

        Points are first scaled, then rotated, then moved. The operation changes the points of meshes, patches, curves
        and polylines. If nodes place an object and ``space`` is ``Scene``, the operation changes the placements of
        these nodes instead of the points. Everything below these nodes also moves. With ``space="Scene"``, the
        operation moves a skinned mesh by moving its joints. If the placement of a node is animated, the node gets a new
        parent, and the operation moves this parent instead. If ``space`` is ``Scene``, ``on:`` is omitted and ``about``
        is not ``Center``, all other root nodes also move, for example the nodes of cameras and lights. A curve must
        stay in the plane z = 0.

        Ids do not change. If the points of a mesh change, its normals, tangents and deltas of morph targets are also
        transformed; other attributes do not change. If the points are mirrored (one or three negative factors in
        ``scale``), the faces are also reversed, so that they stay counter-clockwise seen from outside. In a reversed
        face, the first corner stays first, and the other corners follow in reverse order. In mirrored patches, u and v
        are exchanged, so that the same side of the surface remains the outside. Like any operation that changes the
        connectivity, mirroring the points drops attributes whose edit rule is ``Drop``, such as tangents of corners.

        Example: ``scene.transform(scale=(2, 1, 1), rotate=[{"axis": "Z", "angle": 90}], move=(3, 1, 0))``, in a recipe
        ``Transform(scale: (2, 1, 1), rotate: [(axis: Z, angle: 90)], move: (3, 1, 0))``

        :param scale: The scale factors along x, y and z. Factors must not be 0. A negative factor mirrors.
        :param rotate: The rotations, applied in order.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param move: The distances to move along x, y and z, in scene units.
        :param about: The fixed point of scaling and rotation. Defaults to ``"Origin"``.
            ``"Origin"``: The origin.
            ``"Center"``: The center of the bounding box of each object.
            ``choice.Point(..)``: A point with the coordinates x, y, z.
        :param space: The coordinate system in which objects are scaled, rotated and moved. Defaults to ``"Scene"``.
            ``"Scene"``: The space of the scene.
            ``"Object"``: The space of each object.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Transform', {'scale': scale, 'rotate': rotate, 'move': move, 'about': about, 'space': space}, on, id, progress)

    def scatter(
        self,
        surface: str | Arg | Ron,
        count: int | Arg | Ron,
        *,
        object: str | Arg | Ron | None = None,
        seed: int | Arg | Ron | None = None,
        align: Literal['X', 'Y', 'Z'] | Arg | Ron | None = None,
        name: str | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Places copies of an object on a surface, at random and evenly spread.

        Exactly ``count`` points are chosen so that no two of them are close together (Yuksel, "Sample Elimination for
        Generating Poisson Disk Sample Sets", 2015). Each copy is a node that references the object (an instance), so
        copies need almost no memory, and almost no space in ``.gltf``, ``.glb`` and ``.mws`` files. The node of each
        copy moves the origin of the object to one of the points. To make one mesh of all copies, use ``join()``
        afterwards. If no node placed the object before the operation, the object then appears only at the points.

        Without ``object``, the result is a mesh that consists of the points and has no faces. The vertex normals of
        this mesh are the normals of the surface at the points.

        Example: ``scene.scatter(surface="mesh", count=20, seed=7)``, in a recipe ``Scatter(surface: "mesh", count: 20,
        seed: 7)``

        :param surface: The name of the object with the surface, which must be a mesh with a single instance.
        :param count: The number of points.
        :param object: The name of the object that is placed. If omitted, only the points are made.
        :param seed: The seed. A different seed gives different points. The same seed gives the same points on the same
            surface, in every step. Defaults to ``0``.
        :param align: The axis of the object that is aligned with the normal of the surface. If omitted, the copies are
            not rotated.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param name: Without ``object``, the name of the mesh of points. Defaults to ``points``.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Scatter', {'object': object, 'surface': surface, 'count': count, 'seed': seed, 'align': align, 'name': name}, None, id, progress)

    def weld(
        self,
        distance: float | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Merges vertices that are close together, and joins the faces at them.

        Vertices at most ``distance`` apart are linked. Vertices that are connected by a chain of links merge into one,
        even if the ends of the chain are farther apart than ``distance``. The merged vertex has the position and the
        values of the vertex with the lowest id. The other vertices are removed, so the ids of the vertices after them
        change. Edges between the same two vertices become one edge with the values of the first edge. Corner values
        stay with their corners, so UV seams are kept.

        If neighboring corners of a face merge, the face loses a corner. A face is removed if it has fewer than three
        corners left or would contain a vertex twice. Joined faces may have opposite orientations. If the orientations
        in a connected part can be made to agree, its faces form two groups of equal orientation. All faces of the
        smaller group are reversed. If faces are reversed, the report counts them, and the normals of vertices and
        corners are dropped. Where the result would still not be manifold, vertices and edges are copied. For example, a
        third face at an edge gets a copy of the edge. The report counts the copies. If no vertices merge, the mesh does
        not change.

        Example: ``scene.weld(distance=0)``, in a recipe ``Weld(distance: 0)``

        :param distance: The largest distance between linked vertices, in scene units. With 0, only vertices at equal
            positions merge.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Weld', {'distance': distance}, on, id, progress)

    def reverse(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Reverses the orientation of faces, so that their other side is the outside.

        Adjacent faces must have the same orientation, so only whole connected components can be reversed. If a selected
        face shares an edge with a face that is not selected, the operation is refused. No vertex moves, and all
        elements keep their ids. The first corner of a face stays first, and the other corners follow in reverse order.
        Normals are negated. Attributes whose edit rule is ``Drop``, such as tangents of corners, are dropped. Other
        attributes stay with their elements, and corner values stay with their vertex and face.

        Example: ``scene.reverse()``, in a recipe ``Reverse()``

        :param faces: The faces to reverse. The faces must form whole connected components. Defaults to ``"All"``.
            ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Reverse', {'faces': faces}, on, id, progress)

    def triangulate(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts polygons into triangles.

        A quadrilateral is cut along its shorter diagonal. If both diagonals have the same length, the quadrilateral is
        cut along the diagonal at its vertex with the lowest id. Two lengths count as the same if the relative
        difference of their squares is at most 1e-12. If the chosen diagonal gives a zero-area triangle, or a triangle
        that is turned over relative to the normal of the face, the other diagonal is used, unless it has the same
        problem. A quadrilateral with a reflex corner is therefore cut at that corner. If a diagonal would join two
        vertices that are already joined by an edge or by a diagonal of another face, the quadrilateral is cut along its
        other diagonal where possible. The report counts the duplicate diagonals that remain.

        A face with more than four corners is projected along its normal. The projected face is cut by ear clipping, or
        into monotone pieces if it has more than 4096 corners. Then diagonals are flipped until the triangulation is a
        constrained Delaunay triangulation. Some faces cannot be triangulated in this way: faces with zero area, faces
        whose sides cross, faces with more than 4096 corners whose sides overlap, and faces with more than ten million
        corners. A face that cannot be triangulated in this way becomes a triangle fan around its vertex with the lowest
        id. The report counts these faces.

        The triangles of a face take its place in the order of the faces and have its values. Vertices and edges keep
        their ids. The corners of the triangles have the values of the corners of the face at the same vertices.

        Example: ``scene.triangulate()``, in a recipe ``Triangulate()``

        :param faces: The faces to cut. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Triangulate', {'faces': faces}, on, id, progress)

    def flip_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        until: Literal['Once', 'Delaunay', 'Valence'] | Arg | Ron | None = None,
        passes: int | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces the edge between two triangles with the other diagonal of the quadrilateral that they form.

        Edges are flipped in order of their ids. Each flip is checked against the mesh as edited so far. A flip is
        refused if the edge is on the boundary, if the same face is on both sides of the edge, or if an end of the edge
        has only two edges. A flip is also refused if the two corners opposite to the edge are the same vertex or are
        already joined by an edge. At a seam, a flip is refused unless ``seams`` is ``Drop``. All elements keep their
        ids, and no vertex moves. Vertices, edges and faces keep their values. Each of the two faces gets one new
        corner. The new corner of a face gets its values from the corner of the other face at the same vertex. All other
        corners keep their values.

        If a face beside the edge has more than three corners, each end of the edge moves to the next corner of the
        polygon that the two faces form. With ``until="Delaunay"`` or ``until="Valence"``, such an edge is not flipped.

        With ``until="Delaunay"`` or ``until="Valence"``, an edge is flipped only if the flip improves the mesh. Edges
        are checked again, pass after pass, until a pass flips no edge or ``passes`` is reached. Flips with
        ``until="Delaunay"`` or ``until="Valence"`` neither fold the surface nor create zero-area triangles. If a flip
        that would improve the mesh is refused, the operation does not fail. An edge whose flip is refused is left
        unchanged, and the report counts the refusals by reason. The report also states the number of passes, and
        whether the operation stopped because ``passes`` was reached.

        On a surface that is not flat, a flip changes the shape. To keep creases and other edges, exclude them from
        ``edges``, for example with ``sel.Flat(below=30)`` or ``sel.Not(sel.Tagged("keep"))``.

        Example: ``scene.flip_edges(edges="All")``, in a recipe ``FlipEdges(edges: All)``

        :param edges: The edges to flip. The edges are selected before the first flip. An edge keeps its id when it is
            flipped. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param until: Which edges are flipped, and when to stop. Defaults to ``"Once"``.
            ``"Once"``: Flip each edge once.
            ``"Delaunay"``: Flip edges until no flip reduces the sum of the cotangents of all angles of all triangles.
            ``"Valence"``: Flip edges until no flip brings the valences of the vertices closer to 6, or to 4 on the
                boundary.
        :param passes: The largest number of passes over the edges. Ignored with ``until="Once"``, which makes one pass.
            Defaults to ``100``.
        :param on_refusal: What to do when a flip is refused. Ignored unless ``until`` is ``Once``. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('FlipEdges', {'edges': edges, 'until': until, 'passes': passes, 'on_refusal': on_refusal, 'seams': seams}, on, id, progress)

    def split_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        at: float | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Inserts a vertex on each edge and joins it to the opposite corners of the triangles beside the edge.

        In a mesh of triangles, a split adds 1 vertex, 3 edges and 2 faces. A split of a boundary edge adds 1 vertex, 2
        edges and 1 face. If a face beside the edge has more than three corners, the face is not cut and only gains the
        new vertex as a corner. Edges are split in order of their ids; new edges are not split again. New vertices get
        the highest ids, in the order of the splits. Attribute values at the new vertex and at its corners are
        interpolated between the ends of the edge. At a seam, the two sides are interpolated separately.

        Example: ``scene.split_edges(edges="All")``, in a recipe ``SplitEdges(edges: All)``

        :param edges: The edges to split. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the new vertex on the edge. From 0 to 1, exclusive. If ``edges`` is
            ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other selections, position 0
            is at the end of the edge with the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a split is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('SplitEdges', {'edges': edges, 'at': at, 'on_refusal': on_refusal}, on, id, progress)

    def collapse_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        at: float | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Collapses edges, so that the two ends of each edge become one vertex.

        In a mesh of triangles, a collapse removes 1 vertex, 3 edges and 2 faces. A collapse of a boundary edge removes
        1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face is not removed and
        only loses a corner. Of the two ends, the vertex with the lower id is kept. Edges are collapsed in order of
        their ids. An edge that an earlier collapse removed counts as refused.

        A collapse is refused if it would change the topology of the surface or make elements coincide:

        - ``JoinsBoundaries``: an edge inside the surface joins two boundary vertices.
        - ``Link``: the ends have a common neighbor that is not a corner of a triangle beside the edge, for example on a
          tube with three sides or at a hole with three edges.
        - ``DuplicateEdge``: a second edge joins the ends.
        - ``RepeatedVertex``: both ends are also corners of a face that is not beside the edge.
        - ``Vanishes``: around the edge, the collapse would leave no face, as for a single triangle, or only two faces
          that lie back to back, as for a tetrahedron.
        - ``SameFace``: the same face is on both sides of the edge, or would be on both sides of another edge.
        - ``SameOpposite``: the two triangles beside the edge share another edge.

        Attribute values at the remaining vertex and at its corners are interpolated between the ends of the edge. At a
        seam, the two sides are interpolated separately. When two edges become one, the remaining edge gets the larger
        of the two crease values and the tags of both edges. Normals are dropped.

        Example: ``scene.collapse_edges(edges="All", on_refusal="Skip")``, in a recipe ``CollapseEdges(edges: All,
        on_refusal: Skip)``

        :param edges: The edges to collapse. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the remaining vertex on the edge, from 0 to 1. If ``edges`` is ``sel.Between("v",
            "w")``, position 0 is at v and position 1 is at w. For all other selections, position 0 is at the end of the
            edge with the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a collapse is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('CollapseEdges', {'edges': edges, 'at': at, 'on_refusal': on_refusal}, on, id, progress)

    def dissolve_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes edges and merges the faces beside them.

        Edges are removed in order of their ids. Each removal is checked against the mesh as edited so far. Each removal
        reduces the number of edges by 1 and the number of faces by 1. Of the two faces beside the edge, the face with
        the lower id is kept, with its values. No vertex is removed or moved. To remove vertices that are left with two
        edges, use ``dissolve_vertices(vertices=sel.Valence(2))`` in a later operation. The remaining elements keep
        their order and their values but get new ids.

        An edge cannot be removed if it is on the boundary, if the same face is on both of its sides, or if one of its
        ends has only two edges. An edge also cannot be removed if its two faces have a common corner that is not an end
        of the edge. A seam edge is removed only if ``seams`` is ``Drop``.

        Example: ``scene.dissolve_edges(edges=sel.Between(0, 1))``, in a recipe ``DissolveEdges(edges: Between(0, 1))``

        :param edges: The edges to remove. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('DissolveEdges', {'edges': edges, 'on_refusal': on_refusal, 'seams': seams}, on, id, progress)

    def bevel_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        width: float | Arg | Ron | None = None,
        fraction: float | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces edges with faces of constant width.

        A selected edge and both of its ends are removed, and a new face replaces the edge. The new face extends into
        both faces beside the old edge, up to the distance ``width`` from this edge. An edge that is not selected, but
        shares an end with a selected edge, is cut near this end. If the two edges are neighboring sides of a face, the
        cut is where the distance from the selected edge is ``width``, but at most four times ``width`` from the shared
        end. Otherwise, the cut is at the distance ``width`` from the shared end. Where two selected edges are
        neighboring sides of a face, the new vertex lies inside this face. If three or more new vertices surround an old
        vertex, another new face joins them. All edges are beveled together, so a cube that is beveled at all edges
        keeps all of its symmetries.

        The ends of the edges are removed, so the ids of the vertices after them change. New vertices get the highest
        ids. Faces keep their ids. New faces get the highest ids: first the faces of edges, in order of the edges, then
        the faces of vertices. Edges get new ids.

        A new vertex has the values of the old face at its position, so textures do not change. A new face has the
        values (material, tags) of one of the old faces beside it. It is not specified which of these faces is used, but
        the choice is the same in every run. New edges have zero values (no crease, no tags). Normals are dropped.

        An edge cannot be beveled if it is on the boundary (``Boundary``), or if one of its ends has only one other edge
        and this other edge is not selected (``FewEdges``). An edge also cannot be beveled if the bevels at both ends of
        an edge would overlap (``OutsideEdge``). If the result would not be manifold, no edge is beveled
        (``NonManifold``).

        Example: ``scene.bevel_edges(edges=sel.Between(0, 2), width=0.25)``, in a recipe ``BevelEdges(edges: Between(0,
        2), width: 0.25)``

        :param edges: The edges to bevel. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param width: The distance from the beveled edge to the new edge in each of the two faces beside it, in scene
            units. Either ``width`` or ``fraction`` must be given.
        :param fraction: The width as a fraction of the length of the shortest edge that is selected or shares a vertex
            with a selected edge. From 0 to 1, exclusive.
        :param on_refusal: What to do when an edge cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('BevelEdges', {'edges': edges, 'width': width, 'fraction': fraction, 'on_refusal': on_refusal}, on, id, progress)

    def crease(
        self,
        sharpness: float | Arg | Ron,
        *,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Makes edges and vertices sharp for subdivision.

        Sets the edge attribute ``crease`` of the selected edges and the vertex attribute ``corner`` of the selected
        vertices to ``sharpness``. Elements that are not selected keep their values, or get 0 if the attribute did not
        exist before the operation. Loop and Catmull-Clark subdivision keep an edge or a vertex sharp for as many levels
        as its sharpness, and smooth it in later levels. For example, an edge with sharpness 2.5 is sharp for two levels
        and half sharp in the third level. With sharpness 10, an edge is sharp at every level. Boundary edges are always
        sharp.

        At least one of ``edges`` and ``vertices`` must be given. The geometry does not change. The report counts the
        elements whose value changed.

        Example: ``scene.crease(edges=sel.Sharp(above=40), sharpness=2.5)``, in a recipe ``Crease(edges: Sharp(above:
        40), sharpness: 2.5)``

        :param sharpness: The number of subdivision levels for which the elements stay sharp, from 0 to 10. With 0,
            creases are removed. With 10, the elements are sharp at every level.
        :param edges: The edges to change. If omitted, no edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param vertices: The vertices to change. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or
            a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Crease', {'edges': edges, 'vertices': vertices, 'sharpness': sharpness}, on, id, progress)

    def poke_faces(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        distance: float | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Inserts a vertex at the center of each face and connects it to the corners of the face.

        A face with n corners becomes n triangles. Each poked face adds 1 vertex, n edges and n - 1 faces. The first
        triangle keeps the id of the face. The other triangles and the new vertices and edges get the highest ids, in
        order of the faces. The new vertex is at the mean of the corners, moved along the normal of the face by
        ``distance``. Vertex and corner attributes that edits interpolate get, at the new vertex, the mean of their
        values at the corners. The triangles have the values of their face, and the new edges have zero values (no
        crease, no tags). If ``distance`` is not 0, normals are dropped.

        A face cannot be poked if it contains a vertex twice, if the position of the new vertex would not be finite, or
        if the mesh already has the largest supported number of elements.

        Example: ``scene.poke_faces()``, in a recipe ``PokeFaces()``

        :param faces: The faces to poke. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param distance: The distance of the new vertex from the center of the face, along the normal of the face, in
            scene units. A negative distance moves the vertex inwards. A zero-area face has no normal, so its new vertex
            is at the center. Defaults to ``0.0``.
        :param on_refusal: What to do when a face cannot be poked. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('PokeFaces', {'faces': faces, 'distance': distance, 'on_refusal': on_refusal}, on, id, progress)

    def split_faces(
        self,
        between: Sequence[Sequence[int] | NDArray[Any]] | NDArray[Any] | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts each face in two with an edge between two of its corners.

        Each pair (v, w) of vertices cuts the face that has both vertices as corners. The new edge joins the two
        vertices. Each cut adds 1 edge and 1 face. Cuts are made in the order of the list, so a face can be cut several
        times. A cut from v to w divides the face into two parts. The part to the right of the line from v to w is the
        new face, and the other part keeps the id of the old face. New edges and faces get the highest ids. Corners keep
        their values. The new face has the values of the old face, and the new edge has zero values (no crease, no
        tags).

        A cut is refused if the two vertices are the same or are already joined by an edge. A cut is also refused if no
        face has both vertices as corners, or if several faces do, because the cut would then be ambiguous.

        Example: ``scene.split_faces(between=[])``, in a recipe ``SplitFaces(between: [])``

        :param between: The cuts, as a list of pairs of vertex ids, for example ``[(0, 2), (5, 9)]``.
        :param on_refusal: What to do when a cut is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('SplitFaces', {'between': between, 'on_refusal': on_refusal}, on, id, progress)

    def delete_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        keep_vertices: bool | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes faces and leaves holes.

        All faces are removed at once, so their order does not matter. Edges left without a face are removed. Vertices
        that lose their last edge are also removed, unless ``keep_vertices`` is true. Vertices that were isolated before
        the operation are kept. The remaining elements keep their order and their values but get new ids. To delete
        edges or vertices together with their faces, select the faces with ``sel.FacesBeside("edges")`` or
        ``sel.FacesAround("vertices")``.

        The removal is refused if the remaining faces around a vertex would form several fans that meet only at that
        vertex. With ``on_refusal="Skip"``, faces are instead removed one by one, in order of their ids, in repeated
        passes until no more selected faces can be removed. The selected faces that remain are counted as refused.

        Example: ``scene.delete_faces(faces="All")``, in a recipe ``DeleteFaces(faces: All)``

        :param faces: The faces to delete. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when not all faces can be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param keep_vertices: Whether to keep vertices that are left without an edge. Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('DeleteFaces', {'faces': faces, 'on_refusal': on_refusal, 'keep_vertices': keep_vertices}, on, id, progress)

    def extrude_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
        by: Choice | Arg | Ron,
        *,
        scale: float | Arg | Ron | None = None,
        rotate: Sequence[Mapping[str, Any]] | NDArray[Any] | Arg | Ron | None = None,
        tag: str | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves faces out of the surface and connects them to their old rim with side faces.

        Selected faces that share an edge form a region and move together, with one normal and one center. A region is
        first scaled, then rotated, and then moved. The fixed point of scaling and rotation is the mean of the vertices
        of the region. Side faces with four corners are added along the rim of the region. The rim of a region consists
        of the edges with a face of the region on exactly one side. If all faces of an open sheet are extruded, the
        result is a box that is open where the sheet was. A closed region has no rim, so its faces only move. If the
        area vectors of the faces cancel each other out, as in a closed region, the region has no normal, and ``by``
        must be an ``choice.Offset``.

        The faces keep their ids, so the same selection can be extruded again in later operations, for example to grow
        an arm out of a body. Vertices and edges inside a region also keep their ids. The vertices and edges of the old
        rim do not move, and the moved faces get a new rim. New side faces get the highest ids. They are ordered by
        region (by the lowest face id of each region), then by face, and then counter-clockwise around each face from
        its first corner. The new vertices are in the same order as the side faces. Each new vertex is a copy of the
        first vertex of the corresponding side face.

        A side face has the values of the adjacent moved face (material, tags). The corners of a side face have the
        values of the corners of the moved face, so textures have no seam between the two faces. However, a side face
        shows only one line of the texture: the line along the edge of the moved face, stretched over the whole side
        face. The edges of the new rim have the values of the edges of the old rim (creases, tags). The edges between
        the old and the new rim have zero values (no crease, no tags). Normals are dropped.

        Example: ``scene.extrude_faces(faces=sel.Faces([0]), by=choice.Distance(0.5))``, in a recipe
        ``ExtrudeFaces(faces: Faces([0]), by: Distance(0.5))``

        :param faces: The faces to extrude. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param by: The distance or offset by which the faces move.
            ``choice.Distance(..)``: The distance along the normal of each region, in scene units.
            ``choice.Offset(..)``: The offset along x, y and z, in scene units.
        :param scale: The factor by which each region is scaled about its center. More than 0. Defaults to ``1.0``.
        :param rotate: Rotations of each region about its center, applied in order.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param tag: The name of a tag for the moved faces and their side faces. Faces that already have the tag keep it.
            If omitted, no faces are tagged.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('ExtrudeFaces', {'faces': faces, 'by': by, 'scale': scale, 'rotate': rotate, 'tag': tag}, on, id, progress)

    def inset_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
        fraction: float | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Shrinks faces and surrounds each face with a ring of faces.

        Each face is inset separately, even if selected faces share edges. The inner face keeps the id of the face, and
        existing vertices do not move. A face with n corners adds n vertices, 2 n edges and n faces with four corners.
        New vertices and faces get the highest ids: in order of the selected faces, and counter-clockwise around each
        face from its first corner.

        Values at a new corner or vertex are interpolated between the value at the outer corner and the mean of the
        values at all corners of the face. Textures therefore do not change. The faces of the ring have the values of
        the old face (material, tags). The edges of the inner face have the values of the outer edges. Normals are
        dropped.

        A face cannot be inset if it is on both sides of one of its edges.

        Example: ``scene.inset_faces(faces="All", fraction=0.25)``, in a recipe ``InsetFaces(faces: All, fraction:
        0.25)``

        :param faces: The faces to inset. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of each corner of the inner face on the line from the old corner to the center of
            the face. From 0 (the old corner) to 1 (the center), exclusive.
        :param on_refusal: What to do when a face cannot be inset. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('InsetFaces', {'faces': faces, 'fraction': fraction, 'on_refusal': on_refusal}, on, id, progress)

    def bevel_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
        fraction: float | Arg | Ron,
        distance: float | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Shrinks and raises faces, and surrounds each face with a ring of faces.

        Works like ``inset_faces()``, and also moves the inner face along its normal. Each face is beveled separately,
        even if selected faces share edges. The inner face keeps the id of the face, and existing vertices do not move.
        A face with n corners adds n vertices, 2 n edges and n faces with four corners. New vertices and faces get the
        highest ids: in order of the selected faces, and counter-clockwise around each face from its first corner. A
        zero-area face has no normal, so its inner face is not raised.

        Values at a new corner or vertex are interpolated between the value at the outer corner and the mean of the
        values at all corners of the face. The faces of the ring have the values of the old face (material, tags). The
        edges of the inner face have the values of the outer edges. Normals are dropped.

        A face cannot be beveled if it is on both sides of one of its edges.

        Example: ``scene.bevel_faces(faces="All", fraction=0.25, distance=0.5)``, in a recipe ``BevelFaces(faces: All,
        fraction: 0.25, distance: 0.5)``

        :param faces: The faces to bevel. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of each corner of the inner face on the line from the old corner to the center of
            the face. From 0 (the old corner) to 1 (the center), exclusive.
        :param distance: The distance by which the inner face moves along its normal, in scene units. A negative
            distance moves the inner face inwards.
        :param on_refusal: What to do when a face cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('BevelFaces', {'faces': faces, 'fraction': fraction, 'distance': distance, 'on_refusal': on_refusal}, on, id, progress)

    def dissolve_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes vertices and merges the faces around them.

        Vertices are removed in order of their ids. Each removal is checked against the mesh as edited so far. All faces
        around the vertex become one face, which has the id and the values of the face with the lowest id. If the vertex
        is on the boundary, its two boundary edges become one. If the vertex has only two edges, these edges become one
        edge, and the faces beside the edge lose a corner. When two edges become one, the edge with the lower id is
        kept, with its values. The remaining elements keep their order and their values but get new ids. Normals are
        dropped.

        A vertex cannot be removed if it is isolated or has a single edge, or if a neighbor would be left with a single
        edge inside a face. A vertex also cannot be removed if a face would contain a vertex twice or have fewer than
        three corners, or if an edge would join two vertices that are already joined. A vertex at a seam is removed only
        if ``seams`` is ``Drop``.

        Example: ``scene.dissolve_vertices(vertices=sel.Vertices([1]))``, in a recipe ``DissolveVertices(vertices:
        Vertices([1]))``

        :param vertices: The vertices to remove. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when a vertex cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('DissolveVertices', {'vertices': vertices, 'on_refusal': on_refusal, 'seams': seams}, on, id, progress)

    def bevel_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron,
        fraction: float | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces vertices with faces.

        Each edge at a selected vertex is cut near this vertex, and a new face joins the cuts. The distance of a cut
        from the vertex is a fraction of the length that the edge had before the operation. The new face has as many
        corners as the vertex had edges. If both ends of an edge are selected, the fraction must be below 0.5. For
        example, a fraction of 0.25 turns a cube into a truncated cube.

        The selected vertices are removed, so the ids of the vertices after them change. New vertices get the highest
        ids, in order of the selected vertices and clockwise around each vertex. Faces keep their ids; new faces get the
        highest ids, in order of the vertices.

        Values at the cuts are interpolated between the ends of the edge, so textures do not change. A new face has the
        values (material, tags) of one of the faces at the vertex. Which face is used is not specified, but the choice
        is the same in every run. New edges have zero values (no crease, no tags). Normals are dropped.

        A vertex cannot be beveled if it is on the boundary, if it has fewer than three edges, or if one of its edges is
        too short after earlier cuts.

        Example: ``scene.bevel_vertices(vertices="All", fraction=0.25)``, in a recipe ``BevelVertices(vertices: All,
        fraction: 0.25)``

        :param vertices: The vertices to bevel. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param fraction: The distance of the cuts from the vertex, as a fraction of the edge length. From 0 to 1,
            exclusive.
        :param on_refusal: What to do when a vertex cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('BevelVertices', {'vertices': vertices, 'fraction': fraction, 'on_refusal': on_refusal}, on, id, progress)

    def vertex_normals(
        self,
        *,
        weight: Literal['Area', 'Angle', 'Uniform'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes a unit normal for every vertex, from the faces around it.

        The normals are written to the vertex attribute ``normal``, which is replaced if it exists. Corner normals are
        removed, because they would contradict the vertex normals. A vertex that has no faces or only zero-area faces,
        or whose face normals cancel each other out, gets the zero vector. The report counts these vertices.

        Example: ``scene.vertex_normals()``, in a recipe ``VertexNormals()``

        :param weight: The weights of the faces around a vertex. Defaults to ``"Area"``.
            ``"Area"``: The area of the face.
            ``"Angle"``: The angle of the face at the vertex, at most 180 degrees.
            ``"Uniform"``: The same weight for all faces.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('VertexNormals', {'weight': weight}, on, id, progress)

    def tangents(
        self,
        *,
        uv: str | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes tangents for normal maps with the ``MikkTSpace`` algorithm, which many other tools also use.

        The mesh needs texture coordinates and normals, such as the normals that ``vertex_normals()`` computes. The
        tangents are written to the corner attribute ``tangent``, which is replaced if it exists. A tangent is a unit
        vector perpendicular to the normal, followed by the sign of the bitangent as the fourth number. ``.glb`` and
        ``.gltf`` files store the attribute as ``TANGENT``. Polygons are triangulated in the same way as for ``.glb``
        and ``.gltf`` files. Operations that change the shape or the faces remove the tangents, except a ``transform()``
        that does not mirror the points. Corners at which the texture coordinates define no direction get an arbitrary
        tangent. The report counts these corners.

        Example: ``scene.tangents()``, in a recipe ``Tangents()``

        :param uv: The name of the texture coordinates of the normal map. Defaults to ``uv``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Tangents', {'uv': uv}, on, id, progress)

    def fill_holes(
        self,
        *,
        around: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        max_edges: int | Arg | Ron | None = None,
        with_: Literal['Triangles', 'Face'] | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Covers holes with faces.

        A hole is a boundary loop: a loop of edges with a face on one side only. The outer rim of an open sheet is also
        a boundary loop; use ``around`` or ``max_edges`` to exclude it. No vertices are added, and existing elements
        keep their ids. A hole with n edges gets 1 face with n corners, or n - 2 triangles and n - 3 edges.

        For holes with up to 500 edges, the triangles have the smallest possible total area. A hole with more than 500
        edges is filled one triangle at a time. Each triangle is added at the corner whose two neighbors are closest to
        each other. Triangles at straight and reflex corners are added last. If the hole is far from convex, the
        triangles can overlap. Two vertices that are already joined by an edge are not joined by a second edge. If no
        triangulation without duplicate edges is found, the hole cannot be filled (``DuplicateEdge``). A hole with two
        edges cannot be filled (``WrongPlace``). Use ``stitch()`` to close it.

        New faces have the values of a face beside the hole. New corners have the values of the corner at the same
        vertex in the adjacent face. Normals are dropped if a hole was filled.

        Example: ``scene.fill_holes()``, in a recipe ``FillHoles()``

        :param around: Fill only holes with at least one of these vertices. Defaults to ``"All"``. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param max_edges: Fill only holes with at most this number of edges. If omitted, holes of any size.
        :param with_: The faces that cover a hole. Defaults to ``"Triangles"``.
            ``"Triangles"``: Triangles.
            ``"Face"``: One face with all vertices of the hole as corners.
        :param on_refusal: What to do when a hole cannot be filled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('FillHoles', {'around': around, 'max_edges': max_edges, 'with': with_, 'on_refusal': on_refusal}, on, id, progress)

    def bridge_loops(
        self,
        first: int | Arg | Ron,
        second: int | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Joins two holes with a band of faces.

        Each hole is identified by one of its vertices. The band starts at a new edge that joins the two given vertices,
        and goes around both holes. Holes with n and m edges, where n is at least m, are joined by m quadrilaterals and
        n - m evenly spread triangles. The operation adds n edges and no vertices. Both holes can be in one connected
        part of the mesh, which then gets a tunnel or a handle. They can also be in two separate parts of the same mesh.
        (``join()`` joins two objects into one.)

        Each new face copies the attribute values of the adjacent face at the hole with more edges. New corners have the
        values of the corners at the same vertices in the adjacent faces. Normals are dropped.

        The operation is refused if a vertex is not on the boundary (``NotBoundary``), or if both vertices are on the
        same hole (``WrongPlace``). The operation is also refused if the band would join two vertices that are already
        joined by an edge (``DuplicateEdge``). In this case, the operation can succeed with other vertices of the same
        holes.

        Example: ``scene.bridge_loops(first=0, second=5)``, in a recipe ``BridgeLoops(first: 0, second: 5)``

        :param first: The id of a vertex on the first hole.
        :param second: The id of a vertex on the second hole. A new edge joins this vertex to the vertex ``first``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('BridgeLoops', {'first': first, 'second': second}, on, id, progress)

    def stitch(
        self,
        distance: float | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Joins boundary edges that coincide.

        Two boundary edges coincide if both pairs of corresponding ends are at most ``distance`` apart. Two edges that
        coincide only with each other form a pair. Choose a ``distance`` that is less than the lengths of the edges. If
        an edge coincides with several edges, none of these edges is joined (``NonManifold``). Unlike ``weld()``, this
        operation never merges vertices inside the surface or vertices whose edges do not coincide.

        When two vertices or two edges become one, the one with the lower id is kept, with its position and values. The
        vertex or edge with the higher id is removed, so the ids of the vertices or edges after it change. Faces and
        corners do not change, so an edge whose sides have different UVs becomes a seam. Remaining holes with two edges
        are also closed.

        A pair of edges cannot be joined if both edges belong to the same face (``SameFace``), or if two edges would
        then join the same vertices (``DuplicateEdge``). A pair also cannot be joined if the ends of an edge would
        become one vertex, or if a face would contain a vertex twice (``WrongPlace``).

        Example: ``scene.stitch(distance=0)``, in a recipe ``Stitch(distance: 0)``

        :param distance: The largest distance between corresponding ends of two edges, in scene units. With 0, only ends
            at equal positions are joined.
        :param on_refusal: What to do when a pair cannot be joined, or when more than two edges coincide. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Stitch', {'distance': distance, 'on_refusal': on_refusal}, on, id, progress)

    def cut(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Opens the mesh along edges.

        The edges can form paths, loops and trees. A loop can cut out a piece. Each edge becomes two edges, one for each
        side of the cut. If the cuts separate the faces around a vertex into several parts, each part gets a separate
        copy of the vertex. The part that contains the face with the lowest id keeps the id of the vertex, and new
        vertices get the highest ids. Faces keep their ids, and no vertex moves. Copies of vertices and edges have the
        values of the originals. Corners keep their values. ``stitch()`` is the inverse.

        All edges are cut at once. An edge on the boundary cannot be cut (``Boundary``). An edge also cannot be cut if
        both of its ends are inside the mesh and no other cut continues at either end, because such a cut would not open
        the mesh (``DuplicateEdge``).

        Example: ``scene.cut(edges="All")``, in a recipe ``Cut(edges: All)``

        :param edges: The edges to cut. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be cut. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Cut', {'edges': edges, 'on_refusal': on_refusal}, on, id, progress)

    def tag_vertices(
        self,
        name: str | Arg | Ron,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected vertices and removes the tag from all other vertices. In later operations,
        ``sel.Tagged("rim")`` selects the vertices with the tag ``rim``.

        If a later operation copies a tagged vertex, as ``extrude_faces()`` does, the copy is also tagged. If a later
        operation adds a vertex on an edge, as ``split_edges()`` does, the new vertex is not tagged. An existing tag of
        the same name is replaced. If an attribute of another type has this name, the operation fails. The geometry does
        not change. The report counts the vertices that gained or lost the tag.

        Example: ``scene.tag_vertices(name="some", vertices="Boundary")``, in a recipe ``TagVertices(name: "some",
        vertices: Boundary)``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param vertices: The vertices to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``,
            ``"Isolated"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('TagVertices', {'name': name, 'vertices': vertices}, on, id, progress)

    def tag_edges(
        self,
        name: str | Arg | Ron,
        edges: Literal['All', 'Boundary'] | Choice | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected edges and removes the tag from all other edges. In later operations, ``sel.Tagged("rim")``
        selects the edges with the tag ``rim``.

        When a tagged edge is split or subdivided, its parts are also tagged. An existing tag of the same name is
        replaced. If an attribute of another type has this name, the operation fails. The geometry does not change. The
        report counts the edges that gained or lost the tag.

        Example: ``scene.tag_edges(name="marked", edges=sel.EdgeLoop(sel.Longest(count=2)))``, in a recipe
        ``TagEdges(name: "marked", edges: EdgeLoop(Longest(count: 2)))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param edges: The edges to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('TagEdges', {'name': name, 'edges': edges}, on, id, progress)

    def tag_faces(
        self,
        name: str | Arg | Ron,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron,
        *,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected faces and removes the tag from all other faces. In later operations, ``sel.Tagged("rim")``
        selects the faces with the tag ``rim``.

        When a tagged face is split or subdivided, its parts are also tagged. An existing tag of the same name is
        replaced. If an attribute of another type has this name, the operation fails. The geometry does not change. The
        report counts the faces that gained or lost the tag.

        Example: ``scene.tag_faces(name="some", faces=sel.Facing(direction=(0, 0, 1), within=45))``, in a recipe
        ``TagFaces(name: "some", faces: Facing(direction: (0, 0, 1), within: 45))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param faces: The faces to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('TagFaces', {'name': name, 'faces': faces}, on, id, progress)

    def loop_subdivide(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        weights: Literal['Warren', 'Loop'] | Arg | Ron | None = None,
        boundary: Literal['EdgesOnly', 'EdgesAndCorners', 'Fixed'] | Arg | Ron | None = None,
        creasing: Literal['Uniform', 'Chaikin'] | Arg | Ron | None = None,
        face_varying: Literal['None', 'CornersOnly', 'CornersPlus1', 'CornersPlus2', 'Boundaries', 'All'] | Arg | Ron | None = None,
        to_limit: bool | Arg | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into four and smooths the surface, for a number of levels.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. V - E
        + F does not change. Old vertices keep their ids, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed according to ``face_varying``, and seams are kept. Parts of an edge or a triangle copy the
        values of the old edge or triangle. Normals are dropped, because they would be wrong. An edge or a vertex to
        which ``crease()`` gave the sharpness s stays sharp for s levels.

        Example: ``scene.loop_subdivide(levels=2)``, in a recipe ``LoopSubdivide(levels: 2)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param weights: The weights at old vertices. Defaults to ``"Warren"``.
            ``"Warren"``: u is 3/16 for n = 3, otherwise 3/(8n).
            ``"Loop"``: u is (5/8 - (3/8 + cos(2π/n)/4)²)/n, as in Loop's thesis, 1987.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and new vertices on the boundary lie in the middle of their
                edges.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but the value of a piece with a single face does not change.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also do not change where three or more pieces meet.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also do not change at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Triangles next to the refined faces are cut in two or
            four, so that no vertex lies inside an edge. The surface outside the refined faces does not move. For the
            ids of new elements, see ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``,
            or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('LoopSubdivide', {'levels': levels, 'until': until, 'weights': weights, 'boundary': boundary, 'creasing': creasing, 'face_varying': face_varying, 'to_limit': to_limit, 'faces': faces}, on, id, progress)

    def catmull_clark(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        boundary: Literal['EdgesOnly', 'EdgesAndCorners', 'Fixed'] | Arg | Ron | None = None,
        creasing: Literal['Uniform', 'Chaikin'] | Arg | Ron | None = None,
        face_varying: Literal['None', 'CornersOnly', 'CornersPlus1', 'CornersPlus2', 'Boundaries', 'All'] | Arg | Ron | None = None,
        to_limit: bool | Arg | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every face into quads and smooths the surface, for a number of levels.

        A level creates a quad at each corner of each face. A level turns V vertices, E edges and F faces with C corners
        in total into V + E + F vertices, 2 E + C edges and C quads. V - E + F does not change. Old vertices keep their
        ids. The vertex on edge e has the id V + e, and the vertex at the center of face f has the id V + E + f. Edge e
        becomes edges 2e and 2e + 1. The quads are numbered in the order of the old faces and, in each face, in the
        order of its corners.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed according to ``face_varying``, and seams are kept. Parts of an edge or a face copy the
        values of the old edge or face. Normals are dropped, because they would be wrong. An edge or a vertex to which
        ``crease()`` gave the sharpness s stays sharp for s levels.

        Example: ``scene.catmull_clark(levels=2)``, in a recipe ``CatmullClark(levels: 2)``

        :param levels: The number of levels. Each level replaces every corner of a face with a quad. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and new vertices on the boundary lie in the middle of their
                edges.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but the value of a piece with a single face does not change.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also do not change where three or more pieces meet.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also do not change at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Faces next to the refined faces get the new vertices
            on common edges as additional corners. The surface outside the refined faces does not move. For the ids of
            new elements, see ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('CatmullClark', {'levels': levels, 'until': until, 'boundary': boundary, 'creasing': creasing, 'face_varying': face_varying, 'to_limit': to_limit, 'faces': faces}, on, id, progress)

    def midpoint(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        into: Literal['Triangles', 'Quads'] | Arg | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every face into smaller faces without moving vertices, for a number of levels.

        ``into="Triangles"`` requires a mesh of triangles. A level turns V vertices, E edges and F triangles into V + E
        vertices, 2 E + 3 F edges and 4 F triangles. ``into="Quads"`` accepts all polygons and creates a quad at each
        corner. V vertices, E edges and F faces with C corners in total become V + E + F vertices, 2 E + C edges and C
        quads. Old vertices keep their ids and positions, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1. Triangle f becomes faces 4f to 4f + 3. The quads are numbered in the order of the old
        faces. The vertex at the center of face f has the id V + E + f.

        Vertex attributes are interpolated. Corner values are interpolated within each old face separately. Parts of an
        edge or a face copy the values of the old edge or face, including sharpness. Normals are dropped.

        Example: ``scene.midpoint(levels=2, into="Quads")``, in a recipe ``Midpoint(levels: 2, into: Quads)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Defaults to 1.
            With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param into: How faces are split. Defaults to ``"Triangles"``.
            ``"Triangles"``: Splits each triangle into four.
            ``"Quads"``: Splits each face with n corners into n quads around its center.
        :param faces: The faces to refine. If omitted, all faces. With ``into="Triangles"``, triangles next to the
            refined faces are cut in two or four. With ``into="Quads"``, faces next to the refined faces get the new
            vertices on common edges as additional corners. For the ids of new elements, see
            ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Midpoint', {'levels': levels, 'until': until, 'into': into, 'faces': faces}, on, id, progress)

    def butterfly(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into four and smooths the surface without moving the old vertices, for a number of
        levels.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. V - E
        + F does not change. Old vertices keep their ids, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.

        Vertex attributes are interpolated with the same weights as the positions. Corner values are interpolated
        linearly, separately in each old triangle. Parts of an edge or a triangle copy the values of the old edge or
        triangle. Normals are dropped, because they would be wrong. Sharpness has no effect and is copied unchanged.

        Example: ``scene.butterfly(levels=1)``, in a recipe ``Butterfly(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Butterfly', {'levels': levels, 'until': until}, on, id, progress)

    def sqrt3(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into three, flips the old edges, and smooths the surface, for a number of levels.

        A level turns V vertices, E edges and F triangles into V + F vertices, E + 3 F edges and 3 F triangles. In
        addition, every second level adds one vertex and one edge for each boundary edge. V - E + F does not change. Old
        vertices keep their ids. The vertex in face f has the id V + f, and face f becomes faces 3f to 3f + 2. All faces
        must be triangles. Levels are counted from the start of the operation. One operation of two levels therefore
        cuts the boundary edges, but two operations of one level leave the boundary unchanged.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are interpolated linearly
        within each old triangle separately. A triangle next to a flipped edge covers parts of two old triangles. If the
        flipped edge was a seam, the triangle mixes texture coordinates of both sides of the seam, which distorts
        textures. New triangles copy the values of their old triangle. Parts of a boundary edge copy the values of the
        boundary edge. All other edges have zero values (no crease, no tags). Normals are dropped, because they would be
        wrong.

        Example: ``scene.sqrt3(levels=1)``, in a recipe ``Sqrt3(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by three. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Sqrt3', {'levels': levels, 'until': until}, on, id, progress)

    def doo_sabin(
        self,
        *,
        levels: int | Arg | Ron | None = None,
        until: Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces every edge and every vertex with a face and shrinks the old faces, for a number of levels.

        A level turns a closed mesh with V vertices, E edges and F faces into a mesh with 2 E vertices, 4 E edges and V
        + E + F faces. If the mesh has a boundary, a level creates additional elements along the boundary. V - E + F
        does not change. The face inside old face f has the id f, and the face of edge e has the id F + e. The faces of
        vertices have the highest ids. Isolated vertices are kept. The ids of isolated vertices follow the ids of all
        other vertices. Isolated vertices and inner vertices of valence 2 do not become faces.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are smoothed within each
        old face separately. The new faces at edges and vertices mix corner values of several old faces. At a seam, this
        distorts textures. A face inside an old face copies the values of the old face; the face of an edge or a vertex
        copies the values of an adjacent face. The two new edges along an old edge copy the values of this edge. All
        other edges have zero values (no crease, no tags). Normals are dropped, because they would be wrong.

        Example: ``scene.doo_sabin(levels=1)``, in a recipe ``DooSabin(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Defaults to 1.
            With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('DooSabin', {'levels': levels, 'until': until}, on, id, progress)

    def bisect(
        self,
        normal: Sequence[float] | NDArray[Any] | Arg | Ron,
        *,
        point: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        keep: Literal['Both', 'Front', 'Back'] | Arg | Ron | None = None,
        tag: str | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts meshes along a plane.

        Every edge that crosses the plane gets a vertex on the plane. Every face that crosses the plane is cut along the
        plane. A concave face can be cut several times. A vertex counts as on the plane if its distance from the plane
        is at most 1e-9 times the largest extent of the mesh, or at most 1e-14 times the largest absolute coordinate.
        Such a vertex is not moved. When an edge is cut, the part at the start of its first half-edge keeps the id of
        the edge. When a face is cut, the part with the first corner keeps the id of the face. New elements get the
        highest ids. Where an edge crosses the plane, attributes are interpolated. At a seam, the two sides are
        interpolated separately.

        With ``keep="Front"`` or ``keep="Back"``, the other side of the plane is removed. A face in the plane belongs to
        the back if its normal points to the front, because the face then closes the solid behind the plane. Vertices
        left without a face are removed. If the remaining faces around a vertex form several fans, each fan gets a
        separate copy of the vertex. No faces are added to close the cut. To close the cut, use ``fill_holes()`` in a
        later operation.

        Example: ``scene.bisect(normal=(0, 0, 1))``, in a recipe ``Bisect(normal: (0, 0, 1))``

        :param normal: The normal of the plane, which points to the front. The length of the normal does not matter but
            must not be 0.
        :param point: A point on the plane.
        :param keep: The side to keep. Defaults to ``"Both"``.
            ``"Both"``: Both sides.
            ``"Front"``: The side that the normal points to.
            ``"Back"``: The side that the normal points away from.
        :param tag: The name of a tag for the edges on the plane. Edges that already have the tag keep it. If omitted,
            no edges are tagged.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Bisect', {'point': point, 'normal': normal, 'keep': keep, 'tag': tag}, on, id, progress)

    def symmetrize(
        self,
        normal: Sequence[float] | NDArray[Any] | Arg | Ron,
        *,
        point: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        from_: Literal['Front', 'Back'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces one half of a mesh with the mirror image of the other half.

        The mesh is cut along a plane, as with ``bisect()``. The half on the side ``from_`` is kept and mirrored, and
        the halves are joined at the plane. Vertices near the plane (see ``bisect()``) are moved exactly onto it, so
        that the result is symmetric. Faces in the plane are removed, because they would become walls inside the result.
        Where the surface only touches the plane, the halves are not joined. The report counts the faces that are
        removed completely, not the faces that are cut.

        The elements of the kept half come first, in their old order. The elements of the mirror image follow.
        Attributes are copied, so both halves have the same texture coordinates, tags and joint weights. Normals and
        tangents are dropped.

        Example: ``scene.symmetrize(normal=(1, 0, 0))``, in a recipe ``Symmetrize(normal: (1, 0, 0))``

        :param normal: The normal of the plane, which points to the front. The length of the normal does not matter but
            must not be 0.
        :param point: A point on the plane.
        :param from_: The half that is kept and mirrored. Defaults to ``"Front"``.
            ``"Front"``: The side that the normal points to.
            ``"Back"``: The side that the normal points away from.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Symmetrize', {'point': point, 'normal': normal, 'from': from_}, on, id, progress)

    def simplify(
        self,
        *,
        faces: int | Arg | Ron | None = None,
        ratio: float | Arg | Ron | None = None,
        error: float | Arg | Ron | None = None,
        features: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        intersections: Literal['Allow', 'Refuse'] | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes triangles from meshes, and changes the surface as little as possible.

        Edges are collapsed, starting with the edges whose collapse changes the surface least. The change is measured by
        the squared distance of the new vertex to the planes of the original triangles that it replaces (Garland,
        Heckbert, 1997). The operation ends when ``faces`` or ``ratio`` is reached, or when every remaining collapse is
        refused or could exceed ``error``. At least one of ``faces``, ``ratio`` and ``error`` must be given, but not
        both ``faces`` and ``ratio``. All faces must be triangles.

        The following properties are kept:

        - Topology: holes, handles and separate parts stay.
        - Lines: the boundary, seams of texture coordinates and normals, borders between face tags or materials, edges
          with a tag or a crease, and ``features``. A line can lose vertices, but its ends, and the vertices where lines
          meet, keep their exact positions.
        - Attributes: changes of texture coordinates, normals, colors and other numbers count as changes of the surface
          (Hoppe, 1999), and new vertices get the values that fit best. Values are never mixed across a line, and no
          triangle is turned over in the texture. Normals are kept, so that a simplified mesh is shaded like the
          original. The numbers that ``measure()`` stores also count, and the report lists them. If they must not
          influence the result, use ``measure()`` after this operation.
        - Vertex tags: vertices with different tags, different sharpness, or different values of a whole-number
          attribute are not merged.

        In a texture, the border of a chart is also simplified, and can then cross a chart that is close to it. The
        report counts the faces that overlap in the texture. To leave more space between charts, use ``pack_uvs()`` with
        a larger ``padding`` before this operation.

        No triangle is turned over. Remaining elements get new ids, in the order of their old ids. If the number of
        faces cannot be reached and ``error`` is not given, the operation is refused as ``Unreached``, and the message
        states the reasons. With ``on_refusal="Skip"``, the operation keeps the mesh with the fewest faces that it
        reached.

        Example: ``scene.simplify(ratio=0.5)``, in a recipe ``Simplify(ratio: 0.5)``

        :param faces: The number of faces to reach, for each mesh. The result can have one face fewer than this number.
            A mesh that already has at most this number of faces does not change.
        :param ratio: The number of faces to reach, as a fraction of the number of faces of each mesh.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. The
            limit is guaranteed, because the operation adds up upper bounds of the distances by which the collapses move
            the surface. The true distance is usually between a third of the limit and the limit. If omitted, there is
            no limit.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param pin: Vertices that are never removed and keep their exact positions, for example ``Boundary``. If
            omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param intersections: Whether the operation is allowed to create intersections of faces. Such intersections can
            occur where parts of the surface are close together. Defaults to ``"Allow"``.
            ``"Allow"``: New intersections are allowed, and not detected.
            ``"Refuse"``: No changed face intersects another face, so a mesh without self-intersections stays without
                self-intersections.
        :param on_refusal: What to do if the number of faces cannot be reached. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Simplify', {'faces': faces, 'ratio': ratio, 'error': error, 'features': features, 'pin': pin, 'intersections': intersections, 'on_refusal': on_refusal}, on, id, progress)

    def lods(
        self,
        from_: str | Arg | Ron,
        ratios: Sequence[float] | NDArray[Any] | Arg | Ron,
        *,
        to: str | Arg | Ron | None = None,
        features: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Makes levels of detail: simplified copies of an object.

        The copies are named after the object, for example ``rock_lod1``, ``rock_lod2`` and so on. Each copy is made
        from the previous copy in the same way as with ``simplify()``, and keeps the same attributes, materials and
        lines. If nodes place the object, each of these nodes gets one sibling node for each copy. The sibling node
        places the copy.

        Example: ``scene.lods(from_="mesh", ratios=[0.5, 0.25])``, in a recipe ``Lods(from: "mesh", ratios: [0.5,
        0.25])``

        :param from_: The name of the object.
        :param ratios: The number of faces of each copy, as a fraction of the number of faces of the object. Each
            fraction must be smaller than the previous one.
        :param to: The text before the number in the names of the copies. If omitted, the name of the object followed by
            ``_lod``.
        :param features: Edges to keep as lines, in addition to the lines that ``simplify()`` always keeps. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do if the number of faces of a copy cannot be reached. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Lods', {'from': from_, 'ratios': ratios, 'to': to, 'features': features, 'on_refusal': on_refusal}, None, id, progress)

    def remesh(
        self,
        *,
        length: float | Arg | Ron | None = None,
        curvature: Mapping[str, Any] | Arg | Ron | None = None,
        features: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
        error: float | Arg | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        passes: int | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces all triangles with nearly equilateral triangles of a given size, on the same surface.

        Each pass splits long edges, collapses short edges, flips edges so that most vertices have six edges, and moves
        vertices along the surface (Botsch, Kobbelt, 2004). Most edges of the result have 4/5 to 4/3 of the target
        length. All vertices lie on the original surface, with one exception. A new vertex stays where it is if moving
        it onto the surface would turn a triangle too far or would move the surface too far. The target length of edges
        is either ``length``, or it follows ``curvature``. With ``curvature``, edges are short where the surface is
        curved, and long where it is flat (Dunyach and others, 2013). Exactly one of ``length`` and ``curvature`` must
        be given. All faces must be triangles.

        The following properties are kept:

        - Topology: holes, handles and separate parts stay.
        - Lines: the boundary, seams of texture coordinates and normals, borders between face tags or materials, edges
          with a tag or a crease, and ``features``. Vertices on a line slide along it. The ends of lines, the vertices
          where lines meet, and corners where a line turns by more than 40 degrees keep their exact positions. Other
          sharp edges are rounded.
        - Attributes: each vertex and corner gets the values of the original surface at its position. Values are never
          interpolated across a line.
        - Vertex tags: a new vertex has a tag if all old vertices around its position had the tag. A tagged vertex can
          move only inside a tagged region. A tagged vertex is inside such a region if all corners of one of its
          triangles, or both of its neighbors on a line, also have the tag. All other tagged vertices keep their exact
          positions. Vertices with sharpness also keep their exact positions.

        The number of faces depends on the area of the mesh, which is not known before the run. Therefore ``check``
        shows the largest number of faces that fits the memory budget. When the operation starts, it estimates the
        number of faces from the area. The operation fails if the estimate exceeds the memory budget.

        Edits that would turn a triangle by more than 60 degrees are refused. All elements get new ids. If the distance
        between the result and the original could exceed ``error``, the operation is refused as ``Unreached``. With
        ``on_refusal="Skip"``, a refused operation does not change the mesh.

        Example: ``scene.remesh(length=0.5)``, in a recipe ``Remesh(length: 0.5)``

        :param length: The target length of edges, in scene units.
        :param curvature: Target lengths that follow the curvature. Replaces ``length``.
            ``"error"``: The intended distance between the surface and the triangles, in scene units. It is not
                guaranteed. To guarantee a distance, use the parameter ``error`` of the operation.
            ``"min"``: The smallest target length of edges, in scene units.
            ``"max"``: The largest target length of edges, in scene units.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. To
            keep this limit, some edges can become shorter than the target length. The distance is measured at the end
            of the operation, in both directions and for all points of both surfaces. If omitted, there is no limit.
        :param pin: Vertices that keep their exact positions, for example ``Boundary``. If omitted, no vertices.
            ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param passes: The largest number of passes, from 1 to 1000. The operation ends earlier if a pass changes almost
            nothing. Defaults to 10.
        :param on_refusal: What to do if the distance between the result and the original could exceed ``error``.
            Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Remesh', {'length': length, 'curvature': curvature, 'features': features, 'error': error, 'pin': pin, 'passes': passes, 'on_refusal': on_refusal}, on, id, progress)

    def smooth(
        self,
        by: Choice | Arg | Ron,
        *,
        passes: int | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        boundary: Literal['Fixed', 'Free'] | Arg | Ron | None = None,
        keep_volume: bool | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices so that noise disappears.

        A vertex moves only if it is in ``vertices``, is not in ``pin``, and has a face. All other vertices keep their
        exact positions. Faces can have any number of corners, and degenerate faces are allowed. All elements keep their
        ids. Attributes are kept, so textures stretch with the surface, but normals and tangents are dropped.

        - ``choice.Laplacian``: strong smoothing; shrinks.
        - ``choice.Taubin``: removing noise; nearly the same.
        - ``choice.Implicit``: strong smoothing of meshes with many small faces in one pass; shrinks.
        - ``choice.Denoise``: scans of objects with flat sides and sharp edges; nearly the same.

        If ``boundary`` is ``Fixed``, vertices on the boundary do not move, so that adjacent objects still fit together.

        Example: ``scene.smooth(by=choice.Taubin())``, in a recipe ``Smooth(by: Taubin())``

        :param by: The method.
            ``choice.Laplacian(..)``: Moves each vertex towards the mean of its neighbors.
            ``choice.Taubin(..)``: Moves each vertex towards the mean of its neighbors, and then back by a slightly
                larger factor.
            ``choice.Implicit(..)``: Moves the surface by mean curvature flow for the given time, in one stable step.
            ``choice.Denoise(..)``: Filters the normals of the faces, so that similar normals become equal, then moves
                the vertices to fit the normals.
        :param passes: The number of passes. If omitted, 1 for ``choice.Implicit`` and 10 for the other methods. For
            ``choice.Denoise``, the number of passes over the normals. At most 10000.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param boundary: How vertices on the boundary move. Defaults to ``"Fixed"``.
            ``"Fixed"``: The vertices do not move.
            ``"Free"``: The boundary is smoothed as a set of curves, so the movement of a vertex on the boundary depends
                only on its neighbors along the boundary.
        :param keep_volume: Whether to restore the original volume of the mesh. To restore the volume, the operation
            finally shifts all moved vertices along their normals by the same distance. The mesh must be closed.
            Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Smooth', {'by': by, 'passes': passes, 'vertices': vertices, 'pin': pin, 'boundary': boundary, 'keep_volume': keep_volume}, on, id, progress)

    def transfer(
        self,
        from_: str | Arg | Ron,
        attributes: Sequence[str] | NDArray[Any] | Arg | Ron,
        *,
        within: float | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Copies attributes from the nearest points of another object.

        The operation copies vertex, corner and face attributes from the object ``from_`` to elements of the same kind
        in the changed mesh. Numbers and vectors of vertices and corners are interpolated inside the face that contains
        the nearest point. Whole numbers, tags, and attributes that edits do not interpolate are copied from the nearest
        corner of the face that contains the nearest point. Values of faces are copied from the face that contains the
        nearest point. If the attribute already exists with the same type of values, it is overwritten. If the attribute
        already exists with a different type of values, the operation fails. Without ``on``, a method of a scene acts on
        all meshes except ``from_``.

        All corners of a face take their values from one side of each seam, so no triangle is stretched across a seam of
        texture coordinates. Usually the corners take their values from the side that is nearest to the center of the
        face. Seams divide the source into charts. The chart that is nearest to a corner is used instead if it is much
        nearer to the whole face than the chart that is nearest to the center of the face. This happens where parts of
        the source intersect.

        Elements whose distance from the source exceeds ``within`` keep their values, or get zeros if the attribute is
        new. If the distance of a corner or of the center of a face exceeds ``within``, all corners of the face keep
        their values or get zeros. The report counts the elements that are too far away.

        Example: ``scene.transfer(from_="scan", attributes=["uv", "color"], within=0.01)``, in a recipe ``Transfer(from:
        "scan", attributes: ["uv", "color"], within: 0.01)``

        :param from_: The name of the object with the attributes.
        :param attributes: The names of the attributes, for example ``["uv", "color"]``.
        :param within: The largest distance from the source, in scene units. If omitted, there is no limit.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Transfer', {'from': from_, 'attributes': attributes, 'within': within}, on, id, progress)

    def move_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron,
        by: Choice | Arg | Ron,
        *,
        falloff: float | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        With ``falloff="r"``, vertices near the selected vertices also move. At the distance d from the nearest selected
        vertex, the movement is multiplied by the weight (1 - (d/r)²)². The weight is 1 at selected vertices and falls
        smoothly to 0 at the distance r. Distances are measured along straight lines, not along the surface.

        With ``by=choice.Distance(..)``, each vertex moves along its own normal, which is the mean of the normals of its
        faces, weighted by their areas. Vertices without a normal do not move. The report counts them.

        Example: ``scene.move_vertices(vertices=sel.Vertices([0]), by=choice.Offset((0, 0, 0.5)))``, in a recipe
        ``MoveVertices(vertices: Vertices([0]), by: Offset((0, 0, 0.5)))``

        :param vertices: The vertices to move. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param by: How the vertices move.
            ``choice.Offset(..)``: Moves by this offset along x, y and z, in scene units.
            ``choice.Distance(..)``: Moves by this distance along the normal of each vertex, in scene units.
            ``choice.To(..)``: Moves by one common offset, so that the mean of the selected vertices arrives at this
                point.
            ``choice.Rotate(..)``: Rotates around an axis through the mean of the selected vertices.
            ``choice.Scale(..)``: Scales along x, y and z about the mean of the selected vertices.
        :param falloff: The distance from the selected vertices at which the movement has fallen to 0, in scene units.
            If omitted, only the selected vertices move.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('MoveVertices', {'vertices': vertices, 'by': by, 'falloff': falloff}, on, id, progress)

    def displace(
        self,
        by: Choice | Arg | Ron,
        distance: float | Arg | Ron,
        *,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices along their normals, by amounts that vary over the surface.

        Each vertex moves along its normal by ``distance`` times the value of ``by``. The normal of a vertex is the mean
        of the normals of its faces, weighted by their areas. Vertices without a normal do not move. The report counts
        them. Normals and tangents are dropped. Faces, element ids and other attributes do not change.

        The values are computed without functions whose results differ between machines, so the result is identical on
        all machines.

        Example: ``scene.displace(by=choice.Noise(scale=0.5, seed=7), distance=0.1)``, in a recipe ``Displace(by:
        Noise(scale: 0.5, seed: 7), distance: 0.1)``

        :param by: The values by which ``distance`` is multiplied.
            ``choice.Noise(..)``: Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002).
            ``choice.Random(..)``: A random number from -1 to 1 for each vertex.
            ``choice.Attribute(..)``: A vertex attribute that holds one number for each vertex.
            ``choice.Image(..)``: The brightness of an image (a height map), from 0 (black) to 1 (white), at the texture
                coordinates of the vertex.
        :param distance: The distance that a vertex with the value 1 moves, in scene units. A negative distance moves
            the vertex inwards.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Displace', {'by': by, 'distance': distance, 'vertices': vertices}, on, id, progress)

    def bend(
        self,
        axis: Literal['X', 'Y', 'Z'] | Arg | Ron,
        angle: float | Arg | Ron,
        *,
        towards: Literal['X', 'Y', 'Z'] | Arg | Ron | None = None,
        about: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        from_: float | Arg | Ron | None = None,
        to: float | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Bends a mesh, so that an axis becomes an arc of a circle.

        Vertices at or below ``from_`` do not move. Between ``from_`` and ``to``, the axis becomes an arc of the same
        length, which turns by ``angle`` in total. Vertices above ``to`` move rigidly. Vertices between the axis and the
        center of the circle move closer together, and vertices on the other side of the axis move apart. The distance
        between the center of the circle and the axis is (to - from) / angle, with the angle in radians. Parts of the
        mesh beyond the center of the circle turn inside out. Source: Barr, "Global and Local Deformations of Solid
        Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.bend(axis="Z", angle=90)``, in a recipe ``Bend(axis: Z, angle: 90)``

        :param axis: The axis that becomes an arc.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle by which the axis turns from ``from_`` to ``to``, in degrees. A negative angle bends to
            the other side.
        :param towards: The axis towards which the upper end bends. If omitted, the axis after ``axis`` in the order x,
            y, z, x.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Bend', {'axis': axis, 'angle': angle, 'towards': towards, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, on, id, progress)

    def twist(
        self,
        axis: Literal['X', 'Y', 'Z'] | Arg | Ron,
        angle: float | Arg | Ron,
        *,
        about: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        from_: float | Arg | Ron | None = None,
        to: float | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Rotates vertices around an axis, by an angle that grows along the axis.

        The angle grows linearly from 0 at ``from_`` to ``angle`` at ``to``. Below ``from_`` and above ``to``, vertices
        rotate by the angle of the nearer end. The volume changes only because edges stay straight, so the volume of a
        fine mesh hardly changes. A twist by the opposite angle undoes a twist. Source: Barr, "Global and Local
        Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.twist(axis="Z", angle=90)``, in a recipe ``Twist(axis: Z, angle: 90)``

        :param axis: The axis of the rotation.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle at ``to``, in degrees, counter-clockwise if the axis points to the viewer.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Twist', {'axis': axis, 'angle': angle, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, on, id, progress)

    def taper(
        self,
        axis: Literal['X', 'Y', 'Z'] | Arg | Ron,
        factor: float | Arg | Ron,
        *,
        about: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        from_: float | Arg | Ron | None = None,
        to: float | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Scales vertices towards or away from an axis, by a factor that changes along the axis.

        The factor changes linearly from 1 at ``from_`` to ``factor`` at ``to``. Below ``from_`` and above ``to``, the
        factor of the nearer end applies. Coordinates along the axis do not change. Source: Barr, "Global and Local
        Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.taper(axis="Z", factor=0.5)``, in a recipe ``Taper(axis: Z, factor: 0.5)``

        :param axis: The axis. Points on the axis do not move.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param factor: The factor at ``to``. More than 0. A factor below 1 makes the upper end narrower.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Taper', {'axis': axis, 'factor': factor, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, on, id, progress)

    def lattice(
        self,
        size: Sequence[int] | NDArray[Any] | Arg | Ron,
        moves: Sequence[Sequence[Sequence[float] | NDArray[Any] | Sequence[int] | NDArray[Any]] | NDArray[Any]] | NDArray[Any] | Arg | Ron,
        *,
        min: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        max: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Deforms vertices with a box of control points.

        The box has a grid of ``size`` control points along x, y and z. ``moves`` moves some of the control points, and
        the space in the box follows smoothly. Each point in the box moves to a sum of the control points with Bernstein
        polynomials as weights (Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models", 1986). If all
        control points move by the same offset, the whole box moves by this offset. A control point attracts the
        surface, but the surface usually does not reach it, except at the corners of the box.

        Vertices outside the box do not move. Normals and tangents are dropped. Faces, element ids and other attributes
        do not change, so textures stretch with the surface. Only vertices move, so refine the mesh first if its faces
        are large.

        Example: ``scene.lattice(size=(3, 3, 3), moves=[((2, 2, 2), (0.5, 0.5, 0.5))])``, in a recipe ``Lattice(size:
        (3, 3, 3), moves: [((2, 2, 2), (0.5, 0.5, 0.5))])``

        :param size: The number of control points along x, y and z, from 2 to 16 each.
        :param moves: The control points that move: their indices along x, y and z, counted from 0, and the offset in
            scene units. A control point that is listed several times moves by the sum of its offsets.
        :param min: The lowest corner of the box. If omitted, the lowest corner of the bounding box of the mesh.
        :param max: The highest corner of the box. If omitted, the highest corner of the bounding box of the mesh.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Lattice', {'size': size, 'moves': moves, 'min': min, 'max': max, 'vertices': vertices}, on, id, progress)

    def project(
        self,
        onto: str | Arg | Ron,
        *,
        along: Literal['Nearest', 'Normal'] | Choice | Arg | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Arg | Ron | None = None,
        distance: float | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices onto the surface of another object (shrinkwrap).

        Only vertices in ``vertices`` that are not in ``pin`` move. All other vertices keep their exact positions.
        Without ``on``, a method of a scene acts on all meshes except the object ``onto``, which does not change.
        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        Vertices that would move farther than ``distance`` do not move. With ``Normal`` and ``choice.Direction``, a
        vertex moves along a line, and vertices whose line misses the surface do not move either. The report counts the
        vertices that would move too far, and the vertices whose line misses the surface.

        Example: ``scene.project(onto="scan", distance=0.1)``, in a recipe ``Project(onto: "scan", distance: 0.1)``

        :param onto: The name of the object with the surface.
        :param along: Where each vertex goes. Defaults to ``"Nearest"``.
            ``"Nearest"``: Moves to the nearest point of the surface.
            ``"Normal"``: Moves to the nearest point of the surface on the line through the vertex along its normal, on
                either side.
            ``choice.Direction(..)``: Moves to the first point of the surface in this direction.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param distance: The largest distance that a vertex moves, in scene units. If omitted, any distance.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Project', {'onto': onto, 'along': along, 'vertices': vertices, 'pin': pin, 'distance': distance}, on, id, progress)

    def measure(
        self,
        of: Literal['MeanCurvature', 'GaussianCurvature', 'Area', 'VertexArea', 'MinAngle', 'AspectRatio', 'Thickness'] | Choice | Arg | Ron,
        *,
        name: str | Arg | Ron | None = None,
        missing: float | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Stores a quantity, such as a curvature or a distance, as an attribute of vertices or faces.

        Later operations can select elements by the attribute (``sel.Where``), move vertices by it (``displace()``),
        show it in a picture (``picture()``), and save it to files (``save()``). The attribute is not updated when the
        mesh changes. Positions and other attributes do not change. Quantities are computed in the space of the mesh,
        without the transforms of nodes. The report states the lowest, the mean and the highest value of each object.

        An attribute of the same name is replaced if it belongs to the same elements (vertices or faces) and has one
        floating-point number for each element. Otherwise the operation fails.

        Example: ``scene.measure(of="MeanCurvature")``, in a recipe ``Measure(of: MeanCurvature)``

        :param of: The quantity.
            ``"MeanCurvature"``: The mean curvature at each vertex, in 1 / scene unit: 1 / r on a sphere of radius r, 1
                / (2 r) on a cylinder, and negative where the surface is concave (Cohen-Steiner, Morvan, 2003).
            ``"GaussianCurvature"``: The Gaussian curvature at each vertex, in 1 / scene unit²: the angle defect divided
                by the area of the vertex (Meyer, Desbrun, Schröder, Barr, 2003).
            ``choice.PrincipalCurvature(..)``: A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of
                the curvature tensor of Cohen-Steiner and Morvan, 2003.
            ``"Area"``: The area of each face, in scene units².
            ``"VertexArea"``: The area of each vertex, in scene units².
            ``"MinAngle"``: The smallest angle of each face, in degrees.
            ``"AspectRatio"``: The aspect ratio of each face: 1 for regular polygons, and more than 1 for all other
                polygons (Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict Geometric Quality Library", 2007).
            ``choice.Distance(..)``: The distance from each vertex to the nearest point of another mesh of the scene, in
                scene units.
            ``choice.Geodesic(..)``: The distance along the surface from each vertex to the nearest selected vertex, in
                scene units, by the heat method (Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013; Sharp, Crane,
                2020).
            ``"Thickness"``: The thickness of the solid at each vertex, in scene units.
            ``choice.Occlusion(..)``: The ambient occlusion of each vertex: the fraction of the rays from the vertex
                that meet the mesh, from 0 (open) to 1 (enclosed).
            ``choice.Winding(..)``: The winding number of another mesh of the scene around each vertex: 1 inside, 0
                outside, and numbers between 0 and 1 near gaps of the other mesh (Jacobson, Kavan, Sorkine-Hornung,
                2013; Barill, Dickson, Schmidt, Levin, Jacobson, 2018).
        :param name: The name of the attribute. If omitted, the attribute has the name of the quantity in lower case,
            such as ``mean_curvature``. For principal curvatures, the default names are ``largest_curvature`` and
            ``smallest_curvature``.
        :param missing: The value for elements at which the quantity is not defined, such as the curvature of a vertex
            without faces. The report counts these elements. If omitted, 0 for quantities that can be negative, and -1
            for all others.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Measure', {'of': of, 'name': name, 'missing': missing}, on, id, progress)

    def unwrap(
        self,
        *,
        seams: Literal['All', 'Boundary'] | Choice | Arg | Ron | None = None,
        max_angle: float | Arg | Ron | None = None,
        max_stretch: float | Arg | Ron | None = None,
        page: int | Arg | Ron | None = None,
        padding: int | Arg | Ron | None = None,
        uv: str | Arg | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes texture coordinates without overlaps.

        The surface is cut into charts, which are flattened and packed into a square page. Charts grow from flat regions
        as far as ``max_angle`` allows. The charts are flattened by least squares conformal maps (Levy and others, 2002)
        and the hybrid method of Liu and others (2008). A chart is cut again if it would overlap itself or exceed
        ``max_stretch``. It is also cut again if the ratio of the largest to the smallest stretch would exceed 1.15 on
        more than 5 % of its area. All charts of a mesh have the same scale, and no chart is mirrored. A polygon stays
        in one chart. Each mesh gets its own page, on which the charts are arranged as by ``pack_uvs()``.

        The coordinates are written to the corner attribute ``uv``, which is replaced if it exists. Edges at which
        charts meet become seams. Positions, faces and other attributes do not change, but tangents are removed.
        Zero-area faces have no area in the texture. The report counts them. If a polygon is bent so far that it
        overlaps itself in the texture, the operation is refused as ``WrongPlace``. Before this operation, triangulate
        polygons that would overlap themselves. With ``on_refusal="Skip"``, the triangles of such a polygon overlap in
        the texture.

        Example: ``scene.unwrap(max_angle=60)``, in a recipe ``Unwrap(max_angle: 60)``

        :param seams: Edges that become borders of charts, for example ``sel.Tagged("seam")`` or
            ``sel.Sharp(above=60)``. The algorithm also chooses borders itself. If omitted, the algorithm chooses all
            borders. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param max_angle: The largest angle between the normal of a face and the mean normal of its chart, in degrees.
            Smaller angles give more charts with less stretch. Defaults to ``70.0``.
        :param max_stretch: The largest ratio between the area scale of a triangle and the area scale of its whole
            chart. The area scale is the area in the texture divided by the area on the surface. Defaults to ``4.0``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for any size.
            The size only determines how large the padding is. Defaults to ``1024``.
        :param padding: The number of empty texels around each chart. The distance between two charts is at least twice
            this number. Defaults to 2.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param on_refusal: What to do if a polygon overlaps itself in the texture. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Unwrap', {'seams': seams, 'max_angle': max_angle, 'max_stretch': max_stretch, 'page': page, 'padding': padding, 'uv': uv, 'on_refusal': on_refusal}, on, id, progress)

    def pack_uvs(
        self,
        *,
        uv: str | Arg | Ron | None = None,
        page: int | Arg | Ron | None = None,
        padding: int | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves, rotates and scales charts of texture coordinates so that they do not overlap and have the same scale.

        A chart is a set of faces that are connected without seams of the texture coordinates. After the operation, the
        area of each chart in the texture is proportional to its area on the surface. The shape of each chart does not
        change, even if it is stretched, mirrored or overlaps itself. Each zero-area chart becomes a point. The report
        counts zero-area charts and charts that overlap themselves. Each mesh gets its own page, that is, the whole
        square of a texture. Tangents are removed, because charts are rotated.

        Up to 256 charts can lie in the hollows and holes of each other. More charts are packed in rows, which is much
        faster but leaves more of the page empty.

        Example: ``scene.pack_uvs(page=2048, padding=4)``, in a recipe ``PackUvs(page: 2048, padding: 4)``

        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for any size.
            The size only determines how large the padding is. Defaults to ``1024``.
        :param padding: The number of empty texels around each chart. The distance between two charts is at least twice
            this number. Defaults to 2.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('PackUvs', {'uv': uv, 'page': page, 'padding': padding}, on, id, progress)

    def picture(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        size: Sequence[int] | NDArray[Any] | Arg | Ron | None = None,
        camera: Choice | Arg | Ron | None = None,
        views: Sequence[Choice] | NDArray[Any] | Arg | Ron | None = None,
        columns: int | Arg | Ron | None = None,
        style: Mapping[str, Any] | Arg | Ron | None = None,
        highlight: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        highlight_width: float | Arg | Ron | None = None,
        marks: Sequence[Mapping[str, Any]] | NDArray[Any] | Arg | Ron | None = None,
        color_by: str | Choice | Mapping[str, Any] | Arg | Ron | None = None,
        turntable: Mapping[str, Any] | Arg | Ron | None = None,
        images: str | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the scene into an image file.

        The extension of the file determines the format. A single image has the extension ``.png``. With ``turntable``,
        ``.gif`` gives an animated GIF, and ``.apng`` or ``.png`` gives an animated PNG. The file is written only if the
        whole recipe succeeds. The scene does not change. Drawing needs no GPU and gives the same bytes on every
        machine.

        Example: ``scene.picture(path="a.png", size=(64, 48), highlight=sel.Edges(sel.Sharp(above=30)), color_by={"of":
        "Valence"}, style={"wireframe": {}})``, in a recipe ``Picture(path: "a.png", size: (64, 48), highlight:
        Edges(Sharp(above: 30)), color_by: (of: Valence), style: (wireframe: ()))``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param size: The width and the height of each view in pixels.
        :param camera: The camera.
            ``choice.Fit(..)``: Looks from a side, at the distance from which the picture shows the whole scene.
            ``choice.LookAt(..)``: Looks from one point to another point.
        :param views: Several cameras, which replace ``camera``. The views of the cameras are placed side by side.
        :param columns: The number of views in a row. If omitted, the number of views, but at most 4.
        :param style: The style: shading, lines, background.
            ``"shading"``: The lighting of surfaces.
            ``"sharp"``: The minimum angle between the normals of two faces, in degrees, at which the edge between the
                faces is shaded as sharp. This angle has no effect if the mesh has normals.
            ``"occlusion"``: The strength of ambient occlusion, which darkens hollows, from 0 (none) to 1.
            ``"background"``: The background.
            ``"color"``: The color of all surfaces. If omitted, surfaces have the colors of the scene.
            ``"back"``: The color of the back of faces. The back is visible where a mesh is open or inside out.
            ``"wireframe"``: Draws the edges of meshes, and grids on Bezier patches. Lines that are only a few pixels
                apart are thinner, so that they do not cover the surface.
            ``"boundary"``: Draws the boundary edges of meshes.
            ``"creases"``: Draws crease edges. The width of a crease grows with its sharpness, up to twice ``width``.
            ``"normals"``: Draws vertex normals as short lines. The value is the length of the lines as a fraction of
                the size of the scene.
            ``"points"``: Draws dots at all vertices of meshes and all points of polylines. The value is the diameter of
                the dots in pixels.
            ``"control_nets"``: Draws the control nets of Bezier patches and the control polygons of curves.
            ``"ids"``: Labels vertices or faces with their ids. Only small meshes can be labeled.
            ``"curve_width"``: The width of curves and polylines in pixels.
        :param highlight: Elements to highlight in orange, as in ``sel.Edges(sel.Sharp(above=30))`` or
            ``sel.Faces(sel.Tagged("top"))``. ``"All"``, ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param highlight_width: The width of highlighted edges and the diameter of highlighted vertices, in pixels. The
            default width and the default diameter depend on the shorter side of a view: 2.8 and 7.5 for 240 pixels, 3.4
            and 10 for 480, 4 and 13 for 960, 8 and 26 for 1920. If there are many highlighted vertices, they are drawn
            smaller. Hidden edges are drawn faintly, and hidden vertices as rings.
        :param marks: More selections of elements to highlight, each with its own color.
            ``"of"``: The elements.
            ``"color"``: The color.
            ``"width"``: The width of edges and the diameter of vertices, in pixels. If omitted, the defaults of
                ``highlight_width``.
        :param color_by: What the colors of the surface show: a quantity (``"Valence"``, ``"MinAngle"``, ``"Area"``,
            ``"DihedralAngle"``, ``"MeanCurvature"``, ``"GaussianCurvature"``, or a value of ``meshwright.choice``), the
            name of an attribute, or a mapping with more details.
            ``"of"``: The quantity that the colors show.
            ``"map"``: The color map. The default is ``Classes`` for valences, ``Diverging`` for curvatures, and
                ``Viridis`` for all other quantities.
            ``"range"``: The values that the first and the last color represent, as in ``(0, 60)``. If omitted, the
                range depends on the values of the quantity. For curvatures, the range is symmetric about 0. It leaves
                out the lowest and the highest eighth of the values, or fewer values if all remaining values are 0.
            ``"legend"``: Whether a legend in a corner explains the colors.
        :param turntable: If given, the picture is an animation in which the camera moves once around the scene.
            ``"frames"``: The number of images.
            ``"seconds"``: The duration of the turn.
        :param images: The folder of texture images that are not stored next to their model. The path is relative to the
            folder of the recipe. If omitted, the folder of the recipe. Missing images are not drawn, and the report
            lists them.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('Picture', {'path': path, 'size': size, 'camera': camera, 'views': views, 'columns': columns, 'style': style, 'highlight': highlight, 'highlight_width': highlight_width, 'marks': marks, 'color_by': color_by, 'turntable': turntable, 'images': images}, on, id, progress)

    def curve_figure(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        t: Sequence[float] | NDArray[Any] | Arg | Ron | None = None,
        by_level: bool | Arg | Ron | None = None,
        before: str | Arg | Ron | None = None,
        width: int | Arg | Ron | None = None,
        columns: int | Arg | Ron | None = None,
        scale: int | Arg | Ron | None = None,
        labels: bool | Arg | Ron | None = None,
        legend: bool | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws Bezier curves, and de Casteljau's construction of their points, into an image file.

        The figure has one panel for each combination of a curve and a value of ``t``. With ``by_level``, the figure has
        one panel for each combination of a curve, a value of ``t`` and a level. A panel shows the curve, its control
        polygon, every level of de Casteljau's algorithm in a different color, and the constructed point. Both axes have
        the same scale. With ``by_level``, each panel shows one level more than the previous panel for the same value of
        ``t``. Only the last panel for a value of ``t`` shows the constructed point. The extension of the file
        determines the format: ``.svg`` or ``.png``. The file is written only if the whole recipe succeeds. The scene
        does not change.

        Example: ``scene.curve_figure(path="figure.svg", t=[0.25, 0.5])``, in a recipe ``CurveFigure(path: "figure.svg",
        t: [0.25, 0.5])``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param t: The parameters of the constructed points, from 0 (start) to 1 (end). If empty, only the curves and
            their control polygons are drawn.
        :param by_level: Whether each level of the algorithm has its own panel. If false, one panel shows all levels.
            Defaults to ``False``.
        :param before: The name of a curve that shows an earlier state of the other curves. The earlier curve is drawn
            faintly behind the other curves, with arrows to the control points that moved.
        :param width: The width of the figure in SVG pixels. The font size is 12 to 19 pixels. Defaults to ``640``.
        :param columns: The number of panels in a row. If omitted, the number of values of ``t`` (with ``by_level``, the
            number of levels), but at most 4.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param labels: Whether points are labeled with their names. Defaults to ``True``.
        :param legend: Whether there is a legend below the panels. Defaults to ``True``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('CurveFigure', {'path': path, 't': t, 'by_level': by_level, 'before': before, 'width': width, 'columns': columns, 'scale': scale, 'labels': labels, 'legend': legend}, on, id, progress)

    def half_edge_figure(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Arg | Ron | None = None,
        width: int | Arg | Ron | None = None,
        scale: int | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the half-edges of some faces of a mesh into an image file.

        Each half-edge is drawn as an arrow beside its edge and inside its face, and is labeled with its name. A thin
        curve leads from the head of the arrow to the next half-edge of the face. The twin of a half-edge is on the
        other side of the edge. Half-edges on the boundary have no face and are gray. The viewer looks at the faces from
        the direction of their mean normal. Faces that face away from the viewer or are seen nearly edge-on are left
        out, and the report counts them. The extension of the file determines the format: ``.svg`` or ``.png``. The file
        is written only if the whole recipe succeeds. The scene does not change.

        The name of an element is a letter followed by the id of the element: ``v`` for vertices, ``h`` for half-edges,
        ``f`` for faces. Half-edges ``2e`` and ``2e + 1`` belong to edge ``e``.

        Example: ``scene.half_edge_figure(path="figure.svg")``, in a recipe ``HalfEdgeFigure(path: "figure.svg")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param faces: The faces to draw, at most 200. Defaults to ``"All"``. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('HalfEdgeFigure', {'path': path, 'faces': faces, 'width': width, 'scale': scale}, on, id, progress)

    def uv_picture(
        self,
        path: str | os.PathLike[str] | Arg | Ron,
        *,
        uv: str | Arg | Ron | None = None,
        fill: Literal['None', 'Charts', 'Stretch'] | Arg | Ron | None = None,
        edges: bool | Arg | Ron | None = None,
        width: int | Arg | Ron | None = None,
        scale: int | Arg | Ron | None = None,
        on: str | Sequence[str] | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the charts of the texture coordinates of a mesh into an image file.

        A gray frame shows the page of the texture, where u and v are from 0 to 1; v points upwards. Thick lines are the
        borders of charts, and thin lines are the other edges. Coordinates outside the page are also drawn. To make room
        for coordinates outside the page, the figure becomes higher or its scale becomes smaller. The extension of the
        file determines the format: ``.svg`` or ``.png``. The file is written only if the whole recipe succeeds. The
        scene does not change.

        Example: ``scene.uv_picture(path="uv.svg")``, in a recipe ``UvPicture(path: "uv.svg")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param fill: What the colors inside charts show. Defaults to ``"Charts"``.
            ``"None"``: No colors.
            ``"Charts"``: The charts, in eight colors that repeat.
            ``"Stretch"``: The stretch of angles.
        :param edges: Whether edges inside charts are drawn. Defaults to ``True``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param on: The names of the objects on which the operation acts. If omitted, all that it supports.
        :param id, progress: See :meth:`Scene.apply`.
        """
        return self._apply('UvPicture', {'path': path, 'uv': uv, 'fill': fill, 'edges': edges, 'width': width, 'scale': scale}, on, id, progress)


class MeshOperations:
    """The operations on one mesh."""

    def _apply(
        self,
        operation: str,
        fields: Mapping[str, Any],
        on: str | Sequence[str] | None,
        id: str | None,
        progress: bool | Progress | None,
    ) -> Self:
        raise NotImplementedError

    def save(
        self,
        path: str | os.PathLike[str] | Ron,
        *,
        images: Literal['Embed', 'Copy', 'Keep'] | Ron | None = None,
        compress: Literal['Meshopt'] | Ron | None = None,
        quantize: Mapping[str, Any] | Ron | None = None,
        weight_sets: int | Ron | None = None,
        rows: Literal['Vertices', 'Faces', 'Corners'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Writes objects to a file.

        The extension determines the format: ``.obj``, ``.gltf``, ``.glb``, ``.ply``, ``.stl`` or ``.off`` for meshes,
        ``.bez`` for Bezier patches, ``.bzc`` for a curve, and ``.mws`` for a complete scene without any loss. ``.csv``
        is a table of the positions and attributes of vertices, faces or corners, and ``.npz`` has the arrays of a mesh
        for ``NumPy``. ``load()`` cannot read ``.csv`` and ``.npz`` files. If the name ends with ``.gz``, as in
        ``a.obj.gz``, the file is compressed with gzip. Files in the formats ``.glb``, ``.mws`` and ``.npz`` cannot be
        compressed with gzip. The report lists the content that the format cannot store.

        Example: ``mesh.save(path="a.obj")``

        :param path: The file. A relative path is relative to the working directory.
        :param images: What to do with the images of materials. If omitted, images are embedded in ``.glb`` files. For
            ``.gltf`` and ``.obj``, images in the folder of the source model are copied to the folder of the output
            file. OBJ cannot embed images, so images that are embedded in the source model are also written to files.
            ``"Embed"``: Store the images in the file or, for ``.gltf``, in its ``.bin`` file.
            ``"Copy"``: Write the images to files in the folder of the written file.
            ``"Keep"``: Write only the paths of the images, as in the original model.
        :param compress: How to compress the geometry of ``.glb`` and ``.gltf`` files without loss. If omitted, the
            geometry is not compressed.
            ``"Meshopt"``: The extension ``EXT_meshopt_compression``.
        :param quantize: The number of bits for each attribute of the geometry in ``.glb`` and ``.gltf`` files. If
            omitted, numbers are stored as 32-bit floats. ``quantize={}`` uses the default number of bits for each
            attribute. The report states the largest errors of positions, of normals and tangents, and of texture
            coordinates.
            ``"position"``: The number of bits of each coordinate of a position. Positions are rounded to the points of
                a grid. The grid covers the bounding box of the object and has the same spacing along all axes. Along
                the longest side of the box, the grid has 2^bits - 1 steps. Positions of objects with joints or morph
                targets are not quantized. Defaults to 16.
            ``"normal"``: The number of bits of each of the two numbers that represent a normal or a tangent. The two
                numbers locate a point on an octahedron. Defaults to 8.
            ``"uv"``: The number of bits of each texture coordinate. A set of texture coordinates is not quantized if a
                coordinate is outside the range from 0 to 1. Defaults to 16.
            ``"color"``: The number of bits of each component of a color. Defaults to 8.
        :param weight_sets: For ``.gltf`` and ``.glb``, the number of sets of four joints that are written for each
            vertex of a skinned mesh. If omitted, the number of sets in the file from which the mesh was read, or 1 if
            this number is not known.
        :param rows: For ``.csv``, the kind of elements that the rows list. If omitted, vertices.
            ``"Vertices"``: Vertices.
            ``"Faces"``: Faces.
            ``"Corners"``: The corners of the faces, face by face.
        :param id, progress: See :class:`Mesh`.
        :warns meshwright.LossWarning: If the format cannot store some of the data. The text lists what is lost.
        :returns: The same mesh.
        """
        return self._apply('Save', {'path': path, 'images': images, 'compress': compress, 'quantize': quantize, 'weight_sets': weight_sets, 'rows': rows}, None, id, progress)

    def tessellate(
        self,
        *,
        segments: int | Ron | None = None,
        faces: Literal['Triangles', 'Quads'] | Ron | None = None,
        uvs: bool | Ron | None = None,
        normals: bool | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Turns Bezier patches into a mesh.

        Acts on all objects that consist of patches, or on the objects in ``on``. Each object becomes one mesh of the
        same name. Every patch is divided into ``segments`` x ``segments`` cells. The ids of elements follow the order
        of the patches. Patches share no vertices. If two patches have the same control points on a common side, their
        vertices on this side have bitwise equal positions, so that ``weld(distance=0)`` joins the patches. A side whose
        points coincide, as at the pole of a teapot's lid, becomes one vertex. Zero-area patches give no faces. The
        report counts these patches. The mesh has UVs and normals only if they are requested.

        Example: ``mesh.tessellate(segments=3)``

        :param segments: The number of cells along each side of a patch. Defaults to ``8``.
        :param faces: The faces that a cell becomes. Defaults to ``"Triangles"``.
            ``"Triangles"``: Two triangles, divided by the diagonal from the corner with the lowest u and v.
            ``"Quads"``: One quad.
        :param uvs: Whether to store the parameters (u, v) of each patch as UVs of corners. The UVs of each patch cover
            the whole square from 0 to 1. Defaults to ``False``.
        :param normals: Whether to store the exact unit normals of the patches as vertex normals. Defaults to ``False``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Tessellate', {'segments': segments, 'faces': faces, 'uvs': uvs, 'normals': normals}, None, id, progress)

    def sample_curve(
        self,
        segments: int | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces curves with polylines whose points lie on the curves.

        Each curve becomes one polyline with ``segments`` + 1 points in the plane z = 0, at the parameters 0, 1 /
        segments, 2 / segments and so on, up to 1. The first and the last point are exactly the first and the last
        control point of the curve.

        Example: ``mesh.sample_curve(segments=1)``

        :param segments: The number of straight segments.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('SampleCurve', {'segments': segments}, None, id, progress)

    def curve_levels(
        self,
        t: float | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces curves with the levels of de Casteljau's algorithm.

        A curve with n control points becomes n polylines in the plane z = 0. The first polyline is the control polygon
        with n points. Each of the following polylines has one point fewer than the polyline before it. The last
        polyline has a single point, the point of the curve at ``t``.

        Example: ``mesh.curve_levels(t=0)``

        :param t: The parameter of the point, from 0 (the start of the curve) to 1 (its end).
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('CurveLevels', {'t': t}, None, id, progress)

    def move_control_point(
        self,
        index: int | Ron,
        to: Sequence[float] | NDArray[Any] | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves one control point of curves.

        The other control points do not move. The point of the curve at a parameter t moves by B(t) times the offset of
        the control point, where B is the Bernstein polynomial of the control point.

        Example: ``mesh.move_control_point(index=1, to=(2, -3.5))``

        :param index: The index of the control point, from 0. Every curve on which the operation acts must have a
            control point with this index.
        :param to: The new position: ``(x, y)`` in the plane z = 0, in scene units.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('MoveControlPoint', {'index': index, 'to': to}, None, id, progress)

    def move_patch_point(
        self,
        index: int | Ron,
        to: Sequence[float] | NDArray[Any] | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves one control point of Bezier patches.

        Acts on all objects that consist of patches, or on the objects in ``on``. Control points of the same object that
        are at the same position move together, so that patches with a common side stay joined. The point of a patch at
        the parameters (u, v) moves by B(u) C(v) times the offset of the control point, where B and C are the Bernstein
        polynomials of its column and its row. The report counts the objects.

        Example: ``mesh.move_patch_point(index=5, to=(1, 2, 0.5))``

        :param index: The index of the control point, from 0: 16 times the index of the patch, plus 4 times the row,
            plus the column. Every object on which the operation acts must have a control point with this index.
        :param to: The new position ``(x, y, z)``, in scene units.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('MovePatchPoint', {'index': index, 'to': to}, None, id, progress)

    def transform(
        self,
        *,
        scale: Sequence[float] | NDArray[Any] | Ron | None = None,
        rotate: Sequence[Mapping[str, Any]] | NDArray[Any] | Ron | None = None,
        move: Sequence[float] | NDArray[Any] | Ron | None = None,
        about: Literal['Origin', 'Center'] | Choice | Ron | None = None,
        space: Literal['Scene', 'Object'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Scales, rotates and moves objects.

        Points are first scaled, then rotated, then moved. The operation changes the points of meshes, patches, curves
        and polylines. If nodes place an object and ``space`` is ``Scene``, the operation changes the placements of
        these nodes instead of the points. Everything below these nodes also moves. With ``space="Scene"``, the
        operation moves a skinned mesh by moving its joints. If the placement of a node is animated, the node gets a new
        parent, and the operation moves this parent instead. If ``space`` is ``Scene``, ``on:`` is omitted and ``about``
        is not ``Center``, all other root nodes also move, for example the nodes of cameras and lights. A curve must
        stay in the plane z = 0.

        Ids do not change. If the points of a mesh change, its normals, tangents and deltas of morph targets are also
        transformed; other attributes do not change. If the points are mirrored (one or three negative factors in
        ``scale``), the faces are also reversed, so that they stay counter-clockwise seen from outside. In a reversed
        face, the first corner stays first, and the other corners follow in reverse order. In mirrored patches, u and v
        are exchanged, so that the same side of the surface remains the outside. Like any operation that changes the
        connectivity, mirroring the points drops attributes whose edit rule is ``Drop``, such as tangents of corners.

        Example: ``mesh.transform(scale=(2, 1, 1), rotate=[{"axis": "Z", "angle": 90}], move=(3, 1, 0))``

        :param scale: The scale factors along x, y and z. Factors must not be 0. A negative factor mirrors.
        :param rotate: The rotations, applied in order.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param move: The distances to move along x, y and z, in scene units.
        :param about: The fixed point of scaling and rotation. Defaults to ``"Origin"``.
            ``"Origin"``: The origin.
            ``"Center"``: The center of the bounding box of each object.
            ``choice.Point(..)``: A point with the coordinates x, y, z.
        :param space: The coordinate system in which objects are scaled, rotated and moved. Defaults to ``"Scene"``.
            ``"Scene"``: The space of the scene.
            ``"Object"``: The space of each object.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Transform', {'scale': scale, 'rotate': rotate, 'move': move, 'about': about, 'space': space}, None, id, progress)

    def weld(
        self,
        distance: float | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Merges vertices that are close together, and joins the faces at them.

        Vertices at most ``distance`` apart are linked. Vertices that are connected by a chain of links merge into one,
        even if the ends of the chain are farther apart than ``distance``. The merged vertex has the position and the
        values of the vertex with the lowest id. The other vertices are removed, so the ids of the vertices after them
        change. Edges between the same two vertices become one edge with the values of the first edge. Corner values
        stay with their corners, so UV seams are kept.

        If neighboring corners of a face merge, the face loses a corner. A face is removed if it has fewer than three
        corners left or would contain a vertex twice. Joined faces may have opposite orientations. If the orientations
        in a connected part can be made to agree, its faces form two groups of equal orientation. All faces of the
        smaller group are reversed. If faces are reversed, the report counts them, and the normals of vertices and
        corners are dropped. Where the result would still not be manifold, vertices and edges are copied. For example, a
        third face at an edge gets a copy of the edge. The report counts the copies. If no vertices merge, the mesh does
        not change.

        Example: ``mesh.weld(distance=0)``

        :param distance: The largest distance between linked vertices, in scene units. With 0, only vertices at equal
            positions merge.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Weld', {'distance': distance}, None, id, progress)

    def reverse(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Reverses the orientation of faces, so that their other side is the outside.

        Adjacent faces must have the same orientation, so only whole connected components can be reversed. If a selected
        face shares an edge with a face that is not selected, the operation is refused. No vertex moves, and all
        elements keep their ids. The first corner of a face stays first, and the other corners follow in reverse order.
        Normals are negated. Attributes whose edit rule is ``Drop``, such as tangents of corners, are dropped. Other
        attributes stay with their elements, and corner values stay with their vertex and face.

        Example: ``mesh.reverse()``

        :param faces: The faces to reverse. The faces must form whole connected components. Defaults to ``"All"``.
            ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Reverse', {'faces': faces}, None, id, progress)

    def triangulate(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts polygons into triangles.

        A quadrilateral is cut along its shorter diagonal. If both diagonals have the same length, the quadrilateral is
        cut along the diagonal at its vertex with the lowest id. Two lengths count as the same if the relative
        difference of their squares is at most 1e-12. If the chosen diagonal gives a zero-area triangle, or a triangle
        that is turned over relative to the normal of the face, the other diagonal is used, unless it has the same
        problem. A quadrilateral with a reflex corner is therefore cut at that corner. If a diagonal would join two
        vertices that are already joined by an edge or by a diagonal of another face, the quadrilateral is cut along its
        other diagonal where possible. The report counts the duplicate diagonals that remain.

        A face with more than four corners is projected along its normal. The projected face is cut by ear clipping, or
        into monotone pieces if it has more than 4096 corners. Then diagonals are flipped until the triangulation is a
        constrained Delaunay triangulation. Some faces cannot be triangulated in this way: faces with zero area, faces
        whose sides cross, faces with more than 4096 corners whose sides overlap, and faces with more than ten million
        corners. A face that cannot be triangulated in this way becomes a triangle fan around its vertex with the lowest
        id. The report counts these faces.

        The triangles of a face take its place in the order of the faces and have its values. Vertices and edges keep
        their ids. The corners of the triangles have the values of the corners of the face at the same vertices.

        Example: ``mesh.triangulate()``

        :param faces: The faces to cut. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Triangulate', {'faces': faces}, None, id, progress)

    def flip_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        until: Literal['Once', 'Delaunay', 'Valence'] | Ron | None = None,
        passes: int | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces the edge between two triangles with the other diagonal of the quadrilateral that they form.

        Edges are flipped in order of their ids. Each flip is checked against the mesh as edited so far. A flip is
        refused if the edge is on the boundary, if the same face is on both sides of the edge, or if an end of the edge
        has only two edges. A flip is also refused if the two corners opposite to the edge are the same vertex or are
        already joined by an edge. At a seam, a flip is refused unless ``seams`` is ``Drop``. All elements keep their
        ids, and no vertex moves. Vertices, edges and faces keep their values. Each of the two faces gets one new
        corner. The new corner of a face gets its values from the corner of the other face at the same vertex. All other
        corners keep their values.

        If a face beside the edge has more than three corners, each end of the edge moves to the next corner of the
        polygon that the two faces form. With ``until="Delaunay"`` or ``until="Valence"``, such an edge is not flipped.

        With ``until="Delaunay"`` or ``until="Valence"``, an edge is flipped only if the flip improves the mesh. Edges
        are checked again, pass after pass, until a pass flips no edge or ``passes`` is reached. Flips with
        ``until="Delaunay"`` or ``until="Valence"`` neither fold the surface nor create zero-area triangles. If a flip
        that would improve the mesh is refused, the operation does not fail. An edge whose flip is refused is left
        unchanged, and the report counts the refusals by reason. The report also states the number of passes, and
        whether the operation stopped because ``passes`` was reached.

        On a surface that is not flat, a flip changes the shape. To keep creases and other edges, exclude them from
        ``edges``, for example with ``sel.Flat(below=30)`` or ``sel.Not(sel.Tagged("keep"))``.

        Example: ``mesh.flip_edges(edges="All")``

        :param edges: The edges to flip. The edges are selected before the first flip. An edge keeps its id when it is
            flipped. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param until: Which edges are flipped, and when to stop. Defaults to ``"Once"``.
            ``"Once"``: Flip each edge once.
            ``"Delaunay"``: Flip edges until no flip reduces the sum of the cotangents of all angles of all triangles.
            ``"Valence"``: Flip edges until no flip brings the valences of the vertices closer to 6, or to 4 on the
                boundary.
        :param passes: The largest number of passes over the edges. Ignored with ``until="Once"``, which makes one pass.
            Defaults to ``100``.
        :param on_refusal: What to do when a flip is refused. Ignored unless ``until`` is ``Once``. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('FlipEdges', {'edges': edges, 'until': until, 'passes': passes, 'on_refusal': on_refusal, 'seams': seams}, None, id, progress)

    def split_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        at: float | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Inserts a vertex on each edge and joins it to the opposite corners of the triangles beside the edge.

        In a mesh of triangles, a split adds 1 vertex, 3 edges and 2 faces. A split of a boundary edge adds 1 vertex, 2
        edges and 1 face. If a face beside the edge has more than three corners, the face is not cut and only gains the
        new vertex as a corner. Edges are split in order of their ids; new edges are not split again. New vertices get
        the highest ids, in the order of the splits. Attribute values at the new vertex and at its corners are
        interpolated between the ends of the edge. At a seam, the two sides are interpolated separately.

        Example: ``mesh.split_edges(edges="All")``

        :param edges: The edges to split. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the new vertex on the edge. From 0 to 1, exclusive. If ``edges`` is
            ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other selections, position 0
            is at the end of the edge with the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a split is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('SplitEdges', {'edges': edges, 'at': at, 'on_refusal': on_refusal}, None, id, progress)

    def collapse_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        at: float | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Collapses edges, so that the two ends of each edge become one vertex.

        In a mesh of triangles, a collapse removes 1 vertex, 3 edges and 2 faces. A collapse of a boundary edge removes
        1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face is not removed and
        only loses a corner. Of the two ends, the vertex with the lower id is kept. Edges are collapsed in order of
        their ids. An edge that an earlier collapse removed counts as refused.

        A collapse is refused if it would change the topology of the surface or make elements coincide:

        - ``JoinsBoundaries``: an edge inside the surface joins two boundary vertices.
        - ``Link``: the ends have a common neighbor that is not a corner of a triangle beside the edge, for example on a
          tube with three sides or at a hole with three edges.
        - ``DuplicateEdge``: a second edge joins the ends.
        - ``RepeatedVertex``: both ends are also corners of a face that is not beside the edge.
        - ``Vanishes``: around the edge, the collapse would leave no face, as for a single triangle, or only two faces
          that lie back to back, as for a tetrahedron.
        - ``SameFace``: the same face is on both sides of the edge, or would be on both sides of another edge.
        - ``SameOpposite``: the two triangles beside the edge share another edge.

        Attribute values at the remaining vertex and at its corners are interpolated between the ends of the edge. At a
        seam, the two sides are interpolated separately. When two edges become one, the remaining edge gets the larger
        of the two crease values and the tags of both edges. Normals are dropped.

        Example: ``mesh.collapse_edges(edges="All", on_refusal="Skip")``

        :param edges: The edges to collapse. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the remaining vertex on the edge, from 0 to 1. If ``edges`` is ``sel.Between("v",
            "w")``, position 0 is at v and position 1 is at w. For all other selections, position 0 is at the end of the
            edge with the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a collapse is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('CollapseEdges', {'edges': edges, 'at': at, 'on_refusal': on_refusal}, None, id, progress)

    def dissolve_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes edges and merges the faces beside them.

        Edges are removed in order of their ids. Each removal is checked against the mesh as edited so far. Each removal
        reduces the number of edges by 1 and the number of faces by 1. Of the two faces beside the edge, the face with
        the lower id is kept, with its values. No vertex is removed or moved. To remove vertices that are left with two
        edges, use ``dissolve_vertices(vertices=sel.Valence(2))`` in a later operation. The remaining elements keep
        their order and their values but get new ids.

        An edge cannot be removed if it is on the boundary, if the same face is on both of its sides, or if one of its
        ends has only two edges. An edge also cannot be removed if its two faces have a common corner that is not an end
        of the edge. A seam edge is removed only if ``seams`` is ``Drop``.

        Example: ``mesh.dissolve_edges(edges=sel.Between(0, 1))``

        :param edges: The edges to remove. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('DissolveEdges', {'edges': edges, 'on_refusal': on_refusal, 'seams': seams}, None, id, progress)

    def bevel_edges(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        width: float | Ron | None = None,
        fraction: float | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces edges with faces of constant width.

        A selected edge and both of its ends are removed, and a new face replaces the edge. The new face extends into
        both faces beside the old edge, up to the distance ``width`` from this edge. An edge that is not selected, but
        shares an end with a selected edge, is cut near this end. If the two edges are neighboring sides of a face, the
        cut is where the distance from the selected edge is ``width``, but at most four times ``width`` from the shared
        end. Otherwise, the cut is at the distance ``width`` from the shared end. Where two selected edges are
        neighboring sides of a face, the new vertex lies inside this face. If three or more new vertices surround an old
        vertex, another new face joins them. All edges are beveled together, so a cube that is beveled at all edges
        keeps all of its symmetries.

        The ends of the edges are removed, so the ids of the vertices after them change. New vertices get the highest
        ids. Faces keep their ids. New faces get the highest ids: first the faces of edges, in order of the edges, then
        the faces of vertices. Edges get new ids.

        A new vertex has the values of the old face at its position, so textures do not change. A new face has the
        values (material, tags) of one of the old faces beside it. It is not specified which of these faces is used, but
        the choice is the same in every run. New edges have zero values (no crease, no tags). Normals are dropped.

        An edge cannot be beveled if it is on the boundary (``Boundary``), or if one of its ends has only one other edge
        and this other edge is not selected (``FewEdges``). An edge also cannot be beveled if the bevels at both ends of
        an edge would overlap (``OutsideEdge``). If the result would not be manifold, no edge is beveled
        (``NonManifold``).

        Example: ``mesh.bevel_edges(edges=sel.Between(0, 2), width=0.25)``

        :param edges: The edges to bevel. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param width: The distance from the beveled edge to the new edge in each of the two faces beside it, in scene
            units. Either ``width`` or ``fraction`` must be given.
        :param fraction: The width as a fraction of the length of the shortest edge that is selected or shares a vertex
            with a selected edge. From 0 to 1, exclusive.
        :param on_refusal: What to do when an edge cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('BevelEdges', {'edges': edges, 'width': width, 'fraction': fraction, 'on_refusal': on_refusal}, None, id, progress)

    def crease(
        self,
        sharpness: float | Ron,
        *,
        edges: Literal['All', 'Boundary'] | Choice | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Makes edges and vertices sharp for subdivision.

        Sets the edge attribute ``crease`` of the selected edges and the vertex attribute ``corner`` of the selected
        vertices to ``sharpness``. Elements that are not selected keep their values, or get 0 if the attribute did not
        exist before the operation. Loop and Catmull-Clark subdivision keep an edge or a vertex sharp for as many levels
        as its sharpness, and smooth it in later levels. For example, an edge with sharpness 2.5 is sharp for two levels
        and half sharp in the third level. With sharpness 10, an edge is sharp at every level. Boundary edges are always
        sharp.

        At least one of ``edges`` and ``vertices`` must be given. The geometry does not change. The report counts the
        elements whose value changed.

        Example: ``mesh.crease(edges=sel.Sharp(above=40), sharpness=2.5)``

        :param sharpness: The number of subdivision levels for which the elements stay sharp, from 0 to 10. With 0,
            creases are removed. With 10, the elements are sharp at every level.
        :param edges: The edges to change. If omitted, no edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param vertices: The vertices to change. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or
            a value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Crease', {'edges': edges, 'vertices': vertices, 'sharpness': sharpness}, None, id, progress)

    def poke_faces(
        self,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        distance: float | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Inserts a vertex at the center of each face and connects it to the corners of the face.

        A face with n corners becomes n triangles. Each poked face adds 1 vertex, n edges and n - 1 faces. The first
        triangle keeps the id of the face. The other triangles and the new vertices and edges get the highest ids, in
        order of the faces. The new vertex is at the mean of the corners, moved along the normal of the face by
        ``distance``. Vertex and corner attributes that edits interpolate get, at the new vertex, the mean of their
        values at the corners. The triangles have the values of their face, and the new edges have zero values (no
        crease, no tags). If ``distance`` is not 0, normals are dropped.

        A face cannot be poked if it contains a vertex twice, if the position of the new vertex would not be finite, or
        if the mesh already has the largest supported number of elements.

        Example: ``mesh.poke_faces()``

        :param faces: The faces to poke. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param distance: The distance of the new vertex from the center of the face, along the normal of the face, in
            scene units. A negative distance moves the vertex inwards. A zero-area face has no normal, so its new vertex
            is at the center. Defaults to ``0.0``.
        :param on_refusal: What to do when a face cannot be poked. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('PokeFaces', {'faces': faces, 'distance': distance, 'on_refusal': on_refusal}, None, id, progress)

    def split_faces(
        self,
        between: Sequence[Sequence[int] | NDArray[Any]] | NDArray[Any] | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts each face in two with an edge between two of its corners.

        Each pair (v, w) of vertices cuts the face that has both vertices as corners. The new edge joins the two
        vertices. Each cut adds 1 edge and 1 face. Cuts are made in the order of the list, so a face can be cut several
        times. A cut from v to w divides the face into two parts. The part to the right of the line from v to w is the
        new face, and the other part keeps the id of the old face. New edges and faces get the highest ids. Corners keep
        their values. The new face has the values of the old face, and the new edge has zero values (no crease, no
        tags).

        A cut is refused if the two vertices are the same or are already joined by an edge. A cut is also refused if no
        face has both vertices as corners, or if several faces do, because the cut would then be ambiguous.

        Example: ``mesh.split_faces(between=[])``

        :param between: The cuts, as a list of pairs of vertex ids, for example ``[(0, 2), (5, 9)]``.
        :param on_refusal: What to do when a cut is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('SplitFaces', {'between': between, 'on_refusal': on_refusal}, None, id, progress)

    def delete_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        keep_vertices: bool | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes faces and leaves holes.

        All faces are removed at once, so their order does not matter. Edges left without a face are removed. Vertices
        that lose their last edge are also removed, unless ``keep_vertices`` is true. Vertices that were isolated before
        the operation are kept. The remaining elements keep their order and their values but get new ids. To delete
        edges or vertices together with their faces, select the faces with ``sel.FacesBeside("edges")`` or
        ``sel.FacesAround("vertices")``.

        The removal is refused if the remaining faces around a vertex would form several fans that meet only at that
        vertex. With ``on_refusal="Skip"``, faces are instead removed one by one, in order of their ids, in repeated
        passes until no more selected faces can be removed. The selected faces that remain are counted as refused.

        Example: ``mesh.delete_faces(faces="All")``

        :param faces: The faces to delete. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when not all faces can be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param keep_vertices: Whether to keep vertices that are left without an edge. Defaults to ``False``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('DeleteFaces', {'faces': faces, 'on_refusal': on_refusal, 'keep_vertices': keep_vertices}, None, id, progress)

    def extrude_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron,
        by: Choice | Ron,
        *,
        scale: float | Ron | None = None,
        rotate: Sequence[Mapping[str, Any]] | NDArray[Any] | Ron | None = None,
        tag: str | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves faces out of the surface and connects them to their old rim with side faces.

        Selected faces that share an edge form a region and move together, with one normal and one center. A region is
        first scaled, then rotated, and then moved. The fixed point of scaling and rotation is the mean of the vertices
        of the region. Side faces with four corners are added along the rim of the region. The rim of a region consists
        of the edges with a face of the region on exactly one side. If all faces of an open sheet are extruded, the
        result is a box that is open where the sheet was. A closed region has no rim, so its faces only move. If the
        area vectors of the faces cancel each other out, as in a closed region, the region has no normal, and ``by``
        must be an ``choice.Offset``.

        The faces keep their ids, so the same selection can be extruded again in later operations, for example to grow
        an arm out of a body. Vertices and edges inside a region also keep their ids. The vertices and edges of the old
        rim do not move, and the moved faces get a new rim. New side faces get the highest ids. They are ordered by
        region (by the lowest face id of each region), then by face, and then counter-clockwise around each face from
        its first corner. The new vertices are in the same order as the side faces. Each new vertex is a copy of the
        first vertex of the corresponding side face.

        A side face has the values of the adjacent moved face (material, tags). The corners of a side face have the
        values of the corners of the moved face, so textures have no seam between the two faces. However, a side face
        shows only one line of the texture: the line along the edge of the moved face, stretched over the whole side
        face. The edges of the new rim have the values of the edges of the old rim (creases, tags). The edges between
        the old and the new rim have zero values (no crease, no tags). Normals are dropped.

        Example: ``mesh.extrude_faces(faces=sel.Faces([0]), by=choice.Distance(0.5))``

        :param faces: The faces to extrude. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param by: The distance or offset by which the faces move.
            ``choice.Distance(..)``: The distance along the normal of each region, in scene units.
            ``choice.Offset(..)``: The offset along x, y and z, in scene units.
        :param scale: The factor by which each region is scaled about its center. More than 0. Defaults to ``1.0``.
        :param rotate: Rotations of each region about its center, applied in order.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param tag: The name of a tag for the moved faces and their side faces. Faces that already have the tag keep it.
            If omitted, no faces are tagged.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('ExtrudeFaces', {'faces': faces, 'by': by, 'scale': scale, 'rotate': rotate, 'tag': tag}, None, id, progress)

    def inset_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron,
        fraction: float | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Shrinks faces and surrounds each face with a ring of faces.

        Each face is inset separately, even if selected faces share edges. The inner face keeps the id of the face, and
        existing vertices do not move. A face with n corners adds n vertices, 2 n edges and n faces with four corners.
        New vertices and faces get the highest ids: in order of the selected faces, and counter-clockwise around each
        face from its first corner.

        Values at a new corner or vertex are interpolated between the value at the outer corner and the mean of the
        values at all corners of the face. Textures therefore do not change. The faces of the ring have the values of
        the old face (material, tags). The edges of the inner face have the values of the outer edges. Normals are
        dropped.

        A face cannot be inset if it is on both sides of one of its edges.

        Example: ``mesh.inset_faces(faces="All", fraction=0.25)``

        :param faces: The faces to inset. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of each corner of the inner face on the line from the old corner to the center of
            the face. From 0 (the old corner) to 1 (the center), exclusive.
        :param on_refusal: What to do when a face cannot be inset. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('InsetFaces', {'faces': faces, 'fraction': fraction, 'on_refusal': on_refusal}, None, id, progress)

    def bevel_faces(
        self,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron,
        fraction: float | Ron,
        distance: float | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Shrinks and raises faces, and surrounds each face with a ring of faces.

        Works like ``inset_faces()``, and also moves the inner face along its normal. Each face is beveled separately,
        even if selected faces share edges. The inner face keeps the id of the face, and existing vertices do not move.
        A face with n corners adds n vertices, 2 n edges and n faces with four corners. New vertices and faces get the
        highest ids: in order of the selected faces, and counter-clockwise around each face from its first corner. A
        zero-area face has no normal, so its inner face is not raised.

        Values at a new corner or vertex are interpolated between the value at the outer corner and the mean of the
        values at all corners of the face. The faces of the ring have the values of the old face (material, tags). The
        edges of the inner face have the values of the outer edges. Normals are dropped.

        A face cannot be beveled if it is on both sides of one of its edges.

        Example: ``mesh.bevel_faces(faces="All", fraction=0.25, distance=0.5)``

        :param faces: The faces to bevel. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of each corner of the inner face on the line from the old corner to the center of
            the face. From 0 (the old corner) to 1 (the center), exclusive.
        :param distance: The distance by which the inner face moves along its normal, in scene units. A negative
            distance moves the inner face inwards.
        :param on_refusal: What to do when a face cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('BevelFaces', {'faces': faces, 'fraction': fraction, 'distance': distance, 'on_refusal': on_refusal}, None, id, progress)

    def dissolve_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        seams: Literal['Refuse', 'Drop'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes vertices and merges the faces around them.

        Vertices are removed in order of their ids. Each removal is checked against the mesh as edited so far. All faces
        around the vertex become one face, which has the id and the values of the face with the lowest id. If the vertex
        is on the boundary, its two boundary edges become one. If the vertex has only two edges, these edges become one
        edge, and the faces beside the edge lose a corner. When two edges become one, the edge with the lower id is
        kept, with its values. The remaining elements keep their order and their values but get new ids. Normals are
        dropped.

        A vertex cannot be removed if it is isolated or has a single edge, or if a neighbor would be left with a single
        edge inside a face. A vertex also cannot be removed if a face would contain a vertex twice or have fewer than
        three corners, or if an edge would join two vertices that are already joined. A vertex at a seam is removed only
        if ``seams`` is ``Drop``.

        Example: ``mesh.dissolve_vertices(vertices=sel.Vertices([1]))``

        :param vertices: The vertices to remove. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when a vertex cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('DissolveVertices', {'vertices': vertices, 'on_refusal': on_refusal, 'seams': seams}, None, id, progress)

    def bevel_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron,
        fraction: float | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces vertices with faces.

        Each edge at a selected vertex is cut near this vertex, and a new face joins the cuts. The distance of a cut
        from the vertex is a fraction of the length that the edge had before the operation. The new face has as many
        corners as the vertex had edges. If both ends of an edge are selected, the fraction must be below 0.5. For
        example, a fraction of 0.25 turns a cube into a truncated cube.

        The selected vertices are removed, so the ids of the vertices after them change. New vertices get the highest
        ids, in order of the selected vertices and clockwise around each vertex. Faces keep their ids; new faces get the
        highest ids, in order of the vertices.

        Values at the cuts are interpolated between the ends of the edge, so textures do not change. A new face has the
        values (material, tags) of one of the faces at the vertex. Which face is used is not specified, but the choice
        is the same in every run. New edges have zero values (no crease, no tags). Normals are dropped.

        A vertex cannot be beveled if it is on the boundary, if it has fewer than three edges, or if one of its edges is
        too short after earlier cuts.

        Example: ``mesh.bevel_vertices(vertices="All", fraction=0.25)``

        :param vertices: The vertices to bevel. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param fraction: The distance of the cuts from the vertex, as a fraction of the edge length. From 0 to 1,
            exclusive.
        :param on_refusal: What to do when a vertex cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('BevelVertices', {'vertices': vertices, 'fraction': fraction, 'on_refusal': on_refusal}, None, id, progress)

    def vertex_normals(
        self,
        *,
        weight: Literal['Area', 'Angle', 'Uniform'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes a unit normal for every vertex, from the faces around it.

        The normals are written to the vertex attribute ``normal``, which is replaced if it exists. Corner normals are
        removed, because they would contradict the vertex normals. A vertex that has no faces or only zero-area faces,
        or whose face normals cancel each other out, gets the zero vector. The report counts these vertices.

        Example: ``mesh.vertex_normals()``

        :param weight: The weights of the faces around a vertex. Defaults to ``"Area"``.
            ``"Area"``: The area of the face.
            ``"Angle"``: The angle of the face at the vertex, at most 180 degrees.
            ``"Uniform"``: The same weight for all faces.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``attributes["normal"]`` has the normals.
        """
        return self._apply('VertexNormals', {'weight': weight}, None, id, progress)

    def tangents(
        self,
        *,
        uv: str | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes tangents for normal maps with the ``MikkTSpace`` algorithm, which many other tools also use.

        The mesh needs texture coordinates and normals, such as the normals that ``vertex_normals()`` computes. The
        tangents are written to the corner attribute ``tangent``, which is replaced if it exists. A tangent is a unit
        vector perpendicular to the normal, followed by the sign of the bitangent as the fourth number. ``.glb`` and
        ``.gltf`` files store the attribute as ``TANGENT``. Polygons are triangulated in the same way as for ``.glb``
        and ``.gltf`` files. Operations that change the shape or the faces remove the tangents, except a ``transform()``
        that does not mirror the points. Corners at which the texture coordinates define no direction get an arbitrary
        tangent. The report counts these corners.

        Example: ``mesh.tangents()``

        :param uv: The name of the texture coordinates of the normal map. Defaults to ``uv``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Tangents', {'uv': uv}, None, id, progress)

    def fill_holes(
        self,
        *,
        around: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        max_edges: int | Ron | None = None,
        with_: Literal['Triangles', 'Face'] | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Covers holes with faces.

        A hole is a boundary loop: a loop of edges with a face on one side only. The outer rim of an open sheet is also
        a boundary loop; use ``around`` or ``max_edges`` to exclude it. No vertices are added, and existing elements
        keep their ids. A hole with n edges gets 1 face with n corners, or n - 2 triangles and n - 3 edges.

        For holes with up to 500 edges, the triangles have the smallest possible total area. A hole with more than 500
        edges is filled one triangle at a time. Each triangle is added at the corner whose two neighbors are closest to
        each other. Triangles at straight and reflex corners are added last. If the hole is far from convex, the
        triangles can overlap. Two vertices that are already joined by an edge are not joined by a second edge. If no
        triangulation without duplicate edges is found, the hole cannot be filled (``DuplicateEdge``). A hole with two
        edges cannot be filled (``WrongPlace``). Use ``stitch()`` to close it.

        New faces have the values of a face beside the hole. New corners have the values of the corner at the same
        vertex in the adjacent face. Normals are dropped if a hole was filled.

        Example: ``mesh.fill_holes()``

        :param around: Fill only holes with at least one of these vertices. Defaults to ``"All"``. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param max_edges: Fill only holes with at most this number of edges. If omitted, holes of any size.
        :param with_: The faces that cover a hole. Defaults to ``"Triangles"``.
            ``"Triangles"``: Triangles.
            ``"Face"``: One face with all vertices of the hole as corners.
        :param on_refusal: What to do when a hole cannot be filled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('FillHoles', {'around': around, 'max_edges': max_edges, 'with': with_, 'on_refusal': on_refusal}, None, id, progress)

    def bridge_loops(
        self,
        first: int | Ron,
        second: int | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Joins two holes with a band of faces.

        Each hole is identified by one of its vertices. The band starts at a new edge that joins the two given vertices,
        and goes around both holes. Holes with n and m edges, where n is at least m, are joined by m quadrilaterals and
        n - m evenly spread triangles. The operation adds n edges and no vertices. Both holes can be in one connected
        part of the mesh, which then gets a tunnel or a handle. They can also be in two separate parts of the same mesh.
        (``join()`` joins two objects into one.)

        Each new face copies the attribute values of the adjacent face at the hole with more edges. New corners have the
        values of the corners at the same vertices in the adjacent faces. Normals are dropped.

        The operation is refused if a vertex is not on the boundary (``NotBoundary``), or if both vertices are on the
        same hole (``WrongPlace``). The operation is also refused if the band would join two vertices that are already
        joined by an edge (``DuplicateEdge``). In this case, the operation can succeed with other vertices of the same
        holes.

        Example: ``mesh.bridge_loops(first=0, second=5)``

        :param first: The id of a vertex on the first hole.
        :param second: The id of a vertex on the second hole. A new edge joins this vertex to the vertex ``first``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('BridgeLoops', {'first': first, 'second': second}, None, id, progress)

    def stitch(
        self,
        distance: float | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Joins boundary edges that coincide.

        Two boundary edges coincide if both pairs of corresponding ends are at most ``distance`` apart. Two edges that
        coincide only with each other form a pair. Choose a ``distance`` that is less than the lengths of the edges. If
        an edge coincides with several edges, none of these edges is joined (``NonManifold``). Unlike ``weld()``, this
        operation never merges vertices inside the surface or vertices whose edges do not coincide.

        When two vertices or two edges become one, the one with the lower id is kept, with its position and values. The
        vertex or edge with the higher id is removed, so the ids of the vertices or edges after it change. Faces and
        corners do not change, so an edge whose sides have different UVs becomes a seam. Remaining holes with two edges
        are also closed.

        A pair of edges cannot be joined if both edges belong to the same face (``SameFace``), or if two edges would
        then join the same vertices (``DuplicateEdge``). A pair also cannot be joined if the ends of an edge would
        become one vertex, or if a face would contain a vertex twice (``WrongPlace``).

        Example: ``mesh.stitch(distance=0)``

        :param distance: The largest distance between corresponding ends of two edges, in scene units. With 0, only ends
            at equal positions are joined.
        :param on_refusal: What to do when a pair cannot be joined, or when more than two edges coincide. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Stitch', {'distance': distance, 'on_refusal': on_refusal}, None, id, progress)

    def cut(
        self,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Opens the mesh along edges.

        The edges can form paths, loops and trees. A loop can cut out a piece. Each edge becomes two edges, one for each
        side of the cut. If the cuts separate the faces around a vertex into several parts, each part gets a separate
        copy of the vertex. The part that contains the face with the lowest id keeps the id of the vertex, and new
        vertices get the highest ids. Faces keep their ids, and no vertex moves. Copies of vertices and edges have the
        values of the originals. Corners keep their values. ``stitch()`` is the inverse.

        All edges are cut at once. An edge on the boundary cannot be cut (``Boundary``). An edge also cannot be cut if
        both of its ends are inside the mesh and no other cut continues at either end, because such a cut would not open
        the mesh (``DuplicateEdge``).

        Example: ``mesh.cut(edges="All")``

        :param edges: The edges to cut. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be cut. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Cut', {'edges': edges, 'on_refusal': on_refusal}, None, id, progress)

    def tag_vertices(
        self,
        name: str | Ron,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected vertices and removes the tag from all other vertices. In later operations,
        ``sel.Tagged("rim")`` selects the vertices with the tag ``rim``.

        If a later operation copies a tagged vertex, as ``extrude_faces()`` does, the copy is also tagged. If a later
        operation adds a vertex on an edge, as ``split_edges()`` does, the new vertex is not tagged. An existing tag of
        the same name is replaced. If an attribute of another type has this name, the operation fails. The geometry does
        not change. The report counts the vertices that gained or lost the tag.

        Example: ``mesh.tag_vertices(name="some", vertices="Boundary")``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param vertices: The vertices to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``,
            ``"Isolated"``, or a value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``tag("vertex", name)`` is an array of Booleans.
        """
        return self._apply('TagVertices', {'name': name, 'vertices': vertices}, None, id, progress)

    def tag_edges(
        self,
        name: str | Ron,
        edges: Literal['All', 'Boundary'] | Choice | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected edges and removes the tag from all other edges. In later operations, ``sel.Tagged("rim")``
        selects the edges with the tag ``rim``.

        When a tagged edge is split or subdivided, its parts are also tagged. An existing tag of the same name is
        replaced. If an attribute of another type has this name, the operation fails. The geometry does not change. The
        report counts the edges that gained or lost the tag.

        Example: ``mesh.tag_edges(name="marked", edges=sel.EdgeLoop(sel.Longest(count=2)))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param edges: The edges to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``tag("edge", name)`` is an array of Booleans.
        """
        return self._apply('TagEdges', {'name': name, 'edges': edges}, None, id, progress)

    def tag_faces(
        self,
        name: str | Ron,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron,
        *,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Tags the selected faces and removes the tag from all other faces. In later operations, ``sel.Tagged("rim")``
        selects the faces with the tag ``rim``.

        When a tagged face is split or subdivided, its parts are also tagged. An existing tag of the same name is
        replaced. If an attribute of another type has this name, the operation fails. The geometry does not change. The
        report counts the faces that gained or lost the tag.

        Example: ``mesh.tag_faces(name="some", faces=sel.Facing(direction=(0, 0, 1), within=45))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param faces: The faces to tag. An empty selection gives an empty tag. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``tag("face", name)`` is an array of Booleans.
        """
        return self._apply('TagFaces', {'name': name, 'faces': faces}, None, id, progress)

    def loop_subdivide(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        weights: Literal['Warren', 'Loop'] | Ron | None = None,
        boundary: Literal['EdgesOnly', 'EdgesAndCorners', 'Fixed'] | Ron | None = None,
        creasing: Literal['Uniform', 'Chaikin'] | Ron | None = None,
        face_varying: Literal['None', 'CornersOnly', 'CornersPlus1', 'CornersPlus2', 'Boundaries', 'All'] | Ron | None = None,
        to_limit: bool | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into four and smooths the surface, for a number of levels.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. V - E
        + F does not change. Old vertices keep their ids, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed according to ``face_varying``, and seams are kept. Parts of an edge or a triangle copy the
        values of the old edge or triangle. Normals are dropped, because they would be wrong. An edge or a vertex to
        which ``crease()`` gave the sharpness s stays sharp for s levels.

        Example: ``mesh.loop_subdivide(levels=2)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param weights: The weights at old vertices. Defaults to ``"Warren"``.
            ``"Warren"``: u is 3/16 for n = 3, otherwise 3/(8n).
            ``"Loop"``: u is (5/8 - (3/8 + cos(2π/n)/4)²)/n, as in Loop's thesis, 1987.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and new vertices on the boundary lie in the middle of their
                edges.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but the value of a piece with a single face does not change.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also do not change where three or more pieces meet.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also do not change at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Triangles next to the refined faces are cut in two or
            four, so that no vertex lies inside an edge. The surface outside the refined faces does not move. For the
            ids of new elements, see ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``,
            or a value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('LoopSubdivide', {'levels': levels, 'until': until, 'weights': weights, 'boundary': boundary, 'creasing': creasing, 'face_varying': face_varying, 'to_limit': to_limit, 'faces': faces}, None, id, progress)

    def catmull_clark(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        boundary: Literal['EdgesOnly', 'EdgesAndCorners', 'Fixed'] | Ron | None = None,
        creasing: Literal['Uniform', 'Chaikin'] | Ron | None = None,
        face_varying: Literal['None', 'CornersOnly', 'CornersPlus1', 'CornersPlus2', 'Boundaries', 'All'] | Ron | None = None,
        to_limit: bool | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every face into quads and smooths the surface, for a number of levels.

        A level creates a quad at each corner of each face. A level turns V vertices, E edges and F faces with C corners
        in total into V + E + F vertices, 2 E + C edges and C quads. V - E + F does not change. Old vertices keep their
        ids. The vertex on edge e has the id V + e, and the vertex at the center of face f has the id V + E + f. Edge e
        becomes edges 2e and 2e + 1. The quads are numbered in the order of the old faces and, in each face, in the
        order of its corners.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed according to ``face_varying``, and seams are kept. Parts of an edge or a face copy the
        values of the old edge or face. Normals are dropped, because they would be wrong. An edge or a vertex to which
        ``crease()`` gave the sharpness s stays sharp for s levels.

        Example: ``mesh.catmull_clark(levels=2)``

        :param levels: The number of levels. Each level replaces every corner of a face with a quad. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and new vertices on the boundary lie in the middle of their
                edges.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but the value of a piece with a single face does not change.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also do not change where three or more pieces meet.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also do not change at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Faces next to the refined faces get the new vertices
            on common edges as additional corners. The surface outside the refined faces does not move. For the ids of
            new elements, see ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('CatmullClark', {'levels': levels, 'until': until, 'boundary': boundary, 'creasing': creasing, 'face_varying': face_varying, 'to_limit': to_limit, 'faces': faces}, None, id, progress)

    def midpoint(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        into: Literal['Triangles', 'Quads'] | Ron | None = None,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every face into smaller faces without moving vertices, for a number of levels.

        ``into="Triangles"`` requires a mesh of triangles. A level turns V vertices, E edges and F triangles into V + E
        vertices, 2 E + 3 F edges and 4 F triangles. ``into="Quads"`` accepts all polygons and creates a quad at each
        corner. V vertices, E edges and F faces with C corners in total become V + E + F vertices, 2 E + C edges and C
        quads. Old vertices keep their ids and positions, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1. Triangle f becomes faces 4f to 4f + 3. The quads are numbered in the order of the old
        faces. The vertex at the center of face f has the id V + E + f.

        Vertex attributes are interpolated. Corner values are interpolated within each old face separately. Parts of an
        edge or a face copy the values of the old edge or face, including sharpness. Normals are dropped.

        Example: ``mesh.midpoint(levels=2, into="Quads")``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Defaults to 1.
            With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param into: How faces are split. Defaults to ``"Triangles"``.
            ``"Triangles"``: Splits each triangle into four.
            ``"Quads"``: Splits each face with n corners into n quads around its center.
        :param faces: The faces to refine. If omitted, all faces. With ``into="Triangles"``, triangles next to the
            refined faces are cut in two or four. With ``into="Quads"``, faces next to the refined faces get the new
            vertices on common edges as additional corners. For the ids of new elements, see
            ``subdivision::refine_faces``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Midpoint', {'levels': levels, 'until': until, 'into': into, 'faces': faces}, None, id, progress)

    def butterfly(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into four and smooths the surface without moving the old vertices, for a number of
        levels.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. V - E
        + F does not change. Old vertices keep their ids, and the vertex on edge e has the id V + e. Edge e becomes
        edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be triangles.

        Vertex attributes are interpolated with the same weights as the positions. Corner values are interpolated
        linearly, separately in each old triangle. Parts of an edge or a triangle copy the values of the old edge or
        triangle. Normals are dropped, because they would be wrong. Sharpness has no effect and is copied unchanged.

        Example: ``mesh.butterfly(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Butterfly', {'levels': levels, 'until': until}, None, id, progress)

    def sqrt3(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Splits every triangle into three, flips the old edges, and smooths the surface, for a number of levels.

        A level turns V vertices, E edges and F triangles into V + F vertices, E + 3 F edges and 3 F triangles. In
        addition, every second level adds one vertex and one edge for each boundary edge. V - E + F does not change. Old
        vertices keep their ids. The vertex in face f has the id V + f, and face f becomes faces 3f to 3f + 2. All faces
        must be triangles. Levels are counted from the start of the operation. One operation of two levels therefore
        cuts the boundary edges, but two operations of one level leave the boundary unchanged.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are interpolated linearly
        within each old triangle separately. A triangle next to a flipped edge covers parts of two old triangles. If the
        flipped edge was a seam, the triangle mixes texture coordinates of both sides of the seam, which distorts
        textures. New triangles copy the values of their old triangle. Parts of a boundary edge copy the values of the
        boundary edge. All other edges have zero values (no crease, no tags). Normals are dropped, because they would be
        wrong.

        Example: ``mesh.sqrt3(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by three. Defaults to 1. With
            ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Sqrt3', {'levels': levels, 'until': until}, None, id, progress)

    def doo_sabin(
        self,
        *,
        levels: int | Ron | None = None,
        until: Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces every edge and every vertex with a face and shrinks the old faces, for a number of levels.

        A level turns a closed mesh with V vertices, E edges and F faces into a mesh with 2 E vertices, 4 E edges and V
        + E + F faces. If the mesh has a boundary, a level creates additional elements along the boundary. V - E + F
        does not change. The face inside old face f has the id f, and the face of edge e has the id F + e. The faces of
        vertices have the highest ids. Isolated vertices are kept. The ids of isolated vertices follow the ids of all
        other vertices. Isolated vertices and inner vertices of valence 2 do not become faces.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are smoothed within each
        old face separately. The new faces at edges and vertices mix corner values of several old faces. At a seam, this
        distorts textures. A face inside an old face copies the values of the old face; the face of an edge or a vertex
        copies the values of an adjacent face. The two new edges along an old edge copy the values of this edge. All
        other edges have zero values (no crease, no tags). Normals are dropped, because they would be wrong.

        Example: ``mesh.doo_sabin(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Defaults to 1.
            With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('DooSabin', {'levels': levels, 'until': until}, None, id, progress)

    def bisect(
        self,
        normal: Sequence[float] | NDArray[Any] | Ron,
        *,
        point: Sequence[float] | NDArray[Any] | Ron | None = None,
        keep: Literal['Both', 'Front', 'Back'] | Ron | None = None,
        tag: str | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Cuts meshes along a plane.

        Every edge that crosses the plane gets a vertex on the plane. Every face that crosses the plane is cut along the
        plane. A concave face can be cut several times. A vertex counts as on the plane if its distance from the plane
        is at most 1e-9 times the largest extent of the mesh, or at most 1e-14 times the largest absolute coordinate.
        Such a vertex is not moved. When an edge is cut, the part at the start of its first half-edge keeps the id of
        the edge. When a face is cut, the part with the first corner keeps the id of the face. New elements get the
        highest ids. Where an edge crosses the plane, attributes are interpolated. At a seam, the two sides are
        interpolated separately.

        With ``keep="Front"`` or ``keep="Back"``, the other side of the plane is removed. A face in the plane belongs to
        the back if its normal points to the front, because the face then closes the solid behind the plane. Vertices
        left without a face are removed. If the remaining faces around a vertex form several fans, each fan gets a
        separate copy of the vertex. No faces are added to close the cut. To close the cut, use ``fill_holes()`` in a
        later operation.

        Example: ``mesh.bisect(normal=(0, 0, 1))``

        :param normal: The normal of the plane, which points to the front. The length of the normal does not matter but
            must not be 0.
        :param point: A point on the plane.
        :param keep: The side to keep. Defaults to ``"Both"``.
            ``"Both"``: Both sides.
            ``"Front"``: The side that the normal points to.
            ``"Back"``: The side that the normal points away from.
        :param tag: The name of a tag for the edges on the plane. Edges that already have the tag keep it. If omitted,
            no edges are tagged.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Bisect', {'point': point, 'normal': normal, 'keep': keep, 'tag': tag}, None, id, progress)

    def symmetrize(
        self,
        normal: Sequence[float] | NDArray[Any] | Ron,
        *,
        point: Sequence[float] | NDArray[Any] | Ron | None = None,
        from_: Literal['Front', 'Back'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces one half of a mesh with the mirror image of the other half.

        The mesh is cut along a plane, as with ``bisect()``. The half on the side ``from_`` is kept and mirrored, and
        the halves are joined at the plane. Vertices near the plane (see ``bisect()``) are moved exactly onto it, so
        that the result is symmetric. Faces in the plane are removed, because they would become walls inside the result.
        Where the surface only touches the plane, the halves are not joined. The report counts the faces that are
        removed completely, not the faces that are cut.

        The elements of the kept half come first, in their old order. The elements of the mirror image follow.
        Attributes are copied, so both halves have the same texture coordinates, tags and joint weights. Normals and
        tangents are dropped.

        Example: ``mesh.symmetrize(normal=(1, 0, 0))``

        :param normal: The normal of the plane, which points to the front. The length of the normal does not matter but
            must not be 0.
        :param point: A point on the plane.
        :param from_: The half that is kept and mirrored. Defaults to ``"Front"``.
            ``"Front"``: The side that the normal points to.
            ``"Back"``: The side that the normal points away from.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Symmetrize', {'point': point, 'normal': normal, 'from': from_}, None, id, progress)

    def simplify(
        self,
        *,
        faces: int | Ron | None = None,
        ratio: float | Ron | None = None,
        error: float | Ron | None = None,
        features: Literal['All', 'Boundary'] | Choice | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        intersections: Literal['Allow', 'Refuse'] | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Removes triangles from meshes, and changes the surface as little as possible.

        Edges are collapsed, starting with the edges whose collapse changes the surface least. The change is measured by
        the squared distance of the new vertex to the planes of the original triangles that it replaces (Garland,
        Heckbert, 1997). The operation ends when ``faces`` or ``ratio`` is reached, or when every remaining collapse is
        refused or could exceed ``error``. At least one of ``faces``, ``ratio`` and ``error`` must be given, but not
        both ``faces`` and ``ratio``. All faces must be triangles.

        The following properties are kept:

        - Topology: holes, handles and separate parts stay.
        - Lines: the boundary, seams of texture coordinates and normals, borders between face tags or materials, edges
          with a tag or a crease, and ``features``. A line can lose vertices, but its ends, and the vertices where lines
          meet, keep their exact positions.
        - Attributes: changes of texture coordinates, normals, colors and other numbers count as changes of the surface
          (Hoppe, 1999), and new vertices get the values that fit best. Values are never mixed across a line, and no
          triangle is turned over in the texture. Normals are kept, so that a simplified mesh is shaded like the
          original. The numbers that ``measure()`` stores also count, and the report lists them. If they must not
          influence the result, use ``measure()`` after this operation.
        - Vertex tags: vertices with different tags, different sharpness, or different values of a whole-number
          attribute are not merged.

        In a texture, the border of a chart is also simplified, and can then cross a chart that is close to it. The
        report counts the faces that overlap in the texture. To leave more space between charts, use ``pack_uvs()`` with
        a larger ``padding`` before this operation.

        No triangle is turned over. Remaining elements get new ids, in the order of their old ids. If the number of
        faces cannot be reached and ``error`` is not given, the operation is refused as ``Unreached``, and the message
        states the reasons. With ``on_refusal="Skip"``, the operation keeps the mesh with the fewest faces that it
        reached.

        Example: ``mesh.simplify(ratio=0.5)``

        :param faces: The number of faces to reach, for each mesh. The result can have one face fewer than this number.
            A mesh that already has at most this number of faces does not change.
        :param ratio: The number of faces to reach, as a fraction of the number of faces of each mesh.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. The
            limit is guaranteed, because the operation adds up upper bounds of the distances by which the collapses move
            the surface. The true distance is usually between a third of the limit and the limit. If omitted, there is
            no limit.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param pin: Vertices that are never removed and keep their exact positions, for example ``Boundary``. If
            omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param intersections: Whether the operation is allowed to create intersections of faces. Such intersections can
            occur where parts of the surface are close together. Defaults to ``"Allow"``.
            ``"Allow"``: New intersections are allowed, and not detected.
            ``"Refuse"``: No changed face intersects another face, so a mesh without self-intersections stays without
                self-intersections.
        :param on_refusal: What to do if the number of faces cannot be reached. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Simplify', {'faces': faces, 'ratio': ratio, 'error': error, 'features': features, 'pin': pin, 'intersections': intersections, 'on_refusal': on_refusal}, None, id, progress)

    def remesh(
        self,
        *,
        length: float | Ron | None = None,
        curvature: Mapping[str, Any] | Ron | None = None,
        features: Literal['All', 'Boundary'] | Choice | Ron | None = None,
        error: float | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        passes: int | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Replaces all triangles with nearly equilateral triangles of a given size, on the same surface.

        Each pass splits long edges, collapses short edges, flips edges so that most vertices have six edges, and moves
        vertices along the surface (Botsch, Kobbelt, 2004). Most edges of the result have 4/5 to 4/3 of the target
        length. All vertices lie on the original surface, with one exception. A new vertex stays where it is if moving
        it onto the surface would turn a triangle too far or would move the surface too far. The target length of edges
        is either ``length``, or it follows ``curvature``. With ``curvature``, edges are short where the surface is
        curved, and long where it is flat (Dunyach and others, 2013). Exactly one of ``length`` and ``curvature`` must
        be given. All faces must be triangles.

        The following properties are kept:

        - Topology: holes, handles and separate parts stay.
        - Lines: the boundary, seams of texture coordinates and normals, borders between face tags or materials, edges
          with a tag or a crease, and ``features``. Vertices on a line slide along it. The ends of lines, the vertices
          where lines meet, and corners where a line turns by more than 40 degrees keep their exact positions. Other
          sharp edges are rounded.
        - Attributes: each vertex and corner gets the values of the original surface at its position. Values are never
          interpolated across a line.
        - Vertex tags: a new vertex has a tag if all old vertices around its position had the tag. A tagged vertex can
          move only inside a tagged region. A tagged vertex is inside such a region if all corners of one of its
          triangles, or both of its neighbors on a line, also have the tag. All other tagged vertices keep their exact
          positions. Vertices with sharpness also keep their exact positions.

        The number of faces depends on the area of the mesh, which is not known before the run. Therefore ``check``
        shows the largest number of faces that fits the memory budget. When the operation starts, it estimates the
        number of faces from the area. The operation fails if the estimate exceeds the memory budget.

        Edits that would turn a triangle by more than 60 degrees are refused. All elements get new ids. If the distance
        between the result and the original could exceed ``error``, the operation is refused as ``Unreached``. With
        ``on_refusal="Skip"``, a refused operation does not change the mesh.

        Example: ``mesh.remesh(length=0.5)``

        :param length: The target length of edges, in scene units.
        :param curvature: Target lengths that follow the curvature. Replaces ``length``.
            ``"error"``: The intended distance between the surface and the triangles, in scene units. It is not
                guaranteed. To guarantee a distance, use the parameter ``error`` of the operation.
            ``"min"``: The smallest target length of edges, in scene units.
            ``"max"``: The largest target length of edges, in scene units.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. To
            keep this limit, some edges can become shorter than the target length. The distance is measured at the end
            of the operation, in both directions and for all points of both surfaces. If omitted, there is no limit.
        :param pin: Vertices that keep their exact positions, for example ``Boundary``. If omitted, no vertices.
            ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param passes: The largest number of passes, from 1 to 1000. The operation ends earlier if a pass changes almost
            nothing. Defaults to 10.
        :param on_refusal: What to do if the distance between the result and the original could exceed ``error``.
            Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Remesh', {'length': length, 'curvature': curvature, 'features': features, 'error': error, 'pin': pin, 'passes': passes, 'on_refusal': on_refusal}, None, id, progress)

    def smooth(
        self,
        by: Choice | Ron,
        *,
        passes: int | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        boundary: Literal['Fixed', 'Free'] | Ron | None = None,
        keep_volume: bool | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices so that noise disappears.

        A vertex moves only if it is in ``vertices``, is not in ``pin``, and has a face. All other vertices keep their
        exact positions. Faces can have any number of corners, and degenerate faces are allowed. All elements keep their
        ids. Attributes are kept, so textures stretch with the surface, but normals and tangents are dropped.

        - ``choice.Laplacian``: strong smoothing; shrinks.
        - ``choice.Taubin``: removing noise; nearly the same.
        - ``choice.Implicit``: strong smoothing of meshes with many small faces in one pass; shrinks.
        - ``choice.Denoise``: scans of objects with flat sides and sharp edges; nearly the same.

        If ``boundary`` is ``Fixed``, vertices on the boundary do not move, so that adjacent objects still fit together.

        Example: ``mesh.smooth(by=choice.Taubin())``

        :param by: The method.
            ``choice.Laplacian(..)``: Moves each vertex towards the mean of its neighbors.
            ``choice.Taubin(..)``: Moves each vertex towards the mean of its neighbors, and then back by a slightly
                larger factor.
            ``choice.Implicit(..)``: Moves the surface by mean curvature flow for the given time, in one stable step.
            ``choice.Denoise(..)``: Filters the normals of the faces, so that similar normals become equal, then moves
                the vertices to fit the normals.
        :param passes: The number of passes. If omitted, 1 for ``choice.Implicit`` and 10 for the other methods. For
            ``choice.Denoise``, the number of passes over the normals. At most 10000.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param boundary: How vertices on the boundary move. Defaults to ``"Fixed"``.
            ``"Fixed"``: The vertices do not move.
            ``"Free"``: The boundary is smoothed as a set of curves, so the movement of a vertex on the boundary depends
                only on its neighbors along the boundary.
        :param keep_volume: Whether to restore the original volume of the mesh. To restore the volume, the operation
            finally shifts all moved vertices along their normals by the same distance. The mesh must be closed.
            Defaults to ``False``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Smooth', {'by': by, 'passes': passes, 'vertices': vertices, 'pin': pin, 'boundary': boundary, 'keep_volume': keep_volume}, None, id, progress)

    def transfer(
        self,
        from_: Mesh | str | Ron,
        attributes: Sequence[str] | NDArray[Any] | Ron,
        *,
        within: float | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Copies attributes from the nearest points of another mesh.

        The operation copies vertex, corner and face attributes from the mesh ``from_`` to elements of the same kind in
        the changed mesh. Numbers and vectors of vertices and corners are interpolated inside the face that contains the
        nearest point. Whole numbers, tags, and attributes that edits do not interpolate are copied from the nearest
        corner of the face that contains the nearest point. Values of faces are copied from the face that contains the
        nearest point. If the attribute already exists with the same type of values, it is overwritten. If the attribute
        already exists with a different type of values, the operation fails.

        All corners of a face take their values from one side of each seam, so no triangle is stretched across a seam of
        texture coordinates. Usually the corners take their values from the side that is nearest to the center of the
        face. Seams divide the source into charts. The chart that is nearest to a corner is used instead if it is much
        nearer to the whole face than the chart that is nearest to the center of the face. This happens where parts of
        the source intersect.

        Elements whose distance from the source exceeds ``within`` keep their values, or get zeros if the attribute is
        new. If the distance of a corner or of the center of a face exceeds ``within``, all corners of the face keep
        their values or get zeros. The report counts the elements that are too far away.

        Example: ``mesh.transfer(from_=scan, attributes=["uv", "color"], within=0.01)``

        :param from_: The mesh with the attributes.
        :param attributes: The names of the attributes, for example ``["uv", "color"]``.
        :param within: The largest distance from the source, in scene units. If omitted, there is no limit.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Transfer', {'from': from_, 'attributes': attributes, 'within': within}, None, id, progress)

    def move_vertices(
        self,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron,
        by: Choice | Ron,
        *,
        falloff: float | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        With ``falloff="r"``, vertices near the selected vertices also move. At the distance d from the nearest selected
        vertex, the movement is multiplied by the weight (1 - (d/r)²)². The weight is 1 at selected vertices and falls
        smoothly to 0 at the distance r. Distances are measured along straight lines, not along the surface.

        With ``by=choice.Distance(..)``, each vertex moves along its own normal, which is the mean of the normals of its
        faces, weighted by their areas. Vertices without a normal do not move. The report counts them.

        Example: ``mesh.move_vertices(vertices=sel.Vertices([0]), by=choice.Offset((0, 0, 0.5)))``

        :param vertices: The vertices to move. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param by: How the vertices move.
            ``choice.Offset(..)``: Moves by this offset along x, y and z, in scene units.
            ``choice.Distance(..)``: Moves by this distance along the normal of each vertex, in scene units.
            ``choice.To(..)``: Moves by one common offset, so that the mean of the selected vertices arrives at this
                point.
            ``choice.Rotate(..)``: Rotates around an axis through the mean of the selected vertices.
            ``choice.Scale(..)``: Scales along x, y and z about the mean of the selected vertices.
        :param falloff: The distance from the selected vertices at which the movement has fallen to 0, in scene units.
            If omitted, only the selected vertices move.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('MoveVertices', {'vertices': vertices, 'by': by, 'falloff': falloff}, None, id, progress)

    def displace(
        self,
        by: Choice | Ron,
        distance: float | Ron,
        *,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices along their normals, by amounts that vary over the surface.

        Each vertex moves along its normal by ``distance`` times the value of ``by``. The normal of a vertex is the mean
        of the normals of its faces, weighted by their areas. Vertices without a normal do not move. The report counts
        them. Normals and tangents are dropped. Faces, element ids and other attributes do not change.

        The values are computed without functions whose results differ between machines, so the result is identical on
        all machines.

        Example: ``mesh.displace(by=choice.Noise(scale=0.5, seed=7), distance=0.1)``

        :param by: The values by which ``distance`` is multiplied.
            ``choice.Noise(..)``: Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002).
            ``choice.Random(..)``: A random number from -1 to 1 for each vertex.
            ``choice.Attribute(..)``: A vertex attribute that holds one number for each vertex.
            ``choice.Image(..)``: The brightness of an image (a height map), from 0 (black) to 1 (white), at the texture
                coordinates of the vertex.
        :param distance: The distance that a vertex with the value 1 moves, in scene units. A negative distance moves
            the vertex inwards.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Displace', {'by': by, 'distance': distance, 'vertices': vertices}, None, id, progress)

    def bend(
        self,
        axis: Literal['X', 'Y', 'Z'] | Ron,
        angle: float | Ron,
        *,
        towards: Literal['X', 'Y', 'Z'] | Ron | None = None,
        about: Sequence[float] | NDArray[Any] | Ron | None = None,
        from_: float | Ron | None = None,
        to: float | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Bends a mesh, so that an axis becomes an arc of a circle.

        Vertices at or below ``from_`` do not move. Between ``from_`` and ``to``, the axis becomes an arc of the same
        length, which turns by ``angle`` in total. Vertices above ``to`` move rigidly. Vertices between the axis and the
        center of the circle move closer together, and vertices on the other side of the axis move apart. The distance
        between the center of the circle and the axis is (to - from) / angle, with the angle in radians. Parts of the
        mesh beyond the center of the circle turn inside out. Source: Barr, "Global and Local Deformations of Solid
        Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.bend(axis="Z", angle=90)``

        :param axis: The axis that becomes an arc.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle by which the axis turns from ``from_`` to ``to``, in degrees. A negative angle bends to
            the other side.
        :param towards: The axis towards which the upper end bends. If omitted, the axis after ``axis`` in the order x,
            y, z, x.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Bend', {'axis': axis, 'angle': angle, 'towards': towards, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, None, id, progress)

    def twist(
        self,
        axis: Literal['X', 'Y', 'Z'] | Ron,
        angle: float | Ron,
        *,
        about: Sequence[float] | NDArray[Any] | Ron | None = None,
        from_: float | Ron | None = None,
        to: float | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Rotates vertices around an axis, by an angle that grows along the axis.

        The angle grows linearly from 0 at ``from_`` to ``angle`` at ``to``. Below ``from_`` and above ``to``, vertices
        rotate by the angle of the nearer end. The volume changes only because edges stay straight, so the volume of a
        fine mesh hardly changes. A twist by the opposite angle undoes a twist. Source: Barr, "Global and Local
        Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.twist(axis="Z", angle=90)``

        :param axis: The axis of the rotation.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle at ``to``, in degrees, counter-clockwise if the axis points to the viewer.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Twist', {'axis': axis, 'angle': angle, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, None, id, progress)

    def taper(
        self,
        axis: Literal['X', 'Y', 'Z'] | Ron,
        factor: float | Ron,
        *,
        about: Sequence[float] | NDArray[Any] | Ron | None = None,
        from_: float | Ron | None = None,
        to: float | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Scales vertices towards or away from an axis, by a factor that changes along the axis.

        The factor changes linearly from 1 at ``from_`` to ``factor`` at ``to``. Below ``from_`` and above ``to``, the
        factor of the nearer end applies. Coordinates along the axis do not change. Source: Barr, "Global and Local
        Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.taper(axis="Z", factor=0.5)``

        :param axis: The axis. Points on the axis do not move.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param factor: The factor at ``to``. More than 0. A factor below 1 makes the upper end narrower.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh.
        :param to: The coordinate along the axis at which the deformation is complete. If omitted, the highest
            coordinate of the mesh. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Taper', {'axis': axis, 'factor': factor, 'about': about, 'from': from_, 'to': to, 'vertices': vertices}, None, id, progress)

    def lattice(
        self,
        size: Sequence[int] | NDArray[Any] | Ron,
        moves: Sequence[Sequence[Sequence[float] | NDArray[Any] | Sequence[int] | NDArray[Any]] | NDArray[Any]] | NDArray[Any] | Ron,
        *,
        min: Sequence[float] | NDArray[Any] | Ron | None = None,
        max: Sequence[float] | NDArray[Any] | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Deforms vertices with a box of control points.

        The box has a grid of ``size`` control points along x, y and z. ``moves`` moves some of the control points, and
        the space in the box follows smoothly. Each point in the box moves to a sum of the control points with Bernstein
        polynomials as weights (Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models", 1986). If all
        control points move by the same offset, the whole box moves by this offset. A control point attracts the
        surface, but the surface usually does not reach it, except at the corners of the box.

        Vertices outside the box do not move. Normals and tangents are dropped. Faces, element ids and other attributes
        do not change, so textures stretch with the surface. Only vertices move, so refine the mesh first if its faces
        are large.

        Example: ``mesh.lattice(size=(3, 3, 3), moves=[((2, 2, 2), (0.5, 0.5, 0.5))])``

        :param size: The number of control points along x, y and z, from 2 to 16 each.
        :param moves: The control points that move: their indices along x, y and z, counted from 0, and the offset in
            scene units. A control point that is listed several times moves by the sum of its offsets.
        :param min: The lowest corner of the box. If omitted, the lowest corner of the bounding box of the mesh.
        :param max: The highest corner of the box. If omitted, the highest corner of the bounding box of the mesh.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Lattice', {'size': size, 'moves': moves, 'min': min, 'max': max, 'vertices': vertices}, None, id, progress)

    def project(
        self,
        onto: Mesh | str | Ron,
        *,
        along: Literal['Nearest', 'Normal'] | Choice | Ron | None = None,
        vertices: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        pin: Literal['All', 'Boundary', 'Isolated'] | Choice | Ron | None = None,
        distance: float | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves vertices onto the surface of another mesh (shrinkwrap).

        Only vertices in ``vertices`` that are not in ``pin`` move. All other vertices keep their exact positions.
        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        Vertices that would move farther than ``distance`` do not move. With ``Normal`` and ``choice.Direction``, a
        vertex moves along a line, and vertices whose line misses the surface do not move either. The report counts the
        vertices that would move too far, and the vertices whose line misses the surface.

        Example: ``mesh.project(onto=scan, distance=0.1)``

        :param onto: The mesh with the surface.
        :param along: Where each vertex goes. Defaults to ``"Nearest"``.
            ``"Nearest"``: Moves to the nearest point of the surface.
            ``"Normal"``: Moves to the nearest point of the surface on the line through the vertex along its normal, on
                either side.
            ``choice.Direction(..)``: Moves to the first point of the surface in this direction.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param distance: The largest distance that a vertex moves, in scene units. If omitted, any distance.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('Project', {'onto': onto, 'along': along, 'vertices': vertices, 'pin': pin, 'distance': distance}, None, id, progress)

    def measure(
        self,
        of: Literal['MeanCurvature', 'GaussianCurvature', 'Area', 'VertexArea', 'MinAngle', 'AspectRatio', 'Thickness'] | Choice | Ron,
        *,
        name: str | Ron | None = None,
        missing: float | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Stores a quantity, such as a curvature or a distance, as an attribute of vertices or faces.

        Later operations can select elements by the attribute (``sel.Where``), move vertices by it (``displace()``),
        show it in a picture (``picture()``), and save it to files (``save()``). The attribute is not updated when the
        mesh changes. Positions and other attributes do not change. Quantities are computed in the space of the mesh,
        without the transforms of nodes. The report states the lowest, the mean and the highest value of each object.

        An attribute of the same name is replaced if it belongs to the same elements (vertices or faces) and has one
        floating-point number for each element. Otherwise the operation fails.

        Example: ``mesh.measure(of="MeanCurvature")``

        :param of: The quantity.
            ``"MeanCurvature"``: The mean curvature at each vertex, in 1 / scene unit: 1 / r on a sphere of radius r, 1
                / (2 r) on a cylinder, and negative where the surface is concave (Cohen-Steiner, Morvan, 2003).
            ``"GaussianCurvature"``: The Gaussian curvature at each vertex, in 1 / scene unit²: the angle defect divided
                by the area of the vertex (Meyer, Desbrun, Schröder, Barr, 2003).
            ``choice.PrincipalCurvature(..)``: A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of
                the curvature tensor of Cohen-Steiner and Morvan, 2003.
            ``"Area"``: The area of each face, in scene units².
            ``"VertexArea"``: The area of each vertex, in scene units².
            ``"MinAngle"``: The smallest angle of each face, in degrees.
            ``"AspectRatio"``: The aspect ratio of each face: 1 for regular polygons, and more than 1 for all other
                polygons (Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict Geometric Quality Library", 2007).
            ``choice.Distance(..)``: The distance from each vertex to the nearest point of another mesh of the scene, in
                scene units.
            ``choice.Geodesic(..)``: The distance along the surface from each vertex to the nearest selected vertex, in
                scene units, by the heat method (Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013; Sharp, Crane,
                2020).
            ``"Thickness"``: The thickness of the solid at each vertex, in scene units.
            ``choice.Occlusion(..)``: The ambient occlusion of each vertex: the fraction of the rays from the vertex
                that meet the mesh, from 0 (open) to 1 (enclosed).
            ``choice.Winding(..)``: The winding number of another mesh of the scene around each vertex: 1 inside, 0
                outside, and numbers between 0 and 1 near gaps of the other mesh (Jacobson, Kavan, Sorkine-Hornung,
                2013; Barill, Dickson, Schmidt, Levin, Jacobson, 2018).
        :param name: The name of the attribute. If omitted, the attribute has the name of the quantity in lower case,
            such as ``mean_curvature``. For principal curvatures, the default names are ``largest_curvature`` and
            ``smallest_curvature``.
        :param missing: The value for elements at which the quantity is not defined, such as the curvature of a vertex
            without faces. The report counts these elements. If omitted, 0 for quantities that can be negative, and -1
            for all others.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``attributes["mean_curvature"]``, or the attribute of the
            given name, is an array of the values.
        """
        return self._apply('Measure', {'of': of, 'name': name, 'missing': missing}, None, id, progress)

    def unwrap(
        self,
        *,
        seams: Literal['All', 'Boundary'] | Choice | Ron | None = None,
        max_angle: float | Ron | None = None,
        max_stretch: float | Ron | None = None,
        page: int | Ron | None = None,
        padding: int | Ron | None = None,
        uv: str | Ron | None = None,
        on_refusal: Literal['Error', 'Skip'] | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Computes texture coordinates without overlaps.

        The surface is cut into charts, which are flattened and packed into a square page. Charts grow from flat regions
        as far as ``max_angle`` allows. The charts are flattened by least squares conformal maps (Levy and others, 2002)
        and the hybrid method of Liu and others (2008). A chart is cut again if it would overlap itself or exceed
        ``max_stretch``. It is also cut again if the ratio of the largest to the smallest stretch would exceed 1.15 on
        more than 5 % of its area. All charts of a mesh have the same scale, and no chart is mirrored. A polygon stays
        in one chart. Each mesh gets its own page, on which the charts are arranged as by ``pack_uvs()``.

        The coordinates are written to the corner attribute ``uv``, which is replaced if it exists. Edges at which
        charts meet become seams. Positions, faces and other attributes do not change, but tangents are removed.
        Zero-area faces have no area in the texture. The report counts them. If a polygon is bent so far that it
        overlaps itself in the texture, the operation is refused as ``WrongPlace``. Before this operation, triangulate
        polygons that would overlap themselves. With ``on_refusal="Skip"``, the triangles of such a polygon overlap in
        the texture.

        Example: ``mesh.unwrap(max_angle=60)``

        :param seams: Edges that become borders of charts, for example ``sel.Tagged("seam")`` or
            ``sel.Sharp(above=60)``. The algorithm also chooses borders itself. If omitted, the algorithm chooses all
            borders. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param max_angle: The largest angle between the normal of a face and the mean normal of its chart, in degrees.
            Smaller angles give more charts with less stretch. Defaults to ``70.0``.
        :param max_stretch: The largest ratio between the area scale of a triangle and the area scale of its whole
            chart. The area scale is the area in the texture divided by the area on the surface. Defaults to ``4.0``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for any size.
            The size only determines how large the padding is. Defaults to ``1024``.
        :param padding: The number of empty texels around each chart. The distance between two charts is at least twice
            this number. Defaults to 2.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param on_refusal: What to do if a polygon overlaps itself in the texture. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal, and continue.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change. Its ``attributes["uv"]`` has the coordinates of the corners,
            and ``corners`` has their vertices.
        """
        return self._apply('Unwrap', {'seams': seams, 'max_angle': max_angle, 'max_stretch': max_stretch, 'page': page, 'padding': padding, 'uv': uv, 'on_refusal': on_refusal}, None, id, progress)

    def pack_uvs(
        self,
        *,
        uv: str | Ron | None = None,
        page: int | Ron | None = None,
        padding: int | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Moves, rotates and scales charts of texture coordinates so that they do not overlap and have the same scale.

        A chart is a set of faces that are connected without seams of the texture coordinates. After the operation, the
        area of each chart in the texture is proportional to its area on the surface. The shape of each chart does not
        change, even if it is stretched, mirrored or overlaps itself. Each zero-area chart becomes a point. The report
        counts zero-area charts and charts that overlap themselves. Each mesh gets its own page, that is, the whole
        square of a texture. Tangents are removed, because charts are rotated.

        Up to 256 charts can lie in the hollows and holes of each other. More charts are packed in rows, which is much
        faster but leaves more of the page empty.

        Example: ``mesh.pack_uvs(page=2048, padding=4)``

        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for any size.
            The size only determines how large the padding is. Defaults to ``1024``.
        :param padding: The number of empty texels around each chart. The distance between two charts is at least twice
            this number. Defaults to 2.
        :param id, progress: See :class:`Mesh`.
        :returns: The new mesh. This mesh does not change.
        """
        return self._apply('PackUvs', {'uv': uv, 'page': page, 'padding': padding}, None, id, progress)

    def picture(
        self,
        path: str | os.PathLike[str] | Ron,
        *,
        size: Sequence[int] | NDArray[Any] | Ron | None = None,
        camera: Choice | Ron | None = None,
        views: Sequence[Choice] | NDArray[Any] | Ron | None = None,
        columns: int | Ron | None = None,
        style: Mapping[str, Any] | Ron | None = None,
        highlight: Literal['All', 'Boundary', 'Isolated', 'SelfIntersecting'] | Choice | Ron | None = None,
        highlight_width: float | Ron | None = None,
        marks: Sequence[Mapping[str, Any]] | NDArray[Any] | Ron | None = None,
        color_by: str | Choice | Mapping[str, Any] | Ron | None = None,
        turntable: Mapping[str, Any] | Ron | None = None,
        images: str | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the scene into an image file.

        The extension of the file determines the format. A single image has the extension ``.png``. With ``turntable``,
        ``.gif`` gives an animated GIF, and ``.apng`` or ``.png`` gives an animated PNG. The scene does not change.
        Drawing needs no GPU and gives the same bytes on every machine.

        Example: ``mesh.picture(path="a.png", size=(64, 48), highlight=sel.Edges(sel.Sharp(above=30)), color_by={"of":
        "Valence"}, style={"wireframe": {}})``

        :param path: The file. A relative path is relative to the working directory.
        :param size: The width and the height of each view in pixels.
        :param camera: The camera.
            ``choice.Fit(..)``: Looks from a side, at the distance from which the picture shows the whole scene.
            ``choice.LookAt(..)``: Looks from one point to another point.
        :param views: Several cameras, which replace ``camera``. The views of the cameras are placed side by side.
        :param columns: The number of views in a row. If omitted, the number of views, but at most 4.
        :param style: The style: shading, lines, background.
            ``"shading"``: The lighting of surfaces.
            ``"sharp"``: The minimum angle between the normals of two faces, in degrees, at which the edge between the
                faces is shaded as sharp. This angle has no effect if the mesh has normals.
            ``"occlusion"``: The strength of ambient occlusion, which darkens hollows, from 0 (none) to 1.
            ``"background"``: The background.
            ``"color"``: The color of all surfaces. If omitted, surfaces have the colors of the scene.
            ``"back"``: The color of the back of faces. The back is visible where a mesh is open or inside out.
            ``"wireframe"``: Draws the edges of meshes, and grids on Bezier patches. Lines that are only a few pixels
                apart are thinner, so that they do not cover the surface.
            ``"boundary"``: Draws the boundary edges of meshes.
            ``"creases"``: Draws crease edges. The width of a crease grows with its sharpness, up to twice ``width``.
            ``"normals"``: Draws vertex normals as short lines. The value is the length of the lines as a fraction of
                the size of the scene.
            ``"points"``: Draws dots at all vertices of meshes and all points of polylines. The value is the diameter of
                the dots in pixels.
            ``"control_nets"``: Draws the control nets of Bezier patches and the control polygons of curves.
            ``"ids"``: Labels vertices or faces with their ids. Only small meshes can be labeled.
            ``"curve_width"``: The width of curves and polylines in pixels.
        :param highlight: Elements to highlight in orange, as in ``sel.Edges(sel.Sharp(above=30))`` or
            ``sel.Faces(sel.Tagged("top"))``. ``"All"``, ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param highlight_width: The width of highlighted edges and the diameter of highlighted vertices, in pixels. The
            default width and the default diameter depend on the shorter side of a view: 2.8 and 7.5 for 240 pixels, 3.4
            and 10 for 480, 4 and 13 for 960, 8 and 26 for 1920. If there are many highlighted vertices, they are drawn
            smaller. Hidden edges are drawn faintly, and hidden vertices as rings.
        :param marks: More selections of elements to highlight, each with its own color.
            ``"of"``: The elements.
            ``"color"``: The color.
            ``"width"``: The width of edges and the diameter of vertices, in pixels. If omitted, the defaults of
                ``highlight_width``.
        :param color_by: What the colors of the surface show: a quantity (``"Valence"``, ``"MinAngle"``, ``"Area"``,
            ``"DihedralAngle"``, ``"MeanCurvature"``, ``"GaussianCurvature"``, or a value of ``meshwright.choice``), the
            name of an attribute, or a mapping with more details.
            ``"of"``: The quantity that the colors show.
            ``"map"``: The color map. The default is ``Classes`` for valences, ``Diverging`` for curvatures, and
                ``Viridis`` for all other quantities.
            ``"range"``: The values that the first and the last color represent, as in ``(0, 60)``. If omitted, the
                range depends on the values of the quantity. For curvatures, the range is symmetric about 0. It leaves
                out the lowest and the highest eighth of the values, or fewer values if all remaining values are 0.
            ``"legend"``: Whether a legend in a corner explains the colors.
        :param turntable: If given, the picture is an animation in which the camera moves once around the scene.
            ``"frames"``: The number of images.
            ``"seconds"``: The duration of the turn.
        :param images: The folder of texture images that are not stored next to their model. If omitted, the working
            directory. Missing images are not drawn, and the report lists them.
        :param id, progress: See :class:`Mesh`.
        :returns: The same mesh.
        """
        return self._apply('Picture', {'path': path, 'size': size, 'camera': camera, 'views': views, 'columns': columns, 'style': style, 'highlight': highlight, 'highlight_width': highlight_width, 'marks': marks, 'color_by': color_by, 'turntable': turntable, 'images': images}, None, id, progress)

    def curve_figure(
        self,
        path: str | os.PathLike[str] | Ron,
        *,
        t: Sequence[float] | NDArray[Any] | Ron | None = None,
        by_level: bool | Ron | None = None,
        before: str | Ron | None = None,
        width: int | Ron | None = None,
        columns: int | Ron | None = None,
        scale: int | Ron | None = None,
        labels: bool | Ron | None = None,
        legend: bool | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws Bezier curves, and de Casteljau's construction of their points, into an image file.

        The figure has one panel for each combination of a curve and a value of ``t``. With ``by_level``, the figure has
        one panel for each combination of a curve, a value of ``t`` and a level. A panel shows the curve, its control
        polygon, every level of de Casteljau's algorithm in a different color, and the constructed point. Both axes have
        the same scale. With ``by_level``, each panel shows one level more than the previous panel for the same value of
        ``t``. Only the last panel for a value of ``t`` shows the constructed point. The extension of the file
        determines the format: ``.svg`` or ``.png``. The scene does not change.

        Example: ``mesh.curve_figure(path="figure.svg", t=[0.25, 0.5])``

        :param path: The file. A relative path is relative to the working directory.
        :param t: The parameters of the constructed points, from 0 (start) to 1 (end). If empty, only the curves and
            their control polygons are drawn.
        :param by_level: Whether each level of the algorithm has its own panel. If false, one panel shows all levels.
            Defaults to ``False``.
        :param before: The name of a curve that shows an earlier state of the other curves. The earlier curve is drawn
            faintly behind the other curves, with arrows to the control points that moved.
        :param width: The width of the figure in SVG pixels. The font size is 12 to 19 pixels. Defaults to ``640``.
        :param columns: The number of panels in a row. If omitted, the number of values of ``t`` (with ``by_level``, the
            number of levels), but at most 4.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param labels: Whether points are labeled with their names. Defaults to ``True``.
        :param legend: Whether there is a legend below the panels. Defaults to ``True``.
        :param id, progress: See :class:`Mesh`.
        :returns: The same mesh.
        """
        return self._apply('CurveFigure', {'path': path, 't': t, 'by_level': by_level, 'before': before, 'width': width, 'columns': columns, 'scale': scale, 'labels': labels, 'legend': legend}, None, id, progress)

    def half_edge_figure(
        self,
        path: str | os.PathLike[str] | Ron,
        *,
        faces: Literal['All', 'Boundary', 'SelfIntersecting'] | Choice | Ron | None = None,
        width: int | Ron | None = None,
        scale: int | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the half-edges of some faces of a mesh into an image file.

        Each half-edge is drawn as an arrow beside its edge and inside its face, and is labeled with its name. A thin
        curve leads from the head of the arrow to the next half-edge of the face. The twin of a half-edge is on the
        other side of the edge. Half-edges on the boundary have no face and are gray. The viewer looks at the faces from
        the direction of their mean normal. Faces that face away from the viewer or are seen nearly edge-on are left
        out, and the report counts them. The extension of the file determines the format: ``.svg`` or ``.png``. The
        scene does not change.

        The name of an element is a letter followed by the id of the element: ``v`` for vertices, ``h`` for half-edges,
        ``f`` for faces. Half-edges ``2e`` and ``2e + 1`` belong to edge ``e``.

        Example: ``mesh.half_edge_figure(path="figure.svg")``

        :param path: The file. A relative path is relative to the working directory.
        :param faces: The faces to draw, at most 200. Defaults to ``"All"``. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param id, progress: See :class:`Mesh`.
        :returns: The same mesh.
        """
        return self._apply('HalfEdgeFigure', {'path': path, 'faces': faces, 'width': width, 'scale': scale}, None, id, progress)

    def uv_picture(
        self,
        path: str | os.PathLike[str] | Ron,
        *,
        uv: str | Ron | None = None,
        fill: Literal['None', 'Charts', 'Stretch'] | Ron | None = None,
        edges: bool | Ron | None = None,
        width: int | Ron | None = None,
        scale: int | Ron | None = None,
        id: str | None = None,
        progress: bool | Progress | None = None,
    ) -> Self:
        """Draws the charts of the texture coordinates of a mesh into an image file.

        A gray frame shows the page of the texture, where u and v are from 0 to 1; v points upwards. Thick lines are the
        borders of charts, and thin lines are the other edges. Coordinates outside the page are also drawn. To make room
        for coordinates outside the page, the figure becomes higher or its scale becomes smaller. The extension of the
        file determines the format: ``.svg`` or ``.png``. The scene does not change.

        Example: ``mesh.uv_picture(path="uv.svg")``

        :param path: The file. A relative path is relative to the working directory.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param fill: What the colors inside charts show. Defaults to ``"Charts"``.
            ``"None"``: No colors.
            ``"Charts"``: The charts, in eight colors that repeat.
            ``"Stretch"``: The stretch of angles.
        :param edges: Whether edges inside charts are drawn. Defaults to ``True``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The number of PNG pixels per SVG pixel. Has no effect on ``.svg`` files. Defaults to ``2``.
        :param id, progress: See :class:`Mesh`.
        :returns: The same mesh.
        """
        return self._apply('UvPicture', {'path': path, 'uv': uv, 'fill': fill, 'edges': edges, 'width': width, 'scale': scale}, None, id, progress)
