#include "curves/curves.hpp"

#include "basics/library.hpp"

#include <algorithm>
#include <numeric>

namespace cli {

void Curves::append(const Curves& others) {
    const std::int32_t first = points();
    // Points that were given without weights have the weight 1.
    if (!weights.empty() || !others.weights.empty()) {
        weights.resize(control.size() / 2, 1.0);
        weights.insert(weights.end(), others.weights.begin(), others.weights.end());
        weights.resize((control.size() + others.control.size()) / 2, 1.0);
    }
    control.insert(control.end(), others.control.begin(), others.control.end());
    for (Curve curve : others.curves) {
        for (std::int32_t& index : curve.indices) index += first;
        curves.push_back(curve);
    }
}

std::vector<std::int32_t> default_indices(std::int32_t n, std::int32_t degree,
                                          std::int32_t closed) {
    const std::int32_t repeated = closed == HM_PERIODIC ? degree : closed == HM_TIED ? 1 : 0;
    std::vector<std::int32_t> indices(static_cast<std::size_t>(n + repeated));
    std::iota(indices.begin(), indices.end(), 0);
    for (std::int32_t i = 0; i < repeated; ++i) indices[static_cast<std::size_t>(n + i)] = i % n;
    return indices;
}

bool closes(const Curve& curve) {
    const bool ends_meet = curve.indices.front() == curve.indices.back();
    if (curve.closed == HM_OPEN) return !ends_meet;
    if (curve.closed == HM_TIED) return ends_meet;
    return curve.indices.size() > 2 * static_cast<std::size_t>(curve.degree) &&
           std::equal(curve.indices.begin(), curve.indices.begin() + curve.degree,
                      curve.indices.end() - curve.degree);
}

Curves copied(const hm_curves& from) {
    Curves to;
    to.control.assign(from.control, from.control + 2 * from.n_control);
    if (from.weights) to.weights.assign(from.weights, from.weights + from.n_control);
    for (std::int32_t i = 0; i < from.n_curves; ++i) {
        const hm_curve& given = from.curve[i];
        Curve curve;
        curve.degree = given.degree;
        curve.indices = default_indices(given.n_indices, given.degree, HM_OPEN);
        if (given.indices) curve.indices.assign(given.indices, given.indices + given.n_indices);
        for (std::int32_t& index : curve.indices) index -= given.indices ? from.index_base : 0;
        curve.knots.assign(given.knots, given.knots + given.n_indices + given.degree + 1);
        // The library derives from the indices how a curve closes.
        for (const std::int32_t closed : {HM_TIED, HM_PERIODIC}) {
            curve.closed = closed;
            if (closes(curve)) break;
            curve.closed = HM_OPEN;
        }
        to.curves.push_back(curve);
    }
    return to;
}

const char* closed_name(std::int32_t closed) {
    return closed == HM_PERIODIC ? "periodic" : closed == HM_TIED ? "tied" : "open";
}

CurvesView::CurvesView(const Curves& curves) : view_(sized<hm_curves>()) {
    for (const Curve& curve : curves.curves) {
        indices_.push_back(curve.indices);
        for (std::int32_t& index : indices_.back()) ++index;
        auto view = sized<hm_curve>();
        view.degree = curve.degree;
        view.n_indices = static_cast<std::int32_t>(curve.indices.size());
        view.indices = indices_.back().data();
        view.knots = curve.knots.data();
        curve_.push_back(view);
    }
    view_.index_base = 1;
    view_.n_control = curves.points();
    view_.control = curves.control.data();
    view_.weights = curves.weights.empty() ? nullptr : curves.weights.data();
    view_.n_curves = static_cast<std::int32_t>(curve_.size());
    view_.curve = curve_.data();
}

}  // namespace cli
