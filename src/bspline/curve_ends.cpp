#include "bspline/curve_ends.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

// Directions are taken over several lengths, and the smallest turning counts. A corner changes the
// direction over all lengths. The zigzag of coordinates with few digits changes it over short
// lengths only, and a round arc or a corner nearby over long lengths only.
constexpr Real window[] = {2e-5, 5e-4, 1e-2};

constexpr Real min_corner_turning = 0.087;  // 5 degrees
constexpr Real side_straightness = 0.02;    // as a fraction of the length of the side
constexpr Real coordinate_noise = 2e-6;     // the precision of coordinates with six digits
// A point with a smaller turning divides a straight facet; more than max_flat_points of them in a
// row are a straight side.
constexpr Real flat_turning = 1e-4;
constexpr Index max_flat_points = 3;

Vec2 direction_of(Vec2 a) noexcept { return (1 / length(a)) * a; }

struct OutlineBend {
    Real turning = 0;
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
    Real const turning = length(direction_of(forth) - direction_of(back));
    // On a circle the curvature is exactly 1 / radius if both chords are equal.
    return {turning, 2 * turning / (length(back) + length(forth))};
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
        } while (at != none && at != point && outline.turning[at] < flat_turning &&
                 flat++ < max_flat_points);
        return at;
    }
    Real turning(Index point) const noexcept { return point == none ? 0 : outline.turning[point]; }
};

// Returns whether `turning` is larger than can be expected from the next two points. On rounded
// leading edges, values grow up to fourfold from point to point. If the next turning is far larger
// than that, the outline has a kink beside this point, and is not round.
bool stands_out(Real turning, Real next, Real after) noexcept {
    constexpr Real excess = 2.5, max_growth = 4;
    bool const is_kink = next > excess * max_growth * after;
    Real const growth = is_kink     ? 1
                        : after > 0 ? clamp(next / after, Real(1), max_growth)
                                    : max_growth;
    return turning > excess * growth * next;
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
    Real const turning = walk.turning(point);
    if (walk.turning(first) < 0.5 * turning)
        return {stands_out(turning, walk.turning(first), walk.turning(second)), false};
    return {stands_out(walk.turning(first), walk.turning(second), walk.turning(third)), true};
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
        if (outline.turning[other] > outline.turning[point]) return false;
        if (!forward && outline.turning[other] == outline.turning[point]) return false;
    }
}

bool is_corner(Outline const& outline, Index point) noexcept {
    if (outline.turning[point] < min_corner_turning) return false;
    if (!is_sharpest(outline, point, true) || !is_sharpest(outline, point, false)) return false;
    OutlineSide const back = look({outline, false}, point);
    OutlineSide const forth = look({outline, true}, point);
    return back.is_smooth && forth.is_smooth && !(back.has_partner && forth.has_partner);
}

}  // namespace

