#include "safe/safe_morph.hpp"

#include "plan/plan.hpp"

#include "base/vec2.hpp"
#include "basis/basis_measures.hpp"
#include "morph/weighted_sum.hpp"
#include "safe/safe_work.hpp"
#include "safe/target.hpp"

namespace harmorph {

namespace {

// Checks that bases can be used together in one safe morph.

// Returns the bytes between the header and the values: curves, conditions and parameters.
Span<const unsigned char> problem_of(Basis const& basis) noexcept {
    const auto* const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    const auto* const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    return {begin, static_cast<Size>(end - begin)};
}

// Returns whether the modes of both bases move the given points alike.
bool same_modes(Basis const& basis, Basis const& other) noexcept {
    Index const modes = basis.header->counts.modes, n = basis.n_functions();
    if (modes > 0 && other.kind() != basis.kind()) return false;
    for (Index slot = 0; slot < basis.wall_point.count() && modes > 0; ++slot) {
        if (!basis.is_given(slot)) continue;
        auto const own = basis.row(basis.wall_point[slot]),
                   theirs = other.row(basis.wall_point[slot]);
        for (Index plane = 0; plane < numbers_of(basis.kind()); ++plane) {
            for (Index i = n - modes; i < n; ++i) {
                if (own[plane * n + i] != theirs[plane * n + i]) return false;
            }
        }
    }
    return true;
}

// Returns Status::bad_basis unless a step with the other basis moves the wall as a step with
// `basis` does: the other basis must be solved on the same mesh and have the same curves,
// parameters and modes.
Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept {
    HARMORPH_TRY(other.require_double(fault));
    BasisCounts counts = other.header->counts;
    counts.kind = basis.header->counts.kind;
    Span<const unsigned char> const own = problem_of(basis), theirs = problem_of(other);
    bool const same = other.header->topology == basis.header->topology &&
                      std::memcmp(&counts, &basis.header->counts, sizeof counts) == 0 &&
                      theirs.size() == own.size() &&
                      std::memcmp(theirs.data(), own.data(), own.size()) == 0;
    if (same && other.header->solved == 1 && same_modes(basis, other)) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "one of the other bases is not solved, or belongs to another mesh or to "
                        "other curves");
}

// Returns Status::bad_basis unless the derivative of the safe morph fits into the block of the
// basis: both must have the same functions, derived or not, in the same layout.
Status check_derivative(Plan const& plan, Basis const& basis, Basis const& derivative,
                        Fault& fault) noexcept {
    HARMORPH_TRY(plan.check_fit(derivative, fault));
    BasisCounts const &own = basis.header->counts, &derivative_counts = derivative.header->counts;
    if (std::memcmp(&own, &derivative_counts, sizeof own) == 0) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "the basis for the derivative has other functions than the basis");
}

}  // namespace

void SafeMorph::lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept {
    Index const n = plan.mesh().n_points, n_functions = counts.functions();
    mesh.lay_out(arena, plan, counts);
    arena.take(best_x, n);
    arena.take(best_y, n);
    arena.take(reached, 2 * Offset{n_functions});
    arena.take(weight, n_functions);
    arena.take(block, Basis::bytes(counts));
    first_layer.lay_out(arena, plan.mesh(), static_cast<Size>(plan.equations().walls().count));
    wall_heights.lay_out(arena, plan.mesh(), static_cast<Size>(plan.equations().walls().count));
    arena.take(kinds, n);
    mobility.lay_out(arena, plan);
    auto const shared = arena.mark();
    untangling.lay_out(arena, plan.region_counts());
    arena.release(shared);
    improvement.lay_out(arena, plan);
}

