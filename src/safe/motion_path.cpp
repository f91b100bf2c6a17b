#include "safe/motion_path.hpp"

namespace harmorph {
namespace {

// Returns the root that has a real part >= 0.
Vec2 complex_root(Vec2 z) noexcept {
    Real const size = length(z);
    Real const larger_part = sqrt(0.5 * (size + abs(z.x)));
    if (larger_part == 0) return {};
    Real const smaller_part = 0.5 * z.y / larger_part;
    if (z.x >= 0) return {larger_part, smaller_part};
    return {abs(smaller_part), z.y < 0 ? -larger_part : larger_part};
}

}  // namespace

void find_bulge(Span<const Vec2> from, Span<const Vec2> to, Span<Vec2> bulge) noexcept {
    Index const n = from.count();
    auto const after = [&](Index k) { return k + 1 < n ? k + 1 : 0; };
    auto const rotation = [&](Index k) {
        Vec2 const before = from[after(k)] - from[k], now = to[after(k)] - to[k];
        Vec2 const ratio = square(before) > 0 ? quotient(now, before) : Vec2{};
        Real const size = length(ratio);
        return size > 0 ? 1 / size * ratio : Vec2{1, 0};
    };
    Index first = 0;
    for (Index k = 0; k < n; ++k) {
        if (rotation(k).x > rotation(first).x) first = k;
    }
    // The side whose rotation is least like that of the side before, and how like; where the other
    // of both roots is taken, so that the angles return to the first one; none at first.
    Index least_like = none, other_root = none;
    Real least = 2;
    // Calls visit(point, side from there, weight of the side) for the sides in the middle. Returns
    // whether the angles return to the first one.
    auto const for_sides = [&](auto const& visit) {
        Vec2 root{1, 0};
        for (Index j = 0, k = first; j < n; ++j, k = after(k)) {
            Vec2 const own = complex_root(rotation(k));
            Real const alike = dot(own, root);
            if (abs(alike) < least) least = abs(alike), least_like = k;
            root = (alike < 0) == (k == other_root) ? own : -1 * own;
            Vec2 const before = from[after(k)] - from[k], now = to[after(k)] - to[k];
            Vec2 const side = 0.5 * (product(root, before) + product(conjugate(root), now));
            visit(k, side, length(side) * length(root - Vec2{1, 0}));
        }
        return dot(root, complex_root(rotation(first))) > 0;
    };
    if (!for_sides([](Index, Vec2, Real) {})) other_root = least_like;
    Vec2 gap, at, mean;
    Real weights = 0;
    bool const returns = for_sides([&](Index, Vec2 side, Real weight) {
        gap = gap + side;
        weights += weight;
    });
    fill(bulge, Vec2{});
    if (!returns || weights == 0) return;
    for_sides([&](Index k, Vec2 side, Real weight) {
        bulge[k] = at - 0.5 * (from[k] + to[k]);
        mean = mean + 1 / static_cast<Real>(n) * bulge[k];
        at = at + side - weight / weights * gap;
    });
    for (Vec2& b : bulge) b = b - mean;
}

Vec2 complex_power(Vec2 r, Real t) noexcept {
    constexpr Index bits = 40;
    if (t >= 1) return r;
    Vec2 power{1, 0};
    for (Index bit = 0; bit < bits && t > 0; ++bit) {
        r = complex_root(r);
        t *= 2;
        if (t < 1) continue;
        power = product(power, r);
        t -= 1;
    }
    return power;
}

void MovementPath::lay_out(Arena& arena, BasisCounts const& counts) noexcept {
    Index const n_functions = counts.functions();
    arena.take(group_of, n_functions);
    arena.take(groups, n_functions);
    arena.take(start, n_functions);
    arena.take(drift, n_functions);
    arena.take(bulge, n_functions);
    arena.take(polygon, n_functions);
    arena.take(target_polygon, n_functions);
    arena.take(middle, n_functions);
    arena.take(target, 2 * Offset{n_functions});
    arena.take(slot_of, counts.points);
}

void MovementPath::init(Basis const& basis, const Real* move) noexcept {
    copy(target, Span<const Real>(move, target.size()));
    fill(slot_of, none);
    auto const note = [&](Index point, Index slot) {
        slot_of[point] = basis.is_given(slot) ? none : slot;
    };
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot)
        note(basis.wall_point[slot], slot);
    for (Index k = 0; k < basis.joined_point.count(); ++k)
        note(basis.joined_point[k], basis.joined_slot[k]);
    find_groups(basis);
    find_anchors(basis);
    bend(basis);
}

