// Neumann values: normal derivatives given on the faces of free boundaries.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/parts.hpp>
#include <fixtures/perturb.hpp>
#include <fixtures/refused.hpp>

#include <functional>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

using Formula = std::function<double(double x, double y)>;
using Gradient = std::function<Point(double x, double y)>;

// The fluxes of functions F_i whose sum with the amounts a_i is a field: function i has the normal
// derivative of the field times a_i / |a|^2.
struct FieldFluxes {
    std::vector<std::int32_t> points;
    std::vector<double> values;

    FieldFluxes(Case const& setup, std::vector<double> const& amount, Gradient const& gradient) {
        double squares = 0;
        for (double const a : amount) squares += a * a;
        Mesh const& mesh = setup.mesh;
        for (std::size_t k = 0; k < mesh.face_markers.size(); ++k) {
            bool is_free = false;
            for (hm_condition const& c : setup.conditions)
                is_free = is_free || (c.kind == HM_FREE && c.marker == mesh.face_markers[k]);
            if (!is_free) continue;
            std::int32_t const a = mesh.faces[2 * k], b = mesh.faces[2 * k + 1];
            double const x0 = mesh.x[std::size_t(a)], y0 = mesh.y[std::size_t(a)],
                         dx = mesh.x[std::size_t(b)] - x0, dy = mesh.y[std::size_t(b)] - y0;
            Point const g = gradient(x0 + 0.5 * dx, y0 + 0.5 * dy);
            double const derivative = (g.x * dy - g.y * dx) / std::hypot(dx, dy);
            // Neither the order of the two points nor that of the faces matters.
            points.insert(points.begin(), {k % 2 == 0 ? a : b, k % 2 == 0 ? b : a});
            std::vector<double> row;
            for (double const amplitude : amount) row.push_back(derivative * amplitude / squares);
            values.insert(values.begin(), row.begin(), row.end());
        }
    }
    hm_problem added_to(Case& setup) {
        hm_problem problem = setup.problem();
        numbered = points;
        for (std::int32_t& point : numbered) point += setup.index_base;
        problem.n_fluxes = std::int32_t(points.size() / 2);
        problem.flux_points = numbered.data();
        problem.fluxes = values.data();
        return problem;
    }
    std::vector<std::int32_t> numbered;
};

double largest_error(Mesh const& mesh, std::vector<double> const& found, Formula const& exact) {
    double worst = 0;
    for (std::size_t k = 0; k < found.size(); ++k)
        worst = std::fmax(worst, std::fabs(found[k] - exact(mesh.x[k], mesh.y[k])));
    return worst;
}

