"""numpy arrays of any layout: views where the library can represent them, one copy or a refusal."""

import harmorph
import numpy as np
import pytest

N = 65 * 17


def layouts(xy):
    """Arrays with the same numbers that the library reads and writes in place."""
    three = np.zeros((N, 3))
    three[:, :2] = xy
    record = np.zeros(N, [("a", "f8"), ("x", "f8"), ("b", "f8"), ("y", "f8")])
    record["x"], record["y"] = xy.T
    wide = np.zeros((2, 2 * N))
    wide[:, ::2] = xy.T
    return {
        "rows": xy.copy(),
        "columns": np.asfortranarray(xy),
        "two of three columns": three[:, :2],
        "x and y exchanged": np.ascontiguousarray(xy[:, ::-1])[:, ::-1],
        "every other column": wide[:, ::2].T,
        "a pair": tuple(np.ascontiguousarray(one) for one in xy.T),
        "fields of a record": (record["x"], record["y"]),
    }


def joined(points):
    return np.stack(points, axis=1) if isinstance(points, tuple) else np.asarray(points)


LAYOUTS = list(layouts(np.zeros((N, 2))))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_inputs_and_outputs_in_place(morph, move, layout):
    expected = morph.morph(move)
    points = layouts(morph.start)[layout]
    assert morph.morph(move, points, out=points) is points
    assert np.array_equal(joined(points), expected)
    to = layouts(np.full((N, 2), 7.0))[layout]
    morph.displacement(move, out=to)
    assert np.array_equal(joined(to), morph.displacement(move))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_adjoint_reads_every_layout(morph, random, layout):
    dj = random.normal(size=(N, 2))
    assert np.array_equal(morph.adjoint(layouts(dj)[layout]), morph.adjoint(dj))


@pytest.mark.parametrize("points", [
    pytest.param(lambda xy: xy.astype(np.float32).astype(float).astype(np.float32), id="float32"),
    pytest.param(lambda xy: xy[::-1].copy()[::-1], id="descending"),
    pytest.param(lambda xy: xy.astype(">f8"), id="other byte order"),
    pytest.param(lambda xy: xy.tolist(), id="lists"),
    pytest.param(lambda xy: (xy[:, 0].copy(), xy[:, 1]), id="unequal strides"),
    pytest.param(lambda xy: np.lib.stride_tricks.as_strided(
        np.frombuffer(b"\0" + xy.tobytes() + b"\0" * 7, "u1")[1:][: xy.nbytes].view("f8").reshape(-1, 2)),
        id="not aligned"),
])
def test_other_inputs_are_copied(morph, random, points):
    dj = random.normal(size=(N, 2)).astype(np.float32).astype(float)
    given = points(dj)
    before = np.array(joined(given) if isinstance(given, tuple) else given)
    assert np.array_equal(morph.adjoint(given), morph.adjoint(dj))
    assert np.array_equal(np.array(joined(given) if isinstance(given, tuple) else given), before)


@pytest.mark.parametrize("wrong, words", [
    (np.zeros((N, 3)), "shape"),
    (np.zeros((2, N)), "shape"),
    (np.zeros(2 * N), "shape"),
    (np.zeros((N - 1, 2)), "shape"),
    (np.zeros((N, 2), complex), "real numbers"),
    (np.full((N, 2), "a"), "real numbers"),
    (np.full((N, 2), None), "real numbers"),
    (None, "real numbers"),
    ("points", "real numbers"),
    ([[1, 2], [3]], "different"),
    ((np.zeros(N), np.zeros(N - 1)), "different shapes"),
])
def test_wrong_inputs_are_refused(morph, wrong, words):
    with pytest.raises(harmorph.Error, match=words) as refused:
        morph.adjoint(wrong)
    assert refused.value.code == harmorph.Error.BAD_ARGUMENT