void MovementPath::bend(Basis const& basis) noexcept {
    fit_all(basis, basis.kind() == ValueKind::real);
}

void MovementPath::straighten(Basis const& basis) noexcept { fit_all(basis, true); }

bool MovementPath::is_bent() const noexcept {
    for (Index const group : group_of) {
        if (!groups[group].is_straight()) return true;
    }
    for (Vec2 const& b : bulge) {
        if (b.x != 0 || b.y != 0) return true;
    }
    return false;
}

void MovementPath::fit_all(Basis const& basis, bool straight) noexcept {
    BasisCounts const& counts = basis.header->counts;
    constexpr Vec2 not_at_all{1, 0};
    Index const n_shapes = counts.shapes(), first_mode = n_shapes + 2 * counts.bodies;
    fill(bulge, Vec2{});
    if (counts.combination == 0) fit_curves(basis, straight);
    for (Index i = 0; i < n_shapes && counts.combination != 0; ++i)
        set_alone(i, {}, not_at_all, false);
    for (Index body = 0; body < counts.bodies; ++body) {
        Index const translation = n_shapes + 2 * body, rotation = translation + 1;
        Vec2 const ratio = Vec2{1, 0} + Vec2{target[2 * rotation], target[2 * rotation + 1]};
        bool const anchored = groups[rotation].anchored;
        bool const rotates = !straight && !anchored && length(ratio) > Similarity::min_ratio;
        set_alone(translation, {}, not_at_all, anchored);
        set_alone(rotation, {1, 0}, rotates ? ratio : not_at_all, anchored);
        if (rotates) drift[rotation] = {};
    }
    for (Index mode = 0; mode < counts.modes; ++mode) {
        ModeWay const way =
            mode_ways.empty() || straight ? ModeWay{{}, not_at_all} : mode_ways[mode];
        set_alone(first_mode + mode, way.start, way.ratio, false);
        bulge[first_mode + mode] = {way.bulge, 0};
    }
}

void MovementPath::set_alone(Index function, Vec2 from, Vec2 ratio, bool anchored) noexcept {
    Vec2 const move_of_it{target[2 * function], target[2 * function + 1]};
    groups[function] = {{}, {}, ratio, 1, anchored};
    start[function] = from;
    drift[function] =
        groups[function].is_straight() ? move_of_it : quotient(from + move_of_it, ratio) - from;
}

void MovementPath::fit_curves(Basis const& basis, bool straight) noexcept {
    Index const n_control = basis.header->counts.control;
    for (Index i = 0; i < n_control; ++i)
        start[i] = {basis.control[2 * i], basis.control[2 * i + 1]};
    for (Index group = 0; group < n_control; ++group) fit_group(basis, group, straight);
    for (Index i = 0; i < n_control; ++i) {
        Group const& similarity = groups[group_of[i]];
        Vec2 const move_of_it{target[2 * i], target[2 * i + 1]};
        start[i] = start[i] - similarity.centre;
        drift[i] =
            similarity.is_straight()
                ? move_of_it
                : quotient(start[i] + move_of_it - similarity.shift, similarity.ratio) - start[i];
    }
    for (Index number = 0; number < basis.header->counts.curves && !straight; ++number)
        bend_curve(basis, number);
}

// Bends the way of a closed curve that is a body by itself.
void MovementPath::bend_curve(Basis const& basis, Index number) noexcept {
    Curve const curve = basis.curve(number);
    Index const first = curve.control_point(0), group = group_of[first];
    Index n = 1;
    while (n < curve.n_indices && curve.control_point(n) != first) ++n;
    if (n == curve.n_indices || !groups[group].bends || groups[group].members != n) return;
    for (Index k = 0; k < n; ++k) {
        Index const i = curve.control_point(k);
        polygon[k] = start[i];
        target_polygon[k] = start[i] + drift[i];
    }
    find_bulge(polygon.first(n), target_polygon.first(n), middle.first(n));
    for (Index k = 0; k < n; ++k) bulge[curve.control_point(k)] = middle[k];
}

