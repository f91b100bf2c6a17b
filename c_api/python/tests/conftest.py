"""Meshes that the tests share."""

import os
from pathlib import Path

import harmorph
import numpy as np
import pytest

NI, NJ = 65, 17


def ring(ni=NI, nj=NJ, fat=0.4):
    """Coordinates (nj, ni, 2) of an O-mesh around an ellipse with half axes 1 + fat and 1 - fat."""
    angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
    radius = np.exp(2.0 * np.arange(nj) / (nj - 1))[:, None]
    x = (radius + fat / radius) * np.cos(angle)
    y = (radius - fat / radius) * np.sin(angle)
    return np.ascontiguousarray(np.stack([x, y], axis=-1))


def ring_mesh(**sizes):
    return harmorph.Mesh.structured(ring(**sizes), j_min="wall", j_max="far")


@pytest.fixture
def mesh():
    return ring_mesh()


@pytest.fixture(scope="session")
def curves():
    return harmorph.Curves.fit(ring_mesh(), "wall", n_control=12, closed="periodic")


@pytest.fixture(scope="session")
def morph(curves):
    """Shared: tests must not change it."""
    return harmorph.Morph(ring_mesh(), curves)


@pytest.fixture(scope="session")
def given():
    """Displacements are given at the wall. Shared: tests must not change it."""
    return harmorph.Morph(ring_mesh(), conditions={"wall": "given"})


@pytest.fixture
def move(curves):
    """The upper half of the curve goes up by a tenth."""
    step = np.zeros((12, 2))
    step[curves.control[:, 1] > 0, 1] = 0.1
    return step


@pytest.fixture(scope="session")
def meshes():
    """The folder of the mesh files of harmorph's own tests."""
    beside = Path(__file__).resolve().parents[3] / "build/meshes"
    folder = Path(os.environ.get("HARMORPH_MESHES", beside))
    if not (folder / "naca0012.su2").is_file():
        pytest.skip("the mesh files of harmorph's tests are not here")
    return folder


@pytest.fixture(scope="session")
def program():
    """The program harmorph."""
    path = os.environ.get("HARMORPH_PROGRAM", "")
    if not os.access(path, os.X_OK) or os.path.isdir(path):
        pytest.skip("HARMORPH_PROGRAM does not name the program")
    return path


@pytest.fixture
def random():
    return np.random.default_rng(7)
