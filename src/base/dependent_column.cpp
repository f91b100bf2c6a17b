#include "base/dependent_column.hpp"

#include "base/vec2.hpp"

namespace harmorph {
namespace {

// The columns of a matrix whose entries are treated as complex numbers.
struct Columns {
    Span<Real> matrix;
    Index n, numbers, rows;

    Vec2 at(Index row, Index column) const noexcept {
        const Real* const entry = matrix.data() + (Offset{row} * n + column) * numbers;
        return Vec2{entry[0], numbers == 2 ? entry[1] : 0};
    }
    void set(Index row, Index column, Vec2 value) const noexcept {
        Real* const entry = matrix.data() + (Offset{row} * n + column) * numbers;
        entry[0] = value.x;
        if (numbers == 2) entry[1] = value.y;
    }
    // The entries are divided one by one, as the reciprocal of a tiny number may be infinite.
    static Vec2 quotient_of(Vec2 v, Real by) noexcept { return Vec2{v.x / by, v.y / by}; }
    void divide(Index column, Real by) const noexcept {
        for (Index row = 0; row < rows; ++row) set(row, column, quotient_of(at(row, column), by));
    }
    Real size(Index column) const noexcept {
        Real largest = 0;
        for (Index row = 0; row < rows; ++row) {
            Vec2 const entry = at(row, column);
            largest = max(largest, max(abs(entry.x), abs(entry.y)));
        }
        if (!(largest > 0)) return 0.0;
        Real sum = 0;
        for (Index row = 0; row < rows; ++row) sum += square(quotient_of(at(row, column), largest));
        return largest * sqrt(sum);
    }
    // Subtracts the component along another column, which has length 1.
    void subtract_component(Index column, Index along) const noexcept {
        Vec2 component;
        for (Index row = 0; row < rows; ++row) {
            component = component + product(conjugate(at(row, along)), at(row, column));
        }
        for (Index row = 0; row < rows; ++row) {
            set(row, column, at(row, column) - product(component, at(row, along)));
        }
    }
};

}  // namespace

// The component along each earlier column is subtracted twice, so that the column is orthogonal to
// all of them to rounding.
DependentColumn find_dependent_column(Span<Real> matrix, Index n, Index numbers) noexcept {
    // A column is dependent if less than this fraction of its length remains.
    constexpr Real min_remainder = 1e-12;
    Size const row_length = static_cast<Size>(n) * static_cast<Size>(numbers);
    Index const rows = n > 0 ? static_cast<Index>(matrix.size() / row_length) : 0;
    Columns const columns{matrix, n, numbers, rows};
    for (Index column = 0; column < n; ++column) {
        Real const size = columns.size(column);
        if (!(size > 0)) return {column, true};
        columns.divide(column, size);
        for (Index pass = 0; pass < 2; ++pass) {
            for (Index before = 0; before < column; ++before)
                columns.subtract_component(column, before);
            if (pass == 0 && !(columns.size(column) > min_remainder)) return {column, false};
        }
        columns.divide(column, columns.size(column));
    }
    return {};
}

}  // namespace harmorph
