#include "harmorph/harmonic.hpp"

#include "harmorph/bounded.hpp"
#include "harmorph/laplace.hpp"

namespace harmorph {
namespace {

// Rounding leaves less on most meshes; on very uneven ones a step of refinement brings it back.
constexpr Real refined_above = 1e-13;
constexpr Index most_refinements = 2;

}  // namespace

void Plan::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Index const n = analysis.graph.n;
    arena.take(point_of, n);
    arena.take(reversed, analysis.problem.mesh.n_cells);
    arena.take(delaunay_edges, analysis.problem.method.bounded() ? analysis.triangulation.edges.count() : 0);
    matrix.lay_out(arena, analysis.problem.mesh.n_points, n, analysis.wall.count, analysis.matrix);
    engine.lay_out(arena, analysis.tree.count, analysis.fronts, analysis.subtrees, analysis.n_functions());
    Size const shared = arena.mark();
    engine.lay_out_stack(arena);
    arena.release(shared);
    residual.lay_out(arena, n);
}

void Plan::init(Analysis const& analysis) noexcept {
    mesh = analysis.problem.mesh;
    method = analysis.problem.method;
    progress = analysis.problem.progress;
    basis_counts = analysis.basis_counts();
    topology = analysis.topology;
    conditions = analysis.conditions_print();
    factor_entries = analysis.fronts.factor_entries;
    factored = false;
    for (Index k = 0; k < point_of.count(); ++k) point_of[k] = analysis.graph.point[analysis.order[k]];
    copy(reversed, Span<const std::uint8_t>(analysis.reversed));
    if (method.bounded()) {
        Index n = 0;
        analysis.triangulation.for_each_edge([&](DelaunayEdge const& edge) { delaunay_edges[n++] = edge; });
        analysed_coordinates = coordinates_print(mesh.points, mesh.n_points);
    }
    matrix.build(analysis.stencil_mesh(), analysis.stencil_edges(), analysis.representative, analysis.graph, analysis.order, analysis.border.position,
                 analysis.wall_work.slot);
    engine.kernel = method.kernel == Kernel::automatic ? best_kernel() : method.kernel;
    engine.executor = analysis.problem.executor;
    engine.tree.count = analysis.tree.count;
    copy(engine.subtrees.all, Span<const Subtree>(analysis.subtrees.all.first(analysis.subtrees.count)));
    copy(engine.tree.nodes, Span<const AssemblyTree::Node>(analysis.tree.nodes.first(analysis.tree.count)));
    copy(engine.border_start, Span<const Offset>(analysis.border_start.first(analysis.tree.count + 1)));
    fill_borders(analysis.graph, analysis.order, analysis.tree, analysis.border, engine.border_start, engine.border);
    engine.place_panels();
}

Status Plan::factor(Points points, Fault& fault) noexcept {
    factored = false;
    HARMORPH_TRY(progress.report(Phase::assembly, 0, fault));
    HARMORPH_TRY(assemble(points, fault));
    HARMORPH_TRY(progress.report(Phase::assembly, 1, fault));
    HARMORPH_TRY(progress.report(Phase::factor, 0, fault));
    Status const status = engine.factorise(matrix, progress, fault);
    if (status == Status::not_positive) fault.item = point_of[fault.item];
    HARMORPH_TRY(status);
    coordinates = coordinates_print(points, mesh.n_points);
    HARMORPH_TRY(progress.report(Phase::factor, 1, fault));
    factored = true;
    return Status::ok;
}

Status Plan::assemble(Points points, Fault& fault) const noexcept {
    if (!method.bounded()) {
        Index const inverted = assemble_laplace(mesh, points, reversed, matrix);
        if (inverted == none) return Status::ok;
        return fault.refuse(Status::bad_mesh, "cell # is inverted or empty at the given coordinates", Counts::mesh, inverted);
    }
    if (coordinates_print(points, mesh.n_points) != analysed_coordinates) {
        return fault.refuse(Status::unsupported, "bounded scheme: its triangles fit the analysed coordinates alone; analyse again");
    }
    Index const thin = assemble_bounded(delaunay_edges, points, {}, matrix);
    if (thin == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, "a triangle at the points # and @ is too thin for its area to be computed",
                        Counts::mesh, delaunay_edges[thin].begin, delaunay_edges[thin].end);
}

Status Plan::solve(Basis const& basis, SolveReport& report, Fault& fault) noexcept {
    if (!factored) return fault.refuse(Status::bad_argument, "the plan has no factor: hm_plan_factor comes first");
    bool const same_counts = std::memcmp(&basis.header->counts, &basis_counts, sizeof basis_counts) == 0;
    if (!same_counts || basis.header->topology != topology || basis.header->conditions != conditions) {
        return fault.refuse(Status::bad_basis, "plan and basis were made of different analyses");
    }
    basis.unseal();
    HARMORPH_TRY(progress.report(Phase::solve, 0, fault));
    set_right_hand_sides(basis);
    Index const width = basis.n_functions();
    HARMORPH_TRY(engine.solve({basis.value.data(), point_of.data(), width, width}, progress, fault));
    HARMORPH_TRY(progress.report(Phase::solve, 1, fault));

    HARMORPH_TRY(progress.report(Phase::residual, 0, fault));
    report.unknowns = matrix.n;
    report.functions = width;
    report.factor_entries = factor_entries;
    HARMORPH_TRY(measure_residual(basis, report, fault));
    while (report.residual > refined_above && report.refinements < most_refinements) {
        HARMORPH_TRY(refine(basis, fault));
        ++report.refinements;
        HARMORPH_TRY(measure_residual(basis, report, fault));
    }
    copy_joined_points(basis);
    HARMORPH_TRY(progress.report(Phase::residual, 1, fault));
    basis.header->coordinates = coordinates;
    basis.seal();
    if (report.residual <= method.tolerance) return Status::ok;
    return fault.refuse(Status::not_converged, "function # has the relative residual ~, above the tolerance",
                        Counts::from_zero, report.residual_function, none, report.residual);
}

