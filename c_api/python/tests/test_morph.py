"""Morph, adjoint and assessment; rigid bodies and conditions; copies and files."""

import copy
import pickle

import harmorph
import numpy as np
import pytest
from conftest import ring, ring_mesh
from harmorph._native import ffi


def test_the_wall_follows_the_curve(morph, curves, move):
    moved = morph.morph(move)
    wall, _ = morph.mesh.wall("wall")
    before, after = curves, curves.moved(move)
    for point in wall[::8]:
        u, distance = before.project(morph.start[point])
        expected = morph.start[point] + after.points([u])[0] - before.points([u])[0]
        assert moved[point] == pytest.approx(expected, abs=1e-12)
    far, _ = morph.mesh.wall("far")
    assert np.array_equal(moved[far], morph.start[far])


def test_a_movement_is_linear(morph, move, random):
    other = random.normal(size=move.shape)
    both = morph.displacement(2 * move + other)
    assert abs(both - 2 * morph.displacement(move) - morph.displacement(other)).max() < 1e-13
    assert np.array_equal(morph.morph(np.zeros_like(move)), morph.start)
    assert abs(morph.morph(move) - morph.start - morph.displacement(move)).max() < 1e-15


@pytest.mark.parametrize("operator", ["conformal", "laplace", "weighted"])
def test_the_adjoint_is_the_transpose(curves, random, operator):
    morph = harmorph.Morph(ring_mesh(), curves, operator=operator)
    move, dj = random.normal(size=(12, 2)), random.normal(size=(morph.n_points, 2))
    left, right = (morph.displacement(move) * dj).sum(), (move * morph.adjoint(dj)).sum()
    assert left == pytest.approx(right, rel=1e-12)


def test_the_assessment_is_exact(morph, move):
    displacement = morph.displacement(move)
    step, quality = morph.assess(displacement)
    assert step.admissible > 1 and quality.inverted == 0 and quality.min_quality > 0
    limit = min(step.admissible, step.boundary)
    assert morph.assess(displacement * limit * 0.999).quality.inverted == 0
    if step.admissible < step.boundary:
        assert morph.assess(displacement * limit * 1.001).quality.inverted > 0
    alone = morph.assess()
    assert isinstance(alone, harmorph.Assessment)
    assert alone.step is None and alone.quality.mean_quality > quality.mean_quality
    moved = morph.start + displacement
    assert morph.assess(points=moved, reference=morph.start).quality.min_quality == pytest.approx(
        quality.min_quality)


def test_the_quality_of_each_cell(morph, move):
    displacement = morph.displacement(move)
    quality = morph.assess(displacement, cells=True).quality
    cells = quality.cell_quality
    assert cells.shape == (ring_mesh().n_cells,) and morph.assess(displacement).quality.cell_quality is None
    assert cells.min() == quality.min_quality and cells.argmin() == quality.min_quality_cell
    assert cells.mean() == pytest.approx(quality.mean_quality, rel=1e-13)
    alone = morph.assess(points=morph.start + displacement, reference=morph.start, cells=True).quality
    assert alone.cell_quality == pytest.approx(cells, rel=1e-10)
    far = morph.assess(1000 * displacement, cells=True).quality
    assert far.inverted == (far.cell_quality == 0).sum() > 0


def test_movements_of_real_functions_only_mix_what_they_should(curves, move):
    laplace = harmorph.Morph(ring_mesh(), curves, operator="laplace")
    assert laplace.info.numbers_per_value == 1
    assert np.array_equal(laplace.displacement(move)[:, 0], np.zeros(laplace.n_points))


OPTIONS = [dict(engine="multigrid"), dict(exponent=2),
           dict(exponent=0), dict(offset_correction=True), dict(tolerance=1e-8), dict(threads=2),
           dict(engine="fas", operator="laplace")]


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_options(curves, move, options):
    morph = harmorph.Morph(ring_mesh(), curves, **options)
    moved = morph.displacement(move)
    assert abs(moved).max() == pytest.approx(0.1, rel=0.5)
    assert morph.solve_report.functions == morph.functions == 12


