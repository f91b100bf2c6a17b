#include "plan/analysis.hpp"

#include "mesh/guard_shape.hpp"

namespace harmorph {

void Analysis::lay_out(Arena& arena, Problem const& asked, Index n_curves,
                       Index n_conditions) noexcept {
    Mesh const mesh = division.lay_out(arena, asked.mesh);
    Demands const& demands = asked.demands;
    Executor const& executor = asked.executor;
    arena.take(curves, n_curves);
    arena.take(slip_along, demands.slip_curves);
    arena.take(conditions, n_conditions);
    topology.lay_out(arena, mesh);
    boundary.lay_out(arena, mesh);
    orientation_work.lay_out(arena, mesh);
    arena.take(kinds, mesh.n_points);
    if (n_conditions == 0) return;
    Index const components = asked.method.components(demands);
    arena.take(tangent, components == 2 ? mesh.n_points : 0);
    if (components == 2) {
        slip_curves.lay_out(arena, Boundary::max_faces(mesh), demands.slip_curves > 0);
        slip_followers.lay_out(arena, mesh.n_points, Boundary::max_faces(mesh));
    }
    bool const bounded = asked.method.bounded();
    if (bounded) triangulation.lay_out(arena, mesh);
    periodicity.lay_out(arena, mesh.n_points, demands);
    wall.lay_out(arena, mesh);
    wall_work.lay_out(arena, mesh);
    Index const most_unknowns = components * mesh.n_points;
    graph.lay_out(arena, bounded ? triangulation.mesh : mesh, components);
    arena.take(order, most_unknowns);
    layer_work.lay_out(arena, most_unknowns);
    if (!asked.method.traits().factors) return arena.take(border.position, most_unknowns);
    tree.lay_out(arena, most_unknowns);
    border.lay_out(arena, most_unknowns);
    arena.take(border_start, most_unknowns / 2 + 2);
    subtrees.lay_out(arena, executor.is_serial() ? 1 : executor.n_threads);
    Size const shared = arena.mark();
    dissection_work.lay_out(arena, most_unknowns);
    arena.release(shared);
    border.lay_out_passed(arena, most_unknowns);
}

Status Analysis::run(Problem const& asked, Fault& fault) noexcept {
    problem = asked;
    HARMORPH_TRY(problem.progress.report(Phase::structure, 0, fault));
    HARMORPH_TRY(analyse_mesh(fault));
    if (!has_conditions()) return problem.progress.report(Phase::structure, 1, fault);
    HARMORPH_TRY(analyse_unknowns(fault));
    HARMORPH_TRY(problem.progress.report(Phase::structure, 1, fault));
    return analyse_order(fault);
}

Status Analysis::analyse_mesh(Fault& fault) noexcept {
    Mesh& mesh = problem.mesh;
    Mesh const given = mesh;
    HARMORPH_TRY(check_mesh(given, fault, problem.executor));
    if (given.layout == CellLayout::polygons) {
        division.run(given);
        mesh = division.pieces.mesh(given);
        topology.reversed = topology.reversed.first(mesh.n_checked());
    }
    topology.mesh = mesh;
    Edges& edges = topology.edges;
    for (Index k = 0; k < mesh.n_points; ++k) topology.representative[k] = k;
    Sense sense = Sense::mixed;
    problem.executor.for_each(3, [&](Index part) {  // none needs another
        if (part == 0) edges.build(mesh, {}, fault);
        if (part == 1) sense = common_sense(mesh, least_height);
        if (part == 2 && has_conditions()) mesh_fingerprint = fingerprint_of(given);
    });
    HARMORPH_TRY(fault.status);
    HARMORPH_TRY(boundary.mark(topology, fault));
    bool const all_marked = boundary.count == edges.n_boundary;
    if (!all_marked && join_cuts(topology, boundary.head) > 0) {
        HARMORPH_TRY(edges.build(mesh, topology.representative, fault));
        HARMORPH_TRY(boundary.mark(topology, fault));
    }
    HARMORPH_TRY(orient(topology, sense, orientation_work, inverted, fault));
    if (mesh.is_of_pieces()) {
        division.pieces.orient_guards(topology.reversed);
        for (Index i = mesh.n_cells; i < mesh.n_checked() && inverted == none; ++i) {
            if (is_inverted(shape_of(topology, i, mesh.points))) inverted = i;
        }
    }
    HARMORPH_TRY(boundary.order(topology, fault));
    assign_conditions(mesh.points, conditions, boundary);
    classify(edges, boundary, conditions, kinds);
    return Status::ok;
}

Index Analysis::count_used_points() const noexcept {
    Index used = 0;
    for (Index const point : topology.representative)
        used += kinds[point] != PointKind::unused ? 1 : 0;
    return used;
}

Status Analysis::analyse_unknowns(Fault& fault) noexcept {
    Mesh const& mesh = problem.mesh;
    for (Index number = 0; number < curves.count(); ++number)
        HARMORPH_TRY(check_curve(curves[number], number, fault));
    for (Index number = 0; number < slip_along.count(); ++number) {
        HARMORPH_TRY(check_curve(slip_along[number], number, fault));
    }
    HARMORPH_TRY(check_conditions(conditions, curves.count(), boundary, fault));
    if (inverted != none) {
        CellCorners const corners(shape_of(topology, inverted, mesh.points));
        return fault.refuse(Status::bad_mesh,
                            "cell # is inverted or empty: its smallest corner area is ~",
                            cell_item(mesh.number(inverted)), {}, 0.5 * corners.smallest());
    }
    HARMORPH_TRY(check_heights(fault));
    if (problem.method.bounded()) HARMORPH_TRY(triangulation.build(topology, fault));
    bool const kinds_are_final = tangent.empty() && !problem.demands.periodic();
    problem.executor.for_each(kinds_are_final ? 2 : 1, [&](Index part) {
        if (part == 0) find_wall(fault);
        if (part == 1) graph.build(stencil(), kinds);
    });
    HARMORPH_TRY(fault.status);
    if (!tangent.empty()) {
        HARMORPH_TRY(find_slip_lines(mesh.points, boundary, conditions, {slip_along, wall_work},
                                     kinds, tangent, slip_curves, fault));
    }
    if (problem.demands.periodic()) {
        HARMORPH_TRY(tie_periodic(topology, boundary, conditions, wall_work.chain, kinds, tangent,
                                  periodicity, fault));
        slip_curves.keep_sliding(kinds);
    }
    if (!tangent.empty()) {
        slip_followers.find(topology, boundary, conditions, kinds, slip_curves,
                            larger(problem.method.quarters, Index{0}), problem.executor);
    }
    if (!kinds_are_final) graph.build(stencil(), kinds);
    if (graph.n == 0)
        return fault.refuse(Status::bad_condition,
                            "no mesh point is free to move: there is nothing to solve");
    HARMORPH_TRY(check_parts(fault));
    matrix = Matrix::count(graph, matrix_kind(), periodicity);
    conditions_fingerprint = slip_curves.fingerprint_with(fingerprint_of(kinds, wall));
    return Status::ok;
}

void Analysis::find_wall(Fault& fault) noexcept {
    Points const points = problem.mesh.points;
    if (failed(parametrise(topology, boundary, conditions, curves, problem.given, wall_work, wall,
                           fault)))
        return;
    find_offsets(points, conditions, curves, problem.method.offset_correction != 0, wall);
    check_offsets(fault);
}

// Cells so thin that rounding of moved coordinates decides whether they are inverted.
Status Analysis::check_heights(Fault& fault) const noexcept {
    Real size = 0;
    for (Index k = 0; k < problem.mesh.n_points; ++k)
        size = larger(size, largest_of(problem.mesh.points[k]));
    if (problem.mesh.n_guards == 0 && least_height >= resolved_height(size)) return Status::ok;
    Real height = 0;
    auto const is_too_thin = [&](Index i, Cell const&) {
        CellShape const shape = shape_of(topology, i, problem.mesh.points);
        height = CellCorners(shape).smallest_height(shape.n);
        return !(height >=
                 resolved_height(CellShape(topology.cell(i), problem.mesh.points, false)));
    };
    Index const cell = problem.mesh.find_cell(0, problem.mesh.n_checked(), is_too_thin);
    if (cell == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "cell # has a height of ~, too small for the digits of its coordinates",
                        cell_item(problem.mesh.number(cell)), {}, height);
}

// The functions of a body are offsets from its centre; in single precision they must neither
// overflow nor vanish, also when they are multiplied with entries of the matrix and reduced to
// residuals.
Status Analysis::check_offsets(Fault& fault) const noexcept {
    constexpr Real largest = 1e24, smallest = 1e-12;
    if (problem.method.precision != Precision::in_single || problem.demands.bodies == 0)
        return Status::ok;
    Real size = 0;
    Index farthest = none;
    for (Index slot = 0; slot < wall.count; ++slot) {
        Real const found = wall.curve[slot] < curves.count() ? 0 : length(wall.offset[slot]);
        if (found <= size && farthest != none) continue;
        size = found;
        farthest = wall.point[slot];
    }
    if (size >= smallest && size <= largest) return Status::ok;
    return fault.refuse(
        Status::unsupported,
        "point # is ~ from the centre of its body: single precision takes 1e-12 .. 1e24",
        point_item(farthest), {}, size);
}

// Every part of the mesh must hang on a known value.
Status Analysis::check_parts(Fault& fault) noexcept {
    Demands const& demands = problem.demands;
    if (!demands.free && !demands.slip && !demands.periodic()) return Status::ok;
    Index const floating = graph.first_floating(stencil(), kinds, order, layer_work.reached);
    if (floating == none) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "point # is in a part of the mesh that nothing holds",
                        point_item(floating));
}

