// The C interface: measures a section.
#include "base/range.hpp"
#include "bspline/section_measures.hpp"
#include "section_view.hpp"

namespace harmorph {
namespace {

Status view_quantity(const hm_quantity* array, Index number, Quantity& out, Fault& fault) noexcept {
    hm_quantity q;
    if (!read_struct(array, q) || !read_struct(element(array, number), q)) {
        return fault.refuse(
            Status::bad_argument,
            "struct_size of quantity # is not the size of an hm_quantity; begin with HM_INIT",
            quantity_item(number));
    }
    if (q.kind < HM_AREA || q.kind > HM_CLEARANCE) {
        return fault.refuse(
            Status::bad_argument,
            "the kind of quantity # is @, but it must be one of HM_AREA to HM_CLEARANCE",
            quantity_item(number), plain(q.kind));
    }
    out.kind = static_cast<QuantityKind>(q.kind);
    bool const has_station =
        out.kind == QuantityKind::thickness || out.kind == QuantityKind::camber;
    if (has_station ? !(is_finite(q.station) && q.station > 0 && q.station < 1) : q.station != 0) {
        const char* const text =
            has_station ? "the station of quantity # is ~, but it must lie between 0 and 1"
                        : "quantity # has a station, but only HM_THICKNESS and HM_CAMBER use one";
        return fault.refuse(Status::bad_argument, text, quantity_item(number), {}, q.station);
    }
    out.station = q.station;
    bool const has_polygon = out.kind == QuantityKind::clearance;
    constexpr Index most = Index{1} << 20;
    if (has_polygon ? q.n_polygon < 1 || q.n_polygon > most || q.polygon == nullptr
                    : q.n_polygon != 0) {
        const char* const text =
            has_polygon ? "the polygon of quantity # is NULL, empty or longer than 2^20 points"
                        : "quantity # has a polygon, but only HM_CLEARANCE uses one";
        return fault.refuse(Status::bad_argument, text, quantity_item(number));
    }
    out.polygon = {q.polygon, has_polygon ? q.polygon + 1 : nullptr, 2};
    out.n_polygon = q.n_polygon;
    for (Index k = 0; k < out.n_polygon; ++k) {
        if (is_coordinate(out.polygon[k])) continue;
        return fault.refuse(Status::bad_argument,
                            "point @ of the polygon of quantity # is not finite or beyond 1e100",
                            quantity_item(number), entry_item(k));
    }
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_measure(const hm_curves* curves, const hm_section* section, int32_t n,
                     const hm_quantity* quantities, double* values, double* at, double* gradients,
                     hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        CurvesView view;
        Section outline;
        HARMORPH_TRY(require({{"quantities", quantities}, {"values", values}}, fault));
        if (n < 1)
            return fault.refuse(Status::bad_argument, "n must be at least 1, not #", plain(n));
        HARMORPH_TRY(open_section(curves, section, view, outline, fault));
        Measured measured;
        auto const find = [&](Index k, ControlGradient const& gradient) {
            Quantity quantity;
            HARMORPH_TRY(view_quantity(quantities, k, quantity, fault));
            if (failed(measure(outline, quantity, gradient, measured, fault)))
                fault.item = quantity_item(k);
            return fault.status;
        };
        // All quantities are checked before anything is written; the first ones are remembered.
        constexpr Index most_kept = 32;
        Measured kept[most_kept];
        for (Index k = 0; k < n; ++k) {
            HARMORPH_TRY(find(k, {}));
            if (k < most_kept) kept[k] = measured;
        }
        Offset const length = 2 * Offset{view.set.n_control};
        for (Index k = 0; k < n; ++k) {
            ControlGradient gradient;
            if (gradients != nullptr) {
                Span<Real> const row(gradients + k * length, static_cast<Size>(length));
                fill(row, 0.0);
                gradient = ControlGradient(row.data());
            }
            if (gradients == nullptr && k < most_kept) measured = kept[k];
            else find(k, gradient);
            values[k] = measured.value;
            if (at == nullptr) continue;
            at[2 * k] = measured.at.x;
            at[2 * k + 1] = measured.at.y;
        }
        return Status::ok;
    });
}

}  // extern "C"
