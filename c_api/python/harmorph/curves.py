"""B-spline curves with common control points."""

from __future__ import annotations

from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import airfoil_file
from . import pictures as _pictures
from .arrays import doubles, int32_view, int32s, numbers
from .curve import Curve, frozen, uniform
from .errors import Error, call
from .fit import fit_in_order, fit_markers
from .boundary import Marker
from .mesh import Mesh
from .reports import Report, new, pair
from .shapes import Shapes
from ._native import ffi, lib


class Curves(Shapes):
    """B-spline curves with common control points.

    Parameters
    ----------
    control : array of shape (n_control, 2)
        Control points [length]; copied.
    degree : int
        1 to 5, of a single curve; ignored if `curves` is given.
    closed : {"open", "tied", "periodic"}
        How a single curve with uniform knots ends:

        {"open": HM_OPEN}
        {"tied": HM_TIED}
        {"periodic": HM_PERIODIC}
    curves : sequence of Curve, optional
        The curves with their own knots and indices.
    weights : array of shape (n_control,), optional
        Weights of rational curves, 1e-10 to 1e10.

    Attributes
    ----------
    control : ndarray of shape (n_control, 2)
        Read-only.
    weights : ndarray of shape (n_control,) or None
    curves : tuple of Curve
    markers : tuple of marker
        The markers that :meth:`fit` was given; :class:`harmorph.Morph` puts them onto the curves.
    fit_report : Report or None
        Of curves that were fitted:

        {members of hm_fit_report}

    Raises
    ------
    Error
        ``BAD_CURVE``: degree, knots, indices, weights or control points that form no curve.
    """

    def __init__(
        self,
        control: Any,
        degree: int = 3,
        closed: str = "open",
        *,
        curves: Optional[Sequence[Curve]] = None,
        weights: Any = None,
    ) -> None:
        self.control = frozen(control, "The control points", (-1, 2))
        self.weights = None if weights is None else frozen(weights, "The weights", (len(self.control),))
        if curves is None:
            curves = [uniform(len(self.control), degree, closed)]
        self.curves: Tuple[Curve, ...] = tuple(
            Curve(int(one[0]), frozen(one[1], "The knots", (-1,)), int32s(one[2], "The indices"))
            for one in curves
        )
        self.markers: Tuple[Marker, ...] = ()
        self.fit_report: Optional[Report] = None
        self._view()
        call(lib.hm_curves_check, self._c)

    def _view(self) -> None:
        views = ffi.new("hm_curve[]", len(self.curves))
        alive: List[Any] = [views]
        for view, one in zip(views, self.curves):
            if len(one.knots) != len(one.indices) + one.degree + 1:
                raise Error(f"A curve of degree {one.degree} with {len(one.indices)} indices needs "
                            f"{len(one.indices) + one.degree + 1} knots, not {len(one.knots)}.",
                            Error.BAD_CURVE)
            view.struct_size = ffi.sizeof("hm_curve")
            view.degree, view.n_indices = one.degree, len(one.indices)
            view.indices, view.knots = int32_view(one.indices), ffi.from_buffer("double[]", one.knots)
        struct = new("hm_curves")
        struct.n_control = len(self.control)
        struct.control = doubles(self.control, self.control.shape, "control")
        if self.weights is not None:
            struct.weights = doubles(self.weights, self.weights.shape, "weights")
        struct.n_curves, struct.curve = len(self.curves), views
        self._c, self._alive = struct, alive

    # ---- Other ways to make curves ----

    @classmethod
    def fit(
        cls,
        mesh: Mesh,
        markers: Union[Marker, Iterable[Marker]],
        n_control: int = 20,
        degree: int = 3,
        closed: str = "auto",
        *,
        weights: Any = None,
        smoothing: float = 0.0,
        tolerance: float = 0.0,
        begin: Any = (0.0, 0.0),
        end: Any = (0.0, 0.0),
    ) -> "Curves":
        """Fit curves to the points of markers of a mesh, each connected piece by its own.

        Parameters
        ----------
        mesh : Mesh
        markers : marker or sequence of markers
        n_control : int
            Control points of each piece.
        degree : int
            1 to 5.
        closed : {"auto", "open", "tied", "periodic"}
            How the curve ends, as in :class:`Curves`; `fit_report.closed` tells what was taken.

            {"auto": HM_CLOSED_AUTO}
        weights : array of shape (n_points,), optional
            >= 0: factors of the points in the sum of squares, besides the share of the arc length; the
            default is 1. A point with weight 0 only tells where the curve runs.
        smoothing : float
            Waves much shorter than this are damped; corners stay [length].
        tolerance : float
            Control points are inserted, at most `n_control`, until no point is farther from the curve
            than this [length]; 0: the curve has `n_control` points.
        begin, end : pairs of float
            Directions of the curve where it begins and ends, of any length; (0, 0): free. Not for
            periodic curves.

        Warns
        -----
        HarmorphWarning
            ``BACKTRACKS``: the curve runs against the order of the points; use fewer control points.
            ``FAR_FROM_POINTS``: the points are farther from the curve than `tolerance`.
        """
        one = isinstance(markers, (str, int, np.integer))
        names: tuple = (markers,) if one else tuple(markers)  # type: ignore
        found, result, _block = fit_markers(mesh, names, n_control, degree, closed, weights=weights,
                                            smoothing=smoothing, tolerance=tolerance, begin=begin, end=end)
        curves = cls._copied(found)
        curves.markers, curves.fit_report = names, result
        return curves

    @classmethod
    def fit_points(
        cls,
        points: Any,
        is_loop: bool,
        n_control: int = 20,
        degree: int = 3,
        closed: str = "auto",
        *,
        weights: Any = None,
        smoothing: float = 0.0,
        tolerance: float = 0.0,
        begin: Any = (0.0, 0.0),
        end: Any = (0.0, 0.0),
    ) -> "Curves":
        """Fit curves to points in order.

        Parameters
        ----------
        points : array of shape (n, 2), or pair of arrays of shape (n,)
        is_loop : bool
            The last point is connected to the first one, which is not repeated.
        n_control, degree, closed, weights, smoothing, tolerance, begin, end
            See :meth:`fit`; `weights` has one number for each of the points.
        """
        found, result, _block = fit_in_order(points, is_loop, n_control, degree, closed, weights=weights,
                                             smoothing=smoothing, tolerance=tolerance, begin=begin, end=end)
        curves = cls._copied(found)
        curves.fit_report = result
        return curves

    @classmethod
    def read_airfoil(
        cls, path: Any, n_control: int = 20, degree: int = 3, closed: str = "auto", element: int = 0
    ) -> "Curves":
        """Fit curves to an airfoil file of any layout that ``harmorph fit`` reads; see :meth:`fit`.

        `element` chooses one section of a file with several, from 1.
        """
        return cls.fit_points(airfoil_file.read(path, element), True, n_control, degree, closed)

    @classmethod
    def _copied(cls, view: Any) -> "Curves":
        """A copy of what a ``hm_curves*`` of the library points to."""
        curves = []
        for k in range(view.n_curves):
            one = view.curve[k]
            n = one.n_indices
            indices = (np.arange(n) if one.indices == ffi.NULL
                       else np.frombuffer(ffi.buffer(one.indices, 4 * n), np.int32) - view.index_base)
            knots = np.frombuffer(ffi.buffer(one.knots, 8 * (n + one.degree + 1)))
            curves.append(Curve(one.degree, knots, indices))
        control = np.frombuffer(ffi.buffer(view.control, 16 * view.n_control)).reshape(-1, 2)
        has_weights = view.weights != ffi.NULL
        weights = np.frombuffer(ffi.buffer(view.weights, 8 * view.n_control)) if has_weights else None
        return cls(control, curves=curves, weights=weights)

    # ---- Questions ----

    def moved(self, move: Any) -> "Curves":
        """Return the curves with control points moved by `move` [length], shape (n_control, 2)."""
        step = numbers(move, "move")
        if step.shape != self.control.shape:
            raise Error(f"move must have the shape {self.control.shape}, not {step.shape}.")
        curves = Curves(self.control + step, curves=self.curves, weights=self.weights)
        curves.markers = self.markers
        return curves

    def points(self, u: Any, curve: int = 0, derivative: int = 0) -> np.ndarray:
        """Return points of a curve, or derivatives by the parameter.

        Parameters
        ----------
        u : array of shape (n,), or float
            Parameters in the :meth:`range` of the curve. Those of wall points: :meth:`project`.
        curve : int
            From 0.
        derivative : int
            0 to 5.

        Returns
        -------
        ndarray of shape (n, 2), or (2,) of one parameter
        """
        parameters, xy = numbers(u, "u"), ffi.new("double[12]")
        result = np.empty((parameters.size, 2))
        for row, parameter in zip(result, parameters.flat):
            call(lib.hm_curve_point, self._c, curve, float(parameter), derivative, xy)
            row[:] = xy[2 * derivative], xy[2 * derivative + 1]
        return result.reshape(*parameters.shape, 2)

    def basis(self, u: Any, curve: int = 0) -> np.ndarray:
        """Return the basis functions at parameters of a curve.

        Parameters
        ----------
        u : array of shape (n,)
        curve : int
            From 0.

        Returns
        -------
        ndarray of shape (n, n_control)
            Row k times the control points is the point of the curve at ``u[k]``.
        """
        parameters = np.atleast_1d(numbers(u, "u")).astype(float)
        result = np.zeros((len(parameters), len(self.control)))
        control, values = ffi.new("int32_t[6]"), ffi.new("double[6]")
        for row, parameter in zip(result, parameters):
            call(lib.hm_curve_basis, self._c, curve, parameter, 0, control, values)
            for k in range(self._curve(curve).degree + 1):
                row[control[k]] += values[k]
        return result

    def range(self, curve: int = 0) -> Tuple[float, float]:
        """Return the first and the last parameter of a curve."""
        one = self._curve(curve)
        return float(one.knots[one.degree]), float(one.knots[len(one.indices)])

    def _curve(self, curve: int) -> Curve:
        if not 0 <= curve < len(self.curves):
            raise Error(f"There is no curve {curve}; the set has {len(self.curves)}, counted from 0.")
        return self.curves[curve]

    def project(self, point: Any, curve: int = 0) -> Tuple[Any, Any]:
        """Return the parameters of the curve points nearest to points, and the distances [length].

        Parameters
        ----------
        point : pair of float, or array of shape (n, 2)
            For instance ``mesh.points[mesh.wall("wall")[0]]``.
        curve : int
            From 0.

        Returns
        -------
        u, distance : floats, or ndarrays of shape (n,)
        """
        if np.ndim(point) == 2:
            found = np.array([self.project(one, curve) for one in point]).reshape(-1, 2)
            return found[:, 0], found[:, 1]
        u, distance = ffi.new("double*"), ffi.new("double*")
        x, y = pair(point, "point")
        call(lib.hm_curve_project, self._c, curve, x, y, u, distance)
        return u[0], distance[0]

    # ---- Pictures, copies ----

    def _repr_svg_(self) -> str:
        return _pictures.curves_svg(self)

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draw the curves and their control points by matplotlib.

        ``curves.moved(move).plot(axes, color="r")`` adds the curves after a movement.

        Parameters
        ----------
        ax : matplotlib axes, optional
            The default is ``matplotlib.pyplot.gca()``.
        **style
            Passed to ``plot`` of the axes for the curves, for instance ``c="r"``, ``lw=3``. A colour is
            also that of the control points.

        Returns
        -------
        matplotlib axes
            ``matplotlib.pyplot.show()`` shows them, ``axes.figure.savefig("curves.png")`` writes a file.
        """
        return _pictures.plot_curves(self, ax, style)

    def __copy__(self) -> "Curves":
        other = Curves.__new__(Curves)
        other.__setstate__(self.__getstate__())
        return other

    def __getstate__(self) -> Dict[str, Any]:
        return {key: value for key, value in self.__dict__.items() if key not in ("_c", "_alive")}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        # Arrays that were copied or pickled can be written.
        for array in (self.control, self.weights, *(one.knots for one in self.curves)):
            if array is not None:
                array.flags.writeable = False
        self._view()

    def __repr__(self) -> str:
        shown = f", fitted to {list(self.markers)}" if self.markers else ""
        each = " and ".join(f"{one.closed} of degree {one.degree}" for one in self.curves)
        return f"Curves({len(self.control)} control points, {each}{shown})"
