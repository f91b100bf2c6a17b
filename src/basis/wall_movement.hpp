// The movement that a mesh has made so far, found from the places of the points of its wall. Least
// squares determine the complex numbers m_i of all functions:
//     x_k - X_k = sum_i F_ik m_i,
// where X_k is the place of wall point k when the basis was made, and F_ik are its values. If these
// functions alone have moved the wall, the residual is rounding. The solution of the normal
// equations is refined with the residuals of the points, so that the weak regularisation vanishes
// from all numbers that the wall determines. Each correction is a combination of rows of the matrix
// F, so the solution is the smallest one of all movements with these residuals.
//
// Safe morphs rotate the offset e_k = X_k - C(u_k) of a point from its curve along with the body,
// so that a second solution has one number r more for each curve, whose term is (r - 1) e_k. With
// this number few points could follow any movement. A curve therefore has it only if more of its
// points are on the wall than it has functions and this number, and the second solution is taken
// only if the residual of the second solution is a tenth of the residual of the first one.
#pragma once

#include "basis/basis_measures.hpp"

namespace harmorph {

struct WallMovement {
    // Fractions of the extent of the wall: offsets below min_offset are rounding, and residuals
    // above default_tolerance mean that the wall follows no curve.
    static constexpr Real min_offset = 1e-12, default_tolerance = 1e-4;

    BoundaryError following;  // The largest residual beside the rotated offsets.
    BoundaryError residual;   // The largest distance of a point from where the functions lead it.
    Real rotated_offset = 0;  // The largest |(r - 1) e_k|.

    // [unknowns * unknowns] Lower triangle of a Hermitian matrix, then of its Cholesky factor.
    Span<Vec2> matrix;
    Span<Vec2> row;  // [unknowns] The row of one point of the wall.
    // [unknowns] The numbers of the functions, then for each curve (r - 1) times the scale of the
    // curve.
    Span<Vec2> unknown;
    Span<Vec2> step;   // [unknowns] A correction, or the smallest pivots.
    Span<Vec2> first;  // [unknowns] The solution in which no offset rotates.
    // [curves] The largest offset of a point from the curve; 0 if no offset rotates.
    Span<Real> scale;

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    // Finds `unknown`, which begins with dx and dy of each function, and the measures.
    void find(Basis const& basis, Points at) noexcept;
    // Returns the extent of the points of the wall at these places.
    static Real extent(Basis const& basis, Points at) noexcept;

private:
    void find_row(Basis const& basis, Index slot) noexcept;
    Vec2 rest(Basis const& basis, Index slot, Index n_columns, Points at) noexcept;
    bool find_scales(Basis const& basis) noexcept;
    bool determines_rotation(Basis const& basis, Index curve) noexcept;
    BoundaryError find_solution(Basis const& basis, Points at) noexcept;
    void measure(Basis const& basis, Points at) noexcept;
    void set_up(Basis const& basis) noexcept;
    void regularise(Basis const& basis) noexcept;
    void factor() noexcept;
    void solve() noexcept;
};

}  // namespace harmorph
