#include "plan/plan.hpp"

#include "operators/residual.hpp"

namespace harmorph {
namespace {

// Returns the first slot of given points; the slots of given points come last.
Index first_given(Analysis const& analysis) noexcept {
    Index const number = analysis.curves().count() + analysis.problem().demands.bodies;
    Index slot = 0;
    while (slot < analysis.wall().count && analysis.wall().curve[slot] != number) ++slot;
    return slot;
}

// Calls visit(point) for the points that are joined to another one.
template <class Visit>
void for_each_joined(Span<const Index> representative, Visit const& visit) noexcept {
    for (Index point = 0; point < representative.count(); ++point) {
        if (representative[point] != point) visit(point);
    }
}

}  // namespace

void GivenWall::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return;
    Index n_joined = 0;
    for_each_joined(analysis.topology().representative, [&](Index) { ++n_joined; });
    arena.take(point, analysis.wall().count - first_given(analysis));
    arena.take(joined, n_joined);
    arena.take(boundary_point, analysis.boundary().count);
    arena.take(loop_start, Offset{analysis.boundary().n_loops} + 1);
    arena.take(interface_side,
               analysis.problem().demands.interfaces ? analysis.boundary().count : 0);
}

Index GivenWall::columns(Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return 0;
    return analysis.matrix_sizes().kind == MatrixKind::real ? 2 * fields_at_once : fields_at_once;
}

void GivenWall::init(Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return;
    first_slot = first_given(analysis);
    copy(point, Span<const Index>(analysis.wall().point.from(first_slot, point.count())));
    Index n_joined = 0;
    for_each_joined(analysis.topology().representative, [&](Index at) { joined[n_joined++] = at; });
    copy(boundary_point,
         Span<const Index>(analysis.boundary().point.first(boundary_point.count())));
    copy(loop_start, Span<const Index>(analysis.boundary().loop_start.first(loop_start.count())));
    find_interface_sides(analysis.boundary(), analysis.conditions(), interface_side);
}

namespace {

// A task has at least this many points.
constexpr Index min_task_points = 4096;

}  // namespace

void Plan::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    Method const& method = analysis.problem().method;
    BasisCounts const counts = analysis.basis_counts();
    equations_.lay_out(arena, analysis);
    arena.take(wall_point_, analysis.wall().count);
    given_.lay_out(arena, analysis);
    Index const numbers_per_dof =
        numbers_of(counts.kind) * counts.functions() / equations_.matrix().components();
    fluxes_.lay_out(arena, analysis, numbers_per_dof);
    Index const columns =
        max(equations_.matrix().is_complex() ? counts.functions() : numbers_per_dof,
            GivenWall::columns(analysis));
    engine_.choose(method.engine);
    engine_.lay_out(arena, analysis, columns);
    refinement_.lay_out(arena, analysis, engine_, equations_, columns);
    Offset const numbers = Offset{numbers_of(counts.kind)} * counts.functions();
    Offset const with_modes = block_points * (numbers + max_mode_numbers);
    arena.take(rows_in_work_, max(RowsToBlocks::work_numbers(numbers),
                                  analysis.problem().demands.given ? with_modes : Offset{0}));
}

void Plan::init(Analysis const& analysis) noexcept {
    executor_ = analysis.problem().executor;
    progress_ = analysis.problem().progress;
    basis_counts_ = analysis.basis_counts();
    topology_ = analysis.mesh_fingerprint();
    conditions_ = analysis.conditions_fingerprint();
    factor_entries_ = analysis.fronts().factor_entries;
    factored_ = false;
    copy(wall_point_, Span<const Index>(analysis.wall().point.first(wall_point_.count())));
    given_.init(analysis);
    fluxes_.init(analysis);
    equations_.init(analysis);
    mesh_ = equations_.cells().mesh;
    refinement_.residual.kernel = executor_.kernel = equations_.method().kernel;
    refinement_.residual.choose_subtrees(analysis.tree(), executor_);
    // The three tasks are independent.
    executor_.for_each(3, [&](Index task) {
        if (task == 0) equations_.build(analysis);
        if (task == 1) engine_.init(analysis);
        if (task == 2) region_counts_ = RegionCounts::of(analysis.topology());
    });
    engine_.take_pattern(analysis, equations_.matrix());
}

