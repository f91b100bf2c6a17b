// Finds monotone parameters for points in order along a curve: project_chain() of projection.hpp.
// tests/bspline/test_project_chain.cpp covers this file.
#include "base/longest_monotone.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

// An order of the points in which their parameters should not decrease: position k is the point
// (start + step * k) mod n; step is 1 or -1.
struct Direction {
    Index n = 0;
    Index start = 0;
    Index step = 1;

    Index point(Index k) const noexcept {
        Offset const p = static_cast<Offset>(start) + static_cast<Offset>(step) * k;
        return static_cast<Index>(p < 0 ? p + n : p >= n ? p - n : p);
    }
};

struct Chain {
    Curve const& curve;
    Span<const Vec2> points;
    ChainWork const& work;
    Span<Real> u;

    void project_each() const noexcept;
    Index nearest_to_seam() const noexcept;
    Index run_length(Direction const& direction) const noexcept;
    void take_longer(Direction const& candidate, Direction& best, Index& length) const noexcept;
    void try_largest_falls(Index step, Direction& best, Index& length) const noexcept;
    void fill_between(Direction const& direction, Index first, Index last, Real low,
                      Real high) const noexcept;
    void make_monotone(Direction const& direction) const noexcept;
};

void Chain::project_each() const noexcept {
    Projector projector(curve);
    Real hint = curve.begin();
    for (Index k = 0; k < points.count(); ++k) {
        hint = projector.nearest(points[k], curve.begin(), curve.end(), hint).u;
        work.trial[k] = hint;
    }
}

Index Chain::nearest_to_seam() const noexcept {
    Vec2 const seam = curve_point(curve, curve.begin());
    Index nearest = 0;
    for (Index k = 1; k < points.count(); ++k)
        if (square(points[k] - seam) < square(points[nearest] - seam)) nearest = k;
    return nearest;
}

// Returns the length of the longest non-decreasing subsequence, whose positions are in work.run
// afterwards.
Index Chain::run_length(Direction const& direction) const noexcept {
    for (Index k = 0; k < direction.n; ++k) work.ordered[k] = work.trial[direction.point(k)];
    return longest_run(work.ordered.first(direction.n), work.previous, work.run);
}

void Chain::take_longer(Direction const& candidate, Direction& best, Index& length) const noexcept {
    Index const found = run_length(candidate);
    if (found <= length) return;
    length = found;
    best = candidate;
}

// The points pass the seam where the parameter falls from about end() to about begin(). At a wrong
// projection it may fall nearly as far, so the largest falls are tried one after the other.
void Chain::try_largest_falls(Index step, Direction& best, Index& length) const noexcept {
    constexpr Index n_tried = 4;
    Index const n = points.count();
    Index start[n_tried];
    Real fall[n_tried] = {};
    for (Index k = 0; k < n; ++k) {
        Index const before = Direction{n, k, -step}.point(1);
        Real found = work.trial[before] - work.trial[k];
        Index at = k;
        for (Index j = 0; j < n_tried; ++j) {
            if (!(found > fall[j])) continue;
            Real const passed_fall = fall[j];
            Index const passed = start[j];
            fall[j] = found;
            start[j] = at;
            found = passed_fall;
            at = passed;
        }
    }
    for (Index j = 0; j < n_tried && fall[j] > 0; ++j)
        take_longer({n, start[j], step}, best, length);
}

// Projects the positions first .. last - 1 into the range low .. high: first the middle position,
// then those on either side of it.
void Chain::fill_between(Direction const& direction, Index first, Index last, Real low,
                         Real high) const noexcept {
    while (first < last) {
        Index const middle = first + (last - first) / 2;
        Index const point = direction.point(middle);
        u[point] = project(curve, points[point], low, high).u;
        fill_between(direction, first, middle, low, u[point]);
        first = middle + 1;
        low = u[point];
    }
}

void Chain::make_monotone(Direction const& direction) const noexcept {
    Index const length = run_length(direction);
    Index filled = 0;
    Real low = curve.begin();
    for (Index l = 0; l < length; ++l) {
        Index const position = work.run[l];
        Index const point = direction.point(position);
        u[point] = work.trial[point];
        fill_between(direction, filled, position, low, u[point]);
        filled = position + 1;
        low = u[point];
    }
    fill_between(direction, filled, direction.n, low, curve.end());
}

}  // namespace

void ChainWork::lay_out(Arena& arena, Index n) noexcept {
    arena.take(previous, n);
    arena.take(run, n);
    arena.take(trial, n);
    arena.take(ordered, n);
}

Real project_chain(Curve const& curve, Span<const Vec2> points, bool is_loop, ChainWork const& work,
                   Span<Real> u) noexcept {
    Index const n = points.count();
    if (n == 0) return 0;
    Chain const chain{curve, points, work, u};
    bool const closed = is_closed(curve);
    chain.project_each();

    Direction best{n, 0, 1};
    Index length = 0;
    if (is_loop && closed && !is_periodic(curve)) {
        Index const tied = chain.nearest_to_seam();
        work.trial[tied] = curve.begin();
        chain.take_longer({n, tied, 1}, best, length);
        chain.take_longer({n, tied, -1}, best, length);
    } else {
        chain.take_longer({n, 0, 1}, best, length);
        chain.take_longer({n, n - 1, -1}, best, length);
        if (is_loop || closed) {
            chain.try_largest_falls(1, best, length);
            chain.try_largest_falls(-1, best, length);
        }
    }
    chain.make_monotone(best);

    Real sum = 0;
    for (Index k = 0; k < n; ++k) sum += square(curve_point(curve, u[k]) - points[k]);
    return sum;
}

}  // namespace harmorph
