#include "bspline/corners.hpp"

namespace harmorph {
namespace {

// Directions are taken over several lengths, and the smallest turn counts. A corner turns the
// direction over all lengths. The zigzag of coordinates with few digits turns it over short lengths
// only, and a round arc or a corner nearby over long lengths only.
constexpr Real window[] = {2e-5, 5e-4, 1e-2};

constexpr Real min_corner_turn = 0.087;   // 5 degrees
constexpr Real side_straightness = 0.02;  // as a fraction of the length of the side
constexpr Real coordinate_noise = 2e-6;   // the precision of coordinates with six digits
// A point with a smaller turn divides a straight facet; more than max_flat_points of them in a row
// are a straight side.
constexpr Real flat_turn = 1e-4;
constexpr Index max_flat_points = 3;

Vec2 direction_of(Vec2 a) noexcept { return (1 / length(a)) * a; }

struct OutlineBend {
    Real turn = 0;
    Real curvature = 0;
};

OutlineBend bend_at(Outline const& outline, Index point, Real reach) noexcept {
    Index const a = outline.behind(point, reach);
    Index const b = outline.ahead(point, reach);
    if (a == none || b == none) return {infinity, infinity};
    Vec2 const back = outline.points[point] - outline.points[a];
    Vec2 const forth = outline.points[b] - outline.points[point];
    // A reach of the whole loop leads back to the point.
    if (square(back) == 0 || square(forth) == 0) return {infinity, infinity};
    Real const turn = length(direction_of(forth) - direction_of(back));
    // On a circle the curvature is exactly 1 / radius if both chords are equal.
    return {turn, 2 * turn / (length(back) + length(forth))};
}

// Returns the first of the values [begin, end) of a growing array that is not below `bound`, or
// end.
Index first_not_below(Span<const Real> values, Index begin, Index end, Real bound) noexcept {
    while (begin < end) {
        Index const middle = begin + (end - begin) / 2;
        if (values[middle] < bound) begin = middle + 1;
        else end = middle;
    }
    return begin;
}

// next() returns the next point in one direction, without points that only divide a facet: with
// these points, the ends of the facet would look like corners.
struct Walk {
    Outline const& outline;
    bool forward;

    Index next(Index point) const noexcept {
        if (point == none) return none;
        Index at = point, flat = 0;
        do {
            at = forward ? outline.ahead(at, window[0]) : outline.behind(at, window[0]);
        } while (at != none && at != point && outline.turn[at] < flat_turn &&
                 flat++ < max_flat_points);
        return at;
    }
    Real turn(Index point) const noexcept { return point == none ? 0 : outline.turn[point]; }
};

// Returns whether `turn` is larger than can be expected from the next two turns. On rounded leading
// edges, turns grow up to fourfold from point to point. If the next turn is far larger than that,
// the outline has a kink beside this point, and is not round.
bool stands_out(Real turn, Real next, Real after) noexcept {
    constexpr Real excess = 2.5, max_growth = 4;
    bool const is_kink = next > excess * max_growth * after;
    Real const growth = is_kink     ? 1
                        : after > 0 ? clamp(next / after, Real(1), max_growth)
                                    : max_growth;
    return turn > excess * growth * next;
}

struct OutlineSide {
    bool is_smooth = false;
    // The next point is as sharp, which makes it the other end of a base if its far side is smooth.
    bool has_partner = false;
};

OutlineSide look(Walk const& walk, Index point) noexcept {
    Index const first = walk.next(point);
    Index const second = walk.next(first);
    Index const third = walk.next(second);
    Real const turn = walk.turn(point);
    if (walk.turn(first) < 0.5 * turn)
        return {stands_out(turn, walk.turn(first), walk.turn(second)), false};
    return {stands_out(walk.turn(first), walk.turn(second), walk.turn(third)), true};
}

// Within one short window, only the sharpest point can be a corner; if several are equally sharp,
// only the first.
bool is_sharpest(Outline const& outline, Index point, bool forward) noexcept {
    Index const n = outline.count();
    Index const limit = Walk{outline, forward}.next(point);
    for (Index other = point;;) {
        other += forward ? 1 : -1;
        if (outline.is_loop) other = other < 0 ? n - 1 : other == n ? 0 : other;
        if (other < 0 || other == n || other == limit || other == point) return true;
        if (outline.turn[other] > outline.turn[point]) return false;
        if (!forward && outline.turn[other] == outline.turn[point]) return false;
    }
}

bool is_corner(Outline const& outline, Index point) noexcept {
    if (outline.turn[point] < min_corner_turn) return false;
    if (!is_sharpest(outline, point, true) || !is_sharpest(outline, point, false)) return false;
    OutlineSide const back = look({outline, false}, point);
    OutlineSide const forth = look({outline, true}, point);
    return back.is_smooth && forth.is_smooth && !(back.has_partner && forth.has_partner);
}

}  // namespace

void Outline::lay_out(Arena& arena, Index n) noexcept {
    arena.take(arc, static_cast<Offset>(n) + 1);
    arena.take(turn, n);
    arena.take(curvature, n);
}

void Outline::measure() noexcept {
    Index const n = count();
    arc[0] = 0;
    for (Index k = 0; k < n; ++k) {
        bool const is_last = k + 1 == n;
        arc[k + 1] =
            arc[k] + (is_last && !is_loop ? 0 : length(points[is_last ? 0 : k + 1] - points[k]));
    }
    for (Index k = 0; k < n; ++k) {
        turn[k] = curvature[k] = infinity;
        for (Real const reach : window) {
            OutlineBend const bend = bend_at(*this, k, reach);
            turn[k] = min(turn[k], bend.turn);
            curvature[k] = min(curvature[k], bend.curvature);
        }
        if (turn[k] == infinity) turn[k] = curvature[k] = 0;
    }
}

Index Outline::ahead(Index point, Real reach) const noexcept {
    Index const n = count();
    Real const target = arc[point] + reach;
    Index const last = is_loop ? n : n - 1;
    Index const found = first_not_below(arc, point + 1, last + 1, target);
    if (found <= last) return found == n ? 0 : found;
    return is_loop ? first_not_below(arc, 0, point, target - arc[n]) : none;
}

Index Outline::behind(Index point, Real reach) const noexcept {
    Index const n = count();
    Real const target = arc[point] - reach;
    // The last value that is not above the target precedes the first one that is above; arc lengths
    // grow strictly, except for rounding.
    Index found = first_not_below(arc, 0, point, target);
    if (found < point && arc[found] == target) return found;
    if (found > 0) return found - 1;
    if (!is_loop) return none;
    found = first_not_below(arc, point, n, target + arc[n]);
    return found - 1;
}

Index find_corners(Outline const& outline, Span<Index> corner) noexcept {
    Index n = 0;
    for (Index k = 0; k < outline.count(); ++k)
        if (is_corner(outline, k)) corner[n++] = k;
    return n;
}

bool is_straight_side(Outline const& outline, Index from, Index to, Real longest) noexcept {
    Vec2 const start = outline.points[from];
    Vec2 const along = outline.points[to] - start;
    Real const gap = length(along);
    if (from == to || gap > longest) return false;
    Index const n = outline.count();
    Real walked = 0;
    for (Index k = from; k != to;) {
        Index const next = k + 1 == n ? 0 : k + 1;
        walked += length(outline.points[next] - outline.points[k]);
        Real const off = abs(cross(along, outline.points[next] - start)) / gap;
        if (off > side_straightness * gap + coordinate_noise ||
            walked > 1.1 * gap + coordinate_noise)
            return false;
        k = next;
    }
    return true;
}

}  // namespace harmorph
