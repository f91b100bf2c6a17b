// Areas that sides of cells and faces of the median dual sweep, against products with twice the
// precision of doubles.
#include "fields_model.hpp"

namespace fuzz {
namespace {

// Twice the precision of the coordinates: a point of the line between two positions of a point.
struct Path {
    Quad x0, y0, x1, y1;
};
Path operator+(Path a, Path b) { return {a.x0 + b.x0, a.y0 + b.y0, a.x1 + b.x1, a.y1 + b.y1}; }
Path operator*(Quad s, Path a) { return {s * a.x0, s * a.y0, s * a.x1, s * a.y1}; }

// The area that the line from a to b sweeps to its right.
Quad swept(Path a, Path b) {
    Quad const vx = (a.x1 - a.x0 + b.x1 - b.x0) / 2, vy = (a.y1 - a.y0 + b.y1 - b.y0) / 2;
    Quad const dx = (b.x0 - a.x0 + b.x1 - a.x1) / 2, dy = (b.y0 - a.y0 + b.y1 - a.y1) / 2;
    return vx * dy - vy * dx;
}

}  // namespace

void FieldsModel::areas() {
    std::vector<Cell> const cells = cells_of_mesh(problem_.mesh);
    std::size_t entries = 0;
    for (Cell const& cell : cells) entries += cell.size();
    std::int64_t n = 0;
    done(hm_swept_count(&problem_.mesh, &n, &error_), "a number of sides");
    expect(n == static_cast<std::int64_t>(entries), "another number of sides than cells have");
    std::vector<Point> const from = input_.one_in(2) ? points_ : displaced(), to = displaced();
    Numbers sides(entries, 7), duals(entries, 7), halves(2 * entries, 7);
    hm_points const before = in(from), after = in(to);
    bool const is_wild = input_.one_in(8);
    if (is_wild) {
        std::vector<Point> broken = to;
        broken[input_.below(static_cast<std::uint32_t>(to.size()))].x = NAN;
        hm_points const bad = in(broken);
        hm_status const status = hm_swept_areas(&problem_.mesh, &before, &bad, sides.data(),
                                                duals.data(), halves.data(), nullptr, &error_);
        expect_told(status, error_);
        if (status < 0) expect_untouched(sides), expect_untouched(duals), expect_untouched(halves);
        return;
    }
    done(hm_swept_areas(&problem_.mesh, &before, &after, sides.data(), duals.data(), halves.data(),
                        problem_.options.executor, &error_),
         "swept areas");
    Quad const rounding = Quad(size_) * size_ * 0x1p-98L;
    auto const same = [&](double found, Quad expected, const char* what) {
        Quad const error = found > expected ? found - expected : expected - found;
        Quad const magnitude = expected > 0 ? expected : -expected;
        expect(error <= magnitude * 0x1p-51L + rounding + Quad(0x1p-1070),
               std::string(what) + " differs from the reference");
    };
    std::size_t entry = 0;
    for (Cell const& cell : cells) {
        std::size_t const m = cell.size(), distinct = m - (cell[m - 1] == cell[m - 2]);
        auto const path = [&](std::size_t k) {
            std::size_t const p = at(cell[k % m]);
            return Path{from[p].x, from[p].y, to[p].x, to[p].y};
        };
        Path mean{0, 0, 0, 0};
        for (std::size_t k = 0; k < distinct; ++k)
            mean = mean + (Quad(1) / Quad(distinct)) * path(k);
        for (std::size_t k = 0; k < m; ++k, ++entry) {
            Path const a = path(k), b = path(k + 1), middle = Quad(0.5) * (a + b);
            same(sides[entry], swept(a, b), "the area of a side");
            same(halves[2 * entry], swept(a, middle), "the first half of a side");
            same(halves[2 * entry + 1], swept(middle, b), "the second half of a side");
            bool const is_repeated = cell[k] == cell[(k + 1) % m];
            if (is_repeated)
                expect(sides[entry] == 0 && duals[entry] == 0, "a side without length has an area");
            else same(duals[entry], swept(middle, mean), "the area of a face of the median dual");
        }
    }
}

}  // namespace fuzz
