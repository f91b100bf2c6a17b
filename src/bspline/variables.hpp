// Computes the movement of the outline by each of several design variables that are not control
// points. tests/bspline/test_variables.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"
#include "bspline/envelope_cholesky.hpp"
#include "bspline/section.hpp"

namespace harmorph {

// The C header has the same numbers, and explains the variables.
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

// Approximates movements of the outline by movements of the control points.

// Several wanted movements of the outline, as functions of the place. write() computes all of them
// as pairs [2 * count] for a point of the outline on the upper or the lower side.
struct OutlineMovements {
    Index count = 0;
    bool needs_chord = false;  // without a chord, there are no sides, and `upper` is false
    const void* context = nullptr;
    void (*write)(const void* context, Vec2 point, bool upper, Real* pairs) = nullptr;
};

// Returns the movements by a unit of each variable. Both arguments must outlive the result.
struct VariablesOfSection {
    Section const& section;
    Variables const& variables;

    OutlineMovements movements() const noexcept;
};

// Computes the control points' movements by least squares.
struct VariableMap {
    // The mass matrix of the basis functions of the curves, then the Cholesky factor of the matrix.
    EnvelopeMatrix mass;
    Span<Real> wanted;    // [n_control * n * 2] right-hand sides, then the map
    Span<Real> trial;     // [n_control * n * 2] a copy of the map, which is orthogonalised
    Span<Real> at_point;  // [2 * n] the wanted movements of one point
    Span<Real> error;     // [2 * n] output: root mean square and largest difference
    Span<Real> pins;      // [n_control] the number of curve ends that are this control point

    void lay_out(Arena& arena, Index n_control, Index n) noexcept;
    // The section must be connected, and must have a chord if the movements need one.
    Status run(Section const& section, OutlineMovements const& movements, Fault& fault) noexcept;
    // Refuses movements that are zero or combinations of those before.
    Status check_independence(Fault& fault) noexcept;

private:
    template <class Body>
    void for_each_sample(Section const& section, OutlineMovements const& movements,
                         Body const& body) const noexcept;
    void pin_ends(Section const& section, OutlineMovements const& movements) noexcept;
    bool is_upper(Section const& section, CurvePlace const& place) const noexcept;
    void evaluate(Section const& section, OutlineMovements const& movements,
                  CurvePlace const& place) const noexcept;
    void find_trailing_edge(Section const& section) noexcept;
    void add_samples(Section const& section, OutlineMovements const& movements) noexcept;
    void eliminate_pins() noexcept;
    void measure_errors(Section const& section, OutlineMovements const& movements) noexcept;

    Index n_control_ = 0, n_ = 0;
    // The trailing edge of a periodic curve, as a fraction of its range and as a parameter.
    Real trailing_edge_position_ = 0, trailing_edge_u_ = 0;
};

}  // namespace harmorph
