#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include "polygons.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {
namespace {

std::int32_t count(std::size_t n) { return static_cast<std::int32_t>(n); }

void write_points(Problem& problem, Input& input) {
    std::size_t const n = problem.domain.points.size(), stride = input.below(3) + 1u;
    bool const interleaved = stride > 1 && input.one_in(2);
    std::size_t const reach = (n - 1) * stride + 1;  // nothing behind the last point is read
    problem.coordinates.assign(interleaved ? reach + 1 : 2 * reach, 0.0);
    double* const x = problem.coordinates.data();
    double* const y = interleaved ? x + 1 : x + reach;
    for (std::size_t k = 0; k < n; ++k)
        x[k * stride] = problem.domain.points[k].x, y[k * stride] = problem.domain.points[k].y;
    problem.mesh.points = {x, y,
                           static_cast<std::int64_t>(stride == 1 && input.one_in(2) ? 0 : stride)};
}

void write_cells(Problem& problem, Input& input) {
    hm_mesh& mesh = problem.mesh;
    std::vector<Cell> cells = problem.domain.cells;
    bool all_triangles = true;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Cell& cell = cells[c];
        all_triangles = all_triangles && cell.size() == 3;
        bool const reversed = input.one_in(4);
        if (reversed) std::reverse(cell.begin(), cell.end());
        std::rotate(cell.begin(), cell.begin() + input.from(0, 2), cell.end());
        // The first point of a polygon decides which of several equally good divisions the polygon
        // gets.
        problem.domain.cells[c] = cell;
        if (reversed) std::reverse(problem.domain.cells[c].begin(), problem.domain.cells[c].end());
    }
    mesh.n_cells = count(cells.size());
    auto const put = [&](std::vector<std::int32_t>& to, Cell const& cell, std::size_t width) {
        for (std::size_t k = 0; k < width; ++k)
            to.push_back(cell[std::min(k, cell.size() - 1)] + mesh.index_base);
    };
    std::uint32_t const layout = problem.domain.has_polygons ? 3 : input.below(4);
    if (problem.domain.ni > 0 && layout == 0) {
        mesh.cell_layout = HM_CELLS_STRUCTURED;
        mesh.ni = problem.domain.ni;
        mesh.nj = problem.domain.nj;
        if (input.one_in(2)) mesh.n_cells = 0;
        return;
    }
    if (layout == 1) {
        mesh.cell_layout = all_triangles ? HM_CELLS_TRIANGLES : HM_CELLS_QUADS;
        for (Cell const& cell : cells) put(problem.cells, cell, all_triangles ? 3 : 4);
    } else if (layout == 2) {
        mesh.cell_layout = HM_CELLS_MIXED;
        for (Cell const& cell : cells)
            if (cell.size() == 3) put(problem.cells, cell, 3);
            else put(problem.quads, cell, 4);
        mesh.n_quads = count(problem.quads.size() / 4);
        std::stable_partition(problem.domain.cells.begin(), problem.domain.cells.end(),
                              [](Cell const& cell) { return cell.size() == 3; });
    } else {
        mesh.cell_layout = problem.domain.has_polygons ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
        problem.cell_start.push_back(mesh.index_base);
        for (Cell const& cell : cells) {
            put(problem.cells, cell, cell.size());
            problem.cell_start.push_back(count(problem.cells.size()) + mesh.index_base);
        }
        mesh.cell_start = problem.cell_start.data();
    }
    mesh.cell_points = problem.cells.data();
    mesh.quad_points = problem.quads.data();
}

// Faces one by one, or each marker's chains of faces as lists of points.
void write_boundary(Problem& problem, Input& input) {
    hm_mesh& mesh = problem.mesh;
    bool const as_lists = input.one_in(2);
    problem.list_start.push_back(mesh.index_base);
    for (std::size_t k = 0; k < problem.domain.faces.size(); ++k) {
        Face const& face = problem.domain.faces[k];
        if (!as_lists) {
            bool const turned = input.one_in(4);
            problem.faces.push_back((turned ? face.to : face.from) + mesh.index_base);
            problem.faces.push_back((turned ? face.from : face.to) + mesh.index_base);
            problem.face_markers.push_back(face.marker);
            continue;
        }
        bool const goes_on = k > 0 && problem.domain.faces[k - 1].to == face.from &&
                             problem.domain.faces[k - 1].marker == face.marker;
        if (!goes_on) {
            if (k > 0) problem.list_start.push_back(count(problem.lists.size()) + mesh.index_base);
            problem.lists.push_back(face.from + mesh.index_base);
            problem.list_markers.push_back(face.marker);
        }
        problem.lists.push_back(face.to + mesh.index_base);
    }
    problem.list_start.push_back(count(problem.lists.size()) + mesh.index_base);
    mesh.n_faces = count(problem.face_markers.size());
    mesh.face_points = problem.faces.data();
    mesh.face_markers = problem.face_markers.data();
    mesh.n_lists = count(problem.list_markers.size());
    mesh.list_start = problem.list_start.data();
    mesh.list_points = problem.lists.data();
    mesh.list_markers = problem.list_markers.data();
}

