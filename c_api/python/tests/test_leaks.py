"""Nothing is lost in 100 000 calls and objects: counts of objects and bytes, not times."""

import gc
import tracemalloc

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def resident():
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096
    except OSError:
        pytest.skip("/proc is not here")


@pytest.fixture(scope="module")
def small():
    mesh = ring_mesh(ni=17, nj=5)
    return harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=6, closed="periodic"))


def calls(small):
    move, out, dj = np.full((6, 2), 0.01), np.empty((85, 2)), np.ones((85, 2))
    gradient, strided = np.empty((6, 2)), np.zeros((85, 3))[:, :2]
    return {
        "displacement": lambda: small.displacement(move, out),
        "a new array": lambda: small.morph(move),
        "strided": lambda: small.morph(move, strided, strided),
        "adjoint": lambda: small.adjoint(dj, gradient),
        "refusal": lambda: refused(small),
        "assess": lambda: small.assess(),
    }


def refused(small):
    try:
        small.displacement(np.zeros(3))
    except harmorph.Error:
        pass


NUMBERS = {"displacement": 30000, "a new array": 20000, "strided": 20000, "adjoint": 20000,
           "refusal": 8000, "assess": 2000}


@pytest.mark.parametrize("name", NUMBERS)
def test_calls(small, name):
    """All calls together are 100 000."""
    assert sum(NUMBERS.values()) == 100000
    function = calls(small)[name]
    for _ in range(1000):
        function()
    gc.collect()
    objects, memory = len(gc.get_objects()), resident()
    for _ in range(NUMBERS[name]):
        function()
    gc.collect()
    assert len(gc.get_objects()) <= objects + 20
    assert resident() <= memory + 2**20
    tracemalloc.start()
    function()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(500):
        function()
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert after - before < 4096


def make_mesh():
    return ring_mesh(ni=5, nj=3)


def make_morph():
    return harmorph.Morph(make_mesh(), conditions={"wall": "given"})


def make_curves():
    return harmorph.Curves([[0, 0], [1, 1], [2, 0], [3, 3]])


def make_pool():
    return harmorph.Morph(make_mesh(), conditions={"wall": "given"}, threads=2)


@pytest.mark.parametrize("make, number", [(make_mesh, 2000), (make_morph, 600), (make_curves, 5000),
                                          (make_pool, 300)])
def test_objects(make, number):
    for _ in range(100):
        make()
    gc.collect()
    objects, memory = len(gc.get_objects()), resident()
    for _ in range(number):
        make()
    gc.collect()
    assert len(gc.get_objects()) <= objects + 20
    assert resident() <= memory + 4 * 2**20
