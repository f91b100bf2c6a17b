#include "polygons.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace fuzz {
namespace {

using Wide = long double;
using Side = std::pair<std::int32_t, std::int32_t>;  // from a point to the next one of a cell
constexpr std::size_t max_corners = 10;

std::map<Side, std::size_t> cells_by_side(std::vector<Cell> const& cells) {
    std::map<Side, std::size_t> out;
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (std::size_t k = 0; k < cells[c].size(); ++k)
            out[{cells[c][k], cells[c][(k + 1) % cells[c].size()]}] = c;
    return out;
}

std::size_t common_points(Cell const& a, Cell const& b) {
    return static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&](std::int32_t k) {
        return std::find(b.begin(), b.end(), k) != b.end();
    }));
}

// a without its side from `from` to `to`, and in place of that the rest of b.
Cell merged(Cell a, Cell b, std::int32_t from, std::int32_t to) {
    std::rotate(a.begin(), std::find(a.begin(), a.end(), to), a.end());    // to ... from
    std::rotate(b.begin(), std::find(b.begin(), b.end(), from), b.end());  // from ... to
    a.insert(a.end(), b.begin() + 1, b.end() - 1);
    return a;
}

void merge_some(Domain& domain, Input& input) {
    std::map<Side, std::size_t> cell_at = cells_by_side(domain.cells);
    std::vector<Cell>& cells = domain.cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        for (std::int32_t times = input.from(0, 2); times > 0 && !cells[c].empty(); --times) {
            std::size_t const k = input.below(static_cast<std::uint32_t>(cells[c].size()));
            std::int32_t const from = cells[c][k], to = cells[c][(k + 1) % cells[c].size()];
            auto const other = cell_at.find({to, from});
            if (other == cell_at.end() ||
                cells[c].size() + cells[other->second].size() > max_corners)
                continue;
            std::size_t const d = other->second;
            if (common_points(cells[c], cells[d]) != 2)
                continue;  // else a point would be left inside
            cells[c] = merged(cells[c], cells[d], from, to);
            cells[d].clear();
            for (std::size_t i = 0; i < cells[c].size(); ++i)
                cell_at[{cells[c][i], cells[c][(i + 1) % cells[c].size()]}] = c;
            cell_at.erase({from, to});
            cell_at.erase({to, from});
        }
    }
    cells.erase(
        std::remove_if(cells.begin(), cells.end(), [](Cell const& cell) { return cell.empty(); }),
        cells.end());
}

void split_edges(Domain& domain, Input& input) {
    std::map<Side, std::size_t> const cell_at = cells_by_side(domain.cells);
    for (auto const& [side, c] : cell_at) {
        auto const [from, to] = side;
        auto const other = cell_at.find({to, from});
        if (from > to || other == cell_at.end() || !input.one_in(12)) continue;
        Point const a = domain.points[static_cast<std::size_t>(from)],
                    b = domain.points[static_cast<std::size_t>(to)];
        std::int32_t const middle = static_cast<std::int32_t>(domain.points.size());
        domain.points.push_back({a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2});
        Cell &left = domain.cells[c], &right = domain.cells[other->second];
        left.insert(std::find(left.begin(), left.end(), from) + 1, middle);
        right.insert(std::find(right.begin(), right.end(), to) + 1, middle);
    }
}

struct WidePoint {
    Wide x, y;
};

// The header: convex if the tangent of the exterior angle is above 1/8, flat within this tolerance,
// or reflex.
enum class Kind { convex, flat, reflex };
Kind kind_of(WidePoint a, WidePoint b, WidePoint c) {
    Wide const ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
    Wide const turn = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy), limit = std::atan(0.125L);
    return turn > limit ? Kind::convex : turn < -limit ? Kind::reflex : Kind::flat;
}

// The division whose worst triangle is best, and so on in its parts: shapes are area / sum of
// squared sides.
class Division {
public:
    explicit Division(std::vector<WidePoint> const& at) : at_(at), known_(at.size() * at.size()) {}

