"""A fluid-structure loop: an airfoil on two springs, which moves up and pitches under its own lift.

Usage: python3 fsi.py MESH.su2

The structure knows displacements and forces of wall points. In each step the flow gives forces on the wall,
the springs give displacements of the wall, and harmorph carries these to the mesh. At the end, forces on
mesh points near the wall (as a solver with smeared forces has them) become forces on the wall that do the
same work.
"""
import sys

import harmorph
import numpy as np
from panels import Panels

mesh = harmorph.Mesh.read(sys.argv[1])
morph = harmorph.Morph(mesh, conditions={"airfoil": "given"})
wall = morph.given_points
wall_start = morph.start[wall]
first = int(wall_start[:, 0].argmax())  # panels begin at the trailing edge
pivot, stiffness_up, stiffness_turn = np.array([0.4, 0.0]), 20.0, 3.0

up, turn = 0.0, 0.0
for iteration in range(1, 50):
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    displacement = (wall_start - pivot) @ rotation.T + pivot + [0, up] - wall_start
    points = morph.displace(displacement, morph.start)
    panels = Panels(np.roll(points[wall], -first, axis=0), alpha=3.0)
    force = np.roll(panels.force(), first, axis=0)
    arm = points[wall] - pivot - [0, up]
    new_up = force[:, 1].sum() / stiffness_up
    new_turn = (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).sum() / stiffness_turn
    change = max(abs(new_up - up), abs(new_turn - turn))
    up, turn = new_up, new_turn
    if change < 1e-12:
        break

step, quality = morph.assess(points - morph.start)
print(f"{iteration} iterations; {up:.4f} chords up, {np.degrees(turn):.3f} degrees")
print(f"inverted cells {quality.inverted}, smallest quality {quality.min_quality:.3f}")

smeared = np.random.default_rng(1).normal(size=(mesh.n_points, 2))
virtual = np.random.default_rng(2).normal(size=wall_start.shape)
on_wall = morph.displace_adjoint(smeared)
work, work_on_wall = (smeared * morph.displace(virtual)).sum(), (on_wall * virtual).sum()
print(f"virtual work: relative difference {abs(work / work_on_wall - 1):.1e}")
