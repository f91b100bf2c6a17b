// Nodal gradients as a choice of the plan: exact solutions, the two engines against each other,
// the compact scheme nearby.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/matrices.hpp>
#include <fixtures/schemes.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

Options nodal(std::int32_t engine, std::int32_t scheme = HM_NODAL_GRADIENT) {
    Options out = laplace();
    out.scheme = scheme;
    out.engine = engine;
    return out;
}
Options plain() { return nodal(HM_FAS, HM_NODAL_GRADIENT_PLAIN); }

Case viscous_case(Cells kind) {
    Case setup = airfoil_case(40, 12, Cells::quads);
    setup.mesh = o_mesh(naca4({}, 40), stretched(1e-3, 8, 24), kind);
    return setup;
}

// An amount of each control point is a function of the angle on the first circle, as the curve is
// of degree 1 there.
Case polygon_case(Mesh const& mesh, int n_points, bool closed) {
    Case out;
    out.mesh = mesh;
    Spline polygon;
    polygon.degree = 1;
    for (int k = 0; k < n_points; ++k) {
        polygon.control.push_back(mesh.x[static_cast<std::size_t>(k)]);
        polygon.control.push_back(mesh.y[static_cast<std::size_t>(k)]);
        polygon.indices.push_back(k);
    }
    if (closed) polygon.indices.push_back(0);
    polygon.knots = clamped_knots(1, static_cast<int>(polygon.indices.size()));
    out.curves = polygon;
    out.put_on_curves(body);
    for (int k = 0; k < n_points; ++k)
        out.give(k, 1.0 * k / (static_cast<int>(polygon.indices.size()) - 1));
    return out;
}

// Root mean square of the error of cos(2 angle) on the inner circle; half of it with a free
// symmetry line.
double annulus_error(Cells kind, int refine, bool is_half, double amplitude,
                     Options const& options) {
    double const r0 = 0.5, r1 = 2, q0 = r0 * r0, q1 = r1 * r1;
    int const n_r = 6 * refine, n_t = (is_half ? 16 : 32) * refine,
              n_points = is_half ? n_t + 1 : n_t;
    Mesh mesh =
        is_half ? half_annulus(n_r, n_t, r0, r1, kind) : annulus(n_r, n_t, r0, r1, kind, true);
    perturb(mesh, amplitude, 8);
    Case setup = polygon_case(mesh, n_points, !is_half);
    if (is_half) setup.set_free(symmetry_line);
    std::vector<double> cosines;
    for (int k = 0; k < n_points; ++k)
        cosines.push_back(std::cos((is_half ? 2 : 4) * pi * k / n_t));
    std::vector<double> const found = Solved(setup, &options).combined(cosines);
    double sum = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        Point const p = mesh.point(static_cast<std::int32_t>(k));
        double const squared = p.x * p.x + p.y * p.y, cosine = (p.x * p.x - p.y * p.y) / squared;
        sum += std::pow(found[k] - cosine * (q1 * q1 / squared - squared) / (q1 * q1 / q0 - q0), 2);
    }
    return std::sqrt(sum / static_cast<double>(found.size()));
}

double difference(Solved const& a, Solved const& b) {
    return largest_difference(a.all_values(), b.all_values());
}

// Largest balance that the scheme by itself finds in the volumes of the points that are solved for.
double balance_of(Case const& setup, Solved const& solved, bool corrected, std::int32_t free = -1) {
    Scheme const scheme(setup.mesh, corrected);
    std::vector<char> known(setup.mesh.x.size(), 0);
    for (std::size_t k = 0; k < setup.mesh.faces.size(); ++k)
        if (setup.mesh.face_markers[k / 2] != free)
            known[static_cast<std::size_t>(setup.mesh.faces[k])] = 1;
    double out = 0;
    for (std::int32_t i = 0; i < solved.report.functions; ++i) {
        std::vector<double> const balance = scheme.balance(solved.values(i));
        for (std::size_t k = 0; k < known.size(); ++k)
            if (!known[k]) out = std::fmax(out, std::fabs(balance[k]));
    }
    return out;
}

}  // namespace

TEST_CASE("nothing is left in any volume: the plan's functions solve the scheme's own equations") {
    for (Cells const kind : kinds)
        for (bool const free : {false, true}) {
            Case setup = two_body_case(kind, 8, 6);
            perturb(setup.mesh, 0.3, 3);
            reverse_some(setup.mesh, 4);
            if (free) setup.set_free(far_field);
            Options const direct = nodal(HM_DIRECT), fas = nodal(HM_FAS);
            std::int32_t const marker = free ? far_field : -1;
            CHECK(balance_of(setup, Solved(setup, &direct), true, marker) < 1e-12);
            CHECK(balance_of(setup, Solved(setup, &fas), true, marker) < 1e-9);
            CHECK(balance_of(setup, Solved(setup), true, marker) > 1e-4);  // the test can fail
        }
}

