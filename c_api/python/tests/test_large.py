"""Large movements, better cells, slip and given displacements."""

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def large(morph):
    """A movement that inverts cells in one step: the ellipse turns by 60 degrees."""
    control = morph.curves.control @ [1, 1j]
    turned = control * (np.exp(1j * np.pi / 3) - 1)
    return np.stack([turned.real, turned.imag], axis=1)


@pytest.fixture(scope="module")
def laplace(curves):
    return harmorph.Morph(ring_mesh(), curves, operator="laplace")


def test_a_safe_morph_reaches_the_target(laplace):
    move = large(laplace)
    assert laplace.assess(laplace.displacement(move)).quality.inverted > 0
    found = laplace.safe(move, derivative=True)
    assert isinstance(found, harmorph.Safe)
    assert found.report.step_fraction == 1 and found.report.inverted == 0
    assert laplace.assess(points=found.points).quality.inverted == 0
    assert found.reached == pytest.approx(move)
    assert found.derivative.functions == 12
    # The derivative along a control point, by finite differences at the wall.
    wall, _ = laplace.mesh.wall("wall")
    step = np.zeros_like(move)
    step[2, 1] = 1e-5
    ahead = laplace.safe(move + step).points
    difference = (ahead - found.points)[wall] / 1e-5
    assert difference == pytest.approx(found.derivative.displacement(step / 1e-5)[wall], abs=0.05)


def test_strategies(laplace, morph):
    move = large(laplace)
    with pytest.warns(harmorph.HarmorphWarning) as caught:
        short = laplace.safe(move, skip=["substeps", "untangled"], max_resolves=-1)
    assert caught[0].message.code == harmorph.HarmorphWarning.SHORT
    assert 0 < short.report.step_fraction < 1
    other = laplace.safe(move, others=[morph], skip=["substeps", "untangled", "improved"])
    assert other.report.strategy == "other" and other.report.other == 0
    out = np.empty((laplace.n_points, 2))
    assert laplace.safe(0.1 * move, out, improve=True, heights=1.0, min_quality=0.01,
                        max_height_change=5.0).points is out
    with pytest.raises(harmorph.Error, match="unknown"):
        laplace.safe(move, skip=["magic"])
    with pytest.raises(harmorph.Error, match="was closed"):
        closed = harmorph.Morph(ring_mesh(), laplace.curves)
        closed.close()
        laplace.safe(move, others=[closed])


@pytest.mark.parametrize("times", [3, 6])
def test_the_report_names_the_operator_that_the_library_tried_itself(morph, move, times):
    """Without `others`, functions of other operators are solved where the mesh would be poor."""
    found = morph.safe(times * move, skip=["improved"]).report
    assert found.strategy == "other" and found.other == "laplace" and found.resolves == 1
    first = morph.safe(times * move, skip=["improved"], min_quality=-1).report
    assert first.strategy == "linear" and first.other == -1


def test_an_impossible_target_is_refused(morph):
    out = np.full((morph.n_points, 2), 3.0)
    with pytest.raises(harmorph.Error) as refused:
        morph.safe(np.tile([100.0, 0.0], (12, 1)), out)
    assert refused.value.code == harmorph.Error.CROSSING and (out == 3).all()


def test_better_cells(laplace):
    moved = laplace.morph(0.3 * large(laplace))
    better, found = laplace.improve(moved)
    assert found.min_quality >= found.min_quality_before
    assert laplace.assess(points=better, reference=laplace.start).quality.min_quality == pytest.approx(
        found.min_quality)
    same = moved.copy()
    assert laplace.improve(same, same, reference=laplace.start, max_solutions=20)[0] is same
    assert np.array_equal(same, better)


def test_slip(curves, random):
    morph = harmorph.Morph(ring_mesh(), curves, {"far": "slip"})
    far, _ = morph.mesh.wall("far")
    moved = morph.morph(large(morph) * 0.1)
    assert np.abs(moved[far] - morph.start[far]).max() > 1e-3
    out = moved.copy()
    assert morph.slip(moved, out) is out
    assert abs(morph.slip(out) - out).max() < 1e-9
    # The adjoint is the transpose of the derivative.
    direction, dj = random.normal(size=moved.shape), random.normal(size=moved.shape)
    ahead, behind = morph.slip(moved + 1e-6 * direction), morph.slip(moved - 1e-6 * direction)
    estimate, exact = (ahead - behind) / 2e-6, morph.slip_derivative(moved, direction)
    assert abs(estimate - exact).max() < 1e-6
    assert (exact * dj).sum() == pytest.approx((direction * morph.slip_adjoint(moved, dj)).sum(), rel=1e-12)


