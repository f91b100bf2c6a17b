"""The boundary of a mesh: names and numbers of markers, their edges, their points in order."""

from __future__ import annotations

from typing import Any, Dict, Iterable, List, Mapping, Tuple, Union

import numpy as np

from ._native import ffi, lib
from .arrays import int32_view, int32s
from .errors import MEMORY, Error, call, call_with_memory
from .reports import new

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


class Boundary:
    """Methods of :class:`harmorph.Mesh` that ask for the boundary."""

    markers: Dict[Marker, int]
    n_points: int
    _faces: np.ndarray
    _face_markers: np.ndarray
    _c: Any

    def marker(self, name: Marker) -> int:
        """Return the number of a marker; refuse one that the mesh does not have."""
        if name in self.markers:
            return self.markers[name]
        known = ", ".join(repr(one) for one in self.markers)
        raise Error(
            f"The mesh has no marker {name!r}; its markers are {known}.", Error.BAD_CONDITION, "marker"
        )

    def faces(self, marker: Marker) -> np.ndarray:
        """Return the edges of a marker: int32 array of shape (m, 2) of points."""
        return self._faces[self._face_markers == self.marker(marker)].copy()

    def wall(self, markers: Union[Marker, Iterable[Marker]], piece: int = 0) -> Tuple[np.ndarray, bool]:
        """Return the points of markers in order along the boundary.

        Parameters
        ----------
        markers : marker or sequence of markers
        piece : int
            Which piece, from 0, if the markers form several.

        Returns
        -------
        points : int32 array
            With the mesh on the left: around a body clockwise. A closed piece does not repeat its
            first point.
        is_loop : bool
        """
        numbers = int32_view(np.array(self.numbers_of(markers), np.int32))
        analysis, _alive = self._analysis()
        n, is_loop = ffi.new("int32_t*"), ffi.new("int32_t*")
        points = np.empty(self.n_points, np.int32)
        call(lib.hm_analysis_boundary, analysis, len(numbers), numbers, piece, int32_view(points),
             self.n_points, n, is_loop, names=self.names)
        return points[: n[0]].copy(), bool(is_loop[0])

    def numbers_of(self, markers: Union[Marker, Iterable[Marker]]) -> List[int]:
        """Return the numbers of one marker or of several."""
        one = isinstance(markers, (str, int, np.integer))
        return [self.marker(name) for name in ([markers] if one else markers)]  # type: ignore

    @property
    def names(self) -> Dict[int, str]:
        """The names of the markers that have names, by their numbers."""
        return {number: name for name, number in self.markers.items() if isinstance(name, str)}

    def _analysis(self) -> tuple:
        """An analysis without conditions, and the block that keeps it alive."""
        problem, analysis = new("hm_problem"), ffi.new("hm_analysis**")
        problem.mesh = self._c
        block = call_with_memory(lib.hm_analysis_init, analysis, MEMORY, problem, ffi.NULL, names=self.names)
        return analysis[0], block
