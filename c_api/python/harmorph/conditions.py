"""Boundary conditions: what the points of each marker do."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._native import ffi, lib
from .curves import Curves
from .errors import Error, call
from .boundary import Marker
from .mesh import Mesh
from .reports import fill, new, pair
from .words import kinds

KINDS = kinds("rigid", "fixed", "slip", "free", "given", "interface", curve="ON_CURVE", periodic="PERIODIC_PAIR",
              rotation="ROTATION_PAIR")
_WITH_PARTNER = ("periodic", "rotation", "interface")


@dataclass(frozen=True)
class Condition:
    """What the points of a marker do.

    Parameters
    ----------
    kind : str
        - "curve": they lie on curves, and move with the control points;
        - "rigid": they belong to a body that translates, rotates and scales;
        - "fixed": they stay; also every marker without a condition;
        - "slip": they slide along straight lines, along the smooth curve through the points of the
          marker, or along given curves;
        - "free": zero normal derivative, or those of `fluxes` of :class:`harmorph.Morph`; not with
          the conformal operator;
        - "periodic": this marker and its partner are translates of each other;
        - "rotation": the partner is this marker, rotated about `centre`;
        - "given": their displacements are arguments of :meth:`harmorph.Morph.displace`;
        - "interface": the faces of this marker and its partner may touch and cross.
    curves : pair of int, optional
        "curve": the first curve and the number of curves; the default is all curves.
    body : int
        "rigid": the number of the body, from 0 without gaps.
    partner : marker, optional
        "periodic", "rotation", "interface": the other marker.
    centre : pair of float
        "rigid", "rotation": the centre of rotation [length].
    near : pair of float, optional
        The condition is for one piece of the marker, the one nearest to this point [length].
    along : Curves, optional
        "slip": the curves along which the points move.

    Raises
    ------
    Error
        ``BAD_CONDITION``: an unknown kind, a partner that is missing or has no meaning.
    """

    kind: str
    curves: Optional[Tuple[int, int]] = None
    body: int = 0
    partner: Optional[Marker] = None
    centre: Tuple[float, float] = (0.0, 0.0)
    near: Optional[Tuple[float, float]] = None
    along: Optional[Curves] = None

    def __post_init__(self) -> None:
        if not isinstance(self.kind, str) or self.kind not in KINDS:
            raise Error(f"The kind {self.kind!r} of a condition is unknown; known are {list(KINDS)}.",
                        Error.BAD_CONDITION)
        if (self.kind in _WITH_PARTNER) != (self.partner is not None):
            needs = "needs a `partner`" if self.partner is None else "has no `partner`"
            raise Error(f"A condition of the kind {self.kind!r} {needs}.", Error.BAD_CONDITION)
        if self.along is not None and (self.kind != "slip" or not isinstance(self.along, Curves)):
            raise Error("`along` must be Curves, of a condition of the kind 'slip'.", Error.BAD_CONDITION)
        pair(self.centre, "centre")
        if self.near is not None:
            pair(self.near, "near")
        if self.curves is not None:
            pair(self.curves, "curves")


Given = Union[Mapping[Marker, Any], Iterable[Tuple[Marker, Any]], None]


def listed(mesh: Mesh, curves: Optional[Curves], given: Given) -> List[Tuple[int, Condition]]:
    """Return pairs (number of the marker, Condition).

    Parameters
    ----------
    given : mapping or sequence of pairs
        Conditions by marker: a :class:`Condition` or the name of its kind. Markers that `curves`
        was fitted to, and that have no condition here, are on all curves.
    """
    pairs: List[Tuple[Marker, Any]] = list(given.items() if isinstance(given, Mapping) else (given or ()))
    named = {name for name, _ in pairs}
    fitted = curves.markers if curves is not None else ()
    pairs = [(name, "curve") for name in fitted if name not in named] + pairs
    result: List[Tuple[int, Condition]] = []
    for name, wanted in pairs:
        is_kind = isinstance(wanted, str) and wanted in KINDS
        condition = Condition(wanted) if is_kind else wanted
        if not isinstance(condition, Condition):
            raise Error(f"The condition of marker {name!r} must be one of {list(KINDS)}, or a "
                        f"harmorph.Condition; it is {condition!r}.", Error.BAD_CONDITION)
        result.append((mesh.marker(name), condition))
    if not result:
        raise Error("No marker is on a curve, rigid or given; give `conditions`, or curves that were "
                    "fitted to markers of the mesh.", Error.BAD_CONDITION)
    return result


def with_moved_centres(pairs: List[Tuple[int, Condition]], shifts: Any) -> List[Tuple[int, Condition]]:
    """Return the pairs with the centres of rigid bodies translated by `shifts`, shape (bodies, 2) [length]."""
    def moved(one: Condition) -> Condition:
        x, y = pair(one.centre, "centre")
        return replace(one, centre=(x + shifts[one.body][0], y + shifts[one.body][1]))

    return [(marker, moved(one) if one.kind == "rigid" else one) for marker, one in pairs]


def flux_arrays(curves: Optional[Curves], fluxes: Any) -> Any:
    """Return the pair of arrays `fluxes` of :class:`harmorph.Morph` in the form that C needs, or None."""
    if fluxes is None:
        return None
    if curves is None or len(fluxes) != 2:
        raise Error("fluxes must be a pair of arrays (faces, values), and needs curves.", Error.BAD_CONDITION)
    faces = np.array(fluxes[0], np.int32, order="C")
    values = np.array(fluxes[1], np.float64, order="C")
    if faces.shape != (len(values), 2) or values.shape != (len(values), len(curves.control)):
        raise Error(f"fluxes must have the shapes (n, 2) and (n, {len(curves.control)}), not {faces.shape} and "
                    f"{values.shape}.", Error.BAD_CONDITION)
    return faces, values


def structs(mesh: Mesh, curves: Optional[Curves], pairs: List[Tuple[int, Condition]]) -> Any:
    """Return an array of ``hm_condition``; the curves `along` must stay alive."""
    result = ffi.new("hm_condition[]", len(pairs))
    for struct, (marker, condition) in zip(result, pairs):
        struct.struct_size, struct.marker = ffi.sizeof("hm_condition"), marker
        struct.kind, view = KINDS[condition.kind], ffi.addressof(struct)
        if condition.kind == "curve" and curves is not None:
            first, n = pair(condition.curves or (0, len(curves.curves)), "curves")
            fill(view, first_curve=first, n_curves=n)
        if condition.partner is not None:
            struct.partner = mesh.marker(condition.partner)
        x, y = pair(condition.centre, "centre")
        fill(view, body=condition.body, x=x, y=y)
        if condition.near is not None:
            near_x, near_y = pair(condition.near, "near")
            fill(view, piece=1, near_x=near_x, near_y=near_y)
        if condition.along is not None:
            struct.along, struct.n_curves = condition.along._c, len(condition.along.curves)
    return result


def of_basis(mesh: Mesh, basis: Any, found: Any, n: int) -> List[Tuple[int, Condition]]:
    """Return the pairs that the `n` conditions `found` of a saved basis stand for."""
    names = {value: key for key, value in KINDS.items()}
    markers = {number: name for name, number in mesh.markers.items()}
    pairs = []
    sets: Dict[Any, Curves] = {}  # conditions that had the same curves get the same ones again
    for number, struct in enumerate(found[0:n]):
        kind = names[struct.kind]
        has_partner = kind in _WITH_PARTNER
        pairs.append((struct.marker, Condition(
            kind,
            curves=(struct.first_curve, struct.n_curves) if kind == "curve" else None,
            body=struct.body,
            partner=markers.get(struct.partner, struct.partner) if has_partner else None,
            centre=(struct.x, struct.y),
            near=(struct.near_x, struct.near_y) if struct.piece else None,
            along=_along(basis, number, struct.n_curves, sets) if kind == "slip" else None,
        )))
    return pairs


def _along(basis: Any, condition: int, n: int, sets: Dict[Any, Curves]) -> Optional[Curves]:
    if n == 0:
        return None
    out, curves = new("hm_curves"), ffi.new("hm_curve[]", n)
    curves[0].struct_size = ffi.sizeof("hm_curve")
    call(lib.hm_basis_along, basis, condition, out, curves, n)
    return sets.setdefault(out.control, Curves._copied(out))
