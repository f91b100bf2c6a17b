"""Design variables: linear maps from a few numbers to the control points."""

from __future__ import annotations

from typing import Any, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, numbers
from .errors import MEMORY, Error, call, call_with_memory
from .measures import section_of
from .reports import fill, new, pair
from .words import kinds

_KINDS = kinds("ffd", "cst", "hicks_henne", "naca4")


class Variables:
    """Design variables of the section that curves enclose.

    Made by :meth:`harmorph.Curves.variables` and :meth:`harmorph.Morph.variables`.

    Parameters
    ----------
    kind : str
        {"ffd": HM_FFD}
        {"cst": HM_CST}
        {"hicks_henne": HM_HICKS_HENNE}
        {"naca4": HM_NACA4}
    n_upper, n_lower : int
        Variables of the upper and the lower side, 0 to 64.
    degrees : pair of int
        "ffd": degrees of the box along x and y, 0 to 63.
    box : pair of points, optional
        "ffd": the lower left and the upper right corner [length]; the default is the box of the
        control points, 5 % larger.
    peaks : array of shape (n_upper + n_lower,), optional
        "hicks_henne", "naca4": stations between 0 and 1.
    exponents : pair of float, optional
        "cst": of the leading and the trailing edge, 0 to 10; the default is (0.5, 1).
    width : float, optional
        "hicks_henne": exponent of the sine, 1 to 100; the default is 3.
    chord, curves
        As in :func:`harmorph.measures.measure`.

    Attributes
    ----------
    matrix : complex ndarray of shape (n_control, n)
        One unit of variable j moves control point i by ``matrix[i, j]``, x + i y [length].
    kind : str
    n : int
        The number of variables.
    components : int
        2 for "ffd", whose variables are vectors; otherwise 1.
    error : ndarray of shape (n, 2)
        Root mean square and largest difference between the wanted movement of the outline and that
        of the B-spline [length], for one unit of each variable.

    Raises
    ------
    Error
        ``BAD_CONDITION``: the variable `item` moves nothing, or is a combination of those before.
    """

    def __init__(
        self,
        view: Any,
        n_control: int,
        kind: str,
        *,
        n_upper: int = 0,
        n_lower: int = 0,
        degrees: Tuple[int, int] = (0, 0),
        box: Any = None,
        peaks: Any = None,
        exponents: Tuple[float, float] = (0.0, 0.0),
        width: float = 0.0,
        chord: Any = None,
        curves: Any = None,
    ) -> None:
        if kind not in _KINDS:
            raise Error(f"The kind of variables {kind!r} is unknown; known are {list(_KINDS)}.")
        struct = new("hm_variables")
        degree_x, degree_y = pair(degrees, "degrees")
        leading, trailing = pair(exponents, "exponents")
        fill(struct, kind=_KINDS[kind], n_upper=n_upper, n_lower=n_lower, degree_x=degree_x,
             degree_y=degree_y, leading_exponent=leading, trailing_exponent=trailing, width=width)
        if box is not None:
            low, high = (pair(corner, "A corner of the box") for corner in pair(box, "box"))
            fill(struct, x_min=low[0], y_min=low[1], x_max=high[0], y_max=high[1])
        if peaks is not None:
            stations = numbers(peaks, "peaks")
            places = doubles(stations, (n_upper + n_lower,), "peaks")
            struct.peaks = places
        section, found, memory = section_of(chord, curves), new("hm_section_move"), ffi.new("hm_memory*")
        movement = fill(new("hm_movement"), kind=lib.HM_LINEAR, variables=struct)
        call(lib.hm_move_section, view, section, 1, movement, ffi.NULL, found, memory)
        self.kind = kind
        self.n: int = found.n_variables
        self.components = 2 if kind == "ffd" else 1
        self.matrix = np.empty((n_control, self.n), np.complex128)
        self.error = np.empty((self.n, 2))
        fill(found, matrix=ffi.from_buffer("double[]", self.matrix),
             unit_errors=ffi.from_buffer("double[]", self.error))
        call_with_memory(lib.hm_move_section, view, section, 1, movement, ffi.NULL, found, MEMORY)

    def __repr__(self) -> str:
        return f"Variables({self.kind!r}, n={self.n})"

    def move(self, values: Any) -> np.ndarray:
        """Return the movement of the control points, shape (n_control, 2), for values of the variables.

        Parameters
        ----------
        values : array of shape (n,), or (n, 2) for "ffd"
        """
        array = numbers(values, "values")
        if array.shape != self.shape:
            raise Error(f"values must have the shape {self.shape}, not {array.shape}.")
        moved = self.matrix @ (array[:, 0] + 1j * array[:, 1] if self.components == 2 else array)
        return np.stack([moved.real, moved.imag], axis=1)

    def gradient(self, gradient: Any) -> np.ndarray:
        """Return derivatives by the variables from those by the control points: the transpose.

        Parameters
        ----------
        gradient : array of shape (n_control, 2)

        Returns
        -------
        ndarray of shape (n,), or (n, 2) for "ffd"
        """
        array = numbers(gradient, "gradient")
        if array.shape != (len(self.matrix), 2):
            raise Error(f"gradient must have the shape {(len(self.matrix), 2)}, not {array.shape}.")
        result = self.matrix.conj().T @ (array[:, 0] + 1j * array[:, 1])
        return np.stack([result.real, result.imag], axis=1) if self.components == 2 else result.real

    @property
    def shape(self) -> Tuple[int, ...]:
        """The shape of the values: (n,), or (n, 2) for "ffd"."""
        return (self.n, 2) if self.components == 2 else (self.n,)
