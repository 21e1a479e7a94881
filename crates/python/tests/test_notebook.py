"""The interactive view, and notebooks."""

import base64
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwright as mw
from meshwright import choice

NOTEBOOK = Path(__file__).resolve().parents[1] / "examples" / "curvature.ipynb"


def data(view: object) -> dict[str, str]:
    (text,) = re.findall(r'meshwright\.show\(document\.getElementById\("view"\), (\{.*\})\);', view.to_html())  # type: ignore[attr-defined]
    found: dict[str, str] = json.loads(text)
    return found


def test_a_view_has_the_mesh(box: mw.Mesh) -> None:
    found = data(box.with_attribute("part", np.arange(6), "face").view(color_by="part"))
    points = np.frombuffer(base64.b64decode(found["positions"]), "<f4").reshape(-1, 3)
    triangles = np.frombuffer(base64.b64decode(found["triangles"]), "<u4").reshape(-1, 3)
    colors = np.frombuffer(base64.b64decode(found["colors"]), "u1").reshape(-1, 3)
    assert len(points) == 8 + 36 == len(colors) and triangles.tolist()[0] == [8, 9, 10]
    assert (colors[8:14] == [68, 1, 84]).all() and (colors[-6:] == [253, 231, 37]).all()
    assert len(base64.b64decode(found["edges"])) == 12 * 2 * 4
    by_vertex = data(box.with_attribute("x", box.vertices[:, 0], "vertex").view(color_by="x"))
    assert len(base64.b64decode(by_vertex["colors"])) == 8 * 3


def test_a_picture_and_a_view_show_the_same_quantities(box: mw.Mesh, tmp_path: Path) -> None:
    m = box.with_attribute("heat", box.vertices, "vertex").with_attribute("part", np.arange(6), "face")
    shown: list[tuple[Any, int]] = [
        ("heat", 8),
        ("part", 44),
        (choice.Attribute(name="heat", component=1), 8),
        ({"of": "part", "range": (0, 3)}, 44),
        ("MeanCurvature", 8),
        ("Valence", 8),
        ("Area", 44),
    ]
    for color_by, n in shown:
        m.picture(tmp_path / "a.png", size=(64, 48), color_by=color_by)
        assert m.render(size=(64, 48), color_by=color_by)[:4] == b"\x89PNG"
        assert len(base64.b64decode(data(m.view(color_by=color_by))["colors"])) == 3 * n, color_by
    assert 'color_by: (of: Attribute(name: "heat"))' in mw.recipe().picture("a.png", color_by="heat").to_ron()
    assert "color_by: (of: Area)" in mw.recipe().picture("a.png", color_by="Area").to_ron()
    m.picture(tmp_path / "a.png", size=(64, 48), color_by={"of": "DihedralAngle", "legend": False})
    for wrong in ("DihedralAngle", {"of": "Area", "legend": False}, choice.DistanceTo("a.obj")):
        with pytest.raises(ValueError, match="picture"):
            m.view(color_by=wrong)  # type: ignore[arg-type]


def test_names_cannot_end_the_script(box: mw.Mesh) -> None:
    evil = box.with_attribute("</script><b>", np.zeros(8), "vertex").view(color_by="</script><b>")
    assert "</script><b>" not in evil.to_html()
    assert evil._repr_html_().count("<") == 2


def test_a_view_needs_no_network(box: mw.Mesh, tmp_path: Path) -> None:
    box.view().save(tmp_path / "a.html")
    page = (tmp_path / "a.html").read_text()
    assert not re.search(r'(src|href)="', page) and "import(" not in page and len(page) < 1_000_000
    with pytest.raises(ValueError, match="edge"):
        box.with_attribute("sharp", np.zeros(12), "edge").view(color_by="sharp")


def test_the_notebook_runs() -> None:
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    shown = {kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})}
    assert {"image/png", "text/html"} <= shown
