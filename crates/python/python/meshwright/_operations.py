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
        ``.bzc`` (a Bezier curve) and ``.mws`` (a complete scene). Files in all of these formats except ``.glb`` and
        ``.mws`` can be compressed with gzip. The name of a compressed file ends with ``.gz``, as in ``a.obj.gz``. An
        OBJ file becomes one object of the scene. Objects and groups inside an OBJ file become tags (named sets) of
        faces. For example, a line ``o hat`` gives the tag ``o="hat"``, and a line ``g hat`` gives the tag ``hat``. With
        ``placements="Keep"`` (the default), each mesh of a glTF file becomes an object if at least one node references
        the mesh. If exactly one node references the mesh, the object gets the name of the node. If several nodes
        reference the mesh, the object gets the name of the mesh. With ``placements="Keep"``, the scene also keeps the
        nodes, cameras, lights, skins, morph targets and animations of the glTF file. In a COLLADA file (``.dae``), each
        node with a mesh becomes an object. If the scene cannot store some of the content of the file, the report lists
        and counts this content. The image files of materials are read from the folder that contains the model or its
        material library. If two successive corners of a face are at the same vertex, the second of these corners is
        removed. If the face then has fewer than three corners or still contains a vertex twice, the face is left out.

        Example: ``scene.load(path="teapot.bez")``, in a recipe ``Load(path: "teapot.bez")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            folder of the recipe.
        :param name: The name for objects that have no name in the file. If an ``.mws`` file contains a single object,
            the object gets this name even if the file already names it. If omitted, objects without a name get the name
            of the file without its extension.
        :param non_manifold: What to do if the faces do not form a manifold. This is the case if more than two faces
            share an edge, or if several groups of faces meet only at a vertex, like the tips of two cones. Defaults to
            ``"Split"``.
            ``"Split"``: Split edges and vertices until the faces form a manifold, and list the splits in the report.
            ``"Refuse"``: Refuse to read the file.
        :param orientation: What to do if neighboring faces have opposite orientations. Defaults to ``"Orient"``.
            ``"Orient"``: If possible, reverse faces so that neighboring faces have the same orientation, and list the
                reversed faces in the report.
            ``"Keep"``: Keep the orientation of every face.
        :param duplicates: What to do with a face that has the same vertices as an earlier face, in the same or in the
            opposite order. Defaults to ``"Keep"``.
            ``"Keep"``: Keep the elements.
            ``"Drop"``: Leave the elements out, and list them in the report.
        :param degenerate: What to do with zero-area faces. Defaults to ``"Keep"``.
            ``"Keep"``: Keep the elements.
            ``"Drop"``: Leave the elements out, and list them in the report.
        :param isolated: What to do with vertices without a face. Defaults to ``"Keep"``.
            ``"Keep"``: Keep the elements.
            ``"Drop"``: Leave the elements out, and list them in the report.
        :param placements: What to do with the nodes of a glTF or ``.mws`` file. If the nodes are kept, later operations
            such as ``smooth()`` change a mesh in its own coordinate system, without the transforms of the nodes. The
            change is visible at every node that references the mesh. Defaults to ``"Keep"``.
            ``"Keep"``: Keep the nodes.
            ``"Bake"``: Apply the transforms of the nodes to the points of the meshes.
        :param strict: Whether the operation fails if it would leave out some content of the file. If false, the report
            lists the content that was left out. Defaults to ``False``.
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
        ``.bez`` for Bezier patches, ``.bzc`` for a curve, and ``.mws`` for a complete scene without any loss. A
        ``.csv`` file is a table of the positions and attributes of vertices, faces or corners. An ``.npz`` file stores
        the arrays of a mesh for the Python library ``NumPy``. ``load()`` cannot read ``.csv`` and ``.npz`` files. If
        ``path`` ends with ``.gz``, as in ``a.obj.gz``, the file is compressed with gzip. Files in the formats ``.glb``,
        ``.mws`` and ``.npz`` cannot be compressed with gzip. If the format cannot store some of the content of the
        objects, the report lists this content. The file is created only if all steps of the recipe succeed and all
        expectations of the recipe (checks of the result) are met.

        Example: ``scene.save(path="a.obj")``, in a recipe ``Save(path: "a.obj")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. In the path, ``{name.stem}`` stands for a file name without its extension. The file name is
            taken from the recipe parameter ``name``, whose value must be a file path. For example, ``{input.stem}.glb``
            becomes ``bunny.glb`` if the parameter ``input`` is ``models/bunny.obj``.
        :param images: What to do with the images of materials. If omitted, images are embedded in ``.glb`` files. For
            ``.gltf`` and ``.obj``, the image files of the loaded model are copied to the folder of the output file. If
            images are embedded in the loaded model, a ``.gltf`` file also embeds them. For ``.obj``, embedded images
            are written to separate files, because OBJ cannot embed images.
            ``"Embed"``: Store the images in the file or, for ``.gltf``, in its ``.bin`` file.
            ``"Copy"``: Write the images to files in the folder of the written file.
            ``"Keep"``: Write only the paths of the images, as in the original model.
        :param compress: How to compress the geometry of ``.glb`` and ``.gltf`` files without loss. If omitted, the
            geometry is not compressed.
            ``"Meshopt"``: The extension ``EXT_meshopt_compression``.
        :param quantize: The number of bits for each attribute of the geometry in ``.glb`` and ``.gltf`` files. If
            omitted, numbers are stored as 32-bit floats. ``quantize={}`` uses the default number of bits for each
            attribute. The report states the largest rounding errors of this operation: in positions, in normals and
            tangents, and in texture coordinates.
            ``"position"``: The number of bits of each coordinate of a position. Positions are rounded to the points of
                a grid. The grid covers the bounding box of the object and has the same spacing along all axes. Along
                the longest side of the box, the grid has 2^bits - 1 steps. Positions of objects with joints or morph
                targets are not quantized. Defaults to 16.
            ``"normal"``: The number of bits of each of the two numbers that represent a normal or a tangent. The two
                numbers locate a point on an octahedron. Defaults to 8.
            ``"uv"``: The number of bits of each texture coordinate. If one coordinate in a set of texture coordinates
                is outside the range from 0 to 1, the whole set is not quantized. Defaults to 16.
            ``"color"``: The number of bits of each component of a color. Defaults to 8.
        :param weight_sets: For a skinned mesh in a ``.gltf`` or ``.glb`` file, the largest number of sets of joints for
            each vertex. A set has four joints and their weights. For example, if the limit is 2, up to eight joints
            move a vertex. If omitted, the limit is the number of sets in the file that the mesh was loaded from, or 1
            if this number is not known.
        :param rows: For ``.csv``, the elements that have a row in the table: vertices, faces or corners. If omitted,
            vertices.
            ``"Vertices"``: Vertices.
            ``"Faces"``: Faces.
            ``"Corners"``: The corners of the faces, face by face.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The id of each vertex is the index of its point in ``points``, and the id of each face is its index in
        ``faces``. If connected faces have opposite orientations, the faces with the less frequent orientation are
        reversed. If the orientations of the connected faces cannot be made to agree, as in a Moebius strip, none of
        these faces is reversed. Two kinds of edges are split: edges with more than two faces, and edges whose two faces
        still have opposite orientations. At a split edge, pairs of faces with consistent orientations stay connected.
        Each pair, and each face that is left over, gets its own copy of the edge. A vertex is split if its faces form
        several fans (groups of faces that are connected by edges at the vertex). One fan keeps the vertex, and each
        other fan gets a copy of the vertex. The copies of vertices get the highest ids. The report and the command
        ``check`` list the reversed and split elements.

        Example: ``scene.polygons(name="new", points=[(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces=[[0, 1, 2]])``, in a
        recipe ``Polygons(name: "new", points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])``

        :param points: The points ``(x, y, z)``, in scene units. Points that no face uses become isolated vertices.
        :param faces: The faces. Each face lists the indices of its points, in counter-clockwise order as seen from
            outside. The first of the ``points`` has the index 0. A face has at least three points, without duplicates.
        :param name: The name of the new object. Defaults to the first of the names ``polygons``, ``polygons.2``,
            ``polygons.3`` and so on that no other object has.
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
        +y and -x. In the same order, the vertex ids of the squares are (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3,
        7, 5), (3, 2, 6, 7) and (2, 0, 4, 6). The id of a vertex is a sum: 1 if the vertex is on the side +x, plus 2 if
        it is on the side +y, plus 4 if it is on the side +z.

        Example: ``scene.cube(name="new", size=3, center=(1, 2, 3))``, in a recipe ``Cube(name: "new", size: 3, center:
        (1, 2, 3))``

        :param name: The name of the new object. Defaults to the first of the names ``cube``, ``cube.2``, ``cube.3`` and
            so on that no other object has.
        :param size: The length of the edges, in scene units. More than 0. Defaults to ``2.0``.
        :param center: The center of the cube, in scene units.
        :param triangles: Whether to cut each square (a, b, c, d) along its diagonal from a to c into the triangles (a,
            b, c) and (a, c, d). The square with the id f becomes the faces with the ids 2 f and 2 f + 1. The diagonals
            of the squares join the vertices 0-3, 4-7, 0-5, 1-7, 3-6 and 2-4. Defaults to ``False``.
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

        :param name: The name of the new object. Defaults to the first of the names ``tetrahedron``, ``tetrahedron.2``,
            ``tetrahedron.3`` and so on that no other object has.
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

        :param name: The name of the new object. Defaults to the first of the names ``octahedron``, ``octahedron.2``,
            ``octahedron.3`` and so on that no other object has.
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

        The vertices are the corners of three rectangles with the side ratio 1 : (1 + √5) / 2. The rectangles have the
        same center, and each is parallel to a different coordinate plane.

        Example: ``scene.icosahedron(name="new")``, in a recipe ``Icosahedron(name: "new")``

        :param name: The name of the new object. Defaults to the first of the names ``icosahedron``, ``icosahedron.2``,
            ``icosahedron.3`` and so on that no other object has.
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

        :param name: The name of the new object. Defaults to the first of the names ``grid``, ``grid.2``, ``grid.3`` and
            so on that no other object has.
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

        The vertices form rings, one for each cross section of the tube. The number of rings is ``around``, and each
        ring has ``across`` vertices. With i and j counted from 0, vertex j of ring i has the id ``i * across + j``.
        Ring 0 is in the direction +x from the center of the torus. Vertex 0 of each ring is the vertex farthest from
        the axis.

        Example: ``scene.torus(name="new", around=7, across=5, major=2, minor=0.5)``, in a recipe ``Torus(name: "new",
        around: 7, across: 5, major: 2, minor: 0.5)``

        :param name: The name of the new object. Defaults to the first of the names ``torus``, ``torus.2``, ``torus.3``
            and so on that no other object has.
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

        The vertices of the rim at -z come first, and then the vertices of the rim at +z. The first vertex of each rim
        is in the direction +x from the axis, and the others follow counter-clockwise, seen from +z. The rectangles
        around the axis are the faces with the lowest ids. With ``caps=True``, the two caps follow: first the cap at -z,
        then the cap at +z. Each cap is one polygon.

        Example: ``scene.cylinder(name="new", around=6, radius=1, height=2, caps=True)``, in a recipe ``Cylinder(name:
        "new", around: 6, radius: 1, height: 2, caps: true)``

        :param name: The name of the new object. Defaults to the first of the names ``cylinder``, ``cylinder.2``,
            ``cylinder.3`` and so on that no other object has.
        :param around: The number of rectangles around the axis. At least 3. Defaults to 32.
        :param radius: The distance from the axis to the vertices, in scene units. More than 0. Defaults to ``1.0``.
        :param height: The height along z, in scene units. More than 0. Defaults to ``2.0``.
        :param caps: Whether each end is closed by a face. Defaults to ``True``.
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
        """Creates a sphere whose edges follow meridians and circles of latitude, with poles at -z and +z.

        Vertex 0 is the pole at -z. The vertices between the poles follow, circle by circle from -z to +z. The first
        vertex of each circle is in the direction +x from the axis, and the others follow counter-clockwise, seen from
        +z. The last vertex is the pole at +z.

        Example: ``scene.uv_sphere(name="new", around=8, rings=4, radius=2)``, in a recipe ``UvSphere(name: "new",
        around: 8, rings: 4, radius: 2)``

        :param name: The name of the new object. Defaults to the first of the names ``uvsphere``, ``uvsphere.2``,
            ``uvsphere.3`` and so on that no other object has.
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

        The operation acts on the objects that its parameter ``on`` lists. Without ``on``, a method of a scene acts on
        all objects that consist of Bezier patches. Each object becomes one mesh of the same name. Every patch is
        divided into ``segments`` x ``segments`` cells. Vertices, edges and faces of earlier patches have lower ids.
        Different patches share no vertices. If two patches have the same control points on a common side, their
        vertices on this side have exactly equal positions. ``weld(distance=0)`` then joins the patches. If all points
        of a side coincide, as at the pole of a teapot's lid, the side becomes one vertex. Patches without area give no
        faces. The report counts the patches without area. The mesh has UVs only with ``uvs=True``, and normals only
        with ``normals=True``.

        Example: ``scene.tessellate(segments=3)``, in a recipe ``Tessellate(segments: 3)``

        :param segments: The number of cells along each side of a patch. Defaults to ``8``.
        :param faces: Whether each cell becomes triangles or quads. Defaults to ``"Triangles"``.
            ``"Triangles"``: Two triangles, divided by the diagonal from the corner with the lowest u and v to the
                opposite corner.
            ``"Quads"``: One quad.
        :param uvs: Whether to store the patch parameters (u, v) of each vertex as UVs of the face corners at this
            vertex. The UVs of different patches overlap, because each patch covers the whole square from 0 to 1.
            Defaults to ``False``.
        :param normals: Whether to store the exact unit normals of the patches as vertex normals. Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Each curve becomes one polyline in the plane z = 0. The polyline has ``segments`` + 1 points, at the curve
        parameters 0, 1 / segments, 2 / segments and so on, up to 1. The first and the last point are exactly the first
        and the last control point of the curve.

        Example: ``scene.sample_curve(segments=1)``, in a recipe ``SampleCurve(segments: 1)``

        :param segments: The number of straight segments of each polyline.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Replaces each curve with polylines that show the levels of de Casteljau's algorithm.

        A curve with n control points becomes n polylines in the plane z = 0. The first polyline is the control polygon
        with n points. The points of each later polyline divide the segments of the previous polyline in the ratio t : 1
        - t. Each polyline therefore has one point fewer than the previous polyline. The last polyline has a single
        point, the point of the curve at ``t``.

        Example: ``scene.curve_levels(t=0)``, in a recipe ``CurveLevels(t: 0)``

        :param t: The curve parameter at which the algorithm computes a point, from 0 (the start of the curve) to 1 (the
            end).
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Moves one control point of each curve.

        The other control points do not move. The point of the curve at a parameter t moves by B(t) d. Here, d is the
        displacement of the control point, and B is the Bernstein polynomial of the control point.

        Example: ``scene.move_control_point(index=1, to=(2, -3.5))``, in a recipe ``MoveControlPoint(index: 1, to: (2,
        -3.5))``

        :param index: The index of the control point, from 0. Every curve on which the operation acts must have a
            control point with this index.
        :param to: The new position: ``(x, y)`` in the plane z = 0, in scene units.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The operation acts on the objects that its parameter ``on`` lists. Without ``on``, a method of a scene acts on
        all objects that consist of Bezier patches. If other control points of the object are at the same position, they
        also move, so that patches with a common side stay joined. The point of a patch at the parameters (u, v) moves
        by B(u) C(v) d. Here, d is the displacement of the control point, B is the Bernstein polynomial of its column,
        and C is the Bernstein polynomial of its row. The report counts the changed objects.

        Example: ``scene.move_patch_point(index=5, to=(1, 2, 0.5))``, in a recipe ``MovePatchPoint(index: 5, to: (1, 2,
        0.5))``

        :param index: The index of the control point in the object: 16 p + 4 r + c. Here, p is the index of the patch, r
            is the row and c is the column, all counted from 0. Every object on which the operation acts must have a
            control point with this index.
        :param to: The new position ``(x, y, z)``, in scene units.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        nodes of the scene (as in glTF) place the object, each of these nodes gets a sibling node. The sibling node
        places the copy at the same location.

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

        The remaining objects keep their order. If a node of the scene (as in glTF) places a deleted object, the
        operation also removes the node. However, if the node has children, a camera or a light, or is a joint of a
        skin, the node is kept without the object.

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

        The order of the objects does not change. If an object comes from a glTF file, the object, its nodes and its
        mesh each have a name, and these names can differ. A node or mesh with the old name of the object also gets the
        new name. If no node has the old name, the mesh gets the new name even if the mesh did not have the old name.

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

        Each mesh becomes a part of the result. Vertices, edges and faces are numbered part by part, in the order of
        ``objects``. The parts are not connected, even where they touch. In the scene, the result replaces the first
        mesh in ``objects``, and the other meshes are removed. If nodes of the scene (as in glTF) place a mesh, the
        result contains a copy of the mesh for each of these nodes. The points of each copy are transformed by the
        transform of the node. The result keeps a skin only if all skinned parts have the same skin and each of them has
        exactly one node. In this case, the result also keeps the node of the first skinned part. Parts without a skin
        then follow the first joint of the skin. If no skin is kept, skinned parts are joined in their current pose. The
        result then has no node, because its points are already at their positions in the scene. The names and default
        weights of morph targets are kept if they are the same in all parts that have morph targets.

        If only some of the parts have an attribute, the value of this attribute is zero in all other parts. Missing
        material indices become -1 (no material). If a part has no normals, the normals of all parts are dropped and
        reported as lost. If an attribute of a part has a different type than in earlier parts, the attribute of this
        part is dropped and reported as lost. Equal materials become one material.

        Example: ``scene.join(objects=["mesh", "other"], name="joined")``, in a recipe ``Join(objects: ["mesh",
        "other"], name: "joined")``

        :param objects: The names of the meshes. At least one name, without duplicates.
        :param name: The name of the result, which can be the name of one of the joined meshes.
        :param tag_parts: Whether to tag the faces of each part with the name of the part. In later operations,
            ``sel.Tagged("head")`` then selects the faces of the part "head". Defaults to ``True``.
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

        The parts of an object "figure" get the names "figure 1", "figure 2" and so on. In the list of objects, the
        first part replaces the original object, and the other parts come last. Elements keep their order and their
        values. Every part keeps the whole list of materials. Vertices without a face are dropped. The report counts
        them. The operation fails if the mesh has no faces.

        Nodes of the scene (as in glTF) that placed the original object now place the first part. Each of these nodes
        gets child nodes that place the other parts at the same location.

        If several parts come from one connected component, each of these parts gets its own copies of the edges and
        vertices between the parts. Within a part, the faces around a vertex can form several fans that share no edge at
        this vertex. Each fan then gets a separate copy of the vertex.

        Example: ``scene.separate(object="mesh")``, in a recipe ``Separate(object: "mesh")``

        :param object: The name of the mesh.
        :param by: How the faces are grouped into parts. Defaults to ``"Components"``.
            ``"Components"``: One part for each connected component, in order of the lowest face id in each component.
            ``"Material"``: One part for each material that at least one face has, in order of the materials.
            ``choice.Tag(..)``: Two parts: the first part has the faces with the tag of this name, and the second part
                has all other faces.
        :param count: The expected number of parts. The operation fails if the number of parts is not ``count``. If
            omitted, the number and names of the parts are known only during the run. Later operations that refer to
            objects by name can then not be checked before the run.
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
        and polylines. If nodes of the scene (as in glTF) place an object and ``space`` is ``Scene``, the operation
        changes the transforms of these nodes instead of the points. The descendants of these nodes move with them. A
        skinned mesh follows its joints, so with ``space="Scene"``, the operation moves the joints. If the transform of
        a node is animated, the animation would overwrite the change. The operation therefore gives this node a new
        parent and moves the parent. Root nodes without an object, such as the nodes of cameras and lights, also move if
        three conditions hold: ``space`` is ``Scene``, the operation has no ``on``, and ``about`` is not ``Center``. The
        operation fails if a curve would leave the plane z = 0.

        Ids do not change. If the points of a mesh change, its normals, its tangents and the deltas of its morph targets
        are also transformed. Other attributes do not change. If the points are mirrored (one or three negative factors
        in ``scale``), the faces are also reversed, so that they stay counter-clockwise seen from outside. In a reversed
        face, the first corner stays first, and the other corners follow in reverse order. In mirrored patches, u and v
        are exchanged, so that the same side of the surface remains the outside. Attributes with the edit rule ``Drop``,
        such as tangents of corners, are removed by every step that changes the connectivity. Mirroring the points
        reverses the faces, so it also removes the attributes with this rule.

        Example: ``scene.transform(scale=(2, 1, 1), rotate=[{"axis": "Z", "angle": 90}], move=(3, 1, 0))``, in a recipe
        ``Transform(scale: (2, 1, 1), rotate: [(axis: Z, angle: 90)], move: (3, 1, 0))``

        :param scale: The scale factors along x, y and z. Factors must not be 0. A negative factor mirrors along its
            axis.
        :param rotate: The rotations, applied in the order of the list.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param move: The distances to move along x, y and z, in scene units.
        :param about: The point that scaling and rotation do not move. Defaults to ``"Origin"``.
            ``"Origin"``: The origin.
            ``"Center"``: The center of the bounding box of each object.
            ``choice.Point(..)``: A point with the coordinates x, y, z.
        :param space: The coordinate system in which objects are scaled, rotated and moved. Defaults to ``"Scene"``.
            ``"Scene"``: The space of the scene.
            ``"Object"``: The coordinate system in which the object stores its points.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Places copies of an object on a surface, at random positions that are evenly spread.

        Exactly ``count`` points are chosen so that no two of them are close together (Yuksel, "Sample Elimination for
        Generating Poisson Disk Sample Sets", 2015). Each copy is an instance: a node that references the object. Copies
        therefore need almost no memory, and almost no space in ``.gltf``, ``.glb`` and ``.mws`` files. The node of each
        copy moves the origin of the object to one of the points. To make one mesh of all copies, use ``join()`` in a
        later operation. If no node placed the object before the operation, the object disappears from its original
        position and is visible only at the points.

        Without ``object``, the result is a mesh whose vertices are the chosen points. The mesh has no faces. Its vertex
        normals are the normals of the surface at the points.

        Example: ``scene.scatter(surface="mesh", count=20, seed=7)``, in a recipe ``Scatter(surface: "mesh", count: 20,
        seed: 7)``

        :param surface: The name of the object on whose surface the points lie. This object must be a mesh that appears
            only once in the scene (a single instance).
        :param count: The number of points.
        :param object: The name of the object that is copied. If omitted, the operation creates a mesh of points instead
            of copies.
        :param seed: The seed of the random numbers. Two steps with the same seed, surface and count choose the same
            points. A different seed gives different points. Defaults to ``0``.
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
        """Merges vertices that are close together, so that the faces at these vertices become connected.

        Two vertices are linked if they are at most ``distance`` apart. Vertices that are connected by a chain of links
        merge into one, even if the ends of the chain are farther apart than ``distance``. Of the vertices that merge,
        the vertex with the lowest id remains, with its position and values. The other vertices are removed, so vertices
        with higher ids get new ids. If several edges then join the same two vertices, they become one edge. The merged
        edge gets the values of the edge with the lowest id. Corner values, such as UVs, stay with the corners of the
        faces, so UV seams are kept.

        If neighboring corners of a face merge, the face loses a corner. A face is removed if it has fewer than three
        corners left or would contain a vertex twice. After the merge, neighboring faces can have opposite orientations.
        If possible, the operation then reverses faces, so that all faces of a connected part have the same orientation:
        the more frequent one. The report counts the reversed faces. If faces are reversed, the normals of vertices and
        corners are dropped. If the result is still not a manifold, vertices and edges are copied. For example, if three
        faces share an edge, one of these faces gets a copy of the edge. The report counts the copies. If no vertices
        merge, the mesh does not change.

        Example: ``scene.weld(distance=0)``, in a recipe ``Weld(distance: 0)``

        :param distance: The largest distance between linked vertices, in scene units. With 0, only vertices at equal
            positions merge.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Reverses the orientation of faces, so that their inside and outside are exchanged.

        Adjacent faces must have the same orientation, so only whole connected components can be reversed. If a selected
        face shares an edge with a face that is not selected, the operation fails. No vertex moves, and all elements
        keep their ids. The first corner of a face stays first, and the other corners follow in reverse order. Normals
        are negated. Attributes that do not survive changes of the connectivity (edit rule ``Drop``), such as tangents
        of corners, are removed. Vertices, edges and faces keep all other values. The values of a corner stay at the
        same vertex of the same face.

        Example: ``scene.reverse()``, in a recipe ``Reverse()``

        :param faces: The faces to reverse. The faces must form whole connected components. Defaults to ``"All"``.
            ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A quadrilateral is cut along its shorter diagonal. If both diagonals have the same length, the diagonal at the
        vertex with the lowest id is used. Two lengths count as the same if the relative difference of their squares is
        at most 1e-12. A diagonal is bad if one of its two triangles has zero area or is turned over. A triangle is
        turned over if it is clockwise where the face is counter-clockwise. If exactly one diagonal is bad, the good
        diagonal is used, regardless of lengths and ids. A quadrilateral with a reflex corner (an angle above 180
        degrees) is therefore cut at that corner. A diagonal is a duplicate if its ends are also joined by an edge or by
        a diagonal of another face. A duplicate is replaced with the other diagonal of the quadrilateral, unless the
        other diagonal is worse or also a duplicate. The report counts the duplicates that remain.

        A face with more than four corners is projected along its normal. If the face has at most 4096 corners, it is
        cut into triangles by ear clipping. A larger face is first cut into monotone polygons, which are then cut into
        triangles. Then diagonals are flipped until the triangulation is a constrained Delaunay triangulation. Some
        faces cannot be triangulated in this way: faces with zero area, faces with crossing sides, and faces with more
        than ten million corners. A face with overlapping sides also cannot be triangulated in this way if it has more
        than 4096 corners. Each of these faces becomes a triangle fan around its vertex with the lowest id. The report
        counts these faces.

        In the list of faces, the triangles of a face take the place of this face, so faces with higher ids get new ids.
        The triangles have the values of the face. Vertices and edges keep their ids. Each corner of a triangle has the
        values that the face had at the same corner.

        Example: ``scene.triangulate()``, in a recipe ``Triangulate()``

        :param faces: The faces to cut. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Edges are flipped in order of their ids. Each flip is checked against the mesh that the earlier flips have
        produced. A flip is refused if the edge is on the boundary or if the same face is on both sides of the edge. A
        flip is also refused if an end of the edge has only two edges. A flip is also refused if the new edge would join
        a vertex to itself, or would join two vertices that an edge already joins. The flip of a seam is refused unless
        ``seams`` is ``Drop``. All elements keep their ids, and no vertex moves. Vertices, edges and faces keep their
        values. Each of the two faces gets one new corner. The new corner of a face gets its values from the corner of
        the other face at the same vertex. All other corners keep their values.

        If a face beside the edge has more than three corners, the edge turns inside the polygon that the two faces form
        together. Each end of the edge moves to the next corner of this polygon, counter-clockwise. With
        ``until="Delaunay"`` or ``until="Valence"``, only edges between two triangles are flipped.

        With ``until="Delaunay"`` or ``until="Valence"``, an edge is flipped only if the flip improves the angles of the
        triangles (``Delaunay``) or the numbers of edges at the vertices (``Valence``). The operation makes several
        passes over the edges. It stops after a pass that flips no edge, or after ``passes`` passes. The flips neither
        fold the surface nor create zero-area triangles. If a flip that would improve the mesh is refused, the edge is
        left unchanged, and the operation does not fail. The report counts the refused flips for each reason. The report
        also states the number of passes, and whether the operation stopped because of the limit ``passes``.

        On a surface that is not flat, a flip changes the shape. To keep creases and other edges, exclude them from
        ``edges``. For example, ``sel.Flat(below=30)`` selects only edges at which the surface bends by less than 30
        degrees. ``sel.Not(sel.Tagged("keep"))`` selects only edges without the tag "keep".

        Example: ``scene.flip_edges(edges="All")``, in a recipe ``FlipEdges(edges: All)``

        :param edges: The edges to flip. The edges are selected before the first flip. An edge keeps its id when it is
            flipped. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param until: Which edges are flipped, and when to stop. Defaults to ``"Once"``.
            ``"Once"``: Flip each edge once.
            ``"Delaunay"``: Flip edges until no flip reduces the sum of the cotangents of all angles of all triangles.
            ``"Valence"``: Flip edges until no flip brings the valences (the numbers of edges) of the vertices closer to
                their targets.
        :param passes: The largest number of passes over the edges. Ignored with ``until="Once"``, which makes one pass.
            Defaults to ``100``.
        :param on_refusal: What to do when a flip is refused. Used only with ``until="Once"``. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param seams: What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
            Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Inserts a vertex on each edge and joins this vertex to the opposite corners of the triangles beside the edge.

        In a mesh of triangles, the split of an inner edge adds 1 vertex, 3 edges and 2 faces. The split of a boundary
        edge adds 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face is not
        cut and only gains the new vertex as a corner. Edges are split in order of their ids; new edges are not split
        again. New vertices get the highest ids, in the order of the splits. Attribute values at the new vertex and at
        its corners are interpolated between the ends of the edge. A seam is an edge whose corner values, such as UVs,
        differ between its two sides. At a seam, the corner values of each side are interpolated separately.

        Example: ``scene.split_edges(edges="All")``, in a recipe ``SplitEdges(edges: All)``

        :param edges: The edges to split. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the new vertex on the edge, as a fraction of the length of the edge. Above 0 and
            below 1. If ``edges`` is ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other
            selections, position 0 is at the end whose vertex has the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a split is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        In a mesh of triangles, the collapse of an inner edge removes 1 vertex, 3 edges and 2 faces. The collapse of a
        boundary edge removes 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the
        face is not removed and only loses a corner. Of the two ends, the vertex with the lower id is kept. Edges are
        collapsed in order of their ids. An edge that an earlier collapse removed counts as refused.

        A collapse is refused if it would change the topology of the surface, or if two different elements would become
        one. The report or the error message gives one of these reasons:

        - ``JoinsBoundaries``: both ends of the edge are on the boundary, but the edge itself is not.
        - ``Link``: the ends have a common neighboring vertex that is not a corner of a triangle beside the edge.
          Examples are the edges around a tube with three sides, and the edges of a hole with three edges.
        - ``DuplicateEdge``: a second edge joins the same two vertices.
        - ``RepeatedVertex``: both ends are also corners of a face that is not beside the edge.
        - ``Vanishes``: at the remaining vertex, the collapse would leave no face (as for a single triangle), or only
          two faces that lie back to back (as for a tetrahedron).
        - ``SameFace``: the same face is on both sides of the edge, or the collapse would put the same face on both
          sides of another edge.
        - ``SameOpposite``: the two triangles beside the edge share another edge.

        Attribute values at the remaining vertex and at its corners are interpolated between the ends of the edge. A
        seam is an edge whose corner values, such as UVs, differ between its two sides. At a seam, the corner values of
        each side are interpolated separately. When two edges become one, the remaining edge gets the larger crease
        value (sharpness for subdivision) and the tags of both edges. Normals are dropped.

        Example: ``scene.collapse_edges(edges="All", on_refusal="Skip")``, in a recipe ``CollapseEdges(edges: All,
        on_refusal: Skip)``

        :param edges: The edges to collapse. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the remaining vertex on the old edge, as a fraction of the length of the edge, from 0
            to 1. If ``edges`` is ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other
            selections, position 0 is at the end whose vertex has the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a collapse is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Edges are removed in order of their ids. Each removal is checked against the mesh that the earlier removals have
        produced. A removal reduces the number of edges by 1 and the number of faces by 1. Of the two faces beside the
        edge, the face with the lower id is kept, with its values. No vertex is removed or moved. To remove vertices
        that are left with two edges, use ``dissolve_vertices(vertices=sel.Valence(2))`` in a later operation. The
        remaining elements keep their order and their values but get new ids.

        An edge cannot be removed if it is on the boundary or if the same face is on both of its sides. It also cannot
        be removed if one of its ends has only two edges. The two faces beside the edge must have no common vertices
        except the ends of the edge. A seam is removed only if ``seams`` is ``Drop``.

        Example: ``scene.dissolve_edges(edges=sel.Between(0, 1))``, in a recipe ``DissolveEdges(edges: Between(0, 1))``

        :param edges: The edges to remove. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param seams: What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
            Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A selected edge and both of its ends are removed, and a new face replaces the edge. On both sides, the new face
        extends up to the distance ``width`` from the old edge. An edge that is not selected, but ends at a vertex of a
        selected edge, is shortened at this vertex. If the shortened edge and the selected edge are neighboring sides of
        a face, the new end of the shortened edge is at the distance ``width`` from the selected edge. However, the edge
        is shortened by at most four times ``width``. If the two edges are not neighboring sides of a face, the edge is
        shortened by ``width``. If two selected edges are neighboring sides of a face, a new vertex inside this face
        replaces the corner between them. If three or more new vertices replace an old vertex, another new face joins
        the new vertices. All selected edges are beveled at once. For example, a cube with 12 selected edges keeps all
        of its symmetries.

        The vertices at the ends of selected edges are removed, so vertices with higher ids get new ids. New vertices
        get the highest ids. Faces keep their ids. New faces get the highest ids: first the faces that replace edges, in
        order of these edges, then the faces that replace vertices. Edges get new ids.

        The values of a new vertex are interpolated between corners of an old face, so textures stay in place. A new
        face has the values (material, tags) of one of the old faces beside it. It is not specified which of these faces
        is used, but the choice is the same in every run. New edges have zero values (no crease, no tags). Normals are
        dropped.

        An edge cannot be beveled if it is on the boundary (reason: ``Boundary``), or if one of its ends has only one
        other edge and this other edge is not selected (reason: ``FewEdges``). If the bevels at the two ends of any edge
        would overlap, the selected edges at these ends cannot be beveled (reason: ``OutsideEdge``). If the result would
        not be manifold, no edge is beveled (reason: ``NonManifold``).

        Example: ``scene.bevel_edges(edges=sel.Between(0, 2), width=0.25)``, in a recipe ``BevelEdges(edges: Between(0,
        2), width: 0.25)``

        :param edges: The edges to bevel. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param width: The distance of each new edge from the old edge, in scene units. Two new edges replace the old
            edge: one in each of the faces beside it. Either ``width`` or ``fraction`` must be given.
        :param fraction: The width as a fraction of a length: the length of the shortest edge that is selected or shares
            a vertex with a selected edge. Above 0 and below 1.
        :param on_refusal: What to do when an edge cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The operation sets two attributes to ``sharpness``: the edge attribute ``crease`` of the selected edges, and the
        vertex attribute ``corner`` of the selected vertices. Elements that are not selected keep their values, or get 0
        if the attribute did not exist before the operation. In Loop and Catmull-Clark subdivision, an edge or a vertex
        with sharpness s stays sharp in the first s levels and becomes smooth in later levels. For example, an edge with
        sharpness 2.5 is sharp in the first two levels. The third level places the vertices halfway between the sharp
        and the smooth result. An edge with sharpness 10 stays sharp, however many levels follow. Boundary edges are
        always sharp.

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
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        order of the poked faces. The new vertex is at the mean of the positions of the corners, moved along the normal
        of the face by ``distance``. At the new vertex, interpolated attributes, such as UVs, get the mean of their
        values at the corners of the face. The triangles have the values of their face, and the new edges have zero
        values (no crease, no tags). If ``distance`` is not 0, normals are dropped.

        A face cannot be poked if it contains a vertex twice, or if the position of the new vertex would not be finite.
        No face can be poked if the mesh already has the largest supported number of elements.

        Example: ``scene.poke_faces()``, in a recipe ``PokeFaces()``

        :param faces: The faces to poke. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param distance: The distance of the new vertex from the center of the face, along the normal of the face, in
            scene units. A negative distance moves the vertex inwards. A zero-area face has no normal, so its new vertex
            is at the center. Defaults to ``0.0``.
        :param on_refusal: What to do when a face cannot be poked. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Each pair (v, w) of vertices in ``between`` cuts the face that has both vertices as corners. The new edge joins
        the two vertices. Each cut adds 1 edge and 1 face. Cuts are made in the order of the list, so a face can be cut
        several times. A cut from v to w divides the face into two parts. Seen from outside, the part to the right of
        the line from v to w becomes the new face. The other part keeps the id of the old face. New edges and faces get
        the highest ids. Corners keep their values. The new face has the values of the old face, and the new edge has
        zero values (no crease, no tags).

        A cut is refused if the two vertices are the same or are already joined by an edge. A cut is also refused if no
        face has both vertices as corners. If several faces have both vertices as corners, the cut is refused because it
        is ambiguous.

        Example: ``scene.split_faces(between=[])``, in a recipe ``SplitFaces(between: [])``

        :param between: The cuts, as a list of pairs of vertex ids, for example ``[(0, 2), (5, 9)]``.
        :param on_refusal: What to do when a cut is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        that lose their last edge are also removed, unless ``keep_vertices`` is true. Vertices that had no edge before
        the operation are kept. The remaining elements keep their order and their values but get new ids. To delete
        edges or vertices together with their faces, select the faces with ``sel.FacesBeside("edges")`` or
        ``sel.FacesAround("vertices")``.

        The removal is refused if the remaining faces around a vertex would form several fans that meet only at this
        vertex. A fan is a group of faces that are connected across edges. With ``on_refusal="Skip"``, the operation
        then tries to remove the faces one by one, in order of their ids. The operation repeats these attempts until no
        more selected faces can be removed. Selected faces that still cannot be removed are kept, and the report counts
        them as refused.

        Example: ``scene.delete_faces(faces="All")``, in a recipe ``DeleteFaces(faces: All)``

        :param faces: The faces to delete. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when some of the faces cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param keep_vertices: Whether to keep vertices that are left without an edge. Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Selected faces that are connected across edges form a region. A region moves as a whole, and has one normal and
        one center. A region is first scaled, then rotated, and then moved. Scaling and rotation are about the center of
        the region, which is the mean position of its vertices. Side faces with four corners are added along the rim of
        the region. An edge belongs to the rim if exactly one of its two sides has a face of the region. If all faces of
        an open sheet are extruded, the result is a box that is open where the sheet was. A closed region (for example,
        all faces of a cube) has no rim, so it moves without new side faces. A region has no normal if the area vectors
        of its faces cancel each other out, as in a closed region. For a region without a normal, ``by`` must be an
        ``choice.Offset``.

        The moved faces keep their ids. A later operation can therefore extrude the same faces again, for example to
        grow an arm out of a body. Vertices and edges inside a region also keep their ids. The vertices and edges of the
        old rim do not move, and the moved faces get a new rim. New side faces get the highest ids. Side faces are
        ordered by region, and within a region by the id of the adjacent moved face. Regions are ordered by their lowest
        face id. Around each moved face, the order is counter-clockwise from its first corner. Each side face adds one
        new vertex, so the new vertices are in the order of the side faces. A new vertex is a copy of a vertex on the
        old rim: the first vertex of its side face.

        A side face has the attribute values (material, tags) of the adjacent moved face. The corners of a side face
        have the values of the corners of the moved face, so textures have no seam between the two faces. However, a
        side face shows only one line of the texture: the line along the edge of the moved face. This line is stretched
        over the whole side face. The edges of the new rim have the values of the edges of the old rim (creases, tags).
        The edges between the old and the new rim have zero values (no crease, no tags). Normals are dropped.

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
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Each face is inset separately, even if selected faces share edges. The shrunk inner face keeps the id of the
        selected face, and existing vertices do not move. For a face with n corners, the operation adds n vertices, 2 n
        edges and n faces with four corners. New vertices and faces get the highest ids. They are numbered in order of
        the selected faces, and counter-clockwise around each face from its first corner.

        Attribute values at a new corner or vertex are interpolated in the same way as its position, so textures do not
        move on the surface. The interpolation is between the value at the outer corner and the mean of the values at
        all corners of the face. The faces of the ring have the values of the old face (material, tags). The edges of
        the inner face have the values of the old edges beside them. Normals are dropped.

        A face cannot be inset if it is on both sides of one of its edges.

        Example: ``scene.inset_faces(faces="All", fraction=0.25)``, in a recipe ``InsetFaces(faces: All, fraction:
        0.25)``

        :param faces: The faces to inset. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of the new corners between the old corners (0) and the center of the face (1).
            Must be more than 0 and less than 1.
        :param on_refusal: What to do when a face cannot be inset. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The operation works like ``inset_faces()``, and also moves the inner face along its normal. Each face is beveled
        separately, even if selected faces share edges. The shrunk inner face keeps the id of the selected face, and
        existing vertices do not move. For a face with n corners, the operation adds n vertices, 2 n edges and n faces
        with four corners. New vertices and faces get the highest ids. They are numbered in order of the selected faces,
        and counter-clockwise around each face from its first corner. A zero-area face has no normal, so its inner face
        is not raised.

        Attribute values at a new corner or vertex are interpolated by ``fraction``. Here, 0 stands for the value at the
        outer corner, and 1 stands for the mean of the values at all corners of the face. The faces of the ring have the
        values of the old face (material, tags). The edges of the inner face have the values of the old edges beside
        them. Normals are dropped.

        A face cannot be beveled if it is on both sides of one of its edges.

        Example: ``scene.bevel_faces(faces="All", fraction=0.25, distance=0.5)``, in a recipe ``BevelFaces(faces: All,
        fraction: 0.25, distance: 0.5)``

        :param faces: The faces to bevel. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of the new corners between the old corners (0) and the center of the face (1),
            before the inner face is raised. Must be more than 0 and less than 1.
        :param distance: The distance by which the inner face moves along its normal, in scene units. A negative
            distance moves the inner face in the direction opposite to its normal.
        :param on_refusal: What to do when a face cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Vertices are removed in order of their ids. Each removal is checked against the mesh that the earlier removals
        have produced. If a vertex has three or more edges, all faces around it become one face. The merged face
        replaces the old face with the lowest id, and has the values of this old face. If the vertex is on the boundary,
        its two boundary edges also become one edge. If the vertex has only two edges, these edges become one edge, and
        each face beside this edge loses a corner. When two edges become one, the edge with the lower id is kept, with
        its values. The remaining elements keep their order and their values but get new ids. Normals are dropped.

        A vertex cannot be removed if it is isolated or has a single edge. It also cannot be removed if a neighboring
        vertex would be left with a single edge, because this edge would end inside a face. A removal is also refused if
        a face would contain a vertex twice or have fewer than three corners. A removal is also refused if it would join
        two vertices that an edge already joins. A vertex on a seam (an edge whose corner values, such as UVs, differ
        between its two sides) is removed only if ``seams`` is ``Drop``.

        Example: ``scene.dissolve_vertices(vertices=sel.Vertices([1]))``, in a recipe ``DissolveVertices(vertices:
        Vertices([1]))``

        :param vertices: The vertices to remove. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when a vertex cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param seams: What to do at seams. Defaults to ``"Refuse"``.
            ``"Refuse"``: Refuse the edit.
            ``"Drop"``: Edit anyway.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Each edge at a selected vertex is cut near this vertex. A new face with a corner at each cut replaces the
        vertex. For example, if all vertices of a cube are beveled with ``fraction=0.25``, the result is a truncated
        cube. The distance of a cut from the vertex is ``fraction`` times the length that the edge had before the
        operation. If both ends of an edge are selected, ``fraction`` must be below 0.5.

        The selected vertices are removed, so the ids of the vertices after them change. New vertices get the highest
        ids, in order of the selected vertices and clockwise around each vertex. Old faces keep their ids. New faces get
        the highest ids, in order of the selected vertices.

        Attribute values at a cut are interpolated between the two ends of the cut edge, so textures do not move on the
        surface. A new face has the values (material, tags) of one of the faces at the vertex. It is not specified which
        of these faces is chosen, but the choice is the same in every run. New edges have zero values (no crease, no
        tags). Normals are dropped.

        A vertex cannot be beveled if it is on the boundary or has fewer than three edges. It also cannot be beveled if
        an earlier cut has left one of its edges too short for a second cut.

        Example: ``scene.bevel_vertices(vertices="All", fraction=0.25)``, in a recipe ``BevelVertices(vertices: All,
        fraction: 0.25)``

        :param vertices: The vertices to bevel. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param fraction: The distance of each cut from the vertex, as a fraction of the length of the cut edge. More
            than 0 and less than 1.
        :param on_refusal: What to do when a vertex cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        removed, because they would contradict the vertex normals. The normal of a vertex is the zero vector if the
        vertex has no faces, if all its faces have zero area, or if their normals cancel each other out. The report
        counts these vertices.

        Example: ``scene.vertex_normals()``, in a recipe ``VertexNormals()``

        :param weight: How the normals of the faces around a vertex are weighted. Defaults to ``"Area"``.
            ``"Area"``: The area of the face.
            ``"Angle"``: The angle of the face at the vertex.
            ``"Uniform"``: The same weight for all faces.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        tangents are written to the corner attribute ``tangent``, which is replaced if it exists. Each value has four
        numbers: a unit vector perpendicular to the normal, and then the sign of the bitangent (1 or -1). ``.glb`` and
        ``.gltf`` files store the attribute as ``TANGENT``. For the computation, polygons are triangulated in the same
        way as for ``.glb`` and ``.gltf`` files. Later operations that change the shape or the faces remove the
        tangents, except a ``transform()`` that does not mirror the points. If the texture coordinates define no
        direction at a corner, the corner gets an arbitrary tangent. This happens, for example, if all corners of a face
        have the same texture coordinates. The report counts the corners with an arbitrary tangent.

        Example: ``scene.tangents()``, in a recipe ``Tangents()``

        :param uv: The name of the attribute with the texture coordinates for the normal map. Defaults to ``uv``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The outer rim of
        an open sheet is also a boundary loop; use ``around`` or ``max_edges`` to exclude it. No vertices are added, and
        existing elements keep their ids. With ``with_="Face"``, a hole with n edges gets one face with n corners. With
        ``with_="Triangles"``, the hole gets n - 2 triangles and n - 3 new edges.

        For holes with up to 500 edges, the triangles have the smallest possible total area. A hole with more than 500
        edges is filled one triangle at a time. Each triangle cuts off a corner of the remaining hole: the corner whose
        two neighboring vertices are closest to each other. Straight and reflex corners are cut off last. If the large
        hole is far from convex, the triangles can overlap. In holes of any size, a new edge never joins two vertices
        that an existing edge already joins. If the operation finds no triangulation without duplicate edges, the hole
        is not filled (reason: ``DuplicateEdge``). A hole with only two edges cannot be filled (reason: ``WrongPlace``).
        To close a hole with two edges, use ``stitch()``.

        New faces have the values of a face beside the hole. A new corner has the values of an existing corner at the
        same vertex. Normals are dropped if a hole was filled.

        Example: ``scene.fill_holes()``, in a recipe ``FillHoles()``

        :param around: Fill only holes with at least one of these vertices. Defaults to ``"All"``. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param max_edges: Fill only holes with at most this number of edges. If omitted, holes with any number of edges
            are filled.
        :param with_: The faces that cover a hole. Defaults to ``"Triangles"``.
            ``"Triangles"``: Triangles.
            ``"Face"``: One face with all vertices of the hole as corners.
        :param on_refusal: What to do when a hole cannot be filled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The parameter
        ``first`` gives a vertex of one hole, and the parameter ``second`` gives a vertex of the other hole. The band
        starts at a new edge that joins these two vertices, and runs once around both holes. Let n and m be the numbers
        of edges of the two holes, where n is at least m. The band then consists of m quadrilaterals and n - m evenly
        spread triangles. The operation adds n edges and no vertices. Both holes can be in one connected part of the
        mesh, which then gets a tunnel or a handle. They can also be in two separate parts of the mesh, which then
        become connected. To bridge holes of two objects, first use ``join()`` to make one mesh of the objects.

        Each new face is beside one edge of the hole that has more edges. If both holes have the same number of edges,
        this edge belongs to the hole of the vertex ``first``. The new face copies the attribute values of the old face
        on the other side of this edge. A new corner has the values of an existing corner at the same vertex. Normals
        are dropped.

        The operation is refused if one of the given vertices is not on the boundary (reason: ``NotBoundary``), or if
        both are on the same hole (reason: ``WrongPlace``). The operation is also refused if a new edge would join two
        vertices that an edge already joins (reason: ``DuplicateEdge``). In this last case, try other vertices of the
        same holes.

        Example: ``scene.bridge_loops(first=0, second=5)``, in a recipe ``BridgeLoops(first: 0, second: 5)``

        :param first: The id of a vertex on the first hole.
        :param second: The id of a vertex on the second hole. A new edge joins this vertex to the vertex ``first``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Two boundary edges coincide if each end of one edge is at most ``distance`` from the corresponding end of the
        other edge. Two edges that coincide only with each other form a pair and are joined. An edge that coincides with
        several edges cannot be joined (reason: ``NonManifold``). To avoid this, choose a ``distance`` that is less than
        the lengths of the edges. ``weld()`` merges all vertices that are close together, but ``stitch()`` merges only
        the ends of edges that it joins.

        When two vertices become one, the vertex with the lower id is kept, with its position and values. When two edges
        become one, the edge with the lower id is kept, with its values. The other vertex or edge is removed, so all
        vertices or edges with higher ids get new ids. Faces and corners do not change, so an edge whose sides have
        different UVs becomes a seam. If a hole with only two edges remains beside a joined edge, the two edges of this
        hole are also joined.

        A pair of edges cannot be joined if both edges belong to the same face (reason: ``SameFace``), or if two other
        edges would then join the same two vertices (reason: ``DuplicateEdge``). A pair also cannot be joined if both
        ends of another edge would become one vertex (reason: ``WrongPlace``), or if a face would contain a vertex twice
        (reason: ``RepeatedVertex``).

        Example: ``scene.stitch(distance=0)``, in a recipe ``Stitch(distance: 0)``

        :param distance: The largest distance between corresponding ends of two edges, in scene units. With 0, only ends
            at equal positions are joined.
        :param on_refusal: What to do when a pair of coinciding edges cannot be joined, or when an edge coincides with
            several edges. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The edges can form paths, loops and trees. A closed loop can separate a region of faces from the rest of the
        mesh. Each cut edge becomes two boundary edges, one for each side of the cut. Cuts can divide the faces around a
        vertex into several groups. The group that contains the face with the lowest id then keeps the old vertex, and
        each other group gets a copy of the vertex. The copies get the highest ids. Faces keep their ids, and no vertex
        moves. Copies of vertices and edges have the values of the originals. Corners keep their values. ``stitch()`` is
        the inverse operation: it joins the two sides of a cut.

        An edge on the boundary cannot be cut (reason: ``Boundary``). An edge also cannot be cut if it touches neither
        the boundary nor another edge to cut (reason: ``DuplicateEdge``). Both sides of the cut would still join the
        same two vertices, so the mesh would not open. However, a path of several edges inside the mesh can be cut,
        because all edges are cut at once.

        Example: ``scene.cut(edges="All")``, in a recipe ``Cut(edges: All)``

        :param edges: The edges to cut. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be cut. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Gives a tag (a named mark) to the selected vertices and removes this tag from all other vertices. For
        example, if the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged vertices in later
        operations.

        If a later operation copies a tagged vertex, as ``extrude_faces()`` does, the copy is also tagged. If a later
        operation adds a vertex on an edge, as ``split_edges()`` does, the new vertex is not tagged. An existing vertex
        tag of the same name is replaced. The operation fails if the mesh has a vertex attribute of this name that is
        not a tag. The geometry does not change. The report counts the vertices that gained or lost the tag.

        Example: ``scene.tag_vertices(name="some", vertices="Boundary")``, in a recipe ``TagVertices(name: "some",
        vertices: Boundary)``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param vertices: The vertices to tag. If the selection is empty, the tag exists but no vertex has it. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Gives a tag (a named mark) to the selected edges and removes this tag from all other edges. For example, if
        the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged edges in later operations.

        When a later operation splits or subdivides a tagged edge, the parts of this edge are also tagged. An existing
        edge tag of the same name is replaced. The operation fails if the mesh has an edge attribute of this name that
        is not a tag. The geometry does not change. The report counts the edges that gained or lost the tag.

        Example: ``scene.tag_edges(name="marked", edges=sel.EdgeLoop(sel.Longest(count=2)))``, in a recipe
        ``TagEdges(name: "marked", edges: EdgeLoop(Longest(count: 2)))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param edges: The edges to tag. If the selection is empty, the tag exists but no edge has it. ``"All"``,
            ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Gives a tag (a named mark) to the selected faces and removes this tag from all other faces. For example, if
        the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged faces in later operations.

        When a later operation splits or subdivides a tagged face, the parts of this face are also tagged. An existing
        face tag of the same name is replaced. The operation fails if the mesh has a face attribute of this name that is
        not a tag. The geometry does not change. The report counts the faces that gained or lost the tag.

        Example: ``scene.tag_faces(name="some", faces=sel.Facing(direction=(0, 0, 1), within=45))``, in a recipe
        ``TagFaces(name: "some", faces: Facing(direction: (0, 0, 1), within: 45))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param faces: The faces to tag. If the selection is empty, the tag exists but no face has it. ``"All"``,
            ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Splits every triangle into four and smooths the surface. The operation repeats this for every level.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The
        Euler characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has
        the id V + e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be
        triangles.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed as the parameter ``face_varying`` specifies, and seams are kept. When an edge or a triangle
        is split, its parts copy its attribute values, such as tags and materials. Normals are dropped, because they
        would be wrong. If an edge or a vertex has the sharpness s (see ``crease()``), it stays sharp for s levels.

        Example: ``scene.loop_subdivide(levels=2)``, in a recipe ``LoopSubdivide(levels: 2)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param weights: The weights that determine the new positions of old vertices. An old vertex moves to a weighted
            mean of its old position and its neighbors. Defaults to ``"Warren"``.
            ``"Warren"``: The weight u of a neighbor is 3/16 if the vertex has n = 3 neighbors, and otherwise 3/(8n).
            ``"Loop"``: If the vertex has n neighbors, the weight u of a neighbor is (5/8 - (3/8 + cos(2π/n)/4)²)/n, as
                in Loop's thesis, 1987.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and each new vertex on the boundary lies in the middle of an
                old boundary edge.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but a value at a vertex stays unchanged if only one face at this vertex
                has the value.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also stay unchanged at a vertex with three or more
                different values.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also stay unchanged at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Triangles next to the refined faces are cut in two or
            four. Without these cuts, new vertices would lie in the middle of edges of these triangles. The surface
            outside the refined faces does not move. The documentation of the Rust function
            ``subdivision::refine_faces`` describes the ids of new elements. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Splits every face into quads and smooths the surface. The operation repeats this for every level.

        Each level creates one quad at each corner of each old face. A level turns V vertices, E edges and F faces with
        C corners in total into V + E + F vertices, 2 E + C edges and C quads. The Euler characteristic V - E + F does
        not change. Old vertices keep their ids. The vertex on edge e has the id V + e, and the vertex at the center of
        face f has the id V + E + f. Edge e becomes edges 2e and 2e + 1. The quads are numbered face by face, in the
        order of the old faces. The quads of an old face are in the order of the corners of this face.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed as the parameter ``face_varying`` specifies, and seams are kept. When an edge or a face is
        split, its parts copy its attribute values, such as tags and materials. Normals are dropped, because they would
        be wrong. If an edge or a vertex has the sharpness s (see ``crease()``), it stays sharp for s levels.

        Example: ``scene.catmull_clark(levels=2)``, in a recipe ``CatmullClark(levels: 2)``

        :param levels: The number of levels. Each level replaces every corner of a face with a quad. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and each new vertex on the boundary lies in the middle of an
                old boundary edge.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but a value at a vertex stays unchanged if only one face at this vertex
                has the value.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also stay unchanged at a vertex with three or more
                different values.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also stay unchanged at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. A face beside a refined face gets additional corners
            at the new vertices on their common edge. The surface outside the refined faces does not move. The
            documentation of the Rust function ``subdivision::refine_faces`` describes the ids of new elements.
            ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Splits every face into smaller faces without moving vertices. The operation repeats this for every level.

        With ``into="Triangles"``, all faces must be triangles. A level then turns V vertices, E edges and F triangles
        into V + E vertices, 2 E + 3 F edges and 4 F triangles. Triangle f becomes faces 4f to 4f + 3. With
        ``into="Quads"``, faces can have any number of corners, and each corner becomes a quad. A level then turns V
        vertices, E edges and F faces with C corners in total into V + E + F vertices, 2 E + C edges and C quads. The
        quads are numbered in the order of the old faces. The new vertex at the center of face f has the id V + E + f.
        In both cases, old vertices keep their ids and positions, and the new vertex on edge e has the id V + e. Edge e
        becomes edges 2e and 2e + 1.

        Vertex attributes are interpolated. Corner values are interpolated within each old face separately. When an edge
        or a face is split, its parts copy its attribute values, including the sharpness of edges. Normals are dropped.

        Example: ``scene.midpoint(levels=2, into="Quads")``, in a recipe ``Midpoint(levels: 2, into: Quads)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param into: How faces are split. Defaults to ``"Triangles"``.
            ``"Triangles"``: Splits each triangle into four.
            ``"Quads"``: Splits each face with n corners into n quads around its center.
        :param faces: The faces to refine. If omitted, all faces. With ``into="Triangles"``, triangles next to the
            refined faces are cut in two or four. With ``into="Quads"``, a face beside a refined face gets additional
            corners at the new vertices on their common edge. The documentation of the Rust function
            ``subdivision::refine_faces`` describes the ids of new elements. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Splits every triangle into four and smooths the surface without moving the old vertices. The operation
        repeats this for every level.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The
        Euler characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has
        the id V + e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be
        triangles.

        Vertex attributes are interpolated with the same weights as the positions. Corner values are interpolated
        linearly, separately in each old triangle. When an edge or a triangle is split, its parts copy its attribute
        values, such as tags and materials. Normals are dropped, because they would be wrong. The sharpness that
        ``crease()`` sets has no effect and is copied unchanged.

        Example: ``scene.butterfly(levels=1)``, in a recipe ``Butterfly(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Splits every triangle into three, flips the old edges, and smooths the surface. The operation repeats this
        for every level.

        A level turns V vertices, E edges and F triangles into V + F vertices, E + 3 F edges and 3 F triangles. Every
        second level also cuts each boundary edge in three. Each boundary edge that is cut in three adds one vertex and
        one edge to these counts. The Euler characteristic V - E + F does not change. Old vertices keep their ids. The
        new vertex in face f has the id V + f, and face f becomes faces 3f to 3f + 2. All faces must be triangles. Each
        step counts its own levels from 1. One operation of two levels therefore cuts the boundary edges. Two steps of
        one level each leave the boundary edges uncut.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are interpolated linearly
        within each old triangle separately. A triangle next to a flipped edge covers parts of two old triangles. If the
        flipped edge was a seam, the triangle mixes texture coordinates of both sides of the seam, which distorts
        textures. Each new triangle copies the attribute values, such as tags and materials, of the old triangle that
        was split. Parts of a boundary edge copy the values of the boundary edge. All other edges have zero values (no
        crease, no tags). Normals are dropped, because they would be wrong.

        Example: ``scene.sqrt3(levels=1)``, in a recipe ``Sqrt3(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by three. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        """Replaces every edge and every vertex with a face and shrinks the old faces. The operation repeats this for
        every level.

        A level turns a closed mesh with V vertices, E edges and F faces into a mesh with 2 E vertices, 4 E edges and V
        + E + F faces. If the mesh has a boundary, a level creates additional elements along the boundary. The Euler
        characteristic V - E + F does not change. The shrunk face inside old face f has the id f, and the new face at
        old edge e has the id F + e. The new faces at old vertices have the highest ids. Isolated vertices are kept. The
        ids of isolated vertices follow the ids of all other vertices. Two kinds of vertices do not become faces:
        isolated vertices, and vertices inside the mesh that have only two edges.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are smoothed within each
        old face separately. The new faces at edges and vertices mix corner values of several old faces. At a seam, the
        mixed values distort textures. A face inside an old face copies the attribute values of the old face. The new
        face at an edge or a vertex copies the values of an adjacent face. The two new edges along an old edge copy the
        values of this edge. All other edges have zero values (no crease, no tags). Normals are dropped, because they
        would be wrong.

        Example: ``scene.doo_sabin(levels=1)``, in a recipe ``DooSabin(levels: 1)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Every edge that crosses the plane gets a new vertex at the crossing point. Every face that crosses the plane is
        cut along the plane. A concave face can be cut in several places. A vertex near the plane is treated as if it
        were on the plane, and is not moved. A vertex is near the plane if its distance from the plane is at most 1e-9
        times the longest side of the bounding box. A vertex is also near if this distance is at most 1e-14 times the
        largest absolute coordinate. Every edge has two half-edges. When an edge is cut, one part keeps the id of the
        edge: the part that contains the start of the half-edge with the lower id. When a face is cut, the part that
        contains the first corner keeps the id of the face. New elements get the highest ids. Where an edge crosses the
        plane, attributes are interpolated. At a seam (an edge whose corner values, such as UVs, differ between its two
        sides), the corner values of each side are interpolated separately.

        With ``keep="Front"``, the part of the mesh behind the plane is removed. With ``keep="Back"``, the part in front
        of the plane is removed. A face in the plane whose normal points to the front belongs to the back, because the
        face closes the solid behind the plane. Vertices that are left without a face are removed. If the remaining
        faces around a vertex form several fans (groups of faces connected across edges), each fan gets a separate copy
        of the vertex. No faces are added to close the cut. To close the cut, use ``fill_holes()`` in a later operation.

        Example: ``scene.bisect(normal=(0, 0, 1))``, in a recipe ``Bisect(normal: (0, 0, 1))``

        :param normal: The normal of the plane. The normal points to the front side. The length of the normal does not
            matter but must not be 0.
        :param point: A point on the plane.
        :param keep: The part of the mesh to keep: one side of the plane, or both sides. Defaults to ``"Both"``.
            ``"Both"``: Both sides.
            ``"Front"``: The side in front of the plane: the normal of the plane points to this side.
            ``"Back"``: The side behind the plane: the normal of the plane points away from this side.
        :param tag: The name of a tag for the edges on the plane. Edges that already have the tag keep it. If omitted,
            no edges are tagged.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        the halves are joined at the plane. Vertices near the plane (see ``bisect()``) are moved exactly onto the plane,
        so that the result is symmetric. Faces that lie in the plane are removed, because they would become walls inside
        the result. A vertex on the plane joins the halves if it is on the boundary of the kept half. Where the surface
        only touches the plane, without a boundary there, the halves are not joined. The report counts the faces that
        are removed completely, but not the faces that the plane cuts.

        The elements of the kept half come first, in their old order. The elements of the mirror image follow.
        Attributes are copied, so both halves have the same texture coordinates, tags and joint weights. Normals and
        tangents are dropped.

        Example: ``scene.symmetrize(normal=(1, 0, 0))``, in a recipe ``Symmetrize(normal: (1, 0, 0))``

        :param normal: The normal of the plane. It points to the front side. The length of the normal does not matter
            but must not be 0.
        :param point: A point on the plane.
        :param from_: The half that is kept and mirrored. Defaults to ``"Front"``.
            ``"Front"``: The side in front of the plane: the normal of the plane points to this side.
            ``"Back"``: The side behind the plane: the normal of the plane points away from this side.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Edges are collapsed, starting with the edges whose collapse changes the surface least. A collapse merges the two
        ends of an edge into one vertex. The change is measured by the squared distance of this vertex to the planes of
        the original triangles around the merged vertices (Garland, Heckbert, 1997). The operation ends when the number
        of faces given by ``faces`` or ``ratio`` is reached. It also ends when every remaining collapse would change a
        property that must be kept (see the list below) or could exceed ``error``. At least one of ``faces``, ``ratio``
        and ``error`` must be given, but not both ``faces`` and ``ratio``. All faces must be triangles.

        The following properties are kept:

        - Topology: the numbers of holes, handles and separate parts do not change.
        - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
          different tags or materials, tagged edges, creases, and the edges that ``features`` selects. A line can lose
          vertices, but its ends, and the vertices where lines meet, keep their exact positions.
        - Attributes: changes of texture coordinates, normals, colors and other numbers count as changes of the surface
          (Hoppe, 1999). New vertices get the values that fit best. Values are never mixed across a line, and no
          triangle is turned over in the texture. Stored normals are kept, so that a simplified mesh is shaded like the
          original. The vertex attributes that ``measure()`` stores also influence the result, and the report lists
          their names. To avoid this influence, use ``measure()`` after this operation.
        - Vertex tags: vertices with different tags, different sharpness, or different values of a whole-number
          attribute are not merged.

        Seams divide a texture into charts. The borders of charts are also simplified, and a simplified border can cross
        a neighboring chart in the texture. The report counts the faces that overlap in the texture. To leave more space
        between charts, use ``pack_uvs()`` with a larger ``padding`` before this operation.

        No collapse turns a triangle over. Remaining elements get new ids, in the order of their old ids. If ``error``
        is not given and the number of faces cannot be reached, the operation is refused (reason: ``Unreached``), and
        the message states why. With ``on_refusal="Skip"``, the operation instead simplifies the mesh as far as it can.

        Example: ``scene.simplify(ratio=0.5)``, in a recipe ``Simplify(ratio: 0.5)``

        :param faces: The number of faces to reach, for each mesh. The result can have one face fewer, because a
            collapse inside the mesh removes two faces. A mesh that already has at most this number of faces does not
            change.
        :param ratio: The number of faces to reach, as a fraction of the number of faces of each mesh.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. The
            limit is guaranteed: for each collapse, the operation computes an upper bound of how far the surface moves,
            and adds up these bounds. The sum overestimates the true distance. If the operation ends because of this
            limit, the true distance is usually at least a third of the limit. If omitted, there is no limit.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param pin: Vertices that are never removed and keep their exact positions, for example ``Boundary``. If
            omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param intersections: Whether the operation is allowed to make faces intersect each other. Intersections can
            occur where parts of the surface are close together. Defaults to ``"Allow"``.
            ``"Allow"``: New intersections are allowed.
            ``"Refuse"``: The operation refuses every change that would make a changed face intersect another face.
        :param on_refusal: What to do if the mesh cannot be reduced to the requested number of faces. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The copies are named after the object, for example ``rock_lod1``, ``rock_lod2`` and so on. Each copy is made as
        with ``simplify()``, which keeps attributes, materials and lines such as boundaries, seams and creases. The
        first copy is made from the object, and each further copy from the previous copy. If the scene has nodes that
        reference the object, each of these nodes gets one sibling node for each copy. The sibling node references the
        copy and has the same transform.

        Example: ``scene.lods(from_="mesh", ratios=[0.5, 0.25])``, in a recipe ``Lods(from: "mesh", ratios: [0.5,
        0.25])``

        :param from_: The name of the object.
        :param ratios: For each copy, the number of its faces divided by the number of faces of the original object.
            Each fraction must be smaller than the previous fraction in the list.
        :param to: The text before the number in the names of the copies. If omitted, the name of the object followed by
            ``_lod``.
        :param features: Edges to keep as lines, in addition to the lines that ``simplify()`` always keeps. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do if a copy cannot be reduced to the requested number of faces. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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
        length. Almost all other edges are shorter. Nearly all vertices of the result lie on the original surface. The
        only exceptions are new vertices that cannot move onto the surface without turning a triangle too far or moving
        the surface too far. The parameter ``length`` gives the same target length to all edges. With the parameter
        ``curvature``, edges are short where the surface is curved, and long where it is flat (Dunyach and others,
        2013). Exactly one of ``length`` and ``curvature`` must be given. All faces must be triangles.

        The following properties are kept:

        - Topology: the numbers of holes, handles and separate parts do not change.
        - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
          different tags or materials, tagged edges, creases, and the edges that ``features`` selects. Vertices on a
          line can only slide along this line. The ends of lines, the vertices where lines meet, and corners where a
          line turns by more than 40 degrees keep their exact positions. Sharp edges that are not on a line are rounded.
          To keep sharp edges, select them with ``features``.
        - Attributes: each vertex and corner gets the values of the original surface at its position. Values are never
          interpolated across a line.
        - Vertex tags: a new vertex gets a tag if all old vertices around its position have the tag. Usually, these old
          vertices are the three corners of the old triangle at this position. A tagged vertex can move only in two
          cases: all corners of one of its triangles have the tag, or both of its neighbors on a line have the tag. All
          other tagged vertices keep their exact positions. Vertices with a sharpness (see ``crease()``) also keep their
          exact positions.

        The number of faces depends on the area of the mesh, which is not known before the run. Therefore the command
        ``check``, which examines a recipe but does not run it, shows the largest number of faces that fits the memory
        budget. When the operation starts, it estimates the number of faces from the area. The operation fails if a mesh
        with this number of faces would exceed the memory budget.

        The passes leave out every split, collapse, flip or move that would turn a triangle by more than 60 degrees. All
        elements get new ids. If the operation cannot prove that the distance between the result and the original is at
        most ``error``, the operation is refused (reason: ``Unreached``). With ``on_refusal="Skip"``, a refused
        operation leaves the mesh unchanged, and the run continues.

        Example: ``scene.remesh(length=0.5)``, in a recipe ``Remesh(length: 0.5)``

        :param length: The target length of edges, in scene units.
        :param curvature: Target lengths that depend on the curvature of the surface, instead of one target length for
            all edges.
            ``"error"``: The intended largest distance between the original surface and the new triangles, in scene
                units. This distance is not guaranteed. To guarantee a distance, use the other parameter ``error``,
                which belongs to the operation itself: ``remesh(error=..)``.
            ``"min"``: The smallest target length of edges, in scene units.
            ``"max"``: The largest target length of edges, in scene units.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. To
            stay below this limit, the operation can make some edges shorter than the target length. The distance is
            measured at the end of the operation, in both directions and for all points of both surfaces. If omitted,
            there is no limit.
        :param pin: Vertices that keep their exact positions, for example ``Boundary``. If omitted, no vertices.
            ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param passes: The largest number of passes, from 1 to 1000. The operation ends earlier if a pass changes almost
            nothing. Defaults to 10.
        :param on_refusal: What to do if the distance between the result and the original could exceed ``error``.
            Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        If ``boundary`` is ``Fixed``, vertices on the boundary do not move, so that objects that touch along their
        boundaries still fit together.

        Example: ``scene.smooth(by=choice.Taubin())``, in a recipe ``Smooth(by: Taubin())``

        :param by: The method.
            ``choice.Laplacian(..)``: Moves each vertex towards the mean of its neighbors.
            ``choice.Taubin(..)``: Moves each vertex towards the mean of its neighbors, and then away from this mean
                with a slightly larger factor.
            ``choice.Implicit(..)``: Moves the surface by mean curvature flow.
            ``choice.Denoise(..)``: Filters the normals of the faces, so that similar normals of nearby faces become
                nearly equal.
        :param passes: The number of passes. At most 10000. If omitted, 1 for ``choice.Implicit`` and 10 for the other
            methods. With ``choice.Denoise``, ``passes`` counts only the passes that filter the normals, not the passes
            that then move the vertices.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param boundary: How vertices on the boundary move. Defaults to ``"Fixed"``.
            ``"Fixed"``: The vertices do not move.
            ``"Free"``: The boundary is smoothed as a set of curves: the movement of a vertex on the boundary depends
                only on its neighbors along the boundary.
        :param keep_volume: Whether to restore the original volume of the mesh after smoothing. To restore the volume,
            all vertices that are allowed to move are shifted by the same distance along their normals. The mesh must be
            closed. Defaults to ``False``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        in the changed mesh. For each element, the operation finds the nearest point on the surface of ``from_``, and
        the face that contains this point. The values of vertex and corner attributes at this point are interpolated
        between corners of this face. Attributes that are never interpolated, such as whole numbers and tags, are copied
        from the corner of this face that is nearest to the point. Values of face attributes are copied from this face.
        If the changed mesh already has the attribute with the same type of values, the attribute is overwritten. If the
        changed mesh has the attribute with another type of values, the operation fails. Without ``on``, a method of a
        scene changes all meshes except the object ``from_``.

        Seams divide the source object into charts. All corners of a face of the changed mesh take their values from the
        same chart. If a seam lies inside this chart, they take their values from the same side of the seam. This
        prevents triangles from stretching across a seam of the texture. Usually the chart that is nearest to the center
        of the face is used. Where parts of the source object intersect, the chart that is nearest to the center can be
        far from the corners of the face. If another chart is nearest to a corner, and is much nearer to the face as a
        whole, this other chart is used.

        Elements that are farther from the source object than ``within`` keep their values, or get zeros if the
        attribute is new. Either all corners of a face take values, or none of them. If one of the corners or the center
        of the face is too far away, all corners of the face keep their values or get zeros. The report counts the
        elements that take no values from the source object.

        Example: ``scene.transfer(from_="scan", attributes=["uv", "color"], within=0.01)``, in a recipe ``Transfer(from:
        "scan", attributes: ["uv", "color"], within: 0.01)``

        :param from_: The name of the object with the attributes.
        :param attributes: The names of the attributes, for example ``["uv", "color"]``.
        :param within: The largest distance from the object ``from_`` at which an element takes values, in scene units.
            If omitted, there is no limit.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        With ``falloff="r"``, vertices that are nearer than r to a selected vertex also move, but less far. At the
        distance d from the nearest selected vertex, the movement is multiplied by the weight (1 - (d/r)²)². The weight
        is 1 at selected vertices and falls smoothly to 0 at the distance r. Distances are measured along straight
        lines, not along the surface.

        With ``by=choice.Distance(..)``, each vertex moves along its own normal: the area-weighted mean of its face
        normals. Vertices without a normal, such as isolated vertices, do not move. The report counts these vertices.

        Example: ``scene.move_vertices(vertices=sel.Vertices([0]), by=choice.Offset((0, 0, 0.5)))``, in a recipe
        ``MoveVertices(vertices: Vertices([0]), by: Offset((0, 0, 0.5)))``

        :param vertices: The vertices to move. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param by: How the vertices move.
            ``choice.Offset(..)``: Moves by this offset along x, y and z, in scene units.
            ``choice.Distance(..)``: Moves each vertex by this distance along its normal, in scene units.
            ``choice.To(..)``: Moves all selected vertices by the same offset, so that the mean of their positions
                becomes this point.
            ``choice.Rotate(..)``: Rotates around an axis through the mean of the positions of the selected vertices.
            ``choice.Scale(..)``: Scales along x, y and z about the mean of the positions of the selected vertices.
        :param falloff: The distance from the selected vertices at which the movement becomes 0, in scene units. If
            omitted, only the selected vertices move.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Each vertex moves along its normal by ``distance`` times the value that ``by`` gives for this vertex. The normal
        of a vertex is the area-weighted mean of its face normals. Vertices without a normal, such as isolated vertices,
        do not move. The report counts these vertices. Normals and tangents are dropped. Faces, element ids and other
        attributes do not change.

        The displaced mesh is identical on all machines, because the computation uses only functions that do not depend
        on the machine.

        Example: ``scene.displace(by=choice.Noise(scale=0.5, seed=7), distance=0.1)``, in a recipe ``Displace(by:
        Noise(scale: 0.5, seed: 7), distance: 0.1)``

        :param by: The source of the values by which ``distance`` is multiplied, for example noise or an image.
            ``choice.Noise(..)``: Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002).
            ``choice.Random(..)``: A random number from -1 to 1 for each vertex.
            ``choice.Attribute(..)``: A vertex attribute that holds one number for each vertex.
            ``choice.Image(..)``: The brightness of an image (a height map), from 0 (black) to 1 (white), at the texture
                coordinates of the vertex.
        :param distance: The distance that a vertex with the value 1 moves, in scene units. A negative distance moves
            the vertex inwards.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The parameters ``from_`` and ``to`` are coordinates along the axis. Vertices at or below ``from_`` do not move.
        Between ``from_`` and ``to``, the axis becomes an arc of the same length. The direction of the arc turns by
        ``angle`` from one end to the other. The part above ``to`` moves rigidly with the end of the arc. On the side of
        the axis towards the center of the circle, vertices move closer together. On the other side, vertices move
        apart. The distance between the center of the circle and the axis is (to - from) / angle, with the angle in
        radians. Parts of the mesh that lie beyond the center of the circle, as seen from the axis, turn inside out.
        Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.bend(axis="Z", angle=90)``, in a recipe ``Bend(axis: Z, angle: 90)``

        :param axis: The direction of the axis that becomes an arc. The axis goes through the point ``about``.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle by which the axis turns between ``from_`` and ``to``, in degrees. A negative angle bends
            to the other side.
        :param towards: The upper end bends in the positive direction of this coordinate axis. If omitted, this is the
            axis after ``axis`` in the order x, y, z, x.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Along the axis, the angle grows linearly from 0 at the coordinate ``from_`` to ``angle`` at the coordinate
        ``to``. Vertices below ``from_`` do not move, and vertices above ``to`` rotate by ``angle``. An exact twist
        keeps the volume. The edges of a mesh stay straight, so the volume of the mesh changes slightly. The change is
        small if the mesh is fine. A second twist with the opposite angle and the same other parameters undoes the first
        twist. Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.twist(axis="Z", angle=90)``, in a recipe ``Twist(axis: Z, angle: 90)``

        :param axis: The direction of the axis of the rotation. The axis goes through the point ``about``.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle at ``to``, in degrees, counter-clockwise if the axis points to the viewer.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Along the axis, the factor changes linearly from 1 at the coordinate ``from_`` to ``factor`` at the coordinate
        ``to``. Vertices below ``from_`` do not move, and vertices above ``to`` are scaled by ``factor``. Coordinates
        along the axis do not change. Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``scene.taper(axis="Z", factor=0.5)``, in a recipe ``Taper(axis: Z, factor: 0.5)``

        :param axis: The direction of the axis. The axis goes through the point ``about``, and points on the axis do not
            move.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param factor: The scale factor at the coordinate ``to``. More than 0. A factor below 1 makes the upper end
            narrower.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The box contains a regular grid of control points. ``size`` gives the number of control points along x, y and z.
        ``moves`` gives offsets for some of the control points. The space in the box follows the moved points smoothly.
        The new position of a point in the box is a weighted sum of the new positions of all control points. The weights
        are Bernstein polynomials (Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models", 1986). If all
        control points move by the same offset, the whole box moves by this offset. If only one control point moves, the
        points in the box move in the same direction, but less far. However, if the control point is at a corner of the
        box, this corner moves exactly as far as the control point.

        Vertices outside the box do not move. Normals and tangents are dropped. Faces, element ids and other attributes
        do not change, so textures stretch with the surface. Only vertices move, so refine the mesh first if its faces
        are large.

        Example: ``scene.lattice(size=(3, 3, 3), moves=[((2, 2, 2), (0.5, 0.5, 0.5))])``, in a recipe ``Lattice(size:
        (3, 3, 3), moves: [((2, 2, 2), (0.5, 0.5, 0.5))])``

        :param size: The numbers of control points along x, y and z. Each number is from 2 to 16.
        :param moves: The control points that move. Each entry consists of the three indices of a control point (along
            x, y and z, counted from 0) and the offset of this point in scene units. A control point that is listed
            several times moves by the sum of its offsets.
        :param min: The corner of the box with the lowest coordinates. If omitted, the same corner of the bounding box
            of the mesh is used.
        :param max: The corner of the box with the highest coordinates. If omitted, the same corner of the bounding box
            of the mesh is used.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A vertex moves only if it is in ``vertices`` and not in ``pin``. All other vertices keep their exact positions.
        If the operation does not name objects with ``on``, it acts on all meshes except the object that ``onto`` names.
        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        Vertices that would move farther than ``distance`` do not move. With ``along="Normal"``, a vertex moves along
        the line of its normal. With ``along=choice.Direction(..)``, a vertex moves along a ray in this direction. If
        the line or ray of a vertex misses the surface, the vertex does not move. The report counts the vertices that
        would move too far, and the vertices whose line or ray misses the surface.

        Example: ``scene.project(onto="scan", distance=0.1)``, in a recipe ``Project(onto: "scan", distance: 0.1)``

        :param onto: The name of the object onto whose surface the vertices move.
        :param along: How the operation finds the point of the surface to which a vertex moves. Defaults to
            ``"Nearest"``.
            ``"Nearest"``: Moves to the nearest point of the surface.
            ``"Normal"``: Moves to the nearest point at which the surface meets the line through the vertex along its
                normal.
            ``choice.Direction(..)``: Moves to the first point of the surface in this direction.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param distance: The largest distance that a vertex is allowed to move, in scene units. If omitted, there is no
            limit.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        Later operations can use the attribute to select elements (``sel.Where``) or to move vertices (``displace()``).
        They can also show it in a picture (``picture()``) or save it to a file (``save()``). If a later operation
        changes the mesh, the quantity is not computed again. Positions and other attributes do not change. Quantities
        are computed from the coordinates that the mesh stores. The transforms of the nodes that place the mesh in the
        scene are not applied. For each object, the report states the lowest, the mean and the highest value.

        If the mesh already has an attribute of this name, the attribute is replaced. The operation fails if the
        existing attribute belongs to a different kind of element, or does not have one floating-point number per
        element.

        Example: ``scene.measure(of="MeanCurvature")``, in a recipe ``Measure(of: MeanCurvature)``

        :param of: The quantity.
            ``"MeanCurvature"``: The mean curvature at each vertex, in 1 / scene unit (Cohen-Steiner, Morvan, 2003).
            ``"GaussianCurvature"``: The Gaussian curvature at each vertex, in 1 / scene unit² (Meyer, Desbrun,
                Schröder, Barr, 2003).
            ``choice.PrincipalCurvature(..)``: A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of
                the curvature tensor of Cohen-Steiner and Morvan, 2003.
            ``"Area"``: The area of each face, in scene units².
            ``"VertexArea"``: The area of the surface that belongs to each vertex, in scene units².
            ``"MinAngle"``: The smallest angle of each face, in degrees.
            ``"AspectRatio"``: The aspect ratio of each face (Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict
                Geometric Quality Library", 2007).
            ``choice.Distance(..)``: The distance from each vertex to the nearest point of another mesh of the scene, in
                scene units.
            ``choice.Geodesic(..)``: The distance along the surface from each vertex to the nearest selected vertex, in
                scene units.
            ``"Thickness"``: The thickness of the solid at each vertex, in scene units.
            ``choice.Occlusion(..)``: The ambient occlusion of each vertex.
            ``choice.Winding(..)``: The winding number of another mesh of the scene around each vertex (Jacobson, Kavan,
                Sorkine-Hornung, 2013; Barill, Dickson, Schmidt, Levin, Jacobson, 2018).
        :param name: The name of the attribute. If omitted, the attribute gets the name of the quantity in lower case,
            for example ``mean_curvature`` for ``MeanCurvature``. For principal curvatures, the default names are
            ``largest_curvature`` and ``smallest_curvature``.
        :param missing: The value for elements at which the quantity is not defined. For example, a vertex without faces
            has no curvature. The report counts these elements. If omitted, the value is 0 for quantities that can be
            negative, and -1 for all other quantities.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The surface is cut into charts, which are connected parts of the surface. The charts are flattened and packed
        into the page, the square of the texture with u and v from 0 to 1. Each chart grows from a flat region, as long
        as the normals of its faces differ from their mean by at most ``max_angle``. Each chart is flattened by a least
        squares conformal map (Levy and others, 2002), which the hybrid method of Liu and others (2008) then improves. A
        chart is cut again if its flattened shape overlaps itself or exceeds ``max_stretch``. A chart is also cut again
        if its angles are distorted too much. This distortion turns a small circle on the surface into an ellipse in the
        texture. On at least 95 % of the area of a chart, the longer axis of this ellipse is at most 1.15 times the
        shorter axis. All charts of a mesh have the same scale, and no chart is mirrored. No polygon is divided between
        charts. Each mesh gets its own page. The charts are arranged on the page in the same way as by ``pack_uvs()``.

        The coordinates are written to the corner attribute that the parameter ``uv`` names. If this attribute already
        exists, it is replaced. Edges at which charts meet become seams of the texture coordinates. Positions, faces and
        other attributes do not change, but tangents are removed because they depend on the texture coordinates.
        Zero-area faces also have zero area in the texture. The report counts the faces with zero area in the texture.
        If a polygon is bent so far that it overlaps itself in the texture, the operation fails and gives the reason
        ``WrongPlace``. To avoid this failure, triangulate the bent polygons before this operation. With
        ``on_refusal="Skip"``, the operation does not fail, and the triangles of the bent polygons overlap in the
        texture.

        Example: ``scene.unwrap(max_angle=60)``, in a recipe ``Unwrap(max_angle: 60)``

        :param seams: Edges that become borders of charts, for example ``sel.Tagged("seam")`` or
            ``sel.Sharp(above=60)``. The algorithm adds more borders where charts need them. If omitted, the algorithm
            chooses all borders. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param max_angle: The largest angle between the normal of a face and the mean normal of its chart, in degrees.
            Smaller angles give more charts with less stretch. Defaults to ``70.0``.
        :param max_stretch: The area scale of a triangle is allowed to differ from the area scale of its whole chart by
            at most this factor. The area scale is the area in the texture divided by the area on the surface. Defaults
            to ``4.0``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size.
            The size matters only for ``padding``, which is a number of texels. Defaults to ``1024``.
        :param padding: The width of the empty border around each chart, in texels. The distance between two charts is
            at least twice this width. Defaults to 2.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param on_refusal: What to do if a polygon overlaps itself in the texture. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        A chart is a set of faces that are connected across edges at which the texture coordinates have no seam. After
        the operation, the area of each chart in the texture is proportional to its area on the surface. The shape of
        each chart in the texture does not change. The operation does not repair charts that are stretched or mirrored,
        or that overlap themselves. A chart with zero area on the surface or in the texture becomes a point. The report
        counts these zero-area charts, and the charts that overlap themselves. Each mesh gets its own page, that is, the
        whole square of a texture. Tangents are removed, because charts are rotated.

        If a mesh has at most 256 charts, charts can be placed in the hollows and holes of other charts. If a mesh has
        more charts, all charts are packed in rows. Rows are computed much faster, but leave more of the page empty.

        Example: ``scene.pack_uvs(page=2048, padding=4)``, in a recipe ``PackUvs(page: 2048, padding: 4)``

        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size.
            The size matters only for ``padding``, which is a number of texels. Defaults to ``1024``.
        :param padding: The width of the empty border around each chart, in texels. The distance between two charts is
            at least twice this width. Defaults to 2.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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

        The extension of the file determines the format. Without ``turntable``, the picture is a single image, and the
        extension must be ``.png``. With ``turntable``, the extension ``.gif`` gives an animated GIF, and ``.apng`` or
        ``.png`` gives an animated PNG. The file is written only if the whole recipe succeeds. The scene does not
        change. Drawing needs no GPU and gives the same bytes on every machine.

        Example: ``scene.picture(path="a.png", size=(64, 48), highlight=sel.Edges(sel.Sharp(above=30)), color_by={"of":
        "Valence"}, style={"wireframe": {}})``, in a recipe ``Picture(path: "a.png", size: (64, 48), highlight:
        Edges(Sharp(above: 30)), color_by: (of: Valence), style: (wireframe: ()))``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param size: The width and the height of each view in pixels.
        :param camera: The camera.
            ``choice.Fit(..)``: Looks at the scene from a given side.
            ``choice.LookAt(..)``: Looks from one point to another point.
        :param views: Several cameras, which replace ``camera``. The picture shows the views of all these cameras, side
            by side.
        :param columns: The number of views in each row of the picture. If omitted, up to 4 views share one row, and
            more views are placed in rows of 4.
        :param style: The style: shading, lines, background.
            ``"shading"``: The lighting of surfaces.
            ``"sharp"``: An edge is shaded as sharp if the normals of its two faces differ by at least this angle, in
                degrees. This angle has no effect if the mesh stores normals or smoothing groups.
            ``"occlusion"``: The strength of ambient occlusion, which darkens hollows, from 0 (none) to 1.
            ``"background"``: The background.
            ``"color"``: The color of all surfaces. If omitted, surfaces have the colors of the scene.
            ``"back"``: The color of the back of faces. The back is visible where a mesh is open or inside out.
            ``"wireframe"``: Draws the edges of meshes, and grid lines on Bezier patches. Lines that are only a few
                pixels apart are drawn thinner, so that they do not cover the surface.
            ``"boundary"``: Draws the boundary edges of meshes.
            ``"creases"``: Draws crease edges. The width of a crease grows with its sharpness, up to twice ``width``.
            ``"normals"``: Draws vertex normals as short lines. The value is the length of the lines, as a fraction of
                the radius of the bounding sphere of the scene.
            ``"points"``: Draws dots at all vertices of meshes and all points of polylines. The value is the diameter of
                the dots in pixels.
            ``"control_nets"``: Draws the control nets of Bezier patches and the control polygons of curves.
            ``"ids"``: Labels vertices or faces with their ids. Fails if a mesh has more than 2000 of these elements.
            ``"curve_width"``: The width of curves and polylines in pixels.
        :param highlight: Elements to highlight in orange, as in ``sel.Edges(sel.Sharp(above=30))`` or
            ``sel.Faces(sel.Tagged("top"))``. ``"All"``, ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param highlight_width: The width of highlighted edges and the diameter of highlighted vertices, in pixels. The
            defaults grow with the shorter side of a view. For a side of 240 pixels, the width is 2.8 and the diameter
            is 7.5. The width and the diameter are 3.4 and 10 for 480 pixels, 4 and 13 for 960 pixels, and 8 and 26 for
            1920 pixels. If there are many highlighted vertices, their default diameter is smaller. Edges behind a
            surface are drawn faintly, and vertices behind a surface are drawn as rings.
        :param marks: More selections of elements to highlight, each with its own color.
            ``"of"``: The elements.
            ``"color"``: The color.
            ``"width"``: The width of edges and the diameter of vertices, in pixels. The defaults are the same as for
                ``highlight_width``.
        :param color_by: What the colors of the surface show: a quantity (``"Valence"``, ``"MinAngle"``, ``"Area"``,
            ``"DihedralAngle"``, ``"MeanCurvature"``, ``"GaussianCurvature"``, or a value of ``meshwright.choice``), the
            name of an attribute, or a mapping with more details.
            ``"of"``: The quantity that the colors show.
            ``"map"``: The color map. The default is ``Classes`` for valences, ``Diverging`` for curvatures, and
                ``Viridis`` for all other quantities.
            ``"range"``: The values that the first and the last color represent, as in ``(0, 60)``. If omitted, the
                range is computed from the values of the quantity. For curvatures, the range is symmetric about 0, and
                the lowest and the highest eighth of the values are ignored. If all remaining values are 0, only the
                lowest and the highest 2 % of the values are ignored, or no values.
            ``"legend"``: Whether a legend in a corner of the picture explains the colors.
        :param turntable: If given, the picture is an animation in which the camera moves once around the scene.
            ``"frames"``: The number of images.
            ``"seconds"``: The duration of the turn, in seconds.
        :param images: The folder of texture images that are not stored next to their model. The path is relative to the
            folder of the recipe. If omitted, the folder of the recipe. Missing images are not drawn, and the report
            lists them.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        one panel for each combination of a curve, a value of ``t`` and a level of de Casteljau's algorithm. A panel
        shows the curve, its control polygon, every level of the algorithm in a different color, and the constructed
        point. Both axes have the same scale. With ``by_level``, the panels for a curve and a value of ``t`` form a
        sequence. The first panel shows only the first level of the algorithm, and each further panel shows one level
        more. Only the last of these panels shows the constructed point. The extension of the file determines the
        format: ``.svg`` or ``.png``. The file is written only if the whole recipe succeeds. The scene does not change.

        Example: ``scene.curve_figure(path="figure.svg", t=[0.25, 0.5])``, in a recipe ``CurveFigure(path: "figure.svg",
        t: [0.25, 0.5])``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param t: The curve parameters at which points are constructed, from 0 (start of the curve) to 1 (end). If
            empty, only the curves and their control polygons are drawn.
        :param by_level: Whether each level of the algorithm has its own panel. If false, one panel shows all levels.
            Defaults to ``False``.
        :param before: The name of another curve, such as an older version of the drawn curve. This other curve is drawn
            faintly behind each drawn curve. If both curves have the same degree, an arrow leads from each control point
            of the other curve to the same control point of the drawn curve. Control points that have moved by at most
            28 SVG pixels have no arrow.
        :param width: The width of the figure in SVG pixels. The font size is 12 pixels in narrow panels and up to 19
            pixels in wide panels. Defaults to ``640``.
        :param columns: The number of panels in each row. If omitted, each row has one panel for each value of ``t``,
            but at most 4 panels. With ``by_level``, each row then has one panel for each level of the curve, but at
            most 4 panels.
        :param scale: In a ``.png`` file, each SVG pixel becomes a square of ``scale`` by ``scale`` pixels. Has no
            effect on ``.svg`` files. Defaults to ``2``.
        :param labels: Whether points are labeled with their names. Defaults to ``True``.
        :param legend: Whether there is a legend below the panels. Defaults to ``True``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        other side of the edge. At a boundary edge, the half-edge without a face is also drawn, in gray. The viewer
        looks at the faces from the direction of their mean normal. A face is left out if its normal points away from
        the viewer, or if it is seen nearly edge-on. The report counts these faces. The extension of the file determines
        the format: ``.svg`` or ``.png``. The file is written only if the whole recipe succeeds. The scene does not
        change.

        The name of an element is a letter followed by the id of the element: ``v`` for vertices, ``h`` for half-edges,
        ``f`` for faces. The half-edges with the ids ``2e`` and ``2e + 1`` belong to the edge with the id ``e``.

        Example: ``scene.half_edge_figure(path="figure.svg")``, in a recipe ``HalfEdgeFigure(path: "figure.svg")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param faces: The faces to draw, at most 200. Defaults to ``"All"``. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The width and height of one SVG pixel, in pixels of a ``.png`` file. Has no effect on ``.svg``
            files. Defaults to ``2``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        borders of charts, and thin lines are the other edges. Charts outside the page are also drawn. To make room for
        these charts, the figure is made higher, or everything in it is drawn smaller. The extension of the file
        determines the format: ``.svg`` or ``.png``. The file is written only if the whole recipe succeeds. The scene
        does not change.

        Example: ``scene.uv_picture(path="uv.svg")``, in a recipe ``UvPicture(path: "uv.svg")``

        :param path: The file. For a scene, a relative path is relative to the working directory; in a recipe, to the
            output folder. If ``name`` is a recipe parameter whose value is a file, ``{name.stem}`` is replaced by the
            name of this file without its extension.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param fill: What the colors inside charts show. Defaults to ``"Charts"``.
            ``"None"``: No colors.
            ``"Charts"``: The charts: each chart has one of eight colors.
            ``"Stretch"``: The distortion of angles.
        :param edges: Whether edges inside charts are drawn. Defaults to ``True``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The width and height of one SVG pixel, in pixels of a ``.png`` file. Has no effect on ``.svg``
            files. Defaults to ``2``.
        :param on: The names of the objects on which the operation acts. If omitted, the operation acts on all objects
            that it supports.
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
        ``.bez`` for Bezier patches, ``.bzc`` for a curve, and ``.mws`` for a complete scene without any loss. A
        ``.csv`` file is a table of the positions and attributes of vertices, faces or corners. An ``.npz`` file stores
        the arrays of a mesh for the Python library ``NumPy``. ``load()`` cannot read ``.csv`` and ``.npz`` files. If
        ``path`` ends with ``.gz``, as in ``a.obj.gz``, the file is compressed with gzip. Files in the formats ``.glb``,
        ``.mws`` and ``.npz`` cannot be compressed with gzip. If the format cannot store some of the content of the
        objects, the report lists this content.

        Example: ``mesh.save(path="a.obj")``

        :param path: The file. A relative path is relative to the working directory.
        :param images: What to do with the images of materials. If omitted, images are embedded in ``.glb`` files. For
            ``.gltf`` and ``.obj``, the image files of the loaded model are copied to the folder of the output file. If
            images are embedded in the loaded model, a ``.gltf`` file also embeds them. For ``.obj``, embedded images
            are written to separate files, because OBJ cannot embed images.
            ``"Embed"``: Store the images in the file or, for ``.gltf``, in its ``.bin`` file.
            ``"Copy"``: Write the images to files in the folder of the written file.
            ``"Keep"``: Write only the paths of the images, as in the original model.
        :param compress: How to compress the geometry of ``.glb`` and ``.gltf`` files without loss. If omitted, the
            geometry is not compressed.
            ``"Meshopt"``: The extension ``EXT_meshopt_compression``.
        :param quantize: The number of bits for each attribute of the geometry in ``.glb`` and ``.gltf`` files. If
            omitted, numbers are stored as 32-bit floats. ``quantize={}`` uses the default number of bits for each
            attribute. The report states the largest rounding errors of this operation: in positions, in normals and
            tangents, and in texture coordinates.
            ``"position"``: The number of bits of each coordinate of a position. Positions are rounded to the points of
                a grid. The grid covers the bounding box of the object and has the same spacing along all axes. Along
                the longest side of the box, the grid has 2^bits - 1 steps. Positions of objects with joints or morph
                targets are not quantized. Defaults to 16.
            ``"normal"``: The number of bits of each of the two numbers that represent a normal or a tangent. The two
                numbers locate a point on an octahedron. Defaults to 8.
            ``"uv"``: The number of bits of each texture coordinate. If one coordinate in a set of texture coordinates
                is outside the range from 0 to 1, the whole set is not quantized. Defaults to 16.
            ``"color"``: The number of bits of each component of a color. Defaults to 8.
        :param weight_sets: For a skinned mesh in a ``.gltf`` or ``.glb`` file, the largest number of sets of joints for
            each vertex. A set has four joints and their weights. For example, if the limit is 2, up to eight joints
            move a vertex. If omitted, the limit is the number of sets in the file that the mesh was loaded from, or 1
            if this number is not known.
        :param rows: For ``.csv``, the elements that have a row in the table: vertices, faces or corners. If omitted,
            vertices.
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

        The operation acts on the objects that its parameter ``on`` lists. Each object becomes one mesh of the same
        name. Every patch is divided into ``segments`` x ``segments`` cells. Vertices, edges and faces of earlier
        patches have lower ids. Different patches share no vertices. If two patches have the same control points on a
        common side, their vertices on this side have exactly equal positions. ``weld(distance=0)`` then joins the
        patches. If all points of a side coincide, as at the pole of a teapot's lid, the side becomes one vertex.
        Patches without area give no faces. The report counts the patches without area. The mesh has UVs only with
        ``uvs=True``, and normals only with ``normals=True``.

        Example: ``mesh.tessellate(segments=3)``

        :param segments: The number of cells along each side of a patch. Defaults to ``8``.
        :param faces: Whether each cell becomes triangles or quads. Defaults to ``"Triangles"``.
            ``"Triangles"``: Two triangles, divided by the diagonal from the corner with the lowest u and v to the
                opposite corner.
            ``"Quads"``: One quad.
        :param uvs: Whether to store the patch parameters (u, v) of each vertex as UVs of the face corners at this
            vertex. The UVs of different patches overlap, because each patch covers the whole square from 0 to 1.
            Defaults to ``False``.
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

        Each curve becomes one polyline in the plane z = 0. The polyline has ``segments`` + 1 points, at the curve
        parameters 0, 1 / segments, 2 / segments and so on, up to 1. The first and the last point are exactly the first
        and the last control point of the curve.

        Example: ``mesh.sample_curve(segments=1)``

        :param segments: The number of straight segments of each polyline.
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
        """Replaces each curve with polylines that show the levels of de Casteljau's algorithm.

        A curve with n control points becomes n polylines in the plane z = 0. The first polyline is the control polygon
        with n points. The points of each later polyline divide the segments of the previous polyline in the ratio t : 1
        - t. Each polyline therefore has one point fewer than the previous polyline. The last polyline has a single
        point, the point of the curve at ``t``.

        Example: ``mesh.curve_levels(t=0)``

        :param t: The curve parameter at which the algorithm computes a point, from 0 (the start of the curve) to 1 (the
            end).
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
        """Moves one control point of each curve.

        The other control points do not move. The point of the curve at a parameter t moves by B(t) d. Here, d is the
        displacement of the control point, and B is the Bernstein polynomial of the control point.

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

        The operation acts on the objects that its parameter ``on`` lists. If other control points of the object are at
        the same position, they also move, so that patches with a common side stay joined. The point of a patch at the
        parameters (u, v) moves by B(u) C(v) d. Here, d is the displacement of the control point, B is the Bernstein
        polynomial of its column, and C is the Bernstein polynomial of its row. The report counts the changed objects.

        Example: ``mesh.move_patch_point(index=5, to=(1, 2, 0.5))``

        :param index: The index of the control point in the object: 16 p + 4 r + c. Here, p is the index of the patch, r
            is the row and c is the column, all counted from 0. Every object on which the operation acts must have a
            control point with this index.
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
        and polylines. If nodes of the scene (as in glTF) place an object and ``space`` is ``Scene``, the operation
        changes the transforms of these nodes instead of the points. The descendants of these nodes move with them. A
        skinned mesh follows its joints, so with ``space="Scene"``, the operation moves the joints. If the transform of
        a node is animated, the animation would overwrite the change. The operation therefore gives this node a new
        parent and moves the parent. Root nodes without an object, such as the nodes of cameras and lights, also move if
        three conditions hold: ``space`` is ``Scene``, the operation has no ``on``, and ``about`` is not ``Center``. The
        operation fails if a curve would leave the plane z = 0.

        Ids do not change. If the points of a mesh change, its normals, its tangents and the deltas of its morph targets
        are also transformed. Other attributes do not change. If the points are mirrored (one or three negative factors
        in ``scale``), the faces are also reversed, so that they stay counter-clockwise seen from outside. In a reversed
        face, the first corner stays first, and the other corners follow in reverse order. In mirrored patches, u and v
        are exchanged, so that the same side of the surface remains the outside. Attributes with the edit rule ``Drop``,
        such as tangents of corners, are removed by every step that changes the connectivity. Mirroring the points
        reverses the faces, so it also removes the attributes with this rule.

        Example: ``mesh.transform(scale=(2, 1, 1), rotate=[{"axis": "Z", "angle": 90}], move=(3, 1, 0))``

        :param scale: The scale factors along x, y and z. Factors must not be 0. A negative factor mirrors along its
            axis.
        :param rotate: The rotations, applied in the order of the list.
            ``"axis"``: The direction of the axis.
            ``"angle"``: The angle of the rotation, in degrees. A positive angle is counter-clockwise if the axis points
                towards the viewer. Rotations by multiples of 90 degrees have no rounding errors.
        :param move: The distances to move along x, y and z, in scene units.
        :param about: The point that scaling and rotation do not move. Defaults to ``"Origin"``.
            ``"Origin"``: The origin.
            ``"Center"``: The center of the bounding box of each object.
            ``choice.Point(..)``: A point with the coordinates x, y, z.
        :param space: The coordinate system in which objects are scaled, rotated and moved. Defaults to ``"Scene"``.
            ``"Scene"``: The space of the scene.
            ``"Object"``: The coordinate system in which the object stores its points.
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
        """Merges vertices that are close together, so that the faces at these vertices become connected.

        Two vertices are linked if they are at most ``distance`` apart. Vertices that are connected by a chain of links
        merge into one, even if the ends of the chain are farther apart than ``distance``. Of the vertices that merge,
        the vertex with the lowest id remains, with its position and values. The other vertices are removed, so vertices
        with higher ids get new ids. If several edges then join the same two vertices, they become one edge. The merged
        edge gets the values of the edge with the lowest id. Corner values, such as UVs, stay with the corners of the
        faces, so UV seams are kept.

        If neighboring corners of a face merge, the face loses a corner. A face is removed if it has fewer than three
        corners left or would contain a vertex twice. After the merge, neighboring faces can have opposite orientations.
        If possible, the operation then reverses faces, so that all faces of a connected part have the same orientation:
        the more frequent one. The report counts the reversed faces. If faces are reversed, the normals of vertices and
        corners are dropped. If the result is still not a manifold, vertices and edges are copied. For example, if three
        faces share an edge, one of these faces gets a copy of the edge. The report counts the copies. If no vertices
        merge, the mesh does not change.

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
        """Reverses the orientation of faces, so that their inside and outside are exchanged.

        Adjacent faces must have the same orientation, so only whole connected components can be reversed. If a selected
        face shares an edge with a face that is not selected, the operation fails. No vertex moves, and all elements
        keep their ids. The first corner of a face stays first, and the other corners follow in reverse order. Normals
        are negated. Attributes that do not survive changes of the connectivity (edit rule ``Drop``), such as tangents
        of corners, are removed. Vertices, edges and faces keep all other values. The values of a corner stay at the
        same vertex of the same face.

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

        A quadrilateral is cut along its shorter diagonal. If both diagonals have the same length, the diagonal at the
        vertex with the lowest id is used. Two lengths count as the same if the relative difference of their squares is
        at most 1e-12. A diagonal is bad if one of its two triangles has zero area or is turned over. A triangle is
        turned over if it is clockwise where the face is counter-clockwise. If exactly one diagonal is bad, the good
        diagonal is used, regardless of lengths and ids. A quadrilateral with a reflex corner (an angle above 180
        degrees) is therefore cut at that corner. A diagonal is a duplicate if its ends are also joined by an edge or by
        a diagonal of another face. A duplicate is replaced with the other diagonal of the quadrilateral, unless the
        other diagonal is worse or also a duplicate. The report counts the duplicates that remain.

        A face with more than four corners is projected along its normal. If the face has at most 4096 corners, it is
        cut into triangles by ear clipping. A larger face is first cut into monotone polygons, which are then cut into
        triangles. Then diagonals are flipped until the triangulation is a constrained Delaunay triangulation. Some
        faces cannot be triangulated in this way: faces with zero area, faces with crossing sides, and faces with more
        than ten million corners. A face with overlapping sides also cannot be triangulated in this way if it has more
        than 4096 corners. Each of these faces becomes a triangle fan around its vertex with the lowest id. The report
        counts these faces.

        In the list of faces, the triangles of a face take the place of this face, so faces with higher ids get new ids.
        The triangles have the values of the face. Vertices and edges keep their ids. Each corner of a triangle has the
        values that the face had at the same corner.

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

        Edges are flipped in order of their ids. Each flip is checked against the mesh that the earlier flips have
        produced. A flip is refused if the edge is on the boundary or if the same face is on both sides of the edge. A
        flip is also refused if an end of the edge has only two edges. A flip is also refused if the new edge would join
        a vertex to itself, or would join two vertices that an edge already joins. The flip of a seam is refused unless
        ``seams`` is ``Drop``. All elements keep their ids, and no vertex moves. Vertices, edges and faces keep their
        values. Each of the two faces gets one new corner. The new corner of a face gets its values from the corner of
        the other face at the same vertex. All other corners keep their values.

        If a face beside the edge has more than three corners, the edge turns inside the polygon that the two faces form
        together. Each end of the edge moves to the next corner of this polygon, counter-clockwise. With
        ``until="Delaunay"`` or ``until="Valence"``, only edges between two triangles are flipped.

        With ``until="Delaunay"`` or ``until="Valence"``, an edge is flipped only if the flip improves the angles of the
        triangles (``Delaunay``) or the numbers of edges at the vertices (``Valence``). The operation makes several
        passes over the edges. It stops after a pass that flips no edge, or after ``passes`` passes. The flips neither
        fold the surface nor create zero-area triangles. If a flip that would improve the mesh is refused, the edge is
        left unchanged, and the operation does not fail. The report counts the refused flips for each reason. The report
        also states the number of passes, and whether the operation stopped because of the limit ``passes``.

        On a surface that is not flat, a flip changes the shape. To keep creases and other edges, exclude them from
        ``edges``. For example, ``sel.Flat(below=30)`` selects only edges at which the surface bends by less than 30
        degrees. ``sel.Not(sel.Tagged("keep"))`` selects only edges without the tag "keep".

        Example: ``mesh.flip_edges(edges="All")``

        :param edges: The edges to flip. The edges are selected before the first flip. An edge keeps its id when it is
            flipped. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param until: Which edges are flipped, and when to stop. Defaults to ``"Once"``.
            ``"Once"``: Flip each edge once.
            ``"Delaunay"``: Flip edges until no flip reduces the sum of the cotangents of all angles of all triangles.
            ``"Valence"``: Flip edges until no flip brings the valences (the numbers of edges) of the vertices closer to
                their targets.
        :param passes: The largest number of passes over the edges. Ignored with ``until="Once"``, which makes one pass.
            Defaults to ``100``.
        :param on_refusal: What to do when a flip is refused. Used only with ``until="Once"``. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param seams: What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
            Defaults to ``"Refuse"``.
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
        """Inserts a vertex on each edge and joins this vertex to the opposite corners of the triangles beside the edge.

        In a mesh of triangles, the split of an inner edge adds 1 vertex, 3 edges and 2 faces. The split of a boundary
        edge adds 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the face is not
        cut and only gains the new vertex as a corner. Edges are split in order of their ids; new edges are not split
        again. New vertices get the highest ids, in the order of the splits. Attribute values at the new vertex and at
        its corners are interpolated between the ends of the edge. A seam is an edge whose corner values, such as UVs,
        differ between its two sides. At a seam, the corner values of each side are interpolated separately.

        Example: ``mesh.split_edges(edges="All")``

        :param edges: The edges to split. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the new vertex on the edge, as a fraction of the length of the edge. Above 0 and
            below 1. If ``edges`` is ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other
            selections, position 0 is at the end whose vertex has the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a split is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        In a mesh of triangles, the collapse of an inner edge removes 1 vertex, 3 edges and 2 faces. The collapse of a
        boundary edge removes 1 vertex, 2 edges and 1 face. If a face beside the edge has more than three corners, the
        face is not removed and only loses a corner. Of the two ends, the vertex with the lower id is kept. Edges are
        collapsed in order of their ids. An edge that an earlier collapse removed counts as refused.

        A collapse is refused if it would change the topology of the surface, or if two different elements would become
        one. The report or the error message gives one of these reasons:

        - ``JoinsBoundaries``: both ends of the edge are on the boundary, but the edge itself is not.
        - ``Link``: the ends have a common neighboring vertex that is not a corner of a triangle beside the edge.
          Examples are the edges around a tube with three sides, and the edges of a hole with three edges.
        - ``DuplicateEdge``: a second edge joins the same two vertices.
        - ``RepeatedVertex``: both ends are also corners of a face that is not beside the edge.
        - ``Vanishes``: at the remaining vertex, the collapse would leave no face (as for a single triangle), or only
          two faces that lie back to back (as for a tetrahedron).
        - ``SameFace``: the same face is on both sides of the edge, or the collapse would put the same face on both
          sides of another edge.
        - ``SameOpposite``: the two triangles beside the edge share another edge.

        Attribute values at the remaining vertex and at its corners are interpolated between the ends of the edge. A
        seam is an edge whose corner values, such as UVs, differ between its two sides. At a seam, the corner values of
        each side are interpolated separately. When two edges become one, the remaining edge gets the larger crease
        value (sharpness for subdivision) and the tags of both edges. Normals are dropped.

        Example: ``mesh.collapse_edges(edges="All", on_refusal="Skip")``

        :param edges: The edges to collapse. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param at: The position of the remaining vertex on the old edge, as a fraction of the length of the edge, from 0
            to 1. If ``edges`` is ``sel.Between("v", "w")``, position 0 is at v and position 1 is at w. For all other
            selections, position 0 is at the end whose vertex has the lower id. Defaults to ``0.5``.
        :param on_refusal: What to do when a collapse is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        Edges are removed in order of their ids. Each removal is checked against the mesh that the earlier removals have
        produced. A removal reduces the number of edges by 1 and the number of faces by 1. Of the two faces beside the
        edge, the face with the lower id is kept, with its values. No vertex is removed or moved. To remove vertices
        that are left with two edges, use ``dissolve_vertices(vertices=sel.Valence(2))`` in a later operation. The
        remaining elements keep their order and their values but get new ids.

        An edge cannot be removed if it is on the boundary or if the same face is on both of its sides. It also cannot
        be removed if one of its ends has only two edges. The two faces beside the edge must have no common vertices
        except the ends of the edge. A seam is removed only if ``seams`` is ``Drop``.

        Example: ``mesh.dissolve_edges(edges=sel.Between(0, 1))``

        :param edges: The edges to remove. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
        :param seams: What to do with a seam (an edge whose corner values, such as UVs, differ between its two sides).
            Defaults to ``"Refuse"``.
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

        A selected edge and both of its ends are removed, and a new face replaces the edge. On both sides, the new face
        extends up to the distance ``width`` from the old edge. An edge that is not selected, but ends at a vertex of a
        selected edge, is shortened at this vertex. If the shortened edge and the selected edge are neighboring sides of
        a face, the new end of the shortened edge is at the distance ``width`` from the selected edge. However, the edge
        is shortened by at most four times ``width``. If the two edges are not neighboring sides of a face, the edge is
        shortened by ``width``. If two selected edges are neighboring sides of a face, a new vertex inside this face
        replaces the corner between them. If three or more new vertices replace an old vertex, another new face joins
        the new vertices. All selected edges are beveled at once. For example, a cube with 12 selected edges keeps all
        of its symmetries.

        The vertices at the ends of selected edges are removed, so vertices with higher ids get new ids. New vertices
        get the highest ids. Faces keep their ids. New faces get the highest ids: first the faces that replace edges, in
        order of these edges, then the faces that replace vertices. Edges get new ids.

        The values of a new vertex are interpolated between corners of an old face, so textures stay in place. A new
        face has the values (material, tags) of one of the old faces beside it. It is not specified which of these faces
        is used, but the choice is the same in every run. New edges have zero values (no crease, no tags). Normals are
        dropped.

        An edge cannot be beveled if it is on the boundary (reason: ``Boundary``), or if one of its ends has only one
        other edge and this other edge is not selected (reason: ``FewEdges``). If the bevels at the two ends of any edge
        would overlap, the selected edges at these ends cannot be beveled (reason: ``OutsideEdge``). If the result would
        not be manifold, no edge is beveled (reason: ``NonManifold``).

        Example: ``mesh.bevel_edges(edges=sel.Between(0, 2), width=0.25)``

        :param edges: The edges to bevel. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param width: The distance of each new edge from the old edge, in scene units. Two new edges replace the old
            edge: one in each of the faces beside it. Either ``width`` or ``fraction`` must be given.
        :param fraction: The width as a fraction of a length: the length of the shortest edge that is selected or shares
            a vertex with a selected edge. Above 0 and below 1.
        :param on_refusal: What to do when an edge cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        The operation sets two attributes to ``sharpness``: the edge attribute ``crease`` of the selected edges, and the
        vertex attribute ``corner`` of the selected vertices. Elements that are not selected keep their values, or get 0
        if the attribute did not exist before the operation. In Loop and Catmull-Clark subdivision, an edge or a vertex
        with sharpness s stays sharp in the first s levels and becomes smooth in later levels. For example, an edge with
        sharpness 2.5 is sharp in the first two levels. The third level places the vertices halfway between the sharp
        and the smooth result. An edge with sharpness 10 stays sharp, however many levels follow. Boundary edges are
        always sharp.

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
        order of the poked faces. The new vertex is at the mean of the positions of the corners, moved along the normal
        of the face by ``distance``. At the new vertex, interpolated attributes, such as UVs, get the mean of their
        values at the corners of the face. The triangles have the values of their face, and the new edges have zero
        values (no crease, no tags). If ``distance`` is not 0, normals are dropped.

        A face cannot be poked if it contains a vertex twice, or if the position of the new vertex would not be finite.
        No face can be poked if the mesh already has the largest supported number of elements.

        Example: ``mesh.poke_faces()``

        :param faces: The faces to poke. Defaults to ``"All"``. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param distance: The distance of the new vertex from the center of the face, along the normal of the face, in
            scene units. A negative distance moves the vertex inwards. A zero-area face has no normal, so its new vertex
            is at the center. Defaults to ``0.0``.
        :param on_refusal: What to do when a face cannot be poked. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        Each pair (v, w) of vertices in ``between`` cuts the face that has both vertices as corners. The new edge joins
        the two vertices. Each cut adds 1 edge and 1 face. Cuts are made in the order of the list, so a face can be cut
        several times. A cut from v to w divides the face into two parts. Seen from outside, the part to the right of
        the line from v to w becomes the new face. The other part keeps the id of the old face. New edges and faces get
        the highest ids. Corners keep their values. The new face has the values of the old face, and the new edge has
        zero values (no crease, no tags).

        A cut is refused if the two vertices are the same or are already joined by an edge. A cut is also refused if no
        face has both vertices as corners. If several faces have both vertices as corners, the cut is refused because it
        is ambiguous.

        Example: ``mesh.split_faces(between=[])``

        :param between: The cuts, as a list of pairs of vertex ids, for example ``[(0, 2), (5, 9)]``.
        :param on_refusal: What to do when a cut is refused. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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
        that lose their last edge are also removed, unless ``keep_vertices`` is true. Vertices that had no edge before
        the operation are kept. The remaining elements keep their order and their values but get new ids. To delete
        edges or vertices together with their faces, select the faces with ``sel.FacesBeside("edges")`` or
        ``sel.FacesAround("vertices")``.

        The removal is refused if the remaining faces around a vertex would form several fans that meet only at this
        vertex. A fan is a group of faces that are connected across edges. With ``on_refusal="Skip"``, the operation
        then tries to remove the faces one by one, in order of their ids. The operation repeats these attempts until no
        more selected faces can be removed. Selected faces that still cannot be removed are kept, and the report counts
        them as refused.

        Example: ``mesh.delete_faces(faces="All")``

        :param faces: The faces to delete. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when some of the faces cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        Selected faces that are connected across edges form a region. A region moves as a whole, and has one normal and
        one center. A region is first scaled, then rotated, and then moved. Scaling and rotation are about the center of
        the region, which is the mean position of its vertices. Side faces with four corners are added along the rim of
        the region. An edge belongs to the rim if exactly one of its two sides has a face of the region. If all faces of
        an open sheet are extruded, the result is a box that is open where the sheet was. A closed region (for example,
        all faces of a cube) has no rim, so it moves without new side faces. A region has no normal if the area vectors
        of its faces cancel each other out, as in a closed region. For a region without a normal, ``by`` must be an
        ``choice.Offset``.

        The moved faces keep their ids. A later operation can therefore extrude the same faces again, for example to
        grow an arm out of a body. Vertices and edges inside a region also keep their ids. The vertices and edges of the
        old rim do not move, and the moved faces get a new rim. New side faces get the highest ids. Side faces are
        ordered by region, and within a region by the id of the adjacent moved face. Regions are ordered by their lowest
        face id. Around each moved face, the order is counter-clockwise from its first corner. Each side face adds one
        new vertex, so the new vertices are in the order of the side faces. A new vertex is a copy of a vertex on the
        old rim: the first vertex of its side face.

        A side face has the attribute values (material, tags) of the adjacent moved face. The corners of a side face
        have the values of the corners of the moved face, so textures have no seam between the two faces. However, a
        side face shows only one line of the texture: the line along the edge of the moved face. This line is stretched
        over the whole side face. The edges of the new rim have the values of the edges of the old rim (creases, tags).
        The edges between the old and the new rim have zero values (no crease, no tags). Normals are dropped.

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

        Each face is inset separately, even if selected faces share edges. The shrunk inner face keeps the id of the
        selected face, and existing vertices do not move. For a face with n corners, the operation adds n vertices, 2 n
        edges and n faces with four corners. New vertices and faces get the highest ids. They are numbered in order of
        the selected faces, and counter-clockwise around each face from its first corner.

        Attribute values at a new corner or vertex are interpolated in the same way as its position, so textures do not
        move on the surface. The interpolation is between the value at the outer corner and the mean of the values at
        all corners of the face. The faces of the ring have the values of the old face (material, tags). The edges of
        the inner face have the values of the old edges beside them. Normals are dropped.

        A face cannot be inset if it is on both sides of one of its edges.

        Example: ``mesh.inset_faces(faces="All", fraction=0.25)``

        :param faces: The faces to inset. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of the new corners between the old corners (0) and the center of the face (1).
            Must be more than 0 and less than 1.
        :param on_refusal: What to do when a face cannot be inset. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        The operation works like ``inset_faces()``, and also moves the inner face along its normal. Each face is beveled
        separately, even if selected faces share edges. The shrunk inner face keeps the id of the selected face, and
        existing vertices do not move. For a face with n corners, the operation adds n vertices, 2 n edges and n faces
        with four corners. New vertices and faces get the highest ids. They are numbered in order of the selected faces,
        and counter-clockwise around each face from its first corner. A zero-area face has no normal, so its inner face
        is not raised.

        Attribute values at a new corner or vertex are interpolated by ``fraction``. Here, 0 stands for the value at the
        outer corner, and 1 stands for the mean of the values at all corners of the face. The faces of the ring have the
        values of the old face (material, tags). The edges of the inner face have the values of the old edges beside
        them. Normals are dropped.

        A face cannot be beveled if it is on both sides of one of its edges.

        Example: ``mesh.bevel_faces(faces="All", fraction=0.25, distance=0.5)``

        :param faces: The faces to bevel. ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of
            ``meshwright.sel``.
        :param fraction: The position of the new corners between the old corners (0) and the center of the face (1),
            before the inner face is raised. Must be more than 0 and less than 1.
        :param distance: The distance by which the inner face moves along its normal, in scene units. A negative
            distance moves the inner face in the direction opposite to its normal.
        :param on_refusal: What to do when a face cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        Vertices are removed in order of their ids. Each removal is checked against the mesh that the earlier removals
        have produced. If a vertex has three or more edges, all faces around it become one face. The merged face
        replaces the old face with the lowest id, and has the values of this old face. If the vertex is on the boundary,
        its two boundary edges also become one edge. If the vertex has only two edges, these edges become one edge, and
        each face beside this edge loses a corner. When two edges become one, the edge with the lower id is kept, with
        its values. The remaining elements keep their order and their values but get new ids. Normals are dropped.

        A vertex cannot be removed if it is isolated or has a single edge. It also cannot be removed if a neighboring
        vertex would be left with a single edge, because this edge would end inside a face. A removal is also refused if
        a face would contain a vertex twice or have fewer than three corners. A removal is also refused if it would join
        two vertices that an edge already joins. A vertex on a seam (an edge whose corner values, such as UVs, differ
        between its two sides) is removed only if ``seams`` is ``Drop``.

        Example: ``mesh.dissolve_vertices(vertices=sel.Vertices([1]))``

        :param vertices: The vertices to remove. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param on_refusal: What to do when a vertex cannot be removed. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        Each edge at a selected vertex is cut near this vertex. A new face with a corner at each cut replaces the
        vertex. For example, if all vertices of a cube are beveled with ``fraction=0.25``, the result is a truncated
        cube. The distance of a cut from the vertex is ``fraction`` times the length that the edge had before the
        operation. If both ends of an edge are selected, ``fraction`` must be below 0.5.

        The selected vertices are removed, so the ids of the vertices after them change. New vertices get the highest
        ids, in order of the selected vertices and clockwise around each vertex. Old faces keep their ids. New faces get
        the highest ids, in order of the selected vertices.

        Attribute values at a cut are interpolated between the two ends of the cut edge, so textures do not move on the
        surface. A new face has the values (material, tags) of one of the faces at the vertex. It is not specified which
        of these faces is chosen, but the choice is the same in every run. New edges have zero values (no crease, no
        tags). Normals are dropped.

        A vertex cannot be beveled if it is on the boundary or has fewer than three edges. It also cannot be beveled if
        an earlier cut has left one of its edges too short for a second cut.

        Example: ``mesh.bevel_vertices(vertices="All", fraction=0.25)``

        :param vertices: The vertices to bevel. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param fraction: The distance of each cut from the vertex, as a fraction of the length of the cut edge. More
            than 0 and less than 1.
        :param on_refusal: What to do when a vertex cannot be beveled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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
        removed, because they would contradict the vertex normals. The normal of a vertex is the zero vector if the
        vertex has no faces, if all its faces have zero area, or if their normals cancel each other out. The report
        counts these vertices.

        Example: ``mesh.vertex_normals()``

        :param weight: How the normals of the faces around a vertex are weighted. Defaults to ``"Area"``.
            ``"Area"``: The area of the face.
            ``"Angle"``: The angle of the face at the vertex.
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
        tangents are written to the corner attribute ``tangent``, which is replaced if it exists. Each value has four
        numbers: a unit vector perpendicular to the normal, and then the sign of the bitangent (1 or -1). ``.glb`` and
        ``.gltf`` files store the attribute as ``TANGENT``. For the computation, polygons are triangulated in the same
        way as for ``.glb`` and ``.gltf`` files. Later operations that change the shape or the faces remove the
        tangents, except a ``transform()`` that does not mirror the points. If the texture coordinates define no
        direction at a corner, the corner gets an arbitrary tangent. This happens, for example, if all corners of a face
        have the same texture coordinates. The report counts the corners with an arbitrary tangent.

        Example: ``mesh.tangents()``

        :param uv: The name of the attribute with the texture coordinates for the normal map. Defaults to ``uv``.
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

        A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The outer rim of
        an open sheet is also a boundary loop; use ``around`` or ``max_edges`` to exclude it. No vertices are added, and
        existing elements keep their ids. With ``with_="Face"``, a hole with n edges gets one face with n corners. With
        ``with_="Triangles"``, the hole gets n - 2 triangles and n - 3 new edges.

        For holes with up to 500 edges, the triangles have the smallest possible total area. A hole with more than 500
        edges is filled one triangle at a time. Each triangle cuts off a corner of the remaining hole: the corner whose
        two neighboring vertices are closest to each other. Straight and reflex corners are cut off last. If the large
        hole is far from convex, the triangles can overlap. In holes of any size, a new edge never joins two vertices
        that an existing edge already joins. If the operation finds no triangulation without duplicate edges, the hole
        is not filled (reason: ``DuplicateEdge``). A hole with only two edges cannot be filled (reason: ``WrongPlace``).
        To close a hole with two edges, use ``stitch()``.

        New faces have the values of a face beside the hole. A new corner has the values of an existing corner at the
        same vertex. Normals are dropped if a hole was filled.

        Example: ``mesh.fill_holes()``

        :param around: Fill only holes with at least one of these vertices. Defaults to ``"All"``. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param max_edges: Fill only holes with at most this number of edges. If omitted, holes with any number of edges
            are filled.
        :param with_: The faces that cover a hole. Defaults to ``"Triangles"``.
            ``"Triangles"``: Triangles.
            ``"Face"``: One face with all vertices of the hole as corners.
        :param on_refusal: What to do when a hole cannot be filled. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The parameter
        ``first`` gives a vertex of one hole, and the parameter ``second`` gives a vertex of the other hole. The band
        starts at a new edge that joins these two vertices, and runs once around both holes. Let n and m be the numbers
        of edges of the two holes, where n is at least m. The band then consists of m quadrilaterals and n - m evenly
        spread triangles. The operation adds n edges and no vertices. Both holes can be in one connected part of the
        mesh, which then gets a tunnel or a handle. They can also be in two separate parts of the mesh, which then
        become connected. To bridge holes of two objects, first use ``join()`` to make one mesh of the objects.

        Each new face is beside one edge of the hole that has more edges. If both holes have the same number of edges,
        this edge belongs to the hole of the vertex ``first``. The new face copies the attribute values of the old face
        on the other side of this edge. A new corner has the values of an existing corner at the same vertex. Normals
        are dropped.

        The operation is refused if one of the given vertices is not on the boundary (reason: ``NotBoundary``), or if
        both are on the same hole (reason: ``WrongPlace``). The operation is also refused if a new edge would join two
        vertices that an edge already joins (reason: ``DuplicateEdge``). In this last case, try other vertices of the
        same holes.

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

        Two boundary edges coincide if each end of one edge is at most ``distance`` from the corresponding end of the
        other edge. Two edges that coincide only with each other form a pair and are joined. An edge that coincides with
        several edges cannot be joined (reason: ``NonManifold``). To avoid this, choose a ``distance`` that is less than
        the lengths of the edges. ``weld()`` merges all vertices that are close together, but ``stitch()`` merges only
        the ends of edges that it joins.

        When two vertices become one, the vertex with the lower id is kept, with its position and values. When two edges
        become one, the edge with the lower id is kept, with its values. The other vertex or edge is removed, so all
        vertices or edges with higher ids get new ids. Faces and corners do not change, so an edge whose sides have
        different UVs becomes a seam. If a hole with only two edges remains beside a joined edge, the two edges of this
        hole are also joined.

        A pair of edges cannot be joined if both edges belong to the same face (reason: ``SameFace``), or if two other
        edges would then join the same two vertices (reason: ``DuplicateEdge``). A pair also cannot be joined if both
        ends of another edge would become one vertex (reason: ``WrongPlace``), or if a face would contain a vertex twice
        (reason: ``RepeatedVertex``).

        Example: ``mesh.stitch(distance=0)``

        :param distance: The largest distance between corresponding ends of two edges, in scene units. With 0, only ends
            at equal positions are joined.
        :param on_refusal: What to do when a pair of coinciding edges cannot be joined, or when an edge coincides with
            several edges. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        The edges can form paths, loops and trees. A closed loop can separate a region of faces from the rest of the
        mesh. Each cut edge becomes two boundary edges, one for each side of the cut. Cuts can divide the faces around a
        vertex into several groups. The group that contains the face with the lowest id then keeps the old vertex, and
        each other group gets a copy of the vertex. The copies get the highest ids. Faces keep their ids, and no vertex
        moves. Copies of vertices and edges have the values of the originals. Corners keep their values. ``stitch()`` is
        the inverse operation: it joins the two sides of a cut.

        An edge on the boundary cannot be cut (reason: ``Boundary``). An edge also cannot be cut if it touches neither
        the boundary nor another edge to cut (reason: ``DuplicateEdge``). Both sides of the cut would still join the
        same two vertices, so the mesh would not open. However, a path of several edges inside the mesh can be cut,
        because all edges are cut at once.

        Example: ``mesh.cut(edges="All")``

        :param edges: The edges to cut. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param on_refusal: What to do when an edge cannot be cut. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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
        """Gives a tag (a named mark) to the selected vertices and removes this tag from all other vertices. For
        example, if the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged vertices in later
        operations.

        If a later operation copies a tagged vertex, as ``extrude_faces()`` does, the copy is also tagged. If a later
        operation adds a vertex on an edge, as ``split_edges()`` does, the new vertex is not tagged. An existing vertex
        tag of the same name is replaced. The operation fails if the mesh has a vertex attribute of this name that is
        not a tag. The geometry does not change. The report counts the vertices that gained or lost the tag.

        Example: ``mesh.tag_vertices(name="some", vertices="Boundary")``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param vertices: The vertices to tag. If the selection is empty, the tag exists but no vertex has it. ``"All"``,
            ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
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
        """Gives a tag (a named mark) to the selected edges and removes this tag from all other edges. For example, if
        the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged edges in later operations.

        When a later operation splits or subdivides a tagged edge, the parts of this edge are also tagged. An existing
        edge tag of the same name is replaced. The operation fails if the mesh has an edge attribute of this name that
        is not a tag. The geometry does not change. The report counts the edges that gained or lost the tag.

        Example: ``mesh.tag_edges(name="marked", edges=sel.EdgeLoop(sel.Longest(count=2)))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param edges: The edges to tag. If the selection is empty, the tag exists but no edge has it. ``"All"``,
            ``"Boundary"``, or a value of ``meshwright.sel``.
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
        """Gives a tag (a named mark) to the selected faces and removes this tag from all other faces. For example, if
        the name of the tag is ``rim``, ``sel.Tagged("rim")`` selects the tagged faces in later operations.

        When a later operation splits or subdivides a tagged face, the parts of this face are also tagged. An existing
        face tag of the same name is replaced. The operation fails if the mesh has a face attribute of this name that is
        not a tag. The geometry does not change. The report counts the faces that gained or lost the tag.

        Example: ``mesh.tag_faces(name="some", faces=sel.Facing(direction=(0, 0, 1), within=45))``

        :param name: The name of the tag. The name must not be empty and must not start or end with whitespace.
        :param faces: The faces to tag. If the selection is empty, the tag exists but no face has it. ``"All"``,
            ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
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
        """Splits every triangle into four and smooths the surface. The operation repeats this for every level.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The
        Euler characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has
        the id V + e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be
        triangles.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed as the parameter ``face_varying`` specifies, and seams are kept. When an edge or a triangle
        is split, its parts copy its attribute values, such as tags and materials. Normals are dropped, because they
        would be wrong. If an edge or a vertex has the sharpness s (see ``crease()``), it stays sharp for s levels.

        Example: ``mesh.loop_subdivide(levels=2)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param weights: The weights that determine the new positions of old vertices. An old vertex moves to a weighted
            mean of its old position and its neighbors. Defaults to ``"Warren"``.
            ``"Warren"``: The weight u of a neighbor is 3/16 if the vertex has n = 3 neighbors, and otherwise 3/(8n).
            ``"Loop"``: If the vertex has n neighbors, the weight u of a neighbor is (5/8 - (3/8 + cos(2π/n)/4)²)/n, as
                in Loop's thesis, 1987.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and each new vertex on the boundary lies in the middle of an
                old boundary edge.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but a value at a vertex stays unchanged if only one face at this vertex
                has the value.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also stay unchanged at a vertex with three or more
                different values.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also stay unchanged at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. Triangles next to the refined faces are cut in two or
            four. Without these cuts, new vertices would lie in the middle of edges of these triangles. The surface
            outside the refined faces does not move. The documentation of the Rust function
            ``subdivision::refine_faces`` describes the ids of new elements. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
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
        """Splits every face into quads and smooths the surface. The operation repeats this for every level.

        Each level creates one quad at each corner of each old face. A level turns V vertices, E edges and F faces with
        C corners in total into V + E + F vertices, 2 E + C edges and C quads. The Euler characteristic V - E + F does
        not change. Old vertices keep their ids. The vertex on edge e has the id V + e, and the vertex at the center of
        face f has the id V + E + f. Edge e becomes edges 2e and 2e + 1. The quads are numbered face by face, in the
        order of the old faces. The quads of an old face are in the order of the corners of this face.

        Vertex attributes are smoothed with the same weights as the positions. Texture coordinates and other corner
        values are smoothed as the parameter ``face_varying`` specifies, and seams are kept. When an edge or a face is
        split, its parts copy its attribute values, such as tags and materials. Normals are dropped, because they would
        be wrong. If an edge or a vertex has the sharpness s (see ``crease()``), it stays sharp for s levels.

        Example: ``mesh.catmull_clark(levels=2)``

        :param levels: The number of levels. Each level replaces every corner of a face with a quad. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param boundary: How vertices on the boundary move. Defaults to ``"EdgesOnly"``.
            ``"EdgesOnly"``: The boundary becomes a smooth curve that depends on boundary vertices only.
            ``"EdgesAndCorners"``: Like ``EdgesOnly``, but boundary vertices with one face stay in place.
            ``"Fixed"``: Boundary vertices stay in place, and each new vertex on the boundary lies in the middle of an
                old boundary edge.
        :param creasing: How the sharpness of creases decreases from level to level. Defaults to ``"Uniform"``.
            ``"Uniform"``: The sharpness decreases by 1.
            ``"Chaikin"``: The sharpness is averaged with the sharpness of the neighboring edges of the crease, then
                decreases by 1.
        :param face_varying: How texture coordinates and other corner values are smoothed. Defaults to ``"All"``.
            ``"None"``: Values are smoothed everywhere.
            ``"CornersOnly"``: Like ``None_``, but a value at a vertex stays unchanged if only one face at this vertex
                has the value.
            ``"CornersPlus1"``: Like ``CornersOnly``, but values also stay unchanged at a vertex with three or more
                different values.
            ``"CornersPlus2"``: Like ``CornersPlus1``, but values also stay unchanged at the ends of seams.
            ``"Boundaries"``: Values are interpolated linearly along seams and boundaries, and smoothed elsewhere.
            ``"All"``: Values are interpolated linearly everywhere: each new value is a mean of values of one old face.
        :param to_limit: Whether to move the vertices of the last level to the limit surface and to store the normals
            and tangents of this surface. Defaults to ``False``.
        :param faces: The faces to refine. If omitted, all faces. A face beside a refined face gets additional corners
            at the new vertices on their common edge. The surface outside the refined faces does not move. The
            documentation of the Rust function ``subdivision::refine_faces`` describes the ids of new elements.
            ``"All"``, ``"Boundary"``, ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
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
        """Splits every face into smaller faces without moving vertices. The operation repeats this for every level.

        With ``into="Triangles"``, all faces must be triangles. A level then turns V vertices, E edges and F triangles
        into V + E vertices, 2 E + 3 F edges and 4 F triangles. Triangle f becomes faces 4f to 4f + 3. With
        ``into="Quads"``, faces can have any number of corners, and each corner becomes a quad. A level then turns V
        vertices, E edges and F faces with C corners in total into V + E + F vertices, 2 E + C edges and C quads. The
        quads are numbered in the order of the old faces. The new vertex at the center of face f has the id V + E + f.
        In both cases, old vertices keep their ids and positions, and the new vertex on edge e has the id V + e. Edge e
        becomes edges 2e and 2e + 1.

        Vertex attributes are interpolated. Corner values are interpolated within each old face separately. When an edge
        or a face is split, its parts copy its attribute values, including the sharpness of edges. Normals are dropped.

        Example: ``mesh.midpoint(levels=2, into="Quads")``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
        :param until: The condition that ends the subdivision. If omitted, exactly ``levels`` levels are computed.
            ``choice.EdgeLength(..)``: Stops as soon as all edges are shorter than ``below``.
            ``choice.LimitDistance(..)``: Stops as soon as the distance of every vertex to its limit position is less
                than ``below``.
        :param into: How faces are split. Defaults to ``"Triangles"``.
            ``"Triangles"``: Splits each triangle into four.
            ``"Quads"``: Splits each face with n corners into n quads around its center.
        :param faces: The faces to refine. If omitted, all faces. With ``into="Triangles"``, triangles next to the
            refined faces are cut in two or four. With ``into="Quads"``, a face beside a refined face gets additional
            corners at the new vertices on their common edge. The documentation of the Rust function
            ``subdivision::refine_faces`` describes the ids of new elements. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
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
        """Splits every triangle into four and smooths the surface without moving the old vertices. The operation
        repeats this for every level.

        A level turns V vertices, E edges and F triangles into V + E vertices, 2 E + 3 F edges and 4 F triangles. The
        Euler characteristic V - E + F does not change. Old vertices keep their ids, and the new vertex on edge e has
        the id V + e. Edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3. All faces must be
        triangles.

        Vertex attributes are interpolated with the same weights as the positions. Corner values are interpolated
        linearly, separately in each old triangle. When an edge or a triangle is split, its parts copy its attribute
        values, such as tags and materials. Normals are dropped, because they would be wrong. The sharpness that
        ``crease()`` sets has no effect and is copied unchanged.

        Example: ``mesh.butterfly(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
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
        """Splits every triangle into three, flips the old edges, and smooths the surface. The operation repeats this
        for every level.

        A level turns V vertices, E edges and F triangles into V + F vertices, E + 3 F edges and 3 F triangles. Every
        second level also cuts each boundary edge in three. Each boundary edge that is cut in three adds one vertex and
        one edge to these counts. The Euler characteristic V - E + F does not change. Old vertices keep their ids. The
        new vertex in face f has the id V + f, and face f becomes faces 3f to 3f + 2. All faces must be triangles. Each
        step counts its own levels from 1. One operation of two levels therefore cuts the boundary edges. Two steps of
        one level each leave the boundary edges uncut.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are interpolated linearly
        within each old triangle separately. A triangle next to a flipped edge covers parts of two old triangles. If the
        flipped edge was a seam, the triangle mixes texture coordinates of both sides of the seam, which distorts
        textures. Each new triangle copies the attribute values, such as tags and materials, of the old triangle that
        was split. Parts of a boundary edge copy the values of the boundary edge. All other edges have zero values (no
        crease, no tags). Normals are dropped, because they would be wrong.

        Example: ``mesh.sqrt3(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of triangles by three. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
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
        """Replaces every edge and every vertex with a face and shrinks the old faces. The operation repeats this for
        every level.

        A level turns a closed mesh with V vertices, E edges and F faces into a mesh with 2 E vertices, 4 E edges and V
        + E + F faces. If the mesh has a boundary, a level creates additional elements along the boundary. The Euler
        characteristic V - E + F does not change. The shrunk face inside old face f has the id f, and the new face at
        old edge e has the id F + e. The new faces at old vertices have the highest ids. Isolated vertices are kept. The
        ids of isolated vertices follow the ids of all other vertices. Two kinds of vertices do not become faces:
        isolated vertices, and vertices inside the mesh that have only two edges.

        Vertex attributes are smoothed with the same weights as the positions. Corner values are smoothed within each
        old face separately. The new faces at edges and vertices mix corner values of several old faces. At a seam, the
        mixed values distort textures. A face inside an old face copies the attribute values of the old face. The new
        face at an edge or a vertex copies the values of an adjacent face. The two new edges along an old edge copy the
        values of this edge. All other edges have zero values (no crease, no tags). Normals are dropped, because they
        would be wrong.

        Example: ``mesh.doo_sabin(levels=1)``

        :param levels: The number of levels. Each level multiplies the number of faces by about four. Without ``until``,
            ``levels`` defaults to 1. With ``until``, ``levels`` is the maximum number of levels and defaults to 16.
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

        Every edge that crosses the plane gets a new vertex at the crossing point. Every face that crosses the plane is
        cut along the plane. A concave face can be cut in several places. A vertex near the plane is treated as if it
        were on the plane, and is not moved. A vertex is near the plane if its distance from the plane is at most 1e-9
        times the longest side of the bounding box. A vertex is also near if this distance is at most 1e-14 times the
        largest absolute coordinate. Every edge has two half-edges. When an edge is cut, one part keeps the id of the
        edge: the part that contains the start of the half-edge with the lower id. When a face is cut, the part that
        contains the first corner keeps the id of the face. New elements get the highest ids. Where an edge crosses the
        plane, attributes are interpolated. At a seam (an edge whose corner values, such as UVs, differ between its two
        sides), the corner values of each side are interpolated separately.

        With ``keep="Front"``, the part of the mesh behind the plane is removed. With ``keep="Back"``, the part in front
        of the plane is removed. A face in the plane whose normal points to the front belongs to the back, because the
        face closes the solid behind the plane. Vertices that are left without a face are removed. If the remaining
        faces around a vertex form several fans (groups of faces connected across edges), each fan gets a separate copy
        of the vertex. No faces are added to close the cut. To close the cut, use ``fill_holes()`` in a later operation.

        Example: ``mesh.bisect(normal=(0, 0, 1))``

        :param normal: The normal of the plane. The normal points to the front side. The length of the normal does not
            matter but must not be 0.
        :param point: A point on the plane.
        :param keep: The part of the mesh to keep: one side of the plane, or both sides. Defaults to ``"Both"``.
            ``"Both"``: Both sides.
            ``"Front"``: The side in front of the plane: the normal of the plane points to this side.
            ``"Back"``: The side behind the plane: the normal of the plane points away from this side.
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
        the halves are joined at the plane. Vertices near the plane (see ``bisect()``) are moved exactly onto the plane,
        so that the result is symmetric. Faces that lie in the plane are removed, because they would become walls inside
        the result. A vertex on the plane joins the halves if it is on the boundary of the kept half. Where the surface
        only touches the plane, without a boundary there, the halves are not joined. The report counts the faces that
        are removed completely, but not the faces that the plane cuts.

        The elements of the kept half come first, in their old order. The elements of the mirror image follow.
        Attributes are copied, so both halves have the same texture coordinates, tags and joint weights. Normals and
        tangents are dropped.

        Example: ``mesh.symmetrize(normal=(1, 0, 0))``

        :param normal: The normal of the plane. It points to the front side. The length of the normal does not matter
            but must not be 0.
        :param point: A point on the plane.
        :param from_: The half that is kept and mirrored. Defaults to ``"Front"``.
            ``"Front"``: The side in front of the plane: the normal of the plane points to this side.
            ``"Back"``: The side behind the plane: the normal of the plane points away from this side.
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

        Edges are collapsed, starting with the edges whose collapse changes the surface least. A collapse merges the two
        ends of an edge into one vertex. The change is measured by the squared distance of this vertex to the planes of
        the original triangles around the merged vertices (Garland, Heckbert, 1997). The operation ends when the number
        of faces given by ``faces`` or ``ratio`` is reached. It also ends when every remaining collapse would change a
        property that must be kept (see the list below) or could exceed ``error``. At least one of ``faces``, ``ratio``
        and ``error`` must be given, but not both ``faces`` and ``ratio``. All faces must be triangles.

        The following properties are kept:

        - Topology: the numbers of holes, handles and separate parts do not change.
        - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
          different tags or materials, tagged edges, creases, and the edges that ``features`` selects. A line can lose
          vertices, but its ends, and the vertices where lines meet, keep their exact positions.
        - Attributes: changes of texture coordinates, normals, colors and other numbers count as changes of the surface
          (Hoppe, 1999). New vertices get the values that fit best. Values are never mixed across a line, and no
          triangle is turned over in the texture. Stored normals are kept, so that a simplified mesh is shaded like the
          original. The vertex attributes that ``measure()`` stores also influence the result, and the report lists
          their names. To avoid this influence, use ``measure()`` after this operation.
        - Vertex tags: vertices with different tags, different sharpness, or different values of a whole-number
          attribute are not merged.

        Seams divide a texture into charts. The borders of charts are also simplified, and a simplified border can cross
        a neighboring chart in the texture. The report counts the faces that overlap in the texture. To leave more space
        between charts, use ``pack_uvs()`` with a larger ``padding`` before this operation.

        No collapse turns a triangle over. Remaining elements get new ids, in the order of their old ids. If ``error``
        is not given and the number of faces cannot be reached, the operation is refused (reason: ``Unreached``), and
        the message states why. With ``on_refusal="Skip"``, the operation instead simplifies the mesh as far as it can.

        Example: ``mesh.simplify(ratio=0.5)``

        :param faces: The number of faces to reach, for each mesh. The result can have one face fewer, because a
            collapse inside the mesh removes two faces. A mesh that already has at most this number of faces does not
            change.
        :param ratio: The number of faces to reach, as a fraction of the number of faces of each mesh.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. The
            limit is guaranteed: for each collapse, the operation computes an upper bound of how far the surface moves,
            and adds up these bounds. The sum overestimates the true distance. If the operation ends because of this
            limit, the true distance is usually at least a third of the limit. If omitted, there is no limit.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param pin: Vertices that are never removed and keep their exact positions, for example ``Boundary``. If
            omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param intersections: Whether the operation is allowed to make faces intersect each other. Intersections can
            occur where parts of the surface are close together. Defaults to ``"Allow"``.
            ``"Allow"``: New intersections are allowed.
            ``"Refuse"``: The operation refuses every change that would make a changed face intersect another face.
        :param on_refusal: What to do if the mesh cannot be reduced to the requested number of faces. Defaults to
            ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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
        length. Almost all other edges are shorter. Nearly all vertices of the result lie on the original surface. The
        only exceptions are new vertices that cannot move onto the surface without turning a triangle too far or moving
        the surface too far. The parameter ``length`` gives the same target length to all edges. With the parameter
        ``curvature``, edges are short where the surface is curved, and long where it is flat (Dunyach and others,
        2013). Exactly one of ``length`` and ``curvature`` must be given. All faces must be triangles.

        The following properties are kept:

        - Topology: the numbers of holes, handles and separate parts do not change.
        - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
          different tags or materials, tagged edges, creases, and the edges that ``features`` selects. Vertices on a
          line can only slide along this line. The ends of lines, the vertices where lines meet, and corners where a
          line turns by more than 40 degrees keep their exact positions. Sharp edges that are not on a line are rounded.
          To keep sharp edges, select them with ``features``.
        - Attributes: each vertex and corner gets the values of the original surface at its position. Values are never
          interpolated across a line.
        - Vertex tags: a new vertex gets a tag if all old vertices around its position have the tag. Usually, these old
          vertices are the three corners of the old triangle at this position. A tagged vertex can move only in two
          cases: all corners of one of its triangles have the tag, or both of its neighbors on a line have the tag. All
          other tagged vertices keep their exact positions. Vertices with a sharpness (see ``crease()``) also keep their
          exact positions.

        The number of faces depends on the area of the mesh, which is not known before the run. When the operation
        starts, it estimates the number of faces from the area. The operation fails if a mesh with this number of faces
        would exceed the memory budget.

        The passes leave out every split, collapse, flip or move that would turn a triangle by more than 60 degrees. All
        elements get new ids. If the operation cannot prove that the distance between the result and the original is at
        most ``error``, the operation is refused (reason: ``Unreached``). With ``on_refusal="Skip"``, a refused
        operation leaves the mesh unchanged, and the run continues.

        Example: ``mesh.remesh(length=0.5)``

        :param length: The target length of edges, in scene units.
        :param curvature: Target lengths that depend on the curvature of the surface, instead of one target length for
            all edges.
            ``"error"``: The intended largest distance between the original surface and the new triangles, in scene
                units. This distance is not guaranteed. To guarantee a distance, use the other parameter ``error``,
                which belongs to the operation itself: ``remesh(error=..)``.
            ``"min"``: The smallest target length of edges, in scene units.
            ``"max"``: The largest target length of edges, in scene units.
        :param features: Edges to keep as lines, in addition to the lines that are always kept. For example,
            ``sel.Sharp(above=30)``. If omitted, no additional edges. ``"All"``, ``"Boundary"``, or a value of
            ``meshwright.sel``.
        :param error: The largest allowed Hausdorff distance between the old and the new surface, in scene units. To
            stay below this limit, the operation can make some edges shorter than the target length. The distance is
            measured at the end of the operation, in both directions and for all points of both surfaces. If omitted,
            there is no limit.
        :param pin: Vertices that keep their exact positions, for example ``Boundary``. If omitted, no vertices.
            ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of ``meshwright.sel``.
        :param passes: The largest number of passes, from 1 to 1000. The operation ends earlier if a pass changes almost
            nothing. Defaults to 10.
        :param on_refusal: What to do if the distance between the result and the original could exceed ``error``.
            Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        If ``boundary`` is ``Fixed``, vertices on the boundary do not move, so that objects that touch along their
        boundaries still fit together.

        Example: ``mesh.smooth(by=choice.Taubin())``

        :param by: The method.
            ``choice.Laplacian(..)``: Moves each vertex towards the mean of its neighbors.
            ``choice.Taubin(..)``: Moves each vertex towards the mean of its neighbors, and then away from this mean
                with a slightly larger factor.
            ``choice.Implicit(..)``: Moves the surface by mean curvature flow.
            ``choice.Denoise(..)``: Filters the normals of the faces, so that similar normals of nearby faces become
                nearly equal.
        :param passes: The number of passes. At most 10000. If omitted, 1 for ``choice.Implicit`` and 10 for the other
            methods. With ``choice.Denoise``, ``passes`` counts only the passes that filter the normals, not the passes
            that then move the vertices.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param boundary: How vertices on the boundary move. Defaults to ``"Fixed"``.
            ``"Fixed"``: The vertices do not move.
            ``"Free"``: The boundary is smoothed as a set of curves: the movement of a vertex on the boundary depends
                only on its neighbors along the boundary.
        :param keep_volume: Whether to restore the original volume of the mesh after smoothing. To restore the volume,
            all vertices that are allowed to move are shifted by the same distance along their normals. The mesh must be
            closed. Defaults to ``False``.
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
        the changed mesh. For each element, the operation finds the nearest point on the surface of ``from_``, and the
        face that contains this point. The values of vertex and corner attributes at this point are interpolated between
        corners of this face. Attributes that are never interpolated, such as whole numbers and tags, are copied from
        the corner of this face that is nearest to the point. Values of face attributes are copied from this face. If
        the changed mesh already has the attribute with the same type of values, the attribute is overwritten. If the
        changed mesh has the attribute with another type of values, the operation fails.

        Seams divide the source object into charts. All corners of a face of the changed mesh take their values from the
        same chart. If a seam lies inside this chart, they take their values from the same side of the seam. This
        prevents triangles from stretching across a seam of the texture. Usually the chart that is nearest to the center
        of the face is used. Where parts of the source object intersect, the chart that is nearest to the center can be
        far from the corners of the face. If another chart is nearest to a corner, and is much nearer to the face as a
        whole, this other chart is used.

        Elements that are farther from the source object than ``within`` keep their values, or get zeros if the
        attribute is new. Either all corners of a face take values, or none of them. If one of the corners or the center
        of the face is too far away, all corners of the face keep their values or get zeros. The report counts the
        elements that take no values from the source object.

        Example: ``mesh.transfer(from_=scan, attributes=["uv", "color"], within=0.01)``

        :param from_: The mesh with the attributes.
        :param attributes: The names of the attributes, for example ``["uv", "color"]``.
        :param within: The largest distance from the mesh ``from_`` at which an element takes values, in scene units. If
            omitted, there is no limit.
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

        With ``falloff="r"``, vertices that are nearer than r to a selected vertex also move, but less far. At the
        distance d from the nearest selected vertex, the movement is multiplied by the weight (1 - (d/r)²)². The weight
        is 1 at selected vertices and falls smoothly to 0 at the distance r. Distances are measured along straight
        lines, not along the surface.

        With ``by=choice.Distance(..)``, each vertex moves along its own normal: the area-weighted mean of its face
        normals. Vertices without a normal, such as isolated vertices, do not move. The report counts these vertices.

        Example: ``mesh.move_vertices(vertices=sel.Vertices([0]), by=choice.Offset((0, 0, 0.5)))``

        :param vertices: The vertices to move. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a value of
            ``meshwright.sel``.
        :param by: How the vertices move.
            ``choice.Offset(..)``: Moves by this offset along x, y and z, in scene units.
            ``choice.Distance(..)``: Moves each vertex by this distance along its normal, in scene units.
            ``choice.To(..)``: Moves all selected vertices by the same offset, so that the mean of their positions
                becomes this point.
            ``choice.Rotate(..)``: Rotates around an axis through the mean of the positions of the selected vertices.
            ``choice.Scale(..)``: Scales along x, y and z about the mean of the positions of the selected vertices.
        :param falloff: The distance from the selected vertices at which the movement becomes 0, in scene units. If
            omitted, only the selected vertices move.
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

        Each vertex moves along its normal by ``distance`` times the value that ``by`` gives for this vertex. The normal
        of a vertex is the area-weighted mean of its face normals. Vertices without a normal, such as isolated vertices,
        do not move. The report counts these vertices. Normals and tangents are dropped. Faces, element ids and other
        attributes do not change.

        The displaced mesh is identical on all machines, because the computation uses only functions that do not depend
        on the machine.

        Example: ``mesh.displace(by=choice.Noise(scale=0.5, seed=7), distance=0.1)``

        :param by: The source of the values by which ``distance`` is multiplied, for example noise or an image.
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

        The parameters ``from_`` and ``to`` are coordinates along the axis. Vertices at or below ``from_`` do not move.
        Between ``from_`` and ``to``, the axis becomes an arc of the same length. The direction of the arc turns by
        ``angle`` from one end to the other. The part above ``to`` moves rigidly with the end of the arc. On the side of
        the axis towards the center of the circle, vertices move closer together. On the other side, vertices move
        apart. The distance between the center of the circle and the axis is (to - from) / angle, with the angle in
        radians. Parts of the mesh that lie beyond the center of the circle, as seen from the axis, turn inside out.
        Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.bend(axis="Z", angle=90)``

        :param axis: The direction of the axis that becomes an arc. The axis goes through the point ``about``.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle by which the axis turns between ``from_`` and ``to``, in degrees. A negative angle bends
            to the other side.
        :param towards: The upper end bends in the positive direction of this coordinate axis. If omitted, this is the
            axis after ``axis`` in the order x, y, z, x.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
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

        Along the axis, the angle grows linearly from 0 at the coordinate ``from_`` to ``angle`` at the coordinate
        ``to``. Vertices below ``from_`` do not move, and vertices above ``to`` rotate by ``angle``. An exact twist
        keeps the volume. The edges of a mesh stay straight, so the volume of the mesh changes slightly. The change is
        small if the mesh is fine. A second twist with the opposite angle and the same other parameters undoes the first
        twist. Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.twist(axis="Z", angle=90)``

        :param axis: The direction of the axis of the rotation. The axis goes through the point ``about``.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param angle: The angle at ``to``, in degrees, counter-clockwise if the axis points to the viewer.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
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

        Along the axis, the factor changes linearly from 1 at the coordinate ``from_`` to ``factor`` at the coordinate
        ``to``. Vertices below ``from_`` do not move, and vertices above ``to`` are scaled by ``factor``. Coordinates
        along the axis do not change. Source: Barr, "Global and Local Deformations of Solid Primitives", 1984.

        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface. Only vertices move, so refine the mesh first if its faces are large.

        Example: ``mesh.taper(axis="Z", factor=0.5)``

        :param axis: The direction of the axis. The axis goes through the point ``about``, and points on the axis do not
            move.
            ``"X"``: The x axis.
            ``"Y"``: The y axis.
            ``"Z"``: The z axis.
        :param factor: The scale factor at the coordinate ``to``. More than 0. A factor below 1 makes the upper end
            narrower.
        :param about: A point on the axis. The coordinate of the point along the axis does not matter.
        :param from_: The coordinate along the axis at which the deformation starts. If omitted, the lowest coordinate
            of the mesh along the axis.
        :param to: The coordinate along the axis at which the deformation reaches its full amount. If omitted, the
            highest coordinate of the mesh along the axis. Must not be less than ``from_``.
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

        The box contains a regular grid of control points. ``size`` gives the number of control points along x, y and z.
        ``moves`` gives offsets for some of the control points. The space in the box follows the moved points smoothly.
        The new position of a point in the box is a weighted sum of the new positions of all control points. The weights
        are Bernstein polynomials (Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models", 1986). If all
        control points move by the same offset, the whole box moves by this offset. If only one control point moves, the
        points in the box move in the same direction, but less far. However, if the control point is at a corner of the
        box, this corner moves exactly as far as the control point.

        Vertices outside the box do not move. Normals and tangents are dropped. Faces, element ids and other attributes
        do not change, so textures stretch with the surface. Only vertices move, so refine the mesh first if its faces
        are large.

        Example: ``mesh.lattice(size=(3, 3, 3), moves=[((2, 2, 2), (0.5, 0.5, 0.5))])``

        :param size: The numbers of control points along x, y and z. Each number is from 2 to 16.
        :param moves: The control points that move. Each entry consists of the three indices of a control point (along
            x, y and z, counted from 0) and the offset of this point in scene units. A control point that is listed
            several times moves by the sum of its offsets.
        :param min: The corner of the box with the lowest coordinates. If omitted, the same corner of the bounding box
            of the mesh is used.
        :param max: The corner of the box with the highest coordinates. If omitted, the same corner of the bounding box
            of the mesh is used.
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

        A vertex moves only if it is in ``vertices`` and not in ``pin``. All other vertices keep their exact positions.
        If the operation does not name objects with ``on``, it acts on all meshes except the object that ``onto`` names.
        Normals and tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch
        with the surface.

        Vertices that would move farther than ``distance`` do not move. With ``along="Normal"``, a vertex moves along
        the line of its normal. With ``along=choice.Direction(..)``, a vertex moves along a ray in this direction. If
        the line or ray of a vertex misses the surface, the vertex does not move. The report counts the vertices that
        would move too far, and the vertices whose line or ray misses the surface.

        Example: ``mesh.project(onto=scan, distance=0.1)``

        :param onto: The mesh onto whose surface the vertices move.
        :param along: How the operation finds the point of the surface to which a vertex moves. Defaults to
            ``"Nearest"``.
            ``"Nearest"``: Moves to the nearest point of the surface.
            ``"Normal"``: Moves to the nearest point at which the surface meets the line through the vertex along its
                normal.
            ``choice.Direction(..)``: Moves to the first point of the surface in this direction.
        :param vertices: The vertices to move. If omitted, all vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param pin: Vertices that do not move. If omitted, no vertices. ``"All"``, ``"Boundary"``, ``"Isolated"``, or a
            value of ``meshwright.sel``.
        :param distance: The largest distance that a vertex is allowed to move, in scene units. If omitted, there is no
            limit.
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

        Later operations can use the attribute to select elements (``sel.Where``) or to move vertices (``displace()``).
        They can also show it in a picture (``picture()``) or save it to a file (``save()``). If a later operation
        changes the mesh, the quantity is not computed again. Positions and other attributes do not change. Quantities
        are computed from the coordinates that the mesh stores. The transforms of the nodes that place the mesh in the
        scene are not applied. For each object, the report states the lowest, the mean and the highest value.

        If the mesh already has an attribute of this name, the attribute is replaced. The operation fails if the
        existing attribute belongs to a different kind of element, or does not have one floating-point number per
        element.

        Example: ``mesh.measure(of="MeanCurvature")``

        :param of: The quantity.
            ``"MeanCurvature"``: The mean curvature at each vertex, in 1 / scene unit (Cohen-Steiner, Morvan, 2003).
            ``"GaussianCurvature"``: The Gaussian curvature at each vertex, in 1 / scene unit² (Meyer, Desbrun,
                Schröder, Barr, 2003).
            ``choice.PrincipalCurvature(..)``: A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of
                the curvature tensor of Cohen-Steiner and Morvan, 2003.
            ``"Area"``: The area of each face, in scene units².
            ``"VertexArea"``: The area of the surface that belongs to each vertex, in scene units².
            ``"MinAngle"``: The smallest angle of each face, in degrees.
            ``"AspectRatio"``: The aspect ratio of each face (Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict
                Geometric Quality Library", 2007).
            ``choice.Distance(..)``: The distance from each vertex to the nearest point of another mesh of the scene, in
                scene units.
            ``choice.Geodesic(..)``: The distance along the surface from each vertex to the nearest selected vertex, in
                scene units.
            ``"Thickness"``: The thickness of the solid at each vertex, in scene units.
            ``choice.Occlusion(..)``: The ambient occlusion of each vertex.
            ``choice.Winding(..)``: The winding number of another mesh of the scene around each vertex (Jacobson, Kavan,
                Sorkine-Hornung, 2013; Barill, Dickson, Schmidt, Levin, Jacobson, 2018).
        :param name: The name of the attribute. If omitted, the attribute gets the name of the quantity in lower case,
            for example ``mean_curvature`` for ``MeanCurvature``. For principal curvatures, the default names are
            ``largest_curvature`` and ``smallest_curvature``.
        :param missing: The value for elements at which the quantity is not defined. For example, a vertex without faces
            has no curvature. The report counts these elements. If omitted, the value is 0 for quantities that can be
            negative, and -1 for all other quantities.
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

        The surface is cut into charts, which are connected parts of the surface. The charts are flattened and packed
        into the page, the square of the texture with u and v from 0 to 1. Each chart grows from a flat region, as long
        as the normals of its faces differ from their mean by at most ``max_angle``. Each chart is flattened by a least
        squares conformal map (Levy and others, 2002), which the hybrid method of Liu and others (2008) then improves. A
        chart is cut again if its flattened shape overlaps itself or exceeds ``max_stretch``. A chart is also cut again
        if its angles are distorted too much. This distortion turns a small circle on the surface into an ellipse in the
        texture. On at least 95 % of the area of a chart, the longer axis of this ellipse is at most 1.15 times the
        shorter axis. All charts of a mesh have the same scale, and no chart is mirrored. No polygon is divided between
        charts. Each mesh gets its own page. The charts are arranged on the page in the same way as by ``pack_uvs()``.

        The coordinates are written to the corner attribute that the parameter ``uv`` names. If this attribute already
        exists, it is replaced. Edges at which charts meet become seams of the texture coordinates. Positions, faces and
        other attributes do not change, but tangents are removed because they depend on the texture coordinates.
        Zero-area faces also have zero area in the texture. The report counts the faces with zero area in the texture.
        If a polygon is bent so far that it overlaps itself in the texture, the operation fails and gives the reason
        ``WrongPlace``. To avoid this failure, triangulate the bent polygons before this operation. With
        ``on_refusal="Skip"``, the operation does not fail, and the triangles of the bent polygons overlap in the
        texture.

        Example: ``mesh.unwrap(max_angle=60)``

        :param seams: Edges that become borders of charts, for example ``sel.Tagged("seam")`` or
            ``sel.Sharp(above=60)``. The algorithm adds more borders where charts need them. If omitted, the algorithm
            chooses all borders. ``"All"``, ``"Boundary"``, or a value of ``meshwright.sel``.
        :param max_angle: The largest angle between the normal of a face and the mean normal of its chart, in degrees.
            Smaller angles give more charts with less stretch. Defaults to ``70.0``.
        :param max_stretch: The area scale of a triangle is allowed to differ from the area scale of its whole chart by
            at most this factor. The area scale is the area in the texture divided by the area on the surface. Defaults
            to ``4.0``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size.
            The size matters only for ``padding``, which is a number of texels. Defaults to ``1024``.
        :param padding: The width of the empty border around each chart, in texels. The distance between two charts is
            at least twice this width. Defaults to 2.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param on_refusal: What to do if a polygon overlaps itself in the texture. Defaults to ``"Error"``.
            ``"Error"``: Fail, and leave the mesh unchanged.
            ``"Skip"``: Leave the element unchanged, count the refusal in the report, and continue with the next
                element.
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

        A chart is a set of faces that are connected across edges at which the texture coordinates have no seam. After
        the operation, the area of each chart in the texture is proportional to its area on the surface. The shape of
        each chart in the texture does not change. The operation does not repair charts that are stretched or mirrored,
        or that overlap themselves. A chart with zero area on the surface or in the texture becomes a point. The report
        counts these zero-area charts, and the charts that overlap themselves. Each mesh gets its own page, that is, the
        whole square of a texture. Tangents are removed, because charts are rotated.

        If a mesh has at most 256 charts, charts can be placed in the hollows and holes of other charts. If a mesh has
        more charts, all charts are packed in rows. Rows are computed much faster, but leave more of the page empty.

        Example: ``mesh.pack_uvs(page=2048, padding=4)``

        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param page: The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size.
            The size matters only for ``padding``, which is a number of texels. Defaults to ``1024``.
        :param padding: The width of the empty border around each chart, in texels. The distance between two charts is
            at least twice this width. Defaults to 2.
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

        The extension of the file determines the format. Without ``turntable``, the picture is a single image, and the
        extension must be ``.png``. With ``turntable``, the extension ``.gif`` gives an animated GIF, and ``.apng`` or
        ``.png`` gives an animated PNG. The scene does not change. Drawing needs no GPU and gives the same bytes on
        every machine.

        Example: ``mesh.picture(path="a.png", size=(64, 48), highlight=sel.Edges(sel.Sharp(above=30)), color_by={"of":
        "Valence"}, style={"wireframe": {}})``

        :param path: The file. A relative path is relative to the working directory.
        :param size: The width and the height of each view in pixels.
        :param camera: The camera.
            ``choice.Fit(..)``: Looks at the scene from a given side.
            ``choice.LookAt(..)``: Looks from one point to another point.
        :param views: Several cameras, which replace ``camera``. The picture shows the views of all these cameras, side
            by side.
        :param columns: The number of views in each row of the picture. If omitted, up to 4 views share one row, and
            more views are placed in rows of 4.
        :param style: The style: shading, lines, background.
            ``"shading"``: The lighting of surfaces.
            ``"sharp"``: An edge is shaded as sharp if the normals of its two faces differ by at least this angle, in
                degrees. This angle has no effect if the mesh stores normals or smoothing groups.
            ``"occlusion"``: The strength of ambient occlusion, which darkens hollows, from 0 (none) to 1.
            ``"background"``: The background.
            ``"color"``: The color of all surfaces. If omitted, surfaces have the colors of the scene.
            ``"back"``: The color of the back of faces. The back is visible where a mesh is open or inside out.
            ``"wireframe"``: Draws the edges of meshes, and grid lines on Bezier patches. Lines that are only a few
                pixels apart are drawn thinner, so that they do not cover the surface.
            ``"boundary"``: Draws the boundary edges of meshes.
            ``"creases"``: Draws crease edges. The width of a crease grows with its sharpness, up to twice ``width``.
            ``"normals"``: Draws vertex normals as short lines. The value is the length of the lines, as a fraction of
                the radius of the bounding sphere of the scene.
            ``"points"``: Draws dots at all vertices of meshes and all points of polylines. The value is the diameter of
                the dots in pixels.
            ``"control_nets"``: Draws the control nets of Bezier patches and the control polygons of curves.
            ``"ids"``: Labels vertices or faces with their ids. Fails if a mesh has more than 2000 of these elements.
            ``"curve_width"``: The width of curves and polylines in pixels.
        :param highlight: Elements to highlight in orange, as in ``sel.Edges(sel.Sharp(above=30))`` or
            ``sel.Faces(sel.Tagged("top"))``. ``"All"``, ``"Boundary"``, ``"Isolated"``, ``"SelfIntersecting"``, or a
            value of ``meshwright.sel``.
        :param highlight_width: The width of highlighted edges and the diameter of highlighted vertices, in pixels. The
            defaults grow with the shorter side of a view. For a side of 240 pixels, the width is 2.8 and the diameter
            is 7.5. The width and the diameter are 3.4 and 10 for 480 pixels, 4 and 13 for 960 pixels, and 8 and 26 for
            1920 pixels. If there are many highlighted vertices, their default diameter is smaller. Edges behind a
            surface are drawn faintly, and vertices behind a surface are drawn as rings.
        :param marks: More selections of elements to highlight, each with its own color.
            ``"of"``: The elements.
            ``"color"``: The color.
            ``"width"``: The width of edges and the diameter of vertices, in pixels. The defaults are the same as for
                ``highlight_width``.
        :param color_by: What the colors of the surface show: a quantity (``"Valence"``, ``"MinAngle"``, ``"Area"``,
            ``"DihedralAngle"``, ``"MeanCurvature"``, ``"GaussianCurvature"``, or a value of ``meshwright.choice``), the
            name of an attribute, or a mapping with more details.
            ``"of"``: The quantity that the colors show.
            ``"map"``: The color map. The default is ``Classes`` for valences, ``Diverging`` for curvatures, and
                ``Viridis`` for all other quantities.
            ``"range"``: The values that the first and the last color represent, as in ``(0, 60)``. If omitted, the
                range is computed from the values of the quantity. For curvatures, the range is symmetric about 0, and
                the lowest and the highest eighth of the values are ignored. If all remaining values are 0, only the
                lowest and the highest 2 % of the values are ignored, or no values.
            ``"legend"``: Whether a legend in a corner of the picture explains the colors.
        :param turntable: If given, the picture is an animation in which the camera moves once around the scene.
            ``"frames"``: The number of images.
            ``"seconds"``: The duration of the turn, in seconds.
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
        one panel for each combination of a curve, a value of ``t`` and a level of de Casteljau's algorithm. A panel
        shows the curve, its control polygon, every level of the algorithm in a different color, and the constructed
        point. Both axes have the same scale. With ``by_level``, the panels for a curve and a value of ``t`` form a
        sequence. The first panel shows only the first level of the algorithm, and each further panel shows one level
        more. Only the last of these panels shows the constructed point. The extension of the file determines the
        format: ``.svg`` or ``.png``. The scene does not change.

        Example: ``mesh.curve_figure(path="figure.svg", t=[0.25, 0.5])``

        :param path: The file. A relative path is relative to the working directory.
        :param t: The curve parameters at which points are constructed, from 0 (start of the curve) to 1 (end). If
            empty, only the curves and their control polygons are drawn.
        :param by_level: Whether each level of the algorithm has its own panel. If false, one panel shows all levels.
            Defaults to ``False``.
        :param before: The name of another curve, such as an older version of the drawn curve. This other curve is drawn
            faintly behind each drawn curve. If both curves have the same degree, an arrow leads from each control point
            of the other curve to the same control point of the drawn curve. Control points that have moved by at most
            28 SVG pixels have no arrow.
        :param width: The width of the figure in SVG pixels. The font size is 12 pixels in narrow panels and up to 19
            pixels in wide panels. Defaults to ``640``.
        :param columns: The number of panels in each row. If omitted, each row has one panel for each value of ``t``,
            but at most 4 panels. With ``by_level``, each row then has one panel for each level of the curve, but at
            most 4 panels.
        :param scale: In a ``.png`` file, each SVG pixel becomes a square of ``scale`` by ``scale`` pixels. Has no
            effect on ``.svg`` files. Defaults to ``2``.
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
        other side of the edge. At a boundary edge, the half-edge without a face is also drawn, in gray. The viewer
        looks at the faces from the direction of their mean normal. A face is left out if its normal points away from
        the viewer, or if it is seen nearly edge-on. The report counts these faces. The extension of the file determines
        the format: ``.svg`` or ``.png``. The scene does not change.

        The name of an element is a letter followed by the id of the element: ``v`` for vertices, ``h`` for half-edges,
        ``f`` for faces. The half-edges with the ids ``2e`` and ``2e + 1`` belong to the edge with the id ``e``.

        Example: ``mesh.half_edge_figure(path="figure.svg")``

        :param path: The file. A relative path is relative to the working directory.
        :param faces: The faces to draw, at most 200. Defaults to ``"All"``. ``"All"``, ``"Boundary"``,
            ``"SelfIntersecting"``, or a value of ``meshwright.sel``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The width and height of one SVG pixel, in pixels of a ``.png`` file. Has no effect on ``.svg``
            files. Defaults to ``2``.
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
        borders of charts, and thin lines are the other edges. Charts outside the page are also drawn. To make room for
        these charts, the figure is made higher, or everything in it is drawn smaller. The extension of the file
        determines the format: ``.svg`` or ``.png``. The scene does not change.

        Example: ``mesh.uv_picture(path="uv.svg")``

        :param path: The file. A relative path is relative to the working directory.
        :param uv: The name of the texture coordinates. Defaults to ``uv``.
        :param fill: What the colors inside charts show. Defaults to ``"Charts"``.
            ``"None"``: No colors.
            ``"Charts"``: The charts: each chart has one of eight colors.
            ``"Stretch"``: The distortion of angles.
        :param edges: Whether edges inside charts are drawn. Defaults to ``True``.
        :param width: The width of the figure in SVG pixels. Defaults to ``640``.
        :param scale: The width and height of one SVG pixel, in pixels of a ``.png`` file. Has no effect on ``.svg``
            files. Defaults to ``2``.
        :param id, progress: See :class:`Mesh`.
        :returns: The same mesh.
        """
        return self._apply('UvPicture', {'path': path, 'uv': uv, 'fill': fill, 'edges': edges, 'width': width, 'scale': scale}, None, id, progress)
