// The movement that a mesh has made so far, found from where the points of its wall are. Least
// squares for the numbers m_i of all functions, complex, and one r for each curve:
//     x_k - X_k = sum_i F_ik m_i + (r - 1) e_k,
// X_k the place of wall point k when the basis was made, F_ik its values, e_k = X_k - C(u_k) its
// offset from its curve, which safe morphs turn with their bodies. Where the wall has been moved by
// these functions alone, the residual is rounding. Normal equations, whose solution is refined by
// residuals of the points: what a weak regularisation adds to them vanishes from all numbers that
// the wall determines. The others follow the regularisation, which is 0 where no offset turns and
// each three neighbouring control points of a curve move by one similarity z -> a z + b.
#pragma once

#include "basis/basis_measures.hpp"

namespace harmorph {

struct WallMovement {
    // Parts of the extent of the wall: offsets that are rounding, and residuals of a wall that is
    // on no curve.
    static constexpr Real least_offset = 1e-12, default_tolerance = 1e-4;

    Span<Vec2> matrix;  // [unknowns * unknowns] lower triangle, Hermitian; then its Cholesky factor
    Span<Vec2> row;     // [unknowns] of one point of the wall
    Span<Vec2> unknown;  // [unknowns] the numbers of the functions, then (r - 1) times the scale of
                         // its curve
    Span<Vec2> step;     // [unknowns]
    Span<Real> scale;    // [curves] largest offset of a point from the curve; 0: none to be turned

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    // The largest residual, and its point; `unknown` is the movement, dx and dy of each function.
    BoundaryError find(Basis const& basis, Points at) noexcept;
    // Of the points of the wall, where they are.
    static Real extent(Basis const& basis, Points at) noexcept;

private:
    void find_row(Basis const& basis, Index slot) noexcept;
    Vec2 residual(Basis const& basis, Index slot, Points at) noexcept;
    void set_up(Basis const& basis) noexcept;
    Real regularise(Basis const& basis) noexcept;
    void add_similarity(Curve const& curve, Index k, Real strength) noexcept;
    void factor(Real smallest_pivot) noexcept;
    void solve() noexcept;
};

}  // namespace harmorph
