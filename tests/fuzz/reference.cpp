#include "reference.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {
namespace {

struct WidePoint {
    Wide x, y;
};
WidePoint wide(Point p) { return {p.x, p.y}; }
WidePoint operator-(WidePoint a, WidePoint b) { return {a.x - b.x, a.y - b.y}; }
Wide cross(WidePoint a, WidePoint b) { return a.x * b.y - a.y * b.x; }
Wide dot(WidePoint a, WidePoint b) { return a.x * b.x + a.y * b.y; }

// Twice the area of a corner, its first side turned back, less `sine` times the lengths of its
// sides. Products of differences of doubles need 128 bits.
__float128 corner(std::vector<Point> const& at, JudgedCorner const& judged, double sine = 0) {
    auto const p = [&](std::int32_t k) { return at[static_cast<std::size_t>(k)]; };
    __float128 const ax = __float128(p(judged.here).x) - p(judged.before).x,
                     ay = __float128(p(judged.here).y) - p(judged.before).y;
    __float128 const bx = __float128(p(judged.after).x) - p(judged.here).x,
                     by = __float128(p(judged.after).y) - p(judged.here).y;
    __float128 const area = judged.cosine * (ax * by - ay * bx) + judged.sine * (ax * bx + ay * by);
    if (sine == 0) return area;
    return area -
           sine * (std::hypot(Wide(ax), Wide(ay)) * __float128(std::hypot(Wide(bx), Wide(by))));
}
__float128 corner(std::vector<Point> const& at, std::int32_t before, std::int32_t here,
                  std::int32_t after) {
    return corner(at, {0, before, here, after});
}
int sign(__float128 x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

std::int32_t inverted_cells(Judged const& judged, std::vector<Point> const& at, double sine) {
    std::vector<bool> is_inverted(judged.is_divided.size(), false);
    for (JudgedCorner const& one : judged.corners)
        if (!(corner(at, one, sine) > 0)) is_inverted[one.cell] = true;
    return static_cast<std::int32_t>(std::count(is_inverted.begin(), is_inverted.end(), true));
}

Crossings find_crossings(Domain const& domain, std::vector<Point> const& at) {
    Crossings out;
    auto const same = [&](std::int32_t a, std::int32_t b) {
        Point const p = at[static_cast<std::size_t>(a)], q = at[static_cast<std::size_t>(b)];
        return a == b || (p.x == q.x && p.y == q.y);
    };
    // On one side of an interface, or next to the end of this side.
    auto const near_side = [&](Face const& f, int side) {
        return std::any_of(domain.faces.begin(), domain.faces.end(), [&](Face const& g) {
            return g.marker == domain.interface_sides[side] &&
                   (g.from == f.from || g.from == f.to || g.to == f.from || g.to == f.to);
        });
    };
    for (std::size_t i = 0; i < domain.faces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Face const &f = domain.faces[i], &g = domain.faces[j];
            if ((near_side(f, 0) && near_side(g, 1)) || (near_side(f, 1) && near_side(g, 0)))
                continue;
            if (same(f.from, g.from) || same(f.from, g.to) || same(f.to, g.from) ||
                same(f.to, g.to)) {
                out.touches = true;  // may coincide or lie on each other; not judged here
                continue;
            }
            int const a = sign(corner(at, f.from, f.to, g.from)),
                      b = sign(corner(at, f.from, f.to, g.to));
            int const c = sign(corner(at, g.from, g.to, f.from)),
                      d = sign(corner(at, g.from, g.to, f.to));
            out.crosses = out.crosses || (a * b < 0 && c * d < 0);
        }
    return out;
}

double smallest_sine(Judged const& judged, std::vector<Point> const& at,
                     std::vector<Point> const& by, double step) {
    Wide least = 1;
    // Returns the vector from one point to another. The differences come first, because products of
    // large numbers would lose all digits.
    auto const edge = [](std::vector<Point> const& points, std::int32_t from, std::int32_t to) {
        return wide(points[static_cast<std::size_t>(to)]) -
               wide(points[static_cast<std::size_t>(from)]);
    };
    auto const lengths = [](WidePoint a, WidePoint b) {
        return std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
    };
    for (JudgedCorner const& corner : judged.corners) {
        WidePoint const a0 = edge(at, corner.before, corner.here),
                        b0 = edge(at, corner.here, corner.after);
        WidePoint const u = edge(by, corner.before, corner.here),
                        v = edge(by, corner.here, corner.after);
        WidePoint const a{a0.x + step * u.x, a0.y + step * u.y},
            b{b0.x + step * v.x, b0.y + step * v.y};
        Wide const area = corner.cosine * cross(a, b) + corner.sine * dot(a, b);
        least = std::min(least, area / std::max(lengths(a, b), lengths(a0, b0)));
    }
    return static_cast<double>(least);
}

std::vector<double> basis_functions(hm_curves const& curves, std::int32_t number, double u) {
    hm_curve const& curve = curves.curve[number];
    std::int32_t const degree = curve.degree, n = curve.n_indices;
    const double* const knot = curve.knots;
    std::vector<Wide> value(static_cast<std::size_t>(n + degree), 0);
    std::int32_t span = degree;  // the last one that is not empty and begins at or before u
    for (std::int32_t k = degree; k < n; ++k)
        if (knot[k] < knot[k + 1] && knot[k] <= u) span = k;
    value[static_cast<std::size_t>(span)] = 1;
    for (std::int32_t p = 1; p <= degree; ++p)
        for (std::int32_t k = 0; k + p < n + degree; ++k) {
            Wide const left = Wide(knot[k + p]) - knot[k],
                       right = k + p + 1 < n + degree + 1 ? Wide(knot[k + p + 1]) - knot[k + 1] : 0;
            Wide const here = value[static_cast<std::size_t>(k)],
                       next = value[static_cast<std::size_t>(k + 1)];
            value[static_cast<std::size_t>(k)] =
                (left > 0 ? (u - knot[k]) / left * here : 0) +
                (right > 0 ? (knot[k + p + 1] - u) / right * next : 0);
        }
    std::vector<Wide> sum(static_cast<std::size_t>(curves.n_control), 0);
    Wide total = 0;
    for (std::int32_t k = 0; k < n; ++k) {
        std::size_t const c = static_cast<std::size_t>(
            curve.indices != nullptr ? curve.indices[k] - curves.index_base : k);
        Wide const part = value[static_cast<std::size_t>(k)] *
                          (curves.weights != nullptr ? curves.weights[c] : 1);
        sum[c] += part;
        total += part;
    }
    std::vector<double> out;
    for (Wide const part : sum) out.push_back(static_cast<double>(part / total));
    return out;
}

double laplace_residual(Domain const& domain, Judged const& judged,
                        std::vector<double> const& values, std::vector<bool> const& inside) {
    std::vector<Wide> sum(values.size(), 0), size(values.size(), 0);
    Wide largest = 0;
    for (double const value : values) largest = std::max(largest, std::abs(Wide(value)));
    auto const add_triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c, Wide part) {
        std::size_t const k[] = {static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                                 static_cast<std::size_t>(c)};
        WidePoint const p[] = {wide(domain.points[k[0]]), wide(domain.points[k[1]]),
                               wide(domain.points[k[2]])};
        Wide const area = cross(p[1] - p[0], p[2] - p[0]);
        for (int i = 0; i < 3; ++i) {  // the edge opposite to corner i has half its cotangent
            std::size_t const j = k[(i + 1) % 3], l = k[(i + 2) % 3];
            Wide const weight = part * dot(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]) / area / 2;
            Wide const flux = weight * (Wide(values[l]) - values[j]);
            sum[j] += flux;
            sum[l] -= flux;
            for (std::size_t const end : {j, l})
                size[end] += std::abs(weight) *
                             (std::abs(values[l]) + std::abs(values[j]) + 1e-3L * largest);
        }
    };
    for (auto const& [a, b, c] : judged.triangles) add_triangle(a, b, c, 1);
    for (std::size_t c = 0; c < domain.cells.size(); ++c) {
        Cell const& cell = domain.cells[c];
        if (judged.is_divided[c]) continue;
        if (cell.size() == 3) {
            add_triangle(cell[0], cell[1], cell[2], 1);
            continue;
        }
        add_triangle(cell[0], cell[1], cell[2], 0.5L);
        add_triangle(cell[0], cell[2], cell[3], 0.5L);
        add_triangle(cell[0], cell[1], cell[3], 0.5L);
        add_triangle(cell[1], cell[2], cell[3], 0.5L);
    }
    double worst = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (inside[k] && size[k] > 0)
            worst = std::max(worst, static_cast<double>(std::abs(sum[k]) / size[k]));
    return worst;
}

}  // namespace fuzz
