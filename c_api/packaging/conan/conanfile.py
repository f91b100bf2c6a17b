# Never run: there is no Conan on the machine where harmorph is tested. Call `conan create .` in this folder of an
# unpacked tarball of `make dist`.
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Harmorph(ConanFile):
    name = "harmorph"
    version = "1.0.0"
    license = "MIT"
    description = "Morphs an airfoil and its CFD mesh together"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"

    def export_sources(self):
        top = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "include/*", "src/*", "c_api/*", "fortran/*", "tests/meshes/*"):
            copy(self, pattern, top, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BUILD_TESTING"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["harmorph"]
        self.cpp_info.set_property("cmake_target_name", "harmorph::harmorph")
        self.cpp_info.set_property("pkg_config_name", "harmorph")
