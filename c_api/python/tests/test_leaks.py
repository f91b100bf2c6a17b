"""Nothing is lost in 100 000 calls and 100 000 objects: counts of objects and bytes, not times."""

import copy
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


def nothing_is_lost(function, number, room):
    """Neither Python's objects nor, by more than `room` bytes, the resident memory grow."""
    for _ in range(min(1000, number // 10)):
        function()
    gc.collect()
    objects, memory = len(gc.get_objects()), resident()
    for _ in range(number):
        function()
    gc.collect()
    assert len(gc.get_objects()) <= objects + 20
    assert resident() <= memory + room
    tracemalloc.start()
    function()
    gc.collect()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(500):
        function()
    gc.collect()
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert after - before < 4096


@pytest.mark.parametrize("name", NUMBERS)
def test_calls(small, name):
    """All calls together are 100 000."""
    assert sum(NUMBERS.values()) == 100000
    nothing_is_lost(calls(small)[name], NUMBERS[name], 2**20)


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    """Functions that make an object of a mesh of 15 points."""
    mesh = ring_mesh(ni=5, nj=3)
    boundary = {name: mesh.faces(name) for name in mesh.markers}
    cells, path = mesh.cell_rows()[1].reshape(-1, 4), tmp_path_factory.mktemp("basis") / "basis"
    curves = harmorph.Curves.fit(mesh, "wall", n_control=4, degree=1, closed="periodic")
    morph = harmorph.Morph(mesh, curves)
    morph.save(path)
    given = {"wall": "given"}
    return {
        "Mesh": lambda: harmorph.Mesh(mesh.points, cells, boundary),
        "Curves": lambda: harmorph.Curves(curves.control, 1, "periodic"),
        "Morph": lambda: harmorph.Morph(mesh, conditions=given),
        "threads": lambda: harmorph.Morph(mesh, conditions=given, threads=2),
        "load": lambda: harmorph.Morph.load(path),
        "copy": lambda: copy.copy(morph),
        "Quality": lambda: harmorph.Quality(morph),
        "Walls": lambda: harmorph.Walls(mesh, ["wall"]),
        "Interpolation": lambda: harmorph.Interpolation(mesh, mesh.points),
    }


OBJECTS = {"Mesh": 20000, "Curves": 14000, "Morph": 4000, "threads": 500, "load": 20000, "copy": 22000,
           "Quality": 15000, "Walls": 2250, "Interpolation": 2250}


@pytest.mark.parametrize("name", OBJECTS)
def test_objects(objects, name):
    """All objects together are 100 000. Each has arrays of its own, and "load" maps a file."""
    assert sum(OBJECTS.values()) == 100000
    nothing_is_lost(objects[name], OBJECTS[name], 2 * 2**20)
