// Biconjugate gradients, stabilised, preconditioned from the right, for equations without symmetry that are nearly those of
// a factor (H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631).
#pragma once

#include "harmorph/base/arena.hpp"
#include "harmorph/base/scalar.hpp"

namespace harmorph {

// Several right-hand sides side by side, each with its own numbers: its bits do not depend on its neighbours.
struct BiconjugateGradients {
    static constexpr Index widest = 8;

    Index n = 0, width = 0;
    Span<Real> shadow, direction, image, preconditioned, second, solution;  // [n * width] each

    void lay_out(Arena& arena, Index its_n, Index its_width) noexcept;

    // r [n * width], in place: the first `columns` of each row become solutions whose residuals are `reduction` times as
    // large, or as far as `most` iterations come. apply(from, to): to = A from; precondition(rows): in place, a failed
    // status ends all.
    template <class Apply, class Precondition>
    Status run(Span<Real> r, Index columns, Real reduction, Index most, Index& iterations, Apply const& apply,
               Precondition const& precondition) noexcept;

private:
    struct Numbers {
        Real at[widest] = {};
        Real& operator[](Index k) noexcept { return at[k]; }
        Real operator[](Index k) const noexcept { return at[k]; }
    };
    Numbers dot(Span<const Real> a, Span<const Real> b, Index columns) const noexcept;
    // y = b y + a x
    void combine(Numbers const& a, Span<const Real> x, Numbers const& b, Span<Real> y, Index columns) const noexcept;
};

template <class Apply, class Precondition>
Status BiconjugateGradients::run(Span<Real> r, Index columns, Real reduction, Index most, Index& iterations,
                                 Apply const& apply, Precondition const& precondition) noexcept {
    constexpr auto quotient = [](Real a, Real b) { return b != 0 ? a / b : 0; };  // 0 / 0 where there is nothing to do
    Numbers one;
    for (Real& its : one.at) its = 1;
    copy(shadow, Span<const Real>(r));
    copy(direction, Span<const Real>(r));
    fill(solution, 0.0);
    Numbers along = dot(r, r, columns), wanted = along;
    for (Index k = 0; k < columns; ++k) wanted[k] *= reduction * reduction;
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
        squares = dot(r, r, columns);
        along = dot(shadow, r, columns);
        // direction = r + share (direction - turn image)
        Numbers share, of_image;
        for (Index k = 0; k < columns; ++k) {
            share[k] = quotient(along[k], before[k]) * quotient(step[k], turn[k]);
            of_image[k] = -turn[k] * share[k];
        }
        combine(of_image, image, share, direction, columns);
        combine(one, r, one, direction, columns);
    }
    copy(r, Span<const Real>(solution));
    return Status::ok;
}

}  // namespace harmorph