TEST_CASE("nodal equations have second order on a whole and on a half annulus") {
    Options const options = nodal(HM_DIRECT);
    for (bool const is_half : {false, true})
        for (double const amplitude : {0.0, 0.3})
            for (Cells const kind : kinds) {
                double const coarse = annulus_error(kind, 1, is_half, amplitude, options);
                double const fine = annulus_error(kind, 4, is_half, amplitude, options);
                INFO("errors " << coarse << " " << fine << ", half " << is_half << ", amplitude "
                               << amplitude);
                CHECK(std::log2(coarse / fine) / 2 > (amplitude == 0 ? 1.8 : 1.6));
                CHECK(fine < 1e-3);
            }
}

TEST_CASE("nodal equations without correction have second order on smooth triangles") {
    Options options = plain(), corrected = nodal(HM_DIRECT);
    options.tolerance = 1e-6;  // far below the errors of the scheme
    for (bool const is_half : {false, true}) {
        double const coarse = annulus_error(Cells::triangles, 1, is_half, 0, options);
        double const fine = annulus_error(Cells::triangles, 2, is_half, 0, options);
        INFO("errors " << coarse << " " << fine << ", half " << is_half);
        CHECK(std::log2(coarse / fine) > 1.5);
        CHECK(fine > 2 * annulus_error(Cells::triangles, 2, is_half, 0, corrected));
    }
}

TEST_CASE("the difference from the compact scheme falls as the mesh is refined") {
    Options const options = nodal(HM_DIRECT);
    for (Cells const kind : {Cells::triangles, Cells::hybrid}) {
        double last = 0;
        for (int const refine : {1, 2, 4}) {
            Case setup = ring_case(6 * refine, 24 * refine, 0.5, 2, kind);
            double const now = difference(Solved(setup), Solved(setup, &options));
            if (last > 0) CHECK(last / now > 2.5);
            last = now;
        }
        CHECK(last > 1e-7);
    }
}

TEST_CASE("both engines find the same functions of nodal gradients") {
    for (int which = 0; which < 5; ++which) {
        Case setup = which < 3 ? two_body_case(kinds[which], 10, 7)
                               : viscous_case(which == 3 ? Cells::quads : Cells::triangles);
        if (which == 1) setup.set_free(far_field);
        Options const direct = nodal(HM_DIRECT), fas = nodal(HM_FAS);
        Solved const one(setup, &direct), other(setup, &fas);
        INFO("case " << which << ": " << one.report.iterations << " steps, "
                     << other.report.iterations << " cycles");
        CHECK(difference(one, other) < 1e-8);
        CHECK(one.report.residual < 1e-12);
        CHECK(one.report.refinements >= 1);
        CHECK(one.report.iterations >= 1);
        CHECK(other.report.refinements == 0);
        CHECK(other.report.levels >= 2);
    }
}

TEST_CASE("nodal equations hold for a rigid body and a periodic pair") {
    Case setup = two_body_case(Cells::hybrid, 8, 6);
    setup.conditions.erase(setup.conditions.begin());
    setup.set_rigid(body, 0, 0);
    Options options = nodal(HM_DIRECT), fas = nodal(HM_FAS);
    Solved const one(setup, &options), other(setup, &fas);
    CHECK(one.info().numbers_per_value == 2);
    CHECK(difference(one, other) < 1e-8);

    Case periodic;
    periodic.mesh = square(8, Cells::quads, 2, 2);
    periodic.curves = polyline({{0.375, 0.375}, {0.625, 0.375}, {0.625, 0.625}, {0.375, 0.625}});
    periodic.put_on_curves(body);
    periodic.set_periodic(left, right);
    CHECK(difference(Solved(periodic, &options), Solved(periodic)) <
          1e-12);  // rectangles: the same scheme
    perturb(periodic.mesh, 0.3, 3);
    Solved const found(periodic, &options);
    CHECK(difference(found, Solved(periodic, &fas)) < 1e-8);
    CHECK(difference(found, Solved(periodic)) < 0.05);
    CHECK(difference(found, Solved(periodic)) > 1e-4);
    for (int row = 1; row < 8; ++row) {
        auto const value_at = [&](double x) {
            std::vector<double> const values = found.values(0);
            for (std::size_t k = 0; k < values.size(); ++k)
                if (periodic.mesh.x[k] == x && periodic.mesh.y[k] == row / 8.0) return values[k];
            return -1.0;
        };
        CHECK(value_at(0) == value_at(1));
    }
}

TEST_CASE("functions of nodal gradients sum up to 1 and carry linear fields exactly") {
    for (Cells const kind : kinds) {
        Case setup = square_on_curve(9, kind, 0.3, 6);
        for (Options const& options : {nodal(HM_DIRECT), nodal(HM_FAS), plain()}) {
            Solved const solved(setup, &options);
            double const within = options.engine == HM_DIRECT ? 1e-12 : 1e-8;
            std::vector<double> x, y;
            for (std::int32_t k = 0; k < setup.curves.n_control(); ++k) {
                x.push_back(setup.curves.control[2 * static_cast<std::size_t>(k)]);
                y.push_back(setup.curves.control[2 * static_cast<std::size_t>(k) + 1]);
            }
            CHECK(largest_difference(solved.sum(), std::vector<double>(setup.mesh.x.size(), 1.0)) <
                  within);
            CHECK(largest_difference(solved.combined(x), setup.mesh.x) < within);
            CHECK(largest_difference(solved.combined(y), setup.mesh.y) < within);
        }
    }
}

