"""Fields of moving meshes: swept areas, distances to walls, heights of the first layer."""

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def moved(mesh):
    x, y = mesh.points.T
    return np.stack([x + 0.02 * np.sin(3 * y), y + 0.03 * x * x], axis=1)


def area(points, quads):
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    first, second = c - a, d - b
    return 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def test_swept_areas_close_each_cell():
    mesh = ring_mesh(ni=33, nj=9)
    to = moved(mesh)
    swept = harmorph.swept_areas(mesh, to)
    quads = mesh.cell_rows()[1].reshape(-1, 4)
    growth = np.abs(area(to, quads) - area(mesh.points, quads))
    assert np.abs(swept.sides.reshape(-1, 4).sum(axis=1)) == pytest.approx(growth, abs=1e-14)
    assert swept.halves.sum(axis=1) == pytest.approx(swept.sides, abs=1e-15)
    back = harmorph.swept_areas(mesh, mesh.points, start=to)
    assert np.array_equal(back.sides, -swept.sides) and np.array_equal(back.duals, -swept.duals)


def closed_area(points):
    x, y = points.T
    return 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()


def repeats_points(layout):
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5], [2, 1.5]], float)
    outline = [0, 1, 4, 5, 2, 3, 0]
    quads = np.array([[1, 4, 2, 2], [0, 1, 2, 3], [4, 5, 2, 2]], np.int32)
    if layout == "mixed":
        return harmorph.Mesh(points, (quads[2:, :3].copy(), quads[:2]), {"b": np.array(outline)})
    return harmorph.Mesh(points, quads, {"b": np.array(outline)})


@pytest.mark.parametrize("layout", ["quads", "mixed"])
def test_swept_areas_have_the_numbering_of_cell_rows(layout):
    mesh = repeats_points(layout)
    to = moved(mesh)
    swept, (start, points) = harmorph.swept_areas(mesh, to), mesh.cell_rows()
    assert len(swept.sides) == len(swept.duals) == len(swept.halves) == len(points)
    for begin, end in zip(start, start[1:]):
        corners = points[begin:end]
        growth = closed_area(to[corners]) - closed_area(mesh.points[corners])
        assert swept.sides[begin:end].sum() == pytest.approx(growth, abs=1e-14)
        a, b = mesh.points[corners], to[corners]
        for k in range(len(corners)):
            ends = [k, (k + 1) % len(corners)]
            quad = np.concatenate([a[ends], b[ends][::-1]])
            assert swept.sides[begin + k] == pytest.approx(-closed_area(quad), abs=1e-14)


def test_distances_are_those_of_the_nearest_face():
    mesh = ring_mesh(ni=33, nj=9)
    walls = harmorph.Walls(mesh, ["wall"])
    to = moved(mesh)
    before = walls.distance(mesh.points)
    walls.move(to)
    found = walls.distance(to, hint=before.face)
    assert np.array_equal(found.distance, walls.distance(to).distance)
    first, second = (to[walls.faces[:, k]] for k in range(2))
    along = second - first
    t = ((to[:, None] - first) * along).sum(axis=2) / (along**2).sum(axis=1)
    off = to[:, None] - first - np.clip(t, 0, 1)[:, :, None] * along
    assert found.distance == pytest.approx(np.sqrt((off**2).sum(axis=2)).min(axis=1), abs=1e-14)
    assert not found.distance[walls.points].any()
    place = (1 - found.parameter)[:, None] * first[found.face] + found.parameter[:, None] * second[found.face]
    assert np.hypot(*(to - place).T) == pytest.approx(found.distance, abs=1e-14)
    heights = walls.heights(to)
    assert heights == pytest.approx(found.distance[walls.layer_points], rel=0.1)
    turned = 1.5 * mesh.points[:, ::-1] * (-1, 1)
    ratios, angles = walls.layer_changes(mesh.points, turned)
    assert ratios == pytest.approx(1.5, rel=1e-12) and angles == pytest.approx(0, abs=1e-5)
    with pytest.raises(harmorph.Error, match="no marker 'wing'"):
        harmorph.Walls(mesh, ["wing"])
    with pytest.raises(harmorph.Error, match="hint must have the shape"):
        walls.distance(to, hint=before.face[1:])


def test_derivatives_of_distances(random):
    mesh = ring_mesh(ni=33, nj=9)
    walls = harmorph.Walls(mesh, ["wall"])
    points = mesh.points[64:] + 1e-3 * random.normal(size=(len(mesh.points) - 64, 2))
    face = walls.distance(points).face
    change, mesh_change = random.normal(size=points.shape), random.normal(size=mesh.points.shape)

    def distance(step):
        walls.move(mesh.points + step * mesh_change)
        return walls.distance(points + step * change).distance

    estimate = (distance(1e-7) - distance(-1e-7)) / 2e-7
    walls.move(mesh.points)
    exact = walls.distance_change(points, face, change, mesh_change)
    assert np.median(abs(exact - estimate)) < 1e-6
    parts = walls.distance_change(points, face, change), walls.distance_change(points, face, None, mesh_change)
    assert parts[0] + parts[1] == pytest.approx(exact, abs=1e-14)
    dj = random.normal(size=len(points))
    point_dj, mesh_dj = walls.distance_adjoint(points, face, dj)
    assert (point_dj * change).sum() + (mesh_dj * mesh_change).sum() == pytest.approx(dj @ exact, rel=1e-12)
    with pytest.raises(harmorph.Error, match="face must have the shape"):
        walls.distance_change(points, face[1:])
