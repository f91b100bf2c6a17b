#include "safe/cell_logarithm.hpp"

#include "safe/small_eigen.hpp"

namespace harmorph {
namespace {

// The size of a cell, as a function of c = ln(area / reference): phi = (sqrt(c^2 + b^2) - b) / 2.
struct LogSize {
    Real value, slope, bend;

    LogSize(Real area, Real reference, Real blur) noexcept {
        Real const c = logarithm(area / reference), root = sqrt(c * c + blur * blur);
        value = 0.5 * (root - blur);
        slope = root > 0 ? 0.5 * c / root : 0;
        bend = root > 0 ? 0.5 * (blur / root) * (blur / root) / root : 0;
    }
};

// Relative deformations of a cell with n points, in a frame M in which the cell is regular: point k
// moves by M (sum_j pattern[j][k] (e_2j, e_2j+1)). The patterns are orthonormal, and a translation
// is none of them.
template <Index n>
struct CellFrame {
    static constexpr Index patterns = n - 1, count = 2 * patterns;
    Vec2 column[2];          // M
    Vec2 inverse_column[2];  // of the transposed inverse of M
    Real pattern[patterns][n];
    Real unit;  // a power of two of the size of the cell; lengths are divided by it
    Vec2 side[n], by_side[count][n];  // the sides and their derivatives

    explicit CellFrame(CellShape const& shape) noexcept;

    // Converts the gradient and the Hessian by relative deformations into those by points.
    void to_points(Real const (&gradient)[count], Real const (&hessian)[count][count],
                   CellForm<n>& form) const noexcept;

private:
    void take_columns(Vec2 u, Vec2 v) noexcept {
        Real const per_area = 1 / cross(u, v);
        column[0] = u;
        column[1] = v;
        inverse_column[0] = per_area * Vec2{v.y, -v.x};
        inverse_column[1] = per_area * Vec2{-u.y, u.x};
    }
};

template <Index n>
CellFrame<n>::CellFrame(CellShape const& shape) noexcept {
    constexpr Real two = 0.7071067811865476, six = 0.4082482904638630;
    constexpr Real of_triangle[2][3] = {{-two, two, 0}, {-six, -six, 2 * six}};
    constexpr Real of_quad[3][4] = {
        {-0.5, 0.5, 0.5, -0.5}, {-0.5, -0.5, 0.5, 0.5}, {0.5, -0.5, 0.5, -0.5}};
    Real longest = 0;
    for (Index k = 0; k < n; ++k) {
        side[k] = shape.at[k + 1 == n ? 0 : k + 1] - shape.at[k];
        longest = max(longest, max(abs(side[k].x), abs(side[k].y)));
    }
    unit = power_of_two_at(longest);
    for (Vec2& s : side) s = 1 / unit * s;
    for (Index j = 0; j < patterns; ++j) {
        for (Index k = 0; k < n; ++k)
            pattern[j][k] = n == 3 ? of_triangle[j % 2][k % 3] : of_quad[j][k];
    }
    if (n == 3) take_columns(side[0], 1.1547005383792517 * (-1 * side[2] - 0.5 * side[0]));
    else take_columns(0.5 * (side[0] - side[2]), 0.5 * (side[1] - side[n - 1]));
    for (Index i = 0; i < count; ++i) {
        for (Index k = 0; k < n; ++k) {
            Index const next = k + 1 == n ? 0 : k + 1;
            by_side[i][k] = (pattern[i / 2][next] - pattern[i / 2][k]) * column[i % 2];
        }
    }
}

template <Index n>
void CellFrame<n>::to_points(Real const (&gradient)[count], Real const (&hessian)[count][count],
                             CellForm<n>& form) const noexcept {
    Real const per_unit = 1 / unit, per_square = per_unit * per_unit;
    Vec2 const f = inverse_column[0], g = inverse_column[1];
    for (Index k = 0; k < n; ++k) {
        form.by[k] = {};
        for (Index j = 0; j < patterns; ++j)
            form.by[k] = form.by[k] +
                         per_unit * pattern[j][k] * (gradient[2 * j] * f + gradient[2 * j + 1] * g);
        for (Index other = 0; other < n; ++other) form.hessian[k][other] = {};
    }
    for (Index j = 0; j < patterns; ++j) {
        for (Index i = 0; i < patterns; ++i) {
            Block block;
            block.add(per_square * hessian[2 * j][2 * i], f, f);
            block.add(per_square * hessian[2 * j][2 * i + 1], f, g);
            block.add(per_square * hessian[2 * j + 1][2 * i], g, f);
            block.add(per_square * hessian[2 * j + 1][2 * i + 1], g, g);
            for (Index k = 0; k < n; ++k) {
                for (Index other = 0; other < n; ++other) {
                    Real const part = pattern[j][k] * pattern[i][other];
                    Block& to = form.hessian[k][other];
                    to = to + Block{part * block.a, part * block.b, part * block.c, part * block.d};
                }
            }
        }
    }
}

// The first and the second derivatives of a quantity by relative deformations.
template <Index n>
struct Derivatives {
    static constexpr Index count = 2 * (n - 1);
    Real first[count] = {};
    Real second[count][count] = {};  // the upper triangle

