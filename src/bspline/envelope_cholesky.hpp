// A symmetric positive definite matrix of a few hundred rows within its envelope, and its Cholesky
// factor. George & Liu, Computer Solution of Large Sparse Positive Definite Systems (1981),
// chapter 4.
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"

namespace harmorph {

// Row i keeps the entries from first_column(i) to the diagonal: a band, and full last rows where
// the band closes to a ring (periodic splines):   x
//                              x x
//                                x x
//                              x x x x    <- one closing row for bandwidth 1
class EnvelopeMatrix {
public:
    void lay_out(Arena& arena, Index n, Index bandwidth, bool closes) noexcept;
    void shape(Index n, Index bandwidth,
               bool closes) noexcept;  // as laid out, or smaller; sets all entries to 0

    Index count() const noexcept { return n_; }
    Index first_column(Index row) const noexcept {
        return closes_ && row >= n_ - bandwidth_ ? 0 : max(Index(0), row - bandwidth_);
    }
    Real& at(Index row, Index column) const noexcept {
        return entries_[last_[row] - (row - column)];
    }  // column <= row
    void add(Index i, Index j, Real value) const noexcept {
        (i < j ? at(j, i) : at(i, j)) += value;
    }

    // In place. Returns none, or the first row whose pivot is not above `least` of its diagonal:
    // the matrix is not positive definite there, to rounding.
    Index factor(Real least = 0) const noexcept;
    // Right-hand sides in, solutions out: `width` numbers side by side for each row.
    void solve(Span<Real> x, Index width = 1) const noexcept;

private:
    Index n_ = 0, bandwidth_ = 0;
    bool closes_ = false;
    Span<Offset> last_;  // [n] where the diagonal entry of each row is
    Span<Real> entries_;
};

}  // namespace harmorph