// The number of a group is that of its first member.
void MovementPath::find_groups(Basis const& basis) noexcept {
    for (Index i = 0; i < group_of.count(); ++i) {
        group_of[i] = i;
        groups[i].anchored = false;
    }
    if (basis.header->counts.combination != 0) return;
    for (Index changed = 1; changed > 0;) {
        changed = 0;
        for (Index number = 0; number < basis.header->counts.curves; ++number) {
            Curve const curve = basis.curve(number);
            Index low = group_of.count();
            for (Index k = 0; k < curve.n_indices; ++k)
                low = min(low, group_of[curve.control_point(k)]);
            for (Index k = 0; k < curve.n_indices; ++k) {
                Index& group_number = group_of[curve.control_point(k)];
                changed += group_number != low ? 1 : 0;
                group_number = low;
            }
        }
    }
}

void MovementPath::join(Index group, Index other) noexcept {
    Index const low = min(group, other), high = max(group, other);
    bool const anchored = groups[low].anchored || groups[high].anchored;
    for (Index i = 0; i < group_of.count(); ++i) {
        if (group_of[i] == high) group_of[i] = low;
    }
    groups[low].anchored = anchored;
}

// A loop of the boundary that consists of walls only is a body: its curves rotate together. If a
// loop is a wall only in part, or has both curves and rigid parts, everything on the loop goes
// straight.
void MovementPath::find_anchors(Basis const& basis) noexcept {
    Index const n_shapes = basis.header->counts.shapes();
    for (Index loop = 0; loop + 1 < basis.loop_start.count(); ++loop) {
        Span<const Index> const points = basis.boundary_point.from(
            basis.loop_start[loop], basis.loop_start[loop + 1] - basis.loop_start[loop]);
        Index first = none;
        bool is_body = true;
        for (Index const point : points) {
            Index const slot = slot_of[point];
            if (slot == none) {
                is_body = false;
                continue;
            }
            Index const group = group_of_slot(basis, slot);
            if (first == none) first = group;
            bool const curves = first < n_shapes && group < n_shapes;
            if (group != first && curves) join(group, first);
            if (group != first && curves) first = min(group, first);
            is_body = is_body && (curves || group == first);
        }
        if (is_body) continue;
        for (Index const point : points) {
            if (slot_of[point] != none)
                groups[group_of_slot(basis, slot_of[point])].anchored = true;
        }
    }
}

void MovementPath::fit_group(Basis const& basis, Index group, bool straight) noexcept {
    Group& similarity = groups[group];
    similarity = {{}, {}, {1, 0}, 0, similarity.anchored};
    if (straight || similarity.anchored) return;
    Similarity const fit = fit_similarity([&](auto const& visit) {
        for (Index i = group; i < basis.header->counts.control; ++i) {
            if (group_of[i] == group) visit(start[i], Vec2{target[2 * i], target[2 * i + 1]});
        }
    });
    similarity.members = fit.members;
    similarity.bends = fit.exists;
    if (fit.ratio.x == 1 && fit.ratio.y == 0) return;
    similarity.centre = fit.centre;
    similarity.shift = fit.shift;
    similarity.ratio = fit.ratio;
}

void MovementPath::at(Real t, Span<Real> movement) const noexcept {
    if (t >= 1) return copy(movement, Span<const Real>(target));
    Real const bent = 4 * t * (1 - t);
    RotationAt rotation(*this, t);
    for (Index i = 0; i < group_of.count(); ++i) {
        Group const& similarity = groups[group_of[i]];
        if (similarity.is_straight()) {
            movement[2 * i] = t * drift[i].x + bent * bulge[i].x;
            movement[2 * i + 1] = t * drift[i].y + bent * bulge[i].y;
            continue;
        }
        Vec2 const there = start[i] + t * drift[i] + bent * bulge[i];
        Vec2 const rotated = product(rotation.of(group_of[i]), there);
        Vec2 const moved = t * similarity.shift + (rotated - start[i]);
        movement[2 * i] = moved.x;
        movement[2 * i + 1] = moved.y;
    }
}

Vec2 MovementPath::weight(Index function, Real t) const noexcept {
    if (t <= 0) return {};
    Vec2 const ratio = groups[group_of[function]].ratio;
    return t * quotient(complex_power(ratio, t), ratio);
}

}  // namespace harmorph
