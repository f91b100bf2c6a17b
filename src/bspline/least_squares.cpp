#include "bspline/least_squares.hpp"

#include "base/vec2.hpp"
#include "bspline/quadrature.hpp"

namespace harmorph {
namespace {

// Second differences of control points are minimised with this weight, which is far below that of
// the points and above rounding, so that control points are determined even if the points do not
// determine them.
constexpr Real smoothing = 1e-12;

// Second differences couple a control point with two others on either side.
Index bandwidth(Index degree) noexcept { return 2 * max(degree, Index(2)) + 1; }

struct SymmetricBlock {
    Real xx = 0, xy = 0, yy = 0;
};

SymmetricBlock operator*(Real s, SymmetricBlock a) noexcept {
    return {s * a.xx, s * a.xy, s * a.yy};
}
Vec2 operator*(SymmetricBlock a, Vec2 p) noexcept {
    return {a.xx * p.x + a.xy * p.y, a.xy * p.x + a.yy * p.y};
}

constexpr SymmetricBlock unit{1, 0, 1};

// Returns the quadratic form of the squared distance from a line with this tangent, plus `along`
// times the squared component along the line.
SymmetricBlock metric(Vec2 tangent, Real along) noexcept {
    Real const less = 1 - along;
    return {1 - less * tangent.x * tangent.x, -less * tangent.x * tangent.y,
            1 - less * tangent.y * tangent.y};
}

void add_to_right(LeastSquares const& fit, Index i, Vec2 value) noexcept {
    fit.control[2 * i] += value.x;
    fit.control[2 * i + 1] += value.y;
}

// Adds a product of two basis functions to the equations. The position of a pinned control point is
// known, so its products go to the right-hand side.
void add_product(LeastSquares const& fit, Index i, Index j, SymmetricBlock const& a) noexcept {
    if (fit.pinned[i] != none) return;
    if (fit.pinned[j] != none) return add_to_right(fit, i, -1.0 * (a * fit.points[fit.pinned[j]]));
    if (j > i) return;
    fit.matrix.add(2 * i, 2 * j, a.xx);
    fit.matrix.add(2 * i + 1, 2 * j, a.xy);
    fit.matrix.add(2 * i + 1, 2 * j + 1, a.yy);
    if (j < i) fit.matrix.add(2 * i, 2 * j + 1, a.xy);
}

void add_points(LeastSquares const& fit, Real along) noexcept {
    for (Index k = 0; k < fit.points.count(); ++k) {
        CurveBasis const basis = curve_basis(fit.curve, fit.u[k], 0);
        SymmetricBlock const weight = fit.weight[k] * metric(fit.tangent[k], along);
        Vec2 const pull = weight * fit.points[k];
        for (Index a = 0; a < basis.order; ++a) {
            add_to_right(fit, basis.control[a], basis.value[0][a] * pull);
            for (Index b = 0; b < basis.order; ++b)
                add_product(fit, basis.control[a], basis.control[b],
                            basis.value[0][a] * basis.value[0][b] * weight);
        }
    }
}

// Returns the Greville abscissa: the parameter at which a linear function has the value of its
// control point.
Real greville(Curve const& curve, Index k) noexcept {
    Real sum = 0;
    for (Index j = 1; j <= curve.degree; ++j) sum += curve.knots[k + j];
    return sum / curve.degree;
}

// Adds second differences with respect to the Greville abscissae, which are 0 for a straight line
// with constant speed.
void add_smoothing(LeastSquares const& fit, Real strength) noexcept {
    Curve const& curve = fit.curve;
    for (Index k = 1; k + 1 < curve.n_indices; ++k) {
        Real const before = greville(curve, k) - greville(curve, k - 1);
        Real const after = greville(curve, k + 1) - greville(curve, k);
        Real const factor[3] = {after / (before + after), -1, before / (before + after)};
        for (Index a = 0; a < 3; ++a)
            for (Index b = 0; b < 3; ++b)
                add_product(fit, curve.control_point(k - 1 + a), curve.control_point(k - 1 + b),
                            strength * factor[a] * factor[b] * unit);
    }
}

void add_bending(LeastSquares const& fit) noexcept {
    Curve const& curve = fit.curve;
    for (Index span = curve.degree; span < curve.n_indices; ++span) {
        if (!(curve.knots[span] < curve.knots[span + 1])) continue;
        Gauss10::for_each(curve.knots[span], curve.knots[span + 1], [&](Real u, Real weight) {
            CurveBasis const basis = curve_basis_in(curve, span, u, 2);
            for (Index a = 0; a < basis.order; ++a)
                for (Index b = 0; b < basis.order; ++b)
                    add_product(
                        fit, basis.control[a], basis.control[b],
                        fit.bending * weight * basis.value[2][a] * basis.value[2][b] * unit);
        });
    }
}

// Makes one step of Newton's method for the parameter of each point, except the first and the last.
// `error` becomes the distances before the step.
void step_to_feet(LeastSquares const& fit) noexcept {
    Index const last = fit.points.count() - 1;
    for (Index k = 0; k <= last; ++k) {
        Vec2 c[3];
        curve_point(fit.curve, fit.u[k], 2, c);
        Vec2 const offset = c[0] - fit.points[k];
        fit.error[k] = length(offset);
        Real const speed = square(c[1]);
        fit.tangent[k] = speed > 0 ? (1 / sqrt(speed)) * c[1] : Vec2{};
        // The bound avoids steps towards a maximum of the distance, far from the curve.
        Real const curvature = max(speed + dot(offset, c[2]), 0.5 * speed);
        if (k == 0 || k == last || !(curvature > 0)) continue;
        fit.u[k] = clamp(fit.u[k] - dot(offset, c[1]) / curvature, fit.u[0], fit.u[last]);
    }
}

// Restores the order of the parameters: each becomes the mean of the largest parameter up to the
// point and the smallest one from the point on. Both do not decrease, and the mean does not depend
// on the direction of the curve.
void put_in_order(LeastSquares const& fit) noexcept {
    Index const n = fit.points.count();
    for (Index k = 0; k < n; ++k) {
        fit.largest_so_far[k] = k == 0 ? fit.u[0] : max(fit.largest_so_far[k - 1], fit.u[k]);
    }
    Real smallest = fit.u[n - 1];
    for (Index k = n - 1; k >= 0; --k) {
        smallest = min(smallest, fit.u[k]);
        fit.u[k] = 0.5 * (fit.largest_so_far[k] + smallest);
    }
}

void pin(LeastSquares const& fit) noexcept {
    for (Index i = 0; i < fit.pinned.count(); ++i) {
        if (fit.pinned[i] == none) continue;
        fit.matrix.at(2 * i, 2 * i) = fit.matrix.at(2 * i + 1, 2 * i + 1) = 1;
        fit.control[2 * i] = fit.points[fit.pinned[i]].x;
        fit.control[2 * i + 1] = fit.points[fit.pinned[i]].y;
    }
}

// The control points at an end of the curve and beside this end.
struct CurveEnd {
    Index at, beside;