Status Plan::factor(Points points, Fault& fault) noexcept {
    factored_ = false;
    HARMORPH_TRY(check_range(points, mesh_.n_points, fault, executor_));
    HARMORPH_TRY(progress_.report(Phase::assembly, 0, fault));
    HARMORPH_TRY(equations_.assemble(points, executor_, fault));
    fluxes_.measure(points);
    HARMORPH_TRY(progress_.report(Phase::assembly, 1, fault));
    HARMORPH_TRY(progress_.report(Phase::factor, 0, fault));
    Status const status = engine_.set_up(equations_, points, progress_, fault);
    if (status == Status::not_positive && fault.item.kind == ItemKind::point)
        fault.item = point_item(equations_.point_of(static_cast<Index>(fault.item.number)));
    HARMORPH_TRY(status);
    HARMORPH_TRY(engine_.examine(equations_,
                                 refinement_.residual.value.first(equations_.matrix().n), fault));
    coordinates_ = coordinates_fingerprint(points, mesh_.n_points);
    HARMORPH_TRY(progress_.report(Phase::factor, 1, fault));
    factored_ = true;
    return Status::ok;
}

Status Plan::solve(Basis const& basis, SolveReport& report, Fault& fault,
                   Sealing sealing) noexcept {
    if (!factored_)
        return fault.refuse(Status::bad_argument,
                            "the plan has no factor; call hm_plan_factor first");
    HARMORPH_TRY(check_fit(basis, fault));
    if (block_points * Offset{basis.row_length()} > static_cast<Offset>(rows_in_work_.size())) {
        return fault.refuse(
            Status::unsupported,
            "the basis has # numbers at a point, but this plan solves bases with at most @",
            plain(basis.row_length()),
            plain(static_cast<Index>(rows_in_work_.size() / block_points)));
    }
    bool const is_derived = basis.header->counts.derived();
    if (is_derived && fluxes_.any()) {
        return fault.refuse(Status::unsupported,
                            "functions with fluxes (hm_problem.fluxes) that are combined, or have "
                            "modes beside them, cannot be solved again; solve, then combine");
    }
    DofValues dofs = equations_.dofs(basis);
    dofs.is_start = equations_.method().traits().continues && basis.header->solved == 1;
    basis.unseal();
    HARMORPH_TRY(progress_.report(Phase::solve, 0, fault));
    RowsToBlocks const rows{basis.value.data(), basis.n_points(), basis.row_length(),
                            rows_in_work_};
    if (is_derived || dofs.is_start) rows.undo(executor_);
    if (dofs.is_start) {
        DofDirections(equations_.matrix()).rotate_slipping_back(dofs, mesh_.n_points);
        if (!is_derived) set_wall_values(equations_.matrix(), basis, dofs);
    } else if (is_derived) {
        clear_all_but_wall(dofs);
        subtract_couplings(equations_.matrix(), dofs);
    } else {
        set_right_hand_sides(equations_.matrix(), basis, dofs, executor_);
    }
    fluxes_.add_to(equations_.matrix(), dofs);
    Status const status = solve_rows(dofs, report, fault);
    // The rows become blocks even if the solution failed, as the values of derived functions on the
    // wall must be kept.
    rows.run(executor_);
    HARMORPH_TRY(status);
    HARMORPH_TRY(progress_.report(Phase::residual, 1, fault));
    basis.header->coordinates = coordinates_;
    basis.header->solved = 1;
    if (sealing == Sealing::complete) basis.seal(0, executor_);
    return check_accuracy(report, equations_.method(), fault);
}

Status Plan::solve_rows(DofValues const& dofs, SolveReport& report, Fault& fault) noexcept {
    HARMORPH_TRY(engine_.solve(equations_, dofs, progress_, report.iteration, fault));
    HARMORPH_TRY(progress_.report(Phase::solve, 1, fault));

    HARMORPH_TRY(progress_.report(Phase::residual, 0, fault));
    report.unknowns = equations_.matrix().n;
    report.functions = dofs.n_functions;
    report.factor_entries = factor_entries_;
    HARMORPH_TRY(refinement_.run(equations_, engine_, dofs, progress_, report, fault));
    DofDirections const dof_directions(equations_.matrix());
    dof_directions.rotate_slipping(dofs, mesh_.n_points);
    executor_.for_ranges(mesh_.n_points, min_task_points, [&](Index begin, Index end) {
        for (Index point = begin; point < end; ++point) dofs.copy_row(same_point(point), point);
    });
    dof_directions.rotate_sides(dofs, mesh_.n_points);
    return Status::ok;
}

