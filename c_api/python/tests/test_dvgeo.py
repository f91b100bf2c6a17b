"""pyGeo's protocol, as class BaseDVGeometry in pygeo/parameterization/BaseDVGeo.py (mdolab/pygeo, read
2026-11-24) documents it. pyGeo and pyOptSparse themselves are not installed here.
"""

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh
from harmorph.dvgeo import DVGeo
from harmorph.usmesh import USMesh
from test_curves import section

METHODS = ["addPointSet", "addVariablesPyOpt", "getNDV", "getValues", "getVarNames", "pointSetUpToDate",
           "setDesignVars", "totalSensitivity", "totalSensitivityProd", "update"]


class Problem:
    """Records what pyOptSparse's Optimization.addVarGroup is given."""

    def __init__(self):
        self.groups = {}

    def addVarGroup(self, name, nVars, varType="c", lower=None, upper=None, value=0.0, scale=1.0, **_):
        self.groups[name] = (nVars, varType, lower, upper, np.array(value), scale)


@pytest.fixture
def geometry():
    airfoil = section()
    geometry = DVGeo(airfoil)
    assert geometry.addVariables("shape", airfoil.variables("cst", n_upper=3, n_lower=3), -0.1, 0.1, 10.0) == 6
    assert geometry.addVariables("box", airfoil.variables("ffd", degrees=(1, 1))) == 8
    return geometry


def outline(airfoil, n=30):
    u = np.linspace(*airfoil.range(), n)
    return np.column_stack([airfoil.points(u), np.linspace(0, 1, n)])


def test_the_protocol(geometry, random):
    assert all(callable(getattr(geometry, name)) for name in METHODS)
    points = outline(geometry.curves)
    geometry.addPointSet(points, "surface")
    assert geometry.getNDV() == 14 and geometry.getVarNames() == ["shape", "box"]
    assert not geometry.pointSetUpToDate("surface") and geometry.pointSetUpToDate("other")
    assert np.array_equal(geometry.update("surface"), points) and geometry.pointSetUpToDate("surface")
    values = {"shape": 0.02 * random.normal(size=6), "box": 0.02 * random.normal(size=8), "alpha": [3.0]}
    geometry.setDesignVars(values)
    assert not geometry.pointSetUpToDate("surface")
    assert np.array_equal(geometry.getValues()["shape"], values["shape"]) and "alpha" not in geometry.getValues()
    moved = geometry.update("surface")
    assert np.array_equal(moved[:, 2], points[:, 2])
    expected = geometry.curves.moved(geometry.move()).points(np.linspace(*geometry.curves.range(), 30))
    assert abs(moved[:, :2] - expected).max() < 1e-7
    problem = Problem()
    geometry.addVariablesPyOpt(problem)
    assert problem.groups["shape"][:4] == (6, "c", -0.1, 0.1) and problem.groups["shape"][5] == 10.0
    assert np.array_equal(problem.groups["box"][4], values["box"])


@pytest.mark.parametrize("functions", [None, 1, 4])
def test_derivatives(geometry, random, functions):
    points = outline(geometry.curves)
    geometry.addPointSet(points, "surface")
    seed = {name: random.normal(size=len(value)) for name, value in geometry.getValues().items()}
    forward = geometry.totalSensitivityProd(seed, "surface")
    assert forward.shape == points.shape
    dual = random.normal(size=points.shape if functions is None else (functions, *points.shape))
    backward = geometry.totalSensitivity(dual, "surface")
    for k, one in enumerate(dual if functions else [dual]):
        right = sum(backward[name][k] @ seed[name] for name in seed)
        assert (forward * one).sum() == pytest.approx(right, rel=1e-11)
    before = geometry.update("surface")
    geometry.setDesignVars({name: 1e-3 * value for name, value in seed.items()})
    assert (geometry.update("surface") - before) / 1e-3 == pytest.approx(forward, abs=1e-10)

    class Two:
        @staticmethod
        def allgather(value):
            return [value, value]

    both = geometry.totalSensitivity(dual, "surface", comm=Two())
    assert all(np.array_equal(both[name], 2 * backward[name]) for name in both)


def test_a_gradient_through_the_mesh(curves, random):
    """Design variables, surface points and mesh points: the chain of an adjoint optimisation."""
    mesh = ring_mesh()
    warper = USMesh(mesh, ["wall"])
    geometry = DVGeo(curves)
    geometry.addVariables("box", curves.variables("ffd", degrees=(2, 2), chord=((-1.4, 0), (1.4, 0))))
    start = warper.getSurfaceCoordinates()
    geometry.addPointSet(start, "surface")
    dual = random.normal(size=3 * mesh.n_points)

    def objective(values):
        geometry.setDesignVars({"box": values})
        warper.setSurfaceCoordinates(start + geometry.update("surface") - geometry._points["surface"])
        warper.warpMesh()
        return warper.getSolverGrid() @ dual

    warper.warpDeriv(dual)
    gradient = geometry.totalSensitivity(warper.getdXs(), "surface")["box"][0]
    for k in (0, 5, 11):
        step = np.zeros(18)
        step[k] = 1e-4
        assert (objective(step) - objective(-step)) / 2e-4 == pytest.approx(gradient[k], rel=1e-7, abs=1e-9)


def test_other_axes(random):
    airfoil = section()
    geometry = DVGeo(airfoil, axes=(0, 2))
    geometry.addVariables("t", airfoil.variables("naca4"))
    geometry.addPointSet(outline(airfoil)[:, [0, 2, 1]], "surface")
    geometry.setDesignVars({"t": [0.01]})
    moved = geometry.update("surface") - outline(airfoil)[:, [0, 2, 1]]
    assert np.abs(moved[:, 2]).max() > 1e-3 and (moved[:, 1] == 0).all()


def test_refusals(geometry):
    airfoil = geometry.curves
    with pytest.raises(harmorph.Error, match="already"):
        geometry.addVariables("shape", airfoil.variables("naca4"))
    with pytest.raises(harmorph.Error, match="control points"):
        geometry.addVariables("x", harmorph.Curves([[0, 0], [1, 1], [2, 0], [0, 0.5]]).variables(
            "ffd", degrees=(0, 0)))
    with pytest.raises(harmorph.Error, match="away from the curves") as refused:
        geometry.addPointSet([[0, 0, 0], [5, 5, 0]], "far")
    assert refused.value.item == 1
    with pytest.raises(harmorph.Error, match="no point set"):
        geometry.update("far")
    with pytest.raises(harmorph.Error, match="6 values"):
        geometry.setDesignVars({"shape": np.zeros(5)})
    for value in (np.nan, np.inf):
        with pytest.raises(ValueError, match="Value 2 of the group 'box'"):
            geometry.setDesignVars({"shape": np.ones(6), "box": [0, 0, value, 0, 0, 0, 0, 0]})
    assert not any(values.any() for values in geometry.getValues().values())
    geometry.addPointSet(outline(airfoil), "surface")
    with pytest.raises(harmorph.Error, match="shape"):
        geometry.totalSensitivity(np.zeros((2, 3)), "surface")