// Known values to their rows, and what they pass on to their neighbours' rows.
void Plan::set_right_hand_sides(Basis const& basis) const noexcept {
    fill(basis.value, 0.0);
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        CurveBasis const functions = basis.boundary_functions(slot);
        Real* const own = basis.row(basis.wall_point[slot]);
        for (Index k = 0; k < functions.order; ++k) own[functions.control[k]] += functions.value[0][k];
        for (Index c = matrix.coupling_start[slot]; c < matrix.coupling_start[slot + 1]; ++c) {
            Real* const row = basis.row(point_of[matrix.coupling_row[c]]);
            for (Index k = 0; k < functions.order; ++k) {
                row[functions.control[k]] -= matrix.coupling_value[c] * functions.value[0][k];
            }
        }
    }
}

void Plan::copy_joined_points(Basis const& basis) const noexcept {
    Size const width = static_cast<Size>(basis.n_functions());
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const place = matrix.place[point];
        if (place == none) continue;
        Index const its = Matrix::is_wall(place) ? basis.wall_point[Matrix::wall(place)] : point_of[place];
        if (its != point) copy(Span<Real>(basis.row(point), width), Span<const Real>(basis.row(its), width));
    }
}

Status Plan::measure_residual(Basis const& basis, SolveReport& report, Fault& fault) const noexcept {
    Index const n_functions = basis.n_functions();
    report.residual = 0;
    report.residual_function = none;
    for (Index first = 0; first < n_functions; first += Residual::width) {
        Index const n = smaller(Residual::width, n_functions - first);
        Residual::Norms const norms = residual.compute(matrix, basis, point_of, first, n);
        for (Index k = 0; k < n; ++k) {
            Real const relative = norms.relative(k);
            bool const worse = relative > report.residual || relative != relative;  // once NaN, it stays
            if (!worse) continue;
            report.residual = relative;
            report.residual_function = first + k;
        }
        if (report.refinements > 0) continue;  // fractions never go back
        HARMORPH_TRY(progress.report(Phase::residual, static_cast<Real>(first) / n_functions, fault));
    }
    return Status::ok;
}

// One step of iterative refinement: what is left of the equations is solved for, and added.
Status Plan::refine(Basis const& basis, Fault& fault) noexcept {
    for (Index first = 0; first < basis.n_functions(); first += Residual::width) {
        Index const n = smaller(Residual::width, basis.n_functions() - first);
        residual.compute(matrix, basis, point_of, first, n);
        HARMORPH_TRY(engine.solve({residual.value.data(), nullptr, Residual::width, n}, Progress{}, fault));
        residual.add_to(basis, point_of, first, n);
    }
    return Status::ok;
}

void init_basis(Basis const& basis, BasisCounts const& counts, Analysis const& analysis) noexcept {
    BasisHeader& header = *basis.header;
    std::memset(static_cast<void*>(&header), 0, Basis::bytes(counts));
    std::memcpy(header.magic, "harmorph", sizeof header.magic);
    header.format = BasisHeader::current_format;
    header.byte_order = BasisHeader::native_order;
    header.bytes = Basis::bytes(counts);
    header.topology = analysis.topology;
    header.conditions = analysis.conditions_print();
    header.index_base = analysis.problem.mesh.index_base;
    header.counts = counts;
    header.method = analysis.problem.method;

    Index first_index = 0, first_knot = 0;
    for (Index number = 0; number < analysis.curves.count(); ++number) {
        Curve const& curve = analysis.curves[number];
        Index const n_knots = curve.n_indices + curve.degree + 1;
        basis.shape[number] = {curve.degree, curve.n_indices, first_index, first_knot};
        for (Index k = 0; k < curve.n_indices; ++k) basis.indices[first_index + k] = curve.control_point(k);
        for (Index k = 0; k < n_knots; ++k) basis.knots[first_knot + k] = curve.knots[k];
        first_index += curve.n_indices;
        first_knot += n_knots;
    }
    Curve const& any = analysis.curves[0];
    copy(basis.control, Span<const Real>(any.control, basis.control.size()));
    if (!basis.weights.empty()) copy(basis.weights, Span<const Real>(any.weights, basis.weights.size()));
    copy(basis.conditions, Span<const Condition>(analysis.conditions));
    copy(basis.wall_point, Span<const Index>(analysis.wall.point.first(counts.wall)));
    copy(basis.wall_curve, Span<const Index>(analysis.wall.curve.first(counts.wall)));
    copy(basis.wall_u, Span<const Real>(analysis.wall.u.first(counts.wall)));
    copy(basis.boundary_point, Span<const Index>(analysis.boundary.point.first(counts.boundary)));
    copy(basis.loop_start, Span<const Index>(analysis.boundary.loop_start.first(counts.loops + 1)));
    copy(basis.reversed, Span<const std::uint8_t>(analysis.reversed));
}

}  // namespace harmorph
