#include "harmorph/plan/plan.hpp"

namespace harmorph {
namespace {

// Residuals are stored as the engine solves for them.
Precision residual_precision(Method const& method, Matrix const& matrix) noexcept {
    bool const in_rows = !method.nodal_gradients() && matrix.kind != MatrixKind::two_lines;
    return in_rows ? method.precision : Precision::in_double;
}

// Columns that are refined at a time: what the dead stack has room for, but at least a few.
Index residual_width(Analysis const& analysis, Matrix const& matrix, Index columns) noexcept {
    Method const& method = analysis.problem.method;
    if (method.nodal_gradients()) return smaller(columns, BiconjugateGradients::widest);
    auto const bytes = [](Precision precision) {
        return static_cast<Offset>(precision == Precision::in_single ? sizeof(float) : sizeof(double));
    };
    Offset const planes = matrix.is_complex() ? 2 : 1, n = larger(matrix.n, 1);
    Offset const stack = analysis.is_direct() ? planes * analysis.subtrees.top_stack_entries * bytes(method.precision) : 0;
    Offset const lists = 2 * n * static_cast<Offset>(sizeof(Index));
    Precision const its_precision = residual_precision(method, matrix);
    Offset const room = larger(stack - lists, Offset{0}) / (n * planes * bytes(its_precision));
    Offset const least = its_precision == Precision::in_single ? 12 : 5;
    Offset const its = room >= 16 ? room / 8 * 8 : larger(room, least);  // whole blocks of the kernels
    return static_cast<Index>(smaller(its, Offset{smaller(larger(columns, 2), Residual::widest)}));
}

}  // namespace

void Plan::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Index const n = analysis.graph.n, n_cells = analysis.problem.mesh.n_cells;
    BasisCounts const counts = analysis.basis_counts();
    arena.take(line_of, n);
    arena.take(reversed, n_cells);
    bool const weighted = analysis.problem.method.quarters > 0;
    wall.lay_out(arena, static_cast<Size>(analysis.count_wall_faces()));
    Index const n_edges = analysis.problem.method.bounded() ? analysis.triangulation.edges.count() : 0;
    arena.take(delaunay_edges, n_edges);
    arena.take(conductivity, !weighted ? 0 : n_edges > 0 ? n_edges : n_cells);
    matrix.lay_out(arena, analysis.problem.mesh.n_points, n, analysis.wall.count, analysis.matrix);
    Index const line_length = numbers_of(counts.kind) * counts.functions() / matrix.components();
    Index const columns = matrix.is_complex() ? counts.functions() : line_length;
    bool const nodal_gradients = analysis.problem.method.nodal_gradients();
    if (nodal_gradients) nodal.lay_out(arena, analysis.problem.mesh, analysis.edges.count());
    lay_out_engine(arena, analysis, columns);
    residual.lay_out(arena, n, matrix.components() * analysis.wall.count, matrix.kind,
                     residual_width(analysis, matrix, columns), residual_precision(analysis.problem.method, matrix));
    if (!nodal_gradients) return;
    nodal.lay_out_work(arena, analysis.problem.mesh.n_points, residual.width);
    if (analysis.is_direct()) biconjugate.lay_out(arena, n, residual.width);
}

void Plan::lay_out_engine(Arena& arena, Analysis const& analysis, Index columns) noexcept {
    if (analysis.is_direct()) {
        engine.lay_out(arena, analysis.tree.count, analysis.fronts, analysis.subtrees, columns, matrix.is_complex(),
                       analysis.problem.method.precision);
        Size const shared = arena.mark();
        engine.lay_out_stack(arena);
        return arena.release(shared);
    }
    Offset const entries = analysis.matrix.entries;
    arena.take(faces, entries);
    auto const lay_out = [&](auto& its) {
        Index const n = analysis.graph.n;
        its.lay_out(arena, n, columns, analysis.problem.iteration, analysis.problem.executor);
        Size const shared = arena.mark();
        its.lay_out_work(arena, n, entries);
        arena.release(shared);
        its.lay_out_vectors(arena, n);
        arena.release(shared);
    };
    Method const& its = analysis.problem.method;
    if (its.nodal_gradients()) fas.take_scheme(analysis.problem.mesh.n_points, its.scheme == Scheme::nodal_gradient);
    if (its.engine == Engine::fas) return lay_out(fas);
    lay_out(multigrid);
}