// The field 1 + x + 2 y: the bottom is on a curve, the other sides are free.
std::vector<double> const linear_amounts = {1, 2, 0, 0};
double linear_field(double x, double y) { return 1 + x + 2 * y; }
Point linear_gradient(double, double) { return {1, 2}; }
Case linear_case(Cells kind) {
    Case setup;
    setup.mesh = square(8, kind);
    perturb(setup.mesh, 0.3, 7);
    setup.curves = polyline({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    setup.put_on_curves(bottom);
    for (std::int32_t const side : {right, top, left}) setup.set_free(side);
    return setup;
}

// An annulus whose inner circle is a polyline with a control point at each boundary point, and
// whose outer circle is free. The field is r^2 cos 2t + 3 log r.
double round_field(double x, double y) { return x * x - y * y + 1.5 * std::log(x * x + y * y); }
Point round_gradient(double x, double y) {
    double const r2 = x * x + y * y;
    return {2 * x + 3 * x / r2, -2 * y + 3 * y / r2};
}
double round_error(int refine, Cells kind, Options const& options) {
    int const n_t = 24 * refine;
    Case setup;
    setup.mesh = annulus(6 * refine, n_t, 0.5, 1.5, kind);
    std::vector<Point> corners;
    std::vector<double> amount;
    for (int k = 0; k < n_t; ++k) {
        corners.push_back({setup.mesh.x[std::size_t(k)], setup.mesh.y[std::size_t(k)]});
        amount.push_back(round_field(corners.back().x, corners.back().y));
    }
    setup.curves = polyline(corners);
    setup.put_on_curves(body);
    setup.set_free(far_field);
    FieldFluxes fluxes(setup, amount, round_gradient);
    Solved const solved(fluxes.added_to(setup), options);
    return largest_error(setup.mesh, solved.combined(amount), round_field);
}

Options scheme_of(std::int32_t scheme, std::int32_t engine) {
    Options options = laplace();
    options.scheme = scheme;
    options.engine = engine;
    options.tolerance = 1e-11;
    return options;
}

}  // namespace

TEST_CASE("a linear field with its normal derivatives on three sides is exact, for all engines") {
    struct Way {
        std::int32_t scheme, engine;
    };
    Way const ways[] = {{HM_COMPACT, HM_DIRECT},        {HM_COMPACT, HM_MULTIGRID},
                        {HM_COMPACT, HM_FAS},           {HM_BOUNDED, HM_DIRECT},
                        {HM_NODAL_GRADIENT, HM_DIRECT}, {HM_NODAL_GRADIENT, HM_FAS}};
    for (Cells const kind : kinds)
        for (Way const& way : ways) {
            Case setup = linear_case(kind);
            setup.index_base = way.engine == HM_DIRECT ? 0 : 1;
            FieldFluxes fluxes(setup, linear_amounts, linear_gradient);
            INFO("scheme " << way.scheme << ", engine " << way.engine);
            Solved const solved(fluxes.added_to(setup), scheme_of(way.scheme, way.engine));
            CHECK(solved.report.residual < 1e-10);
            CHECK(largest_error(setup.mesh, solved.combined(linear_amounts), linear_field) <
                  (way.engine == HM_DIRECT ? 1e-12 : 1e-8));
        }
}

TEST_CASE("a harmonic field on an annulus with its fluxes outside, to second order") {
    for (Cells const kind : kinds)
        for (std::int32_t const engine : {HM_DIRECT, HM_MULTIGRID}) {
            Options const options = scheme_of(HM_COMPACT, engine);
            double const coarse = round_error(1, kind, options),
                         fine = round_error(2, kind, options),
                         finest = round_error(4, kind, options);
            INFO(coarse << " " << fine << " " << finest);
            CHECK(finest < 5e-3);
            CHECK(std::log2(coarse / fine) > 1.7);
            CHECK(std::log2(fine / finest) > 1.8);
        }
}

TEST_CASE("with a weight the flux is k dF/dn: layers above a plate carry one flux") {
    for (double const exponent : {0.5, 1.0, 2.0}) {
        int const n = 8;
        Case setup;
        setup.mesh = square(n);
        setup.curves = polyline({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        setup.put_on_curves(bottom);
        for (std::int32_t const side : {right, top, left}) setup.set_free(side);
        double const flux = 0.7;
        FieldFluxes fluxes(setup, {1, 1, 0, 0}, [&](double, double y) {
            return Point{0, y > 1 - 1e-9 ? flux : 0};
        });
        Options const options = options_of(HM_WEIGHTED, exponent);
        Solved const solved(fluxes.added_to(setup), options);
        std::vector<double> const found = solved.combined({1, 1, 0, 0});
        // In layer j, of height 1/n, k = 1 / d^q with d = (j + 1/2) / n.
        double expected = 1;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i)
                CHECK(found[std::size_t(j * (n + 1) + i)] ==
                      doctest::Approx(expected).epsilon(1e-11));
            expected += flux / n * std::pow((j + 0.5) / n, exponent);
        }
    }
}

TEST_CASE("beside slip lines the flux acts along them, and is taken up normal to them") {
    for (std::int32_t const engine : {HM_DIRECT, HM_MULTIGRID}) {
        Case setup;
        setup.mesh = square(8, Cells::hybrid);
        setup.curves = polyline({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        setup.put_on_curves(bottom);
        setup.set_slip(left);
        setup.set_slip(right);
        setup.set_free(top);
        FieldFluxes fluxes(setup, {1, 1, 0, 0}, [](double, double) { return Point{0, 2}; });
        Options options = laplace();
        options.engine = engine;
        Solved const solved(fluxes.added_to(setup), options);
        std::vector<double> const move = {0, 1, 0, 1, 0, 0, 0, 0};
        std::vector<double> dx(solved.info().points), dy(dx);
        hm_points_out const to{dx.data(), dy.data(), 1};
        REQUIRE(hm_morph(solved.basis, move.data(), nullptr, &to, nullptr, nullptr) == HM_OK);
        double worst = 0;
        for (std::size_t k = 0; k < dx.size(); ++k) {
            worst = std::fmax(worst, std::fabs(dx[k]));
            worst = std::fmax(worst, std::fabs(dy[k] - (1 + 2 * setup.mesh.y[k])));
        }
        CHECK(worst < 1e-8);
        CHECK(solved.report.residual < 1e-9);
    }
}

TEST_CASE("functions of rigid bodies have no flux, and change no other function") {
    Case fixed;
    fixed.mesh = square(10, Cells::hybrid, 2, 2);
    fixed.curves = polyline({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    fixed.put_on_curves(bottom);
    for (std::int32_t const side : {right, top, left}) fixed.set_free(side);
    Case rigid = fixed;
    rigid.set_rigid(body, 0.5, 0.5);
    FieldFluxes fluxes(fixed, linear_amounts, linear_gradient);
    Solved const a(fluxes.added_to(fixed), laplace()), b(fluxes.added_to(rigid), laplace()),
        without(rigid, laplace());
    for (std::int32_t i = 0; i < 4; ++i)
        CHECK(largest_difference(a.values(i), b.values(i)) < 1e-13);
    for (std::int32_t i = 4; i < 6; ++i)
        CHECK(largest_difference(without.values(i), b.values(i)) < 1e-13);
    CHECK(largest_difference(without.values(1), b.values(1)) > 0.1);
    // Solved in shares of the functions, too, one of which has functions with fluxes and without.
    std::vector<double> const all = values_in_shares(b, 6);
    for (std::int32_t const width : {1, 2, 3, 5})
        CHECK(largest_difference(values_in_shares(b, width), all) < 1e-13);
}

TEST_CASE("a plan that is factored on a moved mesh has the same derivatives there") {
    Case setup = linear_case(Cells::hybrid);
    FieldFluxes fluxes(setup, linear_amounts, linear_gradient);
    Solved solved(fluxes.added_to(setup), laplace());
    Mesh moved = setup.mesh;
    for (double& x : moved.x) x *= 1.5;
    for (double& y : moved.y) y *= 3;
    hm_points const at = {moved.x.data(), moved.y.data(), 1};
    REQUIRE(hm_plan_factor(solved.plan, &at, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
    // The values at the wall stay: 1 + x / 1.5; the sides keep (1, 2) as gradient.
    CHECK(largest_error(moved, solved.combined(linear_amounts),
                        [](double x, double y) { return 1 + x / 1.5 + 2 * y; }) > 1e-3);
    FieldFluxes stretched(setup, linear_amounts, [](double, double) { return Point{1 / 1.5, 2}; });
    Solved other(stretched.added_to(setup), laplace());
    REQUIRE(hm_plan_factor(other.plan, &at, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(other.plan, other.basis, nullptr, nullptr) == HM_OK);
    CHECK(largest_error(moved, other.combined(linear_amounts),
                        [](double x, double y) { return 1 + x / 1.5 + 2 * y; }) < 1e-12);
    hm_error error{};
    CHECK(hm_plan_solve(other.plan, solved.basis, nullptr, &error) == HM_BAD_BASIS);
}

TEST_CASE("functions with fluxes have the same bits for any number of threads") {
    Case setup;
    setup.mesh = annulus(40, 96, 0.5, 1.5, Cells::hybrid);
    setup.curves = ring(3, 8, 0.52, 0.52);
    setup.put_on_curves(body);
    setup.set_free(far_field);
    FieldFluxes fluxes(setup, std::vector<double>(8, 1.0), round_gradient);
    Options options = laplace();
    Solved const serial(fluxes.added_to(setup), options);
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    options.executor = &executor;
    Solved const parallel(fluxes.added_to(setup), options);
    CHECK(same_bits(serial.all_values(), parallel.all_values()));
}

TEST_CASE("wrong fluxes are refused with the place, and so are operators without free boundaries") {
    Case setup = linear_case(Cells::quads);
    setup.index_base = 1;
    FieldFluxes fluxes(setup, linear_amounts, linear_gradient);
    struct Wrong {
        hm_status status;
        const char* text;
        std::function<void(hm_problem&, FieldFluxes&, Options&)> change;
    };
    double const nan = std::nan("");
    Wrong const all[] = {
        {HM_BAD_ARGUMENT, "problem.n_fluxes must be between 0 and 2^29, not -1",
         [](hm_problem& p, FieldFluxes&, Options&) { p.n_fluxes = -1; }},
        {HM_BAD_ARGUMENT, "problem.flux_points or fluxes is NULL, but problem.n_fluxes is 24",
         [](hm_problem& p, FieldFluxes&, Options&) { p.fluxes = nullptr; }},
        {HM_BAD_CONDITION,
         "a flux names the points 82 and 1, between which there is no boundary face",
         [](hm_problem&, FieldFluxes& f, Options&) { f.numbered[0] = 82, f.numbered[1] = 1; }},
        {HM_BAD_CONDITION,
         "a flux names the points 1 and 3, between which there is no boundary face",
         [](hm_problem&, FieldFluxes& f, Options&) { f.numbered[0] = 1, f.numbered[1] = 3; }},
        {HM_BAD_CONDITION, "a flux names the points 2 and 1, but the face between them is not free",
         [](hm_problem&, FieldFluxes& f, Options&) { f.numbered[2] = 2, f.numbered[3] = 1; }},
        {HM_BAD_CONDITION, "two fluxes name the face between the points 9 and 18",
         [](hm_problem&, FieldFluxes& f, Options&) {
             for (std::size_t k : {std::size_t(2), std::size_t(8)})
                 f.numbered[k] = 9, f.numbered[k + 1] = 18;
             f.numbered[44] = 81, f.numbered[45] = 80;
         }},
        {HM_BAD_CONDITION, nullptr,
         [&](hm_problem&, FieldFluxes& f, Options&) { f.values[6] = nan; }},
        {HM_UNSUPPORTED, nullptr,
         [](hm_problem&, FieldFluxes&, Options& o) { o.operator_kind = HM_CONFORMAL; }},
    };
    for (Wrong const& wrong : all) {
        FieldFluxes changed = fluxes;
        Options options = laplace();
        hm_problem problem = changed.added_to(setup);
        wrong.change(problem, changed, options);
        Attempt const attempt(problem, &options);
        INFO(attempt.error.text);
        CHECK(attempt.status == wrong.status);
        if (wrong.text != nullptr) CHECK(std::string(attempt.error.text) == wrong.text);
    }
}
