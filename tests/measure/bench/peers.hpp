// Lists the peers that this program was built with. run.sh finds them and defines HAVE_CHOLMOD and
// so on.
#pragma once

#include "solver_peer.hpp"

namespace bench {

struct SolverPackage {
    std::string name, package;         // package: Debian's
    SolverPeers (*make)(int threads);  // null: not installed
};

std::vector<SolverPackage> const& solver_packages();

// PETSc's preconditioned iterations; empty: run.sh has not linked PETSc.
SolverPeers iterative_peers();

// "installed" or "not installed (libsuitesparse-dev)".
std::string presence(SolverPackage const& package);

}  // namespace bench
