#include "boundary/slip_curves.hpp"

#include "base/angle.hpp"
#include "base/hash.hpp"

namespace harmorph {
namespace {

constexpr Index max_steps = 100;  // steps of Newton's method or bisection on a segment

Vec2 mirrored(Vec2 tangent, Vec2 chord) noexcept {
    return (2 * dot(tangent, chord)) * chord - tangent;
}

// Returns the tangent of the circle through three points, at the second point.
Vec2 circle_tangent(Vec2 before, Vec2 here, Vec2 after) noexcept {
    Vec2 const a = here - before, b = after - here;
    Real const length_a = length(a), length_b = length(b);
    Real const share = length_a / (length_a + length_b);
    return direction(((1 - share) / length_a) * a + (share / length_b) * b);
}

// A cubic on 0..1, given by its ends and its derivatives at the ends.
struct Cubic {
    Vec2 begin, end, leaving, arriving;

    Vec2 at(Real u) const noexcept {
        Real const v = 1 - u;
        return begin + (u * u * (3 - 2 * u)) * (end - begin) + (u * v * v) * leaving -
               (u * u * v) * arriving;
    }
    Vec2 slope(Real u) const noexcept {
        Real const v = 1 - u;
        return (6 * u * v) * (end - begin) + (v * (1 - 3 * u)) * leaving +
               (u * (3 * u - 2)) * arriving;
    }
    Vec2 bend(Real u) const noexcept {
        return (6 - 12 * u) * (end - begin) + (6 * u - 4) * leaving + (6 * u - 2) * arriving;
    }
};

// Returns whether p is nearer to the curve than the centre of curvature, with a margin. `fall` is
// minus the derivative of (p - C(u)).C'(u).
bool is_regular(Real fall, Vec2 slope) noexcept { return fall > 1e-3 * square(slope); }

}  // namespace

void SlipCurves::lay_out(Arena& arena, Size max_faces, bool any_given) noexcept {
    Size const n_between = any_given ? 2 * max_faces * (divisions - 1) : 0;
    arena.take(start, max_faces + 1);
    arena.take(point, 2 * max_faces);
    arena.take(own, 2 * max_faces);
    arena.take(at, 2 * max_faces);
    arena.take(tangent, 2 * max_faces);
    arena.take(is_given, max_faces);
    arena.take(between_at, n_between);
    arena.take(between_tangent, n_between);
}

void SlipCurves::lay_out_copy(Arena& arena, SlipCurves const& other) noexcept {
    Index const n = other.n_slots();
    arena.take(start, n == 0 ? 0 : Offset{other.count} + 1);
    arena.take(point, n);
    arena.take(own, n);
    arena.take(at, n);
    arena.take(tangent, n);
    arena.take(is_given, other.count);
    Index const n_between = other.between_at.empty() ? 0 : (divisions - 1) * n;
    arena.take(between_at, n_between);
    arena.take(between_tangent, n_between);
}

void SlipCurves::copy_from(SlipCurves const& other) noexcept {
    count = other.count;
    Index const n = other.n_slots();
    if (n == 0) return;
    copy(start, Span<const Index>(other.start.first(count + 1)));
    copy(point, Span<const Index>(other.point.first(n)));
    copy(own, Span<const Index>(other.own.first(n)));
    copy(at, Span<const Vec2>(other.at.first(n)));
    copy(tangent, Span<const Vec2>(other.tangent.first(n)));
    copy(is_given, Span<const std::uint8_t>(other.is_given.first(count)));
    copy(between_at, Span<const Vec2>(other.between_at.first(between_at.size())));
    copy(between_tangent, Span<const Vec2>(other.between_tangent.first(between_tangent.size())));
}

void SlipCurves::find_tangents(Index curve, bool closed) const noexcept {
    Index const first = start[curve], last = start[curve + 1] - 1;
    for (Index k = first + 1; k < last; ++k)
        tangent[k] = circle_tangent(at[k - 1], at[k], at[k + 1]);
    if (closed) {
        tangent[first] = tangent[last] = circle_tangent(at[last - 1], at[first], at[first + 1]);
    } else {
        tangent[first] = mirrored(tangent[first + 1], direction(at[first + 1] - at[first]));
        tangent[last] = mirrored(tangent[last - 1], direction(at[last] - at[last - 1]));
    }
}

void SlipCurves::keep_slipping(Span<const PointKind> kinds) const noexcept {
    for (Index slot = 0; slot < n_slots(); ++slot) {
        if (kinds[point[slot]] != PointKind::slip) own[slot] = none;
    }
}

std::uint64_t SlipCurves::fingerprint_with(std::uint64_t others) const noexcept {
    Hash hash;
    hash.add(others);
    auto const add = [&](Vec2 v) {
        hash.add(bits_of(v.x));
        hash.add(bits_of(v.y));
    };
    bool any = false;
    for (Index curve = 0; curve < count; ++curve) {
        if (is_given[curve] == 0) continue;
        any = true;
        hash.add(static_cast<std::uint64_t>(curve));
        Index const first = start[curve], last = start[curve + 1] - 1;
        for (Index slot = first; slot <= last; ++slot) add(tangent[slot]);
        for (Index k = (divisions - 1) * first; k < (divisions - 1) * last; ++k) {
            add(between_at[k]);
            add(between_tangent[k]);
        }
    }
    return any ? hash.value() : others;
}

Index SlipCurves::curve_of(Index slot) const noexcept {
    Index first = 0, last = count;  // start[first] <= slot < start[last]
    while (last - first > 1) {
        Index const middle = first + (last - first) / 2;
        (start[middle] <= slot ? first : last) = middle;
    }
    return first;
}

SlipCurves::Place SlipCurves::nearest(Index slot, Vec2 p) const noexcept {
    Index const curve = curve_of(slot), first = start[curve], last = start[curve + 1] - 1;
    auto const same = [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; };
    if (same(p, at[slot])) return {at[slot], tangent[slot]};
    bool const closed = same(at[first], at[last]) && same(tangent[first], tangent[last]);
    auto const ahead = [&](Index k) { return dot(p - at[k], tangent[k]); };
    bool const forwards = ahead(slot) >= 0;
    Index here = slot;
    for (Index step = first; step < last; ++step) {
        Index const end = forwards ? last : first;
        if (here == end && !closed) return {at[end] + ahead(end) * tangent[end], tangent[end]};
        if (here == end) here = first + last - end;
        Index const next = forwards ? here + 1 : here - 1;
        if ((ahead(next) >= 0) != forwards) return on_segment(curve, forwards ? here : next, p);
        here = next;
    }
    // If no place of a closed curve is found, p is too far away to have a nearest place.
    if (closed) return {at[slot], tangent[slot]};
    return {at[here] + ahead(here) * tangent[here], tangent[here]};
}

// Searches the first division of the segment whose end lies ahead of p, measured along the tangent
// there.
SlipCurves::Place SlipCurves::on_segment(Index curve, Index slot, Vec2 p) const noexcept {
    Vec2 place[2] = {at[slot], at[slot + 1]}, direction[2] = {tangent[slot], tangent[slot + 1]};
    if (is_given[curve] == 0) return on_cubic(place, direction, p);
    for (Index division = 1; division < divisions; ++division) {
        Index const k = (divisions - 1) * slot + division - 1;
        if (dot(p - between_at[k], between_tangent[k]) < 0) {
            place[1] = between_at[k];
            direction[1] = between_tangent[k];
            break;
        }
        place[0] = between_at[k];
        direction[0] = between_tangent[k];
    }
    return on_cubic(place, direction, p);
}

// Returns whether a cubic between two places is close to the curve: both tangents must point from
// the first place to the second and turn little.
bool SlipCurves::is_smooth(const Vec2 (&at)[2], const Vec2 (&tangent)[2]) noexcept {
    constexpr Real cosine_of_30_degrees = 0.8660254037844386;
    Vec2 const side = at[1] - at[0];
    Real const min_progress = cosine_of_30_degrees * length(side);
    return dot(tangent[0], side) > min_progress && dot(tangent[1], side) > min_progress &&
           dot(tangent[0], tangent[1]) > cosine_of_30_degrees;
}

// Solves (p - C(u)).C'(u) = 0; the left side is not negative at the beginning of the segment and
// not positive at its end.
SlipCurves::Place SlipCurves::on_cubic(const Vec2 (&at)[2], const Vec2 (&tangent)[2],
                                       Vec2 p) noexcept {
    Vec2 const side = at[1] - at[0];
    Real const chord = length(side);
    Real const along = 0.5 / chord * dot(tangent[0] + tangent[1], side);
    Real const speed = 2 * chord / (1 + along);
    Cubic const curve{at[0], at[1], speed * tangent[0], speed * tangent[1]};
    Real low = 0, high = 1, u = clamp(dot(p - at[0], side) / (chord * chord), 0.0, 1.0);
    for (Index step = 0; step < max_steps && high - low > epsilon; ++step) {
        Vec2 const slope = curve.slope(u), off = p - curve.at(u);
        Real const value = dot(off, slope), fall = square(slope) - dot(off, curve.bend(u));
        (value >= 0 ? low : high) = u;
        Real const newton = is_regular(fall, slope) ? u + value / fall : low;
        Real const next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (abs(next - u) <= epsilon) break;
        u = next;
    }
    Vec2 const slope = curve.slope(u);
    Real const fall = square(slope) - dot(p - curve.at(u), curve.bend(u));
    return {curve.at(u), direction(slope), is_regular(fall, slope) ? square(slope) / fall : 1};
}

}  // namespace harmorph
