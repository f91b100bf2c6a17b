"""Markers of a mesh: their names and numbers, and the edges of the boundary."""

from __future__ import annotations

from typing import Any, Dict, Mapping, Union

import numpy as np

from .arrays import int32s
from .errors import Error

Marker = Union[str, int]


def numbered(boundary: Mapping[Marker, Any]) -> Dict[Marker, int]:
    """Return the number of each marker; see the attribute `markers` of :class:`harmorph.Mesh`."""
    if not isinstance(boundary, Mapping):
        raise Error("boundary must be a dict: an array of edges, or a run of points, by marker.")
    numbers: Dict[Marker, int] = {}
    for name in boundary:
        if isinstance(name, (bool, np.bool_)) or not isinstance(name, (str, int, np.integer)):
            raise Error(f"A marker is a name or an integer, not {name!r}.")
        if not isinstance(name, str):
            if not -(2**31) < name < 2**31:
                raise Error(f"The marker {name} is beyond 32 bits.")
            numbers[name] = int(name)
    free = 0
    for name in sorted(one for one in boundary if isinstance(one, str)):
        while free in numbers.values():
            free += 1
        numbers[name] = free
        free += 1
    return numbers


def faces_of(points: Any, name: Marker) -> np.ndarray:
    """Return the edges of a marker, which may be given as a run of points: shape (m, 2)."""
    array = np.asarray(points)
    if array.ndim == 1 and array.size != 1:
        run = int32s(array, f"The run of points of marker {name!r}")
        return np.stack([run[:-1], run[1:]], axis=1) if len(run) else np.empty((0, 2), np.int32)
    if array.ndim != 2 or array.shape[1] != 2:
        raise Error(f"The boundary of marker {name!r} must have the shape (m, 2), or be a run of at "
                    f"least two points; its shape is {array.shape}.")
    return int32s(array, f"The edges of marker {name!r}", 2)
