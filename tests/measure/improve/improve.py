"""Processor time of Morph.improve after one linear morph, in multiples of one solution (analysis, plan, factor and 20
conformal functions), and the quality before and after.

usage: improve.py SIZES KINDS MESH:MARKER ...   lists with spaces; kinds of tests/measure/shared.py; airfoils of chord 1
"""

import sys

import harmorph
import shared


def study(name, mesh, marker):
    curves = harmorph.Curves.fit(mesh, marker)
    solution = shared.fastest(lambda: harmorph.Morph(mesh, curves))
    morph = harmorph.Morph(mesh, curves)
    for what, movement, amount in (("turn 30", shared.rotation, 30), ("turn 90", shared.rotation, 90),
                                   ("camber .1", shared.camber, 0.1), ("camber .4", shared.camber, 0.4),
                                   ("bump .3", shared.bump, 0.3)):
        move, part = movement(curves.control, amount), 1.0
        while True:  # the movement is halved until the linear morph is valid
            moved = morph.morph(part * move)
            quality = morph.assess(points=moved, reference=morph.start).quality
            if quality.inverted == 0 and quality.min_quality > 0:
                break
            part /= 2
        seconds = shared.fastest(lambda: morph.improve(moved), 2)
        _points, report = morph.improve(moved)
        print(f"{name:22} {mesh.n_points:8d}  {what:9} {part:6.3f} {solution:10.4f} {seconds:10.4f} "
              f"{seconds / solution:7.2f} {report.solutions:6d}   {report.min_quality_before:.4f} "
              f"{report.mean_quality_before:.5f}   {report.min_quality:.4f} {report.mean_quality:.5f}", flush=True)


print(f"{'mesh':22} {'points':>8}  {'movement':9} {'part':>6} {'solution':>10} {'improve':>10} {'ratio':>7} "
      f"{'steps':>6}   quality before   after")
for size in sys.argv[1].split():
    for kind in sys.argv[2].split():
        study(kind, shared.o_mesh(kind, int(float(size))), "airfoil")
for word in sys.argv[3:]:
    mesh, marker, name = shared.file_and_marker(word)
    study(name, mesh, marker)
