"""Fits of B-splines, as the library makes them: curves in a block, and a report."""

from __future__ import annotations

from typing import Any, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, int32_view, numbers, points_in
from .errors import MEMORY, Error, call_with_memory
from .mesh import Mesh
from .reports import Report, fill, new, pair, report
from .words import CLOSED


def fit_markers(
    mesh: Mesh, markers: Any, n_control: int, degree: int, closed: str, **details: Any
) -> Tuple[Any, Report, np.ndarray]:
    """Return ``hm_curves*`` through the points of markers, the report, and the block of the curves.

    The arguments are those of :meth:`harmorph.Curves.fit`.
    """
    options, _alive = _options(n_control, degree, closed, **details)
    result = new("hm_fit_report")
    wanted = np.array(mesh.numbers_of(markers), np.int32)
    found = ffi.new("hm_curves**")
    block = call_with_memory(lib.hm_fit_marker, found, MEMORY, mesh._c, len(wanted), int32_view(wanted), options,
                             result, names=mesh.names)
    return found[0], report(result), block


def fit_in_order(
    points: Any, is_loop: bool, n_control: int, degree: int, closed: str, **details: Any
) -> Tuple[Any, Report, np.ndarray]:
    """Return the same through points in order; see :meth:`harmorph.Curves.fit_points`."""
    n = len(points[0]) if isinstance(points, tuple) and len(points) else len(points)
    view, _alive = points_in(points, n, "points")
    options, _alive_too = _options(n_control, degree, closed, **details)
    result = new("hm_fit_report")
    found = ffi.new("hm_curves**")
    block = call_with_memory(lib.hm_fit, found, MEMORY, view, n, bool(is_loop), options, result)
    return found[0], report(result), block


def _options(
    n_control: int, degree: int, closed: str, *, weights: Any, smoothing: float, tolerance: float, begin: Any, end: Any
) -> Tuple[Any, Any]:
    """``hm_fit_options*``, and what must stay alive with it."""
    if closed not in CLOSED:
        raise Error(f"closed must be one of {list(CLOSED)}, not {closed!r}.")
    options = fill(new("hm_fit_options"), n_control=n_control, degree=degree, closed=CLOSED[closed])
    (begin_x, begin_y), (end_x, end_y) = pair(begin, "begin"), pair(end, "end")
    details = fill(new("hm_fit_details"), smoothing=smoothing, tolerance=tolerance, begin_x=begin_x,
                   begin_y=begin_y, end_x=end_x, end_y=end_y)
    values = None
    if weights is not None:
        array = numbers(weights, "weights")
        values = doubles(array, (array.size,), "weights")
        details.weights, details.n_weights = values, array.size
    options.details = details
    return options, (details, values)