Status SafeMorph::run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
                      const Basis* derivative, SafeReport& report, Fault& fault) noexcept {
    Work work{plan, basis, options, derivative, report, fault, {}};
    HARMORPH_TRY(plan.check_fit(basis, fault));
    if (!basis.header->counts.complete() ||
        (derivative != nullptr && !derivative->header->counts.complete())) {
        return fault.refuse(
            Status::bad_basis,
            "a basis with a share of the functions cannot move the mesh: all functions are needed");
    }
    if (derivative != nullptr) HARMORPH_TRY(check_derivative(plan, basis, *derivative, fault));
    for (Basis const& other : options.others) HARMORPH_TRY(check_other(basis, other, fault));
    mesh.init(plan, basis, move);
    copy(best_x, Span<const Real>(mesh.x));
    copy(best_y, Span<const Real>(mesh.y));
    fill(reached, 0.0);
    report.limit = look_ahead(work, basis, 1);
    find_end_that_leaves(work);
    Target const target{work.cells(),       basis.faces(), mesh.ends,
                        plan.mesh().points, mesh.ahead(),  &plan.equations().walls()};
    for (Index k = 0; k < mesh.ends.count(); ++k) {
        if (mesh.ends[k] == KnownEnd::on_line) mesh.to_ahead().set(k, plan.mesh().points[k]);
    }
    HARMORPH_TRY(check_target(target, report.crossing, fault));
    HARMORPH_TRY(check_tear(basis, move, plan.mesh().points, Status::crossing, fault));

    Quality const start = measure_quality(work.cells(), mesh.now(), {}, work.executor());
    report.start_quality = start.min_quality;
    report.start_mean = start.mean_quality();
    report.outcome.min_quality = report.start_quality;
    first_layer.find(plan.mesh(), plan.mesh().points, mesh.representative,
                     plan.equations().walls_at(plan.mesh().points).chosen());
    Method const method = plan.equations().method();
    Status status = climb(work);
    if (!failed(status) && !work.arrives(work.best()) && options.searches)
        status = search_farthest(work);
    plan.equations().change_operator(method.operator_kind, method.exponent_quarters);
    if (work.factored_again)
        plan.forget_factor();  // the factor is that of another mesh or operator
    HARMORPH_TRY(status);
    return finish(work);
}

// Tries one strategy after another until the mesh is good.
Status SafeMorph::climb(Work& work) noexcept {
    SafeOptions const& options = work.options;
    if (work.searches && work.derivative == nullptr) return several_steps(work);
    if (options.tries(Strategy::linear)) single_step(work, work.basis, Strategy::linear, none);
    for (Index i = 0; i < options.others.count() && options.tries(Strategy::other); ++i) {
        if (work.is_fair(work.best())) break;
        Basis const& other = options.others[i];
        if (work.derivative == nullptr || other.kind() == work.basis.kind())
            single_step(work, other, Strategy::other, i);
    }
    if (!work.is_fair(work.best()) && options.solves_others && options.tries(Strategy::other))
        HARMORPH_TRY(other_operators(work));
    if (!work.is_good(work.best())) HARMORPH_TRY(several_steps(work));
    improve_result(work);
    return Status::ok;
}

void SafeMorph::improve_result(Work& work) noexcept {
    SafeOptions const& options = work.options;
    if (work.searches) return;
    bool const is_improved = work.best().strategy == Strategy::improved && !work.report.may_improve;
    if (!work.is_fine(work.best()) && options.tries(Strategy::improved) && !options.improves &&
        !is_improved)
        improve(work, result());
}

// Makes the movement in several steps, on straight ways where bodies that rotate do not arrive. The
// path remains the one on which the mesh came farthest.
Status SafeMorph::several_steps(Work& work) noexcept {
    bool const may_straighten = work.derivative == nullptr && !work.searches;
    HARMORPH_TRY(substeps(work));
    Real const before = work.best().fraction;
    bool const straightens = !work.arrives(work.best()) && may_straighten && mesh.path.is_bent();
    if (straightens) {
        mesh.path.straighten(work.basis);
        mesh.carried.init(work.basis, mesh.path);
        HARMORPH_TRY(substeps(work));
    }
    if (!work.arrives(work.best()) && work.options.tries(Strategy::linear))
        longest_linear_step(work);
    if (straightens && work.best().fraction == before) {
        mesh.path.bend(work.basis);
        mesh.carried.init(work.basis, mesh.path);
    }
    return Status::ok;
}

