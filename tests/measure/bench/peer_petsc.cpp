// PETSc's conjugate gradients with its own algebraic multigrid (GAMG) and with hypre's BoomerAMG.
#include "clock.hpp"
#include "solver_peer.hpp"

#include <petscksp.h>

#include <malloc.h>

#include <stdexcept>

namespace bench {
namespace {

// Options of a preconditioner: "-pc_type", "gamg", ...
using PetscSettings = std::vector<std::pair<const char*, const char*>>;

void done(PetscErrorCode code, const char* call) {
    if (code != 0) throw std::runtime_error(std::string(call) + " failed in PETSc");
}

// Both triangles in compressed rows, columns increasing.
struct WholeRows {
    std::vector<PetscInt> start, column;
    std::vector<double> value;

    explicit WholeRows(Laplacian const& matrix) : start(at(matrix.n) + 1, 0) {
        for (Index i = 0; i < matrix.n; ++i) {
            for (Index k = matrix.start[at(i)]; k < matrix.start[at(i) + 1]; ++k) {
                ++start[at(i) + 1];
                if (matrix.column[at(k)] != i) ++start[at(matrix.column[at(k)]) + 1];
            }
        }
        for (Index i = 0; i < matrix.n; ++i) start[at(i) + 1] += start[at(i)];
        column.resize(at(start.back()));
        value.resize(column.size());
        std::vector<PetscInt> next = start;
        auto const put = [&](Index row, Index to, double entry) {
            std::size_t const k = at(next[at(row)]++);
            column[k] = to;
            value[k] = entry;
        };
        // A row gets its lower triangle when it is visited, and the rest from later rows in order.
        for (Index i = 0; i < matrix.n; ++i) {
            for (Index k = matrix.start[at(i)]; k < matrix.start[at(i) + 1]; ++k) {
                Index const j = matrix.column[at(k)];
                put(i, j, matrix.value[at(k)]);
                if (j != i) put(j, i, matrix.value[at(k)]);
            }
        }
    }
};

class Petsc : public SolverPeer {
public:
    Petsc(std::string name, PetscSettings settings)
        : name_(std::move(name)), settings_(std::move(settings)) {}

    std::string name() const override { return name_; }
    std::string ordering() const override { return ""; }
    Index largest() const override { return 2000000; }
    double bytes() const override { return bytes_; }
    Index iterations() const override { return iterations_; }

    PeerTimes run(Laplacian const& matrix, std::vector<Columns> const& b,
                  std::vector<Columns>& x) override {
        PetscBool is_ready = PETSC_FALSE;
        done(PetscInitialized(&is_ready), "PetscInitialized");
        if (is_ready == PETSC_FALSE) {
            // OpenMPI is to start without a daemon.
            setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
            done(PetscInitializeNoArguments(), "PetscInitialize");
        }
        double const before = in_use();
        WholeRows rows(matrix);
        PeerTimes times;
        ProcessorWatch watch;
        Mat a;
        done(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, matrix.n, matrix.n, rows.start.data(),
                                       rows.column.data(), rows.value.data(), &a),
             "MatCreateSeqAIJWithArrays");
        done(MatSetOption(a, MAT_SPD, PETSC_TRUE), "MatSetOption");
        KSP solver;
        done(KSPCreate(PETSC_COMM_SELF, &solver), "KSPCreate");
        done(KSPSetOperators(solver, a, a), "KSPSetOperators");
        done(KSPSetType(solver, KSPCG), "KSPSetType");
        done(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
        done(KSPSetTolerances(solver, 1e-10, 0, 1e10, 1000), "KSPSetTolerances");
        for (auto const& [option, value] : settings_)
            done(PetscOptionsSetValue(nullptr, option, value), "PetscOptionsSetValue");
        done(KSPSetFromOptions(solver), "KSPSetFromOptions");
        for (auto const& setting : settings_)
            done(PetscOptionsClearValue(nullptr, setting.first), "PetscOptionsClearValue");
        done(KSPSetUp(solver), "KSPSetUp");
        times.factor = watch.lap();
        Vec right, left;
        done(MatCreateVecs(a, &left, &right), "MatCreateVecs");
        iterations_ = 0;
        for (std::size_t set = 0; set < b.size(); ++set) {
            watch.lap();
            for (std::size_t k = 0; k < b[set].count(); ++k) {
                done(VecPlaceArray(right, b[set][k]), "VecPlaceArray");
                done(VecPlaceArray(left, x[set][k]), "VecPlaceArray");
                done(KSPSolve(solver, right, left), "KSPSolve");
                done(VecResetArray(right), "VecResetArray");
                done(VecResetArray(left), "VecResetArray");
                PetscInt count = 0;
                done(KSPGetIterationNumber(solver, &count), "KSPGetIterationNumber");
                iterations_ = std::max(iterations_, count);
            }
            times.solve.push_back(watch.lap());
        }
        bytes_ = in_use() - before;
        done(VecDestroy(&right), "VecDestroy");
        done(VecDestroy(&left), "VecDestroy");
        done(KSPDestroy(&solver), "KSPDestroy");
        done(MatDestroy(&a), "MatDestroy");
        return times;
    }

private:
    // Bytes that malloc has given and that are not freed.
    static double in_use() {
        struct mallinfo2 const info = mallinfo2();
        return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
    }

    std::string name_;
    PetscSettings settings_;
    double bytes_ = not_measured;
    Index iterations_ = 0;
};

}  // namespace

SolverPeers make_petsc() {
    SolverPeers out;
    out.push_back(std::make_unique<Petsc>("CG, GAMG", PetscSettings{{"-pc_type", "gamg"}}));
    out.push_back(std::make_unique<Petsc>(
        "CG, BoomerAMG", PetscSettings{{"-pc_type", "hypre"}, {"-pc_hypre_type", "boomeramg"}}));
    out.push_back(std::make_unique<Petsc>(
        "CG, BoomerAMG, ext+i", PetscSettings{{"-pc_type", "hypre"},
                                              {"-pc_hypre_type", "boomeramg"},
                                              {"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
                                              {"-pc_hypre_boomeramg_interp_type", "ext+i"},
                                              {"-pc_hypre_boomeramg_P_max", "4"}}));
    return out;
}

}  // namespace bench