void Plan::init(Analysis const& analysis) noexcept {
    mesh = analysis.problem.mesh;
    method = analysis.problem.method;
    progress = analysis.problem.progress;
    basis_counts = analysis.basis_counts();
    topology = analysis.topology;
    conditions = analysis.conditions_fingerprint();
    factor_entries = analysis.fronts.factor_entries;
    factored = false;
    engine.kernel = residual.kernel = wall.kernel = method.kernel == Kernel::automatic ? best_kernel() : method.kernel;
    for (Index k = 0; k < line_of.count(); ++k) line_of[k] = analysis.graph.line[analysis.order[k]];
    copy(reversed, Span<const std::uint8_t>(analysis.reversed));
    wall.translations = analysis.translations;
    wall.choose(analysis.boundary, [&](Index face) { return analysis.is_wall_face(face); });
    if (method.bounded()) {
        Index n = 0;
        analysis.triangulation.for_each_edge([&](DelaunayEdge const& edge) { delaunay_edges[n++] = edge; });
        analysed_coordinates = coordinates_fingerprint(mesh.points, mesh.n_points);
    }
    engine.executor = analysis.problem.executor;
    engine.executor.for_each(3, [&](Index part) {  // none needs another
        if (part == 0) build_matrix(analysis);
        if (part == 1 && analysis.is_direct()) init_engine(analysis);
        if (part == 2) region_counts = RegionCounts::of(mesh, analysis.edges);
    });
}

void Plan::build_matrix(Analysis const& analysis) noexcept {
    matrix.build(analysis.representative, analysis.graph, analysis.order, analysis.border.position, analysis.wall_work.slot,
                 analysis.tangent);
    if (!analysis.is_direct()) matrix.mark_faces(analysis.edges, faces);
    if (!method.nodal_gradients()) return;
    nodal.init(mesh, analysis.edges, matrix, analysis.representative, reversed, method.scheme == Scheme::nodal_gradient);
}

void Plan::init_engine(Analysis const& analysis) noexcept {
    engine.tree.count = analysis.tree.count;
    copy(engine.subtrees.all, Span<const Subtree>(analysis.subtrees.all.first(analysis.subtrees.count)));
    copy(engine.tree.nodes, Span<const AssemblyTree::Node>(analysis.tree.nodes.first(analysis.tree.count)));
    copy(engine.border_start, Span<const Offset>(analysis.border_start.first(analysis.tree.count + 1)));
    fill_borders(analysis.graph, analysis.order, analysis.tree, analysis.border, engine.executor, engine.border_start,
                 engine.border);
    engine.place_panels();
}

Status Plan::factor(Points points, Fault& fault) noexcept {
    factored = false;
    HARMORPH_TRY(progress.report(Phase::assembly, 0, fault));
    HARMORPH_TRY(assemble(points, fault));
    HARMORPH_TRY(progress.report(Phase::assembly, 1, fault));
    HARMORPH_TRY(progress.report(Phase::factor, 0, fault));
    Status const status = factor_engine(points, fault);
    if (status == Status::not_positive && fault.item != none) fault.item = point_of(fault.item);
    HARMORPH_TRY(status);
    HARMORPH_TRY(test_factor(fault));
    if (method.nodal_gradients()) nodal.scheme.measure(points);
    coordinates = coordinates_fingerprint(points, mesh.n_points);
    HARMORPH_TRY(progress.report(Phase::factor, 1, fault));
    factored = true;
    return Status::ok;
}

Status Plan::factor_engine(Points points, Fault& fault) noexcept {
    if (method.engine == Engine::direct) return engine.factorise(matrix, progress, fault);
    if (method.engine == Engine::fas) {
        fas.volumes.measure(mesh, points, reversed, matrix.place);
        return fas.set_up(matrix.rows(faces), fault);
    }
    return multigrid.set_up(matrix.rows(faces), fault);
}

Status Plan::solve_engine(Rows const& values, IterationReport& report, Fault& fault) noexcept {
    if (method.engine == Engine::direct) return engine.solve(values, progress, fault);
    if (method.engine == Engine::fas) {
        return fas.solve(values, method.nodal_gradients() ? &nodal.scheme : nullptr, progress, report, fault);
    }
    return multigrid.solve(values, progress, report, fault);
}

Status Plan::solve(Basis const& basis, SolveReport& report, Fault& fault) noexcept {
    if (!factored) return fault.refuse(Status::bad_argument, "the plan has no factor: hm_plan_factor comes first");
    HARMORPH_TRY(check_fit(basis, fault));
    basis.unseal();
    HARMORPH_TRY(progress.report(Phase::solve, 0, fault));
    Lines const all = lines(basis);
    set_right_hand_sides(matrix, all);
    Index const columns = all.columns(matrix);
    // The direct engine starts nodal gradients from the compact scheme's functions.
    if (method.nodal_gradients() && method.engine == Engine::fas) nodal.set_right_hand_sides(all, columns, residual.width);
    HARMORPH_TRY(solve_engine({basis.value.data(), line_of.data(), all.length(), columns, columns}, report.iteration, fault));
    HARMORPH_TRY(progress.report(Phase::solve, 1, fault));

    HARMORPH_TRY(progress.report(Phase::residual, 0, fault));
    report.unknowns = matrix.n;
    report.functions = basis.n_functions();
    report.factor_entries = factor_entries;
    HARMORPH_TRY(refine(basis, report, fault));
    if (matrix.kind == MatrixKind::two_lines) turn_slipping_lines(basis);
    copy_joined_points(basis);
    HARMORPH_TRY(progress.report(Phase::residual, 1, fault));
    basis.header->coordinates = coordinates;
    basis.seal();
    return judge(report, fault);
}

