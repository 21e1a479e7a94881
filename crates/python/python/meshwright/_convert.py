"""Converts meshes from and to other packages. A package is imported only when one of its conversions is called.

Attributes of vertices and faces keep their names, except "normal" and "color" in Open3D, which calls them "normals" and
"colors". For trimesh, texture coordinates and colors are stored as visuals. A warning names the data that the other
package cannot hold.
"""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Container, Iterable
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._mesh import Mesh


def module(name: str) -> Any:
    """Imports a package. If the package is missing, the error says how to install it."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        # If the package is installed, but another package that it needs is missing, the original error says so.
        if error.name not in (name, None):
            raise
        raise ImportError(f"this conversion needs {name}: pip install {name}") from error


def plain(values: NDArray[Any]) -> NDArray[Any]:
    """Converts values for other packages, which cannot hold Booleans: Booleans become bytes."""
    return values.astype(np.uint8) if values.dtype == np.bool_ else np.array(values)


def kept(values: Any) -> NDArray[Any] | None:
    """Returns the values as an array of finite numbers, or of rows of at most 4 numbers. Returns `None` if an attribute
    cannot hold the values."""
    array = np.asarray(values)
    if array.dtype.kind not in "biuf" or array.ndim not in (1, 2) or array.ndim == 2 and not 1 <= array.shape[1] <= 4:
        return None
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        return None
    if array.dtype.kind in "iu" and array.size and not -(2**31) <= int(array.min()) <= int(array.max()) < 2**31:
        return array.astype(np.float64)
    return array


def one_for_each_vertex(values: NDArray[Any], mesh: Mesh) -> tuple[NDArray[Any], NDArray[Any], NDArray[np.int64]]:
    """Converts values of the corners of triangles to values of vertices. If the corners of a vertex have k different
    values, the vertex gets k - 1 copies. Returns three arrays: the values of the vertices, the triangles, and for each
    copy the index of the original vertex."""
    corners = mesh.corners.astype(np.int64)
    of_vertex = np.zeros((mesh.n_vertices, values.shape[1]))
    of_vertex[corners] = values
    others = np.flatnonzero((of_vertex[corners] != values).any(axis=1))
    rows, copies = np.unique(np.column_stack([corners[others], values[others]]), axis=0, return_inverse=True)
    corners[others] = mesh.n_vertices + copies.reshape(-1)
    return np.concatenate([of_vertex, rows[:, 1:]]), corners.reshape(-1, 3), rows[:, 0].astype(np.int64)


class MeshConversions:
    """Conversions of meshes."""

    def _mesh(self) -> Mesh:
        return self  # type: ignore[return-value]

    @classmethod
    def _of(
        cls,
        package: str,
        name: str,
        points: Any,
        faces: Any,
        face_starts: Any = None,
        *,
        of_vertices: Iterable[tuple[str, Any]],
        of_faces: Iterable[tuple[str, Any]],
        uv: NDArray[Any] | None = None,
    ) -> Any:
        """Makes a mesh from data of another package: points, faces, columns of values, and one texture coordinate `uv`
        for each point.

        If a repair drops a face or splits a vertex, the remaining elements keep their values."""
        this: Any = cls
        mesh, point_of_vertex, polygon_of_face = this._built(points, faces, face_starts, name)
        n_faces = len(faces) if face_starts is None else len(face_starts) - 1
        skipped = []
        for domain, columns, n, origin in (
            ("vertex", of_vertices, len(points), point_of_vertex),
            ("face", of_faces, n_faces, polygon_of_face),
        ):
            for column, values in columns:
                array = kept(values)
                if array is None or len(array) != n:
                    skipped.append(f"{domain} {column}")
                else:
                    mesh = mesh.with_attribute(str(column), array[origin], domain)
        if uv is not None:
            mesh = mesh.with_attribute("uv", uv[point_of_vertex[mesh.corners]], "corner")
        if skipped:
            warnings.warn(f"not kept from {package}: {', '.join(skipped)}", stacklevel=3)
        return mesh

    @staticmethod
    def _columns(mesh: Mesh, package: str, held: Container[str] = ()) -> dict[str, dict[str, NDArray[Any]]]:
        """Returns the attributes of vertices and faces as columns. A warning names all other attributes, except those
        in `held`."""
        columns: dict[str, dict[str, NDArray[Any]]] = {"vertex": {}, "face": {}}
        left_out = []
        for domain, name, values in mesh.attributes.items_by_domain():
            if domain in columns:
                columns[domain][name] = plain(values)
            elif f"{domain} {name}" not in held:
                left_out.append(f"{domain} {name}")
        if left_out:
            warnings.warn(f"{package} cannot hold {', '.join(left_out)}", stacklevel=3)
        return columns

    # ---- trimesh

    def to_trimesh(self) -> Any:
        """Returns a `trimesh.Trimesh` with the attributes of vertices and faces. Corner values of the attribute "uv"
        become texture coordinates. Without texture coordinates, vertex values of "color" become vertex colors. Faces
        must be triangles. Vertices keep their order, and nothing is merged. If the corners of a vertex have k different
        texture coordinates, k - 1 copies of the vertex are added after all other vertices, with a warning."""
        mesh = self._mesh()
        trimesh = module("trimesh")
        columns = self._columns(mesh, "trimesh", {"corner uv"})
        vertices, triangles, of_vertex = mesh.vertices.copy(), mesh.triangles, columns["vertex"]
        visual, colors = None, of_vertex.get("color")
        if any((domain, name) == ("corner", "uv") for domain, name, _, _ in mesh._core.attributes()):
            uv, triangles, point_of_copy = one_for_each_vertex(mesh.attributes["corner", "uv"], mesh)
            if len(point_of_copy):
                copies = f"{len(point_of_copy)} copies of vertices were made"
                warnings.warn(f"trimesh has one texture coordinate for each vertex: {copies}", stacklevel=2)
            origin = np.concatenate([np.arange(mesh.n_vertices), point_of_copy])
            vertices, of_vertex = vertices[origin], {name: values[origin] for name, values in of_vertex.items()}
            visual = trimesh.visual.TextureVisuals(uv=uv)
        return trimesh.Trimesh(
            vertices,
            triangles,
            vertex_attributes=of_vertex,
            face_attributes=columns["face"],
            visual=visual,
            vertex_colors=None if colors is None else (255 * colors.clip(0, 1)).round().astype(np.uint8),
            process=False,
        )

    @classmethod
    def from_trimesh(cls, other: Any, *, name: str = "mesh") -> Self:
        """Converts a `trimesh.Trimesh` to a mesh. Attributes of vertices and faces and texture coordinates are kept.
        The colors of vertices or faces become the attribute "color"."""
        of = {"vertex": dict(other.vertex_attributes), "face": dict(other.face_attributes)}
        visual = other.visual
        if visual.kind in of:
            colors = visual.vertex_colors if visual.kind == "vertex" else visual.face_colors
            of[visual.kind].setdefault("color", np.asarray(colors) / 255)
        uv = getattr(visual, "uv", None)
        if uv is not None:
            uv = np.asarray(uv, float)[:, :2]
            uv = uv if len(uv) == len(other.vertices) else None
        made = cls._of(
            "trimesh",
            name,
            other.vertices,
            other.faces,
            of_vertices=of["vertex"].items(),
            of_faces=of["face"].items(),
            uv=uv,
        )
        return made  # type: ignore[no-any-return]

    # ---- meshio

    def to_meshio(self) -> Any:
        """Returns a `meshio.Mesh` of triangles, quads and polygons, with the attributes of vertices and faces."""
        mesh = self._mesh()
        meshio = module("meshio")
        names = {3: "triangle", 4: "quad"}
        degrees = np.diff(mesh.face_starts.astype(np.int64))
        cells, order = [], []
        for degree in np.unique(degrees):
            faces = np.flatnonzero(degrees == degree)
            first = mesh.face_starts[faces].astype(np.int64)
            corners = mesh.corners[first[:, None] + np.arange(degree)]
            cells.append((names.get(int(degree), "polygon"), corners.astype(np.int64)))
            order.append(faces)
        columns = self._columns(mesh, "meshio")
        cell_data = {name: [values[faces] for faces in order] for name, values in columns["face"].items()}
        return meshio.Mesh(np.array(mesh.vertices), cells, point_data=columns["vertex"], cell_data=cell_data)

    @classmethod
    def from_meshio(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh from the triangles, quads and polygons of a `meshio.Mesh`. The data of points and cells become
        attributes. Other cells are left out, with a warning."""
        blocks = [(i, b) for i, b in enumerate(other.cells) if b.type in ("triangle", "quad", "polygon")]
        left = sorted({b.type for b in other.cells} - {b.type for _, b in blocks})
        if left:
            warnings.warn(f"not kept from meshio: cells of type {', '.join(left)}", stacklevel=2)
        lengths, corners = [np.zeros(1, np.int64)], [np.zeros(0, np.int64)]
        for _, block in blocks:
            if isinstance(block.data, np.ndarray):
                lengths.append(np.full(block.data.shape[0], block.data.shape[1]))
                corners.append(block.data.reshape(-1).astype(np.int64))
            else:
                lengths.append(np.array([len(cell) for cell in block.data], np.int64))
                corners += [np.asarray(cell, np.int64) for cell in block.data]
        points = np.asarray(other.points, float)
        if points.ndim == 2 and points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        cell_data = [(n, np.concatenate([np.asarray(d[i]) for i, _ in blocks])) for n, d in other.cell_data.items() if blocks]
        made = cls._of(
            "meshio",
            name,
            points,
            np.concatenate(corners),
            np.cumsum(np.concatenate(lengths)),
            of_vertices=other.point_data.items(),
            of_faces=cell_data,
        )
        return made  # type: ignore[no-any-return]

    # ---- pyvista

    def to_pyvista(self) -> Any:
        """Returns a `pyvista.PolyData` with the attributes of vertices and faces."""
        mesh = self._mesh()
        pyvista = module("pyvista")
        starts = mesh.face_starts.astype(np.int64)
        cells = np.insert(mesh.corners.astype(np.int64), starts[:-1], np.diff(starts))
        data = pyvista.PolyData(np.array(mesh.vertices), faces=cells)
        columns = self._columns(mesh, "pyvista")
        data.point_data.update(columns["vertex"])
        data.cell_data.update(columns["face"])
        return data

    @classmethod
    def from_pyvista(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh from the faces of a `pyvista.PolyData`, or from the surface of another dataset of pyvista. The
        data of points and cells become attributes."""
        surface = other if hasattr(other, "faces") else other.extract_surface()
        polygons = surface.GetPolys()
        array = module("pyvista").convert_array
        made = cls._of(
            "pyvista",
            name,
            surface.points,
            array(polygons.GetConnectivityArray()),
            array(polygons.GetOffsetsArray()),
            of_vertices=surface.point_data.items(),
            of_faces=surface.cell_data.items(),
        )
        return made  # type: ignore[no-any-return]

    # ---- Open3D

    def to_open3d(self) -> Any:
        """Returns an `open3d.t.geometry.TriangleMesh` with the attributes of vertices and faces. Faces must be
        triangles."""
        mesh = self._mesh()
        o3d = module("open3d")
        made = o3d.t.geometry.TriangleMesh()
        made.vertex.positions = o3d.core.Tensor(np.array(mesh.vertices))
        made.triangle.indices = o3d.core.Tensor(mesh.triangles.astype(np.int64))
        columns = self._columns(mesh, "Open3D")
        for target, named in ((made.vertex, columns["vertex"]), (made.triangle, columns["face"])):
            for name, values in named.items():
                own = {"normal": "normals", "color": "colors"}.get(name, name)
                target[own] = o3d.core.Tensor(values[:, :3].copy() if own == "colors" else values)
        return made

    @classmethod
    def from_open3d(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh from an Open3D triangle mesh, with its attributes of vertices and triangles."""
        if hasattr(other, "vertices"):
            other = module("open3d").t.geometry.TriangleMesh.from_legacy(other)
        own = {"normals": "normal", "colors": "color"}

        def columns(table: Any, skipped: str) -> list[tuple[str, Any]]:
            found = [(own.get(n, n), table[n].numpy()) for n in list(table) if n != skipped]
            return [(n, np.column_stack([v, np.ones(len(v))]) if n == "color" and v.shape[1] == 3 else v) for n, v in found]

        made = cls._of(
            "Open3D",
            name,
            other.vertex.positions.numpy(),
            other.triangle.indices.numpy(),
            of_vertices=columns(other.vertex, "positions"),
            of_faces=columns(other.triangle, "indices"),
        )
        return made  # type: ignore[no-any-return]
