// The strategies of a safe morph that place inner points: untangling at the target, and improvement
// there.
#include "safe/safe_work.hpp"

namespace harmorph {

// The rest of the way in one step, whatever it inverts; then the inner points find their places,
// and better ones where cells are poor. Returns whether the mesh is good then. If not, and it is
// not the last thing to try, the way goes on from where it was.
bool SafeMorph::leap(Work& work, Basis const& by, bool is_last) noexcept {
    if (!work.options.tries(Strategy::untangled)) return false;
    look_ahead(work, by, 1);
    untangling.tangle = {work.mesh(), work.mesh().points, work.basis.reversed, mesh.representative,
                         mesh.held};
    untangling.executor = work.executor();
    Fault why;
    Status const status =
        untangling.run(work.options.untangle, mesh.to_ahead(), work.report.untangle, why);
    // Points that slide may have passed others
    if (status != Status::ok || !is_valid(work, mesh.ahead())) return false;
    Outcome there = work.attempt;
    there.strategy = Strategy::untangled;
    there.fraction = 1;
    ++there.steps;
    there.turned_offset = mesh.carried.largest(work.basis, mesh.path, 1);
    measure(work, mesh.ahead(), there);
    if (!work.is_good(there) && work.options.tries(Strategy::improved)) {
        ImproveReport improved;
        there.strategy = Strategy::improved;
        if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.ahead(), why)))
            return false;
        improvement.run(work.plan, work.improve_options(), work.mesh().points, mesh.ahead(),
                        mesh.to_ahead(), improved);
        if (!is_valid(work, mesh.ahead())) return false;
        measure(work, mesh.ahead(), there);
    }
    bool const is_good = work.is_good(there);
    if (is_last || is_good) take_step(work, by);
    if (work.is_better(there, work.best()))
        keep(work, there, mesh.ahead_x, mesh.ahead_y, mesh.aimed);
    return is_good;
}

// The best mesh's inner points, for the quality that is reported. The derivative remains that of
// the way.
void SafeMorph::improve(Work& work) noexcept {
    ImproveReport report;
    Fault why;
    if (work.best().fraction < 1 || work.best().strategy == Strategy::improved) return;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, result(), why))) return;
    improvement.run(work.plan, work.improve_options(), work.mesh().points, result(),
                    mesh.to_ahead(), report);
    Outcome outcome = work.best();
    measure(work, mesh.ahead(), outcome);
    if (!is_valid(work, mesh.ahead()) || !work.is_better(outcome, work.best())) return;
    outcome.strategy = Strategy::improved;
    replace_inner_points(work, outcome);
}

}  // namespace harmorph
