#include "peers.hpp"

namespace bench {

// Null unless the file is linked: PETSc's MPI library excludes that of the sequential MUMPS.
__attribute__((weak)) SolverPeers make_petsc();

SolverPeers iterative_peers() { return make_petsc != nullptr ? make_petsc() : SolverPeers{}; }

std::vector<SolverPackage> const& solver_packages() {
    static std::vector<SolverPackage> const packages = {
#ifdef HAVE_CHOLMOD
        {"CHOLMOD", "libsuitesparse-dev", make_cholmod},
#else
        {"CHOLMOD", "libsuitesparse-dev", nullptr},
#endif
#ifdef HAVE_MUMPS
        {"MUMPS", "libmumps-seq-dev", make_mumps},
#else
        {"MUMPS", "libmumps-seq-dev", nullptr},
#endif
    };
    return packages;
}

std::string presence(SolverPackage const& package) {
    return package.make != nullptr ? "installed" : "not installed (" + package.package + ")";
}

}  // namespace bench
