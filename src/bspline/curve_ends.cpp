#include "harmorph/bspline/curve_ends.hpp"

namespace harmorph {
namespace {

// Of the points that turn within `tie` of the most, those farthest from the centroid (the origin), of these the one nearest
// to either end of the list: rounding, turning and reversing the outline shall not change the choice.
template <class Candidates>
Index sharpest_of(Outline const& outline, Candidates const& candidates, Index n, Real tie) noexcept {
    Real turn = 0;
    for (Index j = 0; j < n; ++j) turn = larger(turn, outline.turn[candidates(j)]);
    turn *= 1 - tie;
    Real distance = 0;
    for (Index j = 0; j < n; ++j)
        if (outline.turn[candidates(j)] >= turn) distance = larger(distance, length(outline.points[candidates(j)]));
    distance *= 1 - 1e-9;
    Index best = none;
    auto const from_ends = [&](Index k) { return smaller(k, outline.count() - 1 - k); };
    for (Index j = 0; j < n; ++j) {
        Index const k = candidates(j);
        if (outline.turn[k] < turn || length(outline.points[k]) < distance) continue;
        if (best == none || from_ends(k) < from_ends(best)) best = k;
    }
    return best;
}

Index sharpest_point(Outline const& outline, Span<const Index> corner) noexcept {
    if (corner.empty()) return sharpest_of(outline, [](Index j) { return j; }, outline.count(), 0.02);
    return sharpest_of(outline, [&](Index j) { return corner[j]; }, corner.count(), 1e-6);
}

// Round a loop, from a corner to the next one: the shortest straight piece, or none.
Index find_base(Outline const& outline, Span<const Index> corner) noexcept {
    Index found = none;
    Real shortest = infinity;
    for (Index j = 0; j < corner.count(); ++j) {
        Index const from = corner[j];
        Index const to = corner[j + 1 == corner.count() ? 0 : j + 1];
        Real const gap = length(outline.points[to] - outline.points[from]);
        if (gap >= shortest || !is_base(outline, from, to)) continue;
        shortest = gap;
        found = j;
    }
    return found;
}

void remove(Span<Index> list, Index n, Index at) noexcept {
    for (Index j = at; j + 1 < n; ++j) list[j] = list[j + 1];
}

void sort_ascending(Span<Index> list, Index n) noexcept {  // a few corners, nearly in order
    for (Index j = 1; j < n; ++j)
        for (Index i = j; i > 0 && list[i] < list[i - 1]; --i) {
            Index const larger_one = list[i - 1];
            list[i - 1] = list[i];
            list[i] = larger_one;
        }
}

}  // namespace

Course choose_course(Outline const& outline, Span<const Index> corner, Closure wanted) noexcept {
    Index const n = outline.count();
    if (!outline.is_loop || wanted == Closure::open) return {Closure::open, 0, n, 0};
    if (wanted == Closure::automatic) {
        Index const base = find_base(outline, corner);
        if (base != none) {
            Index const from = corner[base];
            Index const to = corner[base + 1 == corner.count() ? 0 : base + 1];
            Index const base_points = (to < from ? to + (n - from) : to - from) + 1;
            return {Closure::open, to, n - base_points + 2, base_points};
        }
        wanted = corner.empty() ? Closure::periodic : Closure::tied;
    }
    return {wanted, sharpest_point(outline, corner), n + 1, 0};
}

Index corners_on(Course const& course, Outline const& outline, Span<Index> corner, Index most) noexcept {
    Index const n = outline.count();
    Index kept = 0;
    for (Index const point : corner) {
        Index const position = point < course.first ? point + (n - course.first) : point - course.first;
        bool const inside = position > 0 && position + 1 < course.n_positions;
        if (inside && course.closure != Closure::periodic) corner[kept++] = position;
    }
    auto const turn = [&](Index j) {
        Index const position = corner[j];
        return outline.turn[position < n - course.first ? course.first + position : position - (n - course.first)];
    };
    for (; kept > most; --kept) {
        Index bluntest = 0;
        for (Index j = 1; j < kept; ++j)
            if (turn(j) < turn(bluntest)) bluntest = j;
        remove(corner, kept, bluntest);
    }
    sort_ascending(corner, kept);
    return kept;
}

}  // namespace harmorph
