// Other people's solvers, given the same matrix and right-hand sides.
#pragma once

#include "laplacian.hpp"

namespace bench {

struct PeerTimes {
    double analysis = 0;  // ordering and symbolic pass
    double factor = 0;
    std::vector<double> solve;  // of each set of right-hand sides
    double whole(std::size_t set) const { return analysis + factor + solve[set]; }
};

class SolverPeer {
public:
    virtual ~SolverPeer() = default;
    virtual std::string name() const = 0;
    // Peers of one package with the same ordering spend the same on it.
    virtual std::string ordering() const = 0;
    // Larger systems are not asked for: they would take minutes.
    virtual Index largest() const = 0;
    // Solves from the beginning, all sets with one factor. Throws a std::runtime_error if this
    // fails.
    virtual PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                          std::vector<Columns>& x) = 0;
    // At most at once in the last run, factor and its work; right-hand sides not counted. NaN: not
    // known.
    virtual double bytes() const = 0;
    // The most iterations of any right-hand side in the last run; 0: the solver does not iterate.
    virtual Index iterations() const { return 0; }
};

using SolverPeers = std::vector<std::unique_ptr<SolverPeer>>;

// One for each ordering it offers and each way to use the threads. Compiled where its package is
// there.
SolverPeers make_cholmod(int threads);
SolverPeers make_mumps(int threads);
SolverPeers make_petsc();

}  // namespace bench
