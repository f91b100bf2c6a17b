#include "direct/bicgstab.hpp"

namespace harmorph {

void BiconjugateGradients::lay_out(Arena& arena, Index n_rows, Index n_columns) noexcept {
    n = n_rows;
    width = n_columns;
    Offset const numbers = Offset{n} * width;
    arena.take(shadow, numbers);
    arena.take(direction, numbers);
    arena.take(image, numbers);
    arena.take(preconditioned, numbers);
    arena.take(second, numbers);
    arena.take(solution, numbers);
}

BiconjugateGradients::Numbers BiconjugateGradients::dot(Span<const Real> a, Span<const Real> b,
                                                        Index columns) const noexcept {
    Numbers sum;
    for (Offset row = 0; row < Offset{n} * width; row += width) {
        for (Index k = 0; k < columns; ++k) sum[k] += a[row + k] * b[row + k];
    }
    return sum;
}

void BiconjugateGradients::combine(Numbers const& a, Span<const Real> x, Numbers const& b,
                                   Span<Real> y, Index columns) const noexcept {
    for (Offset row = 0; row < Offset{n} * width; row += width) {
        for (Index k = 0; k < columns; ++k) y[row + k] = b[k] * y[row + k] + a[k] * x[row + k];
    }
}

BiconjugateGradients::Numbers BiconjugateGradients::drop_grown(Span<const Real> vector,
                                                               Numbers const& max_squares,
                                                               Span<Real> r,
                                                               Index columns) const noexcept {
    Numbers squares = dot(vector, vector, columns);
    for (Index k = 0; k < columns; ++k) {
        if (squares[k] <= max_squares[k]) continue;
        squares[k] = 0;
        for (Offset row = 0; row < Offset{n} * width; row += width) {
            r[row + k] = direction[row + k] = image[row + k] = solution[row + k] = 0;
        }
    }
    return squares;
}

}  // namespace harmorph
