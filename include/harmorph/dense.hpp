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

#include "harmorph/executor.hpp"
#include "harmorph/processor.hpp"

namespace harmorph::dense {

inline constexpr Index block = 32;
inline constexpr Index strip = 128;
// Kernels read, but never use or write, up to this many numbers behind the end of a block.
inline constexpr Offset overread = 64;
// Rows of right-hand sides are padded to a multiple of this.
inline constexpr Index row_multiple = 8;
constexpr Index padded(Index n) noexcept { return (n + row_multiple - 1) / row_multiple * row_multiple; }
// Numbers of working space for one thread.
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

// The symmetric matrix that a front leaves to its parent: the upper triangle, in bands of `strip` rows that begin at their
// first row's diagonal. Rows are padded, so that they can be written in whole vectors.
struct UpdateMatrix {
    Real* data = nullptr;
    Index n = 0;

    Offset row_length(Index first) const noexcept { return padded(n - first); }
    Offset band_start(Index first) const noexcept {
        Offset const all = padded(n);
        return Offset{first} * all - Offset{first} * (first - strip) / 2;  // strip is a multiple of the padding
    }
    // row[column] is the entry in a column, column >= the band's first row.
    Real* row(Index number) const noexcept {
        Index const first = number / strip * strip;
        return data + band_start(first) + (number - first) * row_length(first) - first;
    }
    static Offset entries(Index n) noexcept {
        Index const first = n / strip * strip;
        UpdateMatrix const matrix{nullptr, n};
        return matrix.band_start(first) + Offset{n - first} * matrix.row_length(first);
    }
};

// The caller's threads, and packing_entries numbers for each of them.
struct Workers {
    Executor executor;
    Real* packing = nullptr;
};

// Factors in place. Returns the first pivot that is not above `floor` times its value before its own block, or none.
Index factor(Kernel kernel, Panel const& panel, Real floor, Workers const& workers) noexcept;

// Takes U^T U of the border's columns off the update matrix.
void update_border(Kernel kernel, Panel const& panel, UpdateMatrix const& update, Workers const& workers) noexcept;

// y [front x row], row a multiple of row_multiple: solves U^T y = y for the pivots and takes them off the border's rows.
void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row, Executor const& executor) noexcept;
// Solves U y = y for the pivots, the border's rows known.
void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row, Executor const& executor) noexcept;

}  // namespace harmorph::dense
