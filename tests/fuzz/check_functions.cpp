// The functions of a solution: finite, solutions of their equation, basis functions on curves; and
// derived bases.
#include <harmorph_bases.h>
#include "private.h"
#include <harmorph_study.h>
#include "solution_check.hpp"

#include <cmath>
#include <map>
#include <fixtures/memory.hpp>

namespace fuzz {

// The functions, finite, and solutions of their equation.
void SolutionCheck::values() {
    auto const numbers = std::size_t(info_.numbers_per_value);
    value_.assign(std::size_t(info_.functions), std::vector<Numbers>(numbers, Numbers(n_)));
    std::vector<bool> inside(n_, true);
    for (Face const& face : problem_.domain.faces)
        inside[std::size_t(face.from)] = inside[std::size_t(face.to)] = false;
    std::map<std::pair<double, double>, std::size_t> first;  // at a seam two points are one
    for (std::size_t k = 0; k < n_; ++k) {
        Point const& p = problem_.domain.points[k];
        auto const [found, is_new] = first.try_emplace({p.x, p.y}, k);
        if (!is_new) inside[k] = inside[found->second] = false;
    }
    for (std::int32_t i = 0; i < info_.functions; ++i)
        for (std::int32_t number = 0; number < info_.numbers_per_value; ++number) {
            Numbers& found = value_[std::size_t(i)][std::size_t(number)];
            expect(hm_basis_values(its_.basis, i, number, found.data(), &error_) == HM_OK,
                   "no values");
            for (double const value : found) {
                expect(std::isfinite(value), "a value is not finite");
                largest_ = std::max(largest_, std::abs(value));
            }
        }
    bool const is_laplace =
        problem_.options.operator_kind == HM_LAPLACE && problem_.options.scheme == HM_COMPACT;
    if (!is_laplace || judged_.ambiguous > 0 || its_.status != HM_OK ||
        problem_.options.engine != HM_DIRECT)
        return;
    for (std::vector<Numbers> const& function : value_)
        for (Numbers const& function_values : function) {
            double const residual =
                laplace_residual(problem_.domain, judged_, function_values, inside);
            expect(residual < 1e-7,
                   "Laplace's equation has the residual " + std::to_string(residual));
        }
}

// Points on curves have the basis functions at their parameter.
void SolutionCheck::wall() {
    if (info_.offset_correction != 0) return;
    for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
        std::int32_t const curve = info_.point_curve[slot];
        if (curve >= info_.curves) continue;
        Numbers const expected =
            basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            double const found = value_[i][0][std::size_t(info_.curve_point[slot])];
            expect(std::abs(found - expected[i]) < 1e-11,
                   "a point of the wall has another basis function");
        }
    }
}

// In single precision, for some points, and for some points of that.
void SolutionCheck::derived_bases() {
    hm_basis *single = nullptr, *rows = nullptr, *combined = nullptr;
    hm_status const made = its_.blocks.make(error_, size_by(fixtures::single_size, its_.basis),
                                            init_by(hm_single_init, &single, its_.basis));
    std::vector<std::int32_t> points(input_.below(20) + 1);
    for (std::int32_t& k : points)
        k = input_.from(0, problem_.mesh.n_points - 1) + problem_.mesh.index_base;
    std::int32_t const n = static_cast<std::int32_t>(points.size());
    hm_basis const* const whole = made >= 0 && input_.one_in(2) ? single : its_.basis;
    std::size_t bytes = 0;  // for any n points: these may need less
    expect(hm_private_extract_size(whole, n, &bytes, &error_) == HM_OK, "no size of an extract");
    expect(hm_private_extract_init(&rows, its_.blocks.take(bytes).data(), bytes, whole, n,
                                   points.data(), &error_) == HM_OK,
           "no extract");
    Numbers matrix(at(2 * info_.functions));
    for (double& number : matrix) number = input_.between(-1, 1);
    its_.blocks.make(error_, size_by(fixtures::combine_size, its_.basis, 2, 1),
                     init_by(hm_combine, &combined, its_.basis, 2, 1, matrix.data()));
    Numbers x(n_), y(n_), few_x(points.size()), few_y(points.size());
    hm_points_out const all{x.data(), y.data(), 1}, few{few_x.data(), few_y.data(), 1};
    expect(hm_morph(whole, move_.data(), nullptr, &all, nullptr, &error_) == HM_OK,
           "no displacement");
    expect(hm_morph(rows, move_.data(), nullptr, &few, nullptr, &error_) == HM_OK,
           "no displacement of an extract");
    for (std::size_t k = 0; k < points.size(); ++k)
        expect(few_x[k] == x[at(points[k] - problem_.mesh.index_base)],
               "an extract moves otherwise");
}

}  // namespace fuzz
