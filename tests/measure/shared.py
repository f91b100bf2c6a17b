"""Meshes, movements and times that the measurements in Python share."""

import time

import numpy as np
import harmorph
from scipy.optimize import brentq


def processor_seconds(call):
    """Return the processor time [s] of one call, and the result of the call."""
    begun = time.process_time()
    result = call()
    return time.process_time() - begun, result


def fastest(call, runs=5):
    """Return the processor time [s] of the fastest of several calls."""
    return min(processor_seconds(call)[0] for _ in range(runs))


def file_and_marker(word):
    """Split FILE:MARKER; return the mesh, the marker and the name of the file without its extension."""
    path, marker = word.rsplit(":", 1)
    return harmorph.Mesh.read(path), marker, path.rsplit("/", 1)[-1].rsplit(".", 1)[0]


# ---- O-meshes round a Joukowski section, whose chord is 1 from x = 0 to 1; the far field is 20 chords away ----

CIRCLE, FAR = 1.1, 80.0  # radii in the plane of the map z + 1 / z, in which the chord is 4


def _growth(first, layers, height):
    """The ratio of neighbouring heights for which layers, the first `first` high, have this height together."""
    return brentq(lambda q: first * (q**layers - 1) / (q - 1) - height, 1 + 1e-9, min(10, np.exp(700 / layers)))


def _rings(kind, size):
    """Return the number of points around, the radii of the rings, and the number of rings with quadrilaterals."""
    turn = 2 * np.pi
    if kind in ("iso", "triangles"):  # cells as high as long: the height of an equilateral triangle is less
        height = 1 if kind == "iso" else 3**0.5 / 2
        around = int((size * turn * height / np.log(FAR / CIRCLE)) ** 0.5)
        layers = size // around - 1
        return around, CIRCLE * (FAR / CIRCLE) ** (np.arange(layers + 1) / layers), layers if kind == "iso" else 0
    first = 4 * (1e-6 if kind == "thin" else 1e-5)
    if kind in ("viscous", "thin"):
        around = int((1.5 * size) ** 0.5)
        layers = size // around - 1
        growth = _growth(first, layers, FAR - CIRCLE)
        return around, CIRCLE + first * (growth ** np.arange(layers + 1) - 1) / (growth - 1), layers
    if kind != "hybrid":
        raise ValueError(f"no such kind of mesh: {kind}")
    around = int((size / 1.2) ** 0.5)
    layers = int(np.log(turn * CIRCLE / around / first) / np.log(1.2))
    inner = CIRCLE + first * (1.2 ** np.arange(layers + 1) - 1) / 0.2
    outer = int(np.log(FAR / inner[-1]) * around / turn / (3**0.5 / 2))
    return around, np.append(inner, inner[-1] * (FAR / inner[-1]) ** (np.arange(1, outer + 1) / outer)), layers


def o_mesh(kind, size):
    """Return a mesh of about `size` points with the markers "airfoil" and "far".

    The kinds are "iso" (quadrilaterals as high as long), "viscous" and "thin" (the first layer is 1e-5 and 1e-6
    chords high), "triangles" (equilateral ones), and "hybrid" (layers of quadrilaterals inside triangles).
    """
    around, radii, quads = _rings(kind, size)
    shift = 0.5 * (np.maximum(np.arange(len(radii)) - quads, 0) % 2)  # rings of triangles are staggered
    angle = 2 * np.pi * (np.arange(around) + shift[:, None]) / around
    z = CIRCLE * -0.09 / 1.1 + radii[:, None] * np.exp(1j * angle)
    w = z + 1 / z
    left, right = w[0].real.min(), w[0].real.max()
    w = ((w - left) / (right - left)).reshape(-1)
    here = np.arange(w.size, dtype=np.int32).reshape(angle.shape)
    after = np.roll(here, -1, axis=1)

    def cells(rows, *corners):
        return np.concatenate([np.stack([c[k] for c in corners], axis=-1) for k in rows] or
                              [np.empty((0, len(corners)), np.int32)])

    a, b, d, c = here[:-1], here[1:], after[:-1], after[1:]  # counter-clockwise: a, b, c, d
    even, odd = range(quads, len(radii) - 1, 2), range(quads + 1, len(radii) - 1, 2)
    triangles = np.concatenate([cells(even, a, b, d), cells(even, d, b, c), cells(odd, a, c, d), cells(odd, a, b, c)])
    sides = {"airfoil": np.append(here[0], here[0, 0]), "far": np.append(here[-1], here[-1, 0])}
    layers = cells(range(quads), a, b, c, d)
    both = (triangles, layers) if len(triangles) and len(layers) else triangles if len(triangles) else layers
    return harmorph.Mesh(np.stack([w.real, w.imag], axis=1), both, sides)


# ---- Movements of the control points (n, 2) of an airfoil of chord 1 from x = 0 to 1 ----


def _of(control, y=0.0, x=0.0):
    return np.stack(np.broadcast_arrays(x, y, control[:, 0])[:2], axis=1).astype(float)


def camber(control, height):
    """A parabolic arc of this height in chords."""
    return _of(control, y=4 * height * control[:, 0] * (1 - control[:, 0]))


def rotation(control, degrees, centre=(0.25, 0.0), shift=(0.0, 0.0)):
    """A rotation counter-clockwise about the centre, followed by a translation."""
    z, about = control @ [1, 1j], complex(*centre)
    z = (z - about) * (np.exp(1j * np.radians(degrees)) - 1) + complex(*shift)
    return _of(control, x=z.real, y=z.imag)


def thickening(control, by):
    """Each y grows by `by` times y."""
    return _of(control, y=by * control[:, 1])


def translation(control, by):
    """A translation along the diagonal."""
    return _of(control, x=by * 0.5**0.5, y=by * 0.5**0.5)


def flap(control, degrees):
    """The last quarter of the chord turns downwards about the hinge on the chord line."""
    return rotation(control, -degrees, (0.75, 0)) * (control[:, :1] > 0.75)


def bump(control, height):
    """The upper control point nearest to x = 0.4 moves up."""
    moves = np.zeros_like(control)
    upper = np.flatnonzero(control[:, 1] > 0)
    moves[upper[np.abs(control[upper, 0] - 0.4).argmin()], 1] = height
    return moves
