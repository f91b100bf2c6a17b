"""Surface points of several processes in a grid, and their displacements in its plane."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from .errors import Error
from .morph import Morph
from .plane import Plane


class Surface:
    """What :class:`harmorph.usmesh.USMesh` does between three dimensions and the plane.

    Surface points of all processes are copies of the points with given displacements: `_place` has
    the entry of `_given` for each surface point of this process.
    """

    comm: Any
    _plane: Optional[Plane]
    _morph: Morph
    _start: np.ndarray
    _follows: np.ndarray
    _given: np.ndarray
    _place: np.ndarray
    _surface_start: np.ndarray
    _tolerance: float

    def _nearest(self, points: np.ndarray) -> np.ndarray:
        """The entry of the given points at the place of each surface point."""
        here = np.flatnonzero(np.isin(self._follows, self._given))
        order = np.argsort(self._given)
        entry = order[np.searchsorted(self._given[order], self._follows[here])]
        place = np.empty(len(points), int)
        for k, point in enumerate(points):
            distance = np.abs(self._start[here] - point).max(axis=1)
            nearest = int(distance.argmin())
            if not distance[nearest] <= self._tolerance:
                raise Error(f"Surface point {k} is {distance[nearest]:g} away from the surfaces of the grid.",
                            Error.BAD_MESH, "point", k, value=float(distance[nearest]))
            place[k] = entry[nearest]
        return place

    def _to_plane(self, vectors: np.ndarray) -> np.ndarray:
        if self._plane is None:
            return vectors
        return self._plane.to_plane(vectors, self._surface_start)

    def _from_plane(self, vectors: np.ndarray) -> np.ndarray:
        if self._plane is None:
            return np.column_stack([vectors, np.zeros(len(vectors))])
        return self._plane.from_plane(vectors, self._surface_start)

    def _gathered(self, plane: np.ndarray) -> tuple:
        """The vectors and places of all processes, in the order of the processes."""
        if self.comm is None:
            return plane, self._place
        return np.concatenate(self.comm.allgather(plane)), np.concatenate(self.comm.allgather(self._place))

    def _wall(self, displacement: np.ndarray) -> np.ndarray:
        vectors, place = self._gathered(self._to_plane(displacement))
        across = np.abs(vectors[:, 2]).max(initial=0.0)
        size = np.abs(vectors).max(initial=0.0)
        if across > self._tolerance + 1e-6 * size:
            k = int(np.abs(vectors[:, 2]).argmax())
            raise Error(f"Surface point {k} of all processes moves by {across:g} out of its plane.", value=across)
        if len(np.unique(place)) < len(self._given):
            missing = np.setdiff1d(np.arange(len(self._given)), place)[0]
            raise Error(f"No process has a surface point at point {self._given[missing]} of the grid.",
                        Error.BAD_CONDITION, "point", int(self._given[missing]))
        wall = np.empty((len(self._given), 2))
        wall[place] = vectors[:, :2]
        differs = np.abs(wall[place] - vectors[:, :2]).max(initial=0.0)
        if differs > self._tolerance + 1e-6 * size:
            raise Error(f"Copies of a surface point move differently, by {differs:g}.", value=float(differs))
        return wall

    def _counts(self) -> np.ndarray:
        places = self._place if self.comm is None else np.concatenate(self.comm.allgather(self._place))
        return np.bincount(places, minlength=len(self._given))

    def _mean(self, seeds: np.ndarray) -> np.ndarray:
        """Each wall point moves by the mean of its copies: the transpose of :meth:`_of_wall`."""
        vectors, place = self._gathered(self._to_plane(seeds))
        wall = np.zeros((len(self._given), 2))
        np.add.at(wall, place, vectors[:, :2])
        return wall / np.maximum(self._counts(), 1)[:, None]

    def _of_wall(self, force: np.ndarray) -> np.ndarray:
        return self._from_plane((force / np.maximum(self._counts(), 1)[:, None])[self._place])

    def _spread(self, displacement: np.ndarray, points: Optional[np.ndarray]) -> np.ndarray:
        if self._plane is not None:
            return self._plane.spread(displacement, points)
        raised = np.column_stack([displacement, np.zeros(len(displacement))])
        return raised if points is None else points + raised

    def _gather(self, whole: np.ndarray) -> np.ndarray:
        return self._plane.gather(whole) if self._plane is not None else whole[:, :2].copy()

    def _gather_mean(self, whole: np.ndarray) -> np.ndarray:
        layers = np.bincount(self._follows, minlength=self._morph.n_points)
        return self._gather(whole) / layers[:, None]
