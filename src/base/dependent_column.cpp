#include "base/dependent_column.hpp"

#include "base/vec2.hpp"

namespace harmorph {

// Entries are treated as complex numbers. The component along each earlier column is subtracted
// twice, so that the column is orthogonal to all of them to rounding.
DependentColumn find_dependent_column(Span<Real> matrix, Index n, Index numbers) noexcept {
    // A column is dependent if less than this fraction of its length remains.
    constexpr Real min_remainder = 1e-12;
    Size const row_length = static_cast<Size>(n) * static_cast<Size>(numbers);
    Index const rows = n > 0 ? static_cast<Index>(matrix.size() / row_length) : 0;
    auto const at = [&](Index row, Index column) {
        const Real* const entry = matrix.data() + (Offset{row} * n + column) * numbers;
        return Vec2{entry[0], numbers == 2 ? entry[1] : 0};
    };
    auto const set = [&](Index row, Index column, Vec2 value) {
        Real* const entry = matrix.data() + (Offset{row} * n + column) * numbers;
        entry[0] = value.x;
        if (numbers == 2) entry[1] = value.y;
    };
    // The entries are divided one by one, as the reciprocal of a tiny number may be infinite.
    auto const quotient_of = [](Vec2 v, Real by) { return Vec2{v.x / by, v.y / by}; };
    auto const divide = [&](Index column, Real by) {
        for (Index row = 0; row < rows; ++row) set(row, column, quotient_of(at(row, column), by));
    };
    auto const size_of = [&](Index column) {
        Real largest = 0;
        for (Index row = 0; row < rows; ++row) {
            Vec2 const entry = at(row, column);
            largest = max(largest, max(abs(entry.x), abs(entry.y)));
        }
        if (!(largest > 0)) return 0.0;
        Real sum = 0;
        for (Index row = 0; row < rows; ++row) sum += square(quotient_of(at(row, column), largest));
        return largest * sqrt(sum);
    };
    for (Index column = 0; column < n; ++column) {
        Real const size = size_of(column);
        if (!(size > 0)) return {column, true};
        divide(column, size);
        for (Index pass = 0; pass < 2; ++pass) {
            for (Index before = 0; before < column; ++before) {
                Vec2 component;
                for (Index row = 0; row < rows; ++row) {
                    component = component + product(conjugate(at(row, before)), at(row, column));
                }
                for (Index row = 0; row < rows; ++row) {
                    set(row, column, at(row, column) - product(component, at(row, before)));
                }
            }
            if (pass > 0) continue;
            Real const remainder = size_of(column);
            if (!(remainder > min_remainder)) return {column, false};
        }
        divide(column, size_of(column));
    }
    return {};
}

}  // namespace harmorph
