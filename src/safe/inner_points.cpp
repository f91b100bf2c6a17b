// These strategies of a safe morph place inner points: untangling at the target, and improvement
// there.
#include "safe/safe_work.hpp"

namespace harmorph {

// Corrects slipping points ahead of the present mesh, which is valid. If some of them have passed a
// neighbour on their line, as happens beside the end of a wall that leaves the line, all slipping
// points go only a part of their way, or stay. Returns whether any point slips.
bool SafeMorph::keep_order_of_slipping(Work const& work) noexcept {
    BoundaryFaces const faces = work.basis.faces();
    auto const slips = [&](Index point) {
        return mobility.held[mobility.representative[point]] == 0 &&
               work.plan.kind(point) == PointKind::slip;
    };
    bool any = false;
    for (Index k = 0; k < work.mesh().n_points && !any; ++k) any = slips(k);
    if (!any) return false;
    Real part = 1;
    auto const ahead = [&](Index point) {
        Vec2 const there = mesh.ahead()[point], here = mesh.now()[point];
        return slips(point) && part < 1
                   ? mobility.slipping.placed(point, here + part * (there - here))
                   : there;
    };
    auto const is_in_order = [&] {
        for (Index face = 0; face < faces.count(); ++face) {
            Index const begin = faces.begin_of(face), end = faces.end_of(face);
            if (!slips(begin) && !slips(end)) continue;
            Vec2 const side = mesh.now()[end] - mesh.now()[begin];
            if (!(dot(side, ahead(end) - ahead(begin)) > 0)) return false;
        }
        return true;
    };
    constexpr Real parts[] = {0.5, 0.25, 0};
    for (Index k = 0; k < 3 && !is_in_order(); ++k) part = parts[k];
    if (part == 1 || !is_in_order()) return true;
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        if (slips(k)) mesh.to_ahead().set(k, ahead(k));
    }
    return true;
}

// Untangles the mesh ahead with all boundary points held, and if that fails, with points that
// slip.
bool SafeMorph::untangle_ahead(Work& work) noexcept {
    mobility.find(work.plan, mesh.ahead());
    bool const any_slips = keep_order_of_slipping(work);
    untangling.executor = work.executor();
    auto const run = [&](Tangle const& tangle, SlippingPoints const& slipping) {
        Fault why;
        untangling.tangle = tangle;
        untangling.slipping = slipping;
        UntangleOptions options = work.options.untangle;
        options.max_work = static_cast<Real>(work.solutions_left());
        Status const status = untangling.run(options, mesh.to_ahead(), work.report.untangle, why);
        work.report.untangling += work.report.untangle.work;
        // A boundary may cross itself although no cell is inverted.
        return status == Status::ok && is_valid(work, mesh.ahead());
    };
    Points const start = work.mesh().points;
    if (run({work.mesh(), start, work.basis.reversed, mesh.representative, mesh.held}, {}))
        return true;
    return any_slips && run(mobility.tangle(work.plan, start), mobility.slipping);
}

// Makes the rest of the movement in one step, however many cells the step inverts; then untangling
// places the inner points, and improvement follows where cells are poor. Returns whether the mesh
// is then good. If the mesh is not good, and this is not the last strategy, the morph continues
// from the mesh before the step.
bool SafeMorph::leap(Work& work, Basis const& by, bool is_last) noexcept {
    if (!work.options.tries(Strategy::untangled)) return false;
    look_ahead(work, by, work.aim);
    if (!untangle_ahead(work)) return false;
    Fault why;
    Outcome there = work.attempt;
    there.strategy = Strategy::untangled;
    there.fraction = work.aim;
    ++there.steps;
    there.turned_offset = mesh.carried.largest(work.basis, mesh.path, work.aim);
    measure(work, mesh.ahead(), there);
    if (!work.is_good(there) && work.options.tries(Strategy::improved)) {
        there.strategy = Strategy::improved;
        if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.ahead(), why)))
            return false;
        work.report.may_improve =
            run_improvement(work, work.options.improve.max_solutions, mesh.ahead());
        if (!is_valid(work, mesh.ahead())) return false;
        measure(work, mesh.ahead(), there);
    }
    bool const is_good = work.is_good(there);
    if (is_last || is_good) take_step(work, by);
    if (work.is_better(there, work.best()))
        keep(work, there, mesh.ahead_x, mesh.ahead_y, mesh.aimed);
    return is_good;
}

