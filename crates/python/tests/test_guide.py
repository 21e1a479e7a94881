"""The guide in the documentation of the package."""

import pydoc
from pathlib import Path

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice, expect, sel


def rows() -> list[tuple[str, str]]:
    table = (mw.__doc__ or "").split("If you know trimesh:\n\n")[1].split("\n\n")[0].splitlines()
    n = table[1].rindex("  -") + 2
    return [(row[:n].strip(), row[n:].strip()) for row in table[2:]]


@pytest.mark.parametrize(("theirs", "ours"), rows(), ids=[theirs for theirs, _ in rows()])
def test_the_table_for_users_of_trimesh(theirs: str, ours: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ball = mw.Scene().icosahedron(name="ball").mesh().loop_subdivide(levels=2)
    far = mw.Scene().octahedron(name="far", center=(5, 0, 0)).mesh()
    m = mw.Scene().with_object(ball).with_object(far).join(["ball", "far"], "both", tag_parts=False).mesh()
    monkeypatch.chdir(tmp_path)
    m.save("a.obj")
    names = {
        **{"mw": mw, "np": np, "sel": sel, "choice": choice, "m": m, "a": ball, "b": far},
        **{"vertices": m.vertices, "faces": m.triangles, "matrix": np.eye(4), "mask": m.face_normals[:, 2] > 0},
        "p": mw.Mesh.from_arrays([[0, 0, 0], [9, 0, 0]], []),
    }
    value = eval(ours, names)
    if "separate" in ours and "max" in ours:
        assert value.n_faces == 320
    if theirs == "mesh.split()":
        assert [part.n_faces for part in value] == [320, 8]
    if "face 0" in theirs:
        assert value == ball or value.n_faces == 320
    if "contains" in theirs:
        assert value.tolist() == [0]
    if "signed" in theirs:
        assert value[0] < 0 < value[1]
    if "update_faces" in theirs:
        assert value.n_faces == names["mask"].sum()
    if "slice" in theirs:
        assert value.bounds[0, 2] >= 0 and value.bounds[1, 2] == m.bounds[1, 2]
    assert value is not None


def test_the_help_can_be_read() -> None:
    text = pydoc.render_doc(mw, renderer=pydoc.plaintext)
    assert len(text.splitlines()) < 160
    for name in ("choice", "sel", "LossWarning", "from_trimesh"):
        assert name in text
    assert "add_note" not in text and "add_note" in pydoc.render_doc(mw.errors, renderer=pydoc.plaintext)
    for name in ("Mesh", "Scene", "Recipe", "batch", "arg", "Arg", "Ron", "Outcome", "LossWarning"):
        assert hasattr(mw, name)


def test_the_modules_list_only_their_values() -> None:
    for module in (sel, choice, expect):
        assert dir(module) == sorted(dir(module)) and not {"Any", "Choice", "Literal", "NDArray"} & set(dir(module))
        for name in dir(module):
            assert isinstance(getattr(module, name), mw.Choice) or callable(getattr(module, name)), name
    assert "Sharp" in dir(sel) and "Taubin" in dir(choice) and "Faces" in dir(expect)
    assert "numpy.quantile" in (sel.Where.__doc__ or "")
