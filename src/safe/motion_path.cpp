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

void MovementPath::lay_out(Arena& arena, Index n_functions) noexcept {
    arena.take(group_of, n_functions);
    arena.take(groups, n_functions);
    arena.take(start, n_functions);
    arena.take(drift, n_functions);
    arena.take(target, 2 * Offset{n_functions});
}

void MovementPath::init(Basis const& basis, const Real* move) noexcept {
    copy(target, Span<const Real>(move, target.size()));
    find_groups(basis);
    Index const n_control = basis.header->counts.control;
    for (Index i = 0; i < n_control; ++i) start[i] = {basis.control[2 * i], basis.control[2 * i + 1]};
    for (Index group = 0; group < n_control; ++group) fit_similarity(basis, group);
    for (Index i = 0; i < n_control; ++i) {
        Group const& similarity = groups[group_of[i]];
        Vec2 const move_of_it{target[2 * i], target[2 * i + 1]};
        start[i] = start[i] - similarity.centre;
        drift[i] = quotient(start[i] + move_of_it - similarity.shift, similarity.ratio) - start[i];
    }
    for (Index body = 0; body < basis.header->counts.bodies; ++body) {
        Index const translation = n_control + 2 * body, turn = translation + 1;
        groups[translation] = {{}, {target[2 * translation], target[2 * translation + 1]}, {1, 0}, 1};
        Vec2 const change{target[2 * turn], target[2 * turn + 1]}, ratio = Vec2{1, 0} + change;
        bool const turns = length(ratio) > least_ratio;
        groups[turn] = {{}, {}, turns ? ratio : Vec2{1, 0}, 1};
        group_of[translation] = translation;
        group_of[turn] = turn;
        start[translation] = drift[translation] = {};
        start[turn] = {1, 0};
        drift[turn] = turns ? Vec2{} : change;
    }
}

// A control point's group is numbered by its first member.
void MovementPath::find_groups(Basis const& basis) noexcept {
    for (Index i = 0; i < group_of.count(); ++i) group_of[i] = i;
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

// Least squares over the members: d = mean of dP, r - 1 = sum conj(p) (dP - d) / sum |p|^2, p = P - c, c = mean of P.
void MovementPath::fit_similarity(Basis const& basis, Index group) noexcept {
    Group& similarity = groups[group];
    similarity = {{}, {}, {1, 0}, 0};
    auto const for_each_member = [&](auto const& visit) {
        for (Index i = group; i < basis.header->counts.control; ++i) {
            if (group_of[i] == group) visit(start[i], Vec2{target[2 * i], target[2 * i + 1]});
        }
    };
    for_each_member([&](Vec2, Vec2) { ++similarity.members; });
    if (similarity.members == 0) return;
    Real const share = 1 / static_cast<Real>(similarity.members);
    for_each_member([&](Vec2 point, Vec2 move) {
        similarity.centre = similarity.centre + share * point;
        similarity.shift = similarity.shift + share * move;
    });
    if (basis.kind() == ValueKind::real) return;
    Vec2 turned;
    Real squares = 0;
    for_each_member([&](Vec2 point, Vec2 move) {
        turned = turned + product(conjugate(point - similarity.centre), move - similarity.shift);
        squares += square(point - similarity.centre);
    });
    if (squares == 0) return;
    Vec2 const ratio = Vec2{1, 0} + (1 / squares) * turned;
    if (length(ratio) > least_ratio) similarity.ratio = ratio;
}

void MovementPath::at(Real t, Span<Real> movement) const noexcept {
    if (t >= 1) return copy(movement, Span<const Real>(target));
    for (Index i = 0; i < group_of.count(); ++i) {
        Group const& similarity = groups[group_of[i]];
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
