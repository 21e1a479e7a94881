"""Meshwright: a mesh editor driven by recipes.

>>> import meshwright as mw
>>> m = mw.Scene().icosahedron(name="ball").mesh()
>>> m = m.weld(distance=1e-6).loop_subdivide(levels=2)
>>> m.vertices.shape, m.triangles.shape
((162, 3), (320, 3))
>>> m.measure(of="MeanCurvature", name="curvature").attributes["curvature"].shape
(162,)

:func:`read` reads a file as a :class:`Scene`, whose meshes are :class:`Mesh`. Every operation is a method of both, and a
step of a :class:`Recipe`. :mod:`meshwright.sel` has the selections of vertices, edges and faces.
"""

from . import choice, expect, matrices, sel
from ._batch import Report, Row, batch
from ._core import __version__
from ._editor import Editor
from ._errors import EditError, Error, LossWarning, Problem, RecipeError
from ._mesh import Attributes, HalfEdges, Mesh
from ._recipe import Outcome, Parameter, Recipe, Step, arg, recipe, run
from ._ron import Arg, Choice, Ron
from ._scene import Scene, read, read_bytes

__all__ = [
    "Arg",
    "Attributes",
    "Choice",
    "EditError",
    "Editor",
    "Error",
    "HalfEdges",
    "LossWarning",
    "Mesh",
    "Outcome",
    "Parameter",
    "Problem",
    "Recipe",
    "RecipeError",
    "Report",
    "Ron",
    "Row",
    "Scene",
    "Step",
    "__version__",
    "arg",
    "batch",
    "choice",
    "expect",
    "matrices",
    "read",
    "read_bytes",
    "recipe",
    "run",
    "sel",
]
