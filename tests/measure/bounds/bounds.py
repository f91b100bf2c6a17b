"""Processor time of smooth bounds of the quality with derivatives, in multiples of that of Morph.assess.

usage: bounds.py [POINTS AROUND [REPEATS]]
"""

import sys

import numpy as np
import harmorph
from shared import fastest

around, repeats = (int(word) for word in (sys.argv[1:] + ["641", "20"][len(sys.argv) - 1:]))
ni, nj = around - 1, around // 4
angle, r = 2 * np.pi * np.arange(ni + 1) / ni, np.exp(3 * np.arange(nj) / (nj - 1))[:, None]
ring = np.stack([(r + 0.6 / r) * np.cos(angle), (r - 0.6 / r) * np.sin(angle)], axis=-1)
ring[:, -1] = ring[:, 0]
points = ring[:, :-1].reshape(-1, 2)
here = np.arange(ni * nj, dtype=np.int32).reshape(nj, ni)
after = np.roll(here, -1, axis=1)
a, b, c, d = (one.ravel() for one in (here[:-1], after[:-1], after[1:], here[1:]))
pairs = slice(None, None, 2)
sixes = [a[pairs], b[pairs], np.roll(after, -1, axis=1)[:-1].ravel()[pairs],
         np.roll(after, -1, axis=1)[1:].ravel()[pairs], c[pairs], d[pairs]]
quads, hexagons = np.stack([a, b, c, d], axis=1), np.stack(sixes, axis=1)
halves = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
sides = {"wall": np.append(here[0], here[0, 0]), "far": np.append(here[-1], here[-1, 0])}


def polygons(cells):
    start = cells.shape[1] * np.arange(len(cells) + 1, dtype=np.int32)
    return harmorph.Mesh(points, (start, cells.ravel()), sides, polygons=True)


MESHES = {"quadrilaterals": lambda: harmorph.Mesh(points, quads, sides),
          "structured": lambda: harmorph.Mesh.structured(ring, j_min="wall", j_max="far"),
          "triangles": lambda: harmorph.Mesh(points, halves, sides),
          "polygons": lambda: polygons(quads),
          "hexagons": lambda: polygons(hexagons)}

print("processor time, one thread; Quality.bounds in multiples of Morph.assess")
print(f"{'layout':14} {'cells':>8} {'assess':>11} {'quality':>9} {'areas':>9} {'both':>9}")
for layout, make in MESHES.items():
    mesh = make()
    morph = harmorph.Morph(mesh, conditions={"wall": "given"}, operator="laplace")
    x, y = morph.start.T
    move = 0.02 * np.stack([np.sin(3 * y), np.cos(2 * x)], axis=1) / np.hypot(x, y)[:, None]
    quality, at = harmorph.Quality(morph), morph.start + move
    base = fastest(lambda: morph.assess(move), repeats)
    times = [fastest(lambda: quality.bounds(*kinds, points=at), repeats) / base
             for kinds in (["quality"], ["area"], ["quality", "area"])]
    least = morph.assess(move).quality.min_quality
    bound = quality.bounds("quality", points=at)
    print(f"{layout:14} {mesh.n_cells:8d} {1e3 * base:8.2f} ms {times[0]:9.2f} {times[1]:9.2f} {times[2]:9.2f}"
          f"   {bound.values[0]:.3f} <= {bound.extremes[0]:.3f} (assess {least:.3f})", flush=True)
