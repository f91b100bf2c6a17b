"""Builds the extension harmorph._native: the library and the readers of mesh files, behind cffi.

The extension uses the stable interface of CPython alone, so that one file serves every CPython from OLDEST on.
In a checkout the sources are those of the checkout; a source distribution has copies in the folder
`bundled`. Environment variables:

HARMORPH_LIBRARY  a libharmorph.a that was compiled with -fPIC (as `make` does): it is linked, and
                  the library is not compiled again
HARMORPH_MESH     the mesh of the demo, build/meshes/naca0012.su2, which the wheel then contains
HARMORPH_BUILD    the folder for what is built from a checkout; build/python of the checkout if not set
CXXFLAGS          flags that follow those below, for instance -O0
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

OLDEST = (3, 9)  # as requires-python of pyproject.toml says
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "native"))
from declarations import declarations, topics, version  # noqa: E402
from manual import manual  # noqa: E402
from reader_sources import reader_sources  # noqa: E402

BUNDLED = HERE / "bundled"
IS_CHECKOUT = not BUNDLED.is_dir()
TOP = HERE.parent.parent
HEADERS = TOP / "include" if IS_CHECKOUT else BUNDLED / "include"
READERS = TOP / "c_api/cli" if IS_CHECKOUT else BUNDLED / "cli"

# Nothing is written into the folder of the package in a checkout.
OPTIONS = {"bdist_wheel": {"py_limited_api": "cp{}{}".format(*OLDEST)}}
if IS_CHECKOUT:
    BUILD = Path(os.environ.get("HARMORPH_BUILD", TOP / "build/python")).resolve()
    BUILD.mkdir(parents=True, exist_ok=True)
    OPTIONS["build"] = {"build_base": str(BUILD)}
    OPTIONS["egg_info"] = {"egg_base": str(BUILD)}

# As `make amalgamation` says, and no contraction, so that the bits are those of the library. The
# readers use exceptions, the library does not.
FLAGS = ["-std=c++17", "-O2", "-fPIC", "-ffp-contract=off", "-fvisibility=hidden", "-w"]
CORE_FLAGS = ["-fno-math-errno", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics"]


def write_amalgamation(path):
    """Write the library as one source."""
    if IS_CHECKOUT:
        with path.open("wb") as out:
            script = TOP / "c_api/packaging/amalgamate.sh"
            subprocess.run(["sh", str(script)], cwd=TOP, stdout=out, check=True)
    else:
        shutil.copyfile(BUNDLED / "harmorph.cpp", path)


class BuildNative(build_ext):
    """Compiles the objects by the C++ compiler itself, as each kind needs flags of its own."""

    def build_extension(self, extension):
        from cffi import FFI

        folder = Path(self.build_temp).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        ffi = FFI()
        ffi.cdef(declarations(HEADERS))
        ffi.cdef(self._declared_readers())
        headers = "".join(f'#include "{name}.h"\n' for name in (*topics(HEADERS), "harmorph_pthreads"))
        ffi.set_source("harmorph._native", headers + '#include "mesh_files.h"\n')
        bridge = folder / "bridge.cpp"
        ffi.emit_c_code(str(bridge))
        includes = [f"-I{HEADERS}", f"-I{HERE / 'native'}"]
        objects = [self._compiled(bridge, [*self._python_flags(), *includes])]

        readers = folder / "readers.cpp"
        sources = [path for path in reader_sources(READERS) if path.suffix == ".cpp"]
        sources.append(HERE / "native/mesh_files.cpp")
        readers.write_text("".join(f'#include "{path}"\n' for path in sources), encoding="utf-8")
        zlib = self._zlib(folder)
        objects.append(self._compiled(readers, [*includes, f"-I{READERS}", "-DHARMORPH_READS_FILES",
                                                *zlib["compile"]]))

        library = os.environ.get("HARMORPH_LIBRARY")
        if library:
            # The whole archive: a program that links objects alone would drop unused calls.
            objects.append(str(Path(library).resolve()))
        else:
            source = folder / "harmorph.cpp"
            write_amalgamation(source)
            objects.append(self._compiled(source, [*CORE_FLAGS, *includes]))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        (target.parent / "_manual.py").write_text(manual(HEADERS), encoding="utf-8")
        mesh = os.environ.get("HARMORPH_MESH")
        if mesh:
            shutil.copyfile(mesh, target.parent / "naca0012.su2")
        shared = self._shared(folder)
        flags = shlex.split(os.environ.get("LDFLAGS", ""))
        self._run([*self._cxx(), *shared, *flags, "-o", str(target), *objects, *zlib["link"], "-pthread"])

    @staticmethod
    def _shared(folder):
        """The extension exports one name: a run-time library of C++ inside must not meet that of another extension."""
        if sys.platform == "darwin":
            return ["-bundle", "-undefined", "dynamic_lookup", "-Wl,-exported_symbol,_PyInit__native"]
        script = folder / "exported.map"
        script.write_text("{ global: PyInit__native; local: *; };\n", encoding="utf-8")
        return ["-shared", f"-Wl,--version-script={script}"]

    @staticmethod
    def _declared_readers():
        text = (HERE / "native/mesh_files.h").read_text(encoding="utf-8")
        text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
        text = re.sub(r"^#ifdef __cplusplus\n.*?^#endif", "", text, flags=re.S | re.M)
        return re.sub(r"^#.*$", "", text, flags=re.M)

    @staticmethod
    def _cxx():
        return shlex.split(os.environ.get("CXX", "c++"))

    @staticmethod
    def _python_flags():
        import sysconfig

        stable = "-DPy_LIMITED_API=0x{:02X}{:02X}0000".format(*OLDEST)
        return [stable, f"-I{sysconfig.get_path('include')}", f"-I{sysconfig.get_path('platinclude')}"]

    @staticmethod
    def _run(command):
        print(" ".join(command))
        subprocess.run(command, check=True)

    def _compiled(self, source, flags):
        target = str(source.with_suffix(".o"))
        own = shlex.split(os.environ.get("CXXFLAGS", ""))
        self._run([*self._cxx(), *FLAGS, *flags, *own, "-c", str(source), "-o", target])
        return target

    def _zlib(self, folder):
        """Compressed files are read and written where zlib is installed, as by the program."""
        trial = folder / "zlib.cpp"
        trial.write_text("#include <zlib.h>\nint main() { return *zlibVersion() == 0; }\n")
        command = [*self._cxx(), str(trial), "-o", str(folder / "zlib"), "-lz"]
        has_zlib = subprocess.run(command, capture_output=True, check=False).returncode == 0
        if has_zlib:
            return {"compile": ["-DHARMORPH_ZLIB"], "link": ["-lz"]}
        return {"compile": [], "link": []}


class SourceDistribution(sdist):
    """Adds what lies outside of this folder: the library, its headers and the readers."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        base = Path(base_dir)
        bundled = base / "bundled"
        (bundled / "include").mkdir(parents=True, exist_ok=True)
        write_amalgamation(bundled / "harmorph.cpp")
        for name in (*topics(HEADERS), "harmorph_pages", "harmorph_pthreads"):
            shutil.copy(HEADERS / f"{name}.h", bundled / "include")
        for path in reader_sources(READERS):
            place = bundled / "cli" / path.relative_to(READERS)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, place)
        for name in ("native", "tests", "examples"):
            shutil.copytree(HERE / name, base / name, dirs_exist_ok=True,
                            ignore=shutil.ignore_patterns("__pycache__"))


setup(
    version=version(HEADERS),
    long_description=(HERE / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    ext_modules=[Extension("harmorph._native", [], py_limited_api=True)],
    options=OPTIONS,
    cmdclass={"build_ext": BuildNative, "sdist": SourceDistribution},
)
