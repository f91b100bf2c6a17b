// Finds the modes of a family of movements of control points: a singular value decomposition by
// one-sided Jacobi rotations (M. Hestenes, J. SIAM 6 (1958) 51), in the inner product
//
//     <a, b> = sum_i D_i a_i . b_i / sum_i D_i,   D_i = integral of N_i by the arc length.
//
// tests/bspline/test_family_modes.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

class FamilyModes {
public:
    void lay_out(Arena& arena, Index n_control) noexcept;
    void start() noexcept;
    // Adds a curve, which must have been checked. Each curve of the set is added once.
    void add(Curve const& curve) noexcept;
    // Replaces movements [n * 2 * n_control] by the modes, and writes singular [n].
    Status run(Index n, Real* movements, Real* singular, Fault& fault) noexcept;

private:
    Real dot_of(const Real* a, const Real* b) const noexcept;
    void order(Index n, Real* movements, Real* singular) const noexcept;

    Span<Real> weight_;  // [n_control] the integral of each basis function
};

}  // namespace harmorph
