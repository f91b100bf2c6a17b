#include "plan/equations.hpp"

#include "operators/assembly.hpp"

namespace harmorph {

void Equations::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Problem const& problem = analysis.problem();
    Index const n = analysis.graph().n, n_points = problem.mesh.n_points,
                n_cells = problem.mesh.n_cells;
    Mesh const& mesh = problem.mesh;
    Index const n_delaunay = problem.method.bounded() ? analysis.triangulation().edges.count() : 0;
    arena.take(dof_of_, n);
    arena.take(cells_.reversed, mesh.n_checked());
    pieces_.lay_out_copy(arena, mesh);
    arena.take(kinds_, n_points);
    walls_.lay_out(arena, static_cast<Size>(analysis.count_wall_faces()));
    slip_curves_.lay_out_copy(arena, analysis.slip_curves());
    slip_followers_.lay_out_copy(arena, analysis.slip_curves().count > 0 ? n_points : 0);
    arena.take(delaunay_edges_, n_delaunay);
    arena.take(conductivity_,
               conductivities_of(problem.method, n_delaunay > 0 ? n_delaunay : n_cells));
    matrix_.lay_out(arena, n_points, n, analysis.wall().count, analysis.matrix_sizes());
    if (problem.method.nodal_gradients())
        nodal_.lay_out(arena, problem.mesh, analysis.topology().edges.count());
}

void Equations::init(Analysis const& analysis) noexcept {
    cells_.mesh = analysis.problem().mesh;
    pieces_.copy_from(analysis.pieces(), cells_.mesh);
    method_ = analysis.problem().method;
    method_.kernel = resolved(Kernel::automatic, analysis.problem().executor.kernel);
    for (Index k = 0; k < dof_of_.count(); ++k)
        dof_of_[k] = analysis.graph().line[analysis.order()[k]];
    copy(cells_.reversed, Span<const std::uint8_t>(analysis.topology().reversed));
    for (Index k = 0; k < kinds_.count(); ++k)
        kinds_[k] = analysis.kinds()[analysis.topology().representative[k]];
    slip_curves_.copy_from(analysis.slip_curves());
    slip_followers_.copy_from(analysis.slip_followers());
    walls_.kernel = method_.kernel;
    walls_.translations = analysis.periodicity().translations;
    walls_.rotation = analysis.periodicity().rotation;
    walls_.choose(analysis.boundary(), [&](Index face) { return analysis.is_wall_face(face); });
    analysed_coordinates_ = coordinates_fingerprint(cells_.mesh.points, cells_.mesh.n_points);
    if (!method_.bounded()) return;
    Index n = 0;
    analysis.triangulation().for_each_edge(
        [&](DelaunayEdge const& edge) { delaunay_edges_[n++] = edge; });
}

void Equations::build(Analysis const& analysis) noexcept {
    matrix_.set_directions_change(slip_curves_.count > 0);
    matrix_.build(analysis.topology().representative, analysis.graph(), analysis.order(),
                  analysis.border().position, analysis.wall_slot(), analysis.tangent(),
                  analysis.periodicity());
    if (!method_.nodal_gradients()) return;
    Topology topology = analysis.topology();
    topology.mesh = cells_.mesh;  // These are the copies, which outlive the analysis.
    topology.reversed = cells_.reversed;
    nodal_.init(topology, matrix_, method_.scheme == Scheme::nodal_gradient);
}

// Rotates the dofs of points that slip along curves to the tangents at these coordinates.
void Equations::rotate_tangents(Points points) const noexcept {
    if (slip_curves_.count == 0) return;
    slip_curves_.for_each([&](Index slot, Index point) {
        matrix_.set_tangent(point, slip_curves_.nearest(slot, points[point]).tangent);
    });
    for (Index k = 0; k < cells_.mesh.n_points; ++k) {
        if (matrix_.slips(k))
            matrix_.set_tangent(k, matrix_.direction(point_of(matrix_.first_row(k))));
    }
}

Status Equations::assemble(Points points, Executor const& executor, Fault& fault) noexcept {
    rotate_tangents(points);
    HARMORPH_TRY(method_.bounded() ? assemble_edges(points, executor, fault)
                                   : assemble_cells(points, executor, fault));
    if (method_.nodal_gradients()) nodal_.scheme.measure(points);
    return Status::ok;
}

Status Equations::assemble_cells(Points points, Executor const& executor, Fault& fault) noexcept {
    Index const inverted = assemble_operator(method_, cells_, points, walls_, points, conductivity_,
                                             matrix_, executor);
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "cell # is inverted or has no area at the given coordinates",
                        cell_item(cells_.mesh.number(inverted)));
}

bool Equations::change_operator(Operator operator_kind, Index exponent_quarters) noexcept {
    bool const is_complex = operator_traits[static_cast<Index>(operator_kind)].is_complex;
    bool const known =
        method_.scheme == Scheme::compact && (exponent_quarters == 0 || !conductivity_.empty());
    if (!known || (is_complex && matrix_.kind() == MatrixKind::real)) return false;
    method_.operator_kind = operator_kind;
    method_.exponent_quarters = exponent_quarters;
    return true;
}

Status Equations::assemble_edges(Points points, Executor const& executor, Fault& fault) noexcept {
    if (coordinates_fingerprint(points, cells_.mesh.n_points) != analysed_coordinates_) {
        return fault.refuse(Status::unsupported,
                            "the triangles of the bounded scheme belong to the coordinates of the "
                            "analysis; analyse the moved mesh again");
    }
    if (!conductivity_.empty()) {
        walls_.build(points);
        weigh_edges(walls_, delaunay_edges_, points, method_.exponent_quarters, conductivity_,
                    executor);
    }
    Index const thin = assemble_bounded(delaunay_edges_, points, conductivity_, matrix_);
    if (thin == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "a triangle at the points # and @ is too thin for its area to be computed",
                        point_item(delaunay_edges_[thin].begin),
                        point_item(delaunay_edges_[thin].end));
}

}  // namespace harmorph
