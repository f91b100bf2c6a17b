#include "plan/analysis.hpp"

#include "mesh/cell_shape.hpp"

namespace harmorph {

void Analysis::lay_out(Arena& arena, Problem const& asked, Index n_curves,
                       Index n_conditions) noexcept {
    Mesh const mesh = division_.lay_out(arena, asked.mesh);
    Demands const& demands = asked.demands;
    Executor const& executor = asked.executor;
    arena.take(curves_, n_curves);
    arena.take(slip_along_, demands.slip_curves);
    arena.take(conditions_, n_conditions);
    topology_.lay_out(arena, mesh);
    boundary_.lay_out(arena, mesh);
    orientation_work_.lay_out(arena, mesh);
    arena.take(kinds_, mesh.n_points);
    if (n_conditions == 0) return;
    Index const components = asked.method.components(demands);
    arena.take(tangent_, components == 2 ? mesh.n_points : 0);
    if (components == 2) {
        slip_curves_.lay_out(arena, Boundary::max_faces(mesh), demands.slip_curves > 0);
        slip_followers_.lay_out(arena, mesh.n_points, Boundary::max_faces(mesh));
    }
    bool const bounded = asked.method.bounded();
    if (bounded) triangulation_.lay_out(arena, mesh);
    periodicity_.lay_out(arena, mesh.n_points, demands);
    wall_.lay_out(arena, mesh);
    wall_work_.lay_out(arena, mesh);
    Index const max_unknowns = components * mesh.n_points;
    graph_.lay_out(arena, bounded ? triangulation_.mesh : mesh, components);
    arena.take(order_, max_unknowns);
    layer_work_.lay_out(arena, max_unknowns);
    if (!asked.method.traits().factors) return arena.take(border_.position, max_unknowns);
    tree_.lay_out(arena, max_unknowns);
    border_.lay_out(arena, max_unknowns);
    arena.take(border_start_, max_unknowns / 2 + 2);
    subtrees_.lay_out(arena, executor.is_serial() ? 1 : executor.n_threads);
    auto const shared = arena.mark();
    dissection_work_.lay_out(arena, max_unknowns);
    arena.release(shared);
    border_.lay_out_passed(arena, max_unknowns);
}

Status Analysis::run(Problem const& asked, Fault& fault) noexcept {
    problem_ = asked;
    HARMORPH_TRY(problem_.progress.report(Phase::structure, 0, fault));
    HARMORPH_TRY(analyse_mesh(fault));
    if (!has_conditions()) return problem_.progress.report(Phase::structure, 1, fault);
    HARMORPH_TRY(analyse_unknowns(fault));
    HARMORPH_TRY(problem_.progress.report(Phase::structure, 1, fault));
    return analyse_order(fault);
}

Status Analysis::analyse_mesh(Fault& fault) noexcept {
    Mesh& mesh = problem_.mesh;
    Mesh const given = mesh;
    HARMORPH_TRY(check_mesh(given, fault, problem_.executor));
    if (given.layout == CellLayout::polygons) {
        division_.run(given);
        mesh = division_.pieces.mesh(given);
        topology_.reversed = topology_.reversed.first(mesh.n_checked());
    }
    topology_.mesh = mesh;
    Edges& edges = topology_.edges;
    for (Index k = 0; k < mesh.n_points; ++k) topology_.representative[k] = k;
    Sense sense = Sense::mixed;
    // None of the three tasks needs the result of another.
    problem_.executor.for_each(3, [&](Index task) {
        if (task == 0) edges.build(mesh, {}, fault);
        if (task == 1) sense = common_orientation(mesh, min_height_);
        if (task == 2 && has_conditions()) mesh_fingerprint_ = fingerprint_of(given);
    });
    HARMORPH_TRY(fault.status);
    HARMORPH_TRY(boundary_.mark(topology_, fault));
    HARMORPH_TRY(join_cuts(topology_, boundary_, fault, [&] {
        if (!failed(edges.build(mesh, topology_.representative, fault)))
            boundary_.mark(topology_, fault);
    }));
    HARMORPH_TRY(orient(topology_, sense, orientation_work_, inverted_, fault));
    division_.pieces.orient_guards(topology_.reversed);
    for (Index i = mesh.n_cells; i < mesh.n_checked() && inverted_ == none; ++i) {
        if (is_inverted(shape_of(topology_, i, mesh.points))) inverted_ = i;
    }
    HARMORPH_TRY(boundary_.order(topology_, fault));
    assign_conditions(mesh.points, conditions_, boundary_);
    classify(edges, boundary_, conditions_, kinds_);
    return Status::ok;
}

Index Analysis::count_used_points() const noexcept {
    Index used = 0;
    for (Index const point : topology_.representative)
        used += kinds_[point] != PointKind::unused ? 1 : 0;
    return used;
}

Status Analysis::analyse_unknowns(Fault& fault) noexcept {
    Mesh const& mesh = problem_.mesh;
    for (Index number = 0; number < curves_.count(); ++number)
        HARMORPH_TRY(check_curve(curves_[number], number, fault));
    for (Index number = 0; number < slip_along_.count(); ++number) {
        HARMORPH_TRY(check_curve(slip_along_[number], number, fault));
    }
    HARMORPH_TRY(check_conditions(conditions_, curves_.count(), boundary_, fault));
    HARMORPH_TRY(check_fluxes(problem_.fluxes, topology_, boundary_, conditions_, fault));
    if (inverted_ != none) {
        CellCorners const corners(shape_of(topology_, inverted_, mesh.points));
        return fault.refuse(
            Status::bad_mesh,
            "cell # is inverted or has no area: the smallest area at its corners is ~",
            cell_item(mesh.number(inverted_)), {}, 0.5 * corners.smallest());
    }
    HARMORPH_TRY(check_heights(fault));
    if (problem_.method.bounded()) HARMORPH_TRY(triangulation_.build(topology_, fault));
    bool const kinds_are_final = tangent_.empty() && !problem_.demands.periodic();
    problem_.executor.for_each(kinds_are_final ? 2 : 1, [&](Index task) {
        if (task == 0) find_wall(fault);
        if (task == 1) graph_.build(stencil(), kinds_);
    });
    HARMORPH_TRY(fault.status);
    if (!tangent_.empty()) {
        HARMORPH_TRY(find_slip_lines(mesh.points, boundary_, conditions_, {slip_along_, wall_work_},
                                     kinds_, tangent_, slip_curves_, fault));
    }
    if (problem_.demands.periodic()) {
        HARMORPH_TRY(tie_periodic(topology_, boundary_, conditions_, wall_work_.chain_point, kinds_,
                                  tangent_, periodicity_, fault));
        slip_curves_.keep_slipping(kinds_);
    }
    if (!tangent_.empty()) {
        slip_followers_.find(topology_, boundary_, conditions_, kinds_, slip_curves_,
                             max(problem_.method.exponent_quarters, Index{0}), problem_.executor);
    }
    if (!kinds_are_final) graph_.build(stencil(), kinds_);
    if (graph_.n == 0)
        return fault.refuse(Status::bad_condition,
                            "no mesh point is free to move, so there is nothing to solve");
    HARMORPH_TRY(check_regions(fault));
    matrix_ = Matrix::count(graph_, matrix_kind(problem_.method, problem_.demands), periodicity_);
    conditions_fingerprint_ = fingerprint_with(
        slip_curves_.fingerprint_with(fingerprint_of(kinds_, wall_)), problem_.fluxes);
    return Status::ok;
}

void Analysis::find_wall(Fault& fault) noexcept {
    Points const points = problem_.mesh.points;
    if (failed(parametrise(topology_, boundary_, conditions_, curves_, problem_.given,
                           problem_.max_curve_distance, wall_work_, wall_, fault)))
        return;
    find_offsets(points, conditions_, curves_, problem_.method.offset_correction != 0, wall_);
    find_shared(boundary_, conditions_, curves_, wall_work_.slot, wall_, fault);
}

// Refuses cells so thin that rounding of moved coordinates decides whether they are inverted.
Status Analysis::check_heights(Fault& fault) const noexcept {
    Real size = 0;
    for (Index k = 0; k < problem_.mesh.n_points; ++k)
        size = max(size, largest_of(problem_.mesh.points[k]));
    if (problem_.mesh.n_guards == 0 && min_height_ >= resolved_height(size)) return Status::ok;
    Real height = 0;
    auto const is_too_thin = [&](Index i, Cell const&) {
        CellShape const shape = shape_of(topology_, i, problem_.mesh.points);
        height = CellCorners(shape).smallest_height(shape.n);
        return !(height >=
                 resolved_height(CellShape(topology_.cell(i), problem_.mesh.points, false)));
    };
    Index const cell = problem_.mesh.find_cell(0, problem_.mesh.n_checked(), is_too_thin);
    if (cell == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "cell # is too thin: its height is ~, which its coordinates do not resolve",
                        cell_item(problem_.mesh.number(cell)), {}, height);
}

// Checks that every region of the mesh touches a known value.
Status Analysis::check_regions(Fault& fault) noexcept {
    Demands const& demands = problem_.demands;
    if (!demands.free && !demands.slip && !demands.periodic()) return Status::ok;
    Index const floating = graph_.first_floating(stencil(), kinds_, order_, layer_work_.reached);
    if (floating == none) return Status::ok;
    return fault.refuse(
        Status::bad_condition,
        "point # is in a region of the mesh in which no boundary is fixed or prescribed",
        point_item(floating));
}

Status Analysis::analyse_order(Fault& fault) noexcept {
    Progress const& progress = problem_.progress;
    HARMORPH_TRY(progress.report(Phase::ordering, 0, fault));
    if (problem_.method.traits().factors) {
        dissect(graph_, problem_.mesh.points, dissection_work_, problem_.executor, order_, tree_);
    } else {
        order_by_layers(topology_, kinds_, graph_, layer_work_, order_);
    }
    HARMORPH_TRY(progress.report(Phase::ordering, 1, fault));
    HARMORPH_TRY(progress.report(Phase::symbolic, 0, fault));
    if (problem_.method.traits().factors) {
        fronts_ = count_borders(graph_, order_, tree_, border_, problem_.executor, border_start_);
        subtrees_.choose(tree_, border_start_);
    } else {
        for (Index k = 0; k < graph_.n; ++k) border_.position[order_[k]] = k;
    }
    return progress.report(Phase::symbolic, 1, fault);
}

BasisSource Analysis::basis_source() const noexcept {
    return {topology_,       mesh_fingerprint_, conditions_fingerprint_,
            problem_.method, problem_.demands,  curves_,
            slip_along_,     conditions_,       boundary_,
            wall_,           wall_work_.slot,   &division_.pieces};
}

bool Analysis::is_wall_face(Index face) const noexcept {
    const Condition* const condition = condition_of(conditions_, boundary_, face);
    return condition != nullptr && condition->is_wall();
}

Index Analysis::count_wall_faces() const noexcept {
    Index n = 0;
    for (Index face = 0; face < boundary_.count; ++face) n += is_wall_face(face) ? 1 : 0;
    return n;
}

}  // namespace harmorph
