// BiCGSTAB with right preconditioning, for unsymmetric equations that are close to equations with a
// known factor (H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631).
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"

namespace harmorph {

// Several right-hand sides are solved at a time, each with separate coefficients: the bits of a
// solution do not depend on the other right-hand sides.
struct BiconjugateGradients {
    static constexpr Index max_width = 8;
    static constexpr Real max_growth = 1e6;

    Index n = 0, width = 0;
    Span<Real> shadow, direction, image, preconditioned, second, solution;  // [n * width] each

    void lay_out(Arena& arena, Index n_rows, Index n_columns) noexcept;

    // On entry r [n * width] has right-hand sides; the first `columns` of each row become
    // solutions. The iteration ends when the 2-norm of every residual is at most `reduction` times
    // that of the right-hand side, or after max_iterations. If a residual or a direction grows
    // beyond max_growth times the right-hand side, the method has broken down, and the solution is
    // 0. apply(from, to) computes to = A from; precondition(rows) works in place, and a failed
    // status of precondition() ends the iteration.
    template <class Apply, class Precondition>
    Status run(Span<Real> r, Index columns, Real reduction, Index max_iterations, Index& iterations,
               Apply const& apply, Precondition const& precondition) noexcept;

private:
    struct Numbers {
        Real at[max_width] = {};
        Real& operator[](Index k) noexcept { return at[k]; }
        Real operator[](Index k) const noexcept { return at[k]; }
    };
    Numbers dot(Span<const Real> a, Span<const Real> b, Index columns) const noexcept;
    // Computes y = b y + a x.
    void combine(Numbers const& a, Span<const Real> x, Numbers const& b, Span<Real> y,
                 Index columns) const noexcept;
    // If the square of the norm of a column of `vector` is larger than max_squares, the column of
    // the residual r and of the solution becomes 0. Returns the squares of the other columns.
    Numbers drop_grown(Span<const Real> vector, Numbers const& max_squares, Span<Real> r,
                       Index columns) const noexcept;
};

template <class Apply, class Precondition>
Status BiconjugateGradients::run(Span<Real> r, Index columns, Real reduction, Index max_iterations,
                                 Index& iterations, Apply const& apply,
                                 Precondition const& precondition) noexcept {
    // The quotient is 0 if no work is left, and if the method breaks down.
    constexpr auto quotient = [](Real a, Real b) { return abs(b) > 1e-30 * abs(a) ? a / b : 0; };
    Numbers one;
    for (Real& number : one.at) number = 1;
    copy(shadow, Span<const Real>(r));
    copy(direction, Span<const Real>(r));
    fill(solution, 0.0);
    Numbers along = dot(r, r, columns), wanted = along, max_squares = along;
    for (Index k = 0; k < columns; ++k) {
        wanted[k] *= reduction * reduction;
        max_squares[k] *= max_growth * max_growth;
    }
    Numbers squares = along;
    auto const is_done = [&](Index k) { return !(squares[k] > wanted[k]); };
    auto const all_done = [&] {
        for (Index k = 0; k < columns; ++k) {
            if (!is_done(k)) return false;
        }
        return true;
    };
    for (iterations = 0; iterations < max_iterations && !all_done(); ++iterations) {
        copy(preconditioned, Span<const Real>(direction));
        HARMORPH_TRY(precondition(preconditioned.data()));
        apply(preconditioned.data(), image.data());
        Numbers alpha = dot(shadow, image, columns), back;
        for (Index k = 0; k < columns; ++k) {
            alpha[k] = is_done(k) ? 0 : quotient(along[k], alpha[k]);
            back[k] = -alpha[k];
        }
        combine(alpha, preconditioned, one, solution, columns);
        combine(back, image, one, r, columns);
        squares = drop_grown(r, max_squares, r, columns);
        copy(preconditioned, Span<const Real>(r));
        HARMORPH_TRY(precondition(preconditioned.data()));
        apply(preconditioned.data(), second.data());
        Numbers omega = dot(second, r, columns);
        Numbers const size = dot(second, second, columns);
        for (Index k = 0; k < columns; ++k) {
            omega[k] = is_done(k) ? 0 : quotient(omega[k], size[k]);
            back[k] = -omega[k];
        }
        combine(omega, preconditioned, one, solution, columns);
        combine(back, second, one, r, columns);
        Numbers const before = along;
        squares = drop_grown(r, max_squares, r, columns);
        along = dot(shadow, r, columns);
        // The coefficients have van der Vorst's names: direction = r + beta (direction - omega
        // image).
        Numbers beta, image_weight;
        for (Index k = 0; k < columns; ++k) {
            beta[k] = quotient(along[k], before[k]) * quotient(alpha[k], omega[k]);
            image_weight[k] = -omega[k] * beta[k];
        }
        combine(image_weight, image, beta, direction, columns);
        combine(one, r, one, direction, columns);
        drop_grown(direction, max_squares, r, columns);
    }
    copy(r, Span<const Real>(solution));
    return Status::ok;
}

}  // namespace harmorph
