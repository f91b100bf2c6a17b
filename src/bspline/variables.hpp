// Computes the movement of the outline by each of several design variables that are not control
// points. tests/bspline/test_variables.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them.
enum class VariableKind : std::int32_t { ffd = 0, cst = 1, hicks_henne = 2, naca4 = 3 };

// Writes the Bernstein polynomials of degree n - 1 at t to value [n], by de Casteljau's algorithm.
void bernstein(Index n, Real t, Real* value) noexcept;

struct Variables {
    // The largest number of variables of one side, and of nodes in one direction.
    static constexpr Index max_count = 64;

    VariableKind kind = VariableKind::ffd;
    Index n_upper = 0, n_lower = 0;
    Index degree_x = 0, degree_y = 0;
    Vec2 low, high;  // the corners of the box
    const Real* peaks = nullptr;
    Real leading_exponent = 0.5, trailing_exponent = 1;
    Real width = 3;

    Index count() const noexcept {
        if (kind == VariableKind::ffd) return (degree_x + 1) * (degree_y + 1);
        return kind == VariableKind::naca4 ? n_upper + 1 : n_upper + n_lower;
    }
    bool needs_chord() const noexcept { return kind != VariableKind::ffd; }
    // Writes the movement by a unit of each variable, along the normal of the chord and in lengths
    // of the chord, at a station from 0 to 1 of a side, to value [count()].
    void shapes(Real station, bool upper, Real* value) const noexcept;
    // Writes the weight of each node of the box at a point to value [count()].
    void node_weights(Vec2 point, Real* value) const noexcept;
    Real peak(Index k) const noexcept;
};

}  // namespace harmorph