// Searches for the largest part of a movement that could not be completed: the steps go on from the
// best mesh as long as they come nearer to the target; then parts are tried by bisection.
Status SafeMorph::search_farthest(Work& work) noexcept {
    constexpr Real enough = 0.02;
    work.last_solution =
        min(work.report.solutions() + SafeOptions::max_in_search, SafeOptions::max_solutions);
    work.searches = true;
    Real refused = 1;
    bool bisects = false;
    while (refused - work.best().fraction > enough && work.solutions_left() > 0) {
        Real const before = work.best().fraction;
        work.aim = bisects ? 0.5 * (before + refused) : 1;
        work.resolves_before = work.report.resolves;
        HARMORPH_TRY(climb(work));
        if (bisects && !work.arrives(work.best())) refused = work.aim;
        bisects = bisects || work.best().fraction < before + enough;
    }
    work.searches = false;
    work.last_solution = SafeOptions::max_solutions;
    work.aim = work.best().fraction;
    improve_result(work);
    work.aim = 1;
    return Status::ok;
}

// Returns to the best mesh, which belongs to the present path.
void SafeMorph::resume(Work& work) noexcept {
    copy(mesh.x, Span<const Real>(best_x));
    copy(mesh.y, Span<const Real>(best_y));
    copy(mesh.reached, Span<const Real>(reached));
    mesh.time = work.best().fraction;
    mesh.carried.forget();
    work.attempt = work.best();
}

void SafeMorph::begin(Work& work) noexcept {
    mesh.begin(work.plan);
    work.attempt = {};
    work.derivative_of_best = false;
    if (work.derivative == nullptr) return;
    work.derivative->unseal();
    fill(work.derivative->value, 0.0);
}

AdmissibleStep SafeMorph::look_ahead(Work& work, Basis const& by, Real to) noexcept {
    return mesh.look_ahead(work.plan, work.basis, by, to);
}

void SafeMorph::single_step(Work& work, Basis const& by, Strategy strategy, Index other) noexcept {
    begin(work);
    AdmissibleStep const limit = look_ahead(work, by, work.aim);
    if (strategy == Strategy::linear) work.report.limit = limit;
    if (!(limit.step > 1) || !is_valid(work, mesh.ahead())) return;
    work.attempt.strategy = strategy;
    work.attempt.other = other;
    take_step(work, by);
    keep_if_better(work);
}

// Goes straight ahead with the functions of the start, as far as the mesh is valid and usable. No
// other strategy ends with a worse mesh than this one.
void SafeMorph::longest_linear_step(Work& work) noexcept {
    // Steps become shorter slowly at first, and end at a thousandth of the longest.
    constexpr Index max_trials = 16, slow_trials = 7;
    if (mesh.path.is_bent())
        return;  // the derivative of a path that rotates does not fit a straight step
    begin(work);
    Real length = min(0.98 * look_ahead(work, work.basis, work.aim).step, 1.0) * work.aim;
    for (Index trial = 0; trial < max_trials && length > work.best().fraction;
         ++trial, length *= trial <= slow_trials ? 0.8 : 0.5) {
        look_ahead(work, work.basis, length);
        if (!is_valid(work, mesh.ahead())) continue;
        Outcome there;
        measure(work, mesh.ahead(), there);
        there.fraction = length;
        work.note(there);
        if (!work.is_usable(there)) continue;
        take_step(work, work.basis);
        keep_if_better(work);
        return;
    }
}

// Checks the coordinates as they will be stored, after all roundings: every corner must be
// positive, both in exact arithmetic and in the measure of quality, and the boundary must not cross
// itself except where it did so at the start.
bool SafeMorph::is_valid(Work const& work, Points points) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) {
        if (!is_coordinate(points[k])) return false;
    }
    return count_inverted(work.cells(), points, work.executor()) == 0 &&
           !find_new_crossing(work.basis.faces(), work.mesh().points, points).found;
}

// Makes the trial step, the mesh of which is valid.
void SafeMorph::take_step(Work& work, Basis const& by) noexcept {
    if (work.derivative != nullptr) {
        for (Index i = 0; i < weight.count(); ++i) {
            weight[i] = mesh.path.weight(i, mesh.aimed_time) - mesh.path.weight(i, mesh.time);
        }
        add_weighted(*work.derivative, by, weight, work.executor());
        rotate_slipping(work);
    }
    mesh.advance();
    work.attempt.rotated_offset = mesh.carried.largest(work.basis, mesh.path, mesh.time);
    work.attempt.fraction = mesh.time;
    ++work.attempt.steps;
}

