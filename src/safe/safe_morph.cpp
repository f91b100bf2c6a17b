#include "harmorph/safe/safe_morph.hpp"

#include <cstring>

#include "harmorph/base/parallel_reduce.hpp"
#include "harmorph/morph/morph.hpp"
#include "harmorph/morph/quality.hpp"
#include "harmorph/morph/weighted_sum.hpp"

namespace harmorph {
namespace {

constexpr Real share_of_admissible = 0.5;  // that a substep may take
constexpr Real least_step = 1e-4;          // of the whole way; shorter ones lead nowhere
constexpr Index most_trials = 12;          // of a substep's length; the way is not straight

// All that lies between header and values: curves, conditions, parameters.
Span<const unsigned char> problem_of(Basis const& basis) noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    auto const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    return {begin, static_cast<Size>(end - begin)};
}

// Another one's step moves the wall as the B-spline does only if its curves and parameters are the same.
Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept {
    HARMORPH_TRY(other.require_double(fault));
    HARMORPH_TRY(other.require_control_points(fault));
    BasisCounts counts = other.header->counts;
    counts.kind = basis.header->counts.kind;
    Span<const unsigned char> const own = problem_of(basis), theirs = problem_of(other);
    bool const same = other.header->topology == basis.header->topology &&
                      std::memcmp(&counts, &basis.header->counts, sizeof counts) == 0 && theirs.size() == own.size() &&
                      std::memcmp(theirs.data(), own.data(), own.size()) == 0;
    if (same && other.header->solved == 1) return Status::ok;
    return fault.refuse(Status::bad_basis, "one of the other bases is not solved, or of another mesh or other curves");
}

struct Count {
    Index n = 0;
    void merge(Count const& later) noexcept { n += later.n; }
};

}  // namespace

struct SafeMorph::Work {
    Plan& plan;
    Basis const& basis;
    SafeOptions const& options;
    const Basis* derivative;
    SafeReport& report;
    Fault& fault;

    Mesh const& mesh() const noexcept { return plan.mesh; }
    OrientedMesh const& cells() const noexcept { return plan.equations.cells; }
    Executor const& executor() const noexcept { return plan.executor; }
};

void SafeMorph::lay_out(Arena& arena, Plan const& plan) noexcept {
    Index const n = plan.mesh.n_points, n_functions = plan.basis_counts.functions();
    path.lay_out(arena, n_functions);
    arena.take(x, n);
    arena.take(y, n);
    arena.take(next_x, n);
    arena.take(next_y, n);
    arena.take(reached, 2 * Offset{n_functions});
    arena.take(aimed, 2 * Offset{n_functions});
    arena.take(difference, 2 * Offset{n_functions});
    arena.take(weight, n_functions);
    arena.take(block, Basis::bytes(plan.basis_counts));
    arena.take(representative, n);
    arena.take(held, n);
    untangling.lay_out(arena, plan.region_counts);
    first_layer.lay_out(arena, plan.mesh, static_cast<Size>(plan.equations.wall.count));
    wall_heights.lay_out(arena, plan.mesh, static_cast<Size>(plan.equations.wall.count));
    arena.take(kinds, n);
}

// The two ends of a cut move as one; all of the boundary is held.
void SafeMorph::mark_held(Work const& work) const noexcept {
    Matrix const& matrix = work.plan.equations.matrix;
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        Index const place = matrix.row_of[matrix.components() * k];
        held[k] = static_cast<std::uint8_t>(place < 0 ? 1 : 0);
        representative[k] = place < 0 ? k : work.plan.equations.point_of(place);
    }
    for (Index const point : work.basis.boundary_point) {
        held[point] = 1;
        representative[point] = point;
    }
}

