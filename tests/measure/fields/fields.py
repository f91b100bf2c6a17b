"""Milliseconds of processor time of the calls for fields of moving meshes, on one thread, the fastest of several calls.

usage: fields.py [POINTS]     a million points unless another number is given
"""

import sys

import numpy as np
import harmorph
from shared import fastest, o_mesh


def row(what, function, runs=5):
    print(f"{what:52} {1e3 * fastest(function, runs):8.2f} ms", flush=True)


def walls_and_areas(mesh):
    before = mesh.points.copy()
    bent = before + np.stack([0 * before[:, 0], 1e-2 * np.sin(before[:, 0])], axis=1)
    row("swept areas of all sides and dual faces", lambda: harmorph.swept_areas(mesh, bent))
    walls = harmorph.Walls(mesh, ["airfoil"])
    hint = walls.distance(before).face  # the walls bend a little between two calls, as in a step of a solver
    row("walls move", lambda: walls.move(bent))
    row("wall distances without hints", lambda: walls.distance(bent))
    row("wall distances, the faces before the movement hints", lambda: walls.distance(bent, hint))
    assert np.array_equal(walls.distance(bent).distance, walls.distance(bent, hint).distance)


def transfers(mesh, other):
    row("analysis of the mesh with the fields", mesh.report, 2)
    shuffled = np.random.default_rng(1).permutation(other.points)
    row("analysis, cells and weights of all points", lambda: harmorph.Interpolation(mesh, other.points), 2)
    row("the same, the points in random order", lambda: harmorph.Interpolation(mesh, shuffled), 2)
    interpolation, field = harmorph.Interpolation(mesh, other.points), mesh.points[:, 0].copy()
    row("one field", lambda: interpolation(field))


size = int(sys.argv[1]) if len(sys.argv) > 1 else 1000000
meshes = {kind: o_mesh(kind, size) for kind in ("viscous", "triangles")}
for (kind, mesh), other in zip(meshes.items(), reversed(meshes.values())):
    print(f"{kind}: {mesh.n_points} points, {mesh.n_cells} cells")
    walls_and_areas(mesh)
    transfers(mesh, other)
