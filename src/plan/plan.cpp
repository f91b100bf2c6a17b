#include "plan/plan.hpp"

namespace harmorph {
namespace {

constexpr Index least_points = 4096;  // that are worth a task

}  // namespace

void Plan::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Method const& method = analysis.problem.method;
    BasisCounts const counts = analysis.basis_counts();
    equations.lay_out(arena, analysis);
    arena.take(wall_point, analysis.wall.count);
    given.lay_out(arena, analysis);
    Index const numbers_per_dof =
        numbers_of(counts.kind) * counts.functions() / equations.matrix.components();
    Index const columns =
        larger(equations.matrix.is_complex() ? counts.functions() : numbers_per_dof,
               GivenWall::columns(analysis));
    engine.choose(method.engine);
    engine.lay_out(arena, analysis, columns);
    refinement.lay_out(arena, analysis, engine, equations, columns);
    Offset const numbers = Offset{numbers_of(counts.kind)} * counts.functions();
    Offset const with_modes = block_points * (numbers + most_mode_numbers);
    arena.take(rows_in_work, larger(RowsToBlocks::work_numbers(numbers),
                                    analysis.problem.demands.given ? with_modes : Offset{0}));
}

void Plan::init(Analysis const& analysis) noexcept {
    executor = analysis.problem.executor;
    progress = analysis.problem.progress;
    basis_counts = analysis.basis_counts();
    topology = analysis.mesh_fingerprint;
    conditions = analysis.conditions_fingerprint;
    factor_entries = analysis.fronts.factor_entries;
    factored = false;
    copy(wall_point, Span<const Index>(analysis.wall.point.first(wall_point.count())));
    given.init(analysis);
    equations.init(analysis);
    mesh = equations.cells.mesh;
    refinement.residual.kernel = executor.kernel = equations.method.kernel;
    refinement.residual.share_out(analysis.tree, executor);
    executor.for_each(3, [&](Index part) {  // the three parts are independent
        if (part == 0) equations.build(analysis);
        if (part == 1) engine.init(analysis);
        if (part == 2) region_counts = RegionCounts::of(analysis.topology);
    });
    engine.take_pattern(analysis, equations.matrix);
}

Status Plan::factor(Points points, Fault& fault) noexcept {
    factored = false;
    HARMORPH_TRY(check_range(points, mesh.n_points, fault, executor));
    HARMORPH_TRY(progress.report(Phase::assembly, 0, fault));
    HARMORPH_TRY(equations.assemble(points, executor, fault));
    HARMORPH_TRY(progress.report(Phase::assembly, 1, fault));
    HARMORPH_TRY(progress.report(Phase::factor, 0, fault));
    Status const status = engine.set_up(equations, points, progress, fault);
    if (status == Status::not_positive && fault.item.kind == ItemKind::point)
        fault.item = point_item(equations.point_of(static_cast<Index>(fault.item.number)));
    HARMORPH_TRY(status);
    HARMORPH_TRY(
        engine.examine(equations, refinement.residual.value.first(equations.matrix.n), fault));
    coordinates = coordinates_fingerprint(points, mesh.n_points);
    HARMORPH_TRY(progress.report(Phase::factor, 1, fault));
    factored = true;
    return Status::ok;
}

Status Plan::solve(Basis const& basis, SolveReport& report, Fault& fault,
                   Sealing sealing) noexcept {
    if (!factored)
        return fault.refuse(Status::bad_argument,
                            "the plan has no factor: hm_plan_factor comes first");
    HARMORPH_TRY(check_fit(basis, fault));
    if (block_points * Offset{basis.row_length()} > static_cast<Offset>(rows_in_work.size())) {
        return fault.refuse(Status::unsupported,
                            "a point has # numbers, this plan solves bases with @ at most",
                            plain(basis.row_length()),
                            plain(static_cast<Index>(rows_in_work.size() / block_points)));
    }
    basis.unseal();
    HARMORPH_TRY(progress.report(Phase::solve, 0, fault));
    DofValues const dofs = equations.dofs(basis);
    RowsToBlocks const rows{basis.value.data(), basis.n_points(), basis.row_length(), rows_in_work};
    if (basis.header->counts.derived()) {
        rows.undo(executor);
        clear_all_but_wall(dofs);
        subtract_couplings(equations.matrix, dofs);
    } else {
        set_right_hand_sides(equations.matrix, basis, dofs, executor);
    }
    Status const status = solve_rows(dofs, report, fault);
    rows.run(executor);  // also where the solution failed: values on the wall of derived functions
                         // must not be lost
    HARMORPH_TRY(status);
    HARMORPH_TRY(progress.report(Phase::residual, 1, fault));
    basis.header->coordinates = coordinates;
    basis.header->solved = 1;
    if (sealing == Sealing::complete) basis.seal(0, executor);
    return judge(report, equations.method, fault);
}

Status Plan::solve_rows(DofValues const& dofs, SolveReport& report, Fault& fault) noexcept {
    HARMORPH_TRY(engine.solve(equations, dofs, progress, report.iteration, fault));
    HARMORPH_TRY(progress.report(Phase::solve, 1, fault));

    HARMORPH_TRY(progress.report(Phase::residual, 0, fault));
    report.unknowns = equations.matrix.n;
    report.functions = dofs.n_functions;
    report.factor_entries = factor_entries;
    HARMORPH_TRY(refinement.run(equations, engine, dofs, progress, report, fault));
    turn_slipping_points(dofs);
    executor.for_ranges(mesh.n_points, least_points, [&](Index begin, Index end) {
        for (Index point = begin; point < end; ++point) dofs.copy_row(same_point(point), point);
    });
    turn_sides(dofs);
    return Status::ok;
}