Status Analysis::analyse_order(Fault& fault) noexcept {
    Progress const& progress = problem.progress;
    HARMORPH_TRY(progress.report(Phase::ordering, 0, fault));
    if (problem.method.traits().factors) {
        dissect(graph, problem.mesh.points, dissection_work, problem.executor, order, tree);
    } else {
        order_by_layers(topology, kinds, graph, layer_work, order);
    }
    HARMORPH_TRY(progress.report(Phase::ordering, 1, fault));
    HARMORPH_TRY(progress.report(Phase::symbolic, 0, fault));
    if (problem.method.traits().factors) {
        fronts = count_borders(graph, order, tree, border, problem.executor, border_start);
        subtrees.choose(tree, border_start);
    } else {
        for (Index k = 0; k < graph.n; ++k) border.position[order[k]] = k;
    }
    return progress.report(Phase::symbolic, 1, fault);
}

BasisSource Analysis::basis_source() const noexcept {
    return {topology,       mesh_fingerprint, conditions_fingerprint,
            problem.method, problem.demands,  curves,
            conditions,     boundary,         wall,
            wall_work.slot, &division.pieces};
}

MatrixKind Analysis::matrix_kind() const noexcept {
    if (problem.demands.slip) return MatrixKind::coupled_xy;
    return problem.method.conformal() || problem.demands.rotation ? MatrixKind::complex
                                                                  : MatrixKind::real;
}

bool Analysis::is_wall_face(Index face) const noexcept {
    const Condition* const condition = condition_of(conditions, boundary, face);
    return condition != nullptr && condition->is_wall();
}

Index Analysis::count_wall_faces() const noexcept {
    Index n = 0;
    for (Index face = 0; face < boundary.count; ++face) n += is_wall_face(face) ? 1 : 0;
    return n;
}

}  // namespace harmorph