def read_only():
    array = np.zeros((N, 2))
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("wrong, words", [
    (read_only(), "read-only"),
    (np.zeros((N, 2), np.float32), "in place"),
    (np.zeros((N, 2))[::-1], "in place"),
    (np.zeros((N, 2), ">f8"), "in place"),
    (np.broadcast_to(np.zeros((1, 2)), (N, 2)), "read-only|in place"),
    (np.lib.stride_tricks.as_strided(np.zeros(N + 1), (N, 2), (8, 8)), "meeting each other"),
    (np.lib.stride_tricks.as_strided(np.zeros(N), (N, 2), (8, 0)), "meeting each other"),
    ((np.zeros(N), np.zeros(2 * N)[::2]), "in place"),
    ([[0.0, 0.0]] * N, "numpy array"),
    (np.zeros((N, 3)), "shape"),
])
def test_outputs_that_cannot_be_represented_are_refused(morph, move, wrong, words):
    before = np.array(joined(wrong))
    with pytest.raises(harmorph.Error, match=words):
        morph.displacement(move, out=wrong)
    assert np.array_equal(joined(wrong), before)


def test_overlapping_input_and_output(morph, move):
    memory = np.zeros((N + 1, 2))
    memory[:N] = morph.start
    morph.morph(move, memory[:N], out=memory[1:])
    assert np.array_equal(memory[1:], morph.morph(move))
    memory = np.zeros(3 * N)
    three, two = memory.reshape(N, 3)[:, :2], memory[: 2 * N].reshape(N, 2)  # at the same address
    three[:] = morph.start
    assert np.array_equal(morph.morph(move, three, out=two), morph.morph(move))
    columns = np.zeros((2, N))
    columns[:] = morph.start.T
    morph.morph(move, columns.T, out=(columns[1], columns[0]))
    assert np.array_equal(columns[::-1].T, morph.morph(move))


@pytest.mark.parametrize("wrong, words", [
    (np.zeros((11, 2)), r"\(12, 2\)"),
    (np.zeros(24), r"\(12, 2\)"),
    (np.zeros((12, 2), complex), "real numbers"),
    ("up", "real numbers"),
])
def test_movements_of_other_shapes_are_refused(morph, wrong, words):
    with pytest.raises(harmorph.Error, match=words):
        morph.displacement(wrong)


def test_movements_of_other_layouts_are_copied(morph, move):
    expected = morph.displacement(move)
    for same in (np.asfortranarray(move), move.tolist(), move.astype(np.longdouble), move[::-1][::-1]):
        assert np.array_equal(morph.displacement(same), expected)


def test_a_gradient_is_written_in_place(morph, random):
    dj, out = random.normal(size=(N, 2)), np.empty((12, 2))
    assert morph.adjoint(dj, out) is out and np.array_equal(out, morph.adjoint(dj))
    for wrong in (np.empty((12, 2), order="F"), np.empty(24), np.empty((12, 2), np.float32), [0.0]):
        with pytest.raises(harmorph.Error, match="out must be"):
            morph.adjoint(dj, wrong)


def test_numbers_that_are_not_finite(morph, move):
    wrong = move.copy()
    wrong[3, 0] = np.nan
    out = np.full((N, 2), 5.0)
    for use in (lambda: morph.displacement(wrong, out), lambda: morph.morph(wrong, out, out)):
        with pytest.raises(harmorph.Error, match="not finite") as refused:
            use()
        assert (refused.value.kind, refused.value.item) == ("function", 3) and (out == 5).all()
    dj = np.zeros((N, 2))
    dj[3, 0] = np.inf
    assert np.isnan(morph.adjoint(dj)).all()
    points = morph.start.copy()
    points[100] = np.nan
    with pytest.raises(harmorph.Error):
        morph.solve(points)


def test_views_keep_their_arrays_alive(curves):
    import gc
    import weakref

    class Traced(np.ndarray):
        pass

    from conftest import ring

    points = ring().reshape(-1, 2).view(Traced)
    trace = weakref.ref(points)
    mesh = harmorph.Mesh.structured(points.reshape(17, 65, 2), j_min="wall", j_max="far")
    assert np.shares_memory(mesh.points, points)
    del points
    gc.collect()
    assert trace() is not None
    mesh.report()
    del mesh
    gc.collect()
    assert trace() is None
