"""B-splines: fits, evaluation, measures and design variables."""

import copy
import pickle

import harmorph
import numpy as np
import pytest


def naca(n=81, t=0.12):
    """Points of a cambered section with a closed trailing edge, from there around."""
    x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, n)))
    y = 5 * t * (0.2969 * x**0.5 - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    camber = 0.1 * x * (1 - x)
    upper, lower = np.stack([x, camber + y], 1), np.stack([x, camber - y], 1)
    return np.concatenate([upper[::-1], lower[1:-1]])


def section():
    return harmorph.Curves.fit_points(naca(), True, n_control=16)


def test_a_straight_line_is_exact():
    line = harmorph.Curves([[0, 0], [1, 2], [2, 4], [3, 6]])
    u = np.linspace(*line.range(), 7)
    points = line.points(u)
    assert abs(points[:, 1] - 2 * points[:, 0]).max() < 1e-15
    assert np.array_equal(line.points(line.range()), line.control[[0, -1]])
    direction = line.points(u, derivative=1)
    assert abs(direction[:, 1] - 2 * direction[:, 0]).max() < 1e-13
    assert abs(line.basis(u) @ line.control - points).max() < 1e-15
    parameters, distances = line.project(points)
    assert parameters == pytest.approx(u, abs=1e-12) and distances == pytest.approx(0 * u, abs=1e-12)
    assert line.project(np.empty((0, 2)))[0].shape == (0,) and line.points(0.5).shape == (2,)
    parameter, distance = line.project((1.5 - 2, 3 + 1))
    assert distance == pytest.approx(5**0.5)
    assert line.points([parameter])[0] == pytest.approx([1.5, 3])


@pytest.mark.parametrize("closed", ["tied", "periodic"])
def test_closed_curves(closed):
    angle = 2 * np.pi * np.arange(8) / 8
    loop = harmorph.Curves(np.stack([np.cos(angle), np.sin(angle)], 1), closed=closed)
    ends = loop.points(loop.range())
    assert abs(ends[0] - ends[1]).max() < 1e-15
    tangents = loop.points(loop.range(), derivative=1)
    assert (abs(tangents[0] - tangents[1]).max() < 1e-14) == (closed == "periodic")


def test_rational_curves_are_circles():
    quarter = harmorph.Curves([[1, 0], [1, 1], [0, 1]], 2, weights=[1, 0.5**0.5, 1])
    assert np.hypot(*quarter.points(np.linspace(0, 1, 9)).T) == pytest.approx(np.ones(9))


def test_fits(mesh):
    fitted = harmorph.Curves.fit(mesh, "wall", n_control=24)
    assert fitted.markers == ("wall",) and fitted.fit_report.max_error < 2e-3
    wall, _ = mesh.wall("wall")
    distance = max(fitted.project(point)[1] for point in mesh.points[wall])
    assert distance == pytest.approx(fitted.fit_report.max_error, rel=1e-6)
    finer = harmorph.Curves.fit(mesh, ["wall"], n_control=48)
    assert finer.fit_report.max_error < fitted.fit_report.max_error
    pair = harmorph.Curves.fit_points(tuple(np.ascontiguousarray(naca().T)), True, n_control=16)
    assert np.array_equal(pair.control, section().control)


def test_airfoil_files(tmp_path):
    points = naca()
    selig = tmp_path / "selig.dat"
    selig.write_text("A section\n" + "".join(f"{x:.17g} {y:.17g}\n" for x, y in [*points, points[0]]))
    read = harmorph.Curves.read_airfoil(selig, 16)
    assert np.array_equal(read.control, section().control)
    upper, lower = points[:81][::-1], np.concatenate([points[80:], points[:1]])
    lednicer = tmp_path / "lednicer.dat"
    lines = ["A section", "81. 81.", ""]
    for side in (upper, lower):
        lines += [f"{x:.17g} {y:.17g}" for x, y in side] + [""]
    lednicer.write_text("\n".join(lines))
    assert np.array_equal(harmorph.Curves.read_airfoil(lednicer, 16).control, read.control)
    commas = "\n".join(f"{x:.17g};{y:.17g}".replace(".", ",") for x, y in points)
    selig.write_text("x;y\n" + commas)
    assert np.array_equal(harmorph.Curves.read_airfoil(selig, 16).control, read.control)
    # Two elements: the section, and the section at another place.
    both = [*points, points[0], (999.0, 999.0), *(points + [1.5, 0]), points[0] + [1.5, 0]]
    selig.write_text("two\n" + "".join(f"{x:.17g} {y:.17g}\n" for x, y in both))
    assert np.array_equal(harmorph.Curves.read_airfoil(selig, 16, element=1).control, read.control)
    second = harmorph.Curves.read_airfoil(selig, 16, element=2).control
    assert np.abs(second - read.control - [1.5, 0]).max() < 1e-8
    jump = "name\n" + "".join(f"{x:.17g} {y:.17g}\n" for x, y in [*points, (99, 99)])
    for text, words in (("", "x and y of a point"), ("name\n0 1\n1 2\n1 x\n", ":4: .*needs 2 numbers"),
                        ("n\n9. 9.\n0 0\n.5 .1\n1 0\n0 0\n.5 -.1\n1 0\n", "the file says 9"),
                        ("two\n" + "".join(f"{x:.17g} {y:.17g}\n" for x, y in both), "2 elements"),
                        (jump, "the outline jumps")):
        selig.write_text(text)
        with pytest.raises(harmorph.Error, match=words) as refused:
            harmorph.Curves.read_airfoil(selig)
        assert refused.value.code == harmorph.Error.BAD_FILE
    with pytest.raises(harmorph.Error, match="No such file"):
        harmorph.Curves.read_airfoil(tmp_path / "none.dat")


CURVE = harmorph.Curve(1, np.array([0, 0, 1, 1.0]), np.array([0, 1]))


@pytest.mark.parametrize("arguments, words", [
    (dict(control=[[0, 0], [1, 1]], degree=3), "less than the number"),
    (dict(control=[[0, 0], [1, 1]], degree=1, closed="round"), "'open', 'tied' or 'periodic'"),
    (dict(control=[0, 1]), r"\(n, 2\)"),
    (dict(control=[["a", "b"]]), "real numbers"),
    (dict(control=[[0, 0], [1, 1], [2, np.nan]], degree=1), ""),
    (dict(control=[[0, 0], [1, 1]], degree=1, weights=[1, -1]), ""),
    (dict(control=[[0, 0], [1, 1]], degree=1, weights=[1]), "shape"),
    (dict(control=[[0, 0], [1, 1]], curves=[CURVE._replace(knots=np.array([0, 1.0]))]), "needs 4 knots"),
    (dict(control=[[0, 0], [1, 1]], curves=[CURVE._replace(knots=np.array([0, 1, 0, 1.0]))]), "knot"),
    (dict(control=[[0, 0], [1, 1]], curves=[CURVE._replace(indices=np.array([0, 2]))]), ""),
])
def test_wrong_curves_are_refused(arguments, words):
    with pytest.raises(harmorph.Error, match=words):
        harmorph.Curves(**arguments)


def test_wrong_fits_are_refused(mesh):
    for call, words in ((lambda: harmorph.Curves.fit(mesh, "wing"), "no marker"),
                        (lambda: harmorph.Curves.fit(mesh, "wall", closed="round"), "closed must be"),
                        (lambda: harmorph.Curves.fit(mesh, "wall", n_control=2), ""),
                        (lambda: harmorph.Curves.fit_points(np.zeros((3, 2)), True), "")):
        with pytest.raises(harmorph.Error, match=words):
            call()


def test_a_fit_that_backtracks_warns():
    steps = np.linspace(0, 1, 5, endpoint=False)[:, None]
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    square = np.concatenate([a + steps * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0))])
    with pytest.warns(harmorph.HarmorphWarning) as caught:
        harmorph.Curves.fit_points(square, True, n_control=16, degree=5)
    assert caught[0].message.code == harmorph.HarmorphWarning.BACKTRACKS


