// The end of a safe morph: restored heights near walls, the worst cells, the derivative, and the
// report to the caller.
#include "base/vec2.hpp"
#include "morph/weighted_sum.hpp"
#include "safe/safe_work.hpp"

namespace harmorph {
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
    work.plan.walls_at(before);
    wall_heights.find(work.mesh(), before, kinds, mesh.representative, work.plan.walls(),
                      work.executor());
    bool const is_asked_for = work.options.heights > 0;
    Real const quality = work.best().min_quality;
    Real const permitted = min(quality, max(work.goal(), min_kept_quality * quality));
    // Restores a part of the heights in the mesh ahead.
    Outcome outcome;
    auto const accepts = [&](Real amount) {
        copy(mesh.ahead_x, Span<const Real>(best_x));
        copy(mesh.ahead_y, Span<const Real>(best_y));
        wall_heights.restore(work.plan.walls(), before, mesh.to_ahead(), mesh.representative,
                             amount, work.executor());
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
            turn_slipping(work);
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
        if (plan.kind(end) != PointKind::on_wall) return;
        if (plan.kind(beside) != PointKind::slip && plan.kind(beside) != PointKind::fixed) return;
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
