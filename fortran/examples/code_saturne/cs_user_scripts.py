# code_saturne reads this file before a run. The file names the mesh, and the library that is linked.
import os


def define_domain_parameters(domain):
    domain.meshes = ["mesh.msh"]
    domain.mesh_dir = os.environ["MESH_DIR"]
    # harmorph.f90 and moving_mesh.f90 are Fortran 2008 and are compiled before, as code_saturne compiles Fortran 2003.
    module = os.environ["HARMORPH_MODULE"]
    domain.compile_fcflags = "-I" + module
    domain.compile_libs = " ".join([module + "/moving_mesh.o", module + "/harmorph.o", os.environ["HARMORPH_LIBRARY"]])
