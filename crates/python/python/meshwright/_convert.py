"""Conversions from and to other packages, which are imported when a conversion is called.

Attributes of vertices and faces keep their names. Texture coordinates and normals go where the other package has them.
What another package cannot hold is named in a warning.
"""

from __future__ import annotations

import importlib
import warnings
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._mesh import Mesh


def module(name: str) -> Any:
    """Imports a package, or says how to install it."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        # A package that is installed but lacks another package or library says so itself.
        if error.name not in (name, None):
            raise
        raise ImportError(f"this conversion needs {name}: pip install {name}") from error


def left_out(target: str, names: list[str]) -> None:
    """Warns about attributes that a package cannot hold."""
    if names:
        warnings.warn(f"{target} cannot hold {', '.join(names)}", stacklevel=3)


def plain(values: NDArray[Any]) -> NDArray[Any]:
    """Values that other packages can hold: flags become bytes."""
    return values.astype(np.uint8) if values.dtype == np.bool_ else np.array(values)


def kept(values: Any) -> NDArray[Any] | None:
    """Values that an attribute can hold: numbers, or rows of 2 to 4 numbers. `None` for others."""
    array = np.asarray(values)
    if array.dtype.kind not in "biuf" or array.ndim not in (1, 2) or array.ndim == 2 and not 1 <= array.shape[1] <= 4:
        return None
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        return None
    if array.dtype.kind in "iu" and array.size and not -(2**31) <= int(array.min()) <= int(array.max()) < 2**31:
        return array.astype(np.float64)
    return array


class MeshConversions:
    """Conversions of meshes."""

    def _mesh(self) -> Mesh:
        return self  # type: ignore[return-value]

    @classmethod
    def _with(cls, mesh: Any, domain: str, columns: Any, source: str) -> Any:
        """The mesh with columns of another package."""
        skipped = []
        for name, values in columns:
            array = kept(values)
            n = mesh.n_vertices if domain == "vertex" else mesh.n_faces
            if array is None or len(array) != n:
                skipped.append(f"{domain} {name}")
            else:
                mesh = mesh.with_attribute(str(name), array, domain)
        if skipped:
            warnings.warn(f"not kept from {source}: {', '.join(skipped)}", stacklevel=4)
        return mesh

    # ---- trimesh

    def to_trimesh(self) -> Any:
        """Returns a `trimesh.Trimesh` with the attributes of vertices and faces. Faces must be triangles. The positions
        are copied, because trimesh and its simplification need arrays that can be changed."""
        mesh = self._mesh()
        trimesh = module("trimesh")
        of = {"vertex": {}, "face": {}}  # type: dict[str, dict[str, NDArray[Any]]]
        other = []
        for domain, name, values in mesh.attributes.items_by_domain():
            if domain in of:
                of[domain][name] = plain(values)
            else:
                other.append(f"{domain} {name}")
        left_out("trimesh", other)
        return trimesh.Trimesh(
            mesh.vertices.copy(),
            mesh.triangles,
            vertex_attributes=of["vertex"],
            face_attributes=of["face"],
            process=False,
        )

    @classmethod
    def from_trimesh(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh of a `trimesh.Trimesh`, with its attributes of vertices and faces, and its texture
        coordinates."""
        mesh: Any = cls.from_arrays(other.vertices, other.faces, name=name)  # type: ignore[attr-defined]
        columns = list(other.vertex_attributes.items())
        uv = getattr(other.visual, "uv", None)
        mesh = cls._with(mesh, "vertex", columns, "trimesh")
        mesh = cls._with(mesh, "face", other.face_attributes.items(), "trimesh")
        if uv is not None and len(uv) == len(other.vertices) and mesh.n_vertices == len(uv):
            mesh = mesh.with_attribute("uv", np.asarray(uv)[mesh.corners][:, :2], "corner")
        return mesh  # type: ignore[no-any-return]

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
        point_data, cell_data, other = {}, {}, []
        for domain, name, values in mesh.attributes.items_by_domain():
            if domain == "vertex":
                point_data[name] = plain(values)
            elif domain == "face":
                cell_data[name] = [plain(values)[faces] for faces in order]
            else:
                other.append(f"{domain} {name}")
        left_out("meshio", other)
        return meshio.Mesh(np.array(mesh.vertices), cells, point_data=point_data, cell_data=cell_data)

    @classmethod
    def from_meshio(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh of the triangles, quads and polygons of a `meshio.Mesh`, with its data of points and cells. Other
        cells are left out, with a warning."""
        blocks = [(i, b) for i, b in enumerate(other.cells) if b.type in ("triangle", "quad", "polygon")]
        left = sorted({b.type for b in other.cells} - {b.type for _, b in blocks})
        if left:
            warnings.warn(f"not kept from meshio: cells of type {', '.join(left)}", stacklevel=2)
        starts: list[int] = [0]
        corners: list[int] = []
        for _, block in blocks:
            for cell in block.data:
                corners.extend(int(v) for v in cell)
                starts.append(len(corners))
        points = np.asarray(other.points, float)
        if points.ndim == 2 and points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        mesh: Any = cls.from_arrays(points, corners, face_starts=starts, name=name)  # type: ignore[attr-defined]
        mesh = cls._with(mesh, "vertex", other.point_data.items(), "meshio")
        cell_data = [(n, np.concatenate([np.asarray(d[i]) for i, _ in blocks])) for n, d in other.cell_data.items() if blocks]
        return cls._with(mesh, "face", cell_data, "meshio")  # type: ignore[no-any-return]

    # ---- pyvista

    def to_pyvista(self) -> Any:
        """Returns a `pyvista.PolyData` with the attributes of vertices and faces."""
        mesh = self._mesh()
        pyvista = module("pyvista")
        starts = mesh.face_starts.astype(np.int64)
        cells = np.insert(mesh.corners.astype(np.int64), starts[:-1], np.diff(starts))
        data = pyvista.PolyData(np.array(mesh.vertices), faces=cells)
        other = []
        for domain, name, values in mesh.attributes.items_by_domain():
            if domain == "vertex":
                data.point_data[name] = plain(values)
            elif domain == "face":
                data.cell_data[name] = plain(values)
            else:
                other.append(f"{domain} {name}")
        left_out("pyvista", other)
        return data

    @classmethod
    def from_pyvista(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh of the faces of a `pyvista.PolyData`, with its data of points and cells."""
        surface = other if hasattr(other, "faces") else other.extract_surface()
        cells = np.asarray(surface.faces)
        starts, corners, i = [0], [], 0
        while i < len(cells):
            n = int(cells[i])
            corners.append(cells[i + 1 : i + 1 + n])
            starts.append(starts[-1] + n)
            i += n + 1
        flat = np.concatenate(corners) if corners else np.zeros(0, np.int64)
        mesh: Any = cls.from_arrays(surface.points, flat, face_starts=starts, name=name)  # type: ignore[attr-defined]
        mesh = cls._with(mesh, "vertex", surface.point_data.items(), "pyvista")
        return cls._with(mesh, "face", surface.cell_data.items(), "pyvista")  # type: ignore[no-any-return]

    # ---- Open3D

    def to_open3d(self) -> Any:
        """Returns an `open3d.t.geometry.TriangleMesh` with the attributes of vertices and faces. Faces must be
        triangles."""
        mesh = self._mesh()
        o3d = module("open3d")
        made = o3d.t.geometry.TriangleMesh()
        made.vertex.positions = o3d.core.Tensor(np.array(mesh.vertices))
        made.triangle.indices = o3d.core.Tensor(mesh.triangles.astype(np.int64))
        other = []
        for domain, name, values in mesh.attributes.items_by_domain():
            if domain in ("vertex", "face"):
                target = made.vertex if domain == "vertex" else made.triangle
                own = {"normal": "normals", "color": "colors"}.get(name, name)
                array = plain(values)
                target[own] = o3d.core.Tensor(array[:, :3].copy() if own == "colors" else array)
            else:
                other.append(f"{domain} {name}")
        left_out("Open3D", other)
        return made

    @classmethod
    def from_open3d(cls, other: Any, *, name: str = "mesh") -> Self:
        """Makes a mesh of an Open3D triangle mesh, with its attributes of vertices and triangles."""
        if hasattr(other, "vertices"):
            other = module("open3d").t.geometry.TriangleMesh.from_legacy(other)
        own = {"normals": "normal", "colors": "color"}

        def columns(table: Any, skipped: str) -> list[tuple[str, Any]]:
            found = [(own.get(n, n), table[n].numpy()) for n in list(table) if n != skipped]
            return [(n, np.column_stack([v, np.ones(len(v))]) if n == "color" and v.shape[1] == 3 else v) for n, v in found]

        mesh: Any = cls.from_arrays(  # type: ignore[attr-defined]
            other.vertex.positions.numpy(), other.triangle.indices.numpy(), name=name
        )
        mesh = cls._with(mesh, "vertex", columns(other.vertex, "positions"), "Open3D")
        return cls._with(mesh, "face", columns(other.triangle, "indices"), "Open3D")  # type: ignore[no-any-return]