// Converts the derivative of the last trial step at points that slip along curves, which the step
// puts back onto their curves.
void SafeMorph::rotate_slipping(Work const& work) const noexcept {
    SlipCurves const& curves = work.plan.equations().slip_curves();
    if (curves.count == 0) return;
    Index const half = work.derivative->row_length() / 2;  // numbers of x, then of y
    curves.for_each([&](Index slot, Index point) {
        auto const row = work.derivative->row(point);
        SlipCurves::Place const& place = mesh.slip_place[slot];
        for (Index k = 0; k < half; ++k) {
            Real const along =
                place.stretch * (place.tangent.x * row[k] + place.tangent.y * row[half + k]);
            row[k] = place.tangent.x * along;
            row[half + k] = place.tangent.y * along;
        }
    });
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        Index const same = work.plan.representative(k);
        if (work.plan.unknowns().slips(k) && same != k)
            copy_row(work.derivative->row(k), work.derivative->row(same), 2 * half);
    }
}

void SafeMorph::measure(Work const& work, Points points, Outcome& outcome) const noexcept {
    Quality const quality =
        measure_quality(work.cells(), points, work.mesh().points, work.executor());
    outcome.min_quality = quality.min_quality;
    outcome.mean_quality = quality.mean_quality();
    if (!is_finite(work.options.max_height_change)) return;
    FirstLayerChange const change = compare(first_layer, work.mesh().points, points);
    if (change.points == 0) return;
    outcome.height_change =
        max(max(change.max_ratio, change.min_ratio > 0 ? 1 / change.min_ratio : infinity), 1.0);
}

void SafeMorph::keep_if_better(Work& work) noexcept {
    measure(work, mesh.now(), work.attempt);
    if (work.is_better(work.attempt, work.best()))
        keep(work, work.attempt, mesh.x, mesh.y, mesh.reached);
    work.note(work.attempt);
}

void SafeMorph::keep(Work& work, Outcome const& outcome, Span<const Real> x, Span<const Real> y,
                     Span<const Real> movement) noexcept {
    copy(best_x, x);
    copy(best_y, y);
    copy(reached, movement);
    work.best() = outcome;
    work.derivative_of_best = true;
}

void SafeMorph::replace_inner_points(Work& work, Outcome const& outcome) noexcept {
    copy(best_x, Span<const Real>(mesh.ahead_x));
    copy(best_y, Span<const Real>(mesh.ahead_y));
    work.best() = outcome;
}

void SafeMorph::write(MutablePoints to) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) to.set(k, result()[k]);
}

// The end of a safe morph: restored heights near walls, the worst cells, the derivative, and the
// report to the caller.

namespace {

// Restored heights may reduce the smallest quality to this part of it, as long as the quality asked
// for remains.
constexpr Real min_kept_quality = 0.5;

// Returns the mean of the corners of one of the caller's cells. A polygon has its corners in its
// triangles, and those at diagonals repeatedly.
Vec2 centre_of(Mesh const& mesh, Index number, Points points) noexcept {
    Vec2 sum;
    Index n = 0;
    for (Index const piece : mesh.pieces_of(number)) {
        Cell const cell = mesh.cell(piece);
        for (Index k = 0; k < cell.n; ++k, ++n) sum = sum + points[cell.point[k]];
    }
    return (1.0 / n) * sum;
}

// Returns the quality of one cell as measure_quality() defines it.
Real quality_of(OrientedMesh const& cells, Index cell, Points points, Points reference) noexcept {
    Quality one;
    one.add(cell, measure_cell(cells, cell, points), measure_cell(cells, cell, reference).area);
    return one.min_quality;
}

}  // namespace

