"""Shapes of a section: measures, design variables, movements, other airfoils, more control points."""

from __future__ import annotations

from typing import Any, NamedTuple, Sequence, Tuple, Type, TypeVar

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, numbers, points_in
from .errors import MEMORY, Error, call, call_with_memory
from .measures import Measures, measure, section_of
from .reports import Report, fill, new, pair, report
from .variables import Variables
from .words import kinds

_MOVEMENTS = kinds("rotate", "shift", "scale", "flap", "camber_thickness", "parsec", "blade")
Self = TypeVar("Self", bound="Shapes")


class _Movement(NamedTuple):
    kind: str
    centre: Tuple[float, float] = (0.0, 0.0)
    length: float = 0.0
    n_camber: int = 0
    n_thickness: int = 0


class Movement(_Movement):
    """A movement of a section by values v0, v1, ... Every value is a change, and 0 moves nothing.

    Parameters
    ----------
    kind : str
        With (x, y) the `centre`; angles are positive counter-clockwise:

        {"rotate": HM_ROTATE}
        {"shift": HM_SHIFT}
        {"scale": HM_SCALE}
        {"flap": HM_FLAP}
        {"camber_thickness": HM_CAMBER_THICKNESS}
        {"parsec": HM_PARSEC}
        {"blade": HM_BLADE}
    centre : pair of float
        The centre of "rotate", "scale" and "blade"; the hinge of "flap" [length].
    length : float
        "flap": behind this length the section moves as a rigid body; 0 means a tenth of the chord.
    n_camber, n_thickness : int
        "camber_thickness": the numbers of values, 0 to 64.

    Raises
    ------
    Error
        An unknown kind, or a centre that is no pair of numbers.
    """

    def __new__(
        cls,
        kind: str,
        centre: Tuple[float, float] = (0.0, 0.0),
        length: float = 0.0,
        n_camber: int = 0,
        n_thickness: int = 0,
    ) -> "Movement":
        if not isinstance(kind, str) or kind not in _MOVEMENTS:
            raise Error(f"The movement {kind!r} is unknown; known are {list(_MOVEMENTS)}.")
        movement = super().__new__(cls, kind, centre, length, n_camber, n_thickness)
        pair(movement.centre, "centre")
        return movement


class Moved(NamedTuple):
    """Result of :meth:`harmorph.Curves.move_section`.

    Attributes
    ----------
    move : ndarray of shape (n_control, 2)
        The movement of the control points [length].
    derivatives : ndarray of shape (n, n_control, 2)
        The exact derivatives of `move` by the values.
    start : ndarray of shape (n,)
        The values that the given curves have: parameters of "parsec", angles of "blade", otherwise 0.
    error : ndarray of shape (2,)
        Root mean square and largest difference from the wanted movement of the outline [length].
    """

    move: np.ndarray
    derivatives: np.ndarray
    start: np.ndarray
    error: np.ndarray


