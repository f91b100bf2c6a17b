"""The quality of a mesh as smooth constraints of an optimiser, with derivatives by the mesh points.

:meth:`harmorph.Morph.adjoint` turns the derivatives into those by control points, and
:meth:`harmorph.Morph.displace_adjoint` into those by displacements of wall points.
"""

from __future__ import annotations

from typing import Any, List, NamedTuple

import numpy as np

from . import words
from ._native import ffi, lib
from .arrays import points_in
from .errors import MEMORY, Error, call, call_with_memory
from .reports import fill, new

_KINDS = words.kinds("quality", "kept_quality", "area", "height", "stretch", "angle", prefix="BOUND_")


class Bounds(NamedTuple):
    """Result of :meth:`Quality.bounds`, one entry for each bound that was named.

    Attributes
    ----------
    values : ndarray of shape (n,)
    extremes : ndarray of shape (n,)
        The smallest value of all cells or wall points; of "stretch" the largest one.
    items : int32 ndarray of shape (n,)
        The cell, or of "height", "stretch" and "angle" the wall point, with this value.
    gradients : ndarray of shape (n, n_points, 2)
        The exact derivatives of `values` by x and y of each mesh point [1/length].
    """

    values: np.ndarray
    extremes: np.ndarray
    items: np.ndarray
    gradients: np.ndarray


class Corners(NamedTuple):
    """Result of :meth:`Quality.corners`, the smallest step first.

    Attributes
    ----------
    steps : ndarray of shape (n,)
        The multiple of the displacement at which the area of the corner becomes 0.
    cells : int32 ndarray of shape (n,)
    points : int32 ndarray of shape (n, 3)
        The point before the corner, the corner, the point after the corner.
    by_points : ndarray of shape (n, 3, 2)
        Derivatives of the step by the coordinates of these points [1/length]. Those by their
        displacements are `step` times as large.
    """

    steps: np.ndarray
    cells: np.ndarray
    points: np.ndarray
    by_points: np.ndarray


class Quality:
    """The mesh of a morph at its start, with which moved meshes are compared.

    Parameters
    ----------
    morph : Morph
        With its mesh. The object stays valid when `morph` is closed or solved again.
    """

    def __init__(self, morph: Any) -> None:
        self._basis, self._mesh, self._executor = morph._open(), morph._problem, morph._executor
        if self._mesh is None:
            raise Error("This call needs the mesh; give it to Morph.load().", Error.BAD_BASIS)
        self._lock, self._n = morph._lock, morph.n_points
        quality = ffi.new("hm_quality**")
        self._block = call_with_memory(lib.hm_quality_init, quality, MEMORY, self._basis.pointer, self._mesh._c,
                                       ffi.NULL)
        self._quality = quality[0]

    def __repr__(self) -> str:
        return f"Quality({self._n} points)"

    def bounds(self, *kinds: Any, points: Any = None) -> Bounds:
        """Compute smooth bounds of the quality of the mesh, and their derivatives.

        Parameters
        ----------
        *kinds : str or tuple
            {"quality": HM_BOUND_QUALITY}
            {"kept_quality": HM_BOUND_KEPT_QUALITY}
            {"area": HM_BOUND_AREA}
            {"height": HM_BOUND_HEIGHT}
            {"stretch": HM_BOUND_STRETCH}
            {"angle": HM_BOUND_ANGLE}

            A tuple such as ("area", 500.0) names the sharpness rho, 1 to 1e6; the default is 200. The
            lower bound of values v_k is m - ln(sum_k exp(-rho (v_k - m))) / rho, m the smallest one.
        points : array of shape (n_points, 2), or pair of arrays, optional
            The mesh to judge; the default is the start.

        Returns
        -------
        Bounds
        """
        n = len(kinds)
        structs, values = ffi.new("hm_bound[]", max(n, 1)), ffi.new("hm_bound_value[]", max(n, 1))
        for struct, value, wanted in zip(structs, values, kinds):
            kind, sharpness = wanted if isinstance(wanted, tuple) and len(wanted) == 2 else (wanted, 0.0)
            if kind not in _KINDS:
                raise Error(f"The bound {kind!r} is unknown; known are {', '.join(_KINDS)}.")
            fill(ffi.addressof(struct), struct_size=ffi.sizeof("hm_bound"), kind=_KINDS[kind],
                 sharpness=sharpness)
            value.struct_size = ffi.sizeof("hm_bound_value")
        at, _alive = (ffi.NULL, None) if points is None else points_in(points, self._n, "points")
        gradients = np.empty((n, self._n, 2))
        memory = ffi.from_buffer("double[]", gradients)
        out = ffi.new("hm_points_out[]", [(memory + k, memory + k + 1, 2)
                                          for k in range(0, gradients.size, 2 * self._n)])
        with self._lock:
            call(lib.hm_quality_bounds, self._quality, at, n, structs, values, out, self._executor.view)
        found = list(values)[:n]
        return Bounds(np.array([one.bound for one in found]), np.array([one.extreme for one in found]),
                      np.array([one.item for one in found], np.int32), gradients)

    def corners(self, displacement: Any, points: Any = None, closeness: float = 1e-10) -> Corners:
        """Return the corners that limit the admissible step, with the derivatives of their steps.

        Parameters
        ----------
        displacement : array of shape (n_points, 2), or pair of arrays
        points : array of shape (n_points, 2), or pair of arrays, optional
            Coordinates from which the points move; the default is the start.
        closeness : float
            Corners count whose step is at most 1 + closeness times the smallest one, 0 to 1.

        Returns
        -------
        Corners
            Without entries if nothing limits the step.
        """
        view, _alive = points_in(displacement, self._n, "displacement")
        from_, _alive_too = (ffi.NULL, None) if points is None else points_in(points, self._n, "points")
        n, room = ffi.new("int32_t*"), 0
        while room == 0 or n[0] > room:
            room = max(16, n[0])
            found = ffi.new("hm_step_corner[]", room)
            with self._lock:
                call(lib.hm_step_gradient, self._basis.pointer, self._mesh._c, from_, view, closeness, room,
                     found, n, self._executor.view)
        listed: List[Any] = [found[k] for k in range(n[0])]
        return Corners(np.array([one.step for one in listed]),
                       np.array([one.cell for one in listed], np.int32),
                       np.array([list(one.points) for one in listed], np.int32).reshape(-1, 3),
                       np.array([list(one.by_from) for one in listed]).reshape(-1, 3, 2))
