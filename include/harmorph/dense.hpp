// Dense kernels of the direct engine, on row-major blocks. A front's panel holds its pivots' rows; factored, it is the upper
// factor U (A = U^T U), with each diagonal block of `block` pivots replaced by its inverse, so that solves are products.
//
//             pivots         border
//           +----+-------+-----------+
//   strip 0 | I  |       |           |    Strips of at most `strip` pivots; a strip's rows begin at its first pivot, so that
//           +----+-------+-----------+    next to nothing below the diagonal is stored. I: inverses (upper triangles, zeros
//   strip 1      | I     |           |    below), one for each block.
//                +-------+-----------+
#pragma once

#include "harmorph/processor.hpp"

namespace harmorph::dense {

inline constexpr Index block = 32;
inline constexpr Index strip = 128;
// Kernels read, but never use or write, up to this many numbers behind the end of a block.
inline constexpr Offset overread = 64;
// Rows of right-hand sides are padded to a multiple of this.
inline constexpr Index row_multiple = 8;
constexpr Index padded(Index n) noexcept { return (n + row_multiple - 1) / row_multiple * row_multiple; }
// Numbers of working space for factor() and update_border().
inline constexpr Offset packing_entries = 2 * strip * strip;

struct Panel {
    Real* data = nullptr;
    Index pivots = 0;
    Index front = 0;  // pivots + border

    Index border() const noexcept { return front - pivots; }
    // Numbers from one row to the next in the strip that begins at pivot `first`.
    Offset row_length(Index first) const noexcept { return front - first; }
    Offset strip_start(Index first) const noexcept {
        return Offset{first} * front - Offset{first} * (first - strip) / 2;  // sum of strip * (front - 0, strip, 2 strip, ...)
    }
    // A pivot's row, such that row[column] is the entry in a column of the front, column >= the strip's first pivot.
    Real* row(Index pivot) const noexcept {
        Index const first = pivot / strip * strip;
        return data + strip_start(first) + (pivot - first) * row_length(first) - first;
    }
    static Offset entries(Index pivots, Index front) noexcept {
        Index const first = pivots / strip * strip;  // what is left is a strip of its own, or nothing
        Panel const panel{nullptr, pivots, front};
        return panel.strip_start(first) + Offset{pivots - first} * panel.row_length(first);
    }
};

// Factors in place. Returns the first pivot that is not above `floor` times its value before its own block, or none.
Index factor(Kernel kernel, Panel const& panel, Real floor, Real* packing) noexcept;

// Upper triangle of c [border x row] minus U^T U of the border's columns; what is below the diagonal is left undefined.
void update_border(Kernel kernel, Panel const& panel, Real* c, Offset row, Real* packing) noexcept;

// y [front x row], row a multiple of row_multiple: solves U^T y = y for the pivots and takes them off the border's rows.
void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row) noexcept;
// Solves U y = y for the pivots, the border's rows known.
void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row) noexcept;

}  // namespace harmorph::dense
