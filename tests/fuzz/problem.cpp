#include <harmorph_study.h>
#include "fixtures/options.hpp"
#include "polygons.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {
namespace {

template <class Struct>
Struct sized() {
    Struct out{};
    out.struct_size = sizeof out;
    return out;
}
std::int32_t count(std::size_t n) { return static_cast<std::int32_t>(n); }

void write_points(Problem& its, Input& input) {
    std::size_t const n = its.domain.points.size(), stride = input.below(3) + 1u;
    bool const interleaved = stride > 1 && input.one_in(2);
    std::size_t const reach = (n - 1) * stride + 1;  // nothing behind the last point is read
    its.coordinates.assign(interleaved ? reach + 1 : 2 * reach, 0.0);
    double* const x = its.coordinates.data();
    double* const y = interleaved ? x + 1 : x + reach;
    for (std::size_t k = 0; k < n; ++k)
        x[k * stride] = its.domain.points[k].x, y[k * stride] = its.domain.points[k].y;
    its.mesh.points = {x, y,
                       static_cast<std::int64_t>(stride == 1 && input.one_in(2) ? 0 : stride)};
}

void write_cells(Problem& its, Input& input) {
    hm_mesh& mesh = its.mesh;
    std::vector<Cell> cells = its.domain.cells;
    bool all_triangles = true;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Cell& cell = cells[c];
        all_triangles = all_triangles && cell.size() == 3;
        bool const reversed = input.one_in(4);
        if (reversed) std::reverse(cell.begin(), cell.end());
        std::rotate(cell.begin(), cell.begin() + input.from(0, 2), cell.end());
        // Which of several equally good divisions a polygon gets depends on its first point.
        its.domain.cells[c] = cell;
        if (reversed) std::reverse(its.domain.cells[c].begin(), its.domain.cells[c].end());
    }
    mesh.n_cells = count(cells.size());
    auto const put = [&](std::vector<std::int32_t>& to, Cell const& cell, std::size_t width) {
        for (std::size_t k = 0; k < width; ++k)
            to.push_back(cell[std::min(k, cell.size() - 1)] + mesh.index_base);
    };
    std::uint32_t const layout = its.domain.has_polygons ? 3 : input.below(4);
    if (its.domain.ni > 0 && layout == 0) {
        mesh.cell_layout = HM_CELLS_STRUCTURED;
        mesh.ni = its.domain.ni;
        mesh.nj = its.domain.nj;
        if (input.one_in(2)) mesh.n_cells = 0;
        return;
    }
    if (layout == 1) {
        mesh.cell_layout = all_triangles ? HM_CELLS_TRIANGLES : HM_CELLS_QUADS;
        for (Cell const& cell : cells) put(its.cells, cell, all_triangles ? 3 : 4);
    } else if (layout == 2) {
        mesh.cell_layout = HM_CELLS_MIXED;
        for (Cell const& cell : cells)
            if (cell.size() == 3) put(its.cells, cell, 3);
            else put(its.quads, cell, 4);
        mesh.n_quads = count(its.quads.size() / 4);
        std::stable_partition(its.domain.cells.begin(), its.domain.cells.end(),
                              [](Cell const& cell) { return cell.size() == 3; });
    } else {
        mesh.cell_layout = its.domain.has_polygons ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
        its.cell_start.push_back(mesh.index_base);
        for (Cell const& cell : cells) {
            put(its.cells, cell, cell.size());
            its.cell_start.push_back(count(its.cells.size()) + mesh.index_base);
        }
        mesh.cell_start = its.cell_start.data();
    }
    mesh.cell_points = its.cells.data();
    mesh.quad_points = its.quads.data();
}

// Faces one by one, or each marker's chains of faces as lists of points.
void write_boundary(Problem& its, Input& input) {
    hm_mesh& mesh = its.mesh;
    bool const as_lists = input.one_in(2);
    its.list_start.push_back(mesh.index_base);
    for (std::size_t k = 0; k < its.domain.faces.size(); ++k) {
        Face const& face = its.domain.faces[k];
        if (!as_lists) {
            bool const turned = input.one_in(4);
            its.faces.push_back((turned ? face.to : face.from) + mesh.index_base);
            its.faces.push_back((turned ? face.from : face.to) + mesh.index_base);
            its.face_markers.push_back(face.marker);
            continue;
        }
        bool const goes_on = k > 0 && its.domain.faces[k - 1].to == face.from &&
                             its.domain.faces[k - 1].marker == face.marker;
        if (!goes_on) {
            if (k > 0) its.list_start.push_back(count(its.lists.size()) + mesh.index_base);
            its.lists.push_back(face.from + mesh.index_base);
            its.list_markers.push_back(face.marker);
        }
        its.lists.push_back(face.to + mesh.index_base);
    }
    its.list_start.push_back(count(its.lists.size()) + mesh.index_base);
    mesh.n_faces = count(its.face_markers.size());
    mesh.face_points = its.faces.data();
    mesh.face_markers = its.face_markers.data();
    mesh.n_lists = count(its.list_markers.size());
    mesh.list_start = its.list_start.data();
    mesh.list_points = its.lists.data();
    mesh.list_markers = its.list_markers.data();
}

std::vector<Point> points_of(Domain const& domain, std::vector<std::int32_t> const& numbers) {
    std::vector<Point> points;
    for (std::int32_t const k : numbers)
        points.push_back(domain.points[static_cast<std::size_t>(k)]);
    return points;
}

