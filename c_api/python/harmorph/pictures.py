"""Pictures of meshes: an SVG for notebooks, lines for matplotlib."""

from __future__ import annotations

from typing import Any

import numpy as np

from .arrays import _columns
from .errors import Error

_MOST_EDGES = 30000  # of an SVG, about one megabyte


def edges(mesh: Any) -> np.ndarray:
    """Return each edge of the cells once: int array of shape (m, 2)."""
    start, points = mesh.cell_rows()
    following = np.arange(1, len(points) + 1)
    following[start[1:] - 1] = start[:-1]
    both = np.sort(np.stack([points, points[following]], axis=1), axis=1)
    return np.unique(both, axis=0)


def svg(mesh: Any, width: int = 600) -> str:
    """Return an SVG of the mesh; of a mesh with more than 30 000 edges, of its boundary alone."""
    x, y = _columns(mesh.points, mesh.n_points, "points")
    lines = edges(mesh) if mesh.n_cells < _MOST_EDGES else mesh._faces
    if len(lines) > _MOST_EDGES:
        lines = mesh._faces
    used = np.unique(lines)
    low_x, high_x, low_y, high_y = x[used].min(), x[used].max(), y[used].min(), y[used].max()
    scale = width / max(high_x - low_x, high_y - low_y, 1e-300)
    u, v = (x - low_x) * scale, (high_y - y) * scale
    path = "".join(f"M{u[a]:.2f} {v[a]:.2f}L{u[b]:.2f} {v[b]:.2f}" for a, b in lines)
    across, down = (high_x - low_x) * scale, (high_y - low_y) * scale
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{across:.0f}" height="{down:.0f}" '
        f'viewBox="-1 -1 {across + 2:.2f} {down + 2:.2f}"><title>{mesh.n_points} points, '
        f'{mesh.n_cells} cells</title><path d="{path}" fill="none" stroke="#336" '
        'stroke-width="0.4"/></svg>'
    )


def plot(mesh: Any, points: Any, ax: Any, style: dict) -> Any:
    """Draw the edges of the mesh; see :meth:`harmorph.Mesh.plot`."""
    try:
        from matplotlib import pyplot
        from matplotlib.collections import LineCollection
    except ImportError:
        raise Error("matplotlib is not installed; plot() needs it.", Error.UNSUPPORTED) from None
    x, y = _columns(mesh.points if points is None else points, mesh.n_points, "points")
    ax = pyplot.gca() if ax is None else ax
    pairs = edges(mesh)
    ax.add_collection(LineCollection(np.stack([x[pairs], y[pairs]], axis=-1),
                                     **{"linewidths": 0.3, "colors": "#336", **style}))
    ax.autoscale_view()
    ax.set_aspect("equal")
    return ax