void Plan::clear_all_but_wall(DofValues const& dofs) const noexcept {
    Matrix const& matrix = equations.matrix;
    Index const components = matrix.components();
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const row = matrix.row_of[components * point];
        if (Matrix::is_wall(row) && wall_point[Matrix::wall(row) / components] == point) continue;
        for (Index dof = components * point; dof < components * (point + 1); ++dof) {
            std::memset(dofs.of_dof(dof), 0, sizeof(Real) * static_cast<Size>(dofs.length()));
        }
    }
}

Status Plan::level_cells(Index level, Span<Index> cell_of, Index& n_cells,
                         Fault& fault) const noexcept {
    const Agglomeration* const levels = engine.levels();
    if (!factored || levels == nullptr) {
        return fault.refuse(
            Status::bad_argument,
            "the plan has no levels: they are made by hm_plan_factor of other engines");
    }
    if (level < 0 || level >= levels->count) {
        return fault.refuse(Status::bad_argument, "there is no level #: the plan has @",
                            entry_item(level), plain(levels->count));
    }
    Matrix const& matrix = equations.matrix;
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const row = matrix.row_of[matrix.components() * point];
        Index cell = row >= 0 ? row : none;
        for (Index l = 0; l < level && cell != none; ++l) cell = levels->cell_of[l][cell];
        cell_of[point] = cell;
    }
    n_cells = levels->level[level].n;
    return Status::ok;
}

Status Plan::check_fit(Basis const& basis, Fault& fault) const noexcept {
    HARMORPH_TRY(basis.require_double(fault));
    BasisCounts whole = basis.header->counts.share(0, basis_counts.stored);
    if (whole.derived()) {
        whole.combined = whole.combination = whole.modes = 0;
        if (whole.kind == ValueKind::complex)
            whole.kind = basis_counts.kind;  // by a complex matrix or complex modes
    }
    bool const same_counts = std::memcmp(&whole, &basis_counts, sizeof basis_counts) == 0;
    bool const same_mesh =
        basis.header->topology == topology && basis.header->conditions == conditions;
    if (same_counts && same_mesh && basis.header->method.agrees_with(equations.method))
        return Status::ok;
    return fault.refuse(Status::bad_basis, "plan and basis were made of different analyses");
}

// turn(tangent, numbers of the first dof, numbers of the second dof)
template <class Turn>
void Plan::for_each_slipping(DofValues const& values, Turn const& turn) const noexcept {
    Matrix const& matrix = equations.matrix;
    if (matrix.kind != MatrixKind::coupled_xy) return;
    for (Index point = 0; point < mesh.n_points; ++point) {
        bool const slips = matrix.row_of[2 * point] >= 0 && matrix.row_of[2 * point + 1] == none;
        if (!slips || values.of[matrix.row_of[2 * point]] != 2 * point) continue;
        Real* const x = values.of_dof(2 * point);
        Real* const y = values.of_dof(2 * point + 1);
        for (Index k = 0; k < values.length(); ++k) turn(matrix.frame[point], x[k], y[k]);
    }
}

void Plan::turn_slipping_points(DofValues const& values) const noexcept {
    for_each_slipping(values, [](Vec2 along, Real& x, Real& y) {
        y = along.y * x;
        x = along.x * x;
    });
}

void Plan::turn_slipping_points_back(DofValues const& values) const noexcept {
    for_each_slipping(values, [](Vec2 along, Real& x, Real& y) {
        x = along.x * x + along.y * y;
        y = 0;
    });
}

// turn(frame, number as a complex one)
template <class Turn>
void Plan::for_each_turned(DofValues const& values, Turn const& turn) const noexcept {
    Matrix const& matrix = equations.matrix;
    if (!matrix.turns_sides()) return;
    Index const n = values.columns(matrix);
    for (Index point = 0; point < mesh.n_points; ++point) {
        Vec2 const frame = matrix.frame[point];
        if (matrix.row_of[point] == none || (frame.x == 1 && frame.y == 0)) continue;
        Real* const re = values.of_dof(point);
        for (Index k = 0; k < n; ++k) {
            Vec2 const turned = turn(frame, Vec2{re[k], re[n + k]});
            re[k] = turned.x;
            re[n + k] = turned.y;
        }
    }
}

void Plan::turn_sides(DofValues const& values) const noexcept {
    for_each_turned(values, [](Vec2 frame, Vec2 number) { return product(frame, number); });
}

void Plan::turn_sides_back(DofValues const& values) const noexcept {
    for_each_turned(values,
                    [](Vec2 frame, Vec2 number) { return product(conjugate(frame), number); });
}

Vec2 Plan::turn_of(Index point, Index same) const noexcept {
    Matrix const& matrix = equations.matrix;
    if (!matrix.turns_sides()) return {1, 0};
    return product(conjugate(matrix.frame[same]), matrix.frame[point]);
}

Index Plan::same_point(Index point) const noexcept {
    Matrix const& matrix = equations.matrix;
    Index const components = matrix.components(), row = matrix.row_of[components * point];
    if (row >= 0) return equations.point_of(row);
    return row == none ? none : wall_point[Matrix::wall(row) / components];
}

Index Plan::given_index(Index point) const noexcept {
    Matrix const& matrix = equations.matrix;
    Index const row = matrix.row_of[matrix.components() * point];
    if (!Matrix::is_wall(row)) return none;
    Index const slot = Matrix::wall(row) / matrix.components();
    return slot >= given.first_slot ? slot - given.first_slot : none;
}

}  // namespace harmorph
