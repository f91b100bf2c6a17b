"""Pictures of meshes and curves: an SVG for notebooks, lines for matplotlib."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np

from .arrays import finite
from .errors import Error

_MOST_EDGES = 60000  # of an SVG, about two megabytes
_WIDTH = 600  # of an SVG [pixels]
_MARGIN = 0.6  # around the bodies, in parts of their extent
_INSET = 0.26  # of the width of the picture
# Lines that are closer to each other than this are faded, so that no region becomes one dark colour [pixels].
_CLEAR = 3.5
_SHADES = (1.0, 0.6, 0.35, 0.2, 0.12)


class _Box(NamedTuple):
    low_x: float
    low_y: float
    high_x: float
    high_y: float

    @property
    def extent(self) -> float:
        return max(self.high_x - self.low_x, self.high_y - self.low_y)

    def widened(self, by: float, limit: "_Box") -> "_Box":
        return _Box(max(self.low_x - by, limit.low_x), max(self.low_y - by, limit.low_y),
                    min(self.high_x + by, limit.high_x), min(self.high_y + by, limit.high_y))


def edges(mesh: Any) -> np.ndarray:
    """Return each edge of the cells once: int array of shape (m, 2)."""
    start, points = mesh.cell_rows()
    following = np.arange(1, len(points) + 1)
    following[start[1:] - 1] = start[:-1]
    both = np.sort(np.stack([points, points[following]], axis=1), axis=1)
    return np.unique(both, axis=0)


def _box(x: np.ndarray, y: np.ndarray) -> _Box:
    return _Box(float(x.min()), float(y.min()), float(x.max()), float(y.max()))


def _loops(faces: np.ndarray) -> List[np.ndarray]:
    """Return the points of each connected piece of the boundary."""
    parent = {int(k): int(k) for k in np.unique(faces)}

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k

    for a, b in faces.tolist():
        parent[root(a)] = root(b)
    found: dict = {}
    for k in parent:
        found.setdefault(root(k), []).append(k)
    return [np.array(one) for one in found.values()]


def _views(mesh: Any, x: np.ndarray, y: np.ndarray) -> Tuple[_Box, Optional[_Box]]:
    """Return the box around all edges, and the one around the bodies where they are small in it, otherwise None."""
    whole = _box(x, y)
    boxes = sorted((_box(x[one], y[one]) for one in _loops(mesh._faces)), key=lambda box: box.extent)
    bodies = boxes[:-1]  # the piece of the largest extent is the outer boundary
    if not bodies:
        return whole, None
    low, high = np.min([one[:2] for one in bodies], axis=0), np.max([one[2:] for one in bodies], axis=0)
    around = _Box(*low, *high)
    near = around.widened(_MARGIN * around.extent, whole)
    return whole, near if near.extent < 0.6 * whole.extent else None


def _path(u: np.ndarray, v: np.ndarray, lines: np.ndarray) -> str:
    return "".join(f"M{u[a]:.2f} {v[a]:.2f}L{u[b]:.2f} {v[b]:.2f}" for a, b in lines)


def _distances(mesh: Any, u: np.ndarray, v: np.ndarray, lines: np.ndarray) -> np.ndarray:
    """Return about how far each line is from the next one beside it: the area of its cells by its length."""
    start, points = mesh.cell_rows()
    following = np.arange(1, len(points) + 1)
    following[start[1:] - 1] = start[:-1]
    after = points[following]
    cell = np.repeat(np.arange(mesh.n_cells), np.diff(start))
    area = np.abs(np.bincount(cell, u[points] * v[after] - u[after] * v[points], mesh.n_cells)) / 2
    key = np.minimum(points, after).astype(np.int64) * mesh.n_points + np.maximum(points, after)
    place = np.searchsorted(lines[:, 0].astype(np.int64) * mesh.n_points + lines[:, 1], key)
    total, cells = np.bincount(place, area[cell], len(lines)), np.bincount(place, minlength=len(lines))
    length = np.hypot(u[lines[:, 1]] - u[lines[:, 0]], v[lines[:, 1]] - v[lines[:, 0]])
    return total / np.maximum(cells * length, 1e-300)


def _mesh_paths(mesh: Any, u: np.ndarray, v: np.ndarray, across: float, down: float) -> str:
    lines = edges(mesh)
    shade = np.minimum(_distances(mesh, u, v, lines) / _CLEAR, 1.0)
    seen = ((np.minimum(u[lines[:, 0]], u[lines[:, 1]]) <= across) & (np.maximum(u[lines[:, 0]], u[lines[:, 1]]) >= 0)
            & (np.minimum(v[lines[:, 0]], v[lines[:, 1]]) <= down) & (np.maximum(v[lines[:, 0]], v[lines[:, 1]]) >= 0))
    lines, shade = lines[seen], shade[seen]
    if len(lines) > _MOST_EDGES:  # those that are nearest to others are left out
        kept = np.sort(np.argpartition(-shade, _MOST_EDGES)[:_MOST_EDGES])
        lines, shade = lines[kept], shade[kept]
    level = np.argmin(np.abs(np.log(np.maximum(shade, 1e-9))[:, None] - np.log(_SHADES)[None, :]), axis=1)
    return "".join(f'<path d="{_path(u, v, lines[level == k])}" stroke-opacity="{opacity}"/>'
                   for k, opacity in enumerate(_SHADES) if (level == k).any())


def svg(mesh: Any) -> str:
    """Return an SVG: the bodies with the cells around them, and the whole domain as an inset.

    Lines that are too close to each other to be told apart are faded; the faintest ones are left
    out where there are more than 60 000.
    """
    x, y = finite(mesh.points, mesh.n_points, "points")
    used = np.unique(mesh.cell_rows()[1])
    whole, near = _views(mesh, x, y) if len(mesh._faces) else (_box(x[used], y[used]), None)
    view = near or whole
    scale = _WIDTH / max(view.extent, 1e-300)
    u, v = (x - view.low_x) * scale, (view.high_y - y) * scale
    across, down = (view.high_x - view.low_x) * scale, (view.high_y - view.low_y) * scale
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{across:.0f}" height="{down:.0f}" '
        f'viewBox="-1 -1 {across + 2:.2f} {down + 2:.2f}"><title>{mesh.n_points} points, {mesh.n_cells} cells</title>'
        f'<g fill="none" stroke="#336" stroke-width="0.4">{_mesh_paths(mesh, u, v, across, down)}'
        f'<path class="boundary" d="{_path(u, v, mesh._faces)}" stroke="#113" stroke-width="1"/></g>']
    if near is not None:
        parts.append(_inset(mesh, x, y, whole, near, across))
    return "".join(parts) + "</svg>"


def _inset(mesh: Any, x: np.ndarray, y: np.ndarray, whole: _Box, near: _Box, across: float) -> str:
    scale = _INSET * across / max(whole.extent, 1e-300)
    u, v = (x - whole.low_x) * scale, (whole.high_y - y) * scale
    width, height = (whole.high_x - whole.low_x) * scale, (whole.high_y - whole.low_y) * scale
    return (
        f'<svg class="inset" x="{across - width - 7:.2f}" y="5" width="{width + 4:.2f}" height="{height + 4:.2f}" '
        f'viewBox="-2 -2 {width + 4:.2f} {height + 4:.2f}"><rect x="-2" y="-2" width="100%" height="100%" '
        f'fill="#fff" fill-opacity="0.9" stroke="#999"/><path d="{_path(u, v, mesh._faces)}" fill="none" '
        f'stroke="#113" stroke-width="0.7"/><rect x="{(near.low_x - whole.low_x) * scale:.2f}" '
        f'y="{(whole.high_y - near.high_y) * scale:.2f}" width="{max((near.high_x - near.low_x) * scale, 2):.2f}" '
        f'height="{max((near.high_y - near.low_y) * scale, 2):.2f}" fill="none" stroke="#c30"/></svg>')


def _matplotlib() -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise Error("matplotlib is not installed; plot() needs it.", Error.UNSUPPORTED) from None
    return pyplot


def _axes(ax: Any) -> Any:
    """The axes that were given, or the current ones of matplotlib."""
    pyplot = _matplotlib()
    if ax is not None and not isinstance(ax, pyplot.Axes):
        raise Error(f"ax must be axes of matplotlib, not {type(ax).__name__}; curves that moved are drawn by their "
                    "own plot(), a mesh that moved by mesh.plot(points).")
    return pyplot.gca() if ax is None else ax


def _styled(kind: Any, default: dict, style: dict) -> dict:
    """The arguments of an artist: short names such as c and lw count as the long ones."""
    from matplotlib.cbook import normalize_kwargs

    try:
        return {**default, **normalize_kwargs({"color" if one == "colors" else one: value
                                               for one, value in style.items()}, kind)}
    except TypeError as reason:
        raise Error(f"The style is not possible: {reason}.") from None


def plot(mesh: Any, points: Any, ax: Any, whole: bool, style: dict) -> Any:
    """Draw the edges of the mesh; see :meth:`harmorph.Mesh.plot`."""
    x, y = finite(mesh.points if points is None else points, mesh.n_points, "points")
    ax = _axes(ax)
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Rectangle

    pairs = edges(mesh)
    ax.add_collection(LineCollection(np.stack([x[pairs], y[pairs]], axis=-1),
                                     **_styled(LineCollection, {"linewidth": 0.3, "color": "#336"}, style)))
    all_of_it, near = _views(mesh, x, y) if len(mesh._faces) else (_box(x, y), None)
    ax.set_aspect("equal")
    if near is None or whole:
        ax.autoscale_view()
        return ax
    ax.set(xlim=(near.low_x, near.high_x), ylim=(near.low_y, near.high_y))
    if not ax.child_axes:  # a second mesh in the same axes needs no second inset
        inset = ax.inset_axes([1 - _INSET - 0.01, 1 - _INSET - 0.01, _INSET, _INSET])
        faces = np.stack([x[mesh._faces], y[mesh._faces]], axis=-1)
        inset.add_collection(LineCollection(faces, linewidths=0.6, colors="#113"))
        inset.add_patch(Rectangle(near[:2], near.high_x - near.low_x, near.high_y - near.low_y, fill=False,
                                  edgecolor="#c30"))
        inset.autoscale_view()
        inset.set(aspect="equal", xticks=[], yticks=[])
        inset.set_xlim(all_of_it.low_x, all_of_it.high_x)
    return ax


def _outline(curves: Any, curve: int) -> np.ndarray:
    one = curves.curves[curve]
    knots = np.unique(one.knots[one.degree:len(one.indices) + 1])
    return curves.points(np.concatenate([np.linspace(a, b, 12, endpoint=False)
                                         for a, b in zip(knots[:-1], knots[1:])] + [knots[-1:]]), curve)


def curves_svg(curves: Any) -> str:
    """Return an SVG of curves with their control polygons; control points are numbered from 0."""
    outlines = [_outline(curves, k) for k in range(len(curves.curves))]
    both = np.concatenate([*outlines, curves.control])
    low, high = both.min(axis=0), both.max(axis=0)
    scale = _WIDTH / max((high - low).max(), 1e-300)
    place = [(one - [low[0], high[1]]) * [scale, -scale] for one in (*outlines, curves.control)]

    def line(points: np.ndarray) -> str:
        return "M" + "L".join(f"{u:.2f} {v:.2f}" for u, v in points)

    polygons = "".join(f'<path class="polygon" d="{line(place[-1][one.indices])}"/>' for one in curves.curves)
    shapes = "".join(f'<path class="curve" d="{line(one)}" stroke="#1f6fd0" stroke-width="1.6"/>' for one in place[:-1])
    dots = "".join(f'<circle cx="{u:.2f}" cy="{v:.2f}" r="2.6"/><text x="{u + 4:.2f}" y="{v - 4:.2f}">{k}</text>'
                   for k, (u, v) in enumerate(place[-1]))
    across, down = (high - low) * scale
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{across + 40:.0f}" height="{down + 40:.0f}" '
        f'viewBox="-20 -20 {across + 40:.2f} {down + 40:.2f}"><title>{len(curves.control)} control points</title>'
        f'<g fill="none" stroke="#999" stroke-width="0.6">{polygons}{shapes}</g>'
        f'<g fill="#c30" font-family="sans-serif" font-size="9">{dots}</g></svg>')


def plot_curves(curves: Any, ax: Any, style: dict) -> Any:
    """Draw curves and control polygons; see :meth:`harmorph.Curves.plot`."""
    ax = _axes(ax)
    from matplotlib.lines import Line2D

    line = _styled(Line2D, {"linewidth": 1.6}, style)
    # Control points have the colour that is asked for, so that those before and after a movement differ.
    polygon = line.get("color", "#999")
    line = {"color": "#1f6fd0", **line}
    for k, one in enumerate(curves.curves):
        ax.plot(*curves.control[one.indices].T, color=polygon, linewidth=0.6, marker="o", markersize=3, zorder=1)
        ax.plot(*_outline(curves, k).T, **line)
    ax.set_aspect("equal")
    return ax
