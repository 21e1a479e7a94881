"""Invalid arrays raise exceptions, and never end the process."""

import warnings
from typing import Any

import numpy as np
import pytest

import meshwright as mw

ALLOWED = (ValueError, TypeError, OverflowError, mw.Error)
DTYPES = ["f8", "f4", "f2", "i8", "i4", "i2", "i1", "u8", "u4", "u1", "?", "c16", "U3", "O", "M8[s]", ">f8", ">u4"]


def random_array(rng: np.random.Generator, is_index: bool) -> Any:
    kind = str(rng.choice(DTYPES))
    shape = tuple(rng.integers(0, 6, rng.integers(0, 4)))
    if rng.random() < 0.6:
        shape = (int(rng.integers(0, 12)), int(rng.choice([3, 3, 3, 4, 2])))
        kind = str(rng.choice(["u4", "i8", "i4"] if is_index else ["f8", "f4", "i4"]))
    numbers = rng.integers(-2, 14, shape) if rng.random() < 0.3 else rng.integers(0, 8, shape)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            array = np.asarray(numbers).astype(kind)
        except (TypeError, ValueError):
            array = np.asarray(numbers)
    change = rng.integers(0, 9)
    if array.size and array.dtype.kind == "f" and change == 0:
        array.flat[rng.integers(array.size)] = rng.choice([np.nan, np.inf, -np.inf])
    if array.size and array.dtype.kind in "iu" and array.dtype.itemsize >= 4 and change == 1:
        array.flat[rng.integers(array.size)] = np.iinfo(array.dtype).max
    if change == 2:
        array = np.asfortranarray(array)
    if change == 3 and array.ndim:
        array = array[::2]
    if change == 4 and array.ndim:
        array = array[::-1]
    if change == 5:
        array.flags.writeable = False
    if change == 6:
        return array.tolist()
    if change == 7 and array.ndim > 1:
        array = np.broadcast_to(array[:1], array.shape)
    return array


def test_ten_thousand_random_arrays() -> None:
    rng = np.random.default_rng(2026)
    made = 0
    for _ in range(10_000):
        vertices, faces = random_array(rng, False), random_array(rng, True)
        starts = random_array(rng, True) if rng.random() < 0.2 else None
        try:
            m = mw.Mesh.from_arrays(vertices, faces, face_starts=starts, repair=bool(rng.random() < 0.8))
        except ALLOWED:
            continue
        assert m.defects() == []
        made += 1
        values = random_array(rng, False)
        domain = str(rng.choice(["vertex", "corner", "edge", "face", "other"]))
        try:
            m = m.with_attribute("x", values, domain)  # type: ignore[arg-type]
            assert np.isfinite(m.attributes["x"]).all()
        except ALLOWED:
            pass
        try:
            m.with_vertices(values)
        except ALLOWED:
            pass
    assert made > 500


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        (np.zeros((3, 2)), [[0, 1, 2]], r"vertices have the shape \(3, 2\)"),
        (np.full((3, 3), np.nan), [[0, 1, 2]], "vertex 0 is not finite"),
        (np.eye(3), [[0, 1, 3]], "vertex 3, but there are 3 vertices, numbered from 0"),
        (np.eye(3), [[0, 1, -1]], "faces contain -1"),
        (np.eye(3), [[0, 1, 2**40]], "faces contain 1099511627776"),
        (np.eye(3), [[0.0, 1.0, 2.0]], "expected whole numbers"),
        (np.eye(3), [0, 1, 2], "lists of vertices"),
        ([["a", "b", "c"]], [], "expected numbers"),
    ],
)
def test_messages(vertices: Any, faces: Any, message: str) -> None:
    with pytest.raises((ValueError, TypeError), match=message):
        mw.Mesh.from_arrays(vertices, faces)


def test_layouts_give_the_same_mesh() -> None:
    points, faces = np.random.default_rng(1).random((4, 3)), np.array([[0, 1, 2], [0, 2, 3]])
    expected = mw.Mesh.from_arrays(points, faces)
    wide = np.zeros((8, 6))
    wide[::2, ::2] = points
    for other in (np.asfortranarray(points), wide[::2, ::2], points.astype(">f8"), points.tolist()):
        assert mw.Mesh.from_arrays(other, faces.astype("i2")) == expected