    CurveEnd(Curve const& curve, Index end) noexcept
        : at(curve.control_point(end == 0 ? 0 : curve.n_indices - 1)),
          beside(curve.control_point(end == 0 ? 1 : curve.n_indices - 2)) {}
};

// Returns the distance from the control point at an end to its neighbour at which the curve has a
// third of the speed of the points there.
Real min_length(LeastSquares const& fit, Index end) noexcept {
    Curve const& curve = fit.curve;
    const Real* const knots = curve.knots + (end == 0 ? 1 : curve.n_indices - 1);
    return fit.speed * (knots[curve.degree] - knots[0]) / (3 * curve.degree);
}

// Makes an unknown known. Entries outside the envelope are 0.
void fix_unknown(LeastSquares const& fit, Index row, Real value) noexcept {
    EnvelopeMatrix const& matrix = fit.matrix;
    for (Index k = 0; k < matrix.count(); ++k) {
        Index const low = min(row, k), high = max(row, k);
        if (matrix.first_column(high) > low) continue;
        Real& entry = matrix.at(high, low);
        fit.control[k] -= value * entry;
        entry = k == row ? 1 : 0;
    }
    fit.control[row] = value;
}

// The control point beside an end becomes s t + c n, with the tangent t, the normal n, and the
// number c of the control point at the end, which is pinned. Its unknowns are then s and c.
void hold_tangent(LeastSquares const& fit, Index end) noexcept {
    Vec2 const t = fit.direction[end], n = left_of(t);
    CurveEnd const ends(fit.curve, end);
    Vec2 const at = fit.points[fit.pinned[ends.at]];
    Index const row = 2 * ends.beside;
    EnvelopeMatrix const& matrix = fit.matrix;
    for (Index k = 0; k < matrix.count(); ++k) {
        if (k == row || k == row + 1) continue;
        bool const couples =
            k < row ? matrix.first_column(row + 1) <= k : matrix.first_column(k) <= row;
        if (!couples) continue;
        Real& by_x = k < row ? matrix.at(row, k) : matrix.at(k, row);
        Real& by_y = k < row ? matrix.at(row + 1, k) : matrix.at(k, row + 1);
        Vec2 const pair{by_x, by_y};
        by_x = dot(pair, t);
        by_y = dot(pair, n);
    }
    SymmetricBlock const own{matrix.at(row, row), matrix.at(row + 1, row),
                             matrix.at(row + 1, row + 1)};
    Vec2 const right{fit.control[row], fit.control[row + 1]};
    matrix.at(row, row) = dot(t, own * t);
    matrix.at(row + 1, row) = dot(t, own * n);
    matrix.at(row + 1, row + 1) = dot(n, own * n);
    fit.control[row] = dot(right, t);
    fit.control[row + 1] = dot(right, n);
    fix_unknown(fit, row + 1, dot(at, n));
    if (!fit.has_min_speed[end]) return;
    fix_unknown(fit, row, dot(at, t) + (end == 0 ? 1 : -1) * min_length(fit, end));
}

void place_beside_end(LeastSquares const& fit, Index end) noexcept {
    Vec2 const t = fit.direction[end];
    Index const row = 2 * CurveEnd(fit.curve, end).beside;
    Vec2 const place = fit.control[row] * t + fit.control[row + 1] * left_of(t);
    fit.control[row] = place.x;
    fit.control[row + 1] = place.y;
}

// Returns whether an end is slower than it may be.
bool is_too_slow(LeastSquares const& fit, Index end) noexcept {
    CurveEnd const ends(fit.curve, end);
    Vec2 const to{fit.control[2 * ends.beside], fit.control[2 * ends.beside + 1]};
    Vec2 const from = fit.points[fit.pinned[ends.at]];
    Real const length = (end == 0 ? 1 : -1) * dot(to - from, fit.direction[end]);
    return !fit.has_min_speed[end] && length < min_length(fit, end);
}

}  // namespace

void LeastSquares::lay_out(Arena& arena, Offset n_points, Index n_control, Index degree) noexcept {
    arena.take(u, n_points);
    arena.take(weight, n_points);
    arena.take(error, n_points);
    arena.take(tangent, n_points);
    arena.take(largest_so_far, n_points);
    arena.take(control, 2 * static_cast<Offset>(n_control));
    arena.take(pinned, n_control);
    matrix.lay_out(arena, 2 * n_control, bandwidth(degree), true);
}

void LeastSquares::set_up(Curve const& shape, Span<const Vec2> through) noexcept {
    curve = shape;
    curve.control = control.data();
    points = through;
    // The arrays have room for the largest numbers of points and of control points.
    u = {u.data(), through.size()};
    weight = {weight.data(), through.size()};
    error = {error.data(), through.size()};
    control = {control.data(), 2 * static_cast<Size>(shape.n_control)};
    pinned = {pinned.data(), static_cast<Size>(shape.n_control)};
    tangent = {tangent.data(), through.size()};
    largest_so_far = {largest_so_far.data(), through.size()};
}

void LeastSquares::start() noexcept { fill(tangent, Vec2{}); }

void LeastSquares::solve(Real along) noexcept {
    has_min_speed[0] = has_min_speed[1] = false;
    bool again = true;
    while (again) {
        solve_once(along);
        again = false;
        for (Index end = 0; end < 2; ++end) {
            if (!(square(direction[end]) > 0)) continue;
            place_beside_end(*this, end);
            bool const slow = is_too_slow(*this, end);
            again = again || slow;
            has_min_speed[end] = has_min_speed[end] || slow;
        }
    }
}

void LeastSquares::solve_once(Real along) noexcept {
    Real total = 0;
    for (Real const w : weight) total += w;
    Real strength = smoothing * total / curve.n_control;
    do {
        matrix.shape(2 * curve.n_control, bandwidth(curve.degree), true);
        fill(control, Real(0));
        add_points(*this, along);
        add_smoothing(*this, strength);
        if (bending > 0) add_bending(*this);
        pin(*this);
        for (Index end = 0; end < 2; ++end)
            if (square(direction[end]) > 0) hold_tangent(*this, end);
        strength *= 100;
    } while (matrix.factor() != none && strength < total);
    matrix.solve(control);
}

Real LeastSquares::correct_parameters() noexcept {
    for (Index times = 0; times < 2; ++times) {
        step_to_feet(*this);
        put_in_order(*this);
    }
    Real largest = 0;
    for (Real const found : error) largest = max(largest, found);
    return largest;
}

}  // namespace harmorph
