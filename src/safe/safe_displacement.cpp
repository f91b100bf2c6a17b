#include "safe/safe_displacement.hpp"

#include "safe/motion_path.hpp"

namespace harmorph {
namespace {

// The modes of each body. One more is for the way of walls that are no bodies, and the last one, if
// there are bodies, for all bulges.
constexpr Index modes_of_body = 3;

// Calls visit(points of the loop) for each loop of the boundary on which all points are given.
template <class Visit>
void for_each_body(Plan const& plan, Visit const& visit) noexcept {
    GivenWall const& wall = plan.given();
    for (Index loop = 0; loop + 1 < wall.loop_start.count(); ++loop) {
        Span<const Index> const points = wall.boundary_point.from(
            wall.loop_start[loop], wall.loop_start[loop + 1] - wall.loop_start[loop]);
        bool all = !points.empty();
        for (Index const point : points) all = all && plan.given_index(point) != none;
        if (all) visit(points);
    }
}

// Returns a length that is safe as a divisor.
Real or_one(Real size) noexcept { return size > 0 ? size : 1; }

}  // namespace

void SafeDisplacement::lay_out(Arena& arena, Plan const& plan, Basis const& basis) noexcept {
    Index const n = plan.given().point.count();
    n_bodies = 0;
    for_each_body(plan, [&](Span<const Index>) { ++n_bodies; });
    Index const n_modes = modes_of_body * n_bodies + (n_bodies > 0 ? 2 : 1);
    counts = tabulated_counts(basis, n_modes, 2);
    arena.take(given, n);
    arena.take(body, n);
    arena.take(ways, n_modes);
    arena.take(modes, Offset{n_modes} * n);
    arena.take(loop_from, n);
    arena.take(loop_to, n);
    arena.take(loop_bulge, n);
    arena.take(move, 2 * Offset{counts.functions()});
    arena.take(block, Basis::bytes(counts));
    auto const shared = arena.mark();
    work.lay_out(arena, plan, n, fields_of(basis, n_modes));
    arena.release(shared);
    safe.lay_out(arena, plan, counts);
}

Status SafeDisplacement::run(Plan& plan, Basis const& basis, const Real* movement,
                             PointList const& list, Points wall, SafeOptions const& options,
                             SafeReport& report, Fault& fault) noexcept {
    HARMORPH_TRY(plan.check_fit(basis, fault));
    HARMORPH_TRY(read(plan, list, wall, fault));
    if (!plan.is_factored() ||
        plan.coordinates() != coordinates_fingerprint(plan.mesh().points, plan.mesh().n_points)) {
        HARMORPH_TRY(plan.factor(plan.mesh().points, fault));
    }
    Index const n_functions = basis.header->counts.functions(), n_modes = ways.count();
    fill(move, 0.0);
    if (movement != nullptr)
        copy(move.first(2 * n_functions),
             Span<const Real>(movement, 2 * static_cast<Size>(n_functions)));
    find_bodies(plan);
    make_modes(plan, n_functions);

    PointList const all{0, plan.given().point};
    HARMORPH_TRY(work.displacement.find_places(plan, all, fault));
    Basis tabulated;
    Arena arena = Arena::at_origin(block.data(), block.size());
    tabulated.lay_out(arena, counts);
    SolveReport solved;
    HARMORPH_TRY(
        tabulate(plan, basis, all, {n_modes, 2, &modes[0].x}, work, tabulated, solved, fault));
    safe.mesh.take_given(given, ways);
    return safe.run(plan, tabulated, move.data(), options, nullptr, report, fault);
}

// Brings the displacements into the order of the plan by means of a displacement field.
Status SafeDisplacement::read(Plan const& plan, PointList const& list, Points wall,
                              Fault& fault) noexcept {
    Displacement const& field = work.displacement;
    HARMORPH_TRY(work.displacement.find_places(plan, list, fault));
    HARMORPH_TRY(field.set(plan, list, 0, wall, fault));
    for (Index i = 0; i < given.count(); ++i) given[i] = field.at(plan, 0, plan.given().point[i]);
    return Status::ok;
}

// If two loops touch at a point, the point belongs to the first loop.
void SafeDisplacement::find_bodies(Plan const& plan) noexcept {
    Index number = 0;
    fill(body, none);
    for_each_body(plan, [&](Span<const Index> points) {
        for (Index const point : points) {
            Index& body_of_point = body[plan.given_index(point)];
            if (body_of_point == none) body_of_point = number;
        }
        ++number;
    });
}

// All values of modes are at most 1 in size; the amplitudes contain the lengths.
void SafeDisplacement::make_modes(Plan const& plan, Index first_mode) noexcept {
    Index const n = given.count();
    Points const points = plan.mesh().points;
    fill(modes, Vec2{});
    auto const mode = [&](Index number) { return modes.from(Offset{number} * n, n); };
    auto const set_amplitude = [&](Index number, Vec2 target, MovementPath::ModeWay way) {
        move[2 * (first_mode + number)] = target.x;
        move[2 * (first_mode + number) + 1] = target.y;
        ways[number] = way;
    };
    for (Index number = 0; number < n_bodies; ++number) {
        Similarity const similarity = fit_similarity([&](auto const& visit) {
            for (Index i = 0; i < n; ++i) {
                if (body[i] == number) visit(points[plan.given().point[i]], given[i]);
            }
        });
        Vec2 const r = similarity.ratio;
        Index const first = modes_of_body * number;
        Span<Vec2> const translation = mode(first), position = mode(first + 1),
                         drift = mode(first + 2);
        Real extent = 0, largest_drift = 0;
        for (Index i = 0; i < n; ++i) {
            if (body[i] != number) continue;
            translation[i] = {1, 0};
            position[i] = points[plan.given().point[i]] - similarity.centre;
            drift[i] = quotient(position[i] + (given[i] - similarity.shift), r) - position[i];
            extent = max(extent, length(position[i]));
            largest_drift = max(largest_drift, length(drift[i]));
        }
        extent = or_one(extent);
        for (Vec2& p : position) p = (1 / extent) * p;
        for (Vec2& p : drift) p = (1 / or_one(largest_drift)) * p;
        set_amplitude(first, similarity.shift, {{}, {1, 0}});
        set_amplitude(first + 1, extent * (r - Vec2{1, 0}), {{extent, 0}, r});
        set_amplitude(first + 2, largest_drift * r, {{}, r});
    }
    Real largest = 0;
    Span<Vec2> const straight = mode(modes_of_body * n_bodies);
    for (Index i = 0; i < n; ++i) {
        if (body[i] == none) largest = max(largest, length(given[i]));
    }
    for (Index i = 0; i < n; ++i) {
        if (body[i] == none) straight[i] = (1 / or_one(largest)) * given[i];
    }
    set_amplitude(modes_of_body * n_bodies, {largest, 0}, {{}, {1, 0}});
    if (n_bodies == 0) return;
    Real const bulge = find_bulges(plan, mode(modes_of_body * n_bodies + 1));
    set_amplitude(modes_of_body * n_bodies + 1, {}, {{}, {1, 0}, bulge});
}

// Sets the mode to the bulges of all bodies beside the similarities of their ways, in parts of the
// largest one, which is returned.
Real SafeDisplacement::find_bulges(Plan const& plan, Span<Vec2> mode) noexcept {
    constexpr Real rounding = 1e-9;
    Real largest = 0, extent = 0;
    Index number = 0;
    for_each_body(plan, [&](Span<const Index> points) {
        Index const n = points.count();
        for (Index k = 0; k < n; ++k) {
            loop_from[k] = plan.mesh().points[points[k]];
            loop_to[k] = given[plan.given_index(points[k])];
        }
        Similarity const similarity = fit_similarity([&](auto const& visit) {
            for (Index k = 0; k < n; ++k) visit(loop_from[k], loop_to[k]);
        });
        for (Index k = 0; k < n; ++k) {
            Vec2 const position = loop_from[k] - similarity.centre;
            loop_to[k] = quotient(position + loop_to[k] - similarity.shift, similarity.ratio);
            loop_from[k] = position;
            extent = max(extent, length(position));
        }
        if (!similarity.exists) return void(++number);
        find_bulge(loop_from.first(n), loop_to.first(n), loop_bulge.first(n));
        for (Index k = 0; k < n; ++k) {
            Index const i = plan.given_index(points[k]);
            if (body[i] != number) continue;
            mode[i] = product(complex_power(similarity.ratio, 0.5), loop_bulge[k]);
            largest = max(largest, length(mode[i]));
        }
        ++number;
    });
    if (!(largest > rounding * extent)) largest = 0;
    for (Vec2& b : mode) b = 1 / or_one(largest) * b;
    return largest;
}

}  // namespace harmorph
