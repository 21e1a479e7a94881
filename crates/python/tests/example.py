"""The examples of the documentation in one file. The type checker checks the file, and a test runs it."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import meshwright as mw
from meshwright import choice, expect, sel


def edit(path: Path) -> mw.Mesh:
    m = mw.read(path).mesh()
    m = m.weld(distance=1e-6).triangulate().loop_subdivide(levels=2)
    m = m.measure(of="MeanCurvature", name="curvature")
    curvature: NDArray[np.float64] = m.attributes["curvature"]
    m = m.with_attribute("bent", np.abs(curvature) > 1.0, "vertex")
    m = m.smooth(choice.Laplacian(), vertices=sel.Tagged("bent"))
    again: mw.Recipe = mw.read(path).mesh().weld(distance=1e-6).recipe()
    distance: float = m.distance_to(again.run().mesh()).largest
    print(distance)
    with m.edit() as e:
        try:
            e.flip(e.edge(*m.edges[0]))
        except mw.EditError as refused:
            print(refused.reason, refused.elements)
    return e.mesh


def recipe() -> mw.Recipe:
    return (
        mw.recipe()
        .load(mw.arg("input", default=Path("a.obj")))
        .triangulate()
        .flip_edges(edges=sel.Random(count=24, seed=7), on_refusal="Skip")
        .loop_subdivide(levels=mw.arg("levels", int, default=2))
        .save("a.glb")
        .picture("a.png", camera=choice.Fit(up="Z"))
        .expect("Manifold", expect.Faces(min=100))
    )


def run(path: Path, out: Path) -> str:
    try:
        outcome = recipe().run(input=path, levels=1, out=out, progress=lambda step, task, done, total: None)
    except mw.RecipeError as error:
        for problem in error.problems:
            print(problem.file, problem.line, problem.column, problem.message, problem.help)
        raise
    mesh: mw.Mesh = outcome.mesh()
    assert mesh.n_faces and outcome.steps[-1].faces
    return outcome.digest
