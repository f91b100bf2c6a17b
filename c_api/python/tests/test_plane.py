"""Meshes one cell thick: planes and wedges."""

import copy

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def thick(mesh, wedge=False, layers=2):
    """The mesh in three dimensions: `layers` planes z = 0, 1, ..., or the two sides of a wedge."""
    n, (x, y) = mesh.n_points, mesh.points.T
    if wedge:
        low, high = -0.02, 0.02
        parts = [np.stack([x, (y + 9) * np.cos(a), (y + 9) * np.sin(a)], 1) for a in (low, high)]
    else:
        parts = [np.stack([x, y, np.full(n, float(k))], 1) for k in range(layers)]
    start, points = mesh.cell_rows()
    faces = points.reshape(-1, 4)
    sides = {name: np.concatenate([
        np.column_stack([mesh.faces(name) + k * n, mesh.faces(name)[:, ::-1] + (k + 1) * n])
        for k in range(len(parts) - 1)]) for name in mesh.markers}
    return np.concatenate(parts), faces, sides


@pytest.mark.parametrize("wedge", [False, True])
def test_spread_and_gather(random, wedge):
    mesh = ring_mesh(ni=17, nj=5)
    points, faces, sides = thick(mesh, wedge)
    plane = harmorph.Plane(points, faces, sides)
    assert plane.info.layers == 2 and plane.mesh.n_points == mesh.n_points
    assert plane.mesh.report().boundary_edges == mesh.report().boundary_edges
    assert set(plane.mesh.markers) == set(mesh.markers)
    assert np.array_equal(np.bincount(plane.follows), np.full(mesh.n_points, 2))
    displacement, dj = random.normal(size=(mesh.n_points, 2)), random.normal(size=points.shape)
    spread = plane.spread(displacement)
    assert (spread * dj).sum() == pytest.approx((displacement * plane.gather(dj)).sum(), rel=1e-12)
    assert plane.spread(displacement, plane.points) == pytest.approx(points + spread, abs=1e-14)
    if not wedge:
        assert np.array_equal(spread[:, 2], np.zeros(len(points)))


def test_several_layers_and_triangles():
    mesh = ring_mesh(ni=9, nj=3)
    points, faces, sides = thick(mesh, layers=4)
    assert harmorph.Plane(points, faces, sides, kind="planes").info.layers == 4
    triangles = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    assert harmorph.Plane(points, triangles, sides).mesh.report().triangles == len(triangles)


def test_wrong_arrays_are_refused():
    points, faces, sides = thick(ring_mesh(ni=9, nj=3))
    bent = points.copy()
    bent[30] += 0.1
    for arguments, words in (((points[:, :2], faces, sides), "shape"), ((points, faces[:, :2], sides), "columns"),
                             ((points, faces, {"wall": [[0, 1, 2]]}), "columns"),
                             ((bent, faces, sides), "")):
        with pytest.raises(harmorph.Error, match=words):
            harmorph.Plane(*arguments)
    with pytest.raises(harmorph.Error, match="kind"):
        harmorph.Plane(points, faces, sides, kind="cube")
    plane = harmorph.Plane(points, faces, sides)
    with pytest.raises(harmorph.Error, match="shape"):
        plane.gather(np.zeros((3, 3)))
    with pytest.raises(TypeError):
        copy.copy(plane)


@pytest.mark.parametrize("wedge", [False, True])
def test_vectors_of_the_plane(random, wedge):
    mesh = ring_mesh(ni=9, nj=3)
    points, faces, sides = thick(mesh, wedge)
    plane = harmorph.Plane(points, faces, sides)
    displacement = random.normal(size=(mesh.n_points, 2))
    vectors = plane.from_plane(displacement[plane.follows], points)
    assert vectors == pytest.approx(plane.spread(displacement), abs=1e-14)
    back = plane.to_plane(vectors, points)
    assert back[:, :2] == pytest.approx(displacement[plane.follows], abs=1e-14)
    assert back[:, 2] == pytest.approx(np.zeros(len(points)), abs=1e-14)
    any_vectors = random.normal(size=points.shape)
    lengths = np.linalg.norm(plane.to_plane(any_vectors, points), axis=1)
    assert lengths == pytest.approx(np.linalg.norm(any_vectors, axis=1))
