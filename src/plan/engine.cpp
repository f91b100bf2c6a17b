#include "plan/engine.hpp"

namespace harmorph {
namespace {

// If |sum of the terms| / sum of |terms| is larger than this for all pivots, cancellation does not
// matter.
constexpr Real min_uncancelled_ratio = 1e-3;

// If pivot / diagonal is larger than this for all pivots, cancellation does not matter. The ratio
// is a fifth on isotropic cells, and thousandths beside thin ones. Circulations are not
// conductances, so their sums cancel in part, and so do conductances that large angles make
// negative. If x and y are coupled, the rows of rotated dofs of slipping points have no row sums,
// so the bound is larger.
constexpr Real min_even_pivot(MatrixKind kind) noexcept {
    return kind == MatrixKind::coupled_xy ? 1.0 / 30 : 1e-5;
}

// Conductances that large angles of cells make negative may cancel others between the same two
// points, which no pivot shows: the rounding error of the sum acts like a conductance. The error of
// functions is therefore about epsilon times the values that sources of the size of all negative
// conductances would cause. Returns the largest of these values; for real matrices only.
Status raise_by_negative(Multifrontal& factor, Matrix const& matrix, Span<Real> source, Real& rise,
                         Fault& fault) noexcept {
    fill(source, 0.0);
    // An entry is minus a conductance.
    auto const add = [&](Index row, Real entry) { source[row] += entry > 0 ? entry : 0; };
    for (Index i = 0; i < matrix.n; ++i) {
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            add(i, matrix.value[e]);
            add(matrix.column[e], matrix.value[e]);
        }
    }
    for (Index c = 0; c < matrix.coupling_row.count(); ++c)
        add(matrix.coupling_row[c], matrix.coupling_value[c]);
    for (Index h = 0; h < matrix.fixed_row.count(); ++h)
        add(matrix.fixed_row[h], matrix.fixed_value[h]);
    HARMORPH_TRY(factor.solve(Rows{source.data(), nullptr, 1, 1, 1}, Progress{}, fault));
    rise = 0;
    for (Real const value : source) rise = max(rise, abs(value));
    return Status::ok;
}

}  // namespace

void DirectEngine::lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
    factor.lay_out(arena, analysis.tree().count, analysis.fronts(), analysis.subtrees(), columns,
                   analysis.matrix_sizes().kind == MatrixKind::complex);
    auto const shared = arena.mark();
    factor.lay_out_stack(arena);
    arena.release(shared);
}

void DirectEngine::init(Analysis const& analysis) noexcept {
    factor.executor = analysis.problem().executor;
    factor.tree.count = analysis.tree().count;
    copy(factor.subtrees.all,
         Span<const Subtree>(analysis.subtrees().all.first(analysis.subtrees().count)));
    copy(factor.tree.nodes,
         Span<const AssemblyTree::Node>(analysis.tree().nodes.first(analysis.tree().count)));
    copy(factor.border_start,
         Span<const Offset>(analysis.border_start().first(analysis.tree().count + 1)));
    fill_borders(analysis.graph(), analysis.order(), analysis.tree(), analysis.border(),
                 factor.executor, factor.border_start, factor.border);
    factor.complete();
}

Status DirectEngine::set_up(Equations const& equations, Points, Progress const& progress,
                            Fault& fault) noexcept {
    factor.kernel = equations.method().kernel;
    return factor.factorise(equations.matrix(), progress, fault);
}

// Thin cells have by far the largest entries, so beside them a small residual may hide a large
// error. If nothing cancelled in the factor, there is no such error. For nodal gradients the factor
// is that of the compact scheme, so it is never trusted.
Status DirectEngine::examine(Equations const& equations, Span<Real> work, Fault& fault) noexcept {
    trusted = false;
    if (equations.method().nodal_gradients()) return Status::ok;
    Matrix const& matrix = equations.matrix();
    Real const even = min_even_pivot(matrix.kind()), ratio = factor.min_pivot_ratio(),
               pivot = factor.min_pivot_to_diagonal();
    trusted = pivot > even;
    if (matrix.kind() != MatrixKind::real) return Status::ok;
    trusted = ratio > min_uncancelled_ratio && pivot > even * (1 - ratio);
    if (trusted || !(ratio > min_uncancelled_ratio)) return Status::ok;
    Real rise = 0;
    HARMORPH_TRY(raise_by_negative(factor, matrix, work, rise, fault));
    trusted = even * rise < 1;
    return Status::ok;
}

// For nodal gradients this solves for the functions of the compact scheme, from which refinement
// starts.
Status DirectEngine::solve(Equations const& equations, DofValues const& dofs,
                           Progress const& progress, IterationReport&, Fault& fault) noexcept {
    Rows const rows = dofs.rows(equations.matrix());
    if (rows.width <= factor.padded_width) return factor.solve(rows, progress, fault);
    // Combined functions and modes may have more columns than the factor has room for.
    for (Index first = 0; first < rows.width; first += factor.padded_width) {
        Index const n = min(factor.padded_width, rows.width - first);
        HARMORPH_TRY(factor.solve(
            Rows{rows.data + first, rows.row_of, rows.row_length, n, rows.plane}, progress, fault));
    }
    return Status::ok;
}

Offset DirectEngine::idle_bytes() const noexcept {
    return factor.planes * factor.subtrees.top_stack_entries * static_cast<Offset>(sizeof(Real));
}

}  // namespace harmorph
