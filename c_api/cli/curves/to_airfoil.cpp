#include <harmorph_design.h>
#include "curves/to_airfoil.hpp"

#include "curves/airfoil_loop.hpp"
#include "curves/curves.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace cli {

namespace {

using Complex = std::complex<double>;
Complex complex(Point point) { return {point.x, point.y}; }

// A B-spline through the section's points, as close as their number allows: it tells where the
// edges are and what is between the points.
Curves fitted(const Section& section, const std::string& path) {
    auto options = sized<hm_fit_options>();
    const auto n = static_cast<std::int32_t>(section.x.size());
    options.n_control = std::clamp(2 * n / 3, std::min(n, 8), 160);
    options.closed = HM_CLOSED_AUTO;
    const hm_points points = {section.x.data(), section.y.data(), 1};
    std::size_t bytes = 0;
    call(path, hm_fit_size, n, &options, &bytes);
    Block block(bytes);
    const hm_curves* curves = nullptr;
    auto report = sized<hm_fit_report>();
    call(path, hm_fit, &curves, block.data(), bytes, &points, n, std::int32_t{1}, &options,
         &report);
    return copied(*curves);
}

// Least squares for the control points of one curve, some of which are known.
class LeastSquares {
public:
    LeastSquares(const hm_curves& curves, std::int32_t curve, const AirfoilLoop& loop)
        : curves_(curves),
          curve_(curve),
          loop_(loop),
          row_(static_cast<std::size_t>(curves.n_control), unused) {
        const hm_curve& its = curves.curve[curve];
        for (std::int32_t i = 0; i < its.n_indices; ++i) kind_of(its, i) = free;
        if (!loop.is_periodic) kind_of(its, 0) = kind_of(its, its.n_indices - 1) = known;
        for (std::size_t i = 0; i < row_.size(); ++i) {
            if (row_[i] != free) continue;
            row_[i] = static_cast<std::int32_t>(unknowns_.size());
            unknowns_.push_back(i);
        }
    }

    // The least sum of squared distances between C(u[k]) and target[k], of which only this share
    // counts along the curve, as parameters will follow (tangent distance minimisation: W. Wang, H.
    // Pottmann, Y. Liu, ACM Trans. Graph. 25 (2006) 214).
    void solve(const std::vector<double>& u, const std::vector<Point>& target, double share,
               std::vector<double>& control) {
        hm_curves now = curves_;
        now.control = control.data();
        const std::size_t n = 2 * unknowns_.size();
        std::vector<double> matrix(n * n), right(n);
        const auto order = static_cast<std::size_t>(curves_.curve[curve_].degree) + 1;
        std::vector<std::int32_t> used(order);
        std::vector<double> value(order);
        for (std::size_t k = 0; k < u.size(); ++k) {
            double xy[4];
            call(std::string("curve"), hm_curve_basis, &now, curve_, loop_.within(u[k]), 0,
                 used.data(), value.data());
            call(std::string("curve"), hm_curve_point, &now, curve_, loop_.within(u[k]), 1, xy);
            const double rest[2] = {target[k].x - xy[0],
                                    target[k].y - xy[1]};  // what the movement should be
            const double speed = std::hypot(xy[2], xy[3]), tx = speed > 0 ? xy[2] / speed : 0,
                         ty = speed > 0 ? xy[3] / speed : 0;
            const double less = 1 - share;
            const double weight[2][2] = {{1 - less * tx * tx, -less * tx * ty},
                                         {-less * tx * ty, 1 - less * ty * ty}};
            for (std::size_t a = 0; a < order; ++a) {
                const std::int32_t row = row_[index(used[a])];
                if (row < 0) continue;
                for (std::size_t c = 0; c < 2; ++c) {
                    const std::size_t i = 2 * static_cast<std::size_t>(row) + c;
                    right[i] += value[a] * (weight[c][0] * rest[0] + weight[c][1] * rest[1]);
                    for (std::size_t b = 0; b < order; ++b) {
                        const std::int32_t column = row_[index(used[b])];
                        if (column < 0) continue;
                        const std::size_t j = 2 * static_cast<std::size_t>(column);
                        matrix[i * n + j] += value[a] * value[b] * weight[c][0];
                        matrix[i * n + j + 1] += value[a] * value[b] * weight[c][1];
                    }
                }
            }
        }
        // A control point on which no sample depends stays where it is.
        for (std::size_t i = 0; i < n; ++i)
            matrix[i * n + i] += 1e-12 * static_cast<double>(u.size());
        eliminate(matrix, right);
        for (std::size_t i = 0; i < n; ++i) control[2 * unknowns_[i / 2] + i % 2] += right[i];
    }

private:
    static constexpr std::int32_t unused = -1, known = -2, free = -3;

