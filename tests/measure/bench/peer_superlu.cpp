// SuperLU, sequential, in its mode for symmetric patterns: J. W. Demmel, S. C. Eisenstat, J. R.
// Gilbert, X. S. Li, J. W. H. Liu, SIAM J. Matrix Anal. Appl. 20 (1999) 720.
#include "clock.hpp"
#include "solver_peer.hpp"

#include <superlu/slu_ddefs.h>

#include <stdexcept>

// Sets the threads of OpenBLAS, if OpenBLAS is present.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace bench {
namespace {

// Both triangles, in compressed columns.
struct Whole {
    std::vector<int> start, row;
    std::vector<double> value;

    explicit Whole(Laplacian const& matrix) : start(at(matrix.n) + 1, 0) {
        auto for_each = [&](auto const& visit) {
            for (Index i = 0; i < matrix.n; ++i) {
                for (Index k = matrix.start[at(i)]; k < matrix.start[at(i) + 1]; ++k) {
                    Index const j = matrix.column[at(k)];
                    visit(i, j, matrix.value[at(k)]);
                    if (i != j) visit(j, i, matrix.value[at(k)]);
                }
            }
        };
        for_each([&](Index, Index column, double) { ++start[at(column) + 1]; });
        for (Index i = 0; i < matrix.n; ++i) start[at(i) + 1] += start[at(i)];
        row.resize(at(start.back()));
        value.resize(row.size());
        std::vector<int> next = start;
        for_each([&](Index i, Index column, double entry_value) {
            int const k = next[at(column)]++;
            row[at(k)] = i;
            value[at(k)] = entry_value;
        });
    }
};

class SuperLu : public SolverPeer {
public:
    explicit SuperLu(int threads) : threads_(threads) {}

    std::string name() const override { return "SuperLU"; }
    std::string ordering() const override { return "MMD"; }
    Index largest() const override { return 150000; }
    double bytes() const override { return bytes_; }

    PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                  std::vector<Columns>& x) override {
        Whole whole(matrix);
        if (openblas_set_num_threads != nullptr) openblas_set_num_threads(threads_);
        int const n = matrix.n;
        superlu_options_t options;
        set_default_options(&options);
        options.ColPerm = MMD_AT_PLUS_A;
        options.SymmetricMode = YES;
        options.DiagPivotThresh = 0;
        std::vector<int> by_column(at(n)), by_row(at(n)), tree(at(n));
        SuperMatrix a, permuted, lower, upper;
        dCreate_CompCol_Matrix(&a, n, n, static_cast<int>(whole.row.size()), whole.value.data(),
                               whole.row.data(), whole.start.data(), SLU_NC, SLU_D, SLU_GE);
        SuperLUStat_t statistics;
        StatInit(&statistics);
        GlobalLU_t memory;
        PeerTimes times;
        int info = 0;
        Stopwatch watch;
        get_perm_c(options.ColPerm, &a, by_column.data());
        sp_preorder(&options, &a, by_column.data(), tree.data(), &permuted);
        times.analysis = watch.lap();
        dgstrf(&options, &permuted, sp_ienv(2), sp_ienv(1), tree.data(), nullptr, 0,
               by_column.data(), by_row.data(), &lower, &upper, &memory, &statistics, &info);
        times.factor = watch.lap();
        bool const is_factored = info == 0;
        if (is_factored) {
            mem_usage_t used;
            dQuerySpace(&lower, &upper, &used);
            bytes_ = used.total_needed;
        }
        for (std::size_t set = 0; set < b.size() && info == 0; ++set) {
            x[set].data = b[set].data;  // solved in place
            SuperMatrix right;
            dCreate_Dense_Matrix(&right, n, static_cast<int>(b[set].count()), x[set].data.data(), n,
                                 SLU_DN, SLU_D, SLU_GE);
            watch.lap();
            dgstrs(NOTRANS, &lower, &upper, by_column.data(), by_row.data(), &right, &statistics,
                   &info);
            times.solve.push_back(watch.seconds());
            Destroy_SuperMatrix_Store(&right);
        }
        if (is_factored) {
            Destroy_SuperNode_Matrix(&lower);
            Destroy_CompCol_Matrix(&upper);
        }
        Destroy_CompCol_Permuted(&permuted);
        Destroy_SuperMatrix_Store(&a);
        StatFree(&statistics);
        if (info != 0)
            throw std::runtime_error("SuperLU failed with info = " + std::to_string(info));
        return times;
    }

private:
    int threads_;
    double bytes_ = not_measured;
};

}  // namespace

SolverPeers make_superlu(int threads) {
    SolverPeers out;
    out.push_back(std::make_unique<SuperLu>(threads));
    return out;
}

}  // namespace bench
