// The C interface: smooth bounds of the quality of a mesh, and the derivative of the admissible
// step.
#include "apart.hpp"
#include "limits.hpp"
#include "mesh_pair.hpp"
#include "morph/admissible_step.hpp"
#include "morph/cell_bounds.hpp"
#include "morph/odd_cells.hpp"
#include "morph/quality.hpp"

namespace harmorph {
namespace {

constexpr Real default_sharpness = 200;

using BoundLimit = Limit<hm_bound>;
constexpr BoundLimit bound_limits[] = {
    {&hm_bound::kind, HM_BOUND_QUALITY, HM_BOUND_ANGLE,
     "the kind of bound # is @, but it must be one of HM_BOUND_QUALITY to HM_BOUND_ANGLE"},
    {&hm_bound::reserved, 0, 0, "reserved of bound # must be 0, not @"},
    {&hm_bound::sharpness, 1, 1e6,
     "the sharpness of bound # is ~, but it must be 0 or between 1 and 1e6",
     BoundLimit::Zero::is_default},
};

using MeshQualityBlock = InBlock<MeshQuality>;

// One bound of a call, checked.
struct BoundAsked {
    std::int32_t kind = 0;
    Real sharpness = 0;
    MutablePoints gradient;

    bool is_quality() const noexcept {
        return kind == HM_BOUND_QUALITY || kind == HM_BOUND_KEPT_QUALITY;
    }
    bool is_layer() const noexcept { return kind >= HM_BOUND_HEIGHT; }
    LayerValue layer_value() const noexcept {
        return kind == HM_BOUND_HEIGHT    ? LayerValue::height
               : kind == HM_BOUND_STRETCH ? LayerValue::stretch
                                          : LayerValue::angle;
    }
};

Status view_bound(const hm_bound* array, Index number, const hm_points_out* gradients,
                  BoundAsked& asked, Fault& fault) noexcept {
    hm_bound bound;
    Item const item = entry_item(number);
    HARMORPH_TRY(open_element(array, number, bound, item, "bound", "hm_bound", fault));
    HARMORPH_TRY(check_limits(bound, bound_limits, fault, item));
    asked = {bound.kind, bound.sharpness == 0 ? default_sharpness : bound.sharpness, {}};
    if (gradients == nullptr || (gradients[number].x == nullptr && gradients[number].y == nullptr))
        return Status::ok;
    return view_points(&gradients[number], "gradients", asked.gradient, fault);
}

hm_bound_value value_of(BoundAsked const& asked, SmoothMinimum const& found,
                        Index index_base) noexcept {
    Real const sign = asked.kind == HM_BOUND_STRETCH ? -1 : 1, bound = found.bound();
    hm_bound_value value = {};
    value.bound = sign * bound;
    value.extreme = sign * found.smallest;
    value.item_kind = asked.is_layer() ? HM_ITEM_POINT : HM_ITEM_CELL;
    value.item = numbered(found.item, index_base);
    value.count = found.count;
    return value;
}

// Computes all bounds of a call. A bound of the quality and a bound of the areas are computed in
// one pass over the cells.
struct BoundsCall {
    MeshQuality const& quality;
    Points at;
    Executor const& executor;
    const hm_bound* bounds;
    const hm_points_out* gradients;
    hm_bound_value* values;

