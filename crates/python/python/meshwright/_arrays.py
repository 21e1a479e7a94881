"""Conversions between NumPy arrays and the arrays of the compiled module `_core`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

#: The largest id of an element.
MAX_ID = 2**32 - 2


def view(array: _core.Array) -> NDArray[Any]:
    """Returns a read-only NumPy array that shares the memory of `array`."""
    dtype = np.dtype(array.dtype)
    shape = (-1,) if array.columns == 1 else (-1, array.columns)
    if len(array) == 0:
        empty: NDArray[Any] = np.zeros(0 if array.columns == 1 else (0, array.columns), dtype)
        empty.flags.writeable = False
        return empty
    buffer: Any = array
    return np.frombuffer(buffer, dtype).reshape(shape)


def frozen(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """A read-only copy of an array. NumPy cannot make the copy writeable again."""
    return np.frombuffer(array.tobytes()).reshape(array.shape)


def numeric(values: ArrayLike, what: str) -> NDArray[Any]:
    """Converts values to an array of numbers. Raises a `TypeError` if they are not numbers."""
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{what} have the type {array.dtype}, expected numbers")
    return array


def points(values: ArrayLike, what: str = "vertices") -> NDArray[np.float64]:
    """Converts points to a contiguous `float64` array of shape (n, 3)."""
    array = numeric(values, what)
    if array.size == 0 and array.ndim <= 2:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{what} have the shape {array.shape}, expected (n, 3)")
    return np.ascontiguousarray(array, np.float64)


def indices(values: ArrayLike, what: str) -> NDArray[np.uint32]:
    """Converts whole numbers from 0 to 2^32 - 2 to a contiguous `uint32` array of the same shape."""
    array = numeric(values, what)
    if array.size == 0:
        return np.zeros(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{what} have the type {array.dtype}, expected whole numbers")
    low, high = int(array.min()), int(array.max())
    if low < 0 or high > MAX_ID:
        wrong = low if low < 0 else high
        raise ValueError(f"{what} contain {wrong}, expected numbers from 0 to 2^32 - 2")
    return np.ascontiguousarray(array, np.uint32)
