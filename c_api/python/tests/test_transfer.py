"""Fields of one mesh on another: linear fields, transposes, refusals."""

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def linear(points):
    x, y = np.asarray(points).T
    return np.stack([1 + 2 * x - 3 * y, y])


def test_linear_fields_are_exact_inside(random):
    mesh = ring_mesh(ni=33, nj=9)
    corners = mesh.points[mesh.cell_rows()[1].reshape(-1, 4)]
    parts = random.dirichlet(np.ones(4), len(corners))
    inside = (parts[:, :, None] * corners).sum(axis=1)
    interpolation = harmorph.Interpolation(mesh, inside)
    assert interpolation.report.outside == 0 and not interpolation.distance.any()
    assert interpolation(linear(mesh.points)) == pytest.approx(linear(inside), abs=1e-12)
    assert interpolation(linear(mesh.points)[0]).shape == (len(inside),)


def test_the_transpose(random):
    mesh = ring_mesh(ni=33, nj=9)
    interpolation = harmorph.Interpolation(mesh, tuple(random.uniform(-8, 8, size=(2, 200))))
    assert interpolation.report.outside == np.count_nonzero(interpolation.distance) > 0
    fields, dj = random.normal(size=(3, mesh.n_points)), random.normal(size=(3, 200))
    left, right = (interpolation(fields) * dj).sum(), (fields * interpolation.adjoint(dj)).sum()
    assert left == pytest.approx(right, rel=1e-12)
    assert np.array_equal(interpolation.adjoint(dj[1]), interpolation.adjoint(dj)[1])


def test_refusals():
    mesh = ring_mesh(ni=33, nj=9)
    interpolation = harmorph.Interpolation(mesh, mesh.points)
    for call in (lambda: interpolation(np.zeros(3)), lambda: interpolation.adjoint(np.zeros((2, 3))),
                 lambda: harmorph.Interpolation(mesh, np.zeros((3, 3)))):
        with pytest.raises(harmorph.Error, match="shape"):
            call()
    with pytest.raises(harmorph.Error):
        harmorph.Interpolation(mesh, [[np.nan, 0.0]])