@pytest.mark.parametrize("options, words", [
    (dict(operator="biharmonic"), "operator must be one of"),
    (dict(engine="cg"), "engine must be one of"),
    (dict(exponent=0.3), "multiple of 0.25"),
    (dict(exponent=9), ""),
    (dict(tolerance=-1), ""),
    (dict(engine="fas"), ""),
    (dict(threads=0), "between 1 and 256"),
    (dict(threads=257), "between 1 and 256"),
    (dict(threads=1.5), "integer"),
    (dict(conditions={"wing": "curve"}), "no marker 'wing'"),
    (dict(conditions={"far": "stiff"}), "condition of marker 'far'"),
    (dict(conditions={"far": 3}), "condition of marker 'far'"),
    (dict(conditions={"far": "free"}), ""),
    (dict(conditions={"wall": harmorph.Condition("curve", curves=(0, 2))}), ""),
])
def test_wrong_options_are_refused(curves, options, words):
    with pytest.raises(harmorph.Error, match=words):
        harmorph.Morph(ring_mesh(), curves, **options)


def test_wrong_objects_are_refused(curves):
    with pytest.raises(harmorph.Error, match="harmorph.Mesh"):
        harmorph.Morph(ring(), curves)
    with pytest.raises(harmorph.Error, match="give `conditions`"):
        harmorph.Morph(ring_mesh(), harmorph.Curves(curves.control, curves=curves.curves))


def test_a_rigid_body(mesh):
    centre = (0.2, 0.1)
    morph = harmorph.Morph(mesh, conditions={"wall": harmorph.Condition("rigid", centre=centre)})
    assert morph.functions == 2
    moved = morph.morph(harmorph.rigid((0.05, -0.02), 12, 1.1))
    wall, _ = mesh.wall("wall")
    turn = 1.1 * np.exp(1j * np.radians(12))
    z, c = morph.start @ [1, 1j], centre[0] + 1j * centre[1]
    assert abs(moved[wall] @ [1, 1j] - (c + turn * (z[wall] - c) + 0.05 - 0.02j)).max() < 1e-14
    with pytest.raises(harmorph.Error, match="no curves"):
        morph.measure("area")


def test_a_rigid_body_that_has_turned_turns_on(mesh):
    """Functions belong to the first place of the body; with `before` the body keeps its size."""
    centre = (0.2, 0.1)
    morph = harmorph.Morph(mesh, conditions={"wall": harmorph.Condition("rigid", centre=centre)})
    wall, c = mesh.wall("wall")[0], centre[0] + 1j * centre[1]
    first = morph.start[wall] @ [1, 1j] - c
    morph.solve(morph.morph(harmorph.rigid(degrees=20)))
    turned = morph.morph(harmorph.rigid(degrees=20, before=(20, 1)))[wall] @ [1, 1j] - c
    assert abs(abs(turned) - abs(first)).max() < 1e-12
    assert abs(turned - first * np.exp(1j * np.radians(40))).max() < 1e-12
    morph.solve(morph.morph(harmorph.rigid(degrees=20, scale=1.1, before=(20, 1))))
    turned = morph.morph(harmorph.rigid((0.02, 0.01), -40, 1 / 1.1, before=(40, 1.1)))[wall] @ [1, 1j] - c
    assert abs(turned - first - 0.02 - 0.01j).max() < 1e-12
    assert np.array_equal(harmorph.rigid((1, 2), 30, 1.5, before=(0, 1)), harmorph.rigid((1, 2), 30, 1.5))
    with pytest.raises(harmorph.Error, match="before must have two entries"):
        harmorph.rigid(before=3)


def test_the_start_is_a_copy(curves, move):
    mesh = ring_mesh()
    morph = harmorph.Morph(mesh, curves)
    expected = morph.morph(move)
    morph.morph(move, mesh.points, out=mesh.points)  # in place
    assert np.array_equal(mesh.points, expected)
    assert np.array_equal(morph.morph(move), expected)
    with pytest.raises(ValueError):
        morph.start[0] = 0


def test_solving_again_on_the_moved_mesh(curves, move):
    morph = harmorph.Morph(ring_mesh(), curves)
    moved = morph.morph(move)
    before = morph.displacement(move)
    bad = moved.copy()
    bad[70] = bad[0] * 0.5
    with pytest.raises(harmorph.Error):
        morph.solve(bad)
    assert np.array_equal(morph.displacement(move), before)
    assert not np.array_equal(morph.start, moved)
    morph.solve(moved)
    fresh = harmorph.Morph(ring_mesh().with_points(moved), curves.moved(move))
    assert np.array_equal(morph.start, moved)
    assert abs(morph.displacement(move) - fresh.displacement(move)).max() < 1e-5
    assert np.abs(morph.displacement(move) - before).max() > 1e-4
    morph.solve((moved[:, 0].copy(), moved[:, 1].copy()))
    morph.solve()