Status SafeMorph::run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
                      const Basis* derivative, SafeReport& report, Fault& fault) noexcept {
    Work work{plan, basis, options, derivative, report, fault};
    HARMORPH_TRY(plan.check_fit(basis, fault));
    if (!basis.header->counts.complete() || (derivative != nullptr && !derivative->header->counts.complete())) {
        return fault.refuse(Status::bad_basis, "a share of the functions cannot move the mesh: all of them are needed");
    }
    if (derivative != nullptr) HARMORPH_TRY(plan.check_fit(*derivative, fault));
    for (Basis const& other : options.others) HARMORPH_TRY(check_other(basis, other, fault));
    path.init(basis, move);
    mark_held(work);
    for (Index k = 0; k < plan.mesh.n_points; ++k) {
        x[k] = plan.mesh.points[k].x;
        y[k] = plan.mesh.points[k].y;
    }
    fill(reached, 0.0);
    aim(1);
    bool const fits = is_admissible(work, basis) && is_valid(work);
    report.crossing = find_crossing(basis.boundary_point, basis.loop_start, next(), {}, Overlaps::ignored);
    if (report.crossing.found) {
        return fault.refuse(Status::crossing, "the moved boundary crosses itself: the faces that begin at points # and @",
                            Counts::mesh, report.crossing.first[0], report.crossing.second[0]);
    }
    if (derivative != nullptr) {
        derivative->unseal();
        fill(derivative->value, 0.0);
    }
    if (fits && options.tries(Strategy::linear)) {
        take_step(work, basis, 0, 1);
    } else {
        for (Index i = 0; i < options.others.count() && report.fraction < 1 && options.tries(Strategy::other); ++i) {
            Basis const& other = options.others[i];
            if (derivative != nullptr && other.kind() != basis.kind()) continue;
            if (!is_admissible(work, other) || !is_valid(work)) continue;
            report.strategy = Strategy::other;
            report.other = i;
            take_step(work, other, 0, 1);
        }
        if (report.fraction < 1) HARMORPH_TRY(substeps(work));
    }
    if (derivative != nullptr) finish_derivative(work);
    if (options.heights > 0) restore_heights(work);
    measure_first_layer(work);
    if (report.fraction >= 1) return fault.status;
    return fault.refuse(Status::short_of_target, "the mesh could follow ~ of the movement; then cell # stands in the way",
                        Counts::mesh, report.limit.cell, none, report.fraction);
}

void SafeMorph::write(MutablePoints to) const noexcept {
    for (Index k = 0; k < x.count(); ++k) to.set(k, now()[k]);
}

// From where the movements are to where they shall be at that time of the way.
void SafeMorph::aim(Real time) noexcept {
    path.at(time, aimed);
    for (Index i = 0; i < difference.count(); ++i) difference[i] = aimed[i] - reached[i];
}

// The step by `difference`, where it leads, and whether no cell inverts before its end.
bool SafeMorph::is_admissible(Work& work, Basis const& by) noexcept {
    morph(by, difference.data(), {}, next(), work.executor());
    work.report.limit = admissible_step(work.cells(), now(), next(), work.executor());
    for (Index k = 0; k < x.count(); ++k) {
        next_x[k] = next_x[k] == 0 ? x[k] : x[k] + next_x[k];
        next_y[k] = next_y[k] == 0 ? y[k] : y[k] + next_y[k];
    }
    put_wall(work);
    return work.report.limit.step > 1;
}

// Of the coordinates as they will be stored, after all roundings: every corner is positive exactly and as quality measures
// it, and the boundary does not cross itself.
bool SafeMorph::is_valid(Work const& work) const noexcept {
    for (Index k = 0; k < x.count(); ++k) {
        if (!is_in_range(next()[k])) return false;
    }
    return count_inverted(work) == 0 && !find_crossing(work.basis.boundary_point, work.basis.loop_start, next()).found;
}

Index SafeMorph::count_inverted(Work const& work) const noexcept {
    OrientedMesh const cells = work.cells();
    return reduce_cells<Count>(cells.mesh.n_cells, work.executor(), [&](Index cell, Count& count) {
        CellShape const shape(cells.mesh.cell(cell), next(), cells.reversed[cell] != 0);
        count.n += is_inverted(shape) || is_inverted_exactly(shape) ? 1 : 0;
    }).n;
}

Status SafeMorph::substeps(Work& work) noexcept {
    SafeReport& report = work.report;
    Basis const here = unsolved_copy(work.basis);
    // A solution that failed may have left anything in `here`; the functions of the start always serve.
    auto const functions = [&]() -> Basis const& { return here.header->solved == 1 ? here : work.basis; };
    while (work.options.tries(Strategy::substeps)) {
        Real const length = find_step(work, functions(), report.fraction);
        if (length < least_step) break;
        report.strategy = Strategy::substeps;
        take_step(work, functions(), report.fraction, smaller(report.fraction + length, 1.0));
        if (report.fraction >= 1) return Status::ok;
        if (report.resolves == work.options.most_resolves) break;
        Fault why;
        Status const status = solve_at_present(work, here, why);
        if (failed(status) && status != Status::cancelled) break;  // a scheme that cannot, or a mesh too poor
        if (status != Status::ok) work.fault = why;                // not converged: a warning, and on
        HARMORPH_TRY(status);
        ++report.resolves;
    }
    if (!work.options.tries(Strategy::untangled)) return Status::ok;
    return untangle(work, functions());
}

