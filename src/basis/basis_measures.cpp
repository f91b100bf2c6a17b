#include "basis/basis_measures.hpp"

#include "base/executor.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

// The extremes of the values at each place of a block.
struct Extremes {
    Real minima[block_points] = {}, maxima[block_points] = {};

    void include(const Real* values) noexcept {
        for (Index k = 0; k < block_points; ++k) {
            minima[k] = min(minima[k], values[k]);
            maxima[k] = max(maxima[k], values[k]);
        }
    }
    void merge(Extremes const& others) noexcept {
        include(others.minima);
        include(others.maxima);
    }
};

}  // namespace

BoundaryError boundary_error(Basis const& basis, const Real* move, Points from,
                             Points to) noexcept {
    BoundaryError worst;
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (basis.is_given(slot)) continue;
        Index const point = basis.wall_point[slot];
        Vec2 const curve_moved = basis.wall_move(slot, move);
        worst.include(length(to[point] - from[point] - curve_moved), point);
    }
    for (Index k = 0; k < basis.shared_point.count(); ++k) {
        WallPlace const& place = basis.shared_place[k];
        if (basis.is_given(place) || basis.is_given(basis.shared_slot[k])) continue;
        Index const point = basis.shared_point[k];
        worst.include(length(to[point] - from[point] - basis.wall_move(place, move)), point);
    }
    return worst;
}

Tear find_tear(Basis const& basis, const Real* move, Points at) noexcept {
    Tear worst;
    if (basis.shared_point.empty()) return worst;
    Box box;
    for (Index const point : basis.wall_point) box.include(at[point]);
    worst.distance = Tear::tolerance * length(box.size());
    for (Index k = 0; k < basis.shared_point.count(); ++k) {
        WallPlace const& place = basis.shared_place[k];
        Index const slot = basis.shared_slot[k];
        if (basis.is_given(place) || basis.is_given(slot)) continue;
        Real const distance = length(basis.wall_move(place, move) - basis.wall_move(slot, move));
        if (!exceeds(distance, worst.distance)) continue;
        worst = {distance, k};
    }
    return worst;
}

Status check_tear(Basis const& basis, const Real* move, Points at, Status status,
                  Fault& fault) noexcept {
    Tear const tear = find_tear(basis, move, at);
    if (tear.shared == none) return Status::ok;
    return fault.refuse(status,
                        "the movement leaves point # ~ away from where condition @ takes it; put "
                        "both markers on one curve, or give the curves a common control point",
                        point_item(basis.shared_point[tear.shared]),
                        condition_item(basis.shared_condition[2 * tear.shared + 1]), tear.distance);
}

BasisMeasures measure_basis(Basis const& basis, Points points, Executor const& executor) noexcept {
    BasisMeasures measures;
    BasisCounts const& counts = basis.header->counts;
    Index const n_functions = basis.n_functions();
    // Only stored functions count.
    Index const n_control = clamp(counts.shapes() - counts.first_stored, Index{0}, n_functions);
    ValueKind const kind = basis.kind();
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        Index const point = basis.wall_point[slot];
        BoundaryFunctions const functions = basis.stored_boundary_functions(slot);
        auto const values = basis.row(point);
        for (Index plane = 0; plane < numbers_of(kind) && !counts.derived(); ++plane) {
            Real sum = 0;
            for (Index i = 0; i < n_functions; ++i) {
                Real const value = values[plane * n_functions + i];
                Real expected = 0;
                for (Index k = 0; k < functions.order; ++k) {
                    expected += functions.function[k] == i
                                    ? numbers_of(kind, functions.value[k]).plane[plane]
                                    : 0;
                }
                measures.value.include(abs(value - expected), point);
                sum += i < n_control ? value : 0;
            }
            if (!basis.is_on_curve(slot) || !counts.complete()) continue;
            Real const defect = abs(sum - numbers_of(kind, {1, 0}).plane[plane]);
            if (exceeds(defect, measures.partition_defect)) measures.partition_defect = defect;
        }
        if (!basis.is_on_curve(slot)) continue;
        Vec2 const foot = curve_point(basis.curve(basis.wall_curve[slot]), basis.wall_u[slot]);
        measures.distance.include(length(points[point] - foot), point);
    }
    auto const include = [&](Index begin, Index end, Extremes& extremes) {
        // Values after the last point are 0, as the extremes are at the start.
        for (Index block = begin; block < end; ++block) {
            const Real* const values =
                basis.value.data() + Offset{block} * block_points * basis.row_length();
            for (Index i = 0; i < n_control; ++i) extremes.include(values + i * block_points);
        }
    };
    Extremes const extremes =
        reduce_ranges<Extremes>(blocks_of(basis.n_points()), executor, include);
    for (Index k = 0; k < block_points; ++k) {
        measures.min_value = min(measures.min_value, extremes.minima[k]);
        measures.max_value = max(measures.max_value, extremes.maxima[k]);
    }
    return measures;
}

}  // namespace harmorph
