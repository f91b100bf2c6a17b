"""Morphs a structured O-mesh around an ellipse: fit, solve once, move control points as often as wanted."""
import harmorph
import numpy as np

ni, nj = 129, 49
angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
r = np.exp(3 * np.arange(nj) / (nj - 1))[:, None]
points = np.stack([(r + 0.6 / r) * np.cos(angle), (r - 0.6 / r) * np.sin(angle)], axis=-1)
mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")

# A periodic cubic B-spline with 12 control points through the points of the wall; one function for each.
curves = harmorph.Curves.fit(mesh, "wall", n_control=12, closed="periodic")
morph = harmorph.Morph(mesh, curves)

# The upper control points go up. The displacements are judged before the mesh moves.
move = np.zeros((12, 2))
move[curves.control[:, 1] > 0.05, 1] = 0.1
step, quality = morph.assess(morph.displacement(move))
print(f"{quality.inverted} inverted cells; the mesh could follow {step.admissible:.1f} times as far")
if quality.inverted:
    raise SystemExit(1)
morph.morph(move, mesh.points, out=mesh.points)

# Derivatives of an objective by the mesh points become derivatives by the control points.
gradient = morph.adjoint(np.ones((mesh.n_points, 2)))
