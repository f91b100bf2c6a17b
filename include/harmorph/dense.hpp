// Dense kernels of the direct engine, on row-major blocks. A front's panel has `pivots` rows of `front` numbers; factored,
// it is the upper factor U (A = U^T U), with each diagonal block of `block` pivots replaced by its inverse, so that solves
// are products.
//
//            pivots        border
//          +---------+-----------------+
//   pivots | I1  U   |        U        |    I1, I2: inverses of the diagonal blocks (upper triangles, zeros below)
//          | 0   I2  |                 |
//          +---------+-----------------+
#pragma once

#include "harmorph/types.hpp"

namespace harmorph::dense {

inline constexpr Index block = 32;
// Kernels read, but never use or write, up to this many numbers behind the end of a block.
inline constexpr Offset overread = 64;
// Rows of right-hand sides are padded to a multiple of this.
inline constexpr Index row_multiple = 8;
constexpr Index padded(Index n) noexcept { return (n + row_multiple - 1) / row_multiple * row_multiple; }

struct Panel {
    Real* data = nullptr;
    Index pivots = 0;
    Index front = 0;  // pivots + border; also the length of a row
    Index border() const noexcept { return front - pivots; }
};

// Factors in place. Returns the first pivot that is not above `floor` times its value on entry, or none.
Index factor(Panel const& panel, Real floor) noexcept;

// Upper triangle of c [border x row] minus U^T U of the border's columns; what is below the diagonal is left undefined.
void update_border(Panel const& panel, Real* c, Offset row) noexcept;

// y [front x row], row a multiple of row_multiple: solves U^T y = y for the pivots and takes them off the border's rows.
void solve_forward(Panel const& panel, Real* y, Index row) noexcept;
// Solves U y = y for the pivots, the border's rows known.
void solve_backward(Panel const& panel, Real* y, Index row) noexcept;

}  // namespace harmorph::dense
