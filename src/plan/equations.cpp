#include "plan/equations.hpp"

#include "operators/bounded.hpp"
#include "operators/stiffness.hpp"

namespace harmorph {

void Equations::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Problem const& problem = analysis.problem;
    Index const n = analysis.graph.n, n_points = problem.mesh.n_points,
                n_cells = problem.mesh.n_cells;
    Mesh const& mesh = problem.mesh;
    Index const n_delaunay = problem.method.bounded() ? analysis.triangulation.edges.count() : 0;
    bool const weighted = problem.method.quarters > 0;
    arena.take(dof_of, n);
    arena.take(cells.reversed, mesh.n_checked());
    if (mesh.is_of_pieces()) pieces.lay_out(arena, mesh.n_given, mesh.n_cells, mesh.n_guards);
    arena.take(kinds, n_points);
    wall.lay_out(arena, static_cast<Size>(analysis.count_wall_faces()));
    slip_curves.lay_out_copy(arena, analysis.slip_curves);
    slip_followers.lay_out_copy(arena, analysis.slip_curves.count > 0 ? n_points : 0);
    arena.take(delaunay_edges, n_delaunay);
    arena.take(conductivity, !weighted ? 0 : n_delaunay > 0 ? n_delaunay : n_cells);
    matrix.lay_out(arena, n_points, n, analysis.wall.count, analysis.matrix);
    if (problem.method.nodal_gradients())
        nodal.lay_out(arena, problem.mesh, analysis.topology.edges.count());
}

void Equations::init(Analysis const& analysis) noexcept {
    cells.mesh = analysis.problem.mesh;
    if (pieces.given()) {
        pieces.copy_from(analysis.division.pieces);
        cells.mesh.cell_points = pieces.point.data();
        cells.mesh.piece_start = pieces.start.data();
        cells.mesh.guard_start = pieces.guard_start.data();
        cells.mesh.guard_kind = pieces.kind.data();
    }
    method = analysis.problem.method;
    method.kernel = resolved(method.kernel, analysis.problem.executor.kernel);
    for (Index k = 0; k < dof_of.count(); ++k) dof_of[k] = analysis.graph.line[analysis.order[k]];
    copy(cells.reversed, Span<const std::uint8_t>(analysis.topology.reversed));
    for (Index k = 0; k < kinds.count(); ++k)
        kinds[k] = analysis.kinds[analysis.topology.representative[k]];
    slip_curves.copy_from(analysis.slip_curves);
    slip_followers.copy_from(analysis.slip_followers);
    wall.kernel = method.kernel;
    wall.translations = analysis.periodicity.translations;
    wall.rotation = analysis.periodicity.rotation;
    wall.choose(analysis.boundary, [&](Index face) { return analysis.is_wall_face(face); });
    analysed_coordinates = coordinates_fingerprint(cells.mesh.points, cells.mesh.n_points);
    if (!method.bounded()) return;
    Index n = 0;
    analysis.triangulation.for_each_edge(
        [&](DelaunayEdge const& edge) { delaunay_edges[n++] = edge; });
}

void Equations::build(Analysis const& analysis) noexcept {
    matrix.frames_change = slip_curves.count > 0;
    matrix.build(analysis.topology.representative, analysis.graph, analysis.order,
                 analysis.border.position, analysis.wall_work.slot, analysis.tangent,
                 analysis.periodicity);
    if (!method.nodal_gradients()) return;
    Topology topology = analysis.topology;
    topology.mesh = cells.mesh;  // the copies, which outlive the analysis
    topology.reversed = cells.reversed;
    nodal.init(topology, matrix, method.scheme == Scheme::nodal_gradient);
}

// To the tangents of the curves where points slide at these coordinates.
void Equations::turn_frames(Points points) const noexcept {
    if (slip_curves.count == 0) return;
    slip_curves.for_each([&](Index slot, Index point) {
        matrix.frame[point] = slip_curves.nearest(slot, points[point]).tangent;
    });
    for (Index k = 0; k < cells.mesh.n_points; ++k) {
        if (matrix.slips(k)) matrix.frame[k] = matrix.frame[point_of(matrix.row_of[2 * k])];
    }
}

Status Equations::assemble(Points points, Executor const& executor, Fault& fault) noexcept {
    turn_frames(points);
    HARMORPH_TRY(method.bounded() ? assemble_edges(points, executor, fault)
                                  : assemble_cells(points, executor, fault));
    if (method.nodal_gradients()) nodal.scheme.measure(points);
    return Status::ok;
}

Status Equations::assemble_cells(Points points, Executor const& executor, Fault& fault) noexcept {
    if (!conductivity.empty()) {
        wall.build(points);
        weigh_cells(wall, cells.mesh, points, method.quarters, conductivity, executor);
    }
    Index const inverted =
        assemble_stiffness(cells, points, conductivity, method.conformal(), matrix, executor);
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, "cell # is inverted or empty at the given coordinates",
                        cell_item(cells.mesh.number(inverted)));
}

bool Equations::change_operator(Operator operator_kind, Index quarters) noexcept {
    bool const conformal = operator_kind == Operator::conformal;
    bool const known = method.scheme == Scheme::compact && (quarters == 0 || !conductivity.empty());
    if (!known || (conformal && matrix.kind == MatrixKind::real)) return false;
    method.operator_kind = operator_kind;
    method.quarters = quarters;
    return true;
}

Status Equations::assemble_edges(Points points, Executor const& executor, Fault& fault) noexcept {
    if (coordinates_fingerprint(points, cells.mesh.n_points) != analysed_coordinates) {
        return fault.refuse(
            Status::unsupported,
            "bounded scheme: its triangles fit the analysed coordinates alone; analyse again");
    }
    if (!conductivity.empty()) {
        wall.build(points);
        weigh_edges(wall, delaunay_edges, points, method.quarters, conductivity, executor);
    }
    Index const thin = assemble_bounded(delaunay_edges, points, conductivity, matrix);
    if (thin == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "a triangle at the points # and @ is too thin for its area to be computed",
                        point_item(delaunay_edges[thin].begin),
                        point_item(delaunay_edges[thin].end));
}

}  // namespace harmorph