    // The triangles between the corners i .. j, behind `out`; false: there are two ways that are
    // equally good.
    bool collect(std::size_t i, std::size_t j, std::vector<std::array<std::size_t, 3>>& out) {
        if (j == i + 1) return true;
        Part const part = best(i, j);
        out.push_back({i, part.apex, j});
        return !part.is_tie && collect(i, part.apex, out) && collect(part.apex, j, out);
    }

private:
    struct Part {
        bool is_known = false, is_tie = false;
        Wide worst = 0;
        std::size_t apex = 0;
    };

    Wide shape(std::size_t i, std::size_t k, std::size_t j) const {
        auto const square = [](WidePoint a, WidePoint b) {
            return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
        };
        WidePoint const a = at_[i], b = at_[k], c = at_[j];
        Wide const squares = square(a, b) + square(b, c) + square(c, a);
        return squares > 0 ? ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x)) / squares : 0;
    }
    Part best(std::size_t i, std::size_t j) {
        Part& known = known_[i * at_.size() + j];
        if (known.is_known) return known;
        Part found;
        found.is_known = true;
        found.worst = j == i + 1 ? 1 : -1;
        for (std::size_t k = i + 1; k < j; ++k) {
            Wide const worst = std::min({best(i, k).worst, best(k, j).worst, shape(i, k, j)});
            bool const is_first = k == i + 1;
            bool const is_equal = !is_first && std::abs(worst - found.worst) < 1e-12L;
            found.is_tie = is_equal || (!is_first && found.is_tie && worst < found.worst);
            if (is_first || worst > found.worst) found.worst = worst, found.apex = k;
        }
        return known_[i * at_.size() + j] = found;
    }

    std::vector<WidePoint> const& at_;
    std::vector<Part> known_;
};

}  // namespace

void make_polygons(Domain& domain, Input& input) {
    domain.has_polygons = true;
    domain.ni = domain.nj = 0;
    if (!input.one_in(8)) merge_some(domain, input);
    if (input.one_in(2)) split_edges(domain, input);
}

Judged judge_by_header(Domain const& domain) {
    Judged out;
    double const half = std::sqrt(0.5);
    for (std::size_t c = 0; c < domain.cells.size(); ++c) {
        Cell const& cell = domain.cells[c];
        std::size_t const n = cell.size();
        std::vector<WidePoint> at;  // exact: differences with a common origin would be rounded
        for (std::int32_t const k : cell) {
            Point const p = domain.points[static_cast<std::size_t>(k)];
            at.push_back({p.x, p.y});
        }
        std::vector<Kind> kinds;
        for (std::size_t k = 0; k < n; ++k)
            kinds.push_back(kind_of(at[(k + n - 1) % n], at[k], at[(k + 1) % n]));
        bool const is_convex =
            std::count(kinds.begin(), kinds.end(), Kind::convex) == std::ptrdiff_t(n);
        bool const whole = n == 3 || (n == 4 && (is_convex || !domain.has_polygons));
        out.is_divided.push_back(!whole);
        for (std::size_t k = 0; k < n; ++k) {
            JudgedCorner corner{c, cell[(k + n - 1) % n], cell[k], cell[(k + 1) % n]};
            if (!whole && kinds[k] == Kind::flat) corner.sine = half, corner.cosine = half;
            if (!whole && kinds[k] == Kind::reflex) corner.sine = half, corner.cosine = -half;
            out.corners.push_back(corner);
        }
        if (whole) continue;
        std::vector<std::array<std::size_t, 3>> triangles;
        if (!Division(at).collect(0, n - 1, triangles)) {
            ++out.ambiguous;
            continue;
        }
        for (auto const& [i, k, j] : triangles) {
            out.triangles.push_back({cell[i], cell[k], cell[j]});
            out.corners.push_back({c, cell[i], cell[k], cell[j]});
        }
    }
    return out;
}

}  // namespace fuzz
