// The common members of all engines that iterate on levels. tests/multigrid/test_multigrid.cpp
// covers this file.
#pragma once

#include "multigrid/iteration.hpp"
#include "plan/equations.hpp"

namespace harmorph {

// Iterative is a BlockIteration. It iterates to the given tolerance, so solutions are not refined.
template <class Iterative>
struct LevelEngine {
    static constexpr bool trusted = true;

    Iterative iteration;

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        Index const n = analysis.graph().n;
        Offset const entries = analysis.matrix_sizes().entries;
        bool const is_complex = analysis.matrix_sizes().kind == MatrixKind::complex;
        iteration.lay_out(arena, n, is_complex ? 2 * columns : columns,
                          analysis.problem().iteration, analysis.problem().executor);
        auto const shared = arena.mark();
        iteration.lay_out_work(arena, n, entries);
        arena.release(shared);
        iteration.lay_out_vectors(arena, n);
        arena.release(shared);
    }
    void init(Analysis const&) const noexcept {}
    void take_pattern(Analysis const&, Matrix const&) const noexcept {}
    Status examine(Equations const&, Span<Real>, Fault&) const noexcept { return Status::ok; }
    Status correct(Rows const&, Fault&) const noexcept { return Status::ok; }
    Offset idle_bytes() const noexcept { return 0; }
    const Agglomeration* levels() const noexcept { return nullptr; }
};

}  // namespace harmorph
