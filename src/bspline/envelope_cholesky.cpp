#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

void EnvelopeMatrix::lay_out(Arena& arena, Index n, Index bandwidth, bool closes) noexcept {
    Offset const rows = n;
    Offset const closing = closes ? smaller(rows, Offset(bandwidth)) : 0;
    arena.take(last_, n);
    arena.take(entries_, rows * (bandwidth + 1) + closing * rows);
}

void EnvelopeMatrix::shape(Index n, Index bandwidth, bool closes) noexcept {
    n_ = n;
    bandwidth_ = bandwidth;
    closes_ = closes;
    Offset end = 0;
    for (Index row = 0; row < n; ++row) {
        end += row - first_column(row) + 1;
        last_[row] = end - 1;
    }
    fill(entries_.first(end), Real(0));
}

bool EnvelopeMatrix::factor() const noexcept {
    for (Index i = 0; i < n_; ++i) {
        for (Index j = first_column(i); j <= i; ++j) {
            Real sum = at(i, j);
            for (Index k = larger(first_column(i), first_column(j)); k < j; ++k)
                sum -= at(i, k) * at(j, k);
            if (j < i) {
                at(i, j) = sum / at(j, j);
            } else {
                if (!(sum > 0)) return false;
                at(i, i) = square_root(sum);
            }
        }
    }
    return true;
}

void EnvelopeMatrix::solve(Span<Real> x) const noexcept {
    for (Index i = 0; i < n_; ++i) {
        for (Index j = first_column(i); j < i; ++j) x[i] -= at(i, j) * x[j];
        x[i] /= at(i, i);
    }
    for (Index i = n_ - 1; i >= 0; --i) {
        x[i] /= at(i, i);
        for (Index j = first_column(i); j < i; ++j) x[j] -= at(i, j) * x[i];
    }
}

}  // namespace harmorph