// The points of a side that slides, one after the other; none if the domain has no such side.
std::vector<std::int32_t> side(Domain const& domain, std::int32_t marker) {
    std::vector<std::int32_t> points;
    for (Face const& face : domain.faces) {
        if (face.marker != marker) continue;
        if (points.empty()) points.push_back(face.from);
        points.push_back(face.to);
    }
    return points;
}

void write_conditions(Problem& its, Input& input) {
    std::int32_t bodies = 0;
    auto const add = [&](std::int32_t marker, std::int32_t kind) -> hm_condition& {
        hm_condition condition = sized<hm_condition>();
        condition.marker = marker;
        condition.kind = kind;
        its.conditions.push_back(condition);
        return its.conditions.back();
    };
    for (std::size_t wall = 0; wall < its.domain.walls.size(); ++wall) {
        std::int32_t const marker = 5 + count(wall);
        if (its.domain.walls_are_loops && input.one_in(3)) {
            hm_condition& body = add(marker, HM_RIGID);
            body.body = bodies++;
            Point const start =
                its.domain.points[static_cast<std::size_t>(its.domain.walls[wall][0])];
            body.x = start.x;
            body.y = start.y;
            continue;
        }
        std::int32_t const first = count(its.on_walls.curve.size());
        its.on_walls.add(points_of(its.domain, its.domain.walls[wall]), its.domain.walls_are_loops,
                         input);
        hm_condition& on_curve = add(marker, HM_ON_CURVE);
        on_curve.first_curve = first;
        on_curve.n_curves = count(its.on_walls.curve.size()) - first;
    }
    std::uint32_t const outside = input.below(5);
    if (outside == 1) add(3, HM_FIXED);
    if (outside == 2) {
        for (std::int32_t const marker : {3, 2}) {
            std::vector<Point> points = points_of(its.domain, side(its.domain, marker));
            if (points.empty()) continue;
            hm_condition& slips = add(marker, HM_SLIP);
            if (input.one_in(2)) continue;
            bool const is_loop =
                points.front().x == points.back().x && points.front().y == points.back().y;
            if (is_loop) points.pop_back();
            CurveArrays& along = its.along[marker - 2];
            along.add(points, is_loop, input);
            along.finish(input);
            slips.along = &along.view;
            slips.n_curves = along.view.n_curves;
        }
    }
    if (outside == 3) add(3, HM_FREE);
    if (its.domain.is_passage && (outside == 0 || outside > 2)) {
        std::int32_t const first = input.any_of({2, 4});
        hm_condition& pair = add(first, HM_ROTATION_PAIR);
        pair.partner = 6 - first;
        pair.x = its.domain.centre.x;
        pair.y = its.domain.centre.y;
    } else if (outside == 4) {
        add(4, HM_PERIODIC_PAIR).partner = 2;
    }
}

// Rows of the header's table of combinations, mostly.
void choose_options(Problem& its, Input& input) {
    Options& o = its.options = Options();
    o.operator_kind = input.from(0, 2);
    if (o.operator_kind != HM_CONFORMAL && input.one_in(3)) o.scheme = input.any_of({2, 2, 1, 3});
    if (o.operator_kind != HM_CONFORMAL && o.scheme != HM_BOUNDED && input.one_in(3))
        o.engine = input.from(1, 2);
    if (o.engine == HM_DIRECT && input.one_in(4)) o.precision = HM_SINGLE;
    if (o.engine != HM_DIRECT) {
        o.levels = input.from(0, 3);
        o.block_width = input.any_of({0, 4, 16});
        o.max_iterations = input.from(1, 20);
    }
    if (o.operator_kind == HM_CONFORMAL && input.one_in(3)) o.offset_correction = 1;
    if (o.operator_kind != HM_LAPLACE && input.one_in(2)) o.exponent_quarters = input.from(-1, 16);
    if (input.one_in(3)) o.kernel = HM_KERNEL_BASELINE;
    if (!input.one_in(4)) return;
    its.executor = sized<hm_executor>();
    its.executor.run = [](void*, std::int32_t n, void (*task)(void*, std::int32_t), void* context) {
        while (n-- > 0) task(context, n);  // in another order
    };
    its.executor.n_threads = input.from(1, 5);
    o.executor = &its.executor;
}

}  // namespace

std::int32_t Problem::functions() const {
    std::int32_t bodies = 0;
    for (hm_condition const& condition : conditions) bodies += condition.kind == HM_RIGID ? 1 : 0;
    return on_walls.view.n_control + 2 * bodies;
}

double Problem::size() const {
    double size = 0;
    for (Point const& p : domain.points) size = std::max({size, std::abs(p.x), std::abs(p.y)});
    return size;
}

std::unique_ptr<Problem> make_problem(Input& input, Cells cells) {
    std::unique_ptr<Problem> out = std::make_unique<Problem>();
    Problem& its = *out;
    its.domain = make_domain(input);
    if (cells == Cells::polygons) make_polygons(its.domain, input);
    its.mesh = sized<hm_mesh>();
    its.mesh.index_base = input.from(0, 1);
    its.mesh.n_points = count(its.domain.points.size());
    write_points(its, input);
    write_cells(its, input);
    write_boundary(its, input);
    write_conditions(its, input);
    choose_options(its, input);

    its.on_walls.finish(input);
    its.problem = sized<hm_problem>();
    its.problem.mesh = &its.mesh;
    its.problem.curves = its.on_walls.curve.empty() ? nullptr : &its.on_walls.view;
    its.problem.n_conditions = count(its.conditions.size());
    its.problem.conditions = its.conditions.data();
    return out;
}

}  // namespace fuzz
