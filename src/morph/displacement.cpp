#include "morph/displacement.hpp"

#include "base/executor.hpp"
#include "base/vec2.hpp"
#include "basis/derived_basis.hpp"
#include "morph/crossing.hpp"

namespace harmorph {
namespace {

constexpr Index task_points = 4096;

// The first derivative that is not finite.
struct NotFinite {
    Index point = none, field = 0;
    void merge(NotFinite const& later) noexcept { *this = point != none ? *this : later; }
};

// Where nothing moves, no bit changes; -0 + 0 would not be -0.
Vec2 moved(Vec2 at, Vec2 by) noexcept {
    return {by.x == 0 ? at.x : at.x + by.x, by.y == 0 ? at.y : at.y + by.y};
}

bool equal(Vec2 a, Vec2 b) noexcept { return a.x == b.x && a.y == b.y; }

}  // namespace

void Displacement::lay_out(Arena& arena, Plan const& plan, Index fields) noexcept {
    n_fields = fields;
    Offset const row = 2 * Offset{plan.mesh().n_points};
    arena.take(place, plan.given().point.count());
    arena.take(value, row * n_fields);
    arena.take(source, row * min(n_fields, GivenWall::fields_at_once));
}

Displacement::Block Displacement::block_of(Plan const& plan, Index field) const noexcept {
    Index const first = field / GivenWall::fields_at_once * GivenWall::fields_at_once;
    Index const n = min(n_fields - first, GivenWall::fields_at_once);
    Offset const row = 2 * Offset{plan.mesh().n_points};
    return {first, n, value.from(row * first, row * n)};
}

template <class Body>
Status Displacement::for_each_block(Plan const& plan, Fault& fault,
                                    Body const& body) const noexcept {
    if (!plan.is_factored())
        return fault.refuse(Status::bad_argument,
                            "the plan has no factor; call hm_plan_factor first");
    for (Index first = 0; first < n_fields; first += GivenWall::fields_at_once) {
        HARMORPH_TRY(body(block_of(plan, first)));
    }
    return fault.status;
}

DofValues Displacement::dofs(Plan const& plan, Block const& block) noexcept {
    return plan.fields(block.rows, block.first, block.n);
}

Status Displacement::find_places(Plan const& plan, PointList const& list, Fault& fault) noexcept {
    fill(place, none);
    Span<const Index> const given = plan.given().point;
    for (Index k = 0; k < list.count(); ++k) {
        Index const number = plan.given_index(list[k]);
        if (number == none) {
            return fault.refuse(Status::bad_condition,
                                "point # is in the list, but on no marker with given displacements",
                                point_item(list[k]));
        }
        Index& first = place[number];
        if (first == none) first = k;
    }
    for (Index i = 0; i < given.count(); ++i) {
        if (place[i] != none) continue;
        return fault.refuse(Status::bad_condition,
                            "point # is on a marker with given displacements, but not in the list",
                            point_item(given[i]));
    }
    return Status::ok;
}

void Displacement::clear(Plan const& plan) const noexcept {
    plan.executor().for_ranges(plan.mesh().n_points, task_points, [&](Index begin, Index end) {
        for (Index field = 0; field < n_fields; field += GivenWall::fields_at_once) {
            Block const block = block_of(plan, field);
            fill(Span<Real>(block.row(begin),
                            static_cast<Size>(Offset{end - begin} * block.length())),
                 0.0);
        }
    });
}

Status Displacement::set(Plan const& plan, PointList const& list, Index field, Points wall,
                         Fault& fault) const noexcept {
    MutablePoints const to = block_of(plan, field).field(field);
    for (Index k = 0; k < list.count(); ++k) {
        Index const number = plan.given_index(list[k]), first = place[number];
        if (!is_coordinate(wall[k])) {
            bool const finite = is_finite(wall[k].x) && is_finite(wall[k].y);
            return fault.refuse(
                Status::bad_argument,
                finite ? "the displacement of point # in field @ exceeds 1e100 in magnitude"
                       : "the displacement of point # in field @ is not finite",
                point_item(list[k]), field_item(field));
        }
        if (!equal(wall[k], wall[first])) {
            return fault.refuse(Status::bad_argument,
                                "point # has two different displacements in field @",
                                point_item(list[k]), field_item(field));
        }
        to.set(plan.given().point[number], wall[k]);
    }
    return Status::ok;
}

Status Displacement::solve(Plan& plan, bool measured, SolveReport& report,
                           Fault& fault) const noexcept {
    report.functions = n_fields;
    return for_each_block(plan, fault, [&](Block const& block) {
        DofValues const values = dofs(plan, block);
        subtract_couplings(plan.equations().matrix(), values);
        SolveReport block_report;
        HARMORPH_TRY(plan.solve_fields(values, measured, block_report, fault));
        report.merge(block_report);
        plan.to_displacements(values);
        return Status::ok;
    });
}

Status Displacement::check_target(Plan const& plan, Index field, Points from,
                                  Fault& fault) const noexcept {
    GivenWall const& given = plan.given();
    Points const displacement = block_of(plan, field).field(field);
    for (Index const point : given.boundary_point) {
        if (is_coordinate(from[point] + displacement[point])) continue;
        return fault.refuse(Status::bad_argument,
                            "a target coordinate of point # in field @ exceeds 1e100 in magnitude",
                            point_item(point), field_item(field));
    }
    Crossing const crossing = find_crossing(given.faces(), from, displacement);
    if (!crossing.found) return Status::ok;
    return fault.refuse(
        Status::crossing,
        "the moved boundary crosses itself: the faces that begin at points # and @ intersect",
        point_item(crossing.first[0]), point_item(crossing.second[0]));
}

void Displacement::write(Plan const& plan, Index first, Points from,
                         Span<const MutablePoints> to) const noexcept {
    Block const block = block_of(plan, first);
    plan.executor().for_ranges(plan.mesh().n_points, task_points, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            const Real* const row = block.row(k) + (first - block.first);
            for (Index i = 0; i < to.count(); ++i) {
                Vec2 const by{row[i], row[block.n + i]};
                to[i].set(k, from.given() ? moved(from[k], by) : by);
            }
        }
    });
}

