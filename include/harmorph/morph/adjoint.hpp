// The transpose of morphing: the gradient by movements from the gradient by mesh points. Sums are in fixed point, so
// that their bits do not depend on threads, nor on how the points are shared out over processes.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "harmorph/base/executor.hpp"
#include "harmorph/base/fixed_sum.hpp"

namespace harmorph {

// gradient [2 * functions] = sum over the points of F_i^T (by_x, by_y); all NaN where a number is not finite.
void adjoint_morph(Basis const& basis, Points gradient_by_points, Real* gradient, Executor const& executor) noexcept;

// The same for points in several places, each with rows of one basis: the largest of the scales, then the sums at that
// scale, added up elementwise as integers, are those of all points together.
BinaryScale adjoint_scale(Basis const& basis, Points gradient_by_points, Executor const& executor) noexcept;
constexpr Offset adjoint_sums_count(Index row_length) noexcept { return 4 * Offset{row_length}; }
void adjoint_sums(Basis const& basis, Points gradient_by_points, BinaryScale scale, std::int64_t* sums,
                  Executor const& executor) noexcept;
void adjoint_finish(Basis const& basis, BinaryScale scale, const std::int64_t* sums, Real* gradient) noexcept;

}  // namespace harmorph
