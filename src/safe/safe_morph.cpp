#include "harmorph/safe/safe_morph.hpp"

#include "harmorph/base/range.hpp"
#include "harmorph/base/parallel_reduce.hpp"
#include "harmorph/morph/morph.hpp"
#include "harmorph/morph/weighted_sum.hpp"
#include "harmorph/safe/target.hpp"
#include "safe_work.hpp"

namespace harmorph {
namespace {

// All that lies between header and values: curves, conditions, parameters.
Span<const unsigned char> problem_of(Basis const& basis) noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    auto const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    return {begin, static_cast<Size>(end - begin)};
}

// Do modes move the given points alike?
bool same_modes(Basis const& basis, Basis const& other) noexcept {
    Index const modes = basis.header->counts.modes, n = basis.n_functions();
    if (modes > 0 && other.kind() != basis.kind()) return false;
    for (Index slot = 0; slot < basis.wall_point.count() && modes > 0; ++slot) {
        if (!basis.is_given(slot)) continue;
        auto const own = basis.row(basis.wall_point[slot]), theirs = other.row(basis.wall_point[slot]);
        for (Index plane = 0; plane < numbers_of(basis.kind()); ++plane) {
            for (Index i = n - modes; i < n; ++i) {
                if (own[plane * n + i] != theirs[plane * n + i]) return false;
            }
        }
    }
    return true;
}

// Another one's step moves the wall as the B-spline does only if its curves and parameters are the same.
Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept {
    HARMORPH_TRY(other.require_double(fault));
    BasisCounts counts = other.header->counts;
    counts.kind = basis.header->counts.kind;
    Span<const unsigned char> const own = problem_of(basis), theirs = problem_of(other);
    bool const same = other.header->topology == basis.header->topology &&
                      std::memcmp(&counts, &basis.header->counts, sizeof counts) == 0 && theirs.size() == own.size() &&
                      std::memcmp(theirs.data(), own.data(), own.size()) == 0;
    if (same && other.header->solved == 1 && same_modes(basis, other)) return Status::ok;
    return fault.refuse(Status::bad_basis, "one of the other bases is not solved, or of another mesh or other curves");
}

// Of derived functions too: the same functions, in the same layout.
Status check_derivative(Plan const& plan, Basis const& basis, Basis const& derivative, Fault& fault) noexcept {
    HARMORPH_TRY(plan.check_fit(derivative, fault));
    BasisCounts const &own = basis.header->counts, &its = derivative.header->counts;
    if (std::memcmp(&own, &its, sizeof own) == 0) return Status::ok;
    return fault.refuse(Status::bad_basis, "the basis for the derivative has other functions than the basis");
}

struct Count {
    Index n = 0;
    void merge(Count const& later) noexcept { n += later.n; }
};

// Mean of the corners of one of the caller's cells: a polygon has them in its triangles, those at diagonals repeatedly.
Vec2 centre_of(Mesh const& mesh, Index number, Points points) noexcept {
    Index const begin = mesh.is_of_pieces() ? mesh.piece_start[number] : number;
    Index const end = mesh.is_of_pieces() ? mesh.piece_start[number + 1] : number + 1;
    Vec2 sum;
    Index n = 0;
    for (Index piece = begin; piece < end; ++piece) {
        Cell const cell = mesh.cell(piece);
        for (Index k = 0; k < cell.n; ++k, ++n) sum = sum + points[cell.point[k]];
    }
    return (1.0 / n) * sum;
}

// Quality of one cell as measure_quality() has it.
Real quality_of(OrientedMesh const& cells, Index cell, Points points, Points reference) noexcept {
    Quality one;
    one.add(cell, measure_cell(cells, cell, points), measure_cell(cells, cell, reference).area);
    return one.min_quality;
}

}  // namespace

void SafeMorph::lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept {
    Index const n = plan.mesh.n_points, n_functions = counts.functions();
    mesh.lay_out(arena, plan, counts);
    arena.take(best_x, n);
    arena.take(best_y, n);
    arena.take(reached, 2 * Offset{n_functions});
    arena.take(weight, n_functions);
    arena.take(block, Basis::bytes(counts));
    first_layer.lay_out(arena, plan.mesh, static_cast<Size>(plan.equations.wall.count));
    wall_heights.lay_out(arena, plan.mesh, static_cast<Size>(plan.equations.wall.count));
    arena.take(kinds, n);
    Size const shared = arena.mark();
    untangling.lay_out(arena, plan.region_counts);
    arena.release(shared);
    improvement.lay_out(arena, plan);
}