Status Displacement::set_derivatives(Plan const& plan, Index first, Span<const Points> derivatives,
                                     Fault& fault) const noexcept {
    Block const block = block_of(plan, first);
    auto const range = [&](Index begin, Index end, NotFinite& found) {
        for (Index k = begin; k < end; ++k) {
            Real* const row = block.row(k) + (first - block.first);
            for (Index i = 0; i < derivatives.count(); ++i) {
                Vec2 const by = derivatives[i][k];
                row[i] = by.x;
                row[block.n + i] = by.y;
                if (found.point == none && !(is_finite(by.x) && is_finite(by.y)))
                    found = {k, first + i};
            }
        }
    };
    NotFinite const bad = reduce_ranges<NotFinite>(plan.mesh().n_points, plan.executor(), range);
    if (bad.point != none) {
        return fault.refuse(Status::bad_argument,
                            "the derivative by the coordinates of point # in field @ is not finite",
                            point_item(bad.point), field_item(bad.field));
    }
    // A joined point moves with the other point, or rotated against it.
    for (Index const point : plan.given().joined) {
        Index const same = plan.same_point(point);
        if (same == none || same == point) continue;
        Vec2 const back = conjugate(plan.rotation_of(point, same));
        for (Index i = 0; i < derivatives.count(); ++i) {
            MutablePoints const to = block.field(first + i);
            to.set(same, to[same] + product(back, derivatives[i][point]));
        }
    }
    return Status::ok;
}

Status Displacement::solve_transposed(Plan& plan, bool measured, SolveReport& report,
                                      Fault& fault) const noexcept {
    report.functions = n_fields;
    return for_each_block(plan, fault, [&](Block const& block) {
        DofValues values = dofs(plan, block);
        plan.to_displacements_transposed(values);
        copy(source, Span<const Real>(block.rows));
        values.source = source.data();
        auto const row = [&](Span<Real> rows, Index point) {
            return rows.from(Offset{point} * block.length(), block.length());
        };
        for (Index const point : plan.wall_points()) fill(row(block.rows, point), 0.0);
        SolveReport block_report;
        HARMORPH_TRY(plan.solve_fields(values, measured, block_report, fault));
        report.merge(block_report);
        subtract_transposed_couplings(plan.equations().matrix(), values);
        for (Index const point : plan.given().point) {
            for (Index k = 0; k < block.length(); ++k)
                row(block.rows, point)[k] += row(source, point)[k];
        }
        return Status::ok;
    });
}

void Displacement::write_gradient(Plan const& plan, PointList const& list, Index field,
                                  MutablePoints gradient) const noexcept {
    Points const found = block_of(plan, field).field(field);
    for (Index k = 0; k < list.count(); ++k) {
        Index const number = plan.given_index(list[k]);
        bool const is_first = place[number] == k;
        gradient.set(k, is_first ? found[plan.given().point[number]] : Vec2{});
    }
}

namespace {

constexpr Vec2 rotated_by_90(Vec2 v) noexcept { return {-v.y, v.x}; }

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
            wall[k] = matrices && field % 2 == 1 ? rotated_by_90(value) : value;
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
