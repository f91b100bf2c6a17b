// The movement that a mesh has made so far, found from the places of the points of its wall. Least
// squares determine the complex numbers m_i of all functions, and one r for each curve:
//     x_k - X_k = sum_i F_ik m_i + (r - 1) e_k,
// where X_k is the place of wall point k when the basis was made, F_ik are its values, and e_k =
// X_k - C(u_k) is its offset from its curve, which safe morphs turn with their bodies. If these
// functions alone have moved the wall, the residual is rounding. The solution of the normal
// equations is refined with the residuals of the points, so that the weak regularisation vanishes
// from all numbers that the wall determines. The other numbers follow the regularisation, which is
// 0 if no offset turns and each three neighbouring control points of a curve move by one similarity
// z -> a z + b.
#pragma once

#include "basis/basis_measures.hpp"

namespace harmorph {

struct WallMovement {
    // Both are fractions of the extent of the wall: offsets below the first are rounding, and
    // residuals above the second mean that the wall follows no curve.
    static constexpr Real min_offset = 1e-12, default_tolerance = 1e-4;

    // [unknowns * unknowns] Lower triangle of a Hermitian matrix, then of its Cholesky factor.
    Span<Vec2> matrix;
    Span<Vec2> row;  // [unknowns] The row of one point of the wall.
    // [unknowns] The numbers of the functions, then for each curve (r - 1) times the scale of the
    // curve.
    Span<Vec2> unknown;
    Span<Vec2> step;  // [unknowns]
    // [curves] The largest offset of a point from the curve; 0 if no offset is to be turned.
    Span<Real> scale;

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    // Returns the largest residual and its point; `unknown` contains the movement, dx and dy of
    // each function.
    BoundaryError find(Basis const& basis, Points at) noexcept;
    // Returns the extent of the points of the wall at these places.
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