def finite_differences(function, x, step=1e-6):
    result = np.empty((len(function(x)), *x.shape))
    for index in np.ndindex(x.shape):
        ahead, behind = x.copy(), x.copy()
        ahead[index] += step
        behind[index] -= step
        result[(slice(None), *index)] = (function(ahead) - function(behind)) / (2 * step)
    return result


QUANTITIES = ["area", "centroid_x", "centroid_y", "moment_xx", "moment_yy", "moment_xy", "chord",
              ("thickness", 0.3), ("camber", 0.4), "max_thickness", "leading_edge_radius",
              "trailing_edge_angle", "trailing_edge_gap", "min_radius", "curvature_variation",
              ("clearance", [[0.3, 0.0], [0.4, 0.01]])]


def test_measures_and_their_derivatives():
    airfoil = section()
    found = airfoil.measure(*QUANTITIES)
    assert isinstance(found, harmorph.Measures)
    by_name = dict(zip([str(one) for one in QUANTITIES], found.values))
    assert by_name["area"] == pytest.approx(0.0818, abs=5e-4)
    assert by_name["chord"] == pytest.approx(1, abs=1e-3)
    assert by_name["max_thickness"] == pytest.approx(0.12, abs=1e-3)
    assert by_name["trailing_edge_gap"] == 0
    assert found.places.shape == (16, 2)
    differences = finite_differences(
        lambda step: airfoil.moved(step).measure(*QUANTITIES).values, np.zeros_like(airfoil.control)
    )
    for wanted, exact, estimate in zip(QUANTITIES, found.gradients, differences):
        scale = abs(exact).max()
        assert abs(exact - estimate).max() <= 2e-4 * scale, wanted


