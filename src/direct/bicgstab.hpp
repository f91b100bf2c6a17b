// BiCGSTAB with right preconditioning, for unsymmetric equations close to those of which there is a
// factor (H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631).
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"

namespace harmorph {

// Several right-hand sides at a time, each with separate coefficients: the bits of a solution do
// not depend on which other right-hand sides are solved with it.
struct BiconjugateGradients {
    static constexpr Index widest = 8;
    static constexpr Real most_growth = 1e6;

    Index n = 0, width = 0;
    Span<Real> shadow, direction, image, preconditioned, second, solution;  // [n * width] each

    void lay_out(Arena& arena, Index n_rows, Index n_columns) noexcept;

    // r [n * width], right-hand sides on entry: the first `columns` of each row become solutions.
    // Ends when the 2-norm of every residual is at most `reduction` times that of the right-hand
    // side, or after `most` iterations. Where a residual or a direction grows beyond most_growth
    // times the right-hand side, the method has broken down, and the solution is 0. apply(from,
    // to): to = A from; precondition(rows): in place; a failed status of the latter ends the
    // iteration.
    template <class Apply, class Precondition>
    Status run(Span<Real> r, Index columns, Real reduction, Index most, Index& iterations,
               Apply const& apply, Precondition const& precondition) noexcept;

private:
    struct Numbers {
        Real at[widest] = {};
        Real& operator[](Index k) noexcept { return at[k]; }
        Real operator[](Index k) const noexcept { return at[k]; }
    };
    Numbers dot(Span<const Real> a, Span<const Real> b, Index columns) const noexcept;
    // y = b y + a x
    void combine(Numbers const& a, Span<const Real> x, Numbers const& b, Span<Real> y,
                 Index columns) const noexcept;
    // Where the square of the norm of `vector` is larger than `most`, the column becomes 0:
    // residual r and solution. Returns the squares of the others.
    Numbers drop_grown(Span<const Real> vector, Numbers const& most, Span<Real> r,
                       Index columns) const noexcept;
};

template <class Apply, class Precondition>
Status BiconjugateGradients::run(Span<Real> r, Index columns, Real reduction, Index most,
                                 Index& iterations, Apply const& apply,
                                 Precondition const& precondition) noexcept {
    // Where there is nothing to do, and where the method breaks down, 0.
    constexpr auto quotient = [](Real a, Real b) { return abs(b) > 1e-30 * abs(a) ? a / b : 0; };
    Numbers one;
    for (Real& number : one.at) number = 1;
    copy(shadow, Span<const Real>(r));
    copy(direction, Span<const Real>(r));
    fill(solution, 0.0);
    Numbers along = dot(r, r, columns), wanted = along, most_squares = along;
    for (Index k = 0; k < columns; ++k) {
        wanted[k] *= reduction * reduction;
        most_squares[k] *= most_growth * most_growth;
    }
    Numbers squares = along;
    auto const is_done = [&](Index k) { return !(squares[k] > wanted[k]); };
    auto const all_done = [&] {
        for (Index k = 0; k < columns; ++k) {
            if (!is_done(k)) return false;
        }
        return true;
    };
    for (iterations = 0; iterations < most && !all_done(); ++iterations) {
        copy(preconditioned, Span<const Real>(direction));
        HARMORPH_TRY(precondition(preconditioned.data()));
        apply(preconditioned.data(), image.data());
        Numbers step = dot(shadow, image, columns), back;
        for (Index k = 0; k < columns; ++k) {
            step[k] = is_done(k) ? 0 : quotient(along[k], step[k]);
            back[k] = -step[k];
        }
        combine(step, preconditioned, one, solution, columns);
        combine(back, image, one, r, columns);
        squares = drop_grown(r, most_squares, r, columns);
        copy(preconditioned, Span<const Real>(r));
        HARMORPH_TRY(precondition(preconditioned.data()));
        apply(preconditioned.data(), second.data());
        Numbers turn = dot(second, r, columns);
        Numbers const size = dot(second, second, columns);
        for (Index k = 0; k < columns; ++k) {
            turn[k] = is_done(k) ? 0 : quotient(turn[k], size[k]);
            back[k] = -turn[k];
        }
        combine(turn, preconditioned, one, solution, columns);
        combine(back, second, one, r, columns);
        Numbers const before = along;
        squares = drop_grown(r, most_squares, r, columns);
        along = dot(shadow, r, columns);
        // direction = r + beta (direction - turn image); step, turn and beta are van der Vorst's
        // alpha, omega and beta
        Numbers beta, of_image;
        for (Index k = 0; k < columns; ++k) {
            beta[k] = quotient(along[k], before[k]) * quotient(step[k], turn[k]);
            of_image[k] = -turn[k] * beta[k];
        }
        combine(of_image, image, beta, direction, columns);
        combine(one, r, one, direction, columns);
        drop_grown(direction, most_squares, r, columns);
    }
    copy(r, Span<const Real>(solution));
    return Status::ok;
}

}  // namespace harmorph
