"""Refusals and warnings have code, kind, item, value and text."""

import copy
import pickle
import warnings

import harmorph
import numpy as np
import pytest
from conftest import ring


def test_a_refusal_names_code_kind_and_item():
    points = ring(9, 4).reshape(-1, 2)
    points[12] = 0  # the cells around this point are inverted
    mesh = harmorph.Mesh.structured(points.reshape(4, 9, 2), j_min="wall", j_max="far")
    with pytest.raises(harmorph.Error) as refused:
        harmorph.Morph(mesh, conditions={"wall": "given"})
    error = refused.value
    assert error.code == harmorph.Error.BAD_MESH and error.name == "HM_BAD_MESH"
    assert error.kind == "cell" and 0 <= error.item < mesh.n_cells
    assert error.value <= 0 and error.text == str(error) and "inverted" in error.text
    assert isinstance(error, ValueError)


def test_an_index_is_counted_from_0():
    points = ring(9, 4).reshape(-1, 2)
    points[7, 0] = np.nan
    mesh = harmorph.Mesh.structured(points.reshape(4, 9, 2), j_min="wall", j_max="far")
    with pytest.raises(harmorph.Error) as refused:
        mesh.report()
    assert (refused.value.kind, refused.value.item) == ("point", 7)


def test_a_marker_is_named(mesh):
    with pytest.raises(harmorph.Error, match="far.*wall") as refused:
        mesh.wall("wing")
    assert refused.value.code == harmorph.Error.BAD_CONDITION and refused.value.kind == "marker"


def test_warnings_are_python_warnings(mesh, curves):
    far = harmorph.Curves(curves.control * 1.3, curves=curves.curves)
    with pytest.warns(harmorph.HarmorphWarning) as caught:
        harmorph.Morph(mesh, far, {"wall": "curve"})
    warning = caught[0].message
    assert warning.code == harmorph.HarmorphWarning.FAR_FROM_CURVE and warning.kind == "point"
    assert warning.value > 0
    assert caught[0].filename == __file__


def test_warnings_can_be_errors(mesh, curves):
    far = harmorph.Curves(curves.control * 1.3, curves=curves.curves)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(harmorph.HarmorphWarning):
            harmorph.Morph(mesh, far, {"wall": "curve"})


def two_markers(split):
    """A ring whose wall has the markers a and b, which begin at the columns 0 and `split`."""
    ni, nj = 24, 6
    points = ring(ni + 1, nj)[:, :ni].reshape(-1, 2)
    at = np.arange(ni * nj).reshape(nj, ni)
    right = np.roll(at, -1, axis=1)
    cells = np.stack([at[:-1], right[:-1], right[1:], at[1:]], axis=-1).reshape(-1, 4)
    wall, far = np.stack([at[0], right[0]], axis=1), np.stack([at[-1], right[-1]], axis=1)
    return harmorph.Mesh(points, cells, {"a": wall[:split], "b": wall[split:], "far": far})