Status Plan::level_cells(Index level, Span<Index> cell_of, Index& n_cells, Fault& fault) const noexcept {
    if (!factored || method.engine == Engine::direct) {
        return fault.refuse(Status::bad_argument, "the plan has no levels: they are made by hm_plan_factor of other engines");
    }
    Agglomeration const& levels = method.engine == Engine::fas ? fas.levels : multigrid.levels;
    if (level < 0 || level >= levels.count) {
        return fault.refuse(Status::bad_argument, "there is no level # (from 0): the plan has @", Counts::from_zero, level,
                            levels.count);
    }
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index cell = matrix.place[point] >= 0 ? matrix.place[point] : none;
        for (Index l = 0; l < level && cell != none; ++l) cell = levels.cell_of[l][cell];
        cell_of[point] = cell;
    }
    n_cells = levels.level[level].n;
    return Status::ok;
}

Status Plan::check_fit(Basis const& basis, Fault& fault) const noexcept {
    HARMORPH_TRY(basis.require_double(fault));
    BasisCounts const whole = basis.header->counts.share(0, basis_counts.held);
    bool const same_counts = std::memcmp(&whole, &basis_counts, sizeof basis_counts) == 0;
    bool const same_mesh = basis.header->topology == topology && basis.header->conditions == conditions;
    if (same_counts && same_mesh && basis.header->method.agrees_with(method)) return Status::ok;
    return fault.refuse(Status::bad_basis, "plan and basis were made of different analyses");
}

// A slipping point has moved along its tangent: from its one line to those of x and y.
void Plan::turn_slipping_lines(Basis const& basis) const noexcept {
    Lines const all = lines(basis);
    for (Index point = 0; point < mesh.n_points; ++point) {
        bool const slips = matrix.place[2 * point] >= 0 && matrix.place[2 * point + 1] == none;
        if (!slips || all.of[matrix.place[2 * point]] != 2 * point) continue;
        Vec2 const along = matrix.frame[point];
        Real* const x = all.line(2 * point);
        Real* const y = all.line(2 * point + 1);
        for (Index k = 0; k < all.length(); ++k) {
            y[k] = along.y * x[k];
            x[k] = along.x * x[k];
        }
    }
}

void Plan::copy_joined_points(Basis const& basis) const noexcept {
    Size const length = static_cast<Size>(basis.row_length());
    Index const components = matrix.components();
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const place = matrix.place[components * point];
        if (place == none) continue;
        Index const its = Matrix::is_wall(place) ? basis.wall_point[Matrix::wall(place) / components] : point_of(place);
        if (its != point) copy(Span<Real>(basis.row(point), length), Span<const Real>(basis.row(its), length));
    }
}

void init_basis(Basis const& basis, BasisCounts const& counts, Analysis const& analysis) noexcept {
    BasisHeader& header = *basis.header;
    std::memset(static_cast<void*>(&header), 0, Basis::bytes(counts));
    std::memcpy(header.magic, "harmorph", sizeof header.magic);
    header.format = BasisHeader::current_format;
    header.byte_order = BasisHeader::native_order;
    header.bytes = Basis::bytes(counts);
    header.topology = analysis.topology;
    header.conditions = analysis.conditions_fingerprint();
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
    if (counts.curves > 0) {
        Curve const& any = analysis.curves[0];
        copy(basis.control, Span<const Real>(any.control, basis.control.size()));
        if (!basis.weights.empty()) copy(basis.weights, Span<const Real>(any.weights, basis.weights.size()));
    }
    copy(basis.conditions, Span<const Condition>(analysis.conditions));
    copy(basis.wall_point, Span<const Index>(analysis.wall.point.first(counts.wall)));
    copy(basis.wall_curve, Span<const Index>(analysis.wall.curve.first(counts.wall)));
    copy(basis.wall_u, Span<const Real>(analysis.wall.u.first(counts.wall)));
    copy(basis.wall_lever, Span<const Vec2>(analysis.wall.lever.first(counts.wall)));
    Index joined = 0;
    analysis.for_each_joined([&](Index point, Index slot) {
        basis.joined_point[joined] = point;
        basis.joined_slot[joined++] = slot;
    });
    copy(basis.boundary_point, Span<const Index>(analysis.boundary.point.first(counts.boundary)));
    copy(basis.loop_start, Span<const Index>(analysis.boundary.loop_start.first(counts.loops + 1)));
    copy(basis.reversed, Span<const std::uint8_t>(analysis.reversed));
}

}  // namespace harmorph
