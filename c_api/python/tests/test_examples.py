"""The example scripts run, and what they print is right."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def run(name, tmp_path, *arguments, needs=()):
    for host in needs:
        if importlib.util.find_spec(host) is None:
            pytest.skip(f"{host} is not installed")
    script = EXAMPLES / name
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    found = subprocess.run([sys.executable, str(script), *map(str, arguments)], cwd=tmp_path, env=environment,
                           capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    return found.stdout


def number(pattern, text):
    return float(re.search(pattern.replace("#", r"(-?[0-9.]+(?:e[-+]?[0-9]+)?)"), text).group(1))


def test_morph(tmp_path):
    text = run("morph.py", tmp_path)
    assert text.startswith("0 inverted cells") and number("follow # times", text) > 2


def test_optimisation(meshes, tmp_path):
    text = run("optimise.py", tmp_path, meshes / "naca0012.su2", needs=["scipy"])
    assert number("finite differences #", text) < 1e-6
    assert "Optimization terminated successfully" in text
    assert number(r"lift [0-9.]+ -> #", text) == pytest.approx(0.4, abs=1e-4)
    shares = re.search(r"allowed: \[(.*)\]", text).group(1).split()
    assert len(shares) == 5 and min(map(float, shares)) > 1 - 1e-4
    assert number("inverted cells #", text) == 0


def test_fluid_and_structure(meshes, tmp_path):
    text = run("fsi.py", tmp_path, meshes / "naca0012.su2")
    assert number("# iterations", text) < 40 and number("; # chords up", text) > 0
    assert number("inverted cells #", text) == 0 and number("work: relative difference #", text) < 1e-11


def test_finite_elements(tmp_path):
    text = run("finite_elements.py", tmp_path, needs=["dolfinx", "petsc4py"])
    assert number("error before #", text) < 1e-11 and number("error after #;", text) < 1e-11
    assert number("area: # less", text) == pytest.approx(number("section of # more", text), rel=5e-3)


def test_batch(tmp_path):
    text = run("batch.py", tmp_path)
    assert text.startswith("1000 designs") and number("is # of the largest", text) < 1e-14


def test_additive(tmp_path):
    text = run("additive.py", tmp_path)
    assert "back: the bits of the first mesh" in text
    assert number("up to #", text) > 0.01 and 0 < number("instead: # away", text) < 1e-11


def test_data_set(meshes, program, tmp_path):
    """The commands of the page, with fewer sections."""
    mesh = meshes / "naca0012.su2"
    commands = (
        ("fit", mesh, "--marker", "airfoil", "-o", "curve"),
        ("solve", mesh, "--curve", "airfoil=curve", "-o", "basis"),
        ("sample", mesh, "basis", "--naca", "--count", 60, "--wall-distance", "--inside",
         "thickness=.08,.2", "-o", "set"),
    )
    for command in commands:
        subprocess.run([program, *map(str, command)], cwd=tmp_path, check=True, capture_output=True)
    text = run("dataset/distance.py", tmp_path, mesh, "set", needs=["torch"])
    counts = re.match(r"(\d+) designs to train, (\d+) to test, (\d+) out", text).groups()
    trained, tested, out = map(int, counts)
    assert trained + tested + out == 60 and min(trained, tested, out) > 0
    assert number(r"\ntest: .* chords, # times less", text) > 5
    assert number(r"out of range: .* chords, # times less", text) > 5


def test_learning(tmp_path):
    text = run("learning.py", tmp_path, needs=["torch"])
    assert "gradcheck passed" in text and number("differ by #", text) < 1e-7


def test_panels_agree_with_the_circle(monkeypatch):
    """Around a circle the speed is 2 |sin| without circulation, and the adjoint is exact."""
    import numpy as np

    monkeypatch.setattr(sys, "path", [str(EXAMPLES), *sys.path])
    from panels import Panels

    angle = -2 * np.pi * np.arange(200) / 200
    circle = 0.5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    flow = Panels(circle, 0.0)
    middle = angle - np.pi / 200
    assert np.abs(flow.speed) == pytest.approx(2 * np.abs(np.sin(middle)), abs=0.01)
    assert flow.lift()[0] == pytest.approx(0, abs=1e-10)
    assert Panels(circle, 5.0).lift()[0] == pytest.approx(4 * np.pi * np.sin(np.radians(5)), rel=0.02)
    direction = np.random.default_rng(3).normal(size=circle.shape)
    value = lambda t: Panels(circle + t * direction, 5.0).unevenness()[0]  # noqa: E731
    gradient = Panels(circle, 5.0)
    exact = (gradient.adjoint(*gradient.unevenness()[1:]) * direction).sum()
    assert (value(1e-7) - value(-1e-7)) / 2e-7 == pytest.approx(exact, rel=1e-5)