class Shapes:
    """Methods of :class:`harmorph.Curves` for the design of a section."""

    control: np.ndarray
    markers: tuple
    _c: Any

    def measure(self, *quantities: Any, chord: Any = None, curves: Any = None) -> Measures:
        """Measure a section; see :func:`harmorph.measures.measure`."""
        return measure(self._c, len(self.control), quantities, chord, curves)

    def variables(self, kind: str, **options: Any) -> Variables:
        """Return design variables of the section; see :class:`harmorph.Variables`."""
        return Variables(self._c, len(self.control), kind, **options)

    def smooth_gradient(self, gradient: Any, length: float) -> np.ndarray:
        """Smooth a gradient by the control points along the curves.

        Parameters
        ----------
        gradient : array of shape (n_control, 2)
        length : float
            Changes along less than this length are damped [length].

        Returns
        -------
        ndarray of shape (n_control, 2)
            Its product with `gradient` is positive.
        """
        result = np.empty_like(self.control)
        call_with_memory(lib.hm_smooth_gradient, self._c, length, doubles(gradient, self.control.shape, "gradient"),
                         doubles(result, result.shape, "result", out=True), MEMORY)
        return result

    def move_section(
        self, movements: Sequence[Movement], values: Any = None, *, chord: Any = None, curves: Any = None
    ) -> Moved:
        """Rotate, shift or scale a section, deflect a flap, change PARSEC parameters or metal angles.

        Parameters
        ----------
        movements : sequence of Movement
            1 to 64, which are applied in their order.
        values : array of shape (n,), optional
            The values of all movements, one movement after the other; the default is 0.
        chord, curves
            As in :func:`harmorph.measures.measure`.

        Returns
        -------
        Moved
        """
        structs = ffi.new("hm_movement[]", max(len(movements), 1))
        structs[0].struct_size = ffi.sizeof("hm_movement")
        for struct, one in zip(structs, movements):
            wanted = Movement(*one)
            x, y = pair(wanted.centre, "centre")
            fill(ffi.addressof(struct), struct_size=ffi.sizeof("hm_movement"), kind=_MOVEMENTS[wanted.kind],
                 n_camber=wanted.n_camber, n_thickness=wanted.n_thickness, x=x, y=y, length=wanted.length)
        section, found, memory = section_of(chord, curves), new("hm_section_move"), ffi.new("hm_memory*")
        call(lib.hm_move_section, self._c, section, len(movements), structs, ffi.NULL, found, memory)
        n = found.n_values
        given = doubles(np.zeros(n) if values is None else values, (n,), "values")
        shape = self.control.shape
        result = Moved(np.empty(shape), np.empty((n, *shape)), np.empty(n), np.empty(2))
        found.move, found.derivatives, found.start, _error = (
            doubles(one, one.shape, "result", out=True) for one in result)
        call_with_memory(lib.hm_move_section, self._c, section, len(movements), structs, given, found, MEMORY)
        result.error[:] = found.error[0], found.error[1]
        return result

    def refit(
        self, points: Any, is_loop: bool = True, *, on_chord: bool = False, curve: int = 0
    ) -> Tuple[np.ndarray, Report]:
        """Return the movement of the control points that makes the section another airfoil.

        Parameters
        ----------
        points : array of shape (n, 2), or pair of arrays of shape (n,)
            Points in order along the outline of the other airfoil, in either direction.
        is_loop : bool
            The last point is connected to the first one, which is not repeated.
        on_chord : bool
            The points are first rotated, scaled and translated onto the chord of the curve.
        curve : int
            From 0; the following curve may be its blunt base.

        Returns
        -------
        move : ndarray of shape (n_control, 2)
        report : Report
            {members of hm_refit_report}
        """
        n = len(points[0]) if isinstance(points, tuple) else len(points)
        view, _alive = points_in(points, n, "points")
        result, move = new("hm_refit_report"), np.empty_like(self.control)
        call_with_memory(lib.hm_refit, self._c, curve, view, n, bool(is_loop), bool(on_chord),
                         doubles(move, move.shape, "move", out=True), result, MEMORY)
        return move, report(result)

    def family_modes(self, movements: Any) -> Tuple[np.ndarray, np.ndarray]:
        """Return the modes of movements, such as those of :meth:`refit` for a family of airfoils.

        Parameters
        ----------
        movements : array of shape (n, n_control, 2)

        Returns
        -------
        modes : ndarray of shape (n, n_control, 2)
            Orthonormal movements [length], the most important one first: linear design variables.
        singular : ndarray of shape (n,)
            Singular values [length], descending.
        """
        modes = np.array(numbers(movements, "movements"), np.float64, order="C")
        if modes.ndim != 3 or modes.shape[1:] != self.control.shape:
            raise Error(f"movements must have the shape (n, {len(self.control)}, 2), not {modes.shape}.")
        members, singular = modes.copy(), np.empty(len(modes))
        found = fill(new("hm_section_move"), derivatives=ffi.from_buffer("double[]", modes))
        family = fill(new("hm_movement"), kind=lib.HM_FAMILY, n_members=len(members),
                      members=ffi.from_buffer("double[]", members), singular=ffi.from_buffer("double[]", singular))
        call_with_memory(lib.hm_move_section, self._c, ffi.NULL, 1, family, ffi.NULL, found, MEMORY)
        return modes, singular

    def refined(
        self: Self, knots: Any = (), *, degree: int = 0, curve: int = 0
    ) -> Tuple[Self, np.ndarray]:
        """Return the same curves with more control points.

        Parameters
        ----------
        knots : array of shape (n,)
            Parameters at which knots are inserted.
        degree : int
            The degree of the curve plus 1 raises the degree, without `knots`; 0 keeps the degree.
        curve : int
            From 0.

        Returns
        -------
        curves : Curves
        matrix : ndarray of shape (new n_control, n_control)
            Its product with old control points or movements are the new ones; its transpose turns
            derivatives by the new ones into those by the old ones.
        """
        u = numbers(knots, "knots").astype(np.float64)
        finer, matrix = ffi.new("hm_curves**"), ffi.new("double**")
        places = doubles(u, (u.size,), "knots") if u.size else ffi.NULL
        _block = call_with_memory(lib.hm_refine, finer, matrix, MEMORY, self._c, curve, degree, u.size, places)
        curves = self._copied(finer[0])
        curves.markers = self.markers
        shape = (len(curves.control), len(self.control))
        return curves, np.frombuffer(ffi.buffer(matrix[0], 8 * shape[0] * shape[1])).reshape(shape).copy()

    @classmethod
    def _copied(cls: Type[Self], view: Any) -> Self:
        raise NotImplementedError
