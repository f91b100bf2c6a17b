#include "bspline/projection.hpp"

#include "base/vec2.hpp"

namespace harmorph {

Index longest_run(Span<const Real> values, Span<Index> previous, Span<Index> run) noexcept {
    // Among all non-decreasing subsequences of l + 1 values so far, run[l] is the end of the one
    // whose last value is smallest.
    Index length = 0;
    for (Index k = 0; k < values.count(); ++k) {
        Index low = 0;
        Index high = length;
        while (low < high) {
            Index const middle = low + (high - low) / 2;
            if (values[run[middle]] <= values[k]) low = middle + 1;
            else high = middle;
        }
        previous[k] = low > 0 ? run[low - 1] : none;
        run[low] = k;
        if (low == length) ++length;
    }
    for (Index k = length > 0 ? run[length - 1] : none, l = length - 1; k != none;
         k = previous[k], --l)
        run[l] = k;
    return length;
}

namespace {

struct Candidate {
    Real u = 0;
    Real square_distance = infinity;

    void take_nearer(Candidate const& other) noexcept {
        if (other.square_distance < square_distance) *this = other;
    }
};

// Returns a lower bound of the squared distance of a span. The points of the span lie in the convex
// hull of degree + 1 control points, and therefore in their bounding box.
Real box_square_distance(Curve const& curve, Index span, Vec2 q) noexcept {
    Box box;
    for (Index k = span - curve.degree; k <= span; ++k) box.include(curve.point(k));
    return box.squared_distance(q);
}

Real rounding_of(Vec2 q) noexcept { return epsilon * (abs(q.x) + abs(q.y)); }

// Finds the minimum of |C(u) - q| for low <= u <= high in one span, by Newton's method for (C - q)
// . C' = 0 (Piegl & Tiller, equation 6.3). The bracket is bisected if Newton's method leaves the
// bracket or does not halve its step. The last iterate is returned, because it has the smallest
// slope; the distances of two iterates near the minimum differ by less than rounding.
Candidate minimum_between(Curve const& curve, Index span, Vec2 q, Real low, Real high,
                          Real u) noexcept {
    Real step = high - low;
    Real const fine = 2 * epsilon * max(abs(curve.begin()), abs(curve.end()));
    for (Index iteration = 0; iteration < 100; ++iteration) {
        Vec2 c[3];
        curve_point_in(curve, span, u, 2, c);
        Vec2 const offset = c[0] - q;
        Real const slope = dot(offset, c[1]);
        Real const curvature = square(c[1]) + dot(offset, c[2]);
        if (abs(slope) <= rounding_of(q) * length(c[1])) return {u, square(offset)};
        if (slope < 0) low = u;
        else high = u;
        Real next = u - slope / curvature;
        if (!(curvature > 0 && next > low && next < high && abs(next - u) <= 0.5 * abs(step)))
            next = low + 0.5 * (high - low);
        step = next - u;
        u = next;
        if (high - low <= fine || abs(step) <= fine) break;
    }
    Vec2 last;
    curve_point_in(curve, span, u, 0, &last);
    return {u, square(last - q)};
}

// In a span of a curve of degree p, the squared distance is a polynomial of degree 2p, which has at
// most p minima; 4p samples separate them. Each sampled minimum that may be lower than the best one
// is refined.
void search_span(Curve const& curve, SpanSamples const& samples, Vec2 q, Candidate& best) noexcept {
    Index const n = 4 * curve.degree, span = samples.span;
    auto const parameter = [&](Index j) { return samples.parameter(j, n); };
    const Vec2* const point = samples.point;
    Real found[SpanSamples::max_samples];
    for (Index j = 0; j <= n; ++j) found[j] = square(point[j] - q);
    for (Index j = 0; j <= n; ++j) {
        Index const before = j > 0 ? j - 1 : 0;
        Index const after = j < n ? j + 1 : n;
        if (found[before] < found[j] || found[after] < found[j]) continue;
        Real const reach = max(length(point[j] - point[before]), length(point[after] - point[j]));
        Real const nearest = sqrt(found[j]) - reach;
        if (nearest > 0 && nearest * nearest > best.square_distance) continue;
        Candidate const minimum =
            minimum_between(curve, span, q, parameter(before), parameter(after), parameter(j));
        // If the bracket has two minima, the wrong one may be found; the sample is then nearer.
        bool const lost = found[j] < 0.99 * minimum.square_distance;
        best.take_nearer(lost ? Candidate{parameter(j), found[j]} : minimum);
    }
}

}  // namespace

void SpanSamples::take(Curve const& curve, Index new_span, Real new_low, Real new_high) noexcept {
    if (span == new_span && low == new_low && high == new_high) return;
    span = new_span;
    low = new_low;
    high = new_high;
    Index const n = 4 * curve.degree;
    for (Index j = 0; j <= n; ++j) curve_point_in(curve, span, parameter(j, n), 0, &point[j]);
}

Projector::Projector(Curve const& curve) noexcept
    : curve_(curve),
      begin_(curve_point(curve, curve.begin())),
      end_(curve_point(curve, curve.end())) {}

Projection Projector::nearest(Vec2 point, Real low, Real high, Real hint) noexcept {
    low = clamp(low, curve_.begin(), curve_.end());
    high = clamp(high, low, curve_.end());
    // The distance at the hint is an upper bound; it is raised a little so that the minimum beside
    // the hint is taken.
    hint = clamp(hint, low, high);
    Real const bound = length(curve_point(curve_, hint) - point) + 8 * rounding_of(point);
    Candidate best{hint, bound * bound};
    Index const last = knot_span(curve_, high);
    for (Index span = knot_span(curve_, low); span <= last; ++span) {
        Real const a = max(low, curve_.knots[span]);
        Real const b = min(high, curve_.knots[span + 1]);
        if (a < b && box_square_distance(curve_, span, point) < best.square_distance) {
            SpanSamples& samples = recent_[span % n_recent];
            samples.take(curve_, span, a, b);
            search_span(curve_, samples, point, best);
        }
    }
    // A point that coincides with an end of the curve, to rounding, gets the parameter of the end.
    Real const limit = sqrt(best.square_distance) + 8 * rounding_of(point);
    if (low <= curve_.begin() && length(begin_ - point) <= limit) best.u = curve_.begin();
    else if (high >= curve_.end() && length(end_ - point) <= limit) best.u = curve_.end();
    return {best.u, length(curve_point(curve_, best.u) - point)};
}

Projection project(Curve const& curve, Vec2 point, Real low, Real high) noexcept {
    return Projector(curve).nearest(point, low, high, low);
}

bool is_closed(Curve const& curve) noexcept {
    Vec2 const begin = curve_point(curve, curve.begin());
    Vec2 const end = curve_point(curve, curve.end());
    Real magnitude = 0;
    for (Index k = 0; k < curve.n_indices; ++k)
        magnitude = max(magnitude, max(abs(curve.point(k).x), abs(curve.point(k).y)));
    return length(end - begin) <= 16 * epsilon * magnitude;
}

bool is_periodic(Curve const& curve) noexcept {
    if (!is_closed(curve)) return false;
    Vec2 begin[2], end[2];
    curve_point(curve, curve.begin(), 1, begin);
    curve_point(curve, curve.end(), 1, end);
    return abs(cross(begin[1], end[1])) <= 1e-6 * dot(begin[1], end[1]) && square(begin[1]) > 0;
}

TornEnds torn_ends(Curve const& curve) noexcept {
    constexpr Real rounding = 1e-12;  // of the extent
    CurveBasis const begin = curve_basis(curve, curve.begin(), 0),
                     end = curve_basis(curve, curve.end(), 0);
    Box box;
    for (Index k = 0; k < curve.n_indices; ++k) box.include(curve.point(k));
    auto const place = [&](Index control) {
        return Vec2{curve.control[2 * control], curve.control[2 * control + 1]};
    };
    Real const extent = box.extent();
    Vec2 const ends[2] = {curve_point(curve, curve.begin()), curve_point(curve, curve.end())};
    if (!(length(ends[1] - ends[0]) <= rounding * extent)) return {};
    for (Index k = 0; k < begin.order; ++k) {
        for (Index j = 0; j < end.order; ++j) {
            Index const first = begin.control[k], last = end.control[j];
            bool const both_move =
                abs(begin.value[0][k]) > rounding && abs(end.value[0][j]) > rounding;
            if (both_move && first != last &&
                length(place(last) - place(first)) <= rounding * extent)
                return {first, last};
        }
    }
    return {};
}

// Finds monotone parameters for points in order along a curve: project_chain() of projection.hpp.

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