Status SafeMorph::run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
                      const Basis* derivative, SafeReport& report, Fault& fault) noexcept {
    Work work{plan, basis, options, derivative, report, fault, {}};
    HARMORPH_TRY(plan.check_fit(basis, fault));
    if (!basis.header->counts.complete() || (derivative != nullptr && !derivative->header->counts.complete())) {
        return fault.refuse(Status::bad_basis, "a share of the functions cannot move the mesh: all of them are needed");
    }
    if (derivative != nullptr) HARMORPH_TRY(check_derivative(plan, basis, *derivative, fault));
    for (Basis const& other : options.others) HARMORPH_TRY(check_other(basis, other, fault));
    mesh.init(plan, basis, move);
    copy(best_x, Span<const Real>(mesh.x));
    copy(best_y, Span<const Real>(mesh.y));
    fill(reached, 0.0);
    report.limit = look_ahead(work, basis, 1);
    Target const target{work.cells(), basis.boundary_point, basis.loop_start, mesh.ends, plan.mesh.points, mesh.ahead()};
    for (Index k = 0; k < mesh.ends.count(); ++k) {
        if (mesh.ends[k] == EndOf::on_line) mesh.to_ahead().set(k, plan.mesh.points[k]);
    }
    HARMORPH_TRY(check_target(target, report.crossing, fault));

    report.start_quality = measure_quality(work.cells(), mesh.now(), {}, work.executor()).min_quality;
    report.outcome.min_quality = report.start_quality;
    plan.equations.wall.build(plan.mesh.points);
    first_layer.find(plan.mesh, plan.mesh.points, mesh.representative, plan.equations.wall);
    Method const method = plan.equations.method;
    Status const status = climb(work);
    plan.equations.method = method;
    if (work.factored_again) plan.factored = false;  // of another mesh or operator
    HARMORPH_TRY(status);
    return finish(work);
}

// Until the mesh is good.
Status SafeMorph::climb(Work& work) noexcept {
    SafeOptions const& options = work.options;
    bool const may_turn_back = work.derivative == nullptr;
    if (options.tries(Strategy::linear)) single_step(work, work.basis, Strategy::linear, none);
    for (Index i = 0; i < options.others.count() && options.tries(Strategy::other); ++i) {
        if (work.is_good(work.best())) return Status::ok;
        Basis const& other = options.others[i];
        if (work.derivative == nullptr || other.kind() == work.basis.kind()) single_step(work, other, Strategy::other, i);
    }
    if (work.is_good(work.best())) return Status::ok;
    if (options.solves_others && options.tries(Strategy::other)) HARMORPH_TRY(other_operators(work));
    if (work.is_good(work.best())) return Status::ok;
    HARMORPH_TRY(substeps(work));
    if (work.best().fraction < 1 && may_turn_back && mesh.path.is_bent()) {
        mesh.path.straighten(work.basis);
        mesh.carried.init(work.basis, mesh.path, work.mesh().points);
        HARMORPH_TRY(substeps(work));
    }
    if (work.best().fraction < 1 && options.tries(Strategy::linear)) longest_linear_step(work);
    if (!work.is_good(work.best()) && options.tries(Strategy::improved)) improve(work);
    return Status::ok;
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
    AdmissibleStep const limit = look_ahead(work, by, 1);
    if (strategy == Strategy::linear) work.report.limit = limit;
    if (!(limit.step > 1) || !is_valid(work, mesh.ahead())) return;
    work.attempt.strategy = strategy;
    work.attempt.other = other;
    take_step(work, by);
    keep_if_better(work);
}

// No way is worse than this one: straight ahead with the functions of the start, as far as no cell inverts.
void SafeMorph::longest_linear_step(Work& work) noexcept {
    constexpr Index most_trials = 8;
    if (work.derivative != nullptr && mesh.path.is_bent()) return;
    begin(work);
    Real length = smaller(0.98 * look_ahead(work, work.basis, 1).step, 1.0);
    for (Index trial = 0; trial < most_trials && length > work.best().fraction; ++trial, length *= 0.8) {
        look_ahead(work, work.basis, length);
        if (!is_valid(work, mesh.ahead())) continue;
        take_step(work, work.basis);
        keep_if_better(work);
        return;
    }
}

// Of the coordinates as they will be stored, after all roundings: every corner is positive exactly and as quality measures
// it, and the boundary does not cross itself.
bool SafeMorph::is_valid(Work const& work, Points points) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) {
        if (!is_coordinate(points[k])) return false;
    }
    return count_inverted(work, points) == 0 &&
           !find_crossing(work.basis.boundary_point, work.basis.loop_start, points).found;
}

Index SafeMorph::count_inverted(Work const& work, Points points) const noexcept {
    OrientedMesh const cells = work.cells();
    return reduce_cells<Count>(cells.mesh.n_checked(), work.executor(), [&](Index cell, Count& count) {
        CellShape const shape = shape_of(cells, cell, points);
        count.n += is_inverted(shape) || is_inverted_exactly(shape) ? 1 : 0;
    }).n;
}