// Restores heights that the options ask for. The part that leaves a valid mesh with the smallest
// quality that is permitted is found by bisection. If the change of heights is limited, all of the
// heights are restored, or a half, or a quarter and so on: the first part that makes the mesh
// better.
void SafeMorph::restore_heights(Work& work) noexcept {
    constexpr Index max_trials = 6, max_halvings = 4;
    Points const before = work.mesh().points;
    for (Index k = 0; k < kinds.count(); ++k)
        kinds[k] = mesh.held[k] != 0 ? PointKind::fixed : PointKind::inside;
    work.plan.equations().walls_at(before);
    wall_heights.find(work.mesh(), before, kinds, mesh.representative,
                      work.plan.equations().walls(), work.executor());
    bool const is_asked_for = work.options.heights > 0;
    Real const quality = work.best().min_quality;
    Real const permitted = min(quality, max(work.goal(), min_kept_quality * quality));
    // Restores a part of the heights in the mesh ahead.
    Outcome outcome;
    auto const accepts = [&](Real amount) {
        copy(mesh.ahead_x, Span<const Real>(best_x));
        copy(mesh.ahead_y, Span<const Real>(best_y));
        wall_heights.restore(work.plan.equations().walls(), before, mesh.to_ahead(),
                             mesh.representative, amount, work.executor());
        if (!is_valid(work, mesh.ahead())) return false;
        outcome = work.best();
        measure(work, mesh.ahead(), outcome);
        return is_asked_for ? outcome.min_quality >= permitted
                            : work.is_better(outcome, work.best());
    };
    Real const all = is_asked_for ? work.options.heights : 1;
    Real accepted = accepts(all) ? all : 0;
    Real amount = all;
    for (Index halving = 0; !is_asked_for && accepted == 0 && halving < max_halvings; ++halving) {
        amount *= 0.5;
        if (accepts(amount)) accepted = amount;
    }
    Real refused = all;
    for (Index trial = 0; is_asked_for && accepted < all && trial < max_trials; ++trial) {
        amount = 0.5 * (accepted + refused);
        (accepts(amount) ? accepted : refused) = amount;
    }
    if (accepted == 0) return;
    if (amount != accepted) accepts(accepted);
    replace_inner_points(work, outcome);
    work.report.heights = accepted;
}

// Inserts each cell into the short list of the worst cells.
void SafeMorph::measure_worst(Work& work) const noexcept {
    SafeReport& report = work.report;
    report.n_worst = 0;
    for (Index cell = 0; cell < work.mesh().n_given_cells(); ++cell) {
        Real const quality = quality_of(work.cells(), cell, result(), work.mesh().points);
        Index place = report.n_worst;
        while (place > 0 && quality < report.worst[place - 1].quality) --place;
        if (place == SafeReport::max_worst) continue;
        if (report.n_worst < SafeReport::max_worst) ++report.n_worst;
        for (Index k = report.n_worst - 1; k > place; --k) report.worst[k] = report.worst[k - 1];
        report.worst[place] = {
            cell, quality, quality_of(work.cells(), cell, work.mesh().points, work.mesh().points),
            centre_of(work.mesh(), cell, result())};
    }
}

void SafeMorph::finish_derivative(Work& work) noexcept {
    Basis const& derivative = *work.derivative;
    Outcome const& best = work.report.outcome;
    if (!work.derivative_of_best) {  // the best mesh is that of one step, or the start
        fill(derivative.value, 0.0);
        Basis const& by = best.other == none ? work.basis : work.options.others[best.other];
        for (Index i = 0; i < weight.count(); ++i) weight[i] = mesh.path.weight(i, best.fraction);
        if (best.steps > 0) {
            add_weighted(derivative, by, weight, work.executor());
            mesh.begin(work.plan);
            look_ahead(work, by, best.fraction);
            rotate_slipping(work);
        }
    }
    derivative.header->coordinates = work.basis.header->coordinates;
    derivative.seal();
}

