// MUMPS, sequential, for symmetric positive definite matrices: P. R. Amestoy, I. S. Duff, J.
// Koster, J.-Y. L'Excellent, SIAM J. Matrix Anal. Appl. 23 (2001) 15.
#include "clock.hpp"
#include "solver_peer.hpp"

#include <dmumps_c.h>

#include <stdexcept>

// Sets the threads of OpenBLAS, if OpenBLAS is present.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace bench {
namespace {

enum Job { start = -1, finish = -2, analyse = 1, factorise = 2, solve = 3 };

class Mumps : public SolverPeer {
public:
    Mumps(std::string ordering_name, int ordering, int threads)
        : ordering_(std::move(ordering_name)), threads_(threads) {
        its_.par = 1;
        its_.sym = 1;                 // positive definite
        its_.comm_fortran = -987654;  // MUMPS's word for all processes
        its_.job = start;
        dmumps_c(&its_);
        for (int const stream : {1, 2, 3}) control(stream) = -1;
        control(4) = 0;  // says nothing
        control(7) = ordering;
        control(14) = 50;  // [%] more memory than estimated
    }
    ~Mumps() override {
        its_.job = finish;
        dmumps_c(&its_);
    }
    Mumps(Mumps const&) = delete;
    Mumps& operator=(Mumps const&) = delete;

    std::string name() const override { return "MUMPS " + ordering_; }
    std::string ordering() const override { return ordering_; }
    Index largest() const override { return 1 << 30; }
    double bytes() const override { return bytes_; }

    PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                  std::vector<Columns>& x) override {
        std::vector<MUMPS_INT> row, column;  // from 1; the lower triangle
        for (Index i = 0; i < matrix.n; ++i) {
            for (Index k = matrix.start[at(i)]; k < matrix.start[at(i) + 1]; ++k) {
                row.push_back(i + 1);
                column.push_back(matrix.column[at(k)] + 1);
            }
        }
        its_.n = matrix.n;
        its_.nnz = static_cast<MUMPS_INT8>(matrix.value.size());
        its_.irn = row.data();
        its_.jcn = column.data();
        its_.a = const_cast<double*>(matrix.value.data());
        if (openblas_set_num_threads != nullptr) openblas_set_num_threads(threads_);
        PeerTimes times;
        times.analysis = seconds_of(analyse);
        times.factor = seconds_of(factorise);
        bytes_ = 1e6 * its_.infog[21];  // INFOG(22): used by the factorisation [10^6 bytes]
        for (std::size_t set = 0; set < b.size(); ++set) {
            x[set].data = b[set].data;  // solved in place
            its_.rhs = x[set].data.data();
            its_.nrhs = static_cast<MUMPS_INT>(b[set].count());
            its_.lrhs = static_cast<MUMPS_INT>(b[set].rows);
            control(27) = its_.nrhs;  // all at a time
            times.solve.push_back(seconds_of(solve));
        }
        return times;
    }

private:
    std::string ordering_;
    int threads_;
    DMUMPS_STRUC_C its_{};
    double bytes_ = not_measured;

    MUMPS_INT& control(int number) {
        return its_.icntl[number - 1];
    }  // ICNTL, counted from 1 in its manual
    double seconds_of(Job job) {
        Stopwatch watch;
        its_.job = job;
        dmumps_c(&its_);
        if (its_.infog[0] < 0) {
            throw std::runtime_error(name() + ": job " + std::to_string(job) +
                                     " failed with INFOG(1) = " + std::to_string(its_.infog[0]));
        }
        return watch.seconds();
    }
};

}  // namespace

SolverPeers make_mumps(int threads) {
    SolverPeers out;
    out.push_back(std::make_unique<Mumps>("AMD", 0, threads));
    out.push_back(std::make_unique<Mumps>("METIS", 5, threads));
    return out;
}

}  // namespace bench
