"""OpenMDAO, where it is installed. Otherwise a stand-in with the protocol of ExplicitComponent, as the
manual of OpenMDAO 3 ("ExplicitComponent", "Matrix-free components") describes it: initialize, setup,
compute, compute_jacvec_product(inputs, d_inputs, d_outputs, mode), whose products are added.
"""

import importlib.util
import sys
import types

import numpy as np
import pytest

IS_INSTALLED = importlib.util.find_spec("openmdao") is not None


class Options(dict):
    def declare(self, name, types=None, desc=""):
        self[name] = types


class ExplicitComponent:
    def __init__(self, **options):
        self.options, self.shapes, self.values = Options(), {}, {}
        self.initialize()
        for name, value in options.items():
            assert isinstance(value, self.options[name])
            self.options[name] = value

    def add_input(self, name, val=1.0, shape=None):
        self.values[name] = np.full(shape, val) if shape else np.array(val)

    add_output = add_input


@pytest.fixture
def component(monkeypatch, morph):
    if not IS_INSTALLED:
        api = types.ModuleType("openmdao.api")
        api.ExplicitComponent = ExplicitComponent
        package = types.ModuleType("openmdao")
        package.api = api
        monkeypatch.setitem(sys.modules, "openmdao", package)
        monkeypatch.setitem(sys.modules, "openmdao.api", api)
    from harmorph.openmdao import MorphComp

    yield MorphComp(morph=morph)
    sys.modules.pop("harmorph.openmdao", None)


@pytest.mark.skipif(IS_INSTALLED, reason="the host itself is tested below")
def test_the_protocol(component, morph, move, random):
    component.setup()
    assert component.values["move"].shape == (12, 2)
    assert np.array_equal(component.values["points"], morph.start)
    outputs = {}
    component.compute({"move": move}, outputs)
    assert np.array_equal(outputs["points"], morph.morph(move))
    seed, dual = random.normal(size=(12, 2)), random.normal(size=(morph.n_points, 2))
    forward, backward = {"points": np.ones((morph.n_points, 2))}, {"move": np.ones((12, 2))}
    component.compute_jacvec_product({"move": move}, {"move": seed}, forward, "fwd")
    component.compute_jacvec_product({"move": move}, backward, {"points": dual}, "rev")
    assert forward["points"] - 1 == pytest.approx(morph.displacement(seed), abs=1e-14)
    assert backward["move"] - 1 == pytest.approx(morph.adjoint(dual), rel=1e-12, abs=1e-12)
    component.compute_jacvec_product({"move": move}, {}, forward, "fwd")  # not wanted: nothing happens


@pytest.mark.skipif(not IS_INSTALLED, reason="OpenMDAO is not installed")
def test_the_host(component):
    import openmdao.api as om

    problem = om.Problem()
    problem.model.add_subsystem("morph", component)
    problem.setup()
    problem.run_model()
    found = problem.check_partials(out_stream=None, method="fd")
    for one in found["morph"].values():
        assert one["rel error"].forward < 1e-5 and one["rel error"].reverse < 1e-5
