"""Morph: the functions of a mesh, and all that is done with them."""

from __future__ import annotations

import threading
from typing import Any, Optional, Tuple

import numpy as np

from ._native import lib
from .arrays import numbers, points_in
from .basis import Basis
from .conditions import Given, flux_arrays, listed
from .curves import Curves
from .displacements import Displacements
from .errors import Error, call
from .functions import Functions
from .large import Large
from .measures import Measures
from .mesh import Mesh
from .reports import Report, new, report
from .solver import Solver, options_of
from .stored import Stored
from .threads import ONE_THREAD, Executor
from .variables import Variables


class Morph(Functions, Large, Displacements, Stored):
    """The functions that carry movements of control points to a mesh.

    A movement `move` is an array of shape (functions, 2): dx, dy of each control point [length].
    ``mesh.plot(morph.morph(move))`` draws the mesh after a movement.

    ``Morph(mesh, curves)`` checks the mesh, orders and factors the matrix and solves for one
    function for each control point.

    Parameters
    ----------
    mesh : Mesh
        Its coordinates are copied once; they are `start`. So the arrays of the mesh may move.
    curves : Curves, optional
        None: rigid bodies and given displacements only.
    conditions : mapping of marker to Condition or str, or sequence of such pairs, optional
        What the markers do (:class:`harmorph.Condition`). Markers that `curves` was fitted to are
        on the curves; other markers without a condition are fixed.
    operator : {"conformal", "laplace", "weighted"}
        What the functions minimise. The weight k = 1 / d^q of a cell, d its distance from the faces that
        move, makes cells near the wall stiff. The paper is Nikolos, Lygidakis, Leloudas, Tavla,
        "Application of B-spline basis functions as harmonic functions for the concurrent shape and
        mesh morphing of airfoils".

        {"conformal": HM_CONFORMAL}
        {"laplace": HM_LAPLACE}
        {"weighted": HM_WEIGHTED}
    engine : {"direct", "multigrid", "fas"}
        {"direct": HM_DIRECT}
        {"multigrid": HM_MULTIGRID}
        {"fas": HM_FAS}
    exponent : float, optional
        The exponent q of the weight, a multiple of 0.25 up to 4; 0: no weight (k = 1). None: 1.5 of
        "conformal", 1 of "weighted"; "laplace" has no weight.
    offset_correction : bool
        Conformal only: offsets of mesh points from the curve rotate with the curve.
    tolerance : float
        Relative residual above which the solution warns; 0 means 1e-10.
    max_curve_distance : float
        Points that are farther from their curve than this part of the diagonal of the box around
        the curve are refused; 0 refuses none.
    fluxes : pair of arrays, optional
        Neumann values: points of free faces, shape (n, 2), and the outward normal derivatives of
        the functions of all control points there, shape (n, control points) [1/length], times the
        weight of the operator. Other free faces have 0. A file of
        :meth:`save` does not have them: safe morphs after :meth:`load` cannot solve again.
    threads : int
        Threads of each call, 1 to 256. Calls of one object wait for each other if it is not 1.

    Attributes
    ----------
    mesh : Mesh or None
    curves : Curves or None
        The curves at the first analysis; after :meth:`load` on a mesh those at the coordinates of the mesh.
    start : ndarray of shape (n_points, 2), or None
        Read-only: the coordinates on which the functions were solved.
    functions : int
        Rows of `move`: control points, then two rows for each rigid body (:func:`harmorph.rigid`).
    n_points : int
    info : Report
        {members of hm_basis_info}
    shared_points : ndarray of shape (n, 3)
        Points that two conditions move differently, and the positions of the first and of the
        second of them in the list of conditions.
    solve_report : Report or None
        None after :meth:`load`:

        {members of hm_solve_report}

    Raises
    ------
    Error
        ``BAD_MESH``, ``BAD_CURVE``, ``BAD_CONDITION``, ``UNSUPPORTED``, ``NOT_POSITIVE``.

    Warns
    -----
    HarmorphWarning
        ``FAR_FROM_CURVE``: a point is far from its curve; ``TORN``: a point belongs to two moving
        conditions, which movements may tear apart (`shared_points`); ``NOT_CONVERGED``.

    Notes
    -----
    The library runs without the interpreter lock. Any number of threads may call `displacement`,
    `morph`, `adjoint` and `assess` of one object; other calls wait for each other.
    """

    def __init__(
        self,
        mesh: Mesh,
        curves: Optional[Curves] = None,
        conditions: Given = None,
        *,
        operator: str = "conformal",
        engine: str = "direct",
        exponent: Optional[float] = None,
        offset_correction: bool = False,
        tolerance: float = 0.0,
        max_curve_distance: float = 0.0,
        fluxes: Any = None,
        threads: int = 1,
    ) -> None:
        if not isinstance(mesh, Mesh):
            raise Error(f"mesh must be a harmorph.Mesh, not {type(mesh).__name__}.")
        self._options = options_of(operator, engine, exponent, offset_correction, tolerance)
        self._options["max_curve_distance"] = max_curve_distance
        self._own(mesh, curves, listed(mesh, curves, conditions), threads, flux_arrays(curves, fluxes))
        self._solve()

    def _own(self, mesh: Optional[Mesh], curves: Optional[Curves], pairs: Any, threads: int,
             fluxes: Any = None) -> None:
        self.mesh, self.curves, self._pairs, self._fluxes = mesh, curves, pairs, fluxes
        self._executor = ONE_THREAD if threads == 1 else Executor(threads)
        self._lock = threading.RLock()
        self._basis: Optional[Basis] = None
        self._solver: Optional[Solver] = None
        self._problem: Optional[Mesh] = None  # at the start
        self._analysed: Any = None  # coordinates on which the curve was projected
        self._known: Any = None  # places on curves that are not found by projection
        self._moved: Any = None  # the movement of the mesh from there to the start; None: none; an Error: unknown
        self._lost: Optional[Error] = None  # why the wall was not on `curves` there
        self.solve_report: Optional[Report] = None
        if mesh is not None:
            x, y = mesh.points if isinstance(mesh.points, tuple) else mesh.points.T
            self._problem = mesh.with_points(np.stack([x, y], axis=1).astype(np.float64))
            self._problem._file = None
            self._analysed = self._problem.points

    def _ready(self) -> Solver:
        """The solver, made anew where it was released or the object was loaded; with a factor."""
        if self._solver is None:
            if self._problem is None:
                raise Error("This call needs the mesh; give it to Morph.load().", Error.BAD_BASIS)
            mesh = self._problem.with_points(self._analysed.copy())
            self._solver = Solver(mesh, self.curves, self._pairs, self._options, self._executor,
                                  self._fluxes, self._known)
            mesh.points[:] = self._problem.points
        self._solver.factor()
        return self._solver

    def _solve(self) -> None:
        solver, start, moved = self._ready(), self._problem.points, None
        basis, result = self._solved(solver, self._analysed)
        if basis.shape[0] and not np.array_equal(start, self._analysed):
            try:
                moved = basis.before = basis.recover(start)
            except Error as reason:
                moved = reason
                basis, result = self._solved(solver, start)
        self._set_basis(basis)
        self._moved, self.solve_report = moved, report(result)

    def _solved(self, solver: Solver, made: np.ndarray) -> Tuple[Basis, Any]:
        """Return functions on the coordinates of the solver, which has a factor, and their report.

        Movements are found again (:meth:`recover`) from the coordinates `made`, shape (n_points, 2).
        """
        start, points = solver.mesh.points.copy(), solver.mesh.points
        points[:] = made
        try:
            pointer, block = Basis.empty(solver.analysis)
        finally:
            points[:] = start
        result = new("hm_solve_report")
        if Basis(pointer, block).info.functions:
            call(lib.hm_plan_solve, solver.plan, pointer, result)
        return Basis(pointer, block), result

    def _set_basis(self, basis: Basis) -> None:
        self._basis = basis
        self.functions, self.n_points, self.info = basis.shape[0], basis.n_points, basis.info
        self.shared_points = basis.shared_points

    def _open(self) -> Basis:
        if self._basis is None:
            raise Error("This object was closed.", Error.BAD_BASIS)
        return self._basis

    @property
    def start(self) -> Optional[np.ndarray]:
        """Read-only view of the coordinates on which the functions were solved, shape (n_points, 2)."""
        if self._problem is None:
            return None
        view = self._problem.points.view()
        view.flags.writeable = False
        return view

    # ---- Curves ----

    def measure(self, *quantities: Any, move: Any = None, chord: Any = None, curves: Any = None) -> Measures:
        """Measure the section, with derivatives by the rows of `move`.

        Parameters
        ----------
        *quantities, chord, curves
            See :func:`harmorph.measures.measure`.
        move : array of shape (functions, 2), optional
            The section is measured after this movement from `start`.

        Returns
        -------
        Measures
            `gradients` has the shape (n, functions, 2); rows of rigid bodies are 0.

        Raises
        ------
        Error
            ``BAD_CURVE``: see :func:`harmorph.measures.measure`; ``BAD_MESH``: no movement leads the wall to
            `start`, so that the curves there are unknown.
        """
        section = self._curves()
        n_control = len(section.control)
        if move is not None:
            step = numbers(move, "move")
            if step.shape != (self.functions, 2):
                raise Error(f"move must have the shape {(self.functions, 2)}, not {step.shape}.")
            section = section.moved(step[:n_control])
        found = section.measure(*quantities, chord=chord, curves=curves)
        gradients = np.zeros((len(quantities), self.functions, 2))
        gradients[:, :n_control] = found.gradients
        return found._replace(gradients=gradients)

    def variables(self, kind: str, **options: Any) -> Variables:
        """Return design variables of the section at `start`; see :class:`harmorph.Variables`.

        Raises
        ------
        Error
            ``BAD_CURVE``; ``BAD_MESH``: see :meth:`measure`.
        """
        return self._curves().variables(kind, **options)

    def _curves(self) -> Curves:
        """The curves at `start`."""
        if self.curves is None:
            raise Error("This object has no curves.", Error.BAD_CURVE)
        moved = self._lost or self._moved
        if isinstance(moved, Error):
            raise Error(f"The curves at `start` are unknown: {moved.text}", moved.code, moved.kind, moved.item,
                        value=moved.value, place=moved.place)
        return self.curves if moved is None else self.curves.moved(moved[:len(self.curves.control)])

    # ---- Again, the end ----

    def solve(self, points: Any = None) -> None:
        """Solve again, on other coordinates of the mesh points, which become `start`.

        Functions of rigid bodies belong to the places of the bodies at the first analysis: a body that has
        rotated or changed its scale since then changes its size in a further rotation, unless
        :func:`harmorph.rigid` receives `before`.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays, optional
            A valid mesh [length]; the default is `start`. If it is refused, the object stays as it was. The
            movement of the curves to these points is found from the wall, for :meth:`measure` and
            :meth:`variables`; `curves` stays as it was.
        """
        with self._lock:
            self._open()
            solver, before = self._ready(), self._problem
            assert before is not None  # or _ready() has refused
            try:
                if points is not None:
                    _view, columns = points_in(points, self.n_points, "points")
                    at = points if isinstance(points, np.ndarray) else np.stack(columns, axis=1)
                    self._problem = before.with_points(at.astype(np.float64))
                    solver.mesh.points[:] = at
                    solver.has_factor = False
                self._solve()
            except Error:
                self._problem = before
                solver.mesh.points[:] = before.points
                solver.has_factor = False
                raise

    def release(self) -> None:
        """Free analysis and plan. Calls that need them make them again, which takes time."""
        with self._lock:
            self._solver = None

    def close(self) -> None:
        """Free everything. Later calls are refused; the memory of the basis is free."""
        with self._lock:
            self._solver = self._basis = None

    def __enter__(self) -> "Morph":
        return self

    def __exit__(self, *_ignored: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._basis is None:
            return "Morph(closed)"
        markers = ", ".join(f"{one.kind} {self._name(number)!r}" for number, one in self._pairs)
        shown = f", {markers}" if markers else ""
        return f"Morph({self.n_points} points, {self.functions} functions, {self.info.operator_kind}{shown})"

    def _name(self, marker: int) -> Any:
        return self.mesh.names.get(marker, marker) if self.mesh is not None else marker
