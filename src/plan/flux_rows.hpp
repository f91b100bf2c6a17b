// The right-hand sides that given normal derivatives on free faces make: half of the flux through a
// face goes to the equation of each of its two points. tests/plan/test_fluxes.cpp covers this file.
#pragma once

#include "operators/residual.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// The rows exist only for the points of faces with fluxes. Without fluxes all members are empty.
struct FluxRows {
    Span<Index> end;   // [2 * fluxes] The representatives of the two points of each face.
    Span<Real> value;  // [fluxes * n_control] See Fluxes::value.
    Index n_control = 0;
    Span<Real> half_length;  // [fluxes] Half the length of each face at the factor's coordinates.
    Span<Index> row_of;      // [n] The row of each position of the unknowns, or none.
    Span<Real> row;          // The rows, each with the numbers of a dof.

    // The analysis has run. max_numbers is the largest number of numbers of a dof.
    void lay_out(Arena& arena, Analysis const& analysis, Index max_numbers) noexcept;
    void init(Analysis const& analysis) noexcept;
    bool any() const noexcept { return !end.empty(); }
    // Measures the faces.
    void measure(Points points) const noexcept;
    // Makes the rows the source of these functions, and adds them to the right-hand sides, which
    // the unknowns have as values, unless the values are a first approximation.
    void add_to(Matrix const& matrix, DofValues& dofs) const noexcept;

private:
    void find_rows(Matrix const& matrix) const noexcept;
    void add_face(Matrix const& matrix, DofValues const& dofs, Index flux,
                  Index point) const noexcept;
};

}  // namespace harmorph
