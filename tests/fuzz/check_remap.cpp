// Means over control volumes of one mesh from those of another: the overlaps of all pairs of
// volumes are computed again, by clipping triangles in more digits.
#include "fields_model.hpp"

namespace fuzz {
namespace {

struct WidePoint {
    Wide x, y;
};
using Outline = std::vector<WidePoint>;

Wide twice_area(Outline const& outline) {
    Wide sum = 0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        WidePoint const o = outline[0], a = outline[k], b = outline[k + 1];
        sum += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return sum;
}

// The part of a convex outline on the left of the line from a to b.
Outline left_part(Outline const& outline, WidePoint a, WidePoint b) {
    Outline out;
    auto const side = [&](WidePoint p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    for (std::size_t k = 0; k < outline.size(); ++k) {
        WidePoint const p = outline[k], q = outline[(k + 1) % outline.size()];
        Wide const at_p = side(p), at_q = side(q);
        if (at_p >= 0) out.push_back(p);
        if ((at_p < 0) == (at_q < 0)) continue;
        Wide const t = at_p / (at_p - at_q);
        out.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
    return out;
}

bool is_apart(Outline const& a, Outline const& b) {
    auto const ends = [](Outline const& outline, Wide WidePoint::*axis) {
        auto const [low, high] =
            std::minmax({outline[0].*axis, outline[1].*axis, outline[2].*axis});
        return std::pair<Wide, Wide>{low, high};
    };
    for (Wide WidePoint::*axis : {&WidePoint::x, &WidePoint::y}) {
        auto const [low_a, high_a] = ends(a, axis);
        auto const [low_b, high_b] = ends(b, axis);
        if (high_a < low_b || high_b < low_a) return true;
    }
    return false;
}

// Both are triangles.
Wide common_area(Outline part, Outline const& triangle) {
    if (is_apart(part, triangle)) return 0;
    for (std::size_t k = 0; k < 3 && part.size() > 2; ++k)
        part = left_part(part, triangle[k], triangle[(k + 1) % 3]);
    return part.size() > 2 ? twice_area(part) / 2 : 0;
}

// The control volumes of a mesh at some coordinates, as triangles: in each cell, between a corner,
// the middle of one of its sides and the mean of the corners.
struct Volumes {
    std::vector<std::vector<Outline>> triangles;  // of each point
    std::vector<Wide> area;

    Volumes(Domain const& domain, Judged const& judged, std::vector<Point> const& at)
        : triangles(at.size()), area(at.size(), 0) {
        for (std::size_t c = 0; c < domain.cells.size(); ++c)
            if (!judged.is_divided[c]) add(domain.cells[c], at);
        for (auto const& [a, b, c] : judged.triangles) add({a, b, c}, at);
    }

private:
    void add(Cell const& cell, std::vector<Point> const& at) {
        std::size_t const n = cell.size();
        auto const point = [&](std::size_t k) {
            Point const p = at[static_cast<std::size_t>(cell[k % n])];
            return WidePoint{p.x, p.y};
        };
        WidePoint mean{0, 0};
        for (std::size_t k = 0; k < n; ++k)
            mean = {mean.x + point(k).x / Wide(n), mean.y + point(k).y / Wide(n)};
        for (std::size_t k = 0; k < n; ++k) {
            WidePoint const a = point(k), b = point(k + 1),
                            middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
            put(cell[k], {a, middle, mean});
            put(cell[(k + 1) % n], {middle, b, mean});
        }
    }
    void put(std::int32_t point, Outline const& triangle) {
        triangles[static_cast<std::size_t>(point)].push_back(triangle);
        area[static_cast<std::size_t>(point)] += twice_area(triangle) / 2;
    }
};

}  // namespace

// From the mesh, or the mesh at other coordinates, to the mesh at other coordinates.
void FieldsModel::remap() {
    std::vector<Point> const from = input_.one_in(2) ? points_ : displaced(), to = displaced();
    std::size_t const n = points_.size();
    std::int32_t const fields = input_.from(1, 2), order = input_.from(1, 2);
    std::size_t const numbers = n * at(fields);
    Numbers values(numbers), out(numbers, 7), covered(n, 7);
    for (double& value : values) value = input_.between(-1, 1);
    for (std::size_t k = 0; fields == 2 && k < n; ++k) values[n + k] = 0.75;  // a constant field
    hm_points const before = in(from), after = in(to);
    hm_remap_report report = sized<hm_remap_report>();
    std::size_t bytes = 0;
    done(hm_remap_size(analysis_, analysis_, fields, order, &bytes, &error_), "a size of a remap");
    Block const work(bytes, input_.below(64), 0x7F);
    auto const call = [&](std::size_t given) {
        return hm_remap(analysis_, &before, analysis_, &after, fields, order, values.data(),
                        out.data(), covered.data(), work.data(), given, problem_.options.executor,
                        &report, &error_);
    };
    expect(call(bytes - 1) < 0, "a block that is one byte too small is taken");
    hm_status const status = call(bytes);
    expect_told(status, error_);
    work.expect_intact();
    bool const is_valid =
        inverted_cells(judged_, from, 1e-12) == 0 && inverted_cells(judged_, to, 1e-12) == 0;
    if (status < 0) {
        expect_untouched(out), expect_untouched(covered);
        expect(!is_valid || judged_.ambiguous > 0,
               std::string("a remap is refused: ") + error_.text);
        return;
    }
    for (double const value : out) expect(std::isfinite(value), "a mean is not finite");
    if (!is_valid || judged_.ambiguous > 0 || has_short_sides()) return;
    Volumes const source(problem_.domain, judged_, from), target(problem_.domain, judged_, to);
    Wide const rounding = 1e-12L * Wide(extent_) * extent_;
    Wide whole = 0, integral = 0, expected_integral = 0;
    for (std::size_t j = 0; j < n; ++j) {
        Wide common = 0, sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (Outline const& a : source.triangles[i])
                for (Outline const& b : target.triangles[j]) {
                    Wide const area = common_area(a, b);
                    common += area;
                    sum += area * values[i];
                }
        expect(std::abs(covered[j] - common) <= rounding,
               "a covered area differs by " + shown(double(covered[j] - common)));
        whole += common;
        integral += Wide(covered[j]) * out[j];
        expected_integral += sum;
        if (common <= 1e3L * rounding) continue;
        Wide const within = 1e-9L + 4 * rounding / common;
        if (order == 1)
            expect(std::abs(out[j] - sum / common) <= within,
                   "a mean differs by " + shown(double(out[j] - sum / common)));
        if (fields == 2)
            expect(std::abs(out[n + j] - 0.75) <= within, "a constant field does not stay");
    }
    expect(std::abs(report.area - whole) <= rounding * Wide(n), "the common area differs");
    if (order == 1)
        expect(std::abs(integral - expected_integral) <= 4 * rounding * Wide(n),
               "the integral over the common area changes");
}

}  // namespace fuzz
