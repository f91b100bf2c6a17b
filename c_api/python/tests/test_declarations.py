"""The declarations of the extension are those of the headers."""

import re
import sys
from pathlib import Path

import pytest
from harmorph._native import ffi, lib

NATIVE = Path(__file__).resolve().parents[1] / "native"


@pytest.fixture
def headers():
    for folder in (NATIVE.parents[2] / "include", NATIVE.parent / "bundled/include"):
        if (folder / "harmorph.h").is_file():
            return folder
    pytest.skip("the headers are not here")


@pytest.fixture
def declarations(monkeypatch):
    monkeypatch.setattr(sys, "path", [str(NATIVE), *sys.path])
    import declarations

    return declarations


def test_every_call_struct_and_constant(headers, declarations):
    text = "".join((headers / f"{name}.h").read_text() for name in declarations.topics(headers))
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    calls = set(re.findall(r"HM_API [\w ]+?[ *](hm_\w+)\(", text))
    assert len(calls) > 60 and all(hasattr(lib, name) for name in calls)
    structs = set(re.findall(r"typedef struct (hm_\w+) \{", text))
    assert len(structs) > 25 and all(ffi.sizeof(name) for name in structs)
    constants = set(re.findall(r"^\s*(?:enum \{ )?(HM_[A-Z0-9_]+) = ", text, flags=re.M))
    assert len(constants) > 100 and all(hasattr(lib, name) for name in constants)
    assert lib.HM_ABI == lib.hm_abi_version() and lib.HM_NO_MARKER == -(2**31)


def test_every_header(headers, declarations):
    listed = headers.parent / "fortran/harmorph/headers"
    if not listed.is_file():
        pytest.skip("the list of the headers is not here")
    assert sorted(f"{name}.h" for name in declarations.topics(headers)) == sorted(listed.read_text().split())


def test_a_new_member_needs_no_edit(headers, declarations, tmp_path):
    for path in headers.glob("*.h"):
        text = path.read_text()
        if path.name == "harmorph.h":
            text = text.replace("typedef struct hm_curves {", "typedef struct hm_curves {\n    double fresh;")
            text = text.replace("#ifdef __cplusplus\n}", "HM_API int32_t hm_fresh(double x);\n#ifdef __cplusplus\n}")
        (tmp_path / path.name).write_text(text)
    found = declarations.declarations(tmp_path)
    assert "double fresh;" in found and "int32_t hm_fresh(double x);" in found
    assert declarations.version(tmp_path) == ffi.string(lib.hm_version()).decode()