// Improves a mesh with the movement of the best mesh, to the mesh ahead. Returns whether the limit
// of solutions ended the improvement.
bool SafeMorph::run_improvement(Work& work, Index max_solutions, Points from) noexcept {
    ImproveOptions options = work.options.improve;
    options.max_solutions = min(max_solutions, work.solutions_left());
    ImproveReport report;
    improvement.run(work.plan, options, work.mesh().points, from, mesh.to_ahead(), report);
    work.report.improvements += report.solutions;
    return !report.converged;
}

// Improves the mesh `from`, which has the same movement as the best mesh, and keeps the result if
// it is clearly better than the best mesh; if the options ask for improvement, if it is better at
// all. The derivative remains that of the path.
bool SafeMorph::improve(Work& work, Points from) noexcept {
    constexpr Real rounding = 1e-9;
    Fault why;
    if (!work.arrives(work.best()) || work.solutions_left() == 0) return false;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, from, why))) return false;
    work.report.may_improve = run_improvement(work, work.options.improve.max_solutions, from);
    Outcome outcome = work.best();
    measure(work, mesh.ahead(), outcome);
    // If improvement is asked for, any gain is kept.
    Real const needed = work.options.improves ? 1 : SafeOptions::clear_gain;
    bool const is_clear = outcome.min_quality >= (1 - rounding) * work.best().min_quality &&
                          outcome.min_quality * outcome.mean_quality >
                              needed * work.best().min_quality * work.best().mean_quality;
    bool const is_better = work.score(outcome) > work.score(work.best()) ||
                           (work.score(outcome) == work.score(work.best()) && is_clear);
    if (!is_better || !is_valid(work, mesh.ahead())) return false;
    outcome.strategy = Strategy::improved;
    replace_inner_points(work, outcome);
    return true;
}

// Improves the present mesh between two substeps, where its cells are poor: functions that are
// solved on a better mesh carry the mesh farther, and to better cells.
void SafeMorph::improve_on_the_way(Work& work) noexcept {
    constexpr Real poor = 0.5;  // in parts of the smallest quality of the start
    constexpr Index max_solutions = 4;
    if (work.derivative != nullptr || !work.options.tries(Strategy::improved)) return;
    Outcome here;
    Fault why;
    measure(work, mesh.now(), here);
    if (here.min_quality >= poor * work.report.start_quality || work.solutions_left() == 0) return;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.now(), why))) return;
    run_improvement(work, max_solutions, mesh.now());
    copy(mesh.x, Span<const Real>(mesh.ahead_x));
    copy(mesh.y, Span<const Real>(mesh.ahead_y));
}

// Restores heights near the walls and improves cells, as far as the options ask for this.
// Improvement from the mesh without restored heights may give better cells than improvement from
// the mesh with them.
void SafeMorph::improve_at_end(Work& work) noexcept {
    SafeOptions const& options = work.options;
    bool const improves = options.improves && options.tries(Strategy::improved);
    copy(mesh.x, Span<const Real>(best_x));
    copy(mesh.y, Span<const Real>(best_y));
    if (options.heights > 0) restore_heights(work);
    bool const is_improved = work.best().strategy == Strategy::improved && work.report.heights == 0;
    if (improves && !is_improved) improve(work, result());
    if (improves && work.report.heights > 0 && improve(work, mesh.now())) work.report.heights = 0;
    bool const is_limited = work.best().height_change > options.max_height_change;
    if (is_limited && options.heights == 0) restore_heights(work);
}

}  // namespace harmorph
