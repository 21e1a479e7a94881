"""The interactive viewer of notebooks."""

from __future__ import annotations

import base64
import html
import json
import os
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._ron import Choice, color_by

if TYPE_CHECKING:
    from ._mesh import Mesh

#: Colors from the lowest to the highest value: a part of matplotlib's map "viridis".
COLORS = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], float)

PAGE = """<!DOCTYPE html><html><head><meta charset="utf-8"><style>html, body, #view { margin: 0; height: 100%%; overflow: hidden; }
</style></head><body><div id="view" style="position: relative"></div><script>%s</script>
<script>meshwright.show(document.getElementById("view"), %s);</script></body></html>"""


@cache
def script() -> str:
    """Returns a script that contains the viewer and three.js."""
    return (files("meshwright") / "_static" / "viewer.js").read_text(encoding="utf-8")


def encoded(array: NDArray[Any], dtype: str) -> str:
    """Encodes the bytes of an array as base64."""
    return base64.b64encode(np.ascontiguousarray(array, dtype)).decode("ascii")


#: The name of a temporary attribute, which holds the values that the view shows.
SHOWN = "values of the view"
Values = tuple[Literal["vertex", "face"], NDArray[Any]]


def quantity(mesh: Mesh, of: str | Choice) -> Values:
    """Returns the values of a quantity or an attribute, and whether the values belong to the vertices or to the faces.
    Vectors are replaced by their lengths."""
    if isinstance(of, Choice) and of.name == "Attribute":
        name, component = of.fields["name"], of.fields.get("component")
        domain = mesh.attributes.domain(name)
        if domain not in ("vertex", "face"):
            raise ValueError(f'the domain of the attribute "{name}" is {domain}, expected vertex or face')
        values = mesh.attributes[domain, name]
        if component is not None:
            values = values[:, component]
        return domain, values.astype(float) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    if of == "Valence":
        return "vertex", np.bincount(mesh.edges.reshape(-1), minlength=mesh.n_vertices).astype(float)
    if isinstance(of, Choice) or of == "DihedralAngle":
        expected = "expected an attribute or a quantity of vertices or faces"
        raise ValueError(f"a view cannot show {of}: {expected}; picture() shows more")
    at: Literal["vertex", "face"] = "face" if of in ("Area", "MinAngle") else "vertex"
    return at, mesh.measure(of=Choice(of), name=SHOWN).attributes[at, SHOWN]


def colors_of(numbers: NDArray[Any], span: tuple[float, float] | None = None) -> tuple[NDArray[np.uint8], str]:
    """Returns a color for each number, and a text with the lowest and the highest value of the color scale."""
    if not len(numbers):
        return np.zeros((0, 3), np.uint8), "no values"
    low, high = span or (float(numbers.min()), float(numbers.max()))
    part = (numbers - low) / (high - low) if high > low else np.zeros(len(numbers))
    at = np.linspace(0, 1, len(COLORS))
    channels = [np.interp(part, at, COLORS[:, i]) for i in range(3)]
    return np.round(np.column_stack(channels)).astype(np.uint8), f"{low:.6g} to {high:.6g}"


class View:
    """An interactive view of a mesh. A view that is the result of a notebook cell is shown in the notebook.
    :meth:`save` writes the view as an HTML page. The page contains the mesh and three.js, and needs no network."""

    def __init__(self, mesh: Mesh, shown: str | Choice | Mapping[str, Any] | None, wireframe: bool | None, height: int) -> None:
        self._height = height
        caption, domain, values, given = repr(mesh), "", None, {}
        pieces = mesh
        if shown is not None:
            given = color_by(shown)
            unknown = sorted(set(given) - {"of", "range"})
            if unknown:
                raise ValueError(f'color_by has the key "{unknown[0]}", expected "of" or "range"; picture() takes more keys')
            domain, values = quantity(mesh, given["of"])
            if domain == "face":
                pieces = mesh.with_attribute(SHOWN, values, "face")
        if (np.diff(mesh.face_starts) != 3).any():
            pieces = pieces.triangulate()
        # The center of the mesh is moved to the origin, because 32-bit floats are most precise there.
        center = mesh.vertices.mean(axis=0) if mesh.n_vertices else np.zeros(3)
        points, triangles, colors = mesh.vertices - center, pieces.triangles, None
        if values is not None:
            values = pieces.attributes["face", SHOWN] if domain == "face" else values
            colors, span = colors_of(values, given.get("range"))
            of = given["of"]
            caption += f", {of.fields['name'] if isinstance(of, Choice) else of}: {span}"
            if domain == "face":
                # Neighboring triangles can have different colors, so each triangle gets three separate points. In the
                # array, these points come after the vertices of the mesh. The edges still use the vertices.
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
        """Returns the view as an HTML page."""
        return PAGE % (script(), json.dumps(self._data).replace("<", "\\u003c"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the view to a file, as an HTML page."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_html())

    def _repr_html_(self) -> str:
        page = html.escape(self.to_html())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {self._height}px; border: 0"></iframe>'