def test_measures_of_the_moved_section(morph, move):
    chord = ((-1.4, 0), (1.4, 0))
    found = morph.measure("area", ("thickness", 0.5), move=move, chord=chord)
    assert found.gradients.shape == (2, 12, 2)
    step = np.zeros_like(move)
    step[3, 1] = 1e-6
    ahead = morph.measure("area", ("thickness", 0.5), move=move + step, chord=chord)
    assert (ahead.values - found.values) / 1e-6 == pytest.approx(found.gradients[:, 3, 1], abs=1e-5)
    with pytest.raises(harmorph.Error, match="shape"):
        morph.measure("area", move=np.zeros(3))
    assert morph.variables("ffd", degrees=(1, 1)).n == 4


def test_the_movement_of_a_mesh_is_found_again(morph, move, random):
    points = morph.morph(-0.3 * move, morph.morph(move))
    points[len(points) // 2] += 0.01  # an inner point
    assert morph.recover(points) == pytest.approx(0.7 * move, abs=1e-12)
    wall = morph.mesh.wall("wall")[0]
    points[wall[3]] += 0.01
    with pytest.raises(harmorph.Error) as refused:
        morph.recover(points, tolerance=1e-3)
    assert refused.value.kind == "point" and refused.value.value > 1e-3


def test_release_and_close(curves, move):
    with harmorph.Morph(ring_mesh(), curves) as morph:
        expected = morph.displacement(move)
        safe = morph.safe(move).points
        morph.release()
        assert np.array_equal(morph.displacement(move), expected)
        assert np.array_equal(morph.safe(move).points, safe)
    for use in (lambda: morph.displacement(move), lambda: morph.morph(move), lambda: morph.safe(move),
                lambda: morph.adjoint(ring().reshape(-1, 2)), lambda: morph.assess(), lambda: morph.solve(),
                lambda: morph.save("nowhere"), lambda: pickle.dumps(morph), lambda: copy.copy(morph),
                lambda: morph.improve(ring().reshape(-1, 2)), lambda: morph.given_points,
                lambda: morph.slip(ring().reshape(-1, 2))):
        with pytest.raises(harmorph.Error, match="was closed") as refused:
            use()
        assert refused.value.code == harmorph.Error.BAD_BASIS
    assert repr(morph) == "Morph(closed)"


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies(curves, move, again):
    morph = harmorph.Morph(ring_mesh(), curves, operator="weighted")
    morph.solve(morph.morph(move))
    other = again(morph)
    assert np.array_equal(other.displacement(move), morph.displacement(move))
    assert np.array_equal(other.safe(move).points, morph.safe(move).points)
    assert np.array_equal(other.start, morph.start) and repr(other) == repr(morph)
    expected = morph.displacement(move)
    other.close()
    assert np.array_equal(morph.displacement(move), expected)


def test_files(curves, move, tmp_path):
    path = tmp_path / "wall.basis"
    morph = harmorph.Morph(ring_mesh(), curves)
    morph.save(path)
    loaded = harmorph.Morph.load(path, ring_mesh())
    assert np.array_equal(loaded.displacement(move), morph.displacement(move))
    assert np.array_equal(loaded.safe(move).points, morph.safe(move).points)
    assert np.array_equal(loaded.curves.control, curves.control) and loaded.solve_report is None
    alone = harmorph.Morph.load(path)
    assert alone.start is None and alone.functions == 12 and alone.n_points == morph.n_points
    assert np.array_equal(alone.morph(move, morph.start), morph.morph(move))
    for use in (lambda: alone.morph(move), lambda: alone.assess(), lambda: alone.safe(move)):
        with pytest.raises(harmorph.Error, match="mesh"):
            use()
    alone.save(tmp_path / "alone.basis")
    with pytest.warns(harmorph.HarmorphWarning) as caught:
        harmorph.Morph.load(path, ring_mesh().with_points(ring_mesh().points * 1.01))
    assert caught[0].message.code == harmorph.HarmorphWarning.MOVED


def test_damaged_files_are_refused(curves, tmp_path):
    path = tmp_path / "wall.basis"
    harmorph.Morph(ring_mesh(), curves).save(path)
    data = path.read_bytes()
    for damaged in (data[:1000], data[:5000] + b"\xff" + data[5001:], b"nothing"):
        path.write_bytes(damaged)
        with pytest.raises(harmorph.Error) as refused:
            harmorph.Morph.load(path)
        assert refused.value.code == harmorph.Error.BAD_BASIS
    path.write_bytes(data)
    with pytest.raises(harmorph.Error) as refused:
        harmorph.Morph.load(path, ring_mesh(ni=33))
    assert refused.value.code == harmorph.Error.BAD_BASIS
    path.write_bytes(b"")
    with pytest.raises(harmorph.Error, match="empty"):
        harmorph.Morph.load(path)
    with pytest.raises(harmorph.Error, match="No such file"):
        harmorph.Morph.load(tmp_path / "none.basis")


def test_bases_of_the_program(meshes, program, tmp_path):
    """The program morphs by a basis of Python to the same mesh, and Python loads a basis of the program."""
    import subprocess

    mesh = harmorph.Mesh.read(meshes / "naca0012.su2")
    morph = harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "airfoil"))
    morph.save(tmp_path / "python.basis")
    (tmp_path / "moves.txt").write_text("6 0 0.02\n")

    def run(command, *arguments):
        subprocess.run([program, command, meshes / "naca0012.su2", *arguments], cwd=tmp_path, check=True,
                       capture_output=True)

    run("morph", "python.basis", "--move", "moves.txt", "-o", "moved.su2")
    move = np.zeros((20, 2))
    move[5, 1] = 0.02
    mesh.write(tmp_path / "python.su2", morph.morph(move))
    assert (tmp_path / "moved.su2").read_bytes() == (tmp_path / "python.su2").read_bytes()
    run("fit", "--marker", "airfoil", "-o", "airfoil.curve")
    run("solve", "--curve", "airfoil=airfoil.curve", "-o", "program.basis")
    loaded = harmorph.Morph.load(tmp_path / "program.basis", mesh)
    assert loaded.displacement(move) == pytest.approx(morph.displacement(move), abs=1e-12)
    assert loaded.safe(4 * move).report.step_fraction == 1