TEST_CASE("moved coordinates: the plan factors again, as a new one would") {
    Case setup = two_body_case(Cells::hybrid, 8, 6);
    Case moved = setup;
    perturb(moved.mesh, 0.3, 2);
    for (std::int32_t const engine : {int(HM_DIRECT), int(HM_FAS)}) {
        Options const options = nodal(engine);
        Solved const fresh(moved, &options);
        Attempt again(setup.problem(), &options);
        REQUIRE(hm_plan_factor(again.plan, points_in(moved.mesh.x, moved.mesh.y), nullptr) ==
                HM_OK);
        REQUIRE(hm_plan_solve(again.plan, again.basis, nullptr, nullptr) == HM_OK);
        std::vector<double> values(setup.mesh.x.size());
        REQUIRE(hm_basis_values(again.basis, 3, 0, values.data(), nullptr) == HM_OK);
        CHECK(largest_difference(values, fresh.values(3)) < 1e-8);
        CHECK(largest_difference(values, Solved(setup, &options).values(3)) > 1e-6);
        CHECK(again.guards_intact());
    }
}

TEST_CASE("threads and blocks change no bit; a basis remembers its scheme") {
    Case setup = two_body_case(Cells::hybrid, 12, 8);
    for (Options options : {nodal(HM_DIRECT), nodal(HM_FAS), plain()}) {
        bool const iterates = options.engine != HM_DIRECT;
        options.block_width = iterates ? 4 : 0;
        options.max_iterations = iterates ? 40 : 0;
        auto const values_of = [&](Attempt const& attempt) {
            REQUIRE(attempt.status >= 0);
            std::vector<double> out(setup.mesh.x.size());
            REQUIRE(hm_basis_values(attempt.basis, 15, 0, out.data(), nullptr) == HM_OK);
            return out;
        };
        Attempt const serial(setup.problem(), &options);
        Backwards backwards;
        hm_executor const executor = backwards.executor(3);
        options.executor = &executor;
        CHECK(same_bits(values_of(Attempt(setup.problem(), &options)), values_of(serial)));
        CHECK(backwards.tasks > 0);
        auto info = sized<hm_basis_info>();
        REQUIRE(hm_basis_info_get(serial.basis, &info, nullptr) == HM_OK);
        CHECK(info.scheme == options.scheme);

        const hm_basis* attached = nullptr;
        std::vector<double> copy(info.bytes / sizeof(double) + 1);  // aligned
        std::memcpy(copy.data(), serial.basis, info.bytes);
        REQUIRE(hm_basis_attach(&attached, copy.data(), info.bytes, &setup.mesh_view(), nullptr) ==
                HM_OK);
        info.scheme = -1;
        REQUIRE(hm_basis_info_get(attached, &info, nullptr) == HM_OK);
        CHECK(info.scheme == options.scheme);

        Attempt compact(setup.problem());
        CHECK(hm_plan_solve(compact.plan, serial.basis, nullptr, nullptr) == HM_BAD_BASIS);
    }
}

TEST_CASE("where short waves grow, the paper's text ends with a status before its limit") {
    Case setup = two_body_case(Cells::hybrid, 8, 6);
    perturb(setup.mesh, 0.3, 3);
    for (double& y : setup.mesh.y) y *= 0.1;
    for (std::size_t k = 1; k < setup.curves.control.size(); k += 2) setup.curves.control[k] *= 0.1;
    Options const options = plain();
    Attempt const attempt(setup.problem(), &options);
    CHECK(attempt.status == HM_NOT_CONVERGED);
    CHECK(attempt.report.iterations < 2000);
}

TEST_CASE("what does not go together is refused") {
    Case setup = two_body_case(Cells::quads, 6, 4);
    auto const refused = [&](Options const& options) {
        Attempt const attempt(setup.problem(), &options);
        return attempt.status == HM_UNSUPPORTED && attempt.reached == "analysis size";
    };
    CHECK(refused(nodal(HM_MULTIGRID)));
    CHECK(refused(nodal(HM_DIRECT, HM_NODAL_GRADIENT_PLAIN)));
    CHECK(refused(nodal(HM_MULTIGRID, HM_NODAL_GRADIENT_PLAIN)));
    for (std::int32_t const other : {HM_CONFORMAL, HM_WEIGHTED}) {
        Options options = nodal(HM_FAS);
        options.operator_kind = other;
        CHECK(refused(options));
    }
    setup.set_slip(far_field);
    CHECK(refused(nodal(HM_DIRECT)));
    CHECK(refused(nodal(HM_FAS)));
    Options const options = nodal(HM_DIRECT);
    Attempt const attempt(setup.problem(), &options);
    CHECK(std::string(attempt.error.text).find("nodal gradients") != std::string::npos);
}
