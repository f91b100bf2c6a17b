"""PyTorch: values, gradients of first and second order, batches, types."""

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh

torch = pytest.importorskip("torch")


@pytest.fixture(scope="module")
def small(curves):
    mesh = ring_mesh(ni=9, nj=4)
    return harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=6, closed="periodic"))


@pytest.fixture(scope="module")
def host():
    import harmorph.torch as host

    return host


def test_values(host, morph, move):
    tensor = torch.as_tensor(move)
    assert np.array_equal(host.displacement(morph, tensor).numpy(), morph.displacement(move))
    assert host.morph_points(morph, tensor).numpy() == pytest.approx(morph.morph(move), abs=1e-15)
    start = torch.as_tensor(np.array(morph.start), dtype=torch.float64).requires_grad_()
    host.morph_points(morph, tensor, start).sum().backward()
    assert (start.grad == 1).all()


def test_batches_and_types(host, morph, move):
    batch = torch.as_tensor(np.stack([[move, 2 * move], [0 * move, -move]]))
    moved = host.displacement(morph, batch)
    assert moved.shape == (2, 2, morph.n_points, 2)
    assert np.array_equal(moved[0, 1].numpy(), morph.displacement(2 * move))
    single = host.displacement(morph, torch.as_tensor(move, dtype=torch.float32))
    assert single.dtype == torch.float32
    assert single.numpy() == pytest.approx(morph.displacement(move.astype(np.float32)), abs=1e-7)
    transposed = torch.as_tensor(np.ascontiguousarray(move.T)).T
    assert np.array_equal(host.displacement(morph, transposed).numpy(), morph.displacement(move))


def test_gradients(host, small, random):
    move = torch.as_tensor(random.normal(size=(2, 6, 2))).requires_grad_()
    assert torch.autograd.gradcheck(lambda step: host.displacement(small, step), move)
    assert torch.autograd.gradgradcheck(lambda step: host.displacement(small, step) ** 2, move)


def test_refusals(host, morph):
    with pytest.raises(harmorph.Error, match="shape"):
        host.displacement(morph, torch.zeros(3, 2, dtype=torch.float64))