@pytest.mark.parametrize("split", [12, 7])
def test_points_of_two_moving_conditions(split):
    mesh = two_markers(split)
    bodies = [("a", harmorph.Condition("rigid", body=0)), ("b", harmorph.Condition("rigid", body=1))]
    with pytest.warns(harmorph.HarmorphWarning, match="also belongs to condition") as caught:
        morph = harmorph.Morph(mesh, conditions=bodies)
    assert caught[0].message.code == harmorph.HarmorphWarning.TORN
    assert sorted(morph.shared_points[:, 0]) == [0, split]
    assert {tuple(both) for both in morph.shared_points[:, 1:]} == {(0, 1)}
    move = np.zeros((4, 2))
    move[0] = 0.1, 0
    with pytest.warns(harmorph.HarmorphWarning, match="away from where condition 1 takes it"):
        assert np.isclose(morph.boundary_error(move, morph.morph(move)), 0.1)
    move[2] = move[0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert morph.boundary_error(move, morph.morph(move)) < 1e-14


def test_a_limit_for_the_distance_from_the_curve(mesh, curves):
    off = harmorph.Curves(curves.control * 1.05, curves=curves.curves)
    with pytest.raises(harmorph.Error, match="too far for a curve of this wall") as refused:
        harmorph.Morph(mesh, off, {"wall": "curve"}, max_curve_distance=0.01)
    assert refused.value.code == harmorph.Error.BAD_CONDITION


@pytest.mark.parametrize("again", [copy.copy, lambda one: pickle.loads(pickle.dumps(one))])
def test_errors_can_be_copied(again):
    error = harmorph.Error("text", harmorph.Error.BAD_MESH, "cell", 4, "point", 5, 0.5, (1.0, 2.0))
    other = again(error)
    assert type(other) is harmorph.Error and vars(other) == vars(error)


def test_the_codes_are_those_of_the_header():
    names = ["CANCELLED", "BAD_ARGUMENT", "BAD_MESH", "BAD_CURVE", "BAD_CONDITION", "BAD_BASIS",
             "BLOCK_TOO_SMALL", "NOT_POSITIVE", "UNSUPPORTED", "CROSSING"]
    assert [getattr(harmorph.Error, name) for name in names] == list(range(-1, -11, -1))
    for name in names:
        assert harmorph.Error("", getattr(harmorph.Error, name)).name == "HM_" + name
    assert harmorph.Error("", harmorph.Error.BAD_FILE).name == "BAD_FILE"


@pytest.mark.parametrize("use", [
    lambda mesh, curves, morph: harmorph.Curves.fit(mesh, "wall", n_control="many"),
    lambda mesh, curves, morph: harmorph.Curves.fit(mesh, "wall", n_control=2**40),
    lambda mesh, curves, morph: curves.points([0.1], curve="first"),
    lambda mesh, curves, morph: curves.points([0.1], curve=1),
    lambda mesh, curves, morph: curves.points([0.1], derivative=6),
    lambda mesh, curves, morph: curves.points("ab"),
    lambda mesh, curves, morph: curves.basis([0.1], curve=1),
    lambda mesh, curves, morph: curves.range(1),
    lambda mesh, curves, morph: curves.project(3.0),
    lambda mesh, curves, morph: curves.project(("a", 1)),
    lambda mesh, curves, morph: curves.smooth_gradient(np.zeros((12, 2)), "far"),
    lambda mesh, curves, morph: curves.measure("area", chord=(1, 2, 3)),
    lambda mesh, curves, morph: curves.measure(("thickness", "half"), chord=((-1, 0), (1, 0))),
    lambda mesh, curves, morph: curves.measure("area", curves="all"),
    lambda mesh, curves, morph: curves.variables("ffd", degrees=3),
    lambda mesh, curves, morph: curves.variables("ffd", box=(0, 1)),
    lambda mesh, curves, morph: curves.variables("cst", n_upper=2.5),
    lambda mesh, curves, morph: mesh.wall("wall", piece="first"),
    lambda mesh, curves, morph: morph.safe(np.zeros((12, 2)), heights="all"),
    lambda mesh, curves, morph: morph.safe(np.zeros((12, 2)), max_resolves=1.5),
    lambda mesh, curves, morph: morph.improve(morph.start, max_solutions="all"),
    lambda mesh, curves, morph: harmorph.Morph(mesh, curves, tolerance="small"),
    lambda mesh, curves, morph: harmorph.Morph(mesh, curves, exponent="small"),
    lambda mesh, curves, morph: harmorph.Morph(
        mesh, conditions={"wall": harmorph.Condition("rigid", centre=3)}),
    lambda mesh, curves, morph: harmorph.Morph(
        mesh, conditions={"wall": harmorph.Condition("rigid", body="flap")}),
    lambda mesh, curves, morph: harmorph.Morph(
        mesh, curves, {"far": harmorph.Condition("slip", near="here")}),
    lambda mesh, curves, morph: harmorph.Plane(np.zeros((4, 3)), [[0, 1, 2]], {}, axis=(1, 2)),
])
def test_arguments_of_another_type_are_refusals_too(mesh, curves, morph, use):
    with pytest.raises(harmorph.Error):
        use(mesh, curves, morph)


@pytest.mark.parametrize("use, words", [
    (lambda mesh, curves, morph: harmorph.Curves.fit(mesh, "wall", ncontrol=16),
     "Curves.fit has no option 'ncontrol'; options are n_control, degree.*did you mean 'n_control'"),
    (lambda mesh, curves, morph: harmorph.Morph(mesh, curves, operater="laplace"), "Morph has no .*'operator'"),
    (lambda mesh, curves, morph: morph.assess(displacment=morph.start), "Morph.assess has no .*'displacement'"),
    (lambda mesh, curves, morph: morph.safe(np.zeros((12, 2)), impruve=True), "Morph.safe has no .*'improve'"),
    (lambda mesh, curves, morph: harmorph.Mesh.read("a.su2", fromat="su2"), "Mesh.read has no .*'format'"),
    (lambda mesh, curves, morph: harmorph.Movement("flap", center=(1, 0)), "Movement has no .*'centre'"),
    (lambda mesh, curves, morph: harmorph.Condition("rigid", center=(1, 0)), "Condition has no .*'centre'"),
    (lambda mesh, curves, morph: curves.variables("ffd", degree=(1, 1)), "Variables has no .*'degrees'"),
    (lambda mesh, curves, morph: harmorph.rigid(degree=3), "rigid has no .*'degrees'"),
    (lambda mesh, curves, morph: morph.safe(), "Morph.safe: missing a required argument: 'move'"),
])
def test_a_wrong_name_of_an_argument_is_a_refusal_that_lists_the_options(mesh, curves, morph, use, words):
    with pytest.raises(harmorph.Error, match=words):
        use(mesh, curves, morph)


@pytest.mark.parametrize("use, words", [
    (lambda mesh, curves: harmorph.Morph(mesh, curves, operator="laplace", offset_correction=True),
     r'^offset_correction must be 0 unless the operator is "conformal"'),
    (lambda mesh, curves: curves.points([0.1], derivative=6), "^derivative must be between 0 and 5"),
    (lambda mesh, curves: harmorph.Morph(mesh, curves, {"far": "free"}), "free boundaries .\"free\"."),
    (lambda mesh, curves: harmorph.Morph(mesh, curves, exponent=0.3), "^exponent must be a multiple of 0.25"),
])
def test_texts_name_arguments_and_words_of_python(mesh, curves, use, words):
    with pytest.raises(harmorph.Error, match=words) as refused:
        use(mesh, curves)
    assert "HM_" not in str(refused.value) and "hm_" not in str(refused.value)


@pytest.mark.parametrize("bad", [(np.nan, 0.0), (1.0, np.inf)])
def test_coordinates_that_are_not_finite(mesh, morph, tmp_path, bad):
    """Files and pictures refuse them with the point; movements carry them on."""
    points = morph.start.copy()
    points[7] = bad
    other = mesh.with_points(points)
    for use in (lambda: other.write(tmp_path / "a.su2"), lambda: mesh.write(tmp_path / "a.su2", points),
                lambda: other._repr_svg_(), other.plot, lambda: mesh.plot(points), other.report):
        with pytest.raises(harmorph.Error) as refused:
            use()
        assert (refused.value.code, refused.value.kind, refused.value.item) == (harmorph.Error.BAD_MESH, "point", 7)
    assert not list(tmp_path.iterdir())
    moved = morph.morph(np.zeros((12, 2)), points)
    assert np.array_equal(moved, points, equal_nan=True)
    assert morph.assess(points=points).quality.inverted == 2
