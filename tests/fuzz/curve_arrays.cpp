#include <harmorph_design.h>
#include "curve_arrays.hpp"

#include "problem.hpp"

#include <algorithm>
#include <fixtures/memory.hpp>

namespace fuzz {

void CurveArrays::add(std::vector<Point> const& points, bool is_loop, Input& input) {
    bool const is_fitted = input.below(3) > 0 && add_fit(points, is_loop, input);
    if (!is_fitted) add_polygon(points, is_loop);
}

void CurveArrays::finish(Input& input) {
    view = hm_curves{};
    view.struct_size = sizeof view;
    view.index_base = input.from(0, 1);
    for (std::size_t c = 0; c < curve.size(); ++c) {
        for (std::int32_t& k : indices[c]) k += view.index_base;
        curve[c].indices = indices[c].data();
        curve[c].knots = knots[c].data();
    }
    view.n_control = static_cast<std::int32_t>(control.size() / 2);
    view.control = control.data();
    view.n_curves = static_cast<std::int32_t>(curve.size());
    view.curve = curve.data();
    if (curve.empty() || !input.one_in(5)) return;
    for (std::int32_t k = 0; k < view.n_control; ++k) weights.push_back(input.between(0.3, 3));
    view.weights = weights.data();
}

bool CurveArrays::add_fit(std::vector<Point> const& points, bool is_loop, Input& input) {
    std::int32_t const n = static_cast<std::int32_t>(points.size()),
                       first = static_cast<std::int32_t>(control.size() / 2);
    hm_fit_options options = sized<hm_fit_options>();
    options.degree = input.from(1, 5);
    options.n_control = input.from(options.degree + 1, std::max(options.degree + 1, n));
    options.closed = input.from(0, 3);
    std::size_t bytes = 0;
    hm_error error;
    if (fixtures::fit_size(n, &options, &bytes, &error) < 0) return false;
    Block const block(bytes, input.below(64), static_cast<int>(input.below(256)));
    const hm_curves* fitted = nullptr;
    hm_points const at{&points[0].x, &points[0].y, 2};
    hm_status const status = hm_fit(&fitted, fixtures::Memory(block.data(), bytes), &at, n, is_loop,
                                    &options, nullptr, &error);
    block.expect_intact();
    if (status < 0) return false;
    expect(hm_curves_check(fitted, &error) == HM_OK,
           std::string("a fitted curve is refused: ") + error.text);
    control.insert(control.end(), fitted->control, fitted->control + 2 * fitted->n_control);
    for (std::int32_t c = 0; c < fitted->n_curves; ++c) {
        hm_curve const& made = fitted->curve[c];
        std::vector<std::int32_t> curve_indices;
        for (std::int32_t k = 0; k < made.n_indices; ++k)
            curve_indices.push_back(first + (made.indices != nullptr ? made.indices[k] : k));
        add_curve(made.degree, curve_indices,
                  {made.knots, made.knots + made.n_indices + made.degree + 1});
    }
    return true;
}

void CurveArrays::add_polygon(std::vector<Point> const& points, bool is_loop) {
    std::int32_t const first = static_cast<std::int32_t>(control.size() / 2);
    std::vector<std::int32_t> curve_indices;
    for (Point const& point : points) {
        curve_indices.push_back(first + static_cast<std::int32_t>(curve_indices.size()));
        control.insert(control.end(), {point.x, point.y});
    }
    if (is_loop) curve_indices.push_back(first);
    std::vector<double> curve_knots{0};
    for (std::size_t k = 0; k < curve_indices.size(); ++k)
        curve_knots.push_back(static_cast<double>(k));
    curve_knots.push_back(curve_knots.back());
    add_curve(1, curve_indices, curve_knots);
}

void CurveArrays::add_curve(std::int32_t degree, std::vector<std::int32_t> const& curve_indices,
                            std::vector<double> const& curve_knots) {
    hm_curve made = sized<hm_curve>();
    made.degree = degree;
    made.n_indices = static_cast<std::int32_t>(curve_indices.size());
    indices.push_back(curve_indices);
    knots.push_back(curve_knots);
    curve.push_back(made);
}

}  // namespace fuzz
