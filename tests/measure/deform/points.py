"""Admissible steps of conformal functions divided by those of Laplace functions, for 18 of 20 control points that move
one at a time along the chord (x) and across the chord (y), both ways.

usage: points.py MESH:MARKER
"""

import sys

import numpy as np
import harmorph
import shared

mesh, marker, _name = shared.file_and_marker(sys.argv[1])
curves = harmorph.Curves.fit(mesh, marker, 20)
laplace, conformal = (harmorph.Morph(mesh, curves, operator=operator) for operator in ("laplace", "conformal"))
for axis, name in enumerate("xy"):
    ratios = []
    for point in range(1, 19):
        for way in (0.001, -0.001):
            move = np.zeros((20, 2))
            move[point, axis] = way
            steps = [morph.assess(morph.displacement(move)).step for morph in (laplace, conformal)]
            steps = [min(step.admissible, step.boundary) for step in steps]  # neither cells nor walls cross
            ratios.append(steps[1] / steps[0])
    print(f"along {name}: median {np.median(ratios):.2f}, smallest {min(ratios):.2f}, largest {max(ratios):.1f}, "
          f"below 1: {sum(ratio < 1 for ratio in ratios)} of {len(ratios)}")
