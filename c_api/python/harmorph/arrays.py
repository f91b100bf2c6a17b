"""Views of numpy arrays for the library, without a copy where the library can represent them.

Points are two numbers for each point of a mesh. Two forms are taken everywhere:

- one array of shape (n, 2), whose columns are x and y;
- a pair (x, y) of arrays of shape (n,).

The library reads point k at ``x[k * stride]`` and ``y[k * stride]``, so float64 arrays of either
form are used where they are if x and y advance by the same positive number of whole doubles: rows
and columns in either order, the first two of three columns, fields of a structured array. Any other
input of numbers (integers, float32, descending or unequal strides) is copied once. Outputs of
another form are refused, as a copy would be lost.
"""

from __future__ import annotations

from typing import Any, Tuple, Union

import numpy as np

from ._native import ffi
from .errors import Error

Points = Union[np.ndarray, Tuple[np.ndarray, np.ndarray]]

_DOUBLE = np.dtype(np.float64)
_new, _from_buffer = ffi.new, ffi.from_buffer


def points_in(points: Any, n: int, what: str) -> tuple:
    """Return an ``hm_points*`` that views `points`, and the object that keeps the memory alive."""
    if type(points) is np.ndarray and points.dtype is _DOUBLE and points.shape == (n, 2):
        if points.flags.c_contiguous:
            x = _from_buffer("double[]", points)
            return _new("hm_points*", (x, x + 1, 2)), (x, points)
    x, y = _columns(points, n, what)
    layout = _layout(x, y)
    if layout is None:
        x, y = np.array(x, dtype=_DOUBLE), np.array(y, dtype=_DOUBLE)
        layout = _layout(x, y)
    return _new("hm_points*", layout), (x, y)


def finite(points: Any, n: int, what: str) -> tuple:
    """Return x and y of `points`; a coordinate that is infinite or NaN is refused."""
    x, y = _columns(points, n, what)
    bad = np.flatnonzero(~(np.isfinite(x) & np.isfinite(y)))
    if bad.size:
        k = int(bad[0])
        raise Error(f"Point {k} of {what} is at ({x[k]:g}, {y[k]:g}); both numbers must be finite.", Error.BAD_MESH,
                    "point", k)
    return x, y


def points_out(points: Any, n: int, what: str) -> tuple:
    """Return an ``hm_points_out*`` that views `points`, and what keeps the memory alive."""
    if type(points) is np.ndarray and points.dtype is _DOUBLE and points.shape == (n, 2):
        if points.flags.c_contiguous and points.flags.writeable:
            x = _from_buffer("double[]", points)
            return _new("hm_points_out*", (x, x + 1, 2)), (x, points)
    x, y = _columns(points, n, what, is_output=True)
    for column in (x, y):
        if not column.flags.writeable:
            raise Error(f"{what} is read-only; give an array that can be written.")
    layout = _layout(x, y)
    if layout is None or _overlap(x, y):
        raise Error(
            f"{what} cannot be written in place: x and y must be float64 and advance by the same "
            "positive number of whole doubles without meeting each other."
        )
    return _new("hm_points_out*", layout), (x, y)


def apart(read: Any, written: Any) -> Any:
    """Return `read`, or a copy of it if it shares memory with `written` in another layout.

    The library allows an output to be the arrays of the input; other overlaps are copied.
    """
    if read is written or read is None:
        return read
    if isinstance(read, np.ndarray) and isinstance(written, np.ndarray):
        if not np.may_share_memory(read, written):
            return read
        if _address(read) == _address(written) and read.strides == written.strides:
            return read
        return read.copy()
    pair = read if isinstance(read, (tuple, list)) else (read,)
    others = written if isinstance(written, (tuple, list)) else (written,)
    if all(a is b for a, b in zip(pair, others)) and len(pair) == len(others):
        return read
    if any(np.may_share_memory(a, b) for a in pair for b in others):
        return tuple(np.array(a) for a in pair) if len(pair) == 2 else np.array(read)
    return read