void Outline::lay_out(Arena& arena, Index n) noexcept {
    arena.take(arc, static_cast<Offset>(n) + 1);
    arena.take(turning, n);
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
        turning[k] = curvature[k] = infinity;
        for (Real const reach : window) {
            OutlineBend const bend = bend_at(*this, k, reach);
            turning[k] = min(turning[k], bend.turning);
            curvature[k] = min(curvature[k], bend.curvature);
        }
        if (turning[k] == infinity) turning[k] = curvature[k] = 0;
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

namespace {

// A base is at most as long as a body with this thickness allows; a facet is short.
constexpr Real max_base = 0.6, max_facet = 0.15;
// The directions before and after a base differ by an angle whose cosine is below this, so wedges
// up to 45 degrees have bases, and with a base longer than a facet wedges up to 80 degrees.
constexpr Real cosine_of_return = -0.7, cosine_of_wide_return = -0.17;
// The outline bends by at least 25 degrees at both ends of a base. A side with a smaller turning at
// one end is the last panel before a trailing edge of one point.
constexpr Real cosine_of_least_turning = 0.9063;
// The smallest distance of a base from the leading edge, as a fraction of the chord.
constexpr Real min_base_distance = 0.95;
constexpr Real blunt_turning = 1;  // 2 sin(angle / 2) for 60 degrees
// If the outline widens by more than 45 degrees within max_horn_length of the extent beside a
// straight side, the body begins there, and the straight side is the end of a horn or lip.
constexpr Real cosine_of_widening = 0.7, max_horn_length = 0.25, direction_reach = 0.01;
// An edge with a turning above sharp_turning, an interior angle below 36 degrees, is sharp. A
// leading edge with few points bends further at the two points beside a facet, by more than
// min_turning_beside.
constexpr Real sharp_turning = 1.9, min_turning_beside = 0.1;

// Returns one of the points whose turning is the largest, within the fraction `tie`: the point
// farthest from the centroid (the origin), and among several such points the one nearest to either
// end of the list. Rounding, rotation and reversal of the outline therefore do not change the
// choice.
template <class Candidates>
Index sharpest_of(Outline const& outline, Candidates const& candidates, Index n,
                  Real tie) noexcept {
    Real turning = 0;
    for (Index j = 0; j < n; ++j) turning = max(turning, outline.turning[candidates(j)]);
    turning *= 1 - tie;
    Real distance = 0;
    for (Index j = 0; j < n; ++j)
        if (outline.turning[candidates(j)] >= turning)
            distance = max(distance, length(outline.points[candidates(j)]));
    distance *= 1 - 1e-9;
    Index best = none;
    auto const from_ends = [&](Index k) { return min(k, outline.count() - 1 - k); };
    for (Index j = 0; j < n; ++j) {
        Index const k = candidates(j);
        if (outline.turning[k] < turning || length(outline.points[k]) < distance) continue;
        if (best == none || from_ends(k) < from_ends(best)) best = k;
    }
    return best;
}

Index sharpest_point(Outline const& outline, Span<const Index> corner) noexcept {
    if (corner.empty())
        return sharpest_of(
            outline, [](Index j) { return j; }, outline.count(), 0.02);
    return sharpest_of(
        outline, [&](Index j) { return corner[j]; }, corner.count(), 1e-6);
}

Index following(Span<const Index> corner, Index j) noexcept {
    return corner[j + 1 == corner.count() ? 0 : j + 1];
}

Index farthest_from(Outline const& outline, Vec2 from) noexcept {
    Index farthest = 0;
    Real largest = 0;
    for (Index k = 0; k < outline.count(); ++k) {
        Real const squared = square(outline.points[k] - from);
        if (!(squared > largest)) continue;
        largest = squared;
        farthest = k;
    }
    return farthest;
}

// Returns whether the outline reverses its direction at this side, and bends at both ends.
// Directions are taken over the length of the side.
bool comes_back(Outline const& outline, Index from, Index to) noexcept {
    Vec2 const side = outline.points[to] - outline.points[from];
    Real const reach = length(side);
    Vec2 const in = outline.points[from] - outline.points[outline.behind(from, reach)];
    Vec2 const out = outline.points[outline.ahead(to, reach)] - outline.points[to];
    Real const limit = reach > max_facet ? cosine_of_wide_return : cosine_of_return;
    return dot(in, out) < limit * length(in) * length(out) &&
           dot(in, side) < cosine_of_least_turning * length(in) * reach &&
           dot(side, out) < cosine_of_least_turning * reach * length(out);
}

// Returns whether the outline bends away from the body on the side that begins at `end`, one end of
// a base; the other end is `start`.
bool widens(Outline const& outline, Index start, Index end, bool forward) noexcept {
    auto const next = [&](Index point, Real reach) {
        return forward ? outline.ahead(point, reach) : outline.behind(point, reach);
    };
    Vec2 const base = outline.points[end] - outline.points[start];
    Vec2 const away = outline.points[next(end, length(base))] - outline.points[end];
    Real const inwards = cross(base, away);
    Real walked = 0;
    for (Index k = end; walked < max_horn_length;) {
        Index const after = next(k, direction_reach);
        Vec2 const direction = outline.points[after] - outline.points[k];
        Real const turning = dot(away, direction);
        if (cross(away, direction) * inwards < 0 &&
            turning < cosine_of_widening * length(away) * length(direction))
            return true;
        walked += max(length(direction), direction_reach);
        k = after;
    }
    return false;
}

// Returns whether a short straight side is a facet of a leading edge with few points: the other end
// of the section is a sharp edge, and the outline beside the facet is round.
bool is_leading_edge_facet(Outline const& outline, Index from, Index to) noexcept {
    Index const last = outline.count() - 1;
    Index const before = from == 0 ? last : from - 1, after = to == last ? 0 : to + 1;
    Vec2 const middle = 0.5 * (outline.points[from] + outline.points[to]);
    return outline.turning[farthest_from(outline, middle)] > sharp_turning &&
           outline.turning[before] + outline.turning[after] > min_turning_beside;
}

bool is_base(Outline const& outline, Index from, Index to) noexcept {
    if (!is_straight_side(outline, from, to, max_base) || !comes_back(outline, from, to))
        return false;
    if (widens(outline, from, to, true) || widens(outline, to, from, false)) return false;
    if (is_leading_edge_facet(outline, from, to)) return false;
    Vec2 const begin = outline.points[from], end = outline.points[to];
    Vec2 const leading_edge = outline.points[farthest_from(outline, 0.5 * (begin + end))];
    Real const chord = length(outline.points[farthest_from(outline, leading_edge)] - leading_edge);
    return max(length(begin - leading_edge), length(end - leading_edge)) >
           min_base_distance * chord;
}

// Returns the corner at which a base begins, or none if there is no base or if both ends of the
// body have one. If there are several at one end, as in a step, the shortest is returned.
Index find_base(Outline const& outline, Span<const Index> corner) noexcept {
    auto const middle = [&](Index j) {
        return 0.5 * (outline.points[corner[j]] + outline.points[following(corner, j)]);
    };
    Index found = none;
    Real shortest = infinity;
    for (Index j = 0; j < corner.count(); ++j) {
        if (!is_base(outline, corner[j], following(corner, j))) continue;
        if (found != none && length(middle(j) - middle(found)) > 0.5) return none;
        Real const gap = length(outline.points[following(corner, j)] - outline.points[corner[j]]);
        if (gap >= shortest) continue;
        shortest = gap;
        found = j;
    }
    return found;
}

void remove(Span<Index> list, Index n, Index at) noexcept {
    for (Index j = at; j + 1 < n; ++j) list[j] = list[j + 1];
}

}  // namespace

Course choose_course(Outline const& outline, Span<const Index> corner, Closure wanted) noexcept {
    Index const n = outline.count();
    if (!outline.is_loop || wanted == Closure::open) return {Closure::open, 0, n, 0};
    if (wanted != Closure::automatic) return {wanted, sharpest_point(outline, corner), n + 1, 0};
    Index const base = find_base(outline, corner);
    if (base != none) {
        Index const from = corner[base], to = following(corner, base);
        Index const base_points = (to < from ? to + (n - from) : to - from) + 1;
        return {Closure::open, to, n - base_points + 2, base_points};
    }
    Index const first = sharpest_point(outline, corner);
    return {corner.empty() ? Closure::periodic : Closure::tied, first, n + 1, 0};
}

Index drop_facets(Outline const& outline, Span<Index> corner, Index n) noexcept {
    auto const is_facet = [&](Index from, Index to) {
        if (!is_straight_side(outline, from, to, max_facet)) return false;
        if (is_leading_edge_facet(outline, from, to)) return true;
        return outline.turning[from] < blunt_turning && outline.turning[to] < blunt_turning &&
               !is_base(outline, from, to);
    };
    if (!outline.is_loop || n < 2) return n;
    bool const round_the_end = is_facet(corner[n - 1], corner[0]);
    Index kept = 0;
    bool drops = round_the_end;  // whether the current corner ends a facet
    for (Index j = 0; j < n; ++j) {
        bool const begins = j + 1 < n ? is_facet(corner[j], corner[j + 1]) : round_the_end;
        if (!drops && !begins) corner[kept++] = corner[j];
        drops = begins;
    }
    return kept;
}

Index corners_on(Course const& course, Outline const& outline, Span<Index> corner,
                 Index max_corners) noexcept {
    Index const n = outline.count();
    Index kept = 0;
    for (Index const point : corner) {
        Index const position =
            point < course.first ? point + (n - course.first) : point - course.first;
        bool const inside = position > 0 && position + 1 < course.n_positions;
        if (inside && course.closure != Closure::periodic) corner[kept++] = position;
    }
    auto const turning = [&](Index j) {
        Index const position = corner[j];
        return outline.turning[position < n - course.first ? course.first + position
                                                           : position - (n - course.first)];
    };
    for (; kept > max_corners; --kept) {
        Index bluntest = 0;
        for (Index j = 1; j < kept; ++j)
            if (turning(j) < turning(bluntest)) bluntest = j;
        remove(corner, kept, bluntest);
    }
    sort_by_insertion(corner.first(kept), [](Index a, Index b) { return a < b; });
    return kept;
}

}  // namespace harmorph
