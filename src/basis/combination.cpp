#include "harmorph/basis/combination.hpp"

#include <cstring>

#include "harmorph/base/dependent_column.hpp"

namespace harmorph {

BasisCounts combined_counts(Basis const& from, Index n, Index numbers) noexcept {
    BasisCounts counts = from.header->counts;
    bool const was_complex = counts.combination == 2;
    counts.combination = numbers == 2 || was_complex ? 2 : 1;
    counts.combined = n;
    if (numbers == 2 && counts.kind == ValueKind::real) counts.kind = ValueKind::complex;
    return counts.share(0, counts.functions());
}

namespace {

// Everything that lies between header and combination, and what lies behind it up to the values, is the same.
void copy_problem(Basis const& from, Basis const& to) noexcept {
    copy(to.shape, Span<const Basis::CurveShape>(from.shape));
    copy(to.indices, Span<const Index>(from.indices));
    copy(to.knots, Span<const Real>(from.knots));
    copy(to.control, Span<const Real>(from.control));
    copy(to.weights, Span<const Real>(from.weights));
    copy(to.conditions, Span<const Condition>(from.conditions));
    copy(to.wall_point, Span<const Index>(from.wall_point));
    copy(to.wall_curve, Span<const Index>(from.wall_curve));
    copy(to.wall_u, Span<const Real>(from.wall_u));
    copy(to.wall_offset, Span<const Vec2>(from.wall_offset));
    copy(to.joined_point, Span<const Index>(from.joined_point));
    copy(to.joined_slot, Span<const Index>(from.joined_slot));
    copy(to.boundary_point, Span<const Index>(from.boundary_point));
    copy(to.loop_start, Span<const Index>(from.loop_start));
    copy(to.reversed, Span<const std::uint8_t>(from.reversed));
}

// to [rows * n]: the caller's matrix, or where `from` is itself combined, its matrix times the caller's.
void set_combination(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to) noexcept {
    Index const kept = to.header->counts.combination;
    auto const entry_of = [&](Index row, Index column) {
        const Real* const at = matrix + (Offset{row} * n + column) * numbers;
        return Vec2{at[0], numbers == 2 ? at[1] : 0};
    };
    for (Index row = 0; row < from.header->counts.control; ++row) {
        for (Index column = 0; column < n; ++column) {
            Vec2 sum;
            if (from.header->counts.combination == 0) {
                sum = entry_of(row, column);
            } else {
                for (Index k = 0; k < from.header->counts.combined; ++k) {
                    sum = sum + product(from.combination_at(row, k), entry_of(k, column));
                }
            }
            Real* const at = to.combination.data() + (Offset{row} * n + column) * kept;
            at[0] = sum.x;
            if (kept == 2) at[1] = sum.y;
        }
    }
}

}  // namespace

Status combine(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to, Fault& fault) noexcept {
    BasisCounts const counts = combined_counts(from, n, numbers);
    std::memset(static_cast<void*>(to.header), 0, Basis::bytes(counts));
    *to.header = *from.header;
    to.header->counts = counts;
    to.header->bytes = Basis::bytes(counts);
    to.header->filled = counts.stored;
    to.unseal();
    copy_problem(from, to);

    // A square or flat matrix fits into the place of what it becomes: as many rows there, or more.
    Index const shapes = from.header->counts.shapes();
    Span<Real> const trial = to.combination.first(Offset{shapes} * n * numbers);
    copy(trial, Span<const Real>(matrix, trial.size()));
    DependentColumn const dependent = find_dependent_column(trial, n, numbers);
    if (dependent.column != none) {
        return fault.refuse(Status::bad_condition,
                            dependent.is_zero ? "column # (from 0) of the matrix is zero"
                                              : "column # (from 0) of the matrix is a combination of those before",
                            Counts::from_zero, dependent.column);
    }
    set_combination(from, n, numbers, matrix, to);

    // Row by row: numbers of a complex value times an entry are those of a product of linear maps.
    Index const old_planes = numbers_of(from.kind()), planes = numbers_of(to.kind());
    Index const old_length = from.n_functions(), length = to.n_functions(), others = length - n;
    for (Index point = 0; point < to.n_points(); ++point) {
        const Real* const old_row = from.row(point);
        Real* const row = to.row(point);
        for (Index plane = 0; plane < old_planes; ++plane) {
            const Real* const f = old_row + plane * old_length;
            Real* const g = row + plane * length;
            for (Index i = 0; i < shapes; ++i) {
                if (f[i] == 0) continue;
                const Real* const entries = matrix + Offset{i} * n * numbers;
                if (numbers == 1) {
                    for (Index j = 0; j < n; ++j) g[j] += f[i] * entries[j];
                    continue;
                }
                // (a + i b)(x + i y): the real part stays in the plane of f; the imaginary part goes to its partner. Of
                // matrices, xx with xy and yx with yy: [xx xy] [x -y; y x].
                bool const second = plane % 2 == 1;
                Real* const partner = row + (second ? plane - 1 : plane + 1) * length;
                bool const matrices = to.kind() == ValueKind::matrix;
                Real const sign = matrices != second ? -1 : 1;
                for (Index j = 0; j < n; ++j) {
                    g[j] += f[i] * entries[2 * j];
                    partner[j] += sign * f[i] * entries[2 * j + 1];
                }
            }
            for (Index k = 0; k < others; ++k) g[n + k] = f[shapes + k];
        }
        static_cast<void>(planes);
    }
    to.seal();
    return Status::ok;
}

}  // namespace harmorph