// To where it looked, which is valid.
void SafeMorph::take_step(Work& work, Basis const& by) noexcept {
    if (work.derivative != nullptr) {
        for (Index i = 0; i < weight.count(); ++i) {
            weight[i] = mesh.path.weight(i, mesh.aimed_time) - mesh.path.weight(i, mesh.time);
        }
        add_weighted(*work.derivative, by, weight, work.executor());
        turn_sliding(work);
    }
    mesh.advance();
    work.attempt.turned_offset = mesh.carried.largest(work.basis, mesh.path, mesh.time);
    work.attempt.fraction = mesh.time;
    ++work.attempt.steps;
}

// The derivative of the step that was looked at last, where points slide along curves: put back onto them.
void SafeMorph::turn_sliding(Work const& work) const noexcept {
    SlipCurves const& curves = work.plan.equations.slip_curves;
    Matrix const& matrix = work.plan.equations.matrix;
    if (curves.count == 0) return;
    Index const half = work.derivative->row_length() / 2;  // numbers of x, then of y
    curves.for_each([&](Index slot, Index point) {
        auto const row = work.derivative->row(point);
        SlipCurves::Place const& place = mesh.slid[slot];
        for (Index k = 0; k < half; ++k) {
            Real const along = place.stretch * (place.tangent.x * row[k] + place.tangent.y * row[half + k]);
            row[k] = place.tangent.x * along;
            row[half + k] = place.tangent.y * along;
        }
    });
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        if (!matrix.slips(k)) continue;
        Index const same = work.plan.equations.point_of(matrix.row_of[2 * k]);
        if (same != k) copy_row(work.derivative->row(k), work.derivative->row(same), 2 * half);
    }
}

void SafeMorph::measure(Work const& work, Points points, Outcome& outcome) const noexcept {
    outcome.min_quality = measure_quality(work.cells(), points, work.mesh().points, work.executor()).min_quality;
    if (!is_finite(work.options.most_height_change)) return;
    FirstLayerChange const change = compare(first_layer, work.mesh().points, points);
    if (change.points == 0) return;
    outcome.height_change = larger(larger(change.max_ratio, change.min_ratio > 0 ? 1 / change.min_ratio : infinity), 1.0);
}

void SafeMorph::keep_if_better(Work& work) noexcept {
    measure(work, mesh.now(), work.attempt);
    if (work.is_better(work.attempt, work.best())) keep(work, work.attempt, mesh.x, mesh.y, mesh.reached);
}

void SafeMorph::keep(Work& work, Outcome const& outcome, Span<const Real> x, Span<const Real> y,
                     Span<const Real> movement) noexcept {
    copy(best_x, x);
    copy(best_y, y);
    copy(reached, movement);
    work.best() = outcome;
    work.derivative_of_best = true;
}

// The rest of the way in one step, whatever it inverts; then the inner points find their places, and better ones where cells
// are poor. Returns whether the mesh is good then. If not, and it is not the last thing to try, the way goes on from where it
// was.
bool SafeMorph::leap(Work& work, Basis const& by, bool is_last) noexcept {
    if (!work.options.tries(Strategy::untangled)) return false;
    look_ahead(work, by, 1);
    untangling.tangle = {work.mesh(), work.mesh().points, work.basis.reversed, mesh.representative, mesh.held};
    untangling.executor = work.executor();
    Fault why;
    Status const status = untangling.run(work.options.untangle, mesh.to_ahead(), work.report.untangle, why);
    if (status != Status::ok || !is_valid(work, mesh.ahead())) return false;  // points that slide may have passed others
    Outcome there = work.attempt;
    there.strategy = Strategy::untangled;
    there.fraction = 1;
    ++there.steps;
    there.turned_offset = mesh.carried.largest(work.basis, mesh.path, 1);
    measure(work, mesh.ahead(), there);
    if (!work.is_good(there) && work.options.tries(Strategy::improved)) {
        ImproveReport improved;
        there.strategy = Strategy::improved;
        if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.ahead(), why))) return false;
        improvement.run(work.plan, work.options.improve, work.mesh().points, mesh.ahead(), mesh.to_ahead(), improved);
        if (!is_valid(work, mesh.ahead())) return false;
        measure(work, mesh.ahead(), there);
    }
    bool const is_good = work.is_good(there);
    if (is_last || is_good) take_step(work, by);
    if (work.is_better(there, work.best())) keep(work, there, mesh.ahead_x, mesh.ahead_y, mesh.aimed);
    return is_good;
}

