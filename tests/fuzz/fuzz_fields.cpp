// The calls of harmorph_fields.h with random meshes: swept areas, distances to the walls, coarse
// levels of control volumes, and interpolation. Results are compared with sums and searches over
// all cells and faces in more digits, derivatives with their transposes.
#include <harmorph_fields.h>
#include "fields_model.hpp"
#include "target.hpp"

namespace fuzz {
namespace {

using Quad = __float128;

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
        if (status < 0) untouched(sides), untouched(duals), untouched(halves);
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
            if (is_repeated) expect(sides[entry] == 0, "a side without length has an area");
            else same(duals[entry], swept(middle, mean), "the area of a face of the median dual");
        }
    }
}

// The coarse levels are unions of finer ones, connected, and their areas are those of the control
// volumes.
void FieldsModel::levels() {
    hm_levels* levels = nullptr;
    std::vector<Point> const moved = displaced(), second = displaced();
    hm_points const coordinates = in(moved);
    const hm_points* const given = input_.one_in(2) ? &coordinates : nullptr;
    std::int32_t const kind = input_.from(0, 2), most = input_.from(0, 4);
    hm_status const status = in_block(
        [&](std::size_t* bytes) { return hm_levels_size(analysis_, bytes, &error_); },
        [&](void* memory, std::size_t bytes) {
            return hm_levels_init(&levels, memory, bytes, analysis_, given, kind, most, &error_);
        });
    if (status < 0) return;
    std::int32_t n_levels = 0;
    done(hm_level_cells(levels, 0, nullptr, nullptr, &n_levels, &error_), "a number of levels");
    expect(n_levels >= 1 && (most == 0 || n_levels <= most), "too many levels");
    std::vector<std::int32_t> finer, out(points_.size(), 7);
    expect(hm_level_cells(levels, n_levels, out.data(), nullptr, nullptr, &error_) < 0,
           "a level beyond the last one");
    for (std::int32_t const cell : out) expect(cell == 7, "a refused call has written");
    std::int32_t finer_count = 0;
    for (std::int32_t level = 0; level < n_levels; ++level) {
        std::vector<std::int32_t> cells(points_.size(), 7);
        std::int32_t count = 0;
        done(hm_level_cells(levels, level, cells.data(), &count, nullptr, &error_), "a level");
        if (level > 0) {
            expect(3 * count <= finer_count, "a level has more than a third of the finer one");
            std::vector<std::int32_t> parent(at(finer_count), -1);
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (finer[k] < 0) continue;
                std::int32_t& its = parent[at(finer[k])];
                expect(its < 0 || its == cells[k], "a volume is no union of finer ones");
                its = cells[k];
            }
        }
        volumes_are_connected(cells, count);
        volumes_have_areas(levels, level, cells, count, moved, second);
        finer = cells;
        finer_count = count;
    }
}

void FieldsModel::volumes_are_connected(std::vector<std::int32_t> const& cells,
                                        std::int32_t count) const {
    std::vector<std::int32_t> root(cells.size());
    for (std::size_t k = 0; k < root.size(); ++k) root[k] = static_cast<std::int32_t>(k);
    auto const find = [&](std::int32_t k) {
        while (root[at(k)] != k) k = root[at(k)];
        return k;
    };
    auto const join = [&](std::int32_t a, std::int32_t b) {
        if (cells[at(a)] == cells[at(b)]) root[at(find(a))] = find(b);
    };
    std::vector<bool> is_used(cells.size(), false);
    for (Cell const& cell : problem_.domain.cells)
        for (std::size_t k = 0; k < cell.size(); ++k) {
            join(cell[k], cell[(k + 1) % cell.size()]);
            is_used[at(cell[k])] = true;
        }
    for (auto const& [a, b, c] : judged_.triangles) join(a, b), join(b, c), join(c, a);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        expect(is_used[k] ? cells[k] >= 0 && cells[k] < count : cells[k] == -1,
               "a point has the number of a volume that does not exist");
        // A cut, or a pair of the analysis, joins points.
        for (std::size_t other = 0; other < k; ++other)
            if (points_[other].x == points_[k].x && points_[other].y == points_[k].y)
                join(static_cast<std::int32_t>(k), static_cast<std::int32_t>(other));
    }
    for (Domain::Image const& image : problem_.domain.images) join(image.source, image.at);
    if (judged_.ambiguous > 0) return;                         // unknown edges inside
    for (hm_condition const& condition : problem_.conditions)  // a pair of other sides
        if (condition.kind == HM_PERIODIC_PAIR && problem_.domain.images.empty()) return;
    std::vector<std::int32_t> root_of(at(count), -1);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (!is_used[k]) continue;
        std::int32_t& known = root_of[at(cells[k])];
        std::int32_t const own = find(static_cast<std::int32_t>(k));
        expect(known < 0 || known == own, "a volume has two pieces");
        known = own;
    }
    for (std::int32_t const known : root_of) expect(known >= 0, "a volume without points");
}

void FieldsModel::volumes_have_areas(hm_levels const* levels, std::int32_t level,
                                     std::vector<std::int32_t> const& cells, std::int32_t count,
                                     std::vector<Point> const& from, std::vector<Point> const& to) {
    Numbers areas(at(count), 7), increases(at(count), 7);
    hm_points const before = in(from), after = in(to);
    done(hm_level_areas(levels, level, nullptr, &after, areas.data(), &error_), "areas");
    done(hm_level_areas(levels, level, &before, &after, increases.data(), &error_), "increases");
    if (judged_.ambiguous > 0 || has_short_sides()) return;
    std::vector<Quad> expected(at(count), 0), change(at(count), 0);
    // The quadrilateral between a corner, the middles of its sides and the mean of the cell.
    auto const add = [&](Cell const& cell) {
        std::size_t const m = cell.size();
        for (std::size_t k = 0; k < m; ++k)
            for (bool const is_late : {false, true}) {
                std::vector<Point> const& place = is_late ? to : from;
                auto const p = [&](std::size_t i) { return place[at(cell[i % m])]; };
                Point const o = p(k);
                Quad cx = 0, cy = 0;
                for (std::size_t i = 0; i < m; ++i)
                    cx += Quad(p(i).x) - o.x, cy += Quad(p(i).y) - o.y;
                cx /= m, cy /= m;
                Quad const ax = (Quad(p(k + 1).x) - o.x) / 2, ay = (Quad(p(k + 1).y) - o.y) / 2,
                           bx = (Quad(p(k + m - 1).x) - o.x) / 2,
                           by = (Quad(p(k + m - 1).y) - o.y) / 2;
                Quad const area = (ax * cy - ay * cx + cx * by - cy * bx) / 2;
                std::size_t const volume = at(cells[at(cell[k])]);
                if (is_late) expected[volume] += area;
                change[volume] += is_late ? area : -area;
            }
    };
    for (std::size_t c = 0; c < problem_.domain.cells.size(); ++c)
        if (!judged_.is_divided[c]) add(problem_.domain.cells[c]);
    for (auto const& [a, b, c] : judged_.triangles) add({a, b, c});
    double const within = 1e-13 * extent_ * extent_ * 20;
    for (std::size_t k = 0; k < areas.size(); ++k) {
        expect(std::abs(areas[k] - double(expected[k])) <= within,
               "the area of a volume differs from the reference");
        expect(std::abs(increases[k] - double(change[k])) <= within,
               "the increase of an area differs from the reference");
    }
}

Outcome run_fields(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    return FieldsModel(*problem, input).run();
}

}  // namespace fuzz
