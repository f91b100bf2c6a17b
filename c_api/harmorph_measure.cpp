// The C interface: measures a section.
#include "bspline/section_measures.hpp"
#include "limits.hpp"
#include "section_view.hpp"

namespace harmorph {
namespace {

// Of the sharpness: products with lengths, and quotients of logarithms, neither overflow nor
// underflow.
using QuantityLimit = Limit<hm_quantity>;
constexpr QuantityLimit quantity_limits[] = {
    {&hm_quantity::kind, HM_AREA, HM_DISTANCE,
     "the kind of quantity # is @, but it must be one of HM_AREA to HM_DISTANCE"},
    {&hm_quantity::sharpness, 1e-100, 1e100,
     "the sharpness of quantity # is ~, but it must be 0 or between 1e-100 and 1e100",
     QuantityLimit::Zero::is_default},
};

// Reads the stations of a quantity.
Status view_stations(hm_quantity const& q, Index number, Quantity& out, Fault& fault) noexcept {
    bool const has_range = out.kind == QuantityKind::min_thickness,
               has_station = has_range || out.kind == QuantityKind::thickness ||
                             out.kind == QuantityKind::camber;
    if (has_station ? !(is_finite(q.station) && q.station > 0 && q.station < 1) : q.station != 0) {
        const char* const text =
            has_station ? "the station of quantity # is ~, but it must lie between 0 and 1"
                        : "quantity # has a station, but only HM_THICKNESS, HM_CAMBER and "
                          "HM_MIN_THICKNESS use one";
        return fault.refuse(Status::bad_argument, text, quantity_item(number), {}, q.station);
    }
    if (has_range
            ? !(is_finite(q.last_station) && q.last_station >= q.station && q.last_station < 1)
            : q.last_station != 0) {
        const char* const text =
            has_range ? "the last station of quantity # is ~, but it must lie between the first "
                        "one and 1"
                      : "quantity # has a last station, but only HM_MIN_THICKNESS uses one";
        return fault.refuse(Status::bad_argument, text, quantity_item(number), {}, q.last_station);
    }
    out.station = q.station;
    out.last_station = q.last_station;
    return Status::ok;
}

// Reads the other body of a distance, and joins its curves to an outline.
Status view_other(const hm_curves* curves, hm_quantity const& q, Index number,
                  Section const& section, Quantity& out, Section& other,
                  CallFault& fault) noexcept {
    if (out.kind != QuantityKind::distance) {
        if (q.other_curve == 0 && q.n_other == 0) return Status::ok;
        return fault.refuse(Status::bad_argument,
                            "quantity # names another body, but only HM_DISTANCE uses one",
                            quantity_item(number));
    }
    Index const first = section.first_curve, end = first + section.n_curves;
    if (q.n_other < 1 || q.other_curve < 0 ||
        (q.other_curve < end && q.other_curve + Offset{q.n_other} > first)) {
        return fault.refuse(Status::bad_argument,
                            "the other body of quantity # has no curves, or curves of the section",
                            quantity_item(number));
    }
    hm_section asked = {};
    asked.struct_size = sizeof asked;
    asked.first_curve = q.other_curve;
    asked.n_curves = q.n_other;
    CurvesView view;
    HARMORPH_TRY(open_section(curves, &asked, view, other, fault));
    out.other = &other;
    return Status::ok;
}

Status view_quantity(const hm_curves* curves, const hm_quantity* array, Index number,
                     Section const& section, Quantity& out, Section& other,
                     CallFault& fault) noexcept {
    hm_quantity q;
    Item const item = quantity_item(number);
    HARMORPH_TRY(open_element(array, number, q, item, "quantity", "hm_quantity", fault));
    HARMORPH_TRY(check_limits(q, quantity_limits, fault, item));
    out.kind = static_cast<QuantityKind>(q.kind);
    HARMORPH_TRY(view_stations(q, number, out, fault));
    bool const may_be_smooth = out.kind == QuantityKind::clearance ||
                               out.kind == QuantityKind::min_thickness ||
                               out.kind == QuantityKind::distance;
    if (q.sharpness != 0 && !may_be_smooth) {
        return fault.refuse(Status::bad_argument,
                            "quantity # has the sharpness ~, but only HM_CLEARANCE, "
                            "HM_MIN_THICKNESS and HM_DISTANCE use one",
                            item, {}, q.sharpness);
    }
    out.sharpness = q.sharpness;
    bool const has_polygon = out.kind == QuantityKind::clearance;
    constexpr Index max_corners = Index{1} << 20;
    if (has_polygon ? q.n_polygon < 1 || q.n_polygon > max_corners || q.polygon == nullptr
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
    return view_other(curves, q, number, section, out, other, fault);
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
            Section other;
            HARMORPH_TRY(view_quantity(curves, quantities, k, outline, quantity, other, fault));
            if (failed(measure(outline, quantity, gradient, measured, fault)))
                fault.item = quantity_item(k);
            return fault.status;
        };
        // All quantities are checked before anything is written; the first ones are remembered.
        constexpr Index max_kept = 32;
        Measured kept[max_kept];
        for (Index k = 0; k < n; ++k) {
            HARMORPH_TRY(find(k, {}));
            if (k < max_kept) kept[k] = measured;
        }
        Offset const length = 2 * Offset{view.set.n_control};
        for (Index k = 0; k < n; ++k) {
            ControlGradient gradient;
            if (gradients != nullptr) {
                Span<Real> const row(gradients + k * length, static_cast<Size>(length));
                fill(row, 0.0);
                gradient = ControlGradient(row.data());
            }
            if (gradients == nullptr && k < max_kept) measured = kept[k];
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
