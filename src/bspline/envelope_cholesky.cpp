#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

void EnvelopeMatrix::lay_out(Arena& arena, Index n, Index bandwidth, bool closes) noexcept {
    Offset const rows = n;
    Offset const closing = closes ? min(rows, Offset(bandwidth)) : 0;
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

Index EnvelopeMatrix::factor(Real min_pivot) const noexcept {
    for (Index i = 0; i < n_; ++i) {
        Real const diagonal = at(i, i);
        for (Index j = first_column(i); j <= i; ++j) {
            Real sum = at(i, j);
            for (Index k = max(first_column(i), first_column(j)); k < j; ++k)
                sum -= at(i, k) * at(j, k);
            if (j < i) {
                at(i, j) = sum / at(j, j);
            } else {
                if (!(sum > min_pivot * diagonal)) return i;
                at(i, i) = sqrt(sum);
            }
        }
    }
    return none;
}

void EnvelopeMatrix::solve(Span<Real> x, Index width) const noexcept {
    auto const row = [&](Index i) { return x.data() + Offset{i} * width; };
    auto const subtract = [&](Real factor, Index from, Index to) {
        if (factor == 0) return;
        for (Index c = 0; c < width; ++c) row(to)[c] -= factor * row(from)[c];
    };
    auto const divide = [&](Index i) {
        for (Index c = 0; c < width; ++c) row(i)[c] /= at(i, i);
    };
    for (Index i = 0; i < n_; ++i) {
        for (Index j = first_column(i); j < i; ++j) subtract(at(i, j), j, i);
        divide(i);
    }
    for (Index i = n_ - 1; i >= 0; --i) {
        divide(i);
        for (Index j = first_column(i); j < i; ++j) subtract(at(i, j), i, j);
    }
}

}  // namespace harmorph
