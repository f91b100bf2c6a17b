// Design variables that are not control points: the movement of the outline by each, and its
// approximation by movements of the control points.
#pragma once

#include "base/arena.hpp"
#include "bspline/envelope_cholesky.hpp"
#include "bspline/section.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them.
enum class VariableKind : std::int32_t { ffd = 0, cst = 1, hicks_henne = 2, naca4 = 3 };

struct Variables {
    static constexpr Index most = 64;  // of one side, and nodes in one direction

    VariableKind kind = VariableKind::ffd;
    Index n_upper = 0, n_lower = 0;
    Index degree_x = 0, degree_y = 0;
    Vec2 low, high;  // the box
    const Real* peaks = nullptr;
    Real leading_exponent = 0.5, trailing_exponent = 1;
    Real width = 3;

    Index count() const noexcept {
        if (kind == VariableKind::ffd) return (degree_x + 1) * (degree_y + 1);
        return kind == VariableKind::naca4 ? n_upper + 1 : n_upper + n_lower;
    }
    bool needs_chord() const noexcept { return kind != VariableKind::ffd; }
    // Along the normal of the chord, in chords, at a station 0 .. 1 of a side: value [count()].
    void shapes(Real station, bool upper, Real* value) const noexcept;
    // Of the nodes at a point: value [count()].
    void node_weights(Vec2 point, Real* value) const noexcept;
    Real peak(Index k) const noexcept;
};

// Least squares for the map d(control) / d(variable).
struct VariableMap {
    EnvelopeMatrix mass;  // of the curves' basis functions, then its Cholesky factor
    Span<Real> wanted;    // [n_control * n * 2] right-hand sides, then the map
    Span<Real> trial;     // [n_control * n * 2] the map again, orthogonalised
    Span<Real> value;     // [n] of the variables at one point
    Span<Real> error;     // [2 * n] out: root mean square and largest difference
    Span<Real> pins;      // [n_control] how many ends of curves fix a control point

    void lay_out(Arena& arena, Index n_control, Index n) noexcept;
    // The section is joined, and has its chord where variables need it. Refuses variables without
    // effect.
    Status run(Section const& section, Variables const& variables, Fault& fault) noexcept;

private:
    template <class Body>
    void for_each_sample(Section const& section, Variables const& variables,
                         Body const& body) const noexcept;
    void pin_ends(Section const& section, Variables const& variables) noexcept;
    bool is_upper(Section const& section, CurvePlace const& place) const noexcept;
    Vec2 evaluate(Section const& section, Variables const& variables, Vec2 point,
                  bool upper) const noexcept;
    void find_edge(Section const& section) noexcept;
    void add_samples(Section const& section, Variables const& variables) noexcept;
    void eliminate_pins() noexcept;
    Status check_independence(Fault& fault) noexcept;
    void measure_errors(Section const& section, Variables const& variables) noexcept;

    Index n_control_ = 0, n_ = 0;
    Real edge_position_ = 0,
         edge_u_ = 0;  // the trailing edge on a periodic curve: part of its range, parameter
};

}  // namespace harmorph
