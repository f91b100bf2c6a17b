// Approximates the movement of the outline by each design variable by movements of the control
// points. tests/bspline/test_variables.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "bspline/envelope_cholesky.hpp"
#include "bspline/section.hpp"
#include "bspline/variables.hpp"

namespace harmorph {

// Computes the map d(control point) / d(variable) by least squares.
struct VariableMap {
    EnvelopeMatrix
        mass;           // the mass matrix of the curves' basis functions, then its Cholesky factor
    Span<Real> wanted;  // [n_control * n * 2] right-hand sides, then the map
    Span<Real> trial;   // [n_control * n * 2] a copy of the map, which is orthogonalised
    Span<Real> value;   // [n] the values of the variables at one point
    Span<Real> error;   // [2 * n] output: root mean square and largest difference
    Span<Real> pins;    // [n_control] the number of curve ends that are this control point

    void lay_out(Arena& arena, Index n_control, Index n) noexcept;
    // The section must be connected, and must have a chord if the variables need one. Refuses
    // variables without effect.
    Status run(Section const& section, Variables const& variables, Fault& fault) noexcept;

private:
    template <class Body>
    void for_each_sample(Section const& section, Variables const& variables,
                         Body const& body) const noexcept;
    void pin_ends(Section const& section, Variables const& variables) noexcept;
    bool is_upper(Section const& section, CurvePlace const& place) const noexcept;
    Vec2 evaluate(Section const& section, Variables const& variables, Vec2 point,
                  bool upper) const noexcept;
    void find_trailing_edge(Section const& section) noexcept;
    void add_samples(Section const& section, Variables const& variables) noexcept;
    void eliminate_pins() noexcept;
    Status check_independence(Fault& fault) noexcept;
    void measure_errors(Section const& section, Variables const& variables) noexcept;

    Index n_control_ = 0, n_ = 0;
    // The trailing edge of a periodic curve, as a fraction of its range and as a parameter.
    Real trailing_edge_position_ = 0, trailing_edge_u_ = 0;
};

}  // namespace harmorph
