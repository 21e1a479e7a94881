"""Sparse matrices of meshes, as `scipy.sparse.csr_array`.

>>> import meshwright as mw
>>> import numpy as np
>>> ball = mw.Scene().icosahedron(name="ball").mesh()
>>> refine = mw.matrices.subdivision(ball, "loop", levels=1)
>>> np.allclose(refine @ ball.vertices, ball.loop_subdivide(levels=1).vertices)
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from ._arrays import view

if TYPE_CHECKING:
    from ._mesh import Mesh


def _sparse() -> Any:
    try:
        import scipy.sparse
    except ImportError as error:
        raise ImportError("matrices need SciPy: pip install scipy") from error
    return scipy.sparse


def _csr(starts: _core.Array, columns: _core.Array, values: _core.Array, n_columns: int) -> Any:
    indptr, indices = view(starts).astype(np.int64), view(columns).astype(np.int64)
    return _sparse().csr_array((view(values).copy(), indices, indptr), shape=(len(indptr) - 1, n_columns))


def laplacian(mesh: Mesh) -> Any:
    """Returns the cotangent Laplacian: a positive semidefinite matrix whose rows add up to 0. The entry of an edge is
    -1/2 times the sum of the cotangents of the opposite angles. Divided by the areas of :func:`mass`, the matrix
    approximates the negative Laplace operator.

    Faces with 4 to 16 corners have a virtual vertex at their center (Bunge, Herholz, Kazhdan, Botsch, "Polygon Laplacian
    Made Simple", 2020).
    """
    starts, columns, values, _ = _core.laplacian(mesh._core)
    return _csr(starts, columns, values, mesh.n_vertices)


def mass(mesh: Mesh) -> Any:
    """Returns the lumped mass matrix: a diagonal matrix whose entries are the areas that belong to the vertices."""
    areas = view(_core.laplacian(mesh._core)[3])
    return _sparse().diags_array(areas.copy(), format="csr")


def subdivision(
    mesh: Mesh, scheme: Literal["loop", "catmull_clark", "midpoint", "butterfly", "sqrt3"] = "loop", *, levels: int = 1
) -> Any:
    """Returns a matrix that maps values at the vertices of a mesh to values at the vertices of the subdivided mesh. The
    refined positions are ``subdivision(mesh) @ mesh.vertices``.

    :param mesh: The mesh.
    :param scheme: The subdivision scheme.
    :param levels: The number of levels.
    """
    if levels < 0 or levels > 16:
        raise ValueError(f"levels is {levels}, expected 0 to 16")
    starts, columns, values, n_columns = _core.subdivision(mesh._core, scheme, int(levels))
    return _csr(starts, columns, values, n_columns)
