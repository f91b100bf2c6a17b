#include "parts/part_equations.hpp"

#include "operators/assembly.hpp"
#include "operators/residual.hpp"
#include "operators/right_hand_sides.hpp"

namespace harmorph {
namespace {

constexpr Index residual_columns = 1;

}  // namespace

void PartEquations::lay_out(Arena& arena, Part const& own_part, PartProblem const& asked,
                            Index n_edges, Index n_curves, Index n_conditions,
                            Index n_control) noexcept {
    part = own_part;
    problem = asked;
    Mesh const& own = own_part.own();
    Index const n_points = own.n_points, n_shared = 2 * n_edges,
                components = asked.method.components(asked.demands);
    Index const max_wall = min(n_points, n_shared), max_unknowns = components * n_points;
    Index const squared = components * components;
    Matrix::Sizes max_sizes;
    max_sizes.entries = own_part.pairs * squared;
    max_sizes.couplings = max_sizes.fixed = static_cast<Index>(own_part.border_pairs * squared);
    max_sizes.kind = matrix_kind(asked.method, asked.demands);

    shared.lay_out(arena, n_edges, asked, n_curves, n_conditions);
    arena.take(topology.representative, n_points);
    arena.take(no_loops.loop_start, 1);
    arena.take(kinds, n_points);
    arena.take(tangent, components == 2 ? n_points : 0);
    arena.take(wall.point, max_wall);
    arena.take(wall.curve, max_wall);
    arena.take(wall.u, max_wall);
    arena.take(wall.offset, max_wall);
    arena.take(wall.shared, n_shared);
    arena.take(slot, n_points);
    arena.take(local, n_shared);
    faces.lay_out(arena, static_cast<Size>(n_edges));
    arena.take(conductivity, conductivities_of(asked.method, own.n_cells));
    arena.take(unknown_number, max_unknowns);
    arena.take(is_own, max_unknowns);
    arena.take(dof_of, max_unknowns);
    matrix.lay_out(arena, n_points, max_unknowns, max_wall, max_sizes);
    auto const mark = arena.mark();
    graph.lay_out(arena, own, components);
    arena.take(order, max_unknowns);
    arena.release(mark);
    residual.lay_out(arena, max_unknowns, max_sizes.couplings, max_sizes.kind, residual_columns);
    Offset const values = numbers_of(asked.method.value_kind(asked.demands));
    arena.take(rows_in_work,
               RowsToBlocks::work_numbers(values * (n_control + 2 * asked.demands.bodies)));
}

Status PartEquations::run(Span<const OpenEdge> edges, Fault& fault) noexcept {
    residual.kernel = resolved(Kernel::automatic, problem.executor.kernel);
    HARMORPH_TRY(shared.run(edges, problem, fault));
    topology.mesh = part.own();
    topology.edges = part.topology.edges;
    topology.reversed = part.topology.reversed;
    no_loops.loop_start[0] = 0;
    join_points();
    find_wall();
    find_unknowns();
    coordinates = coordinates_fingerprint(part.own().points, part.own().n_points);
    mesh_fingerprint = fingerprint_of(part.cells);
    conditions_fingerprint = fingerprint_of(kinds, wall);
    assemble();
    return fault.status;
}

// Finds the kinds of the part's points, and which of them have a common unknown.
void PartEquations::join_points() noexcept {
    local = local.first(shared.n_points);
    fill(local, none);
    for (Index point = 0; point < part.own().n_points; ++point) {
        Index const on_boundary = shared.find(part.number(point));
        topology.representative[point] = point;
        if (on_boundary == none) {
            kinds[point] = part.in_cell[point] != 0 ? PointKind::inside : PointKind::unused;
            if (!tangent.empty()) tangent[point] = {1, 0};
            continue;
        }
        Index const same = shared.topology.representative[on_boundary];
        bool const is_first = local[same] == none;
        if (is_first) local[same] = point;
        topology.representative[point] = local[same];
        kinds[point] = is_first ? shared.kinds[same] : PointKind::unused;
        if (!tangent.empty()) tangent[point] = shared.tangent[same];
    }
}

// Takes the slots of the shared boundary whose points the part has, in the order of the boundary.
void PartEquations::find_wall() noexcept {
    fill(slot, none);
    wall.count = wall.n_shared = 0;
    for (Index k = 0; k < shared.wall.count; ++k) {
        Index const point = local[shared.topology.representative[shared.wall.point[k]]];
        if (point == none) continue;
        slot[point] = wall.count;
        wall.point[wall.count] = point;
        wall.curve[wall.count] = shared.wall.curve[k];
        wall.u[wall.count] = shared.wall.u[k];
        wall.offset[wall.count++] = shared.wall.offset[k];
    }
    for (SharedPoint point : shared.wall.shared.first(shared.wall.n_shared)) {
        Index const same = shared.topology.representative[shared.wall.point[point.slot]];
        if (local[same] == none) continue;
        point.slot = slot[local[same]];
        wall.shared[wall.n_shared++] = point;
    }
}

void PartEquations::find_unknowns() noexcept {
    graph.build(topology, kinds);
    Index const n = graph.n, components = graph.components;
    for (Index k = 0; k < n; ++k) order[k] = k;
    matrix.fit(
        n, wall.count,
        Matrix::count(graph, matrix_kind(problem.method, problem.demands), shared.periodicity));
    matrix.build(topology.representative, graph, order, order, slot, tangent, shared.periodicity);
    unknown_number = unknown_number.first(n);
    is_own = is_own.first(n);
    dof_of = dof_of.first(n);
    for (Index k = 0; k < n; ++k) {
        Index const dof = graph.line[k], point = dof / components,
                    on_boundary = shared.find(part.number(point));
        Offset const number = on_boundary == none
                                  ? part.number(point)
                                  : shared.number[shared.topology.representative[on_boundary]];
        dof_of[k] = dof;
        unknown_number[k] = components * number + dof % components;
        is_own[k] = 0;
    }
    for (Index point = 0; point < part.own().n_points; ++point) {
        if (part.in_cell[point] != 2) continue;
        for (Index c = 0; c < components; ++c) {
            Index const row = matrix.row_of(components * point + c);
            if (row >= 0) is_own[row] = 1;
        }
    }
}

// The result of the assembly is not checked, as Part has checked the cells.
void PartEquations::assemble() noexcept {
    faces.kernel = residual.kernel;
    faces.translations = shared.periodicity.translations;
    faces.choose(shared.boundary, [&](Index face) { return shared.is_wall_face(face); });
    assemble_operator(problem.method, topology, part.own().points, faces, shared.points(),
                      conductivity, matrix, problem.executor);
}

BasisSource PartEquations::basis_source() const noexcept {
    return {topology,
            mesh_fingerprint,
            conditions_fingerprint,
            problem.method,
            problem.demands,
            shared.curves,
            {},
            shared.conditions,
            no_loops,
            wall,
            slot,
            &part.division.pieces};
}

bool PartEquations::matches(Basis const& rows) const noexcept {
    BasisHeader const& header = *rows.header;
    BasisCounts const counts = basis_source().counts();
    return std::memcmp(&header.counts, &counts, sizeof counts) == 0 &&
           header.topology == mesh_fingerprint && header.coordinates == coordinates &&
           header.conditions == conditions_fingerprint && header.method.agrees_with(problem.method);
}

void PartEquations::get(DofValues const& values, Index column, Real* numbers) const noexcept {
    Index const planes = matrix.planes(), plane = values.columns(matrix);
    for (Index k = 0; k < matrix.n; ++k) {
        for (Index p = 0; p < planes; ++p) *numbers++ = values.at(k)[p * plane + column];
    }
}

void PartEquations::set(DofValues const& values, Index column, const Real* numbers) const noexcept {
    Index const planes = matrix.planes(), plane = values.columns(matrix);
    for (Index k = 0; k < matrix.n; ++k) {
        for (Index p = 0; p < planes; ++p) values.at(k)[p * plane + column] = *numbers++;
    }
}

void PartEquations::find_residual(DofValues const& values, Index column,
                                  Real* numbers) const noexcept {
    residual.compute(matrix, values, column, 1);
    const Real* row = residual.value.data();
    for (Index k = 0; k < matrix.n * matrix.planes(); ++k, row += residual.width) *numbers++ = *row;
}

void PartEquations::finish(DofValues const& values) const noexcept {
    DofDirections(matrix).rotate_slipping(values, part.own().n_points);
    for (Index point = 0; point < part.own().n_points; ++point)
        values.copy_row(topology.representative[point], point);
}

void PartEquations::finish(Basis const& basis, Real largest) const noexcept {
    finish(dofs(basis));
    RowsToBlocks{basis.value.data(), basis.n_points(), basis.row_length(), rows_in_work}.run(
        problem.executor);
    basis.header->coordinates = coordinates;
    basis.header->filled = basis.n_functions();
    basis.seal(largest);
}

}  // namespace harmorph
