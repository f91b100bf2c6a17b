"""Smooth bounds of the quality and corners that limit a step: values, derivatives by differences, refusals."""

import harmorph
import numpy as np
import pytest
from conftest import ring, ring_mesh

KINDS = ("quality", "kept_quality", "area", "height", "stretch", "angle")


@pytest.fixture
def moved(morph, move):
    return morph.morph(0.3 * move)


def test_bounds_are_on_the_right_side(morph, moved):
    quality = harmorph.Quality(morph)
    found = quality.bounds(*KINDS, ("area", 5000.0), points=moved)
    assert isinstance(found, harmorph.Bounds) and found.gradients.shape == (7, morph.n_points, 2)
    below = found.extremes - found.values
    assert (below[[0, 1, 2, 3, 5]] >= 0).all() and below[4] <= 0 and 0 <= below[6] < below[2]
    start = quality.bounds(*KINDS)
    assert start.extremes[1:] == pytest.approx(np.ones(5), rel=1e-12)
    quads = morph.mesh.cell_rows()[1].reshape(-1, 4)

    def corner_areas(points):
        corner = points[quads]
        ahead, behind = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
        return ahead[..., 0] * behind[..., 1] - ahead[..., 1] * behind[..., 0]

    ratios = (corner_areas(moved) / corner_areas(morph.start)).min(axis=1)
    assert found.extremes[2] == pytest.approx(ratios.min(), rel=1e-10)
    assert ratios[found.items[2]] == ratios.min()


def test_derivatives_by_control_points(morph, move, moved, random):
    """The adjoint of the gradients is the derivative along a movement of the control points."""
    quality = harmorph.Quality(morph)
    direction, step = random.normal(size=move.shape), 1e-6
    found = quality.bounds(*KINDS, points=moved)
    ahead, behind = (quality.bounds(*KINDS, points=morph.morph(sign * step * direction, moved)).values
                     for sign in (1, -1))
    exact = [(morph.adjoint(gradient) * direction).sum() for gradient in found.gradients]
    assert exact == pytest.approx((ahead - behind) / (2 * step), rel=1e-4)


def test_the_corner_that_limits_a_step(morph, move, random):
    displacement = morph.displacement(move)
    quality, limit = harmorph.Quality(morph), morph.assess(displacement).step.admissible
    found = quality.corners(displacement)
    assert isinstance(found, harmorph.Corners)
    assert found.steps[0] == pytest.approx(limit, rel=1e-12) and len(found.steps) == len(found.cells)
    a, b, c = (morph.start + limit * displacement)[found.points[0]]
    assert abs((b - a)[0] * (c - b)[1] - (b - a)[1] * (c - b)[0]) < 1e-12
    change, step = random.normal(size=displacement.shape), 1e-7
    ahead, behind = (morph.assess(displacement + sign * step * change).step.admissible for sign in (1, -1))
    if len(found.steps) == 1:
        exact = limit * (found.by_points[0] * change[found.points[0]]).sum()
        assert exact == pytest.approx((ahead - behind) / (2 * step), rel=1e-5)
    more = quality.corners(displacement, morph.start, closeness=1.0)
    assert len(more.steps) > 16 and (np.diff(more.steps) >= 0).all() and more.steps[-1] <= 2 * limit
    nothing = quality.corners(np.zeros_like(displacement))
    assert len(nothing.steps) == 0 and nothing.points.shape == (0, 3)


def test_refusals(morph, curves, moved, tmp_path):
    quality = harmorph.Quality(morph)
    for wrong, words in ((("skew",), "unknown"), ((("area", 0.5),), "sharpness"), ((), "")):
        with pytest.raises(harmorph.Error, match=words):
            quality.bounds(*wrong)
    with pytest.raises(harmorph.Error, match="shape"):
        quality.bounds("area", points=moved[1:])
    path = tmp_path / "basis"
    morph.save(path)
    with harmorph.Morph.load(path) as without, pytest.raises(harmorph.Error, match="needs the mesh"):
        harmorph.Quality(without)


def test_the_object_outlives_the_morph(curves):
    mesh = harmorph.Mesh.structured(ring(), j_min="wall", j_max="far")
    with harmorph.Morph(mesh, curves) as one:
        quality = harmorph.Quality(one)
    assert quality.bounds("kept_quality").extremes == pytest.approx([1.0])
    threaded = harmorph.Quality(harmorph.Morph(ring_mesh(), curves, threads=2))
    points = ring().reshape(-1, 2) * 1.01
    assert np.array_equal(threaded.bounds(*KINDS, points=points).gradients,
                          quality.bounds(*KINDS, points=points).gradients)
