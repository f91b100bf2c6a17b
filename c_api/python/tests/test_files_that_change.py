"""Files that other programs shorten or rewrite after they were read: the objects do not notice."""

import gzip
import os

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def shorten(path):
    os.truncate(path, 100)


def empty(path):
    open(path, "wb").close()


def rewrite_in_place(path):
    with open(path, "r+b") as file:
        data = file.read()
        file.seek(0)
        file.write(data[::-1])


CHANGES = [shorten, empty, rewrite_in_place]


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("ending", [".su2", ".msh", ".vtk", ".vtu", ".su2.gz"])
def test_a_mesh_is_written_as_it_was_read(tmp_path, change, ending):
    made, copy = tmp_path / f"made{ending}", tmp_path / f"copy{ending}"
    if ending.endswith(".gz"):
        ring_mesh(ni=33, nj=9).write(tmp_path / "plain.su2")
        made.write_bytes(gzip.compress((tmp_path / "plain.su2").read_bytes()))
    else:
        ring_mesh(ni=33, nj=9).write(made)
    copy.write_bytes(made.read_bytes())
    mesh = harmorph.Mesh.read(copy)
    change(copy)
    mesh.write(tmp_path / f"out{ending}")
    assert (tmp_path / f"out{ending}").read_bytes() == made.read_bytes()


@pytest.mark.parametrize("change", CHANGES)
def test_a_basis_moves_the_mesh_as_it_was_saved(tmp_path, change, curves):
    mesh = ring_mesh()
    solved = harmorph.Morph(mesh, curves)
    path = tmp_path / "ring.basis"
    solved.save(path)
    loaded = harmorph.Morph.load(path, mesh)
    move = np.zeros((solved.functions, 2))
    move[2] = 0.1, -0.05
    expected = solved.displacement(move)
    change(path)
    assert np.array_equal(loaded.displacement(move), expected)
