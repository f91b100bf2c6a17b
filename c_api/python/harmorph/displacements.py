"""Displacements that are given at wall points, and their transpose: calls that need the plan."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import apart, doubles, int32_view, int32s, numbers, points_in, points_out
from .basis import Basis
from .errors import MEMORY, Error, call_with_memory
from .large import Safe, move_safe, safe_options, safe_report
from .reports import fill, new


class Displacements:
    """Methods of :class:`harmorph.Morph` for markers with the condition "given"."""

    _basis: Optional[Basis]
    _lock: Any
    n_points: int

    @property
    def given_points(self) -> np.ndarray:
        """The wall points with given displacements: int32 array of mesh points, in order."""
        with self._lock:
            self._open()
            return self._ready().given_points()

    def displace(self, wall: Any, points: Any = None, out: Any = None, *, wall_points: Any = None) -> Any:
        """Carry displacements of wall points to the mesh.

        Parameters
        ----------
        wall : array of shape (n, 2) or (fields, n, 2)
            Displacements of the wall points [length]; several fields are solved at once.
        points : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates that the displacements are added to. None: displacements are returned.
        out : array of shape (n_points, 2), or pair of arrays, optional
            Receives the result of a single field; it may be `points`.
        wall_points : int array of shape (n,), optional
            The mesh points of `wall`, in any order; the default is `given_points`.

        Returns
        -------
        ndarray of shape (n_points, 2) or (fields, n_points, 2), or `out`

        Raises
        ------
        Error
            ``CROSSING``: with `points`, the moved boundary crosses itself.
        """
        with self._lock:
            self._open()
            solver, where, n, fields, is_stack = self._wall(wall, wall_points, "wall")
            if is_stack and out is not None:
                raise Error("out is for a single field.")
            results: Any = np.empty((len(fields), self.n_points, 2)) if out is None else [out]
            views = [points_in(apart(one, out), n, "wall") for one in fields]
            targets = [points_out(one, self.n_points, "out") for one in results]
            from_, _alive = (ffi.NULL, None)
            if points is not None:
                from_, _alive = points_in(apart(points, out), self.n_points, "points")
            call_with_memory(lib.hm_displace, solver.plan, n, where, len(fields),
                             ffi.new("hm_points[]", [view[0] for view, _ in views]), from_,
                             ffi.new("hm_points_out[]", [view[0] for view, _ in targets]), MEMORY, ffi.NULL)
        return results if is_stack else results[0]

    def displace_adjoint(self, dj: Any, *, wall_points: Any = None) -> np.ndarray:
        """The transpose of :meth:`displace`: forces on mesh points become forces on the wall.

        Parameters
        ----------
        dj : array of shape (n_points, 2) or (fields, n_points, 2), or pair of arrays
            Derivatives of objectives by the mesh points.
        wall_points : int array of shape (n,), optional
            As in :meth:`displace`. Where a point is repeated, its first entry receives the whole
            derivative.

        Returns
        -------
        ndarray of shape (n, 2) or (fields, n, 2)
        """
        with self._lock:
            self._open()
            solver = self._ready()
            n, where, _kept = self._where(solver, wall_points)
            is_stack = not isinstance(dj, tuple) and np.ndim(dj) == 3
            fields = list(dj) if is_stack else [dj]
            results = np.empty((len(fields), n, 2))
            views = [points_in(one, self.n_points, "dj") for one in fields]
            targets = [points_out(one, n, "out") for one in results]
            call_with_memory(lib.hm_displace_adjoint, solver.plan, n, where, len(fields),
                             ffi.new("hm_points[]", [view[0] for view, _ in views]),
                             ffi.new("hm_points_out[]", [view[0] for view, _ in targets]), MEMORY, ffi.NULL)
        return results if is_stack else results[0]

    def displace_safe(
        self,
        wall: Any,
        move: Any = None,
        out: Any = None,
        *,
        wall_points: Any = None,
        max_resolves: int = 0,
        skip: Sequence[str] = (),
        improve: bool = False,
        heights: float = 0.0,
        min_quality: float = 0.0,
        max_height_change: float = 0.0,
        improve_work: int = 0,
    ) -> Safe:
        """Move the mesh from `start` by given displacements of any size, so that no cell inverts.

        Parameters
        ----------
        wall : array of shape (n, 2)
            See :meth:`displace`.
        move : array of shape (functions, 2), optional
            Movements of curves and rigid bodies in the same call.
        out, max_resolves, skip, improve, heights, min_quality, max_height_change, improve_work
            See :meth:`safe`.
        wall_points
            See :meth:`displace`.

        Returns
        -------
        Safe
        """
        options, _others = safe_options(
            max_resolves, skip, (), improve, heights, min_quality, max_height_change, improve_work
        )
        with self._lock:
            basis = self._open()
            solver, where, n, fields, is_stack = self._wall(wall, wall_points, "wall")
            if is_stack:
                raise Error("displace_safe takes one field, an array of shape (n, 2).")
            out = np.empty((self.n_points, 2)) if out is None else out
            to, _to_alive = points_out(out, self.n_points, "out")
            view, _alive = points_in(apart(fields[0], out), n, "wall")
            step = ffi.NULL if move is None else doubles(move, basis.shape, "move")
            reached, result = np.zeros(basis.shape), new("hm_safe_report")
            if basis.shape[0]:
                options.reached = doubles(reached, basis.shape, "reached", out=True)
            target = fill(new("hm_safe_target"), move=step, n=n, points=where, wall=view)
            try:
                move_safe(self, solver, target, to, options, result)
            finally:
                solver.has_factor = solver.has_factor and result.resolves == 0
        return Safe(out, safe_report(result, ()), reached, None)

    def _where(self, solver: Any, wall_points: Any) -> Tuple[int, Any, Any]:
        if wall_points is None:
            return len(solver.given_points()), ffi.NULL, None
        where = int32s(wall_points, "wall_points")
        return len(where), int32_view(where), where

    def _wall(self, wall: Any, wall_points: Any, what: str) -> tuple:
        solver = self._ready()
        n, where, _kept = self._where(solver, wall_points)
        array = numbers(wall, what)
        if array.ndim not in (2, 3) or array.shape[-2:] != (n, 2):
            raise Error(f"{what} must have the shape ({n}, 2) or (fields, {n}, 2), not {array.shape}.")
        return solver, where, n, list(array) if array.ndim == 3 else [array], array.ndim == 3

    def _open(self) -> Basis:
        raise NotImplementedError

    def _ready(self) -> Any:
        raise NotImplementedError