    std::size_t index(std::int32_t control) const {
        return static_cast<std::size_t>(control - curves_.index_base);
    }
    std::int32_t& kind_of(const hm_curve& its, std::int32_t i) {
        return row_[its.indices ? index(its.indices[i]) : static_cast<std::size_t>(i)];
    }

    // Gauss, without pivots: the matrix is positive definite. The solution replaces the right-hand
    // side.
    static void eliminate(std::vector<double>& matrix, std::vector<double>& right) {
        const std::size_t n = right.size();
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t i = k + 1; i < n; ++i) {
                const double factor = matrix[i * n + k] / matrix[k * n + k];
                if (factor == 0) continue;
                for (std::size_t j = k; j < n; ++j) matrix[i * n + j] -= factor * matrix[k * n + j];
                right[i] -= factor * right[k];
            }
        }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t j = k + 1; j < n; ++j) right[k] -= matrix[k * n + j] * right[j];
            right[k] /= matrix[k * n + k];
        }
    }

    const hm_curves& curves_;
    std::int32_t curve_;
    const AirfoilLoop& loop_;
    std::vector<std::int32_t> row_;  // of each control point: its unknown, or what it is instead
    std::vector<std::size_t> unknowns_;  // the control points that are looked for
};

// Each parameter moves to the foot of its target, to first order, and stays behind the one before
// it.
void correct_parameters(const hm_curves& curves, std::int32_t curve, const AirfoilLoop& loop,
                        const std::vector<Point>& target, std::vector<double>& u) {
    double least = u.front();
    const double most = u.back();
    for (std::size_t k = 1; k + 1 < u.size(); ++k) {
        double xy[4];
        call(std::string("curve"), hm_curve_point, &curves, curve, loop.within(u[k]), 1, xy);
        const double square = xy[2] * xy[2] + xy[3] * xy[3];
        const double along = (target[k].x - xy[0]) * xy[2] + (target[k].y - xy[1]) * xy[3];
        if (square > 0) u[k] += along / square;
        least = u[k] = std::clamp(u[k], least, most);
    }
}

// Both ends come to the middle between them, and the sides follow in proportion to the arc from the
// leading edge.
void taper(std::vector<Point>& outline, const std::vector<double>& part) {
    const Complex first = complex(outline.front()), last = complex(outline.back()),
                  half = .5 * (last - first);
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Complex moved = complex(outline[k]) + (1 - part[k]) * half;
        outline[k] = {moved.real(), moved.imag()};
    }
}

// The straight base keeps its place between the two ends that it has in common with the airfoil.
void move_base(const hm_curves& before, const Curve& airfoil, const Curve& base,
               std::vector<double>& control) {
    const auto point = [](const double* pairs, std::int32_t i) {
        return Complex(pairs[2 * i], pairs[2 * i + 1]);
    };
    const std::int32_t a = airfoil.indices.front(), b = airfoil.indices.back();
    const Complex from = point(before.control, a), to = point(control.data(), a);
    const Complex turn = (point(control.data(), b) - to) / (point(before.control, b) - from);
    for (const std::int32_t i : base.indices) {
        if (i == a || i == b) continue;
        const Complex moved = to + turn * (point(before.control, i) - from);
        control[static_cast<std::size_t>(2 * i)] = moved.real();
        control[static_cast<std::size_t>(2 * i + 1)] = moved.imag();
    }
}

}  // namespace

