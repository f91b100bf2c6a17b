// Eigen's SimplicialLLT, with its own AMD ordering: what libigl solves with.
#include "clock.hpp"
#include "solver_peer.hpp"

// Warnings of Eigen are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <eigen3/Eigen/SparseCholesky>

#include <stdexcept>

namespace bench {
namespace {

class EigenLlt : public SolverPeer {
public:
    std::string name() const override { return "Eigen SimplicialLLT"; }
    std::string ordering() const override { return "AMD"; }
    Index largest() const override { return 150000; }
    double bytes() const override { return not_measured; }

    PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                  std::vector<Columns>& x) override {
        using Sparse = Eigen::SparseMatrix<double>;
        Eigen::Map<Sparse const> const a(
            matrix.n, matrix.n, static_cast<Index>(matrix.value.size()), matrix.start.data(),
            matrix.column.data(), matrix.value.data());
        PeerTimes times;
        Stopwatch watch;
        Eigen::SimplicialLLT<Sparse, Eigen::Upper> solver;
        solver.analyzePattern(a);
        times.analysis = watch.lap();
        solver.factorize(a);
        times.factor = watch.lap();
        if (solver.info() != Eigen::Success) throw std::runtime_error("Eigen SimplicialLLT failed");
        for (std::size_t set = 0; set < b.size(); ++set) {
            auto const rows = static_cast<Eigen::Index>(b[set].rows),
                       count = static_cast<Eigen::Index>(b[set].count());
            Eigen::Map<Eigen::MatrixXd const> const right(b[set].data.data(), rows, count);
            watch.lap();
            Eigen::Map<Eigen::MatrixXd>(x[set].data.data(), rows, count) = solver.solve(right);
            times.solve.push_back(watch.seconds());
        }
        return times;
    }
};

}  // namespace

SolverPeers make_eigen(int) {
    SolverPeers out;
    out.push_back(std::make_unique<EigenLlt>());
    return out;
}

}  // namespace bench
#pragma GCC diagnostic pop
