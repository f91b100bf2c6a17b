"""Every public name has a docstring, type hints, and a test that uses it."""

import importlib
import inspect
import re
import subprocess
import sys
import typing
from pathlib import Path

import harmorph
import pytest
from harmorph._native import ffi

MODULES = ["arrays", "measures", "usmesh", "dvgeo", "openmdao", "torch", "jax"]
HERE = Path(__file__)
TESTS = "".join(path.read_text() for path in HERE.parent.glob("test_*.py") if path.name != HERE.name)
CLASSES = [one for one in vars(harmorph).values()
           if inspect.isclass(one) and one.__module__.startswith("harmorph")]


def is_member(name, value):
    is_call = inspect.isfunction(value) or inspect.ismethod(value) or isinstance(value, property)
    return not name.startswith("_") and is_call and "harmorph" in getattr(value, "__module__", "harmorph")


def members(one):
    return {name: value for name, value in inspect.getmembers(one) if is_member(name, value)}


def test_all_is_complete():
    public = {name for name, value in vars(harmorph).items()
              if not name.startswith("_") and not inspect.ismodule(value)}
    assert public | {"__version__"} == set(harmorph.__all__)
    assert harmorph.__version__.count(".") == 2


@pytest.mark.parametrize("one", CLASSES, ids=lambda one: one.__name__)
def test_docstrings_hints_and_tests(one):
    assert one.__name__ in TESTS or one.__name__ in ("Report",), one.__name__
    assert inspect.getdoc(one)
    for name, member in members(one).items():
        function = member.fget if isinstance(member, property) else member
        if one.__name__ not in ("Safe", "Assessment", "Measures", "Curve"):
            assert inspect.getdoc(member), f"{one.__name__}.{name} has no docstring"
            assert name in TESTS, f"no test uses {one.__name__}.{name}"
            hints = typing.get_type_hints(function)
            assert "return" in hints, f"{one.__name__}.{name} has no hint of what it returns"
            for parameter in inspect.signature(function).parameters:
                assert parameter in ("self", "cls") or parameter in hints, f"{one.__name__}.{name}: {parameter}"


@pytest.mark.parametrize("one", CLASSES, ids=lambda one: one.__name__)
def test_arguments_are_documented(one):
    """Each argument of a constructor stands in the docstring of its class."""
    if issubclass(one, (tuple, harmorph.Report, Exception)):
        return
    text = inspect.getdoc(one)
    for name in list(inspect.signature(one).parameters):
        if not name.startswith("_") and name not in ("view", "n_control"):
            assert name in text, f"{one.__name__}: {name}"


@pytest.mark.parametrize("one", [*CLASSES, harmorph.measures.measure, harmorph.rigid, harmorph.swept_areas],
                         ids=lambda one: one.__name__)
def test_docstrings_need_no_header(one):
    """They name no call, struct or file of C, and leave no line to fill in."""
    things = [one, *(members(one).values() if inspect.isclass(one) else ())]
    for thing in things:
        text = inspect.getdoc(thing) or ""
        assert not re.search(r"\bhm_\w+|harmorph_?\w*\.h\b|\{members of|\bHM_", text), f"{thing}: {text}"


@pytest.mark.parametrize("struct, thing", [
    ("hm_step_report", harmorph.Assessment), ("hm_quality_report", harmorph.Assessment),
    ("hm_safe_report", harmorph.Safe), ("hm_fit_report", harmorph.Curves), ("hm_mesh_report", harmorph.Mesh.report),
    ("hm_solve_report", harmorph.Morph), ("hm_basis_info", harmorph.Morph), ("hm_plane_info", harmorph.Plane),
    ("hm_improve_report", harmorph.Morph.improve), ("hm_refit_report", harmorph.Curves.refit),
])
def test_docstrings_name_the_members_of_reports(struct, thing):
    text = inspect.getdoc(thing)
    names = [name for name, field in ffi.typeof(struct).fields if field.type.kind == "primitive"
             and name not in ("struct_size", "bytes", "index_base") and not name.startswith("reserved")]
    assert len(names) > 5 or struct == "hm_step_report"
    for name in names:
        assert f"`{name}`" in text, name


