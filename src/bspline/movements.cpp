#include "bspline/movements.hpp"

#include "base/vec2.hpp"
#include "bspline/quadrature.hpp"
#include "bspline/section_extremes.hpp"
#include "bspline/variables.hpp"

namespace harmorph {
namespace {

constexpr Real largest_rotation = 360;  // degrees

MappedPoint rotated_about(Vec2 centre, Real degrees, Vec2 point) noexcept {
    Vec2 const rotation = rotation_by(degrees), arm = point - centre;
    Vec2 const by_degrees = per_degree * left_of(rotated(arm, rotation));
    return {rotated(arm, rotation - Vec2{1, 0}), rotation, left_of(rotation), {by_degrees, {}}};
}

MappedPoint deflect(Movement const& flap, Real degrees, Vec2 point) noexcept {
    Vec2 const arm = point - flap.centre;
    // A quotient that is out of range is not computed: it may overflow.
    Real const behind = dot(arm, flap.behind);
    Real const t = behind >= flap.length ? 1 : behind > 0 ? behind / flap.length : 0;
    Real const share = t * t * t * (10 - t * (15 - 6 * t));
    Real const slope = t > 0 && t < 1 ? 30 * t * t * (1 - t) * (1 - t) / flap.length : 0;
    MappedPoint mapped = rotated_about(flap.centre, share * degrees, point);
    Vec2 const by_angle = mapped.by_value[0];
    mapped.by_x = mapped.by_x + (degrees * slope * flap.behind.x) * by_angle;
    mapped.by_y = mapped.by_y + (degrees * slope * flap.behind.y) * by_angle;
    mapped.by_value[0] = share * by_angle;
    return mapped;
}

}  // namespace

Index Movement::count() const noexcept {
    switch (kind) {
        case MovementKind::shift: return 2;
        case MovementKind::camber_thickness: return n_camber + n_thickness;
        case MovementKind::parsec: return 11;
        case MovementKind::blade: return 3;
        case MovementKind::linear: return n_linear;
        default: return 1;
    }
}

Index Movement::find_bad_value(const Real* values) const noexcept {
    bool const is_angle =
        kind == MovementKind::rotate || kind == MovementKind::flap || kind == MovementKind::blade;
    for (Index j = 0; j < count(); ++j) {
        if (!is_at_most(values[j], is_angle ? largest_rotation : largest_coordinate)) return j;
    }
    return kind == MovementKind::scale && !(values[0] > -1) ? 0 : none;
}

MappedPoint map_point(Movement const& movement, const Real* values, Vec2 point) noexcept {
    Vec2 const x{1, 0}, y{0, 1};
    switch (movement.kind) {
        case MovementKind::shift: return {{values[0], values[1]}, x, y, {x, y}};
        case MovementKind::scale: {
            Vec2 const arm = point - movement.centre;
            Real const scale = 1 + values[0];
            return {values[0] * arm, scale * x, scale * y, {arm, {}}};
        }
        case MovementKind::flap: return deflect(movement, values[0], point);
        default: return rotated_about(movement.centre, values[0], point);
    }
}

namespace {

constexpr Index n_places = 33, n_rounds = 6;
constexpr Real largest_metal_angle = 85;  // degrees from the chord
constexpr Index max_values = 2 * Variables::max_count;

Vec2 in_frame(Section const& section, Vec2 point) noexcept {
    Vec2 const chord = section.chord();
    return (1 / square(chord)) * rotation_between(chord, point - section.leading_edge);
}

// Writes s (1-s) B_k(s), and the derivatives by s, of the n Bernstein polynomials of degree n - 1.
void camber_shapes(Index n, Real s, Real* value, Real* slope) noexcept {
    if (n == 0) return;
    Real lower[Variables::max_count];
    bernstein(n, s, value);
    bernstein(n - 1, s, lower);
    for (Index k = 0; k < n; ++k) {
        Real const before = k > 0 ? lower[k - 1] : 0, at = k + 1 < n ? lower[k] : 0;
        slope[k] = (1 - 2 * s) * value[k] + s * (1 - s) * (n - 1) * (before - at);
        value[k] *= s * (1 - s);
    }
}

}  // namespace

// Each round puts the middles of the thickness, which are measured on normals of the last line, on
// the next line. The first normals are those of the chord.
Status CamberLine::measure(Section const& section, Fault& fault) noexcept {
    for (Real& c : coefficient) c = 0;
    Section across = section;
    across.has_fixed_chord = true;
    for (Index round = 0; round < n_rounds; ++round) {
        Real matrix[n * n] = {}, right[n] = {};
        for (Index k = 0; k < n_places; ++k) {
            // The stations are dense at both ends.
            Real const s = 0.5 * (1 - rotation_by(180.0 * (k + 1) / (n_places + 1)).x);
            Real c[3];
            evaluate(s, c);
            Vec2 const foot{s, c[0]}, tangent = direction(Vec2{1, c[1]});
            Vec2 const chord = section.chord();
            Vec2 const through = section.leading_edge + rotated(foot, chord);
            across.leading_edge = through - 0.5 * rotated(tangent, chord);
            across.trailing_edge = through + 0.5 * rotated(tangent, chord);
            Station station;
            HARMORPH_TRY(measure_station(across, StationValue::camber, 0.5, station, fault));
            Vec2 const middle = foot + (station.value / length(chord)) * left_of(tangent);
            Real shape[n], slope[n];
            camber_shapes(n, clamp(middle.x, 0.0, 1.0), shape, slope);
            for (Index i = 0; i < n; ++i) {
                right[i] += shape[i] * middle.y;
                for (Index j = 0; j < n; ++j) matrix[i * n + j] += shape[i] * shape[j];
            }
        }
        if (!solve_small(n, matrix, 1, right)) break;
        for (Index i = 0; i < n; ++i) coefficient[i] = right[i];
    }
    return Status::ok;
}

void CamberLine::evaluate(Real s, Real (&height)[3]) const noexcept {
    Real p[3] = {};
    for (Index d = 0; d < 3; ++d) {
        Real difference[n], value[n];
        for (Index k = 0; k < n; ++k) difference[k] = coefficient[k];
        Real factor = 1;
        for (Index e = 0; e < d; ++e) {
            factor *= n - 1 - e;
            for (Index k = 0; k + 1 + e < n; ++k) difference[k] = difference[k + 1] - difference[k];
        }
        bernstein(n - d, s, value);
        for (Index k = 0; k < n - d; ++k) p[d] += factor * difference[k] * value[k];
    }
    Real const q = s * (1 - s), by = 1 - 2 * s;
    height[0] = q * p[0];
    height[1] = by * p[0] + q * p[1];
    height[2] = -2 * p[0] + 2 * by * p[1] + q * p[2];
}

// A few steps of Newton's method suffice: points that stay beside their normal keep their distance
// along the camber line, too.
Real CamberLine::station_of(Vec2 point) const noexcept {
    Real s = clamp(point.x, 0.0, 1.0);
    for (Index times = 0; times < 8; ++times) {
        Real c[3];
        evaluate(s, c);
        Real const offset = point.x - s + (point.y - c[0]) * c[1];
        Real const stiffness = max(1 + c[1] * c[1] - (point.y - c[0]) * c[2], 0.5);
        s = clamp(s + offset / stiffness, 0.0, 1.0);
    }
    return s;
}

Status CamberChange::measure(Section const& section, Movement const& movement,
                             Fault& fault) noexcept {
    section_ = &section;
    movement_ = &movement;
    HARMORPH_TRY(line_.measure(section, fault));
    for (Index end = 0; end < 2; ++end) {
        Real c[3];
        line_.evaluate(end, c);
        end_slope_[end] = c[1];
    }
    return Status::ok;
}

Real CamberChange::start(Index j) const noexcept {
    if (!is_blade()) return 0;
    Vec2 const chord = section_->chord();
    return angle_of(j == 2 ? chord : rotated(chord, {1, end_slope_[j]})) / per_degree;
}

Index CamberChange::set(const Real* values) noexcept {
    values_ = values;
    for (Index end = 0; is_blade() && end < 2; ++end) {
        Real const slope = end_slope_[end], degrees = values[end] - values[2];
        if (!(abs(angle_of({1, slope}) / per_degree + degrees) <= largest_metal_angle)) return end;
        Vec2 const rotation = rotation_by(degrees);
        slope_change_[end] = (1 + slope * slope) * rotation.y / (rotation.x - slope * rotation.y);
        Real const now = slope + slope_change_[end];
        slope_by_[end] = (1 + now * now) * per_degree;
    }
    return none;
}

CamberChange::Change CamberChange::change_at(Real s, Change* by) const noexcept {
    Change sum;
    if (is_blade()) {
        // The cubics with slope 1 at one end.
        Real const value[2] = {s * (1 - s) * (1 - s), -s * s * (1 - s)};
        Real const slope[2] = {(1 - s) * (1 - 3 * s), s * (3 * s - 2)};
        by[2] = {};
        for (Index end = 0; end < 2; ++end) {
            sum.height += slope_change_[end] * value[end];
            sum.slope += slope_change_[end] * slope[end];
            by[end] = {slope_by_[end] * value[end], slope_by_[end] * slope[end], 0};
            by[2] = {by[2].height - by[end].height, by[2].slope - by[end].slope, 0};
        }
        return sum;
    }
    Real value[Variables::max_count], slope[Variables::max_count];
    camber_shapes(movement_->n_camber, s, value, slope);
    for (Index k = 0; k < movement_->n_camber; ++k) {
        by[k] = {value[k], slope[k], 0};
        sum.height += values_[k] * value[k];
        sum.slope += values_[k] * slope[k];
    }
    bernstein(movement_->n_thickness, s, value);
    for (Index k = 0; k < movement_->n_thickness; ++k) {
        Index const j = movement_->n_camber + k;
        by[j] = {0, 0, sqrt(s) * (1 - s) * value[k]};
        sum.thickness += values_[j] * by[j].thickness;
    }
    return sum;
}

// Moves a point with its place along the camber line and normal to it.
void CamberChange::write(Vec2 point, bool upper, Real* pairs) const noexcept {
    Change by[max_values];
    Vec2 const in = in_frame(*section_, point), chord = section_->chord();
    Real const s = line_.station_of(in), sign = upper ? 1 : -1;
    Real c[3];
    line_.evaluate(s, c);
    auto const tangent_of = [](Real slope) { return direction(Vec2{1, slope}); };
    Vec2 const foot{s, c[0]}, tangent = tangent_of(c[1]);
    Real const along = dot(in - foot, tangent), offset = cross(tangent, in - foot);
    Change const change = change_at(s, by);
    Real const slope = c[1] + change.slope, distance = offset + sign * change.thickness;
    Vec2 const now = tangent_of(slope), normal = left_of(now);
    auto const place = [&](Vec2 t, Real height, Real off) {
        return Vec2{s, height} + along * t + off * left_of(t);
    };
    Vec2 const moved = place(now, c[0] + change.height, distance) - place(tangent, c[0], offset);
    Vec2 const in_plane = rotated(moved, chord);
    Vec2 const rotation = is_blade() ? rotation_by(values_[2]) : Vec2{1, 0};
    Vec2 const arm = point + in_plane - movement_->centre;
    Vec2 const total = in_plane + rotated(arm, rotation - Vec2{1, 0});
    pairs[0] = total.x;
    pairs[1] = total.y;
    Vec2 const by_slope = (1 / (1 + slope * slope)) * (along * normal - distance * now);
    for (Index j = 0; j < movement_->count(); ++j) {
        Vec2 const shape =
            Vec2{0, by[j].height} + by[j].slope * by_slope + (sign * by[j].thickness) * normal;
        Vec2 derivative = rotated(rotated(shape, chord), rotation);
        if (is_blade() && j == 2)
            derivative = derivative + per_degree * left_of(rotated(arm, rotation));
        pairs[2 * j + 2] = derivative.x;
        pairs[2 * j + 3] = derivative.y;
    }
}

OutlineMovements CamberChange::movements() const noexcept {
    auto const write = [](const void* context, Vec2 point, bool upper, Real* pairs) {
        static_cast<const CamberChange*>(context)->write(point, upper, pairs);
    };
    return {1 + movement_->count(), true, this, write};
}

namespace {

constexpr Index max_sweeps = 60;         // about six suffice
constexpr Real smallest_cosine = 1e-15;  // between movements that count as orthogonal
constexpr Real smallest_value = 1e-12;   // of the largest singular value

}  // namespace

void FamilyModes::lay_out(Arena& arena, Index n_control) noexcept {
    arena.take(weight_, n_control);
}

void FamilyModes::start() noexcept { fill(weight_, Real(0)); }

void FamilyModes::add(Curve const& curve) noexcept {
    for (Index span = curve.degree; span < curve.n_indices; ++span) {
        Real const low = curve.knots[span], high = curve.knots[span + 1];
        if (!(low < high)) continue;
        auto const speed_at = [&](Real u) {
            Vec2 c[2];
            curve_point_in(curve, span, u, 1, c);
            return length(c[1]);
        };
        // The integrals of all functions that are not 0 there; the arc length is their size.
        auto const integrand = [&](Real u) {
            Sums<2 * max_order> at;
            CurveBasis const basis = curve_basis_in(curve, span, u, 0);
            Real const speed = speed_at(u);
            for (Index k = 0; k < basis.order; ++k) {
                at.value[k] = speed * basis.value[0][k];
                at.value[max_order + k] = speed;
            }
            return at;
        };
        for_converged<2 * max_order>(low, high, integrand, [&](Real from, Real to) {
            Gauss10::for_each(from, to, [&](Real u, Real weight) {
                CurveBasis const basis = curve_basis_in(curve, span, u, 0);
                for (Index k = 0; k < basis.order; ++k)
                    weight_[basis.control[k]] += weight * speed_at(u) * basis.value[0][k];
            });
        });
    }
}

Real FamilyModes::dot_of(const Real* a, const Real* b) const noexcept {
    Real sum = 0;
    for (Index i = 0; i < weight_.count(); ++i)
        sum += weight_[i] * (a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]);
    return sum;
}

