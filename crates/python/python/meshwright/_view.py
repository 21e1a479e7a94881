"""The interactive viewer of notebooks."""

from __future__ import annotations

import base64
import html
import json
import os
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._mesh import Mesh

#: Colors from the lowest to the highest value: a part of matplotlib's map "viridis".
COLORS = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], float)

PAGE = """<!DOCTYPE html><html><head><meta charset="utf-8"><style>html, body, #view { margin: 0; height: 100%%; overflow: hidden; }
</style></head><body><div id="view" style="position: relative"></div><script>%s</script>
<script>meshwright.show(document.getElementById("view"), %s);</script></body></html>"""


@cache
def script() -> str:
    """The viewer with three.js in one script."""
    return (files("meshwright") / "_static" / "viewer.js").read_text(encoding="utf-8")


def encoded(array: NDArray[Any], dtype: str) -> str:
    """The bytes of an array as text."""
    return base64.b64encode(np.ascontiguousarray(array, dtype)).decode("ascii")


def colors_of(values: NDArray[Any]) -> tuple[NDArray[np.uint8], str]:
    """A color for each value, and the range of the values in words. If the values are vectors, their lengths are
    used."""
    numbers = values.astype(float) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    if not len(numbers):
        return np.zeros((0, 3), np.uint8), "no values"
    low, high = float(numbers.min()), float(numbers.max())
    part = (numbers - low) / (high - low) if high > low else np.zeros(len(numbers))
    at = np.linspace(0, 1, len(COLORS))
    channels = [np.interp(part, at, COLORS[:, i]) for i in range(3)]
    return np.round(np.column_stack(channels)).astype(np.uint8), f"{low:.6g} to {high:.6g}"


class View:
    """An interactive view of a mesh. A notebook shows it at the end of a cell; :meth:`save` writes it as a page. The page
    contains the mesh and three.js, and needs no network."""

    def __init__(self, mesh: Mesh, color_by: str | None, wireframe: bool | None, height: int) -> None:
        self._height = height
        pieces = mesh.triangulate() if (np.diff(mesh.face_starts) != 3).any() else mesh
        # The mesh is moved to the origin, because 32-bit floats are precise only there.
        center = mesh.vertices.mean(axis=0) if mesh.n_vertices else np.zeros(3)
        points, triangles = mesh.vertices - center, pieces.triangles
        caption, colors = repr(mesh), None
        if color_by is not None:
            domain = mesh.attributes.domain(color_by)
            if domain not in ("vertex", "face"):
                raise ValueError(f'"{color_by}" is an attribute of a {domain}, expected one of vertices or faces')
            source = mesh if domain == "vertex" else pieces
            colors, span = colors_of(source.attributes[domain, color_by])
            caption += f", {color_by}: {span}"
            if domain == "face":
                # Each triangle gets three points of its own. These points follow the vertices, to which the edges
                # refer.
                points = np.concatenate([points, points[triangles.reshape(-1)]])
                colors = np.concatenate([np.zeros((mesh.n_vertices, 3), np.uint8), np.repeat(colors, 3, axis=0)])
                triangles = (mesh.n_vertices + np.arange(3 * len(triangles), dtype=np.uint32)).reshape(-1, 3)
        self._data = {
            "positions": encoded(points, "<f4"),
            "triangles": encoded(triangles, "<u4"),
            "edges": encoded(mesh.edges, "<u4"),
            "caption": caption,
            "wireframe": mesh.n_faces <= 20_000 if wireframe is None else wireframe,
        }
        if colors is not None:
            self._data["colors"] = encoded(colors, "u1")

    def to_html(self) -> str:
        """Returns the page."""
        return PAGE % (script(), json.dumps(self._data).replace("<", "\\u003c"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_html())

    def _repr_html_(self) -> str:
        page = html.escape(self.to_html())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {self._height}px; border: 0"></iframe>'
