#include "morph/mode_functions.hpp"

#include "basis/derived_basis.hpp"

namespace harmorph {
namespace {

constexpr Vec2 turned_by_90(Vec2 v) noexcept { return {-v.y, v.x}; }

}  // namespace

Status Modes::check(Index n_points, Fault& fault) const noexcept {
    for (Index mode = 0; mode < n; ++mode) {
        bool is_zero = true;
        for (Index k = 0; k < n_points; ++k) {
            Vec2 const here = at(mode, k, n_points);
            if (!is_finite(here.x) || !is_finite(here.y)) {
                return fault.refuse(Status::bad_argument,
                                    "mode # is not finite at point @ of the list", field_item(mode),
                                    entry_item(k));
            }
            is_zero = is_zero && here.x == 0 && here.y == 0;
        }
        if (is_zero)
            return fault.refuse(Status::bad_condition,
                                "mode # is zero: it moves no point of the list", field_item(mode));
    }
    return Status::ok;
}

BasisCounts tabulated_counts(Basis const& from, Index n, Index numbers) noexcept {
    BasisCounts counts = from.header->counts;
    counts.modes += n;
    if (numbers == 2 && counts.kind == ValueKind::real) counts.kind = ValueKind::complex;
    return counts.share(0, counts.functions());
}

// Solves with mode j as the displacement of the wall for the amplitude (1, 0); matrices need also
// (0, 1).
Status tabulate(Plan& plan, Basis const& from, PointList const& list, Modes const& modes,
                ModeWork const& work, Basis const& to, SolveReport& report, Fault& fault) noexcept {
    Displacement const& displacement = work.displacement;
    bool const matrices = from.kind() == ValueKind::matrix;
    displacement.clear(plan);
    Span<Vec2> const wall = work.wall;
    for (Index field = 0; field < displacement.n_fields; ++field) {
        Index const mode = matrices ? field / 2 : field;
        for (Index k = 0; k < list.count(); ++k) {
            Vec2 const value = modes.at(mode, k, list.count());
            wall[k] = matrices && field % 2 == 1 ? turned_by_90(value) : value;
        }
        HARMORPH_TRY(displacement.set(plan, list, field, {&wall[0].x, &wall[0].y, 2}, fault));
    }
    HARMORPH_TRY(displacement.solve(plan, true, report, fault));

    BasisCounts const counts = tabulated_counts(from, modes.n, modes.numbers);
    begin_derived(from, counts, to);
    copy(to.combination, Span<const Real>(from.combination));
    Index const old_length = from.n_functions(), length = to.n_functions();
    for (Index point = 0; point < to.n_points(); ++point) {
        auto const old_row = from.row(point);
        auto const row = to.row(point);
        for (Index plane = 0; plane < numbers_of(from.kind()); ++plane) {
            for (Index i = 0; i < old_length; ++i)
                row[plane * length + i] = old_row[plane * old_length + i];
        }
        for (Index mode = 0; mode < modes.n; ++mode) {
            Index const at = old_length + mode;
            Vec2 const moved = displacement.at(plan, matrices ? 2 * mode : mode, point);
            if (matrices) {
                Vec2 const for_y = displacement.at(plan, 2 * mode + 1, point);
                row[at] = moved.x;
                row[length + at] = for_y.x;
                row[2 * length + at] = moved.y;
                row[3 * length + at] = for_y.y;
            } else {
                row[at] = moved.x;
                if (to.kind() == ValueKind::complex) row[length + at] = moved.y;
            }
        }
    }
    to.header->coordinates = plan.coordinates();
    to.seal();
    return fault.status;
}

}  // namespace harmorph
