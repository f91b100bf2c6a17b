#include "harmorph/safe/motion_path.hpp"

namespace harmorph {
namespace {

// The root with a real part >= 0.
Vec2 complex_root(Vec2 z) noexcept {
    Real const size = length(z);
    Real const larger_part = square_root(0.5 * (size + absolute(z.x)));
    if (larger_part == 0) return {};
    Real const smaller_part = 0.5 * z.y / larger_part;
    if (z.x >= 0) return {larger_part, smaller_part};
    return {absolute(smaller_part), z.y < 0 ? -larger_part : larger_part};
}

// A body that collapses or turns inside out has no way round 0 that is worth going.
constexpr Real least_ratio = 0.05;

}  // namespace

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
    arena.take(target, 2 * Offset{n_functions});
    arena.take(slot_of, counts.points);
}

void MovementPath::init(Basis const& basis, const Real* move) noexcept {
    copy(target, Span<const Real>(move, target.size()));
    fill(slot_of, none);
    auto const note = [&](Index point, Index slot) { slot_of[point] = basis.is_given(slot) ? none : slot; };
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) note(basis.wall_point[slot], slot);
    for (Index k = 0; k < basis.joined_point.count(); ++k) note(basis.joined_point[k], basis.joined_slot[k]);
    find_groups(basis);
    find_anchors(basis);
    fit_all(basis, basis.kind() == ValueKind::real);
}

void MovementPath::straighten(Basis const& basis) noexcept { fit_all(basis, true); }

bool MovementPath::is_bent() const noexcept {
    for (Index const group : group_of) {
        if (!groups[group].is_straight()) return true;
    }
    return false;
}

void MovementPath::fit_all(Basis const& basis, bool straight) noexcept {
    Index const n_control = basis.header->counts.control;
    for (Index i = 0; i < n_control; ++i) start[i] = {basis.control[2 * i], basis.control[2 * i + 1]};
    for (Index group = 0; group < n_control; ++group) fit_similarity(basis, group, straight);
    for (Index i = 0; i < n_control; ++i) {
        Group const& similarity = groups[group_of[i]];
        Vec2 const move_of_it{target[2 * i], target[2 * i + 1]};
        start[i] = start[i] - similarity.centre;
        drift[i] = similarity.is_straight()
                       ? move_of_it
                       : quotient(start[i] + move_of_it - similarity.shift, similarity.ratio) - start[i];
    }
    for (Index body = 0; body < basis.header->counts.bodies; ++body) {
        Index const translation = n_control + 2 * body, turn_of_it = translation + 1;
        Vec2 const change{target[2 * turn_of_it], target[2 * turn_of_it + 1]}, ratio = Vec2{1, 0} + change;
        bool const anchored = groups[turn_of_it].anchored;
        bool const turns = !straight && !anchored && length(ratio) > least_ratio;
        groups[translation] = {{}, {}, {1, 0}, 1, anchored};
        groups[turn_of_it] = {{}, {}, turns ? ratio : Vec2{1, 0}, 1, anchored};
        start[translation] = {};
        drift[translation] = {target[2 * translation], target[2 * translation + 1]};
        start[turn_of_it] = {1, 0};
        drift[turn_of_it] = turns ? Vec2{} : change;
    }
}

// A group is numbered by its first member.
void MovementPath::find_groups(Basis const& basis) noexcept {
    for (Index i = 0; i < group_of.count(); ++i) {
        group_of[i] = i;
        groups[i].anchored = false;
    }
    for (Index changed = 1; changed > 0;) {
        changed = 0;
        for (Index number = 0; number < basis.header->counts.curves; ++number) {
            Curve const curve = basis.curve(number);
            Index low = group_of.count();
            for (Index k = 0; k < curve.n_indices; ++k) low = smaller(low, group_of[curve.control_point(k)]);
            for (Index k = 0; k < curve.n_indices; ++k) {
                Index& group_number = group_of[curve.control_point(k)];
                changed += group_number != low ? 1 : 0;
                group_number = low;
            }
        }
    }
}

void MovementPath::join(Index group, Index other) noexcept {
    Index const low = smaller(group, other), high = larger(group, other);
    bool const anchored = groups[low].anchored || groups[high].anchored;
    for (Index i = 0; i < group_of.count(); ++i) {
        if (group_of[i] == high) group_of[i] = low;
    }
    groups[low].anchored = anchored;
}

// A loop of the boundary that is wall all round is a body: its curves turn as one. Where a loop is wall in part, or of curves
// in part and rigid in part, whatever is on it goes straight.
void MovementPath::find_anchors(Basis const& basis) noexcept {
    Index const n_control = basis.header->counts.control;
    for (Index loop = 0; loop + 1 < basis.loop_start.count(); ++loop) {
        Span<const Index> const points =
            basis.boundary_point.from(basis.loop_start[loop], basis.loop_start[loop + 1] - basis.loop_start[loop]);
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
            bool const curves = first < n_control && group < n_control;
            if (group != first && curves) join(group, first);
            if (group != first && curves) first = smaller(group, first);
            is_body = is_body && (curves || group == first);
        }
        if (is_body) continue;
        for (Index const point : points) {
            if (slot_of[point] != none) groups[group_of_slot(basis, slot_of[point])].anchored = true;
        }
    }
}

// Least squares over the members: d = mean of dP, r - 1 = sum conj(p) (dP - d) / sum |p|^2, p = P - c, c = mean of P.
void MovementPath::fit_similarity(Basis const& basis, Index group, bool straight) noexcept {
    Group& similarity = groups[group];
    similarity = {{}, {}, {1, 0}, 0, similarity.anchored};
    auto const for_each_member = [&](auto const& visit) {
        for (Index i = group; i < basis.header->counts.control; ++i) {
            if (group_of[i] == group) visit(start[i], Vec2{target[2 * i], target[2 * i + 1]});
        }
    };
    if (straight || similarity.anchored) return;
    for_each_member([&](Vec2, Vec2) { ++similarity.members; });
    if (similarity.members == 0) return;
    Real const share = 1 / static_cast<Real>(similarity.members);
    for_each_member([&](Vec2 point, Vec2 move) {
        similarity.centre = similarity.centre + share * point;
        similarity.shift = similarity.shift + share * move;
    });
    Vec2 turned;
    Real squares = 0;
    for_each_member([&](Vec2 point, Vec2 move) {
        turned = turned + product(conjugate(point - similarity.centre), move - similarity.shift);
        squares += square(point - similarity.centre);
    });
    Vec2 const ratio = squares > 0 ? Vec2{1, 0} + (1 / squares) * turned : Vec2{};
    if (length(ratio) > least_ratio) {
        similarity.ratio = ratio;
    } else {
        similarity.centre = similarity.shift = {};
    }
}

void MovementPath::at(Real t, Span<Real> movement) const noexcept {
    if (t >= 1) return copy(movement, Span<const Real>(target));
    for (Index i = 0; i < group_of.count(); ++i) {
        Group const& similarity = groups[group_of[i]];
        if (similarity.is_straight()) {
            movement[2 * i] = t * drift[i].x;
            movement[2 * i + 1] = t * drift[i].y;
            continue;
        }
        Vec2 const turned = product(complex_power(similarity.ratio, t), start[i] + t * drift[i]);
        Vec2 const moved = t * similarity.shift + (turned - start[i]);
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