def doubles(values: Any, shape: tuple, what: str, out: bool = False) -> Any:
    """Return a ``double[]`` view of a C-contiguous float64 array of this shape.

    Inputs in another layout are copied once; outputs are refused. The view keeps its array alive.
    """
    if type(values) is np.ndarray and values.dtype is _DOUBLE and values.shape == shape:
        if values.flags.c_contiguous and (not out or values.flags.writeable):
            return _from_buffer("double[]", values)
    if out:
        if not isinstance(values, np.ndarray):
            raise Error(f"{what} must be a numpy array.")
        raise Error(
            f"{what} must be a writable, C-contiguous float64 array of shape {shape}; the array "
            f"given is {_said(values)}."
        )
    array = numbers(values, what)
    if array.shape != shape:
        raise Error(f"{what} must have the shape {shape}, not {array.shape}.")
    return _from_buffer("double[]", np.ascontiguousarray(array, dtype=_DOUBLE))


def int32s(values: Any, what: str, ndim: int = 1) -> np.ndarray:
    """Return `values` as a C-contiguous int32 array; anything but integers in range is refused."""
    array = np.asarray(values)
    if array.size == 0:
        array = array.astype(np.int32)
    if array.ndim != ndim or array.dtype.kind not in "iu":
        raise Error(f"{what} must be integers in {ndim} dimension(s); the array is {_said(array)}.")
    if array.dtype.itemsize >= 4 and array.size > 0:
        low, high = array.min(), array.max()
        if low < -(2**31) or high >= 2**31:
            raise Error(f"{what} has the number {low if low < -(2**31) else high}, beyond 32 bits.")
    return np.ascontiguousarray(array, dtype=np.int32)


def int32_view(array: np.ndarray) -> Any:
    """Return an ``int32_t[]`` view of what :func:`int32s` returned."""
    return _from_buffer("int32_t[]", array) if array.size else ffi.NULL


def numbers(values: Any, what: str) -> np.ndarray:
    """Return `values` as an array of real numbers of any type; other types are refused."""
    try:
        array = np.asarray(values)
    except ValueError:
        raise Error(f"{what} is no array: its rows have different lengths.") from None
    if array.dtype.kind not in "fiub":
        raise Error(f"{what} must be real numbers; the array is {_said(array)}.")
    return array


def _columns(points: Any, n: int, what: str, is_output: bool = False) -> tuple:
    if isinstance(points, (tuple, list)) and len(points) == 2 and np.ndim(points[0]) == 1:
        x, y = points
        if np.shape(x) != np.shape(y):
            raise Error(f"x and y of {what} have different shapes, {np.shape(x)} and {np.shape(y)}.")
        if len(x) == n and not (n == 2 and not isinstance(x, np.ndarray)):
            if is_output and not (isinstance(x, np.ndarray) and isinstance(y, np.ndarray)):
                raise Error(f"{what} must be numpy arrays.")
            return numbers(x, what), numbers(y, what)
    if is_output and not isinstance(points, np.ndarray):
        raise Error(f"{what} must be a numpy array, or a pair of them.")
    array = numbers(points, what)
    if array.shape != (n, 2):
        raise Error(f"{what} must have the shape ({n}, 2), or be a pair of arrays of {n} numbers; "
                    f"its shape is {array.shape}.")
    return array[:, 0], array[:, 1]


def _layout(x: np.ndarray, y: np.ndarray) -> Any:
    """The members of hm_points, or None if the library cannot represent the arrays."""
    if x.dtype != _DOUBLE or y.dtype != _DOUBLE or not x.dtype.isnative or not y.dtype.isnative:
        return None
    if not (x.flags.aligned and y.flags.aligned):
        return None
    stride = x.strides[0] if len(x) > 1 else 8
    if stride != (y.strides[0] if len(y) > 1 else 8) or stride <= 0 or stride % 8:
        return None
    return (ffi.cast("double*", _address(x)), ffi.cast("double*", _address(y)), stride // 8)


def _overlap(x: np.ndarray, y: np.ndarray) -> bool:
    apart_by = abs(_address(y) - _address(x))
    stride = x.strides[0] if len(x) > 1 else 8
    return not (8 <= apart_by <= stride - 8 or apart_by >= stride * (len(x) - 1) + 8)


def _address(array: np.ndarray) -> int:
    return array.__array_interface__["data"][0]


def _said(values: Any) -> str:
    array = np.asarray(values)
    return f"{array.dtype} of shape {array.shape}"
