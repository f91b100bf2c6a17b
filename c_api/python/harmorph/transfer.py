"""Fields of one mesh on another: interpolation with its transpose, and means that keep integrals."""

from __future__ import annotations

from typing import Any, NamedTuple, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, numbers, points_in
from .errors import MEMORY, Error, call, call_with_memory
from .mesh import Mesh
from .reports import Report, new, report
from .threads import ONE_THREAD


class Interpolation:
    """The places of points in a mesh, and the weights of the mesh points there.

    Parameters
    ----------
    mesh : Mesh
        The mesh that has the fields, at its coordinates now.
    to : array of shape (n, 2), or pair of arrays of shape (n,)
        Any points, such as those of another mesh.

    Attributes
    ----------
    distance : ndarray of shape (n,)
        How far each point is outside the mesh [length]; 0 inside.
    report : Report
        {members of hm_interpolation_report}
    """

    def __init__(self, mesh: Mesh, to: Any) -> None:
        n = len(to[0]) if isinstance(to, tuple) else len(to)
        view, _alive = points_in(to, n, "to")
        analysis, _block = mesh._analysis()
        made, self.distance = ffi.new("hm_interpolation**"), np.empty(n)
        result = new("hm_interpolation_report")
        self._block = call_with_memory(lib.hm_interpolation_init, made, MEMORY, analysis, ffi.NULL, n, view,
                                       ffi.from_buffer("double[]", self.distance), ONE_THREAD.view, result)
        self._made, self._shape = made[0], (mesh.n_points, n)
        self.report: Report = report(result)

    def __repr__(self) -> str:
        return f"Interpolation({self._shape[0]} points to {self._shape[1]})"

    def __call__(self, fields: Any) -> np.ndarray:
        """Return the values at the points.

        Parameters
        ----------
        fields : array of shape (n_points,) or (n_fields, n_points)
            Values at the points of the mesh. Outside the mesh, those of the nearest place are taken.

        Returns
        -------
        ndarray of shape (n,) or (n_fields, n)
        """
        values, shape = _fields(fields, self._shape[0], "fields")
        result = np.empty((*shape, self._shape[1]))
        call(lib.hm_interpolate, self._made, shape[0] if shape else 1, values,
             ffi.from_buffer("double[]", result), ONE_THREAD.view)
        return result

    def adjoint(self, dj: Any) -> np.ndarray:
        """Return derivatives by the fields from those by the values at the points: the transpose.

        Parameters
        ----------
        dj : array of shape (n,) or (n_fields, n)

        Returns
        -------
        ndarray of shape (n_points,) or (n_fields, n_points)
        """
        values, shape = _fields(dj, self._shape[1], "dj")
        result = np.zeros((*shape, self._shape[0]))
        call(lib.hm_interpolate_adjoint, self._made, shape[0] if shape else 1, values,
             ffi.from_buffer("double[]", result))
        return result


def _fields(fields: Any, n: int, what: str) -> Tuple[Any, tuple]:
    """A view of one field or several, and the shape before the points."""
    array = numbers(fields, what)
    if array.ndim not in (1, 2) or array.shape[-1] != n:
        raise Error(f"{what} must have the shape ({n},) or (fields, {n}), not {array.shape}.")
    return doubles(array, array.shape, what), array.shape[:-1]
