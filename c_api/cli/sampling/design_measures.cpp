#include "sampling/design_measures.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "options/place_options.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::int32_t end_of(const hm_curves& curves, std::int32_t curve, bool last) {
    const hm_curve& one = curves.curve[curve];
    const std::int32_t place = last ? one.n_indices - 1 : 0;
    return one.indices == nullptr ? place : one.indices[place] - curves.index_base;
}

bool is_base(const hm_curves& curves, std::int32_t curve) {
    if (curve + 1 >= curves.n_curves) return false;
    const std::int32_t a = end_of(curves, curve, false), b = end_of(curves, curve, true),
                       c = end_of(curves, curve + 1, false), d = end_of(curves, curve + 1, true);
    return a != b && ((c == a && d == b) || (c == b && d == a));
}

}  // namespace

SectionMeasures::SectionMeasures(const Arguments& arguments, const hm_curves& curves,
                                 std::int32_t curve)
    : section_(section_of(arguments)) {
    section_.first_curve = curve;
    section_.n_curves = is_base(curves, curve) ? 2 : 1;
    add("area", HM_AREA);
    add("chord", HM_CHORD);
    add("max_thickness", HM_MAX_THICKNESS);
    add("max_camber", HM_MAX_CAMBER);
    add("leading_edge_radius", HM_LEADING_EDGE_RADIUS);
    add("trailing_edge_angle", HM_TRAILING_EDGE_ANGLE);
    if (!arguments.has("--stations")) return;
    for (const double station : stations_of(arguments)) {
        add("thickness_" + brief(station), HM_THICKNESS, station);
        add("camber_" + brief(station), HM_CAMBER, station);
    }
}

void SectionMeasures::add(const std::string& name, std::int32_t kind, double station) {
    auto quantity = sized<hm_quantity>();
    quantity.kind = kind;
    quantity.station = station;
    names_.push_back(name);
    quantities_.push_back(quantity);
}

std::vector<double> SectionMeasures::values(const hm_curves& curves,
                                            const std::vector<double>& control) const {
    hm_curves moved = curves;
    moved.control = control.data();
    const auto n = static_cast<std::int32_t>(quantities_.size());
    std::vector<double> values(quantities_.size(), unknown);
    const hm_status status = hm_measure(&moved, &section_, n, quantities_.data(), values.data(),
                                        nullptr, nullptr, nullptr);
    for (std::size_t k = 0; k < quantities_.size() && status < 0; ++k)
        hm_measure(&moved, &section_, 1, &quantities_[k], &values[k], nullptr, nullptr, nullptr);
    return values;
}

Limits::Limits(const Arguments& arguments, const std::vector<std::string>& names) : names_(names) {
    take(arguments, "--min", true);
    take(arguments, "--max", false);
}

void Limits::take(const Arguments& arguments, const char* option, bool is_min) {
    for (const std::string& text : arguments.all(option)) {
        const auto [name, number] = arguments.named_numbers(option, text, 1, "NAME=NUMBER");
        Limit limit = {0, is_min, number[0]};
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) {
            std::string known;
            for (const std::string& one : names_) known += (known.empty() ? "" : ", ") + one;
            arguments.refuse(std::string(option) + ": " + in_quotes(name) + " is none of " + known);
        }
        limit.column = static_cast<std::size_t>(found - names_.begin());
        limits_.push_back(limit);
    }
}

std::string Limits::refusal_from(const std::vector<double>& values, std::size_t first) const {
    for (const Limit& limit : limits_) {
        if (limit.column < first) continue;
        const double value = values[limit.column];
        const std::string& name = names_[limit.column];
        if (std::isnan(value)) return name + " does not exist";
        if (limit.is_min && value < limit.value)
            return name + " " + brief(value) + " is below " + brief(limit.value);
        if (!limit.is_min && value > limit.value)
            return name + " " + brief(value) + " is above " + brief(limit.value);
    }
    return "";
}

}  // namespace cli
