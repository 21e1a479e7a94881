"""Conversions to and from other packages, and matrices."""

import warnings
from typing import Any

import numpy as np
import pytest

import meshwright as mw


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