// The best mesh's inner points, for the quality that is reported. The derivative remains that of the way.
void SafeMorph::improve(Work& work) noexcept {
    ImproveReport report;
    Fault why;
    if (work.best().fraction < 1 || work.best().strategy == Strategy::improved) return;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, result(), why))) return;
    improvement.run(work.plan, work.options.improve, work.mesh().points, result(), mesh.to_ahead(), report);
    Outcome outcome = work.best();
    measure(work, mesh.ahead(), outcome);
    if (!is_valid(work, mesh.ahead()) || !work.is_better(outcome, work.best())) return;
    outcome.strategy = Strategy::improved;
    copy(best_x, Span<const Real>(mesh.ahead_x));
    copy(best_y, Span<const Real>(mesh.ahead_y));
    work.best() = outcome;
}

// As much as no cell inverts for: all that is asked for, or a half, or a quarter, ...
void SafeMorph::restore_heights(Work& work) noexcept {
    constexpr Index most_halvings = 4;
    Points const before = work.mesh().points;
    for (Index k = 0; k < kinds.count(); ++k) kinds[k] = mesh.held[k] != 0 ? PointKind::fixed : PointKind::inside;
    work.plan.equations.wall.build(before);
    wall_heights.find(work.mesh(), before, kinds, mesh.representative, work.plan.equations.wall, work.executor());
    bool const is_asked_for = work.options.heights > 0;
    Real amount = is_asked_for ? work.options.heights : 1;
    for (Index halving = 0; halving <= most_halvings; ++halving, amount *= 0.5) {
        copy(mesh.ahead_x, Span<const Real>(best_x));
        copy(mesh.ahead_y, Span<const Real>(best_y));
        wall_heights.restore(work.plan.equations.wall, before, mesh.to_ahead(), mesh.representative, amount, work.executor());
        if (!is_valid(work, mesh.ahead())) continue;
        Outcome outcome = work.best();
        measure(work, mesh.ahead(), outcome);
        if (!is_asked_for && !work.is_better(outcome, work.best())) continue;
        copy(best_x, Span<const Real>(mesh.ahead_x));
        copy(best_y, Span<const Real>(mesh.ahead_y));
        work.best() = outcome;
        work.report.heights = amount;
        return;
    }
}

// By insertion into the short list.
void SafeMorph::measure_worst(Work& work) const noexcept {
    SafeReport& report = work.report;
    report.n_worst = 0;
    for (Index cell = 0; cell < work.mesh().n_given_cells(); ++cell) {
        Real const quality = quality_of(work.cells(), cell, result(), work.mesh().points);
        Index place = report.n_worst;
        while (place > 0 && quality < report.worst[place - 1].quality) --place;
        if (place == SafeReport::most_worst) continue;
        if (report.n_worst < SafeReport::most_worst) ++report.n_worst;
        for (Index k = report.n_worst - 1; k > place; --k) report.worst[k] = report.worst[k - 1];
        report.worst[place] = {cell, quality, quality_of(work.cells(), cell, work.mesh().points, work.mesh().points),
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
            turn_sliding(work);
        }
    }
    derivative.header->coordinates = work.basis.header->coordinates;
    derivative.seal();
}

Status SafeMorph::finish(Work& work) noexcept {
    SafeReport& report = work.report;
    Outcome const& best = report.outcome;
    if (work.derivative != nullptr) finish_derivative(work);
    if (work.options.heights > 0 || best.height_change > work.options.most_height_change) restore_heights(work);
    report.first_layer = compare(first_layer, work.mesh().points, result());
    measure_worst(work);
    WorstCell const& worst = report.worst[0];
    if (best.fraction < 1) {
        Index const cell = work.mesh().number(report.limit.cell);
        Vec2 const at = cell != none ? centre_of(work.mesh(), cell, result()) : Vec2{};
        return work.fault.refuse_at(at.x, at.y, Status::short_of_target,
                                    cell != none ? "the mesh could follow ~ of the movement; then cell # at $ stands in the way"
                                                 : "the mesh could follow ~ of the movement",
                                    Counts::mesh, cell, none, best.fraction);
    }
    if (work.is_good(best)) return work.fault.status;
    if (best.min_quality < work.goal()) {
        return work.fault.refuse_at(worst.centre.x, worst.centre.y, Status::poor,
                                    "the smallest quality is ~, less than was asked for: cell # at $", Counts::mesh, worst.cell,
                                    none, worst.quality);
    }
    bool const shrunk = report.first_layer.min_ratio * report.first_layer.max_ratio < 1;
    Index const point = shrunk ? report.first_layer.min_ratio_point : report.first_layer.max_ratio_point;
    Vec2 const at = result()[point];
    return work.fault.refuse_at(at.x, at.y, Status::poor,
                                "the height of the first layer at point # $ is ~ of what it was, beyond what was asked for",
                                Counts::mesh, point, none,
                                shrunk ? report.first_layer.min_ratio : report.first_layer.max_ratio);
}

void SafeMorph::write(MutablePoints to) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) to.set(k, result()[k]);
}

}  // namespace harmorph