    BoundAsked bound(Index number) const noexcept {
        Fault none_expected;
        BoundAsked asked;
        view_bound(bounds, number, gradients, asked, none_expected);
        return asked;
    }
    void clear(MutablePoints gradient) const noexcept {
        clear_gradient(gradient, quality.cells.mesh.n_points);
    }
    void finish(Index number, BoundAsked const& asked, SmoothMinimum const& found) const noexcept {
        write_element(value_of(asked, found, quality.cells.mesh.index_base), values, number);
    }
    void find_layer(Index number) const noexcept {
        BoundAsked const asked = bound(number);
        clear(asked.gradient);
        SmoothMinimum const found =
            find_layer_bound(quality.edges(), asked.layer_value(), asked.sharpness, at,
                             quality.start(), asked.gradient);
        if (asked.kind == HM_BOUND_STRETCH)
            scale_gradient(asked.gradient, quality.cells.mesh.n_points, -1, executor);
        finish(number, asked, found);
    }
    // Computes a bound of the quality and one of the areas, either of which may be none.
    void find_pair(Index number_of_quality, Index number_of_area) const noexcept {
        CellBoundPair pair;
        BoundAsked of_quality, of_area;
        if (number_of_quality != none) {
            of_quality = bound(number_of_quality);
            pair.quality = {of_quality.sharpness, of_quality.gradient, {}};
            pair.kept = of_quality.kind == HM_BOUND_KEPT_QUALITY;
        }
        if (number_of_area != none) {
            of_area = bound(number_of_area);
            pair.area = {of_area.sharpness, of_area.gradient, {}};
        }
        clear(of_quality.gradient);
        clear(of_area.gradient);
        find_cell_bounds(quality.cells, at, quality.start(), executor, pair);
        if (number_of_quality != none) finish(number_of_quality, of_quality, pair.quality.found);
        if (number_of_area != none) finish(number_of_area, of_area, pair.area.found);
    }
    // Finds the next bound of the quality, or of the areas, from an entry on.
    Index next(Index from, Index n, bool is_quality) const noexcept {
        for (Index k = from; k < n; ++k) {
            BoundAsked const asked = bound(k);
            if (!asked.is_layer() && asked.is_quality() == is_quality) return k;
        }
        return none;
    }
    void find_all(Index n) const noexcept {
        for (Index k = 0; k < n; ++k) {
            if (bound(k).is_layer()) find_layer(k);
        }
        Index of_quality = next(0, n, true), of_area = next(0, n, false);
        while (of_quality != none || of_area != none) {
            find_pair(of_quality, of_area);
            of_quality = of_quality == none ? none : next(of_quality + 1, n, true);
            of_area = of_area == none ? none : next(of_area + 1, n, false);
        }
    }
};

// Gradients must be apart from `at` and from each other.
Status check_gradients(const hm_points_out* gradients, Index n, Points at, Index n_points,
                       Fault& fault) noexcept {
    auto const view = [&](Index k) {
        return MutablePoints{gradients[k].x, gradients[k].y, stride_of(gradients[k].stride)};
    };
    if (gradients == nullptr) return Status::ok;
    for (Index k = 0; k < n; ++k) {
        Apart from_at;
        from_at.add("at", at, n_points);
        HARMORPH_TRY(from_at.check("gradients", view(k), n_points, fault));
        for (Index before = 0; before < k; ++before) {
            Apart from_other;
            from_other.add("gradients", view(before), n_points);
            HARMORPH_TRY(from_other.check("gradients", view(k), n_points, fault));
        }
    }
    return Status::ok;
}

Status view_start(const hm_points* given, Mesh const& mesh, Points& start, Fault& fault) noexcept {
    HARMORPH_TRY(view_coordinates(given, "start", mesh, start, fault));
    return check_range(start, mesh.n_points, fault);
}

// The corners that a caller wants, in the order of steps.
struct StepCornerList {
    OrientedMesh const& cells;
    Index index_base;
    hm_step_corner* corners;  // [capacity]
    Index capacity;
    Index count = 0;  // includes those corners for which there is no room

    void insert(StepCorner const& found) noexcept {
        Index to = min(count++, capacity);
        for (; to > 0 && found.step < corners[to - 1].step; --to) {
            if (to < capacity) corners[to] = corners[to - 1];
        }
        if (to == capacity) return;
        hm_step_corner& corner = corners[to];
        corner.step = found.step;
        corner.cell = numbered(cells.mesh.number(found.cell), index_base);
        for (Index k = 0; k < 3; ++k) {
            corner.points[k] = numbered(found.point[k], index_base);
            corner.by_from[2 * k] = found.by_position[k].x;
            corner.by_from[2 * k + 1] = found.by_position[k].y;
        }
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_quality_init(hm_quality** quality, hm_memory* memory, const hm_basis* basis,
                          const hm_mesh* mesh, const hm_points* start, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Mesh view;
        OrientedMesh cells;
        Points at;
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        MeshQualityBlock made;
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { made.lay_out(arena, b, cells.mesh); }));
        HARMORPH_TRY(require({{"quality", quality}}, fault));
        HARMORPH_TRY(view_start(start, view, at, fault));
        Index const inverted = measure_quality(cells, at, {}, {}).first_inverted;
        if (inverted != none) {
            return fault.refuse(Status::bad_mesh, "cell # is inverted at the start",
                                cell_item(inverted));
        }
        made.object.find(b, cells, at);
        made.give(quality);
        return Status::ok;
    });
}

