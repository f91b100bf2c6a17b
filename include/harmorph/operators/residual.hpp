// What the solved functions leave of their equations: the measure of every engine, and the food of refinement.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "harmorph/operators/matrix.hpp"
#include "harmorph/basis/options.hpp"
#include "harmorph/simd/cpu.hpp"
#include "harmorph/base/row_view.hpp"

namespace harmorph {

// The values of a basis as the equations see them: a line of numbers for each unknown, a column for each right-hand side.
// Lines are the rows of values, or their halves where a point has two unknowns. Complex ones hold the columns' real parts,
// then their imaginary parts.
struct Lines {
    Basis const& basis;
    Span<const Index> of;  // [n] line of each position
    Index components;      // lines of a point

    Index length() const noexcept { return basis.row_length() / components; }
    Real* line(Index number) const noexcept { return basis.value.data() + Offset{number} * length(); }
    Real* at(Index position) const noexcept { return line(of[position]); }
    Index columns(Matrix const& matrix) const noexcept { return matrix.is_complex() ? basis.n_functions() : length(); }
    // The unknowns' lines, as engines see them.
    Rows rows(Matrix const& matrix) const noexcept {
        return {basis.value.data(), of.data(), length(), columns(matrix), columns(matrix)};
    }
    // Of a line of the wall: its slot's point.
    Real* wall(Index number) const noexcept {
        return line(components * basis.wall_point[number / components] + number % components);
    }
};

// Residuals of a few columns at a time, in whole rows. They are sums of differences of values along couplings, so that
// what couplings of thin cells put on the diagonal does not drown what the weak ones do (symmetric_matrix.hpp); of two
// lines a point differences of displacements. Points that slip have their second line empty: it is filled last.
// A row is summed at once: it finds its earlier entries in lists, where each row waits for the next that it is coupled to.
struct Residual {
    static constexpr Index widest = 24;

    Index width = 6;   // at most `widest`
    Kernel kernel = Kernel::baseline;  // any gives the same bits
    // [n x planes x width] rows by position: b - A F, real and then imaginary parts; of these one, as the engine solves.
    Span<Real> value;
    Span<float> single;  // differences are rounded to single precision last, so that corrections are none the worse
    Span<Index> latest;  // [n] not where x and y are coupled: the row that began to wait last, and
    Span<Index> next;    // [n + lines of the wall] for each the one before it

    void lay_out(Arena& arena, Index unknowns, Index walls, MatrixKind kind, Index its_width = 6,
                 Precision precision = Precision::in_double) noexcept;
    // Columns first .. first+n-1, n <= width; squared 2-norms of b and of b - A F.
    struct Norms {
        Real right_hand_side[widest] = {}, rest[widest] = {};
        // |b - A F| / |b|; the numerator alone where b is 0.
        Real relative(Index k) const noexcept;
    };
    Norms compute(Matrix const& matrix, Lines const& lines, Index first, Index n) const noexcept;
    // The norms alone, n <= widest; not where x and y are coupled.
    Norms measure(Matrix const& matrix, Lines const& lines, Index first, Index n) const noexcept;
    // Of one column, in all rows: the largest number of b - A F beside the row's entries times the largest of F. Rounding of F
    // alone leaves an epsilon of that. 2 <= width. Infinite where a number is none.
    Real beside_entries(Matrix const& matrix, Lines const& lines, Index column) const noexcept;
    struct Choice {
        bool column[widest];
    };
    // The chosen ones of columns first .. first+n-1 of F += those of value, as corrections. Returns the largest of
    // those beside the largest number that F has become.
    struct Changes {
        Real column[widest];
    };
    Changes add_to(Matrix const& matrix, Lines const& lines, Index first, Index n, Choice const& chosen) const noexcept;
};

}  // namespace harmorph
