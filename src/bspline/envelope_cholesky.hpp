// Stores a symmetric positive definite matrix of a few hundred rows within its envelope, and
// computes its Cholesky factor. George & Liu, Computer Solution of Large Sparse Positive Definite
// Systems (1981), chapter 4.
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"

namespace harmorph {

// Row i keeps the entries from first_column(i) to the diagonal. The rows form a band; if the matrix
// closes (periodic splines), the last rows are full. For bandwidth 1, the last row is full:
//
//     x
//     x x
//       x x
//     x x x x
class EnvelopeMatrix {
public:
    void lay_out(Arena& arena, Index n, Index bandwidth, bool closes) noexcept;
    // Sets the shape, at most as large as laid out, and sets all entries to 0.
    void shape(Index n, Index bandwidth, bool closes) noexcept;

    Index count() const noexcept { return n_; }
    Index first_column(Index row) const noexcept {
        return closes_ && row >= n_ - bandwidth_ ? 0 : max(Index(0), row - bandwidth_);
    }
    // Returns an entry with column <= row.
    Real& at(Index row, Index column) const noexcept {
        return entries_[last_[row] - (row - column)];
    }
    void add(Index i, Index j, Real value) const noexcept {
        (i < j ? at(j, i) : at(i, j)) += value;
    }

    // Factors the matrix in place. Returns none, or the first row whose pivot is not larger than
    // min_pivot times the diagonal entry: the matrix is not positive definite there, to rounding.
    Index factor(Real min_pivot = 0) const noexcept;
    // Replaces right-hand sides by solutions; x has `width` numbers side by side for each row.
    void solve(Span<Real> x, Index width = 1) const noexcept;

private:
    Index n_ = 0, bandwidth_ = 0;
    bool closes_ = false;
    Span<Offset> last_;  // [n] the position of the diagonal entry of each row
    Span<Real> entries_;
};

}  // namespace harmorph
