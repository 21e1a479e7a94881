"""Meshes that several tests use."""

import pytest

import meshwright as mw


@pytest.fixture
def ball() -> mw.Mesh:
    return mw.Scene().icosahedron(name="ball").mesh()


@pytest.fixture
def box() -> mw.Mesh:
    return mw.Scene().cube(name="box").mesh()