ToAirfoil moves_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                           const std::string& path, bool on_chord) {
    const hm_curves& before = basis.curves();
    const Curves copy = copied(before);
    const AirfoilLoop from(before, curve);
    const Curves through = fitted(section, path);
    AirfoilLoop to(*CurvesView(through).get(), 0);
    if (to.runs_clockwise() != from.runs_clockwise()) to.reverse();
    if (from.is_blunt && !to.is_blunt) {
        throw Failure(exit_file, path +
                                     ": the trailing edge is sharp, and that of the mesh's airfoil "
                                     "is blunt: its base cannot vanish");
    }
    if (to.is_blunt && !from.is_blunt) {
        warn(path + ": the blunt base, " +
             brief(std::abs(complex(to.at.front()) - complex(to.at.back()))) +
             " wide, becomes one point, as the mesh's airfoil has it: both sides are tapered from "
             "the leading edge on");
    }
    const Complex scale = !on_chord ? 1
                                    : (complex(from.trailing) - complex(from.leading)) /
                                          (complex(to.trailing) - complex(to.leading));
    const auto place = [&](double& x, double& y) {
        const Complex at =
            !on_chord ? Complex(x, y)
                      : complex(from.leading) + scale * (Complex(x, y) - complex(to.leading));
        x = at.real();
        y = at.imag();
    };
    Section placed = section;
    for (std::size_t k = 0; k < placed.x.size(); ++k) place(placed.x[k], placed.y[k]);
    std::vector<Point> target = to.at;
    for (Point& point : target) place(point.x, point.y);

    if (to.is_blunt && !from.is_blunt) taper(target, to.part);

    std::vector<double> control(before.control, before.control + 2 * before.n_control);
    hm_curves after = before;
    after.control = control.data();
    const Curve& its = copy.curves[static_cast<std::size_t>(curve)];
    if (!from.is_periodic) {  // the ends are where the section's are
        const Complex first = complex(target.front()), last = complex(target.back());
        const Complex ends[] = {from.is_blunt ? first : .5 * (first + last),
                                from.is_blunt ? last : .5 * (first + last)};
        for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
            const auto i =
                static_cast<std::size_t>(end == 0 ? its.indices.front() : its.indices.back());
            control[2 * i] = ends[end].real();
            control[2 * i + 1] = ends[end].imag();
        }
    }
    std::vector<double> u(target.size());
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = from.u_at(to.part[k]);
    LeastSquares squares(before, curve, from);
    constexpr int rounds = 60, first_rounds = 5;
    for (int round = 0; round < rounds; ++round) {
        squares.solve(u, target, round < first_rounds ? 1 : 1e-4, control);
        if (round + 1 < rounds) correct_parameters(after, curve, from, target, u);
    }
    const auto next = static_cast<std::size_t>(curve) + 1;
    const bool has_base = from.is_blunt && next < copy.curves.size() &&
                          (copy.curves[next].indices.front() == its.indices.back() ||
                           copy.curves[next].indices.back() == its.indices.back());
    if (has_base) move_base(before, its, copy.curves[next], control);

    ToAirfoil result;
    result.moves.resize(2 * static_cast<std::size_t>(basis.functions()));
    for (std::size_t i = 0; i < control.size(); ++i)
        result.moves[i] = control[i] - before.control[i];
    result.points = static_cast<std::int32_t>(placed.x.size());
    result.chord = std::abs(scale * (complex(to.trailing) - complex(to.leading)));
    for (std::size_t k = 0; k < placed.x.size(); ++k) {
        double nearest = 0;
        for (std::int32_t piece = curve; piece <= curve + (has_base ? 1 : 0); ++piece) {
            double foot = 0, distance = 0;
            call(path, hm_curve_project, &after, piece, placed.x[k], placed.y[k], &foot, &distance);
            nearest = piece == curve ? distance : std::min(nearest, distance);
        }
        result.rms_error += nearest * nearest;
        if (nearest > result.max_error) {
            result.max_error = nearest;
            result.worst_point = static_cast<std::int32_t>(k) + 1;
        }
    }
    result.rms_error = std::sqrt(result.rms_error / static_cast<double>(result.points));
    return result;
}

}  // namespace cli
