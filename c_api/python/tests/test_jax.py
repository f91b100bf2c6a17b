"""JAX, where it is installed. Otherwise a stand-in with the three names that the adapter uses, as the
manual of JAX ("Custom derivative rules", "External callbacks") describes them: custom_vjp with defvjp,
pure_callback(function, shape_and_type, *arguments) and ShapeDtypeStruct.
"""

import importlib.util
import sys
import types

import harmorph
import numpy as np
import pytest

IS_INSTALLED = importlib.util.find_spec("jax") is not None


class ShapeDtypeStruct:
    def __init__(self, shape, dtype):
        self.shape, self.dtype = tuple(shape), np.dtype(dtype)


def pure_callback(function, kind, *arguments):
    result = function(*arguments)
    assert result.shape == kind.shape and result.dtype == kind.dtype
    return result


class custom_vjp:
    def __init__(self, function):
        self.function = function

    def __call__(self, *arguments):
        return self.function(*arguments)

    def defvjp(self, first, second):
        self.first, self.second = first, second

    def vjp(self, *arguments):
        value, residuals = self.first(*arguments)
        return value, lambda seed: self.second(residuals, seed)


@pytest.fixture
def host(monkeypatch):
    if not IS_INSTALLED:
        stand_in = types.ModuleType("jax")
        stand_in.ShapeDtypeStruct, stand_in.pure_callback = ShapeDtypeStruct, pure_callback
        stand_in.custom_vjp = custom_vjp
        monkeypatch.setitem(sys.modules, "jax", stand_in)
    import harmorph.jax as host

    yield host
    sys.modules.pop("harmorph.jax", None)


@pytest.mark.skipif(IS_INSTALLED, reason="the host itself is tested below")
@pytest.mark.parametrize("batch", [(), (3,), (2, 2)])
def test_the_protocol(host, morph, random, batch):
    function = host.displacement(morph)
    move = random.normal(size=(*batch, 12, 2))
    dual = random.normal(size=(*batch, morph.n_points, 2))
    value, pull = function.vjp(move)
    (gradient,) = pull(dual)
    assert value.shape == dual.shape and gradient.shape == move.shape
    assert (value * dual).sum() == pytest.approx((gradient * move).sum(), rel=1e-12)
    assert function(move.astype(np.float32)).dtype == np.float32
    with pytest.raises(harmorph.Error, match="shape"):
        function(np.zeros((3, 2)))


@pytest.mark.skipif(not IS_INSTALLED, reason="JAX is not installed")
def test_the_host(host, morph, move):
    import jax

    jax.config.update("jax_enable_x64", True)
    function = host.displacement(morph)
    gradient = jax.jit(jax.grad(lambda step: (function(step) ** 2).sum()))(move)
    assert np.asarray(gradient) == pytest.approx(2 * morph.adjoint(morph.displacement(move)), rel=1e-9)