    // Adds factor times the outer product of a gradient with itself.
    void add_square(Real factor, Real const (&gradient)[count]) noexcept {
        for (Index i = 0; i < count; ++i) {
            for (Index j = i; j < count; ++j) second[i][j] += factor * gradient[i] * gradient[j];
        }
    }
    void add_first(Real factor, Real const (&gradient)[count]) noexcept {
        for (Index i = 0; i < count; ++i) first[i] += factor * gradient[i];
    }
};

// Adds weight ln(1 / sin t), where t is the angle of the corner between the sides `in` and `out`.
// `square_weight` times the square of the gradient is added, too.
template <Index n>
void add_corner(CellFrame<n> const& frame, Index in, Index out, Real weight, Real square_weight,
                Derivatives<n>& to) noexcept {
    constexpr Index count = 2 * (n - 1);
    Vec2 const a = frame.side[in], b = frame.side[out];
    Real const sine = cross(a, b), cotangent = -dot(a, b) / sine;  // of pi minus the turning angle
    Vec2 p[count], q[count];
    Real gradient[count];
    for (Index i = 0; i < count; ++i) {
        p[i] = quotient(frame.by_side[i][in], a);
        q[i] = quotient(frame.by_side[i][out], b);
        gradient[i] = cotangent * (q[i].y - p[i].y);
    }
    // With the turning angle t from a to b, ln(1 / sin t) has the derivatives -cot t and 1 + cot^2
    // t.
    for (Index i = 0; i < count; ++i) {
        for (Index j = i; j < count; ++j) {
            Real const turning = (q[i].y - p[i].y) * (q[j].y - p[j].y);
            Real const bends =
                (p[i].x * p[j].y + p[i].y * p[j].x) - (q[i].x * q[j].y + q[i].y * q[j].x);
            to.second[i][j] += weight * ((1 + cotangent * cotangent) * turning + cotangent * bends);
        }
    }
    to.add_first(weight, gradient);
    if (square_weight != 0) to.add_square(square_weight, gradient);
}

// Adds slope ln(area) and square_weight times the square of its gradient; the area is that of the
// triangle or quadrilateral.
template <Index n>
void add_area(CellFrame<n> const& frame, Real slope, Real square_weight,
              Derivatives<n>& to) noexcept {
    constexpr Index count = 2 * (n - 1);
    constexpr Index last = n - 1;
    // The area is half the cross product of the two diagonals, or of two sides.
    auto const first_of = [](Vec2 const(&side)[n]) { return n == 3 ? side[0] : side[0] + side[1]; };
    auto const second_of = [](Vec2 const(&side)[n]) {
        return n == 3 ? side[1] : side[1] + side[last - 1];
    };
    Vec2 const u = first_of(frame.side), v = second_of(frame.side);
    Real const per_area = 1 / cross(u, v);
    Real gradient[count];
    Vec2 du[count], dv[count];
    for (Index i = 0; i < count; ++i) {
        du[i] = first_of(frame.by_side[i]);
        dv[i] = second_of(frame.by_side[i]);
        gradient[i] = per_area * (cross(u, dv[i]) + cross(du[i], v));
    }
    for (Index i = 0; i < count; ++i) {
        for (Index j = i; j < count; ++j)
            to.second[i][j] += slope * per_area * (cross(du[i], dv[j]) + cross(du[j], dv[i]));
    }
    to.add_first(slope, gradient);
    to.add_square(square_weight - slope, gradient);
}

// Makes the Hessian slope * second + curvature * first first^T positive definite.
template <Index n>
void finish(CellFrame<n> const& frame, Derivatives<n> const& y, LogarithmWeights const& weights,
            CellForm<n>& form) noexcept {
    constexpr Index count = 2 * (n - 1);
    Real hessian[count][count], vector[count][count];
    for (Index i = 0; i < count; ++i) {
        for (Index j = i; j < count; ++j)
            hessian[i][j] =
                weights.slope * y.second[i][j] + weights.curvature * y.first[i] * y.first[j];
    }
    diagonalise(hessian, vector);
    Real value[count];
    for (Index k = 0; k < count; ++k)
        value[k] = max(abs(hessian[k][k]), weights.least) + weights.damping;
    for (Index i = 0; i < count; ++i) {
        for (Index j = i; j < count; ++j) {
            Real sum = 0;
            for (Index k = 0; k < count; ++k) sum += value[k] * vector[i][k] * vector[j][k];
            hessian[i][j] = hessian[j][i] = sum;
        }
    }
    frame.to_points(y.first, hessian, form);
}

}  // namespace

Real minus_log_quality(CellMeasure const& measure, Real reference_area, Real blur) noexcept {
    Real const skew = measure.skew.numerator / measure.skew.denominator;
    if (!(measure.twice_smallest > 0) || !(skew > 0)) return infinity;
    return LogSize(measure.area, reference_area, blur).value - logarithm(skew);
}

void differentiate_cell(CellShape const& shape, Real reference_area,
                        LogarithmWeights const& weights, CellForm<3>& form) noexcept {
    constexpr Index count = 4;
    CellFrame<3> const frame(shape);
    Real const area = CellCorners(shape).cell_area(3);
    LogSize const size(area, reference_area, weights.blur);
    Derivatives<3> y;
    Real squares = 0, gradient[count] = {};
    for (Vec2 const side : frame.side) squares += square(side);
    for (Index i = 0; i < count; ++i) {
        for (Index k = 0; k < 3; ++k)
            gradient[i] += 2 / squares * dot(frame.side[k], frame.by_side[i][k]);
        for (Index j = i; j < count; ++j) {
            for (Index k = 0; k < 3; ++k)
                y.second[i][j] += 2 / squares * dot(frame.by_side[i][k], frame.by_side[j][k]);
        }
    }
    y.add_first(1, gradient);
    y.add_square(-1, gradient);
    add_area(frame, size.slope - 1, size.bend, y);
    finish(frame, y, weights, form);
}

void differentiate_cell(CellShape const& shape, Real reference_area,
                        LogarithmWeights const& weights, CellForm<4>& form) noexcept {
    CellFrame<4> const frame(shape);
    CellCorners const corners(shape);
    LogSize const size(corners.cell_area(4), reference_area, weights.blur);
    Real inverse_sine[4], sum = 0;
    for (Index k = 0; k < 4; ++k) {
        Vec2 const in = frame.side[(k + 3) & 3], out = frame.side[k];
        inverse_sine[k] = sqrt(square(in)) * sqrt(square(out)) / cross(in, out);
        sum += inverse_sine[k];
    }
    Derivatives<4> y;
    for (Index k = 0; k < 4; ++k)
        add_corner(frame, (k + 3) & 3, k, inverse_sine[k] / sum, inverse_sine[k] / sum, y);
    y.add_square(-1, y.first);
    add_area(frame, size.slope, size.bend, y);
    finish(frame, y, weights, form);
}

// The gradient of a polygon's y is a sum of gradients g with weights w >= 0, the sum of which is at
// most 1.5; therefore the square of the sum is at most 1.5 times the sum of w g g^T.
constexpr Real corner_weight_sum = 1.5;

void differentiate_piece(CellShape const& shape, PolygonMeasures const& polygon,
                         LogarithmWeights const& weights, CellForm<3>& form) noexcept {
    CellFrame<3> const frame(shape);
    LogSize const size(polygon.area, polygon.reference_area, weights.blur);
    Real const part = CellCorners(shape).cell_area(3) / polygon.area;
    Derivatives<3> y;
    add_area(frame, part * size.slope, part * (size.bend + max(size.slope, 0.0)), y);
    LogarithmWeights own = weights;
    own.curvature *= corner_weight_sum / max(part * abs(size.slope), 1e-3);
    own.least *= part;
    own.damping *= part;
    finish(frame, y, own, form);
}

void differentiate_corner(CellShape const& shape, PolygonMeasures const& polygon,
                          LogarithmWeights const& weights, CellForm<3>& form) noexcept {
    CellFrame<3> const frame(shape);
    Vec2 const in = frame.side[0], out = frame.side[1];
    Real const part = sqrt(square(in)) * sqrt(square(out)) / cross(in, out) / polygon.inverse_sines;
    Derivatives<3> y;
    add_corner(frame, 0, 1, part, part, y);
    LogarithmWeights own = weights;
    own.curvature *= corner_weight_sum / part;
    own.least *= part;
    own.damping *= part;
    finish(frame, y, own, form);
}

}  // namespace harmorph
