// The transpose of morphing: the gradient by movements from the gradient by mesh points. Sums are
// in fixed point, so that their bits depend neither on the number of threads nor on the partition
// of the points over processes.
#pragma once

#include "basis/basis.hpp"
#include "base/executor.hpp"
#include "base/fixed_sum.hpp"

namespace harmorph {

// Computes gradient [2 * functions] = sum over the points of F_i^T (by_x, by_y); all numbers are
// NaN if an input is not finite.
void adjoint_morph(Basis const& basis, Points gradient_by_points, Real* gradient,
                   Executor const& executor) noexcept;

// The calls below serve points on several processes, each with some rows of the basis. Take the
// maximum of adjoint_scale() over the processes, call adjoint_sums() with that scale, add the sums
// of all processes elementwise as integers, and call adjoint_finish().
BinaryScale adjoint_scale(Basis const& basis, Points gradient_by_points,
                          Executor const& executor) noexcept;
constexpr Offset adjoint_sums_count(Index row_length) noexcept { return 4 * Offset{row_length}; }
void adjoint_sums(Basis const& basis, Points gradient_by_points, BinaryScale scale,
                  std::int64_t* sums, Executor const& executor) noexcept;
void adjoint_finish(Basis const& basis, BinaryScale scale, const std::int64_t* sums,
                    Real* gradient) noexcept;

}  // namespace harmorph