hm_status hm_quality_bounds(const hm_quality* quality, const hm_points* at, int32_t n,
                            const hm_bound* bounds, hm_bound_value* values,
                            const hm_points_out* gradients, const hm_executor* executor,
                            hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        HARMORPH_TRY(
            require({{"quality", quality}, {"bounds", bounds}, {"values", values}}, fault));
        MeshQuality const& opened = *reinterpret_cast<const MeshQuality*>(quality);
        Mesh const& mesh = opened.cells.mesh;
        fault.bases.set(mesh);
        if (n < 1)
            return fault.refuse(Status::bad_argument, "n must be at least 1, not #", plain(n));
        HARMORPH_TRY(check_report(values, "values", fault));
        BoundAsked asked;
        for (Index k = 0; k < n; ++k) {
            HARMORPH_TRY(view_bound(bounds, k, gradients, asked, fault));
            if (!asked.is_layer() || opened.n_edges > 0) continue;
            return fault.refuse(Status::bad_argument,
                                "bound # is one of the first layer, but no wall point has an edge "
                                "of a first layer",
                                entry_item(k));
        }
        Points here;
        Executor threads;
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(view_coordinates(at, "at", mesh, here, fault));
        HARMORPH_TRY(check_gradients(gradients, n, here, mesh.n_points, fault));
        HARMORPH_TRY(check_range(here, mesh.n_points, fault, threads));
        BoundsCall{opened, here, threads, bounds, gradients, values}.find_all(n);
        return Status::ok;
    });
}

hm_status hm_step_gradient(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from,
                           const hm_points* displacement, double closeness, int32_t capacity,
                           hm_step_corner* corners, int32_t* n, const hm_executor* executor,
                           hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Mesh view;
        OrientedMesh cells;
        Points start, change;
        HARMORPH_TRY(require({{"corners", corners}, {"n", n}}, fault));
        if (capacity < 1) {
            return fault.refuse(Status::bad_argument, "capacity must be at least 1, not #",
                                plain(capacity));
        }
        if (!is_finite(closeness) || closeness < 0 || closeness > 1) {
            return fault.refuse(Status::bad_argument, "closeness must be between 0 and 1, not ~",
                                {}, {}, closeness);
        }
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        HARMORPH_TRY(view_coordinates(from, "from", view, start, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", change, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(check_range(start, view.n_points, fault, threads));
        HARMORPH_TRY(check_range(change, view.n_points, fault, threads));
        AdmissibleStep const limit = admissible_step(cells, start, change, threads);
        if (limit.step == 0) {
            return fault.refuse(Status::bad_mesh, "cell # is inverted at `from`",
                                cell_item(cells.mesh.number(limit.cell)));
        }
        if (!(limit.step < infinity)) {
            *n = 0;
            return Status::ok;
        }
        Real const max_step = (1 + closeness) * limit.step;
        find_step_corners(
            cells, start, change, limit, max_step, threads, [&](StepCorner const& found) {
                if (found.has_derivative || failed(fault.status)) return;
                fault.refuse(
                    Status::bad_mesh,
                    "the step has no derivative, because the area of a corner of cell # only "
                    "touches 0",
                    cell_item(cells.mesh.number(found.cell)));
            });
        HARMORPH_TRY(fault.status);
        StepCornerList list{cells, view.index_base, corners, capacity};
        find_step_corners(cells, start, change, limit, max_step, threads,
                          [&](StepCorner const& found) { list.insert(found); });
        *n = list.count;
        return Status::ok;
    });
}

}  // extern "C"