def test_slip_along_a_curve(curves, tmp_path):
    circle = harmorph.Curves.fit(ring_mesh(), "far", n_control=20, closed="periodic")
    morph = harmorph.Morph(ring_mesh(), curves, {"far": harmorph.Condition("slip", along=circle)})
    moved = morph.slip(morph.morph(large(morph) * 0.1))
    far, _ = morph.mesh.wall("far")
    offset = max(circle.project(point)[1] for point in moved[far])
    assert offset < 1.5 * circle.fit_report.max_error + 1e-9
    morph.save(tmp_path / "slip.basis")  # with the curve along which points slip
    loaded = harmorph.Morph.load(tmp_path / "slip.basis", ring_mesh())
    assert np.array_equal(loaded.slip(loaded.morph(large(morph) * 0.1)), moved)


def test_given_displacements(given, random):
    points = given.given_points
    assert len(points) == 64
    wall = 0.01 * random.normal(size=(64, 2))
    displacement = given.displace(wall)
    assert np.array_equal(displacement[points], wall)
    moved = given.displace(wall, given.start)
    assert abs(moved - given.start - displacement).max() < 1e-15
    inside = given.start.copy()
    assert given.displace(wall, inside, inside) is inside and np.array_equal(inside, moved)
    within = np.zeros((given.n_points, 2))
    within[10:74] = wall
    assert np.array_equal(given.displace(within[10:74], out=within), displacement)
    order = random.permutation(64)
    assert np.array_equal(given.displace(wall[order], wall_points=points[order]), displacement)
    stack = given.displace(np.stack([wall, 2 * wall]))
    assert stack.shape == (2, given.n_points, 2)
    assert stack[0] == pytest.approx(displacement, abs=1e-15)
    assert stack[1] == pytest.approx(2 * displacement, abs=1e-15)
    assert given.assess(displacement).quality.inverted == 0


def test_given_forces(given, random):
    wall, dj = random.normal(size=(64, 2)), random.normal(size=(2, given.n_points, 2))
    force = given.displace_adjoint(dj[0])
    assert (given.displace(wall) * dj[0]).sum() == pytest.approx((wall * force).sum(), rel=1e-12)
    both = given.displace_adjoint(dj)
    assert both.shape == (2, 64, 2) and both[0] == pytest.approx(force, rel=1e-12, abs=1e-13)
    points = given.given_points[::-1].copy()
    assert given.displace_adjoint(dj[0], wall_points=points)[::-1] == pytest.approx(force, abs=1e-13)


def test_given_displacements_of_any_size(given):
    points = given.given_points
    z = given.start[points] @ [1, 1j]
    turned = z * (np.exp(1j * np.pi / 2) - 1)
    wall = np.stack([turned.real, turned.imag], axis=1)
    found = given.displace_safe(wall)
    assert found.report.step_fraction == 1 and found.derivative is None
    assert np.array_equal(found.points[points], given.start[points] + wall)
    assert given.assess(points=found.points).quality.inverted == 0
    # The factor is that of the start again.
    assert np.array_equal(given.displace(wall * 0.01)[points], wall * 0.01)


@pytest.mark.parametrize("use, words", [
    (lambda one: one.displace(np.zeros((63, 2))), "shape"),
    (lambda one: one.displace(np.zeros((64, 3))), "shape"),
    (lambda one: one.displace(np.zeros((64, 2), complex)), "real numbers"),
    (lambda one: one.displace(np.full((64, 2), np.nan)), ""),
    (lambda one: one.displace(np.zeros((2, 64, 2)), out=np.zeros((one.n_points, 2))), "single field"),
    (lambda one: one.displace(np.zeros((64, 2)), wall_points=np.zeros(64)), "integers"),
    (lambda one: one.displace(np.zeros((64, 2)), wall_points=np.full(64, 10**6)), ""),
    (lambda one: one.displace(np.zeros((2, 2)), wall_points=[0, 1]), ""),
    (lambda one: one.displace_adjoint(np.zeros((5, 2))), "shape"),
    (lambda one: one.displace_safe(np.zeros((2, 64, 2))), "one field"),
    (lambda one: one.displace_safe(np.zeros((64, 2)), np.zeros((1, 2))), "shape"),
])
def test_wrong_displacements_are_refused(given, use, words):
    with pytest.raises(harmorph.Error, match=words):
        use(given)


def test_given_displacements_need_given_markers(morph):
    with pytest.raises(harmorph.Error):
        morph.displace(np.zeros((64, 2)))


def test_crossing_walls_are_refused(given):
    points = given.given_points
    wall = np.zeros((64, 2))
    wall[0] = -2 * given.start[points[0]]
    with pytest.raises(harmorph.Error) as refused:
        given.displace(wall, given.start)
    assert refused.value.code == harmorph.Error.CROSSING


@pytest.mark.parametrize("given_reference", [False, True])
def test_better_cells_after_solving_again(curves, given_reference):
    """`start` is the reference also where it is not the mesh of the first analysis."""
    morph = harmorph.Morph(ring_mesh(), curves, operator="laplace")
    morph.solve(morph.morph(0.1 * large(morph)))
    moved = morph.morph(0.1 * large(morph))
    better, found = morph.improve(moved, reference=morph.start if given_reference else None)
    assert morph.assess(points=better, reference=morph.start).quality.min_quality == pytest.approx(found.min_quality)
