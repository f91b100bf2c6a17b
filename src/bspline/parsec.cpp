#include "bspline/parsec.hpp"

#include "base/vec2.hpp"
#include "bspline/movements.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

enum Parameter : Index {
    leading_edge_radius = 0,
    crest = 1,  // station, height, second derivative; the three of the lower side follow
    edge_height = 7,
    edge_thickness = 8,
    edge_direction = 9,
    edge_wedge = 10
};
constexpr Real largest_slope_angle = 85;  // degrees
constexpr Real first_crest = 0.001, last_crest = 0.999;

// Writes the d-th derivative of t^(n - 1/2) at t for n = 1 .. 6.
void powers(Real t, Index derivative, Real* value) noexcept {
    Real const root = sqrt(t);
    Real power = root;
    for (Index d = 0; d < derivative; ++d) power /= t;
    for (Index n = 0; n < ParsecSection::n_powers; ++n) {
        Real factor = 1;
        for (Index d = 0; d < derivative; ++d) factor *= n + 0.5 - d;
        value[n] = factor * power;
        power *= t;
    }
}

Real sum(const Real* a, const Real* b) noexcept {
    Real total = 0;
    for (Index n = 0; n < ParsecSection::n_powers; ++n) total += a[n] * b[n];
    return total;
}

// A place of the outline in the frame of the chord: station, height and their derivatives by the
// parameter of the curve.
struct InFrame {
    Vec2 at, first, second;

    InFrame(Section const& section, CurvePlace const& place) noexcept {
        Vec2 c[3];
        place.derivatives(2, c);
        Vec2 const chord = section.chord();
        auto const frame = [&](Vec2 v) { return (1 / square(chord)) * rotation_between(chord, v); };
        at = frame(c[0] - section.leading_edge);
        first = frame(c[1]);
        second = frame(c[2]);
    }
    Real slope() const noexcept { return first.y / first.x; }
    Real second_derivative() const noexcept {
        return cross(first, second) / (first.x * first.x * first.x);
    }
};

// Finds the highest place of the outline; with sign -1, the lowest one.
CurvePlace find_crest(Section const& section, Real sign) noexcept {
    CurvePlace best;
    Real highest = -infinity;
    section.for_each_span(0, section.n_sides, [&](Index c, Index span, Real low, Real high) {
        auto const rise = [&](Real u) {
            return sign * InFrame(section, {&section.curve[c], span, u}).first.y;
        };
        Index const n = 8 * section.curve[c].degree;
        Real u = low, before = rise(low);
        for (Index j = 1; j <= n; ++j) {
            Real const next = j == n ? high : low + (high - low) * j / n, after = rise(next);
            if ((before < 0) != (after < 0)) {
                CurvePlace const place{&section.curve[c], span, sign_change(u, next, rise)};
                Real const height = sign * InFrame(section, place).at.y;
                if (height > highest) {
                    highest = height;
                    best = place;
                }
            }
            u = next;
            before = after;
        }
    });
    return best;
}

}  // namespace

Index ParsecSection::solve() noexcept {
    for (Index j = 0; j < n_parameters; ++j) {
        if (!is_at_most(parameter[j], 1e6)) return j;
    }
    if (!(parameter[leading_edge_radius] > 0)) return leading_edge_radius;
    Index const bad = solve_side(0);
    return bad != none ? bad : solve_side(1);
}

// The first coefficient follows from the radius of the leading edge. Five equations at the crest
// and at the trailing edge determine the others; the derivatives follow from the same equations.
Index ParsecSection::solve_side(Index side) noexcept {
    constexpr Index n = n_powers - 1;
    const Real* const at_crest = parameter + crest + 3 * side;
    Index const first = crest + 3 * side;
    Real const sign = side == 0 ? 1 : -1, t = at_crest[0];
    if (!(t > first_crest && t < last_crest)) return first;
    Real const angle = parameter[edge_direction] - 0.5 * sign * parameter[edge_wedge];
    if (!(abs(angle) <= largest_slope_angle)) return edge_direction;
    Vec2 const rotation = rotation_by(angle);
    Real const slope = rotation.y / rotation.x, by_angle = (1 + slope * slope) * per_degree;
    Real const height = parameter[edge_height] + 0.5 * sign * parameter[edge_thickness];
    Real rows[n][n_powers];
    for (Index d = 0; d < 3; ++d) powers(t, d, rows[d]);
    for (Index d = 0; d < 2; ++d) powers(1, d, rows[3 + d]);
    auto const solve_for = [&](Index width, Real* right) {
        Real matrix[n * n];
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < n; ++k) matrix[i * n + k] = rows[i][k + 1];
        return solve_small(n, matrix, width, right);
    };
    Real* const own = a[side];
    own[0] = sign * sqrt(2 * parameter[leading_edge_radius]);
    Real const wanted[n] = {at_crest[1], 0, at_crest[2], height, slope};
    Real right[n * n_parameters];
    for (Index i = 0; i < n; ++i) right[i] = wanted[i] - own[0] * rows[i][0];
    if (!solve_for(1, right)) return first;
    for (Index i = 0; i < n; ++i) own[i + 1] = right[i];

    Real const by_radius = sign / sqrt(2 * parameter[leading_edge_radius]);
    for (Real& entry : right) entry = 0;
    for (Index i = 0; i < n; ++i)
        right[i * n_parameters + leading_edge_radius] = -by_radius * rows[i][0];
    for (Index d = 0; d < 3; ++d) {
        Real next[n_powers];
        powers(t, d + 1, next);
        right[d * n_parameters + first] = -sum(own, next);
    }
    right[0 * n_parameters + first + 1] = 1;
    right[2 * n_parameters + first + 2] = 1;
    right[3 * n_parameters + edge_height] = 1;
    right[3 * n_parameters + edge_thickness] = 0.5 * sign;
    right[4 * n_parameters + edge_direction] = by_angle;
    right[4 * n_parameters + edge_wedge] = -0.5 * sign * by_angle;
    solve_for(n_parameters, right);
    for (Index j = 0; j < n_parameters; ++j) {
        by[side][j][0] = j == leading_edge_radius ? by_radius : 0;
        for (Index i = 0; i < n; ++i) by[side][j][i + 1] = right[i * n_parameters + j];
    }
    return none;
}