void Plan::clear_all_but_wall(DofValues const& dofs) const noexcept {
    Index const components = equations_.matrix().components();
    for (Index point = 0; point < mesh_.n_points; ++point) {
        Index const slot = unknowns().wall_slot(point);
        if (slot != none && wall_point_[slot] == point) continue;
        for (Index dof = components * point; dof < components * (point + 1); ++dof) {
            std::memset(dofs.values_of_dof(dof), 0,
                        sizeof(Real) * static_cast<Size>(dofs.length()));
        }
    }
}

Status Plan::level_cells(Index level, Span<Index> cell_of, Index& n_cells,
                         Fault& fault) const noexcept {
    const Agglomeration* const levels = engine_.levels();
    if (!factored_ || levels == nullptr) {
        return fault.refuse(
            Status::bad_argument,
            "the plan has no merged cells; hm_plan_factor makes them for the engine fas");
    }
    if (level < 0 || level >= levels->count) {
        return fault.refuse(Status::bad_argument, "there is no level #; the plan has @ levels",
                            entry_item(level), plain(levels->count));
    }
    for (Index point = 0; point < mesh_.n_points; ++point) {
        Index cell = unknowns().is_unknown(point) ? unknowns().first_row(point) : none;
        for (Index l = 0; l < level && cell != none; ++l) cell = levels->cell_of[l][cell];
        cell_of[point] = cell;
    }
    n_cells = levels->level[level].n;
    return Status::ok;
}

Status Plan::check_fit(Basis const& basis, Fault& fault) const noexcept {
    HARMORPH_TRY(basis.require_double(fault));
    BasisCounts whole = basis.header->counts.share(0, basis_counts_.stored);
    if (whole.derived()) {
        whole.combined = whole.combination = whole.modes = 0;
        // A complex matrix or complex modes have made the kind complex.
        if (whole.kind == ValueKind::complex) whole.kind = basis_counts_.kind;
    }
    bool const same_counts = std::memcmp(&whole, &basis_counts_, sizeof basis_counts_) == 0;
    bool const same_mesh =
        basis.header->topology == topology_ && basis.header->conditions == conditions_;
    if (same_counts && same_mesh && basis.header->method.agrees_with(equations_.method()))
        return Status::ok;
    return fault.refuse(
        Status::bad_basis,
        "the plan and the basis were made from different analyses: of another mesh, "
        "or with other curves, conditions, fluxes or options");
}

Status Plan::solve_fields(DofValues const& values, bool measured, SolveReport& report,
                          Fault& fault) noexcept {
    report.unknowns = equations_.matrix().n;
    report.factor_entries = factor_entries_;
    HARMORPH_TRY(progress_.report(Phase::solve, 0, fault));
    HARMORPH_TRY(engine_.solve(equations_, values, progress_, report.iteration, fault));
    HARMORPH_TRY(progress_.report(Phase::solve, 1, fault));
    HARMORPH_TRY(progress_.report(Phase::residual, 0, fault));
    // A trusted factor needs no refinement. If right-hand sides are rough, residuals relative to
    // them are large although nothing can be improved.
    bool const refined = !engine_.trusted() || !equations_.method().traits().factors;
    if (refined) {
        HARMORPH_TRY(refinement_.run(equations_, engine_, values, progress_, report, fault));
        HARMORPH_TRY(check_accuracy(report, equations_.method(), fault));
    } else if (measured) {
        refinement_.measure(equations_, values, report);
    }
    return progress_.report(Phase::residual, 1, fault);
}

void Plan::to_displacements(DofValues const& values) const noexcept {
    DofDirections const dof_directions(equations_.matrix());
    dof_directions.rotate_slipping(values, mesh_.n_points);
    for (Index const point : given_.joined) values.copy_row(same_point(point), point);
    dof_directions.rotate_sides(values, mesh_.n_points);
}

void Plan::to_displacements_transposed(DofValues const& values) const noexcept {
    DofDirections const dof_directions(equations_.matrix());
    dof_directions.rotate_slipping_back(values, mesh_.n_points);
    dof_directions.rotate_sides_back(values, mesh_.n_points);
}

Index Plan::same_point(Index point) const noexcept {
    if (unknowns().is_unknown(point)) return representative(point);
    Index const slot = unknowns().wall_slot(point);
    return slot == none ? none : wall_point_[slot];
}

Index Plan::given_index(Index point) const noexcept {
    Index const slot = unknowns().wall_slot(point);
    return slot != none && slot >= given_.first_slot ? slot - given_.first_slot : none;
}

}  // namespace harmorph
