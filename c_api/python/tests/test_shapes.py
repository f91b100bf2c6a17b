"""Movements of a section, other airfoils, modes of a family, more control points, details of a fit."""

import harmorph
import numpy as np
import pytest
from test_curves import finite_differences, naca, section


def turned(points, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return points @ np.array([[c, s], [-s, c]])


def test_maps_of_the_section():
    airfoil = section()
    found = airfoil.move_section([harmorph.Movement("rotate"), harmorph.Movement("shift")], [10, 0.3, -0.2])
    assert isinstance(found, harmorph.Moved) and not found.error.any() and not found.start.any()
    after = airfoil.control + found.move
    assert abs(after - turned(airfoil.control, 10) - [0.3, -0.2]).max() < 1e-14
    scaled = airfoil.move_section([("scale", (0.25, 0.0))], [0.5])
    assert scaled.move == pytest.approx(0.5 * (airfoil.control - [0.25, 0]), abs=1e-15)
    flap = airfoil.move_section([harmorph.Movement("flap", (0.7, 0.0), 0.1)], [8.0]).move
    assert not flap[airfoil.control[:, 0] < 0.69].any()
    behind = airfoil.control[:, 0] > 0.82
    hinge = airfoil.control[behind] - [0.7, 0]
    assert behind.any() and abs(flap[behind] - (turned(hinge, 8) - hinge)).max() < 1e-12


@pytest.mark.parametrize("movement, n", [
    (harmorph.Movement("camber_thickness", n_camber=2, n_thickness=2), 4),
    (harmorph.Movement("parsec"), 11),
    (harmorph.Movement("blade"), 3),
])
def test_derivatives_by_the_values(movement, n, random):
    airfoil, values = section(), 0.01 * random.uniform(size=n)
    found = airfoil.move_section([movement], values)
    assert found.derivatives.shape == (n, 16, 2) and found.error.max() < 0.05
    estimate = finite_differences(lambda v: airfoil.move_section([movement], v).move.ravel(), values, 1e-7)
    assert abs(found.derivatives.reshape(n, -1).T - estimate).max() < 1e-5 * abs(estimate).max()
    assert not airfoil.move_section([movement]).move.any()


def test_another_airfoil():
    airfoil, other = section(), naca(t=0.15)
    move, report = airfoil.refit(other)
    assert report.max_error < 2e-3
    thicker = airfoil.moved(move)
    assert thicker.measure("max_thickness").values[0] == pytest.approx(0.15, abs=2e-3)
    far, _report = airfoil.refit(turned(3 * other, 20) + [5, 1], on_chord=True)
    assert abs(far - move).max() < 2e-3
    pair, _report = airfoil.refit(tuple(np.ascontiguousarray(other.T)), True, curve=0)
    assert np.array_equal(pair, move)


def test_modes_of_a_family(random):
    airfoil = section()
    first, second = (airfoil.refit(naca(t=t))[0] for t in (0.1, 0.15))
    family = np.array([a * first + b * second for a, b in random.normal(size=(5, 2))])
    modes, singular = airfoil.family_modes(family)
    assert (np.diff(singular) <= 0).all() and singular[2] < 1e-10 * singular[0] and not modes[2:].any()
    flat = family.reshape(5, -1)
    parts = np.linalg.lstsq(modes[:2].reshape(2, -1).T, flat.T, rcond=None)[0]
    assert abs(modes[:2].reshape(2, -1).T @ parts - flat.T).max() < 1e-10


@pytest.mark.parametrize("options", [dict(knots=[0.3, 0.6, 0.6]), dict(degree=4)])
def test_more_control_points(options, random):
    airfoil = section()
    finer, matrix = airfoil.refined(**options)
    u = np.linspace(*airfoil.range(), 50)
    assert len(finer.control) > 16 and abs(finer.points(u) - airfoil.points(u)).max() < 1e-14
    assert abs(matrix @ airfoil.control - finer.control).max() < 1e-14
    move = random.normal(size=(16, 2))
    assert abs(finer.moved(matrix @ move).points(u) - airfoil.moved(move).points(u)).max() < 1e-12


def test_details_of_a_fit(random):
    points = naca()
    angle = 2 * np.pi * np.arange(160) / 160
    noisy = np.stack([np.cos(angle), np.sin(angle)], 1) + 1e-3 * random.normal(size=(160, 2))
    rough, smooth = (harmorph.Curves.fit_points(noisy, True, 24, smoothing=one) for one in (0.0, 0.5))
    variation = [one.measure("curvature_variation").values[0] for one in (rough, smooth)]
    assert variation[1] < 0.2 * variation[0]
    enough = harmorph.Curves.fit_points(points, True, 40, tolerance=1e-3)
    assert enough.fit_report.max_error <= 1e-3 and len(enough.control) < 40
    with pytest.warns(harmorph.HarmorphWarning) as caught:
        harmorph.Curves.fit_points(points, True, 8, tolerance=1e-9)
    assert caught[0].message.code == harmorph.HarmorphWarning.FAR_FROM_POINTS
    weights = np.ones(len(points))
    weights[40] = 1e4
    heavy = harmorph.Curves.fit_points(points, True, 12, weights=weights)
    plain = harmorph.Curves.fit_points(points, True, 12)
    assert heavy.project(points[40])[1] < 0.1 * plain.project(points[40])[1]
    steps = np.linspace(0, 1, 30)
    arc = harmorph.Curves.fit_points(np.stack([steps, steps**2], 1), False, 8, begin=(1, 1), end=(2, 0))
    tangents = arc.points(arc.range(), derivative=1)
    assert tangents[0, 0] == pytest.approx(tangents[0, 1]) and abs(tangents[1, 1]) < 1e-12 * tangents[1, 0]


def test_smallest_values_and_other_bodies():
    one = section()
    two = harmorph.Curves(
        np.concatenate([one.control, one.control + [0, 0.5]]),
        curves=[one.curves[0], one.curves[0]._replace(indices=one.curves[0].indices + 16)],
    )
    found = two.measure(("distance", 1, 1), ("distance", 1, 1, 100.0), ("min_thickness", 0.2, 0.6),
                        ("min_thickness", 0.2, 0.6, 500.0), ("thickness", 0.6), "twist", curves=(0, 1))
    exact, smooth, least, bound, at_end, twist = found.values
    assert 0.37 < exact < 0.5 and smooth < exact and bound < least == pytest.approx(at_end, rel=1e-6)
    turn = one.moved(turned(one.control, -7) - one.control).measure("twist").values[0]
    assert turn - twist == pytest.approx(-7)


@pytest.mark.parametrize("call, words", [
    (lambda a: a.move_section([("roll",)], [1]), "unknown"),
    (lambda a: a.move_section([("rotate",)], [1, 2]), "values must have the shape"),
    (lambda a: a.move_section([]), ""),
    (lambda a: a.move_section([("rotate",)], [np.nan]), ""),
    (lambda a: a.refit(np.zeros((9, 2))), ""),
    (lambda a: a.refit(np.zeros((9, 3))), "shape"),
    (lambda a: a.family_modes(np.zeros((2, 5, 2))), "shape"),
    (lambda a: a.refined([2.0]), ""),
    (lambda a: a.refined([0.5], degree=4), ""),
    (lambda a: a.measure(("min_thickness", 0.2)), "written"),
    (lambda a: harmorph.Movement("roll"), "'roll' is unknown; known are .*'rotate'"),
    (lambda a: harmorph.Movement(["rotate"]), "unknown"),
    (lambda a: harmorph.Movement("rotate", 0.25), "centre must have two entries"),
    (lambda a: harmorph.Movement("flap", centre=(0, 0, 0)), "centre must have two entries"),
    (lambda a: a.measure(("distance", 5, 1)), ""),
    (lambda a: harmorph.Curves.fit_points(naca(), True, weights=[1.0]), ""),
    (lambda a: harmorph.Curves.fit_points(naca(), True, smoothing=-1.0), ""),
])
def test_refusals(call, words):
    with pytest.raises(harmorph.Error, match=words):
        call(section())


def test_a_movement_is_a_tuple():
    """Tuples and movements mean the same, and both are checked."""
    flap = harmorph.Movement("flap", (0.7, 0.0), length=0.1)
    assert flap == ("flap", (0.7, 0.0), 0.1, 0, 0) and "flap" in repr(flap)
    one = section()
    assert (one.move_section([flap], [3]).move == one.move_section([("flap", (0.7, 0.0), 0.1)], [3]).move).all()


@pytest.mark.parametrize("markers", [0, 1])
def test_pictures_of_curves(markers):
    import xml.etree.ElementTree as tree

    one = section() if markers == 0 else harmorph.Curves(np.array([[0.0, 0.0], [1, 2], [3, -1], [4, 0]]))
    root = tree.fromstring(one._repr_svg_())
    space = "{http://www.w3.org/2000/svg}"
    assert len(list(root.iter(f"{space}circle"))) == len(one.control)
    outline = next(each for each in root.iter(f"{space}path") if each.get("class") == "curve").get("d")[1:].split("L")
    # The picture shows points of the curve, to the scale of the picture.
    places = np.array([[float(x) for x in place.split()] for place in (outline[0], outline[len(outline) // 2])])
    first, last = one.range()
    knots = np.unique(one.curves[0].knots)
    assert len(outline) == 12 * (np.count_nonzero((knots >= first) & (knots <= last)) - 1) + 1
    scale = 600 / np.ptp(np.concatenate([one.control, one.points(np.linspace(first, last, 400))]), axis=0).max()
    spans = knots[(knots >= first) & (knots <= last)]
    u = np.concatenate([np.linspace(a, b, 12, endpoint=False) for a, b in zip(spans[:-1], spans[1:])] + [spans[-1:]])
    step = np.diff(one.points([u[0], u[len(u) // 2]]), axis=0) * [scale, -scale]
    assert abs(np.diff(places, axis=0) - step).max() < 0.02 * 600 / 100
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    assert len(one.plot().lines) == 2 * len(one.curves)
    pyplot.close("all")


def test_styles_of_pictures(mesh, curves):
    """Short names count as the long ones, a colour is that of the control points too; axes are demanded."""
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    axes = curves.plot(c="r", lw=3)
    assert [line.get_color() for line in axes.lines] == ["r", "r"] and axes.lines[1].get_linewidth() == 3
    assert mesh.plot(lw=2, color="g").collections[-1].get_linewidth()[0] == 2
    assert mesh.plot(linewidths=3, colors="g").collections[-1].get_linewidth()[0] == 3
    for use in (lambda: curves.plot(curves), lambda: curves.plot(curves.control), lambda: mesh.plot(ax=curves)):
        with pytest.raises(harmorph.Error, match="ax must be axes of matplotlib, not "):
            use()
    with pytest.raises(harmorph.Error, match="'c'"):
        curves.plot(c="r", color="g")
    pyplot.close("all")