def test_docstrings_explain_the_kinds():
    from harmorph.measures import _KINDS as quantities
    from harmorph.shapes import _MOVEMENTS as movements
    from harmorph.variables import _KINDS as variables

    for kinds, thing in ((quantities, harmorph.measures.measure), (movements, harmorph.Movement),
                         (variables, harmorph.Variables), (harmorph.quality._KINDS, harmorph.Quality.bounds)):
        for kind in kinds:
            assert f'"{kind}"' in inspect.getdoc(thing), kind


def test_representations(curves, morph):
    mesh = morph.mesh
    assert "12 control points" in repr(curves) and "'wall'" in repr(curves)
    for one, words in ((mesh, "1105 points"), (morph, "12 functions, conformal, curve 'wall'"),
                       (harmorph.Quality(morph), "1105 points"),
                       (harmorph.Walls(mesh, ["wall"]), "64 faces"),
                       (harmorph.Interpolation(mesh, mesh.points[:7]), "1105 points to 7"),
                       (curves.variables("ffd", degrees=(2, 1)), "'ffd', n=6")):
        assert repr(one).startswith(type(one).__name__ + "(") and words in repr(one)


@pytest.mark.parametrize("one", CLASSES, ids=lambda one: one.__name__)
def test_every_class_has_a_representation(one):
    assert any("__repr__" in vars(base) for base in one.__mro__ if base is not object)


@pytest.mark.parametrize("name", MODULES)
def test_modules_are_documented(name):
    assert (Path(harmorph.__file__).parent / f"{name}.py").read_text().startswith('"""')
    if name in ("arrays", "measures"):
        assert importlib.import_module(f"harmorph.{name}").__doc__


def test_adapters_are_imported_when_they_are_used():
    lines = ("import sys, harmorph; assert not {'harmorph.usmesh', 'harmorph.dvgeo'} & set(sys.modules); "
             "harmorph.usmesh.USMesh, harmorph.dvgeo.DVGeo; assert not hasattr(harmorph, 'idwarp')")
    subprocess.run([sys.executable, "-c", lines], check=True)


def test_the_help_of_the_package_begins_with_the_program_of_the_readme():
    program = (HERE.parent.parent / "examples/morph.py").read_text().split('"""', 2)[2]
    assert program.strip() in inspect.getdoc(harmorph).replace("\n    ", "\n")


def test_reports_are_words_and_lines(curves, morph):
    assert curves.fit_report.closed == "periodic" and curves.curves[0].closed == "periodic"
    assert (morph.info.operator_kind, morph.info.engine) == ("conformal", "direct")
    assert (morph.info.scheme, morph.info.storage) == ("compact", "double")
    assert not hasattr(morph.info, "index_base") and not hasattr(morph.info, "bytes")
    lines = repr(curves.fit_report).splitlines()
    assert lines[0] == "Report(" and "    closed='periodic'," in lines and lines[-1] == ")"
    number = next(line for line in lines if "max_error=" in line).split("=")[1]
    assert len(number.strip(",").split("e")[0].replace(".", "").lstrip("0")) <= 6


@pytest.mark.parametrize("closed", ["open", "tied", "periodic"])
def test_the_closure_of_curves_is_a_word(closed):
    control = [(0, 0), (1, 1), (2, 1), (3, 0), (2, -1), (1, -1)]
    curves = harmorph.Curves(control, degree=2, closed=closed)
    assert curves.curves[0].closed == closed and f"{closed} of degree 2" in repr(curves)


def test_each_constant_has_its_own_meaning():
    """The comment behind the last constant of a list is not that of the constant before."""
    text = inspect.getdoc(harmorph.Curves)
    assert '"tied": clamped, both ends are one control point: a sharp trailing edge\n' in text
    assert '"periodic": smooth everywhere' in text


def test_the_package_is_typed():
    assert (Path(harmorph.__file__).parent / "py.typed").is_file()
