"""Optimises an airfoil with its mesh by scipy: the most even pressure at a given lift, area and thickness.

Usage: python3 optimise.py MESH.su2

The flow solver is the panel method of panels.py, which sees the wall points of the mesh. Its adjoint gives
derivatives by these points; harmorph turns them into derivatives by the control points, and the design
variables (CST) into derivatives for SLSQP. Area and thickness are measured on the B-spline.
"""
import sys

import harmorph
import numpy as np
from panels import Panels
from scipy.optimize import minimize

mesh = harmorph.Mesh.read(sys.argv[1])
curves = harmorph.Curves.fit(mesh, "airfoil", n_control=20)
morph = harmorph.Morph(mesh, curves)
variables = morph.variables("cst", n_upper=5, n_lower=5)
wall, _ = mesh.wall("airfoil")
wall = np.roll(wall, -int(morph.start[wall, 0].argmax()))  # from the trailing edge around
stations = [("thickness", 0.2), ("thickness", 0.4), ("thickness", 0.6), ("thickness", 0.8)]
alpha, lift = 1.0, 0.4


def flow(values):
    return Panels(morph.morph(variables.move(values))[wall], alpha)


def gradient(panels, by_speed, by_length):
    by_points = np.zeros((mesh.n_points, 2))
    by_points[wall] = panels.adjoint(by_speed, by_length)
    return variables.gradient(morph.adjoint(by_points))


def value_and_gradient(values, what):
    panels = flow(values)
    value, by_speed, by_length = what(panels)
    return value, gradient(panels, by_speed, by_length)


def measured(values):
    found = morph.measure("area", *stations, move=variables.move(values))
    return found.values, np.array([variables.gradient(one) for one in found.gradients])


# The gradient is that of the whole chain: it agrees with finite differences.
trial = 0.003 * np.cos(np.arange(variables.n))
step = 1e-6 * np.sin(1.0 + np.arange(variables.n))
difference = (value_and_gradient(trial + step, Panels.unevenness)[0]
              - value_and_gradient(trial - step, Panels.unevenness)[0]) / 2
exact = value_and_gradient(trial, Panels.unevenness)[1] @ step
print(f"gradient: relative difference from finite differences {abs(difference / exact - 1):.1e}")

least = measured(np.zeros(variables.n))[0] * [1.0, 0.9, 0.9, 0.9, 0.9]
result = minimize(
    value_and_gradient,
    np.zeros(variables.n),
    args=(Panels.unevenness,),
    jac=True,
    method="SLSQP",
    bounds=[(-0.2, 0.2)] * variables.n,
    constraints=[
        {"type": "eq", "fun": lambda v: value_and_gradient(v, Panels.lift)[0] - lift,
         "jac": lambda v: value_and_gradient(v, Panels.lift)[1]},
        {"type": "ineq", "fun": lambda v: measured(v)[0] / least - 1,
         "jac": lambda v: measured(v)[1] / least[:, None]},
    ],
    options={"maxiter": 60, "ftol": 1e-9},
)
move = variables.move(result.x)
quality = morph.assess(morph.displacement(move)).quality
start = flow(np.zeros(variables.n))
print(f"iterations {result.nit}, {result.message}")
print(f"lift {start.lift()[0]:.4f} -> {flow(result.x).lift()[0]:.4f}")
print(f"integral of squared pressure {start.unevenness()[0]:.5f} -> {result.fun:.5f}")
print("area and thickness over the smallest allowed:", np.array2string(measured(result.x)[0] / least, precision=4))
print(f"inverted cells {quality.inverted}, smallest quality {quality.min_quality:.3f}")
