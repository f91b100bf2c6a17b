"""Large movements, better cells, and points that slip along curves: calls that need the plan."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import apart, doubles, points_in, points_out
from .basis import Basis
from .errors import MEMORY, Error, call, call_with_memory
from .reports import Report, fill, new, report
from .words import STRATEGIES, of_value


class Safe(NamedTuple):
    """Result of :meth:`harmorph.Morph.safe` and :meth:`harmorph.Morph.displace_safe`.

    Attributes
    ----------
    points : ndarray of shape (n_points, 2), or `out`
        The mesh; no cell is inverted.
    report : Report
        {members of hm_safe_report}
        - `worst` : tuple of Report. The `n_worst` worst cells: `cell`, `quality` and `start_quality`,
          and the mean `x`, `y` of the corners.
    reached : ndarray of shape (functions, 2)
        The movement that `points` has.
    derivative : Morph or None
        `displacement` and `adjoint` of this object are the derivative of `points` by `move` and its
        transpose.
    """

    points: Any
    report: Report
    reached: np.ndarray
    derivative: Any


class Large:
    """Methods of :class:`harmorph.Morph` that solve on the way."""

    _basis: Optional[Basis]
    _lock: Any
    n_points: int
    functions: int
    start: Any

    def safe(
        self,
        move: Any,
        out: Any = None,
        *,
        max_resolves: int = 0,
        skip: Sequence[str] = (),
        others: Sequence[Any] = (),
        improve: bool = False,
        heights: float = 0.0,
        min_quality: float = 0.0,
        max_height_change: float = 0.0,
        improve_work: int = 0,
        derivative: bool = False,
    ) -> Safe:
        """Move the mesh from `start` by a movement of any size, so that no cell inverts.

        Strategies are tried in the order of `skip`, until the mesh is at the target and as good as the
        options ask for; the best mesh of all is returned. So the wall ends where :meth:`morph` takes
        it (where bodies rotate, their offsets from the curve rotate, too), while inner points may lie
        elsewhere, also where :meth:`morph` would give a valid mesh: `report.strategy` tells.

        Parameters
        ----------
        move : array of shape (functions, 2)
            See :meth:`displacement`.
        out : array of shape (n_points, 2), or pair of arrays of shape (n_points,), optional
            Receives the coordinates.
        max_resolves : int
            How many times the functions may be solved again; 0 means 10, negative never.
        skip : sequence of {"linear", "other", "substeps", "untangled", "improved"}
            Strategies that are not tried:

            {"linear": HM_STRATEGY_LINEAR}
            {"other": HM_STRATEGY_OTHER}
            {"substeps": HM_STRATEGY_SUBSTEPS}
            {"untangled": HM_STRATEGY_UNTANGLED}
            {"improved": HM_STRATEGY_IMPROVED}

            Unless `min_quality` is negative, "other" is also tried, and "improved", where the mesh at the
            target is much poorer than the start, as `min_quality` says.
        others : sequence of Morph
            Objects of the same mesh, curves and conditions with other operators. Without them the
            library itself solves functions of the operators other than that of this object, unless a
            derivative is wanted.
        improve : bool
            True: the mesh at the target is improved in any case; False: only where it is poor.
        heights : float
            0 to 1: the part of the heights of the first layer that is restored.
        min_quality : float
            Smallest quality at the target, or after the largest part of the movement that has this
            quality, in parts of that of the start; 0 means 0.05. Other operators are tried where this
            part is below 0.8, an improvement where the part, or that of the mean quality, is below
            0.98. Negative: the first valid mesh at the target is taken, or the last valid one before.
        max_height_change : float
            The largest factor by which heights of the first layer may change; 0: any.
        improve_work : int
            Solutions of each improvement at most; 0 means 20.
        derivative : bool
            Also return the derivative.

        Returns
        -------
        Safe

        Raises
        ------
        Error
            ``CROSSING``: no mesh has the moved boundary. `out` is then unchanged.

        Warns
        -----
        HarmorphWarning
            ``SHORT``: only a part of the movement was possible; ``POOR``; ``NOT_CONVERGED``.
        """
        options, alive = safe_options(
            max_resolves, skip, others, improve, heights, min_quality, max_height_change, improve_work
        )
        with self._lock:
            basis, solver = self._open(), self._ready()
            step = doubles(move, basis.shape, "move")
            out = np.empty((self.n_points, 2)) if out is None else out
            to, _to_alive = points_out(out, self.n_points, "out")
            reached, result = np.zeros(basis.shape), new("hm_safe_report")
            options.reached = doubles(reached, basis.shape, "reached", out=True)
            other, block = Basis.empty(solver.analysis) if derivative else (ffi.NULL, None)
            options.derivative = other
            target = fill(new("hm_safe_target"), move=step)
            try:
                move_safe(self, solver, target, to, options, result)
            finally:
                solver.has_factor = solver.has_factor and result.resolves == 0
            found = self._derivative(Basis(other, block)) if derivative else None
        del alive
        return Safe(out, safe_report(result, others), reached, found)

    def _derivative(self, basis: Basis) -> Any:
        from copy import copy

        other = copy(self)
        other._set_basis(basis)
        return other

    def improve(
        self, points: Any, out: Any = None, *, reference: Any = None, max_solutions: int = 0
    ) -> Tuple[Any, Report]:
        """Make the cells of a moved mesh more like those before; no cell inverts.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays
            A valid mesh after a movement.
        out : array of shape (n_points, 2), or pair of arrays, optional
            Receives the coordinates; it may be `points`.
        reference : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates before the movement; the default is `start`.
        max_solutions : int
            Factorisations at most; 0 means 20.

        Returns
        -------
        points : ndarray of shape (n_points, 2), or `out`
        report : Report
            {members of hm_improve_report}
        """
        options, result, n = new("hm_improve_options"), new("hm_improve_report"), self.n_points
        fill(options, max_solutions=max_solutions)
        out = np.empty((n, 2)) if out is None else out
        to, _to_alive = points_out(out, n, "out")
        from_, _alive = points_in(apart(points, out), n, "points")
        with self._lock:
            self._open()
            solver = self._ready()
            before, _kept = points_in(apart(self.start if reference is None else reference, out), n, "reference")
            options.reference = before
            call_with_memory(lib.hm_improve, solver.plan, from_, to, MEMORY, options, result)
        return out, report(result)

    def slip(self, points: Any, out: Any = None) -> Any:
        """Put points with slip back onto their curved boundary after a morph.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays
        out : array of shape (n_points, 2), or pair of arrays, optional
            Receives the coordinates; it may be `points`.

        Returns
        -------
        ndarray of shape (n_points, 2), or `out`
        """
        n = self.n_points
        out = np.empty((n, 2)) if out is None else out
        to, _to_alive = points_out(out, n, "out")
        from_, _alive = points_in(apart(points, out), n, "points")
        with self._lock:
            self._open()
            call(lib.hm_slip, self._ready().analysis, from_, to)
        return out

    def slip_derivative(self, points: Any, change: Any) -> np.ndarray:
        """Return the changes of the points after :meth:`slip` from those of the points before it.

        Parameters
        ----------
        points, change : arrays of shape (n_points, 2), or pairs of arrays
            The points before, and their changes.

        Returns
        -------
        ndarray of shape (n_points, 2)
        """
        return self._slipped(lib.hm_slip_derivative, points, change, "change")

    def slip_adjoint(self, points: Any, dj: Any) -> np.ndarray:
        """Return derivatives by the points before :meth:`slip` from those by the points after it.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays
            The points before.
        dj : array of shape (n_points, 2), or pair of arrays

        Returns
        -------
        ndarray of shape (n_points, 2)
        """
        return self._slipped(lib.hm_slip_adjoint, points, dj, "dj")

    def _slipped(self, function: Any, points: Any, vectors: Any, what: str) -> np.ndarray:
        n, result = self.n_points, np.empty((self.n_points, 2))
        to, _to_alive = points_out(result, n, "out")
        from_, _alive = points_in(points, n, "points")
        view, _alive_too = points_in(vectors, n, what)
        with self._lock:
            self._open()
            call(function, self._ready().analysis, from_, view, to)
        return result

    def _open(self) -> Basis:
        raise NotImplementedError

    def _ready(self) -> Any:
        raise NotImplementedError

    def _set_basis(self, basis: Basis) -> None:
        raise NotImplementedError


def move_safe(morph: Any, solver: Any, target: Any, to: Any, options: Any, result: Any) -> None:
    """Call ``hm_move_safe`` with the functions of a morph.

    Raises
    ------
    Error
        ``BAD_BASIS``: the basis was read from a file, and its analysis cannot be made again from the mesh.
    """
    basis = morph._open()
    try:
        call_with_memory(lib.hm_move_safe, solver.plan, basis.pointer, target, to, MEMORY, options, result)
    except Error as refused:
        is_of_place = basis.info.bodies or basis.info.offset_correction
        if refused.code != Error.BAD_BASIS or morph._known is None or not is_of_place or options.n_others:
            raise
        raise Error("the mesh has moved since the first analysis of this basis, on which its rigid bodies or offsets "
                    "depend; call solve() first, or restore the coordinates", Error.BAD_BASIS) from None


def safe_options(
    max_resolves: int,
    skip: Any,
    others: Any,
    improve: bool,
    heights: float,
    min_quality: float,
    max_height_change: float,
    improve_work: int,
) -> Tuple[Any, Any]:
    """Return ``hm_safe_options*``, and what must stay alive with it."""
    options = fill(new("hm_safe_options"), max_resolves=max_resolves, improve=int(bool(improve)),
                   heights=heights, min_quality=min_quality, max_height_change=max_height_change,
                   improve_work=improve_work)
    for name in skip:
        if name not in STRATEGIES:
            raise Error(f"The strategy {name!r} is unknown; known are {list(STRATEGIES)}.")
        options.skipped_strategies |= 1 << STRATEGIES[name]
    alive: List[Any] = [other._open() for other in others]
    if alive:
        pointers = ffi.new("hm_basis*[]", [one.pointer for one in alive])
        options.others, options.n_others = pointers, len(alive)
        alive.append(pointers)
    return options, alive


def safe_report(result: Any, others: Sequence[Any]) -> Report:
    """Return the report of a safe morph; without `others`, `other` is the operator that the library has tried."""
    told = report(result)
    if not others:
        told.other = of_value("operator_kind", told.other)
    return told