@pytest.mark.parametrize("wrong, words", [
    ((), "at least one"),
    (("volume",), "unknown"),
    (("thickness",), r"'thickness' is written \('thickness', station\), not"),
    ((("camber",),), r"'camber' is written \('camber', station\), not"),
    ((("area", 0.5),), "'area' is written 'area', not"),
    ((("distance", 1),), r"written \('distance', other_curve, n_other \[, sharpness\]\), not"),
    (((["area"],),), "unknown"),
    ((("thickness", 1.5),), ""),
    ((("clearance", [0.0, 1.0]),), "shape"),
])
def test_wrong_quantities_are_refused(wrong, words):
    with pytest.raises(harmorph.Error, match=words):
        section().measure(*wrong)


def test_a_chord_of_ones_own(curves):
    with pytest.raises(harmorph.Error):
        curves.measure("chord")  # a periodic curve has none
    found = curves.measure("chord", ("thickness", 0.5), chord=((-1.4, 0), (1.4, 0)), curves=(0, 1))
    assert found.values == pytest.approx([2.8, 1.2], abs=0.02)


KINDS = {
    "ffd": dict(degrees=(3, 1)),
    "cst": dict(n_upper=4, n_lower=4),
    "hicks_henne": dict(n_upper=3, n_lower=2, peaks=[0.2, 0.4, 0.6, 0.3, 0.5]),
    "naca4": dict(n_upper=1),
}


@pytest.mark.parametrize("kind", KINDS)
def test_variables_and_their_transpose(kind, random):
    airfoil = section()
    variables = airfoil.variables(kind, **KINDS[kind])
    assert isinstance(variables, harmorph.Variables)
    n = {"ffd": 8, "cst": 8, "hicks_henne": 5, "naca4": 2}[kind]
    assert variables.n == n and variables.shape == ((n, 2) if kind == "ffd" else (n,))
    assert variables.components == (2 if kind == "ffd" else 1)
    assert variables.matrix.shape == (16, n) and variables.error.shape == (n, 2)
    values, gradient = random.normal(size=variables.shape), random.normal(size=(16, 2))
    left, right = (variables.move(values) * gradient).sum(), (values * variables.gradient(gradient)).sum()
    assert left == pytest.approx(right, rel=1e-12)


def test_a_unit_of_thickness():
    airfoil = section()
    variables = airfoil.variables("naca4")
    thicker = airfoil.moved(variables.move([0.03]))
    assert thicker.measure("max_thickness").values[0] == pytest.approx(0.15, abs=1e-3)


def test_a_box_that_moves_moves_the_section():
    airfoil = section()
    variables = airfoil.variables("ffd", degrees=(2, 1), box=((-0.5, -0.5), (1.5, 0.5)))
    assert abs(variables.move(np.tile([0.1, 0.2], (6, 1))) - [0.1, 0.2]).max() < 1e-10


@pytest.mark.parametrize("arguments, words", [
    (dict(kind="bumps"), "unknown"),
    (dict(kind="cst"), ""),
    (dict(kind="hicks_henne", n_upper=2, peaks=[0.5]), "peaks must have the shape"),
    (dict(kind="hicks_henne", n_upper=2, peaks=[0.5, 0.5]), ""),
    (dict(kind="cst", n_upper=3, exponents=(-1, 1)), ""),
    (dict(kind="hicks_henne", n_upper=2, width=0.5), ""),
])
def test_wrong_variables_are_refused(arguments, words):
    with pytest.raises(harmorph.Error, match=words):
        section().variables(**arguments)


def test_wrong_values_are_refused():
    variables = section().variables("cst", n_upper=2)
    with pytest.raises(harmorph.Error, match="shape"):
        variables.move(np.zeros(3))
    with pytest.raises(harmorph.Error, match="shape"):
        variables.gradient(np.zeros(32))


def test_smooth_gradients(random):
    airfoil, rough = section(), random.normal(size=(16, 2))
    assert np.array_equal(airfoil.smooth_gradient(rough, 0), rough)
    smooth = airfoil.smooth_gradient(rough, 0.2)
    assert (smooth * rough).sum() > 0 and np.abs(np.diff(smooth, axis=0)).sum() < np.abs(np.diff(rough, axis=0)).sum()
    with pytest.raises(harmorph.Error):
        airfoil.smooth_gradient(rough, -1)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies(curves, again):
    other = again(curves)
    assert np.array_equal(other.points([0.1, 0.2]), curves.points([0.1, 0.2]))
    assert other.markers == curves.markers and repr(other) == repr(curves)
    with pytest.raises(ValueError):
        other.control[0] = 0


def test_movements_of_other_shapes_are_refused(curves):
    with pytest.raises(harmorph.Error, match="shape"):
        curves.moved(np.zeros((3, 2)))
