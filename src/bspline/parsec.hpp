// Sections by eleven parameters: H. Sobieczky, Parametric Airfoils and Wings, Notes on Numerical
// Fluid Mechanics 68 (1998) 71. tests/bspline/test_movements.cpp covers this file.
#pragma once

#include "bspline/variables.hpp"

namespace harmorph {

// The heights of both sides, z(t) = sum over n = 1 .. 6 of a_n t^(n - 1/2), t and z in chords.
struct ParsecSection {
    static constexpr Index n_parameters = 11, n_powers = 6;

    // The parameters in the order of the C header.
    Real parameter[n_parameters] = {};
    Real a[2][n_powers] = {};                 // the upper side, the lower side
    Real by[2][n_parameters][n_powers] = {};  // the derivatives of `a` by each parameter

    // Computes the coefficients. Returns none, or the first parameter that is out of its range.
    Index solve() noexcept;

private:
    Index solve_side(Index side) noexcept;
};

// The movement of an outline from its own parameters to changed ones.
class ParsecChange {
public:
    static constexpr Index count = ParsecSection::n_parameters;

    // Measures the parameters of a section, whose chord has been found.
    Status measure(Section const& section, Fault& fault) noexcept;
    Real start(Index j) const noexcept { return before_.parameter[j]; }
    // Changes the parameters. Returns none, or the first value that is out of its range.
    Index set(const Real* values) noexcept;
    // Returns the movement by the values of set(), and the derivatives by each value.
    OutlineMovements movements() const noexcept;

private:
    const Section* section_ = nullptr;
    ParsecSection before_, now_;
};

}  // namespace harmorph
