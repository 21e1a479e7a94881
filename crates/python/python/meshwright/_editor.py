"""Edits of single elements."""

from __future__ import annotations

from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Self

from . import _core

if TYPE_CHECKING:
    from ._mesh import Mesh


class Editor:
    """Edits of single elements, on a copy of a mesh. Each edit is checked first: a refused edit raises
    :class:`meshwright.EditError` and changes nothing. Ids of elements stay valid until the end of the `with` block.
    Then elements get new ids, so that removed elements leave no gaps."""

    def __init__(self, mesh: Mesh) -> None:
        self._original = mesh
        self._core = _core.Editor(mesh._core)
        self._mesh: Mesh | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self._mesh = self._original._with_core(self._core.mesh(), "edit()")

    @property
    def mesh(self) -> Mesh:
        """After the `with` block: the edited mesh. Inside the block: the mesh with the edits made so far."""
        return self._mesh or self._original._with_core(self._core.mesh(), "edit()")

    def edge(self, v: int, w: int) -> int:
        """Returns the edge between two vertices. Raises `KeyError` if there is none."""
        found = self._core.edge(int(v), int(w))
        if found is None:
            raise KeyError(f"no edge joins the vertices {v} and {w}")
        return found

    def edge_vertices(self, edge: int) -> tuple[int, int]:
        """Returns the two vertices of an edge."""
        v, w = self._core.edge_vertices(edge)
        return v, w

    def face_vertices(self, face: int) -> list[int]:
        """Returns the vertices of a face, counter-clockwise."""
        return self._core.face_vertices(face)

    def flip(self, edge: int) -> None:
        """Rotates the edge between two faces, so that each end moves to the next corner. Ids stay the same."""
        self._core.flip(edge)

    def split(self, edge: int, at: float = 0.5) -> int:
        """Inserts a vertex on an edge. If a face of the edge is a triangle, this triangle is cut in two, from the new
        vertex to the opposite corner. Returns the vertex.

        :param at: The position along the edge, strictly between 0 (the first of its :meth:`edge_vertices`) and 1.
        """
        return self._core.split(edge, at)

    def collapse(self, edge: int, at: float = 0.5) -> int:
        """Merges both ends of an edge into one vertex. Returns the vertex that remains.

        :param at: The position along the edge, from 0 (the first of its :meth:`edge_vertices`) to 1.
        """
        return self._core.collapse(edge, at)

    def dissolve_edge(self, edge: int) -> int:
        """Removes an edge and merges its two faces. Returns the face that remains."""
        return self._core.dissolve_edge(edge)

    def dissolve_vertex(self, vertex: int) -> int:
        """Removes a vertex and merges the faces around it. Returns the face that remains."""
        return self._core.dissolve_vertex(vertex)

    def connect(self, v: int, w: int) -> int:
        """Cuts a face in two by an edge between two of its vertices. Returns the new edge."""
        return self._core.connect(v, w)

    def poke(self, face: int) -> int:
        """Inserts a vertex at the center of a face, and connects it to each corner by an edge. Returns the vertex."""
        return self._core.poke(face)

    def inset(self, face: int, fraction: float) -> list[int]:
        """Shrinks a face, and fills the space around it with a ring of faces. Returns the new faces.

        :param fraction: How far each corner moves toward the center, strictly between 0 and 1.
        """
        return self._core.inset(face, fraction)

    def extrude(self, faces: Sequence[int], offset: Sequence[float]) -> list[int]:
        """Moves faces by an offset and adds side faces. Returns the side faces."""
        x, y, z = offset
        return self._core.extrude(list(faces), (x, y, z))

    def delete(self, faces: Sequence[int]) -> None:
        """Deletes faces, which leaves holes. If the edit is refused, no face is deleted."""
        self._core.delete(list(faces))

    def fill_hole(self, half_edge: int) -> int:
        """Fills the hole beside a boundary half-edge with one face. Returns the face."""
        return self._core.fill_hole(half_edge)

    def move(self, vertex: int, position: Sequence[float]) -> None:
        """Moves a vertex to a position."""
        x, y, z = position
        self._core.move(vertex, (x, y, z))
