"""Measures of a section, with their derivatives by the control points."""

from __future__ import annotations

from typing import Any, NamedTuple, Sequence

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, numbers
from .errors import Error, call
from .reports import fill, new, pair
from .words import kinds

_KINDS = kinds(
    "area", "centroid_x", "centroid_y", "moment_xx", "moment_yy", "moment_xy", "chord", "thickness", "camber",
    "max_thickness", "max_camber", "leading_edge_radius", "trailing_edge_angle", "trailing_edge_gap", "min_radius",
    "curvature_variation", "clearance", "twist", "min_thickness", "distance",
)
# The members of hm_quantity that follow the name in a tuple, and how many of them are required.
_MEMBERS = {
    "thickness": (("station",), 1),
    "camber": (("station",), 1),
    "clearance": (("polygon", "sharpness"), 1),
    "min_thickness": (("station", "last_station", "sharpness"), 2),
    "distance": (("other_curve", "n_other", "sharpness"), 2),
}


class Measures(NamedTuple):
    """Results of :func:`measure`.

    Attributes
    ----------
    values : ndarray of shape (n,)
    gradients : ndarray of shape (n, n_control, 2)
        Derivatives by x and y of the control points, at constant weights. Those of
        :meth:`harmorph.Morph.measure` have a row for each function.
    places : ndarray of shape (n, 2)
        The point of the section to which each value belongs [length].
    """

    values: np.ndarray
    gradients: np.ndarray
    places: np.ndarray


def section_of(chord: Any, curves: Any) -> Any:
    """Return an ``hm_section*``, or NULL for all curves with their own chord."""
    if chord is None and curves is None:
        return ffi.NULL
    section = new("hm_section")
    if curves is not None:
        first, n = pair(curves, "curves")
        fill(section, first_curve=first, n_curves=n)
    if chord is not None:
        leading, trailing = (pair(end, "An end of the chord") for end in pair(chord, "chord"))
        fill(section, leading_x=leading[0], leading_y=leading[1], trailing_x=trailing[0],
             trailing_y=trailing[1])
    return section


def _written(name: str) -> str:
    members, least = _MEMBERS.get(name, ((), 0))
    if not members:
        return repr(name)
    rest = "".join(f" [, {member}]" for member in members[least:])
    return f"({name!r}, {', '.join(members[:least])}{rest})"


def measure(view: Any, n_control: int, quantities: Sequence[Any], chord: Any, curves: Any) -> Measures:
    """Measure the section that curves enclose.

    Parameters
    ----------
    quantities : str or tuple
        A station is the part of the chord line from the leading edge, 0 < t < 1:

        {"area": HM_AREA}
        {"centroid_x", "centroid_y": HM_CENTROID_Y}
        {"moment_xx", "moment_yy", "moment_xy": HM_MOMENT_XX}
        {"chord": HM_CHORD}
        {("thickness", t): HM_THICKNESS}
        {("camber", t): HM_CAMBER}
        {"max_thickness": HM_MAX_THICKNESS}
        {"max_camber": HM_MAX_CAMBER}
        {"leading_edge_radius": HM_LEADING_EDGE_RADIUS}
        {"trailing_edge_angle": HM_TRAILING_EDGE_ANGLE}
        {"trailing_edge_gap": HM_TRAILING_EDGE_GAP}
        {"min_radius": HM_MIN_RADIUS}
        {"curvature_variation": HM_CURVATURE_VARIATION}
        {"twist": HM_TWIST}
        {("clearance", polygon), polygon of shape (m, 2): HM_CLEARANCE}
        {("min_thickness", station, last_station): HM_MIN_THICKNESS}
        {("distance", curve, n), the first curve of the other body and their number: HM_DISTANCE}

        The last three may have a sharpness [1/length] as their last entry, 1e-100 to 1e100, and are
        then smooth lower bounds of the values v_k: m - ln(sum_k exp(-sharpness (v_k - m))) / sharpness,
        m the smallest one.
    chord : pair of points, optional
        A chord line (leading edge, trailing edge) that does not move. Periodic curves need one for
        the quantities that refer to the chord.
    curves : pair of int, optional
        The first curve and the number of curves that form the outline; the default is all.

    Returns
    -------
    Measures

    Raises
    ------
    Error
        ``BAD_CURVE``: the curves do not have the quantity `item`.
    """
    n = len(quantities)
    if n == 0:
        raise Error("Name at least one quantity.")
    structs, alive = ffi.new("hm_quantity[]", n), []
    for struct, wanted in zip(structs, quantities):
        name, *values = wanted if isinstance(wanted, tuple) and wanted else (wanted,)
        if not isinstance(name, str) or name not in _KINDS:
            raise Error(f"The quantity {wanted!r} is unknown; known are {', '.join(_KINDS)}.")
        members, least = _MEMBERS.get(name, ((), 0))
        if not least <= len(values) <= len(members):
            raise Error(f"The quantity {name!r} is written {_written(name)}, not {wanted!r}.")
        struct.struct_size, struct.kind = ffi.sizeof("hm_quantity"), _KINDS[name]
        given = dict(zip(members, values))
        if "polygon" in given:
            polygon = numbers(given.pop("polygon"), "The polygon")
            view_of_polygon = doubles(polygon, (len(polygon), 2), "The polygon")
            alive.append(view_of_polygon)
            struct.polygon, struct.n_polygon = view_of_polygon, len(polygon)
        fill(ffi.addressof(struct), **given)
    result = Measures(np.empty(n), np.empty((n, n_control, 2)), np.empty((n, 2)))
    views = [doubles(one, one.shape, "result", out=True) for one in result]
    call(lib.hm_measure, view, section_of(chord, curves), n, structs, views[0], views[2], views[1])
    return result
