"""Conversions to and from other packages, and matrices."""

import warnings
from typing import Any

import numpy as np
import pytest

import meshwright as mw
from meshwright import sel


@pytest.fixture
def model() -> mw.Mesh:
    m = mw.Scene().torus(name="ring").mesh().triangulate()
    m = m.with_attribute("heat", np.linspace(0, 1, m.n_vertices))
    return m.with_attribute("part", np.arange(m.n_faces) % 3, "face")


@pytest.mark.parametrize("package", ["trimesh", "meshio", "pyvista", "open3d"])
def test_there_and_back(package: str, model: mw.Mesh) -> None:
    pytest.importorskip(package, exc_type=ImportError)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        again = getattr(mw.Mesh, f"from_{package}")(getattr(model, f"to_{package}")())
    assert np.allclose(again.vertices, model.vertices)
    assert (again.triangles == model.triangles).all()
    assert np.allclose(again.attributes["heat"], model.attributes["heat"])
    assert (again.attributes["part"] == model.attributes["part"]).all()


POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]], float)
FACES = np.array([[0, 1, 2], [0, 0, 1], [1, 0, 3], [0, 1, 4]])


@pytest.mark.parametrize("package", ["trimesh", "meshio", "pyvista", "open3d"])
def test_repairs_keep_the_attributes_of_the_other_elements(package: str) -> None:
    """The data have an edge with three faces, and an invalid face. The repair splits the edge and drops the face."""
    pytest.importorskip(package, exc_type=ImportError)
    heat, part = np.arange(5.0), np.array([10, 11, 12, 13])
    other: Any
    if package == "trimesh":
        import trimesh

        other = trimesh.Trimesh(POINTS, FACES, vertex_attributes={"heat": heat}, face_attributes={"part": part}, process=False)
    elif package == "meshio":
        import meshio

        other = meshio.Mesh(POINTS, [("triangle", FACES)], point_data={"heat": heat}, cell_data={"part": [part]})
    elif package == "pyvista":
        import pyvista

        other = pyvista.PolyData(POINTS, faces=np.column_stack([np.full(4, 3), FACES]))
        other.point_data["heat"], other.cell_data["part"] = heat, part
    else:
        import open3d

        other = open3d.t.geometry.TriangleMesh(open3d.core.Tensor(POINTS), open3d.core.Tensor(FACES))
        other.vertex["heat"], other.triangle["part"] = open3d.core.Tensor(heat), open3d.core.Tensor(part)
    m = getattr(mw.Mesh, f"from_{package}")(other)
    assert m.n_vertices > 5 and m.attributes["part"].tolist() == [10, 12, 13]
    assert any("split" in note for note in m.notes) and any("dropped" in note for note in m.notes)
    original = m.attributes["heat"].astype(int)
    assert (POINTS[original] == m.vertices).all()


def test_trimesh_texture_coordinates(model: mw.Mesh) -> None:
    pytest.importorskip("trimesh")
    smooth = model.with_attribute("uv", model.vertices[model.corners][:, :2], "corner")
    other = smooth.to_trimesh()
    assert (other.visual.uv == model.vertices[:, :2]).all() and len(other.vertices) == model.n_vertices
    assert (mw.Mesh.from_trimesh(other).attributes["corner", "uv"] == smooth.attributes["corner", "uv"]).all()
    # The first 9 faces now have other texture coordinates, so there is a seam around them.
    uv = np.array(smooth.attributes["corner", "uv"])
    uv[:27] += 10
    with pytest.warns(UserWarning, match="copies of vertices were made"):
        other = smooth.with_attribute("uv", uv, "corner").to_trimesh()
    assert (other.visual.uv[other.faces].reshape(-1, 2) == uv).all()
    assert (other.vertices[other.faces] == model.vertices[model.triangles]).all()
    assert (other.vertex_attributes["heat"][other.faces] == model.attributes["heat"][model.triangles]).all()
    assert (mw.Mesh.from_trimesh(other).attributes["corner", "uv"] == uv).all()


def test_trimesh_colors(model: mw.Mesh) -> None:
    trimesh: Any = pytest.importorskip("trimesh")
    colors = np.arange(4 * model.n_vertices).reshape(-1, 4).astype(np.uint8)
    other = trimesh.Trimesh(model.vertices, model.triangles, vertex_colors=colors, process=False)
    m = mw.Mesh.from_trimesh(other)
    assert np.allclose(m.attributes["vertex", "color"] * 255, colors)
    assert (m.to_trimesh().visual.vertex_colors == colors).all()
    faces = trimesh.Trimesh(model.vertices, model.triangles, face_colors=[255, 0, 0, 255], process=False)
    assert (mw.Mesh.from_trimesh(faces).attributes["face", "color"] == [1, 0, 0, 1]).all()


def test_mixed_polygons_survive(box: mw.Mesh) -> None:
    mixed = box.triangulate(faces=sel.Faces([0, 2]))
    mixed = mixed.with_attribute("part", np.arange(mixed.n_faces), "face")
    for package in ("meshio", "pyvista"):
        pytest.importorskip(package)
        again = getattr(mw.Mesh, f"from_{package}")(getattr(mixed, f"to_{package}")())
        faces = {tuple(again.faces[i]): int(part) for i, part in enumerate(again.attributes["part"])}
        assert faces == {tuple(face): i for i, face in enumerate(mixed.faces)}


def test_polygons_survive_meshio(box: mw.Mesh) -> None:
    pytest.importorskip("meshio")
    again = mw.Mesh.from_meshio(box.to_meshio())
    assert (again.corners == box.corners).all()


def test_trimesh_agrees_about_area_and_volume(model: mw.Mesh) -> None:
    trimesh: Any = pytest.importorskip("trimesh")
    other = model.to_trimesh()
    assert isinstance(other, trimesh.Trimesh) and other.is_watertight
    assert np.isclose(mw.matrices.mass(model).sum(), other.area)
    before = model.vertices.copy()
    other.apply_scale(2)
    assert (model.vertices == before).all() and np.isclose(other.vertices.max(), 2 * before.max())


def test_what_cannot_be_kept_is_a_warning(model: mw.Mesh) -> None:
    pytest.importorskip("trimesh")
    with pytest.warns(UserWarning, match="edge sharp"):
        model.with_attribute("sharp", np.zeros(model.n_edges), "edge").to_trimesh()


def test_a_missing_package_is_named(model: mw.Mesh, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    with pytest.raises(ImportError, match="pip install trimesh"):
        model.to_trimesh()


def test_laplacian(model: mw.Mesh) -> None:
    pytest.importorskip("scipy")
    matrix, mass = mw.matrices.laplacian(model), mw.matrices.mass(model)
    assert abs(matrix - matrix.T).max() < 1e-12
    assert np.abs(matrix @ np.ones(model.n_vertices)).max() < 1e-9
    corners = model.vertices[model.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    assert np.isclose(mass.sum(), area)
    # The Dirichlet energy of the coordinates is twice the area.
    energy = np.einsum("ij,ij->", model.vertices, matrix @ model.vertices)
    assert np.isclose(energy, 2 * area)


def test_subdivision_matrices(model: mw.Mesh) -> None:
    pytest.importorskip("scipy")
    for scheme, refined in (("loop", model.loop_subdivide(levels=2)), ("butterfly", model.butterfly(levels=2)), ("sqrt3", model.sqrt3(levels=2))):
        matrix = mw.matrices.subdivision(model, scheme, levels=2)  # type: ignore[arg-type]
        assert np.allclose(matrix @ model.vertices, refined.vertices)
        assert np.allclose(matrix @ np.ones(model.n_vertices), 1)
