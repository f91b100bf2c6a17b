// The library, through its C interface alone: from a mesh to solved functions, every phase timed.
#pragma once

#include "cases.hpp"

#include <harmorph_pages.h>

#include <cstdint>
#include <cstdlib>
#include <memory>

namespace bench {

// An engine, and the name that tables give to the engine.
struct Engine {
    char const* name;
    Index number;
};

struct Phases {
    double structure = 0, ordering = 0,
           symbolic = 0;              // hm_analysis_init; symbolic: with hm_plan_init as a whole
    double assembly = 0, factor = 0;  // hm_plan_factor
    double solve = 0, residual = 0;   // hm_plan_solve

    // The work of a solver that is given the matrix and the right-hand sides.
    double engine() const { return ordering + symbolic + factor + solve; }
    // The work that such a solver does not have.
    double around() const { return structure + assembly; }
};

enum class Pages { plain, huge };
enum class TimeKind { wall, processor };

// Memory comes untouched, and is kept for the next run.
struct Block {
    Pages pages = Pages::huge;
    std::unique_ptr<void, void (*)(void*)> memory{nullptr, std::free};
    void* data = nullptr;  // inside the memory
    std::size_t bytes = 0;

    Block() = default;
    explicit Block(Pages which) : pages(which) {}
    void* give(std::size_t wanted) {
        if (wanted > bytes) {
            memory.reset();
            std::size_t const room = hm_pages_room(wanted);  // SIZE_MAX: there is none
            memory.reset(room <= PTRDIFF_MAX ? std::malloc(room) : nullptr);
            if (!memory) throw std::bad_alloc();
            data = pages == Pages::huge ? hm_pages_place(memory.get(), wanted)
                                        : at_cache_line(memory.get());
            bytes = wanted;
        }
        return data;
    }
    static void* at_cache_line(void* memory) {
        std::uintptr_t const address = reinterpret_cast<std::uintptr_t>(memory);
        return static_cast<unsigned char*>(memory) + (64 - address % 64) % 64;
    }
    double* numbers(std::size_t n) { return static_cast<double*>(give(n * sizeof(double))); }
};

// Memory that only a run needs; several problems may take turns with this memory.
struct Workspace {
    Block analysis, plan;
};

class Ours {
public:
    // FAS is the improved one, with functions in blocks
    // of 4. The report of an engine that iterates may say that the engine has not converged.
    Ours(Case const& mesh_case, Workspace& workspace, Index functions, hm_executor const* executor,
         Index engine = HM_DIRECT, Index operator_kind = HM_LAPLACE);
    Ours(Ours const&) = delete;

    // Runs from the beginning, in the same blocks each time; the first run is the warm-up.
    Phases run(TimeKind kind = TimeKind::wall);
    // The size queries alone: analysis_bytes(), plan_bytes() and basis_bytes(), no solution.
    void query();
    hm_basis const* basis() const { return basis_; }
    Fit const& fit() const { return fit_; }
    Index functions() const { return functions_; }
    double plan_bytes() const { return plan_bytes_; }
    double analysis_bytes() const { return analysis_bytes_; }
    double basis_bytes() const { return basis_bytes_; }
    double factor_entries() const { return static_cast<double>(report_.factor_entries); }
    hm_solve_report const& report() const { return report_; }

private:
    struct Clock;
    struct Asked;  // the problem with its options
    hm_analysis* analyse(Asked& asked);

    Case const& case_;
    Workspace& workspace_;
    Index functions_;
    hm_executor const* executor_;
    Index engine_, operator_kind_;
    Fit fit_;
    Block basis_block_;
    hm_basis* basis_ = nullptr;
    double analysis_bytes_ = 0, plan_bytes_ = 0, basis_bytes_ = 0;
    hm_solve_report report_{};
};

// The medians of several runs, phase by phase.
Phases medians(std::vector<Phases> const& runs);

}  // namespace bench