// All but the values stays as it is.
Basis SafeMorph::unsolved_copy(Basis const& basis) const noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(basis.header);
    auto const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    std::memcpy(block.data(), begin, static_cast<Size>(end - begin));
    Basis const copy = Basis::view(static_cast<void*>(block.data()));
    copy.unseal();
    return copy;
}

// The longest step from here, in parts of the whole way, that takes no more than its share of what is admissible.
Real SafeMorph::find_step(Work& work, Basis const& by, Real from) noexcept {
    Real length = 1 - from;
    for (Index trial = 0; trial < most_trials && length >= least_step; ++trial) {
        Real const end = from + length;
        aim(end);
        is_admissible(work, by);
        Real const share = work.report.limit.step * share_of_admissible;
        if (share >= 1 && is_valid(work)) return length;
        length *= clamp(0.99 * share, 0.05, share >= 1 ? 0.5 : 0.9);
    }
    return 0;
}

// The mesh becomes the next one, which is valid.
void SafeMorph::take_step(Work& work, Basis const& by, Real from, Real to_time) noexcept {
    copy(x, Span<const Real>(next_x));
    copy(y, Span<const Real>(next_y));
    copy(reached, Span<const Real>(aimed));
    if (work.derivative != nullptr) {
        for (Index i = 0; i < weight.count(); ++i) weight[i] = path.weight(i, to_time) - path.weight(i, from);
        add_weighted(*work.derivative, by, weight, work.executor());
    }
    work.report.fraction = to_time;
    ++work.report.steps;
}

// From the start, and not from step to step: rounding does not add up.
void SafeMorph::put_wall(Work const& work) const noexcept {
    Matrix const& matrix = work.plan.equations.matrix;
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        Index const place = matrix.row_of[matrix.components() * k];
        if (!Matrix::is_wall(place)) continue;
        Vec2 const moved = work.basis.wall_move(Matrix::wall(place) / matrix.components(), aimed.data());
        Vec2 const start = work.mesh().points[k];
        next().set(k, {moved.x == 0 ? start.x : start.x + moved.x, moved.y == 0 ? start.y : start.y + moved.y});
    }
}

Status SafeMorph::solve_at_present(Work& work, Basis const& basis, Fault& why) noexcept {
    SolveReport solved;
    HARMORPH_TRY(work.plan.factor(now(), why));
    return work.plan.solve(basis, solved, why);
}

// The rest of the way in one step, whatever it inverts, and then the inner points find their places.
Status SafeMorph::untangle(Work& work, Basis const& by) noexcept {
    aim(1);
    morph(by, difference.data(), now(), next(), work.executor());
    put_wall(work);
    untangling.tangle = {work.mesh(), work.mesh().points, work.basis.reversed, representative, held};
    untangling.executor = work.executor();
    Fault why;
    Status const status = untangling.run(work.options.untangle, next(), work.report.untangle, why);
    if (status != Status::ok || !is_valid(work)) return Status::ok;  // points that slide may have passed others
    take_step(work, by, work.report.fraction, 1);
    work.report.strategy = Strategy::untangled;
    return Status::ok;
}

// As much as no cell inverts for: all that is asked for, or a half, or a quarter, ...
void SafeMorph::restore_heights(Work& work) noexcept {
    constexpr Index most_halvings = 4;
    Points const before = work.mesh().points;
    for (Index k = 0; k < x.count(); ++k) kinds[k] = held[k] != 0 ? PointKind::fixed : PointKind::inside;
    work.plan.equations.wall.build(before);
    wall_heights.find(work.mesh(), before, kinds, representative, work.plan.equations.wall, work.executor());
    Real amount = work.options.heights;
    for (Index halving = 0; halving <= most_halvings; ++halving, amount *= 0.5) {
        copy(next_x, Span<const Real>(x));
        copy(next_y, Span<const Real>(y));
        wall_heights.restore(work.plan.equations.wall, before, next(), representative, amount, work.executor());
        if (!is_valid(work)) continue;
        copy(x, Span<const Real>(next_x));
        copy(y, Span<const Real>(next_y));
        work.report.heights = amount;
        return;
    }
}

void SafeMorph::measure_first_layer(Work& work) noexcept {
    first_layer.find(work.mesh(), work.mesh().points, representative, work.plan.equations.wall);
    work.report.first_layer = compare(first_layer, work.mesh().points, now());
}

void SafeMorph::finish_derivative(Work const& work) const noexcept {
    work.derivative->header->coordinates = work.basis.header->coordinates;
    work.derivative->seal();
}

}  // namespace harmorph