// The mesh ahead is at the target. Beside the end of a wall, neighbours on the line or curve of the
// boundary stay or slip; the end leaves the line if the distance to them changes.
void SafeMorph::find_end_that_leaves(Work& work) const noexcept {
    constexpr Real min_share = 1e-6;  // in parts of the movement of the end
    Plan const& plan = work.plan;
    Points const start = work.mesh().points, target = mesh.ahead();
    auto const distance = [&](Vec2 p, Index end, Index beside) {
        SlipCurves const& curves = plan.equations().slip_curves();
        for (Index slot = 0; slot < curves.n_slots(); ++slot) {
            if (curves.own[slot] == slot && curves.point[slot] == beside)
                return length(p - curves.nearest(slot, p).at);
        }
        Vec2 const along = start[beside] - start[end];
        return abs(cross(along, p - start[end])) / length(along);
    };
    auto const look_at = [&](Index end, Index beside) {
        if (plan.equations().kind(end) != PointKind::on_wall) return;
        if (plan.equations().kind(beside) != PointKind::slip &&
            plan.equations().kind(beside) != PointKind::fixed)
            return;
        Real const leaves =
            abs(distance(target[end], end, beside) - distance(start[end], end, beside));
        if (!(leaves > min_share * length(target[end] - start[end]))) return;
        if (leaves <= work.report.end_distance) return;
        work.report.end = end;
        work.report.end_distance = leaves;
    };
    BoundaryFaces const faces = work.basis.faces();
    for (Index face = 0; face < faces.count(); ++face) {
        look_at(faces.begin_of(face), faces.end_of(face));
        look_at(faces.end_of(face), faces.begin_of(face));
    }
}

// Returns whether the cell has the point or one of the neighbours of the point on the boundary.
bool SafeMorph::is_beside(Work const& work, Index cell, Index point) const noexcept {
    if (cell == none || point == none) return false;
    Cell const corners = work.mesh().cell(cell);
    BoundaryFaces const faces = work.basis.faces();
    auto const has = [&](Index wanted) {
        for (Index k = 0; k < corners.n; ++k) {
            if (corners.point[k] == wanted) return true;
        }
        return false;
    };
    for (Index face = 0; face < faces.count(); ++face) {
        Index const begin = faces.begin_of(face), end = faces.end_of(face);
        if ((begin == point || end == point) && (has(begin) || has(end))) return true;
    }
    return has(point);
}

Status SafeMorph::finish(Work& work) noexcept {
    SafeReport& report = work.report;
    Outcome const& best = report.outcome;
    if (work.derivative != nullptr) finish_derivative(work);
    improve_at_end(work);
    report.first_layer = compare(first_layer, work.mesh().points, result());
    measure_worst(work);
    WorstCell const& worst = report.worst[0];
    if (best.fraction < 1) {
        if (is_beside(work, report.limit.cell, report.end)) {
            Vec2 const at = work.mesh().points[report.end];
            return work.fault.refuse_at(at.x, at.y, Status::short_of_target,
                                        "the wall's end, point # at $, moves ~ off the line of the "
                                        "boundary beside it, farther than the mesh can follow",
                                        point_item(report.end), {}, report.end_distance);
        }
        if (work.farthest_poor > best.fraction) {
            return work.fault.refuse_at(
                worst.centre.x, worst.centre.y, Status::short_of_target,
                "the mesh could follow ~ of the movement; the meshes found farther on have a "
                "smaller quality than was asked for; the worst cell here: cell # at $",
                cell_item(worst.cell), {}, best.fraction);
        }
        Index const cell = work.mesh().number(report.limit.cell);
        Vec2 const at = cell != none ? centre_of(work.mesh(), cell, result()) : Vec2{};
        const char* const text =
            cell != none
                ? "the mesh could follow ~ of the movement; beyond that, cell # at $ would invert"
                : "the mesh could follow ~ of the movement";
        return work.fault.refuse_at(at.x, at.y, Status::short_of_target, text,
                                    cell != none ? cell_item(cell) : Item{}, {}, best.fraction);
    }
    if (work.is_good(best)) return work.fault.status;
    if (best.min_quality < work.goal()) {
        return work.fault.refuse_at(
            worst.centre.x, worst.centre.y, Status::poor,
            "the smallest quality is ~, less than was asked for: cell # at $",
            cell_item(worst.cell), {}, worst.quality);
    }
    bool const shrunk = report.first_layer.min_ratio * report.first_layer.max_ratio < 1;
    Index const point =
        shrunk ? report.first_layer.min_ratio_point : report.first_layer.max_ratio_point;
    Vec2 const at = result()[point];
    return work.fault.refuse_at(
        at.x, at.y, Status::poor,
        "the height of the first layer at point # $ is ~ times the height at the start, beyond the "
        "limit that was asked for",
        point_item(point), {},
        shrunk ? report.first_layer.min_ratio : report.first_layer.max_ratio);
}

}  // namespace harmorph
