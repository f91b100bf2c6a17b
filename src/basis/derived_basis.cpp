#include "basis/derived_basis.hpp"

#include <cstring>

#include "base/dependent_column.hpp"

namespace harmorph {

void begin_derived(Basis const& from, BasisCounts const& counts, Basis const& to) noexcept {
    std::memset(static_cast<void*>(to.header), 0, Basis::bytes(counts));
    *to.header = *from.header;
    to.header->counts = counts;
    to.header->bytes = Basis::bytes(counts);
    to.header->filled = counts.stored;
    to.unseal();
    copy(to.shape, Span<const Basis::CurveShape>(from.shape));
    copy(to.indices, Span<const Index>(from.indices));
    copy(to.knots, Span<const Real>(from.knots));
    copy(to.control, Span<const Real>(from.control));
    copy(to.weights, Span<const Real>(from.weights));
    copy(to.conditions, Span<const Condition>(from.conditions));
    to.along.copy_from(from.along);
    copy(to.wall_point, Span<const Index>(from.wall_point));
    copy(to.wall_curve, Span<const Index>(from.wall_curve));
    copy(to.wall_u, Span<const Real>(from.wall_u));
    copy(to.wall_offset, Span<const Vec2>(from.wall_offset));
    copy(to.wall_start, Span<const Vec2>(from.wall_start));
    copy(to.shared_point, Span<const Index>(from.shared_point));
    copy(to.shared_condition, Span<const Index>(from.shared_condition));
    copy(to.shared_place, Span<const WallPlace>(from.shared_place));
    copy(to.shared_slot, Span<const Index>(from.shared_slot));
    copy(to.joined_point, Span<const Index>(from.joined_point));
    copy(to.joined_slot, Span<const Index>(from.joined_slot));
    copy(to.boundary_point, Span<const Index>(from.boundary_point));
    copy(to.loop_start, Span<const Index>(from.loop_start));
    copy(to.interface_side, Span<const Index>(from.interface_side));
    copy(to.reversed, Span<const std::uint8_t>(from.reversed));
    if (to.pieces.given()) to.pieces.copy_from(from.pieces);
}

BasisCounts combined_counts(Basis const& from, Index n, Index numbers) noexcept {
    BasisCounts counts = from.header->counts;
    bool const was_complex = counts.combination == 2;
    counts.combination = numbers == 2 || was_complex ? 2 : 1;
    counts.combined = n;
    if (numbers == 2 && counts.kind == ValueKind::real) counts.kind = ValueKind::complex;
    return counts.share(0, counts.functions());
}

namespace {

// Fills to.combination with the caller's matrix, or with the matrix of `from` times the caller's
// matrix if the functions of `from` are combined already.
void set_combination(Basis const& from, Index n, Index numbers, const Real* matrix,
                     Basis const& to) noexcept {
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

// Adds the products for one number of a block of points.
void add_product(Real factor, const Real* from, Real* to) noexcept {
    for (Index k = 0; k < block_points; ++k) to[k] += factor * from[k];
}

}  // namespace

Status combine(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to,
               Fault& fault) noexcept {
    BasisCounts const counts = combined_counts(from, n, numbers);
    begin_derived(from, counts, to);

    // A square or wide matrix fits into the place of the result, which has as many rows or more.
    Index const shapes = from.header->counts.shapes();
    Span<Real> const trial = to.combination.first(Offset{shapes} * n * numbers);
    copy(trial, Span<const Real>(matrix, trial.size()));
    DependentColumn const dependent = find_dependent_column(trial, n, numbers);
    if (dependent.column != none) {
        const char* const text =
            dependent.is_zero
                ? "column # of the matrix is zero: the design variable moves no control point"
                : "column # of the matrix is a linear combination of the columns before it";
        return fault.refuse(Status::bad_condition, text, variable_item(dependent.column));
    }
    set_combination(from, n, numbers, matrix, to);

    // The functions are combined block by block of points: the numbers of a value times an entry of
    // the matrix are those of a product of linear maps.
    Index const old_length = from.n_functions(), length = to.n_functions(), others = length - n;
    bool const matrices = to.kind() == ValueKind::matrix;
    for (Index point = 0; point < to.n_points(); point += block_points) {
        auto const old_row = from.row(point);
        auto const row = to.row(point);
        for (Index plane = 0; plane < numbers_of(from.kind()); ++plane) {
            for (Index i = 0; i < shapes; ++i) {
                const Real* const f = &old_row[Offset{plane} * old_length + i];
                const Real* const entries = matrix + Offset{i} * n * numbers;
                for (Index j = 0; j < n; ++j)
                    add_product(entries[numbers * j], f, &row[Offset{plane} * length + j]);
                if (numbers == 1) continue;
                // In (a + i b)(x + i y) the imaginary part goes to the plane of the partner. For
                // matrices, the partners are xx with xy and yx with yy: [xx xy] [x -y; y x].
                bool const is_second = plane % 2 == 1;
                Index const partner = is_second ? plane - 1 : plane + 1;
                Real const sign = matrices != is_second ? -1 : 1;
                for (Index j = 0; j < n; ++j) {
                    add_product(sign * entries[2 * j + 1], f, &row[Offset{partner} * length + j]);
                }
            }
            for (Index k = 0; k < others; ++k) {
                add_product(1, &old_row[Offset{plane} * old_length + shapes + k],
                            &row[Offset{plane} * length + n + k]);
            }
        }
    }
    to.seal();
    return Status::ok;
}

namespace {

constexpr Real largest_float = 0x1.fffffep+127;

// Copies the data between header and values, which are the same in both.
void copy_problem(Basis const& from, Basis const& to) noexcept {
    const auto* const begin = reinterpret_cast<const unsigned char*>(from.shape.data());
    const auto* const end = reinterpret_cast<const unsigned char*>(from.value.data());
    std::memcpy(to.shape.data(), begin, static_cast<Size>(end - begin));
}

}  // namespace

BasisCounts single_counts(Basis const& from) noexcept {
    BasisCounts counts = from.header->counts;
    counts.storage = Precision::in_single;
    return counts;
}

Status store_single(Basis const& from, Basis const& to, Fault& fault) noexcept {
    // This is the largest value of the whole basis even if `from` is a share of it, so it is kept.
    Real const largest = from.header->largest;
    if (!(largest <= largest_float)) {
        return fault.refuse(
            Status::unsupported,
            "a value of the functions, ~, is too large for single precision, which ends at 3.4e38",
            {}, {}, largest);
    }
    BasisCounts const counts = single_counts(from);
    std::memset(static_cast<void*>(to.header), 0, Basis::bytes(counts));
    *to.header = *from.header;
    to.header->counts = counts;
    to.header->bytes = Basis::bytes(counts);
    copy_problem(from, to);
    Index const length = from.row_length();
    for (Size k = 0; k < from.value.size(); ++k) to.single[k] = static_cast<float>(from.value[k]);
    auto const clear = [&](Index point) {
        auto const row = to.single_row(point);
        for (Index k = 0; k < length; ++k) row[k] = 0;
    };
    for (Index slot = 0; slot < from.wall_point.count(); ++slot) {
        copy_row(to.row(slot), from.row(from.wall_point[slot]), length);
        clear(from.wall_point[slot]);
    }
    for (Index const point : from.joined_point) clear(point);
    to.seal(max(largest, static_cast<Real>(static_cast<float>(largest))));
    return Status::ok;
}

}  // namespace harmorph
