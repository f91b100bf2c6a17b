# Never run: there is no Spack on the machine where harmorph is tested. The tarball of `make dist` lies in the folder
# from which spack is called; the checksum is that of `sha256sum harmorph-VERSION.tar.gz`.
import os

from spack.package import *


class Harmorph(MakefilePackage):
    """Morphs an airfoil and its CFD mesh together, by functions of the B-spline's control points."""

    url = f"file://{os.getcwd()}/harmorph-1.0.0.tar.gz"
    license("MIT")

    version("1.0.0")

    variant("program", default=True, description="Builds the program harmorph, too")

    depends_on("cxx", type="build")

    def edit(self, spec, prefix):
        pass

    def build(self, spec, prefix):
        make("CXX=" + spack_cxx, "all" if spec.satisfies("+program") else "library-only")

    def install(self, spec, prefix):
        target = "install" if spec.satisfies("+program") else "install-library"
        make("CXX=" + spack_cxx, "PREFIX=" + prefix, target)
