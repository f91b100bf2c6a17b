"""Threads of the library and threads of Python."""

import os
import threading

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh


def test_the_same_bits_for_any_number_of_threads(curves, move, morph):
    for threads in (2, 3):
        other = harmorph.Morph(ring_mesh(), curves, threads=threads)
        assert np.array_equal(other.displacement(move), morph.displacement(move))
        assert np.array_equal(other.morph(move), morph.morph(move))
        dj = morph.displacement(move)
        assert np.array_equal(other.adjoint(dj), morph.adjoint(dj))
        assert vars(other.assess(dj).step) == vars(morph.assess(dj).step)
        assert np.array_equal(other.safe(move * 3).points, morph.safe(move * 3).points)


@pytest.mark.parametrize("threads", [1, 2])
def test_python_threads_share_an_object(curves, move, threads):
    shared = harmorph.Morph(ring_mesh(), curves, {"far": "given"}, threads=threads)
    expected = [shared.morph(k * move) for k in range(8)]
    safe = shared.safe(move).points
    wrong = []

    def work(k):
        for _ in range(20):
            if not np.array_equal(shared.morph(k * move), expected[k]):
                wrong.append(k)
        if not np.array_equal(shared.safe(move).points, safe):
            wrong.append(-k)

    running = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for one in running:
        one.start()
    for one in running:
        one.join()
    assert wrong == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes")
def test_the_interpreter_lock_is_released(mesh, tmp_path):
    """The library waits for a pipe that another thread of Python fills: with the lock it waits for ever."""
    mesh.write(tmp_path / "mesh.su2")
    pipe = tmp_path / "pipe.su2"
    os.mkfifo(pipe)
    writer = threading.Thread(target=lambda: pipe.write_bytes((tmp_path / "mesh.su2").read_bytes()))
    writer.start()
    assert np.array_equal(harmorph.Mesh.read(pipe).points, mesh.points)
    writer.join()


def test_closing_while_another_thread_morphs(curves, move):
    for _ in range(20):
        shared = harmorph.Morph(ring_mesh(ni=17, nj=5), curves, {"wall": "curve"})
        expected, wrong = shared.morph(move), []

        def work():
            try:
                while True:
                    if not np.array_equal(shared.morph(move), expected):
                        wrong.append(1)
            except harmorph.Error:
                pass

        other = threading.Thread(target=work)
        other.start()
        shared.close()
        other.join()
        assert wrong == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_forked_process_goes_on(curves, move):
    morph = harmorph.Morph(ring_mesh(), curves, threads=2)
    expected = morph.safe(move).points
    child = os.fork()
    if child == 0:
        same = np.array_equal(morph.safe(move).points, expected)
        del morph
        os._exit(0 if same else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