std::vector<Point> points_of(Domain const& domain, std::vector<std::int32_t> const& numbers) {
    std::vector<Point> points;
    for (std::int32_t const k : numbers) points.push_back(domain.points[at(k)]);
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

void write_conditions(Problem& problem, Input& input) {
    std::int32_t bodies = 0;
    auto const add = [&](std::int32_t marker, std::int32_t kind) -> hm_condition& {
        hm_condition condition = sized<hm_condition>();
        condition.marker = marker;
        condition.kind = kind;
        problem.conditions.push_back(condition);
        return problem.conditions.back();
    };
    for (std::size_t wall = 0; wall < problem.domain.walls.size(); ++wall) {
        std::int32_t const marker = 5 + count(wall);
        if (problem.domain.walls_are_loops && input.one_in(3)) {
            hm_condition& body = add(marker, HM_RIGID);
            body.body = bodies++;
            Point const start = problem.domain.points[at(problem.domain.walls[wall][0])];
            body.x = start.x;
            body.y = start.y;
            continue;
        }
        std::int32_t const first = count(problem.on_walls.curve.size());
        problem.on_walls.add(points_of(problem.domain, problem.domain.walls[wall]),
                             problem.domain.walls_are_loops, input);
        hm_condition& on_curve = add(marker, HM_ON_CURVE);
        on_curve.first_curve = first;
        on_curve.n_curves = count(problem.on_walls.curve.size()) - first;
    }
    std::uint32_t const outside = input.below(5);
    if (outside == 1) add(3, HM_FIXED);
    if (outside == 2) {
        for (std::int32_t const marker : {3, 2}) {
            std::vector<Point> points = points_of(problem.domain, side(problem.domain, marker));
            if (points.empty()) continue;
            hm_condition& slips = add(marker, HM_SLIP);
            if (input.one_in(2)) continue;
            bool const is_loop =
                points.front().x == points.back().x && points.front().y == points.back().y;
            if (is_loop) points.pop_back();
            CurveArrays& along = problem.along[marker - 2];
            along.add(points, is_loop, input);
            along.finish(input);
            slips.along = &along.view;
            slips.n_curves = along.view.n_curves;
        }
    }
    if (outside == 3) add(3, HM_FREE);
    if (problem.domain.is_passage && (outside == 0 || outside > 2)) {
        std::int32_t const first = input.any_of({2, 4});
        hm_condition& pair = add(first, HM_ROTATION_PAIR);
        pair.partner = 6 - first;
        pair.x = problem.domain.centre.x;
        pair.y = problem.domain.centre.y;
    } else if (outside == 4) {
        add(4, HM_PERIODIC_PAIR).partner = 2;
    }
    if (!input.one_in(6)) return;
    auto const some_marker = [&] {
        std::vector<Face> const& faces = problem.domain.faces;
        return faces[input.below(static_cast<std::uint32_t>(faces.size()))].marker;
    };
    std::int32_t const one = some_marker(), other = some_marker();
    if (one == other) return;
    add(one, HM_INTERFACE).partner = other;
    problem.domain.interface_sides[0] = one;
    problem.domain.interface_sides[1] = other;
}

// Rows of the header's table of combinations, mostly.
void choose_options(Problem& problem, Input& input) {
    Options& o = problem.options = Options();
    o.operator_kind = input.from(0, 2);
    if (o.operator_kind != HM_CONFORMAL && input.one_in(3)) o.scheme = input.any_of({2, 2, 1, 3});
    if (o.operator_kind != HM_CONFORMAL && o.scheme != HM_BOUNDED && input.one_in(3))
        o.engine = input.from(1, 2);
    if (o.engine != HM_DIRECT) {
        o.levels = input.from(0, 3);
        o.block_width = input.any_of({0, 4, 16});
        o.max_iterations = input.from(1, 20);
    }
    if (o.operator_kind == HM_CONFORMAL && input.one_in(3)) o.offset_correction = 1;
    if (o.operator_kind != HM_LAPLACE && input.one_in(2)) o.exponent = input.from(-1, 16) / 4.0;
    if (!input.one_in(4)) return;
    problem.executor = sized<hm_executor>();
    problem.executor.run = [](void*, std::int32_t n, void (*task)(void*, std::int32_t),
                              void* context) {
        while (n-- > 0) task(context, n);  // in another order
    };
    problem.executor.n_threads = input.from(1, 5);
    o.executor = &problem.executor;
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

void Problem::move_to(std::vector<Point> const& points) {
    domain.points = points;
    std::size_t const stride = std::size_t(std::max<std::int64_t>(mesh.points.stride, 1));
    double* const x = coordinates.data() + (mesh.points.x - coordinates.data());
    double* const y = coordinates.data() + (mesh.points.y - coordinates.data());
    for (std::size_t k = 0; k < points.size(); ++k)
        x[k * stride] = points[k].x, y[k * stride] = points[k].y;
}

std::unique_ptr<Problem> make_problem(Input& input, Cells cells) {
    std::unique_ptr<Problem> out = std::make_unique<Problem>();
    Problem& problem = *out;
    problem.domain = make_domain(input);
    if (cells == Cells::polygons) make_polygons(problem.domain, input);
    problem.mesh = sized<hm_mesh>();
    problem.mesh.index_base = input.from(0, 1);
    problem.mesh.n_points = count(problem.domain.points.size());
    write_points(problem, input);
    write_cells(problem, input);
    write_boundary(problem, input);
    write_conditions(problem, input);
    choose_options(problem, input);

    problem.on_walls.finish(input);
    problem.problem = sized<hm_problem>();
    problem.problem.mesh = &problem.mesh;
    problem.problem.curves = problem.on_walls.curve.empty() ? nullptr : &problem.on_walls.view;
    problem.problem.n_conditions = count(problem.conditions.size());
    problem.problem.conditions = problem.conditions.data();
    return out;
}

}  // namespace fuzz