class CountedFrom1(harmorph.Mesh):
    """A mesh as a Fortran code has it."""

    def _view(self):
        super()._view()
        self._c.index_base = 1
        self._from_1 = np.ascontiguousarray(self._faces.reshape(-1) + 1)
        self._c.face_points = ffi.from_buffer("int32_t[]", self._from_1)


def test_a_basis_counted_from_1(curves, move, tmp_path):
    """Numbers of points and cells in reports and errors are counted from 0 for any basis."""
    CountedFrom1.structured(ring(), j_min="wall", j_max="far").report()
    other = harmorph.Morph(CountedFrom1.structured(ring(), j_min="wall", j_max="far"), curves)
    other.save(tmp_path / "fortran.basis")
    loaded = harmorph.Morph.load(tmp_path / "fortran.basis", ring_mesh())
    morph = harmorph.Morph(ring_mesh(), curves)
    displacement = 50 * morph.displacement(move)
    assert loaded.assess(displacement) == morph.assess(displacement)
    assert vars(loaded.safe(move).report) == vars(morph.safe(move).report)


def test_fluxes_of_a_linear_field():
    n = 6
    x, y = np.meshgrid(np.arange(n) / (n - 1), np.arange(n) / (n - 1))
    mesh = harmorph.Mesh.structured(np.stack([x, y], axis=-1), j_min="low", j_max="top", i_min="left", i_max="right")
    curves = harmorph.Curves.fit_points(np.stack([x[0], y[0]], axis=1), False, n_control=2, degree=1,
                                        closed="open")
    k = np.arange(n - 1)
    faces = np.concatenate([np.stack([n * (n - 1) + k, n * (n - 1) + k + 1], 1), np.stack([n * k, n * k + n], 1),
                            np.stack([n * k + n - 1, n * k + 2 * n - 1], 1)])
    # 1 + x + 2 y has the amounts 1 and 2; its normal derivatives, times numbers whose sum with the amounts is 1.
    values = np.repeat([2.0, -1.0, 1.0], n - 1)[:, None] * np.array([1, 2]) / 5
    conditions = {"low": "curve", "top": "free", "left": "free", "right": "free"}
    morph = harmorph.Morph(mesh, curves, conditions, operator="laplace", fluxes=(faces, values))
    expected = (1 + x + 2 * y).ravel()
    for one in (morph, copy.copy(morph), pickle.loads(pickle.dumps(morph))):
        one.solve()
        assert abs(one.displacement([[1, 0], [2, 0]])[:, 0] - expected).max() < 1e-12
    with pytest.raises(harmorph.Error, match="operator"):
        harmorph.Morph(mesh, curves, conditions, fluxes=(faces, values))
    with pytest.raises(harmorph.Error, match="shapes"):
        harmorph.Morph(mesh, curves, conditions, operator="laplace", fluxes=(faces, values[:, :1]))
    with pytest.raises(harmorph.Error, match="not free"):
        harmorph.Morph(mesh, curves, dict(conditions, top="fixed"), operator="laplace", fluxes=(faces, values))


