// CHOLMOD, supernodal: Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam, ACM Trans. Math. Softw.
// 35 (2008) 22.
#include "clock.hpp"
#include "solver_peer.hpp"

#include <suitesparse/cholmod.h>

#include <cstring>
#include <stdexcept>

// Set the threads of OpenBLAS and of the OpenMP that CHOLMOD is linked with, if these are present.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int);
__attribute__((weak)) void omp_set_max_active_levels(int);
}

namespace bench {
namespace {

// CHOLMOD has threads of its own, by OpenMP, and those of its BLAS; both at once may get into each
// other's way.
struct Threads {
    int blas = 1,
        openmp = 1;  // OpenMP's number is limited from outside: here only one or all of them

    void set() const {
        if (openblas_set_num_threads != nullptr) openblas_set_num_threads(blas);
        if (omp_set_max_active_levels != nullptr) omp_set_max_active_levels(openmp > 1 ? 1 : 0);
    }
    std::string name() const {
        if (blas == 1 && openmp == 1) return "";
        return " (BLAS " + std::to_string(blas) + ", OpenMP " + std::to_string(openmp) + ")";
    }
};

class Cholmod : public SolverPeer {
public:
    Cholmod(std::string ordering_name, int ordering, Threads threads)
        : ordering_(std::move(ordering_name)), threads_(threads) {
        cholmod_start(&common_);
        common_.nmethods = 1;
        common_.method[0].ordering = ordering;
        common_.postorder = 1;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.print = 0;
    }
    ~Cholmod() override {
        cholmod_free_dense(&x_, &common_);
        cholmod_free_dense(&y_, &common_);
        cholmod_free_dense(&e_, &common_);
        cholmod_finish(&common_);
    }

    std::string name() const override { return "CHOLMOD " + ordering_ + threads_.name(); }
    std::string ordering() const override { return ordering_; }
    Index largest() const override { return 1 << 30; }
    double bytes() const override { return bytes_; }

    PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                  std::vector<Columns>& x) override {
        // The upper triangle is what it permutes in one step.
        cholmod_sparse a{};
        a.nrow = a.ncol = at(matrix.n);
        a.nzmax = matrix.value.size();
        a.p = const_cast<Index*>(matrix.start.data());
        a.i = const_cast<Index*>(matrix.column.data());
        a.x = const_cast<double*>(matrix.value.data());
        a.stype = 1;
        a.itype = CHOLMOD_INT;
        a.xtype = CHOLMOD_REAL;
        a.dtype = CHOLMOD_DOUBLE;
        a.sorted = a.packed = 1;

        threads_.set();
        std::size_t const before = common_.memory_inuse;  // what the last solution left
        common_.memory_usage = before;
        PeerTimes times;
        Stopwatch watch;
        cholmod_factor* factor = cholmod_analyze(&a, &common_);
        times.analysis = watch.lap();
        if (factor == nullptr) fail("cholmod_analyze");
        cholmod_factorize(&a, factor, &common_);
        times.factor = watch.seconds();
        bytes_ = static_cast<double>(common_.memory_usage - before);
        bool good = common_.status == CHOLMOD_OK && factor->minor == factor->n;
        for (std::size_t set = 0; set < b.size() && good; ++set) {
            cholmod_dense right{};
            right.nrow = right.d = b[set].rows;
            right.ncol = b[set].count();
            right.nzmax = b[set].data.size();
            right.x = const_cast<double*>(b[set].data.data());
            right.xtype = CHOLMOD_REAL;
            right.dtype = CHOLMOD_DOUBLE;
            // solve2 keeps its work for the next run.
            watch.lap();
            good = cholmod_solve2(CHOLMOD_A, factor, &right, nullptr, &x_, nullptr, &y_, &e_,
                                  &common_) != 0;
            times.solve.push_back(watch.seconds());
            if (good) std::memcpy(x[set].data.data(), x_->x, x[set].data.size() * sizeof(double));
        }
        cholmod_free_factor(&factor, &common_);
        if (!good) fail("cholmod_factorize or cholmod_solve2");
        return times;
    }

private:
    std::string ordering_;
    Threads threads_;
    cholmod_common common_;
    cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
    double bytes_ = not_measured;

    [[noreturn]] void fail(const char* call) const {
        throw std::runtime_error(name() + ": " + call + " failed with status " +
                                 std::to_string(common_.status));
    }
};

}  // namespace

SolverPeers make_cholmod(int threads) {
    std::vector<Threads> ways = {{threads, threads}};
    if (threads > 1) ways = {{threads, 1}, {threads, threads}, {1, threads}};
    struct Ordering {
        char const* name;
        int number;
    };
    SolverPeers out;
    for (Ordering const ordering :
         {Ordering{"AMD", CHOLMOD_AMD}, {"METIS", CHOLMOD_METIS}, {"NESDIS", CHOLMOD_NESDIS}})
        for (Threads const& way : ways)
            out.push_back(std::make_unique<Cholmod>(ordering.name, ordering.number, way));
    return out;
}

}  // namespace bench
