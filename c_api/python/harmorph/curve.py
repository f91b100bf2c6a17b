"""One B-spline of a set: its degree, its knots, the control points that it uses."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .arrays import numbers
from .errors import Error


class Curve(NamedTuple):
    """One B-spline of a set: C(u) = sum_k N_k(u) P[indices[k]].

    Parameters
    ----------
    degree : int
        1 to 5.
    knots : array of shape (n_indices + degree + 1,)
        Non-decreasing.
    indices : int array of shape (n_indices,)
        The control points of the curve, from 0. Repeated points close a curve.
    """

    degree: int
    knots: np.ndarray
    indices: np.ndarray

    @property
    def closed(self) -> str:
        """How the curve ends: "open", "tied" or "periodic"; see :class:`harmorph.Curves`."""
        if self.knots[0] != self.knots[self.degree]:
            return "periodic" if np.array_equal(self.indices[:self.degree], self.indices[-self.degree:]) else "open"
        return "tied" if self.indices[0] == self.indices[-1] else "open"


def frozen(values: Any, what: str, shape: tuple) -> np.ndarray:
    """Return a read-only copy as float64; a shape with -1 for any number is demanded."""
    array = np.array(numbers(values, what), dtype=np.float64, order="C")
    if array.ndim != len(shape) or any(s not in (-1, t) for s, t in zip(shape, array.shape)):
        raise Error(f"{what} must have the shape {str(shape).replace('-1', 'n')}, not {array.shape}.")
    array.flags.writeable = False
    return array


def uniform(n: int, degree: int, closed: str) -> Curve:
    """Return the curve with uniform knots of :class:`harmorph.Curves`."""
    if closed not in ("open", "tied", "periodic") or not 1 <= degree <= 5 or n <= degree:
        raise Error(f"A curve of degree {degree} with {n} control points that is {closed!r} is not "
                    "possible: the degree is 1 to 5 and less than the number of control points; the "
                    "curve is 'open', 'tied' or 'periodic'.", Error.BAD_CURVE)
    if closed == "periodic":
        indices = np.concatenate([np.arange(n), np.arange(degree)])
        return Curve(degree, np.arange(len(indices) + degree + 1.0), indices)
    indices = np.arange(n + 1) % n if closed == "tied" else np.arange(n)
    inner = np.linspace(0, 1, len(indices) - degree + 1)
    return Curve(degree, np.concatenate([[0.0] * degree, inner, [1.0] * degree]), indices)