@pytest.mark.parametrize("operator, planes", [("conformal", 2), ("laplace", 1)])
def test_functions_as_a_dense_array(curves, move, operator, planes):
    morph = harmorph.Morph(ring_mesh(), curves, operator=operator)
    f = morph.matrix()
    assert f.shape == (planes, morph.n_points, 12)
    if planes == 1:
        found = f[0] @ move
    else:
        found = np.stack([f[0] @ move[:, 0] - f[1] @ move[:, 1], f[1] @ move[:, 0] + f[0] @ move[:, 1]], axis=1)
    expected = morph.displacement(move)
    assert np.abs(found - expected).max() <= 1e-14 * np.abs(expected).max()
    again = np.empty(f.shape)
    assert morph.matrix(out=again) is again and np.array_equal(again, f)
    with pytest.raises(harmorph.Error):
        morph.matrix(out=np.empty((1, 2, 3)))


@pytest.mark.parametrize("arguments, words", [
    (dict(kind="sticky"), "'sticky' of a condition is unknown; known are"),
    (dict(kind=3), "unknown"),
    (dict(kind="periodic"), "needs a `partner`"),
    (dict(kind="slip", partner="far"), "has no `partner`"),
    (dict(kind="fixed", along=3), "`along` must be Curves"),
    (dict(kind="rigid", centre=3), "centre must have two entries"),
    (dict(kind="slip", near="here"), "near must have two entries"),
])
def test_wrong_conditions_are_refused_when_they_are_made(arguments, words):
    with pytest.raises(harmorph.Error, match=words):
        harmorph.Condition(**arguments)


@pytest.mark.parametrize("shift", [0.003, 0.1, 5.0])
@pytest.mark.parametrize("options", [dict(), dict(operator="laplace"), dict(offset_correction=True)], ids=str)
@pytest.mark.filterwarnings("ignore::harmorph.HarmorphWarning")
def test_loading_on_a_mesh_that_has_moved(curves, move, options, shift, tmp_path):
    """Points keep their places on the curves, so that functions are those of solve(points) in the first object."""
    along = np.zeros_like(move)
    along[:, 0] = shift
    mesh = ring_mesh()
    first = harmorph.Morph(mesh, curves, **options)
    first.save(tmp_path / "first.basis")
    moved = mesh.points + (along[0] if shift > 1 else first.displacement(along))
    ref = copy.copy(first)
    ref.solve(moved)
    ref.save(tmp_path / "second.basis")
    here = mesh.with_points(moved)
    loaded = harmorph.Morph.load(tmp_path / "first.basis", here)
    assert loaded.curves.control == pytest.approx(curves.control + along, abs=1e-11)
    assert loaded.recover(ref.morph(move)) == pytest.approx(along + move, abs=1e-10)
    with pytest.raises(harmorph.Error, match="the mesh has moved since the (basis was solved|first analysis)"):
        loaded.safe(move)
    loaded.solve()
    second = harmorph.Morph.load(tmp_path / "second.basis", here)
    if options.get("offset_correction"):
        with pytest.raises(harmorph.Error, match="the mesh has moved since the first analysis"):
            second.safe(move)
        second.solve()
    part = along * (0.01 / shift)  # no body rotates
    copies = [copy.copy(second), pickle.loads(pickle.dumps(second))]
    for one in (loaded, second, *copies):
        assert abs(one.displacement(move) - ref.displacement(move)).max() < 1e-12
        assert abs(one.safe(part).points - ref.safe(part).points).max() < 1e-9
        assert one.recover(ref.morph(move)) == pytest.approx(move, abs=1e-10)
        assert one.measure("area", move=move).values == pytest.approx(ref.measure("area", move=move).values, rel=1e-9)
        one.release()
        one.solve()
        assert abs(one.displacement(move) - ref.displacement(move)).max() < 1e-12
        assert one.recover(ref.morph(move)) == pytest.approx(move, abs=1e-10)


