"""Morphs a mesh forward and back 1000 times: the last mesh has the bits of the first.

Coordinates are never added up. `morph.morph(total)` starts from `morph.start` each time, so a mesh depends on the sum
of the movements alone; and the sums are exact, as all movements are whole multiples of one power of two.
"""
import harmorph
import numpy as np

ni, nj = 129, 49
angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
r = np.exp(3 * np.arange(nj) / (nj - 1))[:, None]
points = np.stack([(r + 0.6 / r) * np.cos(angle), (r - 0.6 / r) * np.sin(angle)], axis=-1)
mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")
morph = harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=12, closed="periodic"))

unit = 2.0**-40  # 1e-12 of the unit of length; sums below 2^12 units of length are exact
random = np.random.default_rng(1)
steps = np.round(1e-3 * random.standard_normal((1000, 12, 2)) / unit) * unit

first, total = mesh.points.copy(), np.zeros((12, 2))
added = first.copy()  # for comparison: coordinates to which each movement is added
for step in steps:
    total += step
    morph.morph(total, out=mesh.points)
    morph.morph(step, added, out=added)
print(f"forward: the mesh moved by up to {np.abs(mesh.points - first).max():.2f}")
for step in random.permutation(steps):  # back, in another order
    total -= step
    morph.morph(total, out=mesh.points)
    morph.morph(-step, added, out=added)
print("back: the bits of the first mesh" if np.array_equal(mesh.points, first) else "back: other bits")
print(f"added up instead: {np.abs(added - first).max():.1e} away")