Status FamilyModes::run(Index n, Real* movements, Real* singular, Fault& fault) noexcept {
    Offset const length = 2 * Offset{weight_.count()};
    Real total = 0, largest = 0;
    for (Real const w : weight_) total += w;
    for (Offset k = 0; k < n * length; ++k) {
        if (!is_at_most(movements[k], largest_coordinate)) {
            return fault.refuse(Status::bad_argument,
                                "movement # has a number that is not finite or beyond 1e100",
                                entry_item(static_cast<Index>(k / length)));
        }
        if (weight_[static_cast<Index>(k % length / 2)] > 0)
            largest = max(largest, abs(movements[k]));
    }
    if (!(total > 0) || !(largest > 0))
        return fault.refuse(Status::bad_argument, "the movements move no point of the curves");
    for (Real& w : weight_) w /= total;
    for (Offset k = 0; k < n * length; ++k) {
        bool const counts = weight_[static_cast<Index>(k % length / 2)] > 0;
        movements[k] = counts ? movements[k] / largest : 0;
    }
    bool is_orthogonal = false;
    for (Index sweep = 0; sweep < max_sweeps && !is_orthogonal; ++sweep) {
        is_orthogonal = true;
        for (Index p = 0; p + 1 < n; ++p) {
            for (Index q = p + 1; q < n; ++q) {
                Real *const a = movements + p * length, *const b = movements + q * length;
                Real const aa = dot_of(a, a), bb = dot_of(b, b), ab = dot_of(a, b);
                if (!(abs(ab) > smallest_cosine * sqrt(aa * bb)) || abs(ab) < 1e-300) continue;
                is_orthogonal = false;
                Real const z = (bb - aa) / (2 * ab);
                Real const t = (z < 0 ? -1 : 1) / (abs(z) + sqrt(1 + z * z));
                Real const cosine = 1 / sqrt(1 + t * t), sine = t * cosine;
                for (Offset k = 0; k < length; ++k) {
                    Real const at = a[k];
                    a[k] = cosine * at - sine * b[k];
                    b[k] = sine * at + cosine * b[k];
                }
            }
        }
    }
    for (Index k = 0; k < n; ++k) {
        const Real* const mode = movements + k * length;
        singular[k] = sqrt(dot_of(mode, mode));
    }
    order(n, movements, singular);
    for (Index k = 0; k < n; ++k) {
        Real* const mode = movements + k * length;
        Real farthest = 0;
        for (Offset i = 0; i < length; ++i)
            if (abs(mode[i]) > abs(farthest)) farthest = mode[i];
        bool const counts = singular[k] > smallest_value * singular[0];
        Real const factor = !counts ? 0 : (farthest < 0 ? -1 : 1) / singular[k];
        for (Offset i = 0; i < length; ++i) mode[i] *= factor;
    }
    for (Index k = 0; k < n; ++k) singular[k] *= largest;
    return Status::ok;
}

// Puts the largest singular values first.
void FamilyModes::order(Index n, Real* movements, Real* singular) const noexcept {
    Offset const length = 2 * Offset{weight_.count()};
    auto const swap = [](Real& a, Real& b) {
        Real const kept = a;
        a = b;
        b = kept;
    };
    for (Index k = 0; k + 1 < n; ++k) {
        Index best = k;
        for (Index j = k + 1; j < n; ++j)
            if (singular[j] > singular[best]) best = j;
        if (best == k) continue;
        swap(singular[k], singular[best]);
        for (Offset i = 0; i < length; ++i)
            swap(movements[k * length + i], movements[best * length + i]);
    }
}

}  // namespace harmorph
