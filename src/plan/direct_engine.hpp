// The direct engine of a plan: a multifrontal factor of the matrix, which also serves iterative
// refinement. tests/plan/test_thin_shear.cpp covers this file.
#pragma once

#include "direct/multifrontal.hpp"
#include "multigrid/iteration.hpp"
#include "plan/equations.hpp"

namespace harmorph {

// AnyEngine describes the members.
struct DirectEngine {
    Multifrontal factor;
    bool trusted = false;  // Nothing cancelled in the factor, so solutions need no refinement.

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept;
    void init(Analysis const& analysis) noexcept;
    void take_pattern(Analysis const&, Matrix const&) const noexcept {}
    Status set_up(Equations const& equations, Points points, Progress const& progress,
                  Fault& fault) noexcept;
    // `work` [n] is overwritten.
    Status examine(Equations const& equations, Span<Real> work, Fault& fault) noexcept;
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept;
    Status correct(Rows const& rows, Fault& fault) noexcept {
        return factor.solve(rows, Progress{}, fault);
    }
    // Returns the size of the memory that only set_up() needs.
    Offset idle_bytes() const noexcept;
    const Agglomeration* levels() const noexcept { return nullptr; }
};

}  // namespace harmorph
