"""Movements of all mesh points by a solved basis, their transpose, and their assessment."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from ._native import ffi, lib
from .arrays import apart, doubles, points_in, points_out
from .basis import Basis
from .errors import MEMORY, Error, call, call_with_memory, check
from .mesh import Mesh
from .reports import Report, new, pair, report
from .threads import Executor

_new, _NULL = ffi.new, ffi.NULL
_hm_morph, _hm_adjoint = lib.hm_morph, lib.hm_adjoint


class Assessment(NamedTuple):
    """Result of :meth:`Morph.assess`.

    Attributes
    ----------
    step : Report or None
        How far the displacement can be multiplied before the first cell inverts; None without a
        displacement:

        {members of hm_step_report}
    quality : Report
        {members of hm_quality_report}
        cell_quality : ndarray of shape (n_cells,), or None
            With ``cells=True``, the quality of each cell in the order of the mesh, 0 for inverted
            cells: `min_quality` is the smallest of them, and `mean_quality` their mean.
    """

    step: Optional[Report]
    quality: Report


class Functions:
    """Methods of :class:`harmorph.Morph` that need no plan."""

    _basis: Optional[Basis]
    _problem: Optional[Mesh]
    _executor: Executor
    _lock: Any
    n_points: int

    def displacement(self, move: Any, out: Any = None) -> Any:
        """Return the displacement of each mesh point, sum_i F_i (dx, dy)_i.

        Parameters
        ----------
        move : array of shape (functions, 2)
            Movements of the control points [length], then two rows for each rigid body. Velocities
            give velocities.
        out : array of shape (n_points, 2), or pair of arrays of shape (n_points,), optional
            Receives the result; see :mod:`harmorph.arrays`.

        Returns
        -------
        ndarray of shape (n_points, 2), or `out`
        """
        basis = self._basis or self._open()
        step = doubles(move, basis.shape, "move")
        if out is None:
            out = np.empty((basis.n_points, 2))
        to, _alive = points_out(out, basis.n_points, "out")
        error = _new("hm_error*")
        if self._executor.threads == 1:
            status = _hm_morph(basis.pointer, step, _NULL, to, self._executor.view, error)
        else:
            with self._lock:
                status = _hm_morph(basis.pointer, step, _NULL, to, self._executor.view, error)
        if status:
            check(status, error)
        return out

    def morph(self, move: Any, points: Any = None, out: Any = None) -> Any:
        """Return moved coordinates, points + sum_i F_i (dx, dy)_i.

        Parameters
        ----------
        move : array of shape (functions, 2)
            See :meth:`displacement`.
        points : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates before the movement; the default is `start`.
        out : array of shape (n_points, 2), or pair of arrays, optional
            Receives the result; it may be `points`, which then moves in place.

        Returns
        -------
        ndarray of shape (n_points, 2), or `out`

        Notes
        -----
        Points on the wall follow the B-spline. Points with a displacement of 0 keep their bits. A
        sum of movements gives the same mesh in one call or in several. Whether cells invert,
        :meth:`assess` tells.
        """
        basis = self._basis or self._open()
        step = doubles(move, basis.shape, "move")
        if out is None:
            out = np.empty((basis.n_points, 2))
        if points is None:
            if self._problem is None:
                raise Error("A basis without a mesh has no coordinates; give `points`.")
            points = self._problem.points
        elif points is not out:
            points = apart(points, out)
        to, _alive = points_out(out, basis.n_points, "out")
        from_, _alive_too = points_in(points, basis.n_points, "points")
        error = _new("hm_error*")
        if self._executor.threads == 1:
            status = _hm_morph(basis.pointer, step, from_, to, self._executor.view, error)
        else:
            with self._lock:
                status = _hm_morph(basis.pointer, step, from_, to, self._executor.view, error)
        if status:
            check(status, error)
        return out

    def adjoint(self, dj: Any, out: Optional[np.ndarray] = None) -> np.ndarray:
        """Return derivatives by the movement from those by the mesh points: the exact transpose.

        Parameters
        ----------
        dj : array of shape (n_points, 2), or pair of arrays of shape (n_points,)
            Derivatives of an objective J by x and y of each mesh point.
        out : C-contiguous float64 array of shape (functions, 2), optional

        Returns
        -------
        ndarray of shape (functions, 2), or `out`
            Derivatives by the rows of `move`. If a number is not finite, all are NaN.
        """
        basis = self._basis or self._open()
        view, _alive = points_in(dj, basis.n_points, "dj")
        if out is None:
            out = np.empty(basis.shape)
        gradient = doubles(out, basis.shape, "out", out=True)
        error = _new("hm_error*")
        if self._executor.threads == 1:
            status = _hm_adjoint(basis.pointer, view, gradient, self._executor.view, error)
        else:
            with self._lock:
                status = _hm_adjoint(basis.pointer, view, gradient, self._executor.view, error)
        if status:
            check(status, error)
        return out

    def matrix(self, out: Optional[np.ndarray] = None) -> np.ndarray:
        """Return the functions as a dense array, for products on any device.

        Parameters
        ----------
        out : C-contiguous float64 array of shape (planes, n_points, functions), optional

        Returns
        -------
        ndarray of shape (planes, n_points, functions), or `out`
            The displacements ``(dx, dy)`` of :meth:`displacement` are, for columns ``px, py`` of `move`,
            ``F[0] @ px, F[0] @ py`` with 1 plane (real functions),
            ``F[0] @ px - F[1] @ py, F[1] @ px + F[0] @ py`` with 2 (complex functions: the default operator), and
            ``F[0] @ px + F[1] @ py, F[2] @ px + F[3] @ py`` with 4 (points that slip along lines).
            So a batch of movements is one product in numpy, PyTorch or CuPy.
        """
        basis = self._basis or self._open()
        shape = (basis.info.numbers_per_value, basis.n_points, basis.shape[0])
        if out is None:
            out = np.empty(shape)
        call(lib.hm_basis_matrix, basis.pointer, doubles(out, shape, "out", out=True))
        return out

    def assess(self, displacement: Any = None, points: Any = None, reference: Any = None,
               cells: bool = False) -> Assessment:
        """Judge a movement before anything moves, or a mesh as it is.

        Parameters
        ----------
        displacement : array of shape (n_points, 2), or pair of arrays, optional
            From :meth:`displacement`. None: the mesh at `points` is judged.
        points : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates from which the points move; the default is `start`.
        reference : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates with the sizes of cells that the quality refers to; the default is `points`. So
            ``assess(points=moved)`` judges shapes of cells alone; to judge a moved mesh against the
            start, give ``reference=morph.start``: the quality is then that of
            ``assess(displacement)``.
        cells : bool, optional
            Also return the quality of each cell, as ``quality.cell_quality``.

        Returns
        -------
        Assessment
            The pair (step, quality). The movement is possible while ``step.admissible`` is above 1 and
            ``quality.inverted`` is 0.
        """
        basis, n = self._open(), self.n_points
        if self._problem is None:
            raise Error("This call needs the mesh; give it to Morph.load().", Error.BAD_BASIS)
        views = [(_NULL, None) if one is None else points_in(one, n, what)
                 for one, what in ((points, "points"), (displacement, "displacement"),
                                   (reference, "reference"))]
        step = new("hm_step_report") if displacement is not None else _NULL
        quality = new("hm_quality_report")
        of_cells = np.empty(self._problem.n_cells) if cells else None
        if of_cells is not None:
            quality.cell_quality = ffi.from_buffer("double[]", of_cells)
        with self._lock if self._executor.threads > 1 else _NoLock():
            call(lib.hm_assess, basis.pointer, self._problem._c, *(view for view, _ in views),
                 self._executor.view, step, quality)
        found = report(quality)
        found.cell_quality = of_cells
        return Assessment(None if step == _NULL else report(step), found)

    def boundary_error(self, move: Any, moved: Any, points: Any = None) -> float:
        """Return the largest distance of wall points from where their conditions take them [length].

        Parameters
        ----------
        move : array of shape (functions, 2)
        moved : array of shape (n_points, 2), or pair of arrays
            The mesh after the movement.
        points : array of shape (n_points, 2), or pair of arrays, optional
            The mesh before the movement; the default is `start`.

        Warns
        -----
        HarmorphWarning
            ``TORN``: the movement takes the two conditions of a point apart by more than 1e-6 of
            the diagonal of the box around the wall; do not use the moved mesh.
        """
        basis, n = self._open(), self.n_points
        if points is None and self._problem is None:
            raise Error("A basis without a mesh has no coordinates; give `points`.")
        before, _alive = points_in(self._problem.points if points is None else points, n, "points")
        after, _alive_too = points_in(moved, n, "moved")
        error = ffi.new("double*")
        call(lib.hm_boundary_error, basis.pointer, doubles(move, basis.shape, "move"), before, after,
             error, ffi.NULL)
        return error[0]

    def recover(self, points: Any, tolerance: float = 0.0) -> np.ndarray:
        """Return the movement, shape (functions, 2), that a mesh has made since the functions were solved.

        If several movements lead the wall there, the smallest one is returned. After :meth:`load` on a mesh
        that has moved since the functions were solved, the movement is that since the first analysis.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays
            The mesh after any number of morphs or safe morphs.
        tolerance : float
            The call refuses a mesh whose wall is farther than this from where the movement leads it,
            apart from offsets that safe morphs have turned [length]; 0 means 1e-4 of the extent of the wall.
        """
        basis = self._open()
        move = basis.recover(points, tolerance)
        return move if basis.before is None else move - basis.before

    def _open(self) -> Basis:
        raise NotImplementedError


class _NoLock:
    def __enter__(self) -> None:
        pass

    def __exit__(self, *_ignored: Any) -> None:
        pass


def rigid(shift: Sequence[float] = (0.0, 0.0), degrees: float = 0.0, scale: float = 1.0, *,
          before: Sequence[float] = (0.0, 1.0)) -> np.ndarray:
    """Return the two rows of `move` for a rigid body.

    The second row is the change of s = scale * (cos a, sin a), a the angle of rotation since the first
    analysis, so that movements may be added. After :meth:`harmorph.Morph.solve` on a mesh in which the body
    has rotated or changed its scale, a further rotation therefore needs `before`: without it the rotation
    moves each point of the body by (s - 1) times its first distance from the centre, and the body changes
    its size.

    Parameters
    ----------
    shift : pair of float
        Translation [length].
    degrees : float
        Rotation about the centre of the body [degrees], counter-clockwise. The centre has moved with the
        translations so far.
    scale : float
        Scale about the centre [-].
    before : pair of float
        The rotation [degrees] and the scale [-] that the body has had since the first analysis; the
        rotation and scale of this call follow them.

    Returns
    -------
    ndarray of shape (2, 2)

    Raises
    ------
    Error
        `before` is not a pair.
    """
    angle, (degrees_before, scale_before) = np.radians(degrees), pair(before, "before")
    turn = complex(scale * np.cos(angle) - 1, scale * np.sin(angle))
    if (degrees_before, scale_before) != (0, 1):
        turn *= scale_before * np.exp(1j * np.radians(degrees_before))
    return np.array([shift, [turn.real, turn.imag]], dtype=float)
