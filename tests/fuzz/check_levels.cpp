// Coarse levels of control volumes: the volumes of a level are connected unions of volumes of the
// finer level, and have the areas of their cells' corners.
#include "fields_model.hpp"

namespace fuzz {

void FieldsModel::levels() {
    hm_levels* levels = nullptr;
    std::vector<Point> const moved = displaced(), second = displaced();
    hm_points const coordinates = in(moved);
    const hm_points* const given = input_.one_in(2) ? &coordinates : nullptr;
    std::int32_t const kind = input_.from(0, 2), most = input_.from(0, 4);
    hm_status const status =
        blocks_.make(error_, size_by(hm_levels_size, analysis_),
                     init_by(hm_levels_init, &levels, analysis_, given, kind, most));
    if (status < 0) return;
    std::int32_t n_levels = 0;
    done(hm_level_cells(levels, 0, nullptr, nullptr, &n_levels, &error_), "a number of levels");
    expect(n_levels >= 1 && (most == 0 || n_levels <= most), "too many levels");
    std::vector<std::int32_t> finer, out(points_.size(), 7);
    expect(hm_level_cells(levels, n_levels, out.data(), nullptr, nullptr, &error_) < 0,
           "a level beyond the last one");
    expect_untouched(out);
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
                std::int32_t& owner = parent[at(finer[k])];
                expect(owner < 0 || owner == cells[k], "a volume is no union of finer ones");
                owner = cells[k];
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
    // Of an inverted polygon, the header does not say how it is divided.
    bool const is_valid = inverted_cells(judged_, points_) == 0;
    if (judged_.ambiguous > 0 || (problem_.domain.has_polygons && !is_valid)) return;
    std::vector<Quad> expected(at(count), 0), change(at(count), 0), size(at(count), 0);
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
                size[volume] += area < 0 ? -area : area;
            }
    };
    for (std::size_t c = 0; c < problem_.domain.cells.size(); ++c)
        if (!judged_.is_divided[c]) add(problem_.domain.cells[c]);
    for (auto const& [a, b, c] : judged_.triangles) add({a, b, c});
    for (std::size_t k = 0; k < areas.size(); ++k) {
        // The terms are rounded, and added one after the other; there are fewer than 256.
        double const within = 256 * 0x1p-53 * double(size[k]) + 0x1p-96 * extent_ * extent_;
        expect(std::abs(areas[k] - double(expected[k])) <= within,
               "the area of a volume differs from the reference");
        expect(std::abs(increases[k] - double(change[k])) <= within,
               "the increase of an area differs from the reference");
    }
}

}  // namespace fuzz