def test_measures_after_solving_again(curves, move, random):
    """The section is that of the mesh, and movements are found from `start`."""
    chord = ((-1.4, 0), (1.4, 0))
    morph = harmorph.Morph(ring_mesh(), curves)

    def is_moved_by(so_far, one):
        expected = curves.moved(so_far).measure("area", "centroid_y", ("thickness", 0.5), chord=chord)
        found = one.measure("area", "centroid_y", ("thickness", 0.5), chord=chord)
        assert found.values == pytest.approx(expected.values, abs=1e-10)
        assert found.gradients == pytest.approx(expected.gradients, abs=1e-9)
        ahead = one.measure("area", move=move, chord=chord).values
        assert ahead == pytest.approx(curves.moved(so_far + move).measure("area", chord=chord).values, abs=1e-10)
        assert one.recover(one.morph(0.3 * move)) == pytest.approx(0.3 * move, abs=1e-10)
        box = one.variables("ffd", degrees=(1, 1)).matrix
        assert box == pytest.approx(curves.moved(so_far).variables("ffd", degrees=(1, 1)).matrix, abs=1e-9)
        assert np.array_equal(one.curves.control, curves.control)

    so_far = np.zeros_like(move)
    for _ in range(3):
        step = 0.5 * move + 0.005 * random.normal(size=move.shape)
        morph.solve(morph.morph(step))
        so_far += step
        for one in (morph, copy.copy(morph), pickle.loads(pickle.dumps(morph))):
            is_moved_by(so_far, one)
    found = morph.safe(0.2 * move, derivative=True).derivative
    assert found.recover(found.morph(0.1 * move)) == pytest.approx(0.1 * move, abs=1e-10)
    bad = morph.start.copy()
    bad[70] = bad[0] * 0.5
    with pytest.raises(harmorph.Error):
        morph.solve(bad)
    is_moved_by(so_far, morph)
    morph.solve(ring().reshape(-1, 2))
    is_moved_by(0 * move, morph)


def test_a_section_that_no_movement_leads_to(curves, move, tmp_path):
    mesh = ring_mesh()
    morph = harmorph.Morph(mesh, curves)
    other = morph.start.copy()
    other[mesh.wall("wall")[0][5]] *= 0.98
    morph.solve(other)
    morph.save(tmp_path / "other.basis")
    assert morph.recover(morph.morph(0.3 * move)) == pytest.approx(0.3 * move, abs=1e-10)
    for use in (lambda one: one.measure("area"), lambda one: one.variables("ffd", degrees=(1, 1))):
        for one in (morph, copy.copy(morph), pickle.loads(pickle.dumps(morph))):
            with pytest.raises(harmorph.Error, match="`start` are unknown: the wall is on no curve") as refused:
                use(one)
            assert refused.value.code == harmorph.Error.BAD_MESH and refused.value.kind == "point"
    morph.solve(ring().reshape(-1, 2))
    assert morph.measure("area").values == pytest.approx(curves.measure("area").values)
    harmorph.Morph(mesh, curves).save(tmp_path / "first.basis")
    with pytest.warns(harmorph.HarmorphWarning, match="other coordinates"):
        loaded = harmorph.Morph.load(tmp_path / "first.basis", mesh.with_points(other))
    with pytest.raises(harmorph.Error, match="unknown"):
        loaded.measure("area")
    with pytest.warns(harmorph.HarmorphWarning, match="away from its curve"):
        loaded.solve()
    with pytest.raises(harmorph.Error, match="unknown"):
        loaded.measure("area")