Status ParsecChange::measure(Section const& section, Fault& fault) noexcept {
    section_ = &section;
    Real* const p = before_.parameter;
    if (section.n_sides == 1 && is_periodic(section.curve[0])) {
        return fault.refuse(Status::bad_curve,
                            "PARSEC needs a section whose outline ends at the trailing edge, but "
                            "the curve is periodic");
    }
    if (!section.leading_edge_is_smooth)
        return fault.refuse(Status::bad_curve, "PARSEC needs a section with a round leading edge");
    InFrame const leading_edge(section, section.leading_edge_place);
    Real const speed = length(leading_edge.first);
    p[leading_edge_radius] =
        speed * speed * speed / abs(cross(leading_edge.first, leading_edge.second));
    for (Index side = 0; side < 2; ++side) {
        CurvePlace const place = find_crest(section, side == 0 ? 1 : -1);
        Real const station = place.curve == nullptr ? 0 : InFrame(section, place).at.x;
        if (!(station > first_crest && station < last_crest)) {
            return fault.refuse(Status::bad_curve,
                                side == 0 ? "the upper side of the section has no crest above its "
                                            "ends, which PARSEC needs"
                                          : "the lower side of the section has no crest below its "
                                            "ends, which PARSEC needs");
        }
        InFrame const top(section, place);
        p[crest + 3 * side] = station;
        p[crest + 3 * side + 1] = top.at.y;
        p[crest + 3 * side + 2] = top.second_derivative();
    }
    // The outline runs from the upper trailing edge to the lower one, or in the other direction.
    InFrame const begin(section, section.first_end()), end(section, section.last_end());
    bool const begins_above = section.sign > 0;
    InFrame const &upper = begins_above ? begin : end, &lower = begins_above ? end : begin;
    Real const above = angle_of({1, upper.slope()}) / per_degree,
               below = angle_of({1, lower.slope()}) / per_degree;
    p[edge_height] = 0.5 * (upper.at.y + lower.at.y);
    p[edge_thickness] = upper.at.y - lower.at.y;
    p[edge_direction] = 0.5 * (above + below);
    p[edge_wedge] = below - above;
    if (before_.solve() == none) return Status::ok;
    return fault.refuse(Status::bad_curve, "no PARSEC section has the parameters of this section");
}

Index ParsecChange::set(const Real* values) noexcept {
    for (Index j = 0; j < count; ++j) now_.parameter[j] = before_.parameter[j] + values[j];
    return now_.solve();
}

OutlineMovements ParsecChange::movements() const noexcept {
    auto const write = [](const void* context, Vec2 point, bool upper, Real* pairs) {
        auto const& own = *static_cast<const ParsecChange*>(context);
        Vec2 const chord = own.section_->chord(), up = left_of(chord);
        Real const t =
            clamp(dot(point - own.section_->leading_edge, chord) / square(chord), 0.0, 1.0);
        Index const side = upper ? 0 : 1;
        Real power[ParsecSection::n_powers];
        powers(t, 0, power);
        for (Index j = 0; j <= count; ++j) {
            Real const height =
                j > 0 ? sum(own.now_.by[side][j - 1], power)
                      : sum(own.now_.a[side], power) - sum(own.before_.a[side], power);
            pairs[2 * j] = height * up.x;
            pairs[2 * j + 1] = height * up.y;
        }
    };
    return {1 + count, true, this, write};
}

}  // namespace harmorph
