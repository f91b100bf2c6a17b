"""What a call from Python takes beyond the same call of the library, in microseconds of processor time.

Usage: PYTHONPATH=... python3 overhead.py [repetitions]

The library is called with structs that were made beforehand, by the same extension; the difference to the
method of harmorph.Morph is the overhead. The smallest of several runs counts, as other programs disturb. The
script prints and judges nothing.
"""
import sys
import time
import tracemalloc

import harmorph
import numpy as np
from harmorph._native import ffi, lib

repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 15


def mesh_of(ni, nj):
    angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
    r = np.exp(2 * np.arange(nj) / (nj - 1))[:, None]
    points = np.stack([(r + 0.4 / r) * np.cos(angle), (r - 0.4 / r) * np.sin(angle)], axis=-1)
    return harmorph.Mesh.structured(points, j_min="wall", j_max="far")


def interleaved(functions, calls=1000):
    """The smallest microseconds of each function, measured in turn."""
    best = [float("inf")] * len(functions)
    for _ in range(repetitions):
        for k, function in enumerate(functions):
            begun = time.process_time_ns()
            for _ in range(calls):
                function()
            best[k] = min(best[k], (time.process_time_ns() - begun) / calls / 1000)
    return best


print("points  call          library  method  overhead  [microseconds]; bytes allocated by the method")
for ni, nj in ((17, 5), (101, 50)):
    mesh = mesh_of(ni, nj)
    morph = harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=12, closed="periodic"), operator="laplace")
    n, move = mesh.n_points, np.full((12, 2), 0.01)
    out, dj, gradient, start = np.empty((n, 2)), np.ones((n, 2)), np.empty((12, 2)), np.array(morph.start)
    view = {id(one): ffi.from_buffer("double[]", one) for one in (move, out, dj, gradient, start)}
    basis, executor, error = morph._basis.pointer, morph._executor.view, ffi.new("hm_error*")

    def points(kind, array):
        first = view[id(array)]
        return ffi.new(kind, (first, first + 1, 2))

    to, from_, derivative = points("hm_points_out*", out), points("hm_points*", start), points("hm_points*", dj)
    step, result = view[id(move)], view[id(gradient)]
    calls = {
        "displacement": (lambda: lib.hm_morph(basis, step, ffi.NULL, to, executor, error),
                         lambda: morph.displacement(move, out)),
        "morph": (lambda: lib.hm_morph(basis, step, from_, to, executor, error),
                  lambda: morph.morph(move, start, out)),
        "adjoint": (lambda: lib.hm_adjoint(basis, derivative, result, executor, error),
                    lambda: morph.adjoint(dj, gradient)),
    }
    for name, pair in calls.items():
        library, method = interleaved(pair)
        tracemalloc.start()
        pair[1]()
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        pair[1]()
        peak = tracemalloc.get_traced_memory()[1] - before
        tracemalloc.stop()
        print(f"{n:6d}  {name:12s} {library:8.2f} {method:7.2f} {method - library:9.2f}   {peak} bytes")
