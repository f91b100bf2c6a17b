// The bounded scheme: no conductance has the wrong sign, functions stay between 0 and 1, linear
// fields are reproduced.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>
#include <fixtures/guarded.hpp>

#include "boundary/distance.hpp"
#include "operators/assembly.hpp"

using namespace fixtures;
using harmorph::DelaunayEdge;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

Options bounded() {
    Options out{};
    out.operator_kind = HM_LAPLACE;
    out.scheme = HM_BOUNDED;
    return out;
}

// The operator of a case, and the dense system of its unknowns.
struct Bounded : Attempt {
    std::unique_ptr<AssembledMatrix> sparse;
    std::vector<DelaunayEdge> edges;

    explicit Bounded(Case& setup) {
        Options const options = bounded();
        bool const done = analyse(setup.problem(), &options);
        INFO(error.text);
        REQUIRE(done);
        sparse = std::make_unique<AssembledMatrix>(core());
        core().triangulation().for_each_edge(
            [&](DelaunayEdge const& edge) { edges.push_back(edge); });
    }
    harmorph::Analysis const& core() const { return inside(analysis); }
    void assemble(std::vector<double> const& conductivity = {}) const {
        harmorph::Points const points = core().problem().mesh.points;
        REQUIRE(assemble_bounded(span(edges), points, span(conductivity), sparse->matrix) ==
                harmorph::none);
    }
    // Known values on the wall, 0 at fixed points; result by rows.
    template <class Value>
    std::vector<double> solve(Value value) const {
        std::vector<double> right = sparse->couplings_times(value);
        for (double& one : right) one = -one;
        DenseMatrix a = sparse->unknowns();
        REQUIRE(a.factor());
        return a.solve(right);
    }
};

// A function of the angle that is on the first circle of an annulus, as an amount of each control
// point: one of these is at each point there, and the curve is of degree 1.
void put_on_polygon(Case& setup, int n_points, bool closed) {
    Spline polygon;
    polygon.degree = 1;
    for (int k = 0; k < n_points; ++k) {
        polygon.control.push_back(setup.mesh.x[static_cast<std::size_t>(k)]);
        polygon.control.push_back(setup.mesh.y[static_cast<std::size_t>(k)]);
        polygon.indices.push_back(k);
    }
    if (closed) polygon.indices.push_back(0);
    polygon.knots = clamped_knots(1, static_cast<int>(polygon.indices.size()));
    setup.curves = polygon;
    setup.put_on_curves(body);
    int const spans = static_cast<int>(polygon.indices.size()) - 1;
    for (int k = 0; k < n_points; ++k) setup.give(k, 1.0 * k / spans);
}

// Cells stretched across the diagonals of triangles: what the compact scheme has trouble with.
Case stretched_bodies(Cells kind, double thin) {
    Case setup = two_body_case(kind, 8, 6);
    perturb(setup.mesh, 0.4, 4);
    for (double& y : setup.mesh.y) y *= thin;
    for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
        setup.curves.control[k] *= thin;
    return setup;
}

}  // namespace

TEST_CASE("no entry beside the diagonal and no coupling is positive for any weights") {
    auto const positive_entries = [](harmorph::Matrix const& m) {
        int out = 0;
        for (double const entry : m.value) out += entry > 0;
        for (double const entry : m.coupling_value) out += entry > 0;
        return out;
    };
    for (Cells const kind : kinds)
        for (bool const on_circles : {false, true}) {
            Case setup = on_circles ? square_on_curve(12, kind, 0, 0) : stretched_bodies(kind, 0.1);
            // Cells at an angle are on circles up to rounding only, which then says on which side
            // of 0 a conductance is.
            auto const turn = [](double& x, double& y) {
                double const old = x;
                x = 0.8 * old - 0.6 * y;
                y = 0.6 * old + 0.8 * y;
            };
            for (std::size_t k = 0; k < setup.mesh.x.size(); ++k)
                turn(setup.mesh.x[k], setup.mesh.y[k]);
            std::vector<double>& control = setup.curves.control;
            for (std::size_t k = 0; k < control.size(); k += 2) turn(control[k], control[k + 1]);
            Analysed const seen(setup);
            AssembledMatrix compact(*seen.operator->());
            compact.assemble();
            if (!on_circles) CHECK(positive_entries(compact.matrix) > 0);  // the test can fail
            Bounded const scheme(setup);
            std::mt19937 random(3);
            for (bool const weighted : {false, true}) {
                std::vector<double> conductivity;
                for (std::size_t k = 0; weighted && k < scheme.edges.size(); ++k) {
                    conductivity.push_back(std::exp(20 * uniform(random)));
                }
                scheme.assemble(conductivity);
                CHECK(positive_entries(scheme.sparse->matrix) == 0);
                for (Index const slot :
                     {0, 20}) {  // functions stay within their boundary values therefore
                    auto const one = [&](Index s) { return s == slot ? 1.0 : 0.0; };
                    for (double const f : scheme.solve(one)) {
                        CHECK(f >= 0);
                        CHECK(f <= 1);
                    }
                }
            }
        }
}

TEST_CASE("every edge is weighted by itself") {
    Case setup = square_on_curve(7, Cells::hybrid, 0.4, 5);
    Bounded const scheme(setup);
    std::vector<double> conductivity;
    for (std::size_t k = 0; k < scheme.edges.size(); ++k)
        conductivity.push_back(1.0 + static_cast<double>(k));
    scheme.assemble();
    DenseMatrix const plain = scheme.sparse->unknowns();
    scheme.assemble(conductivity);
    DenseMatrix const weighted = scheme.sparse->unknowns();
    std::vector<double> rows = scheme.sparse->couplings_times([](Index) { return 1.0; });
    for (std::size_t k = 0; k < scheme.edges.size(); ++k) {
        harmorph::Span<const Index> const place = scheme.sparse->matrix.rows_of_dofs();
        Index const i = place[scheme.edges[k].begin], j = place[scheme.edges[k].end];
        if (i < 0 || j < 0) continue;
        std::size_t const row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
        CHECK(weighted.at(row, column) ==
              doctest::Approx(conductivity[k] * plain.at(row, column)).epsilon(1e-15));
    }
    for (std::size_t i = 0; i < weighted.n; ++i) {  // constants are solutions still
        for (std::size_t j = 0; j < weighted.n; ++j) rows[i] += weighted.at(i, j);
        CHECK(std::fabs(rows[i]) < 1e-11);
    }
}

TEST_CASE("linear fields are reproduced, at an aspect ratio of 10^4 as well") {
    for (Cells const kind : kinds)
        for (double const thin : {1.0, 1e-4}) {
            Case setup = square_on_curve(9, kind, 0.4, 3);
            for (double& y : setup.mesh.y) y *= thin;
            for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
                setup.curves.control[k] *= thin;
            Bounded const scheme(setup);
            scheme.assemble();
            auto const defect = [&](auto field) {
                auto const at = [&](Index point) { return field(setup.mesh.point(point)); };
                std::vector<double> const found =
                    scheme.solve([&](Index slot) { return at(scheme.core().wall().point[slot]); });
                double worst = 0;
                for (std::size_t row = 0; row < found.size(); ++row) {
                    Index const point = scheme.sparse->point_at(static_cast<Index>(row));
                    worst = std::fmax(worst, std::fabs(found[row] - at(point)));
                }
                return worst;
            };
            CHECK(defect([](Point) { return 1.0; }) < 1e-13);
            CHECK(defect([](Point p) { return p.x; }) < 1e-12);
            CHECK(defect([&](Point p) { return p.x + p.y / thin; }) < 1e-12);
            CHECK(defect([](Point p) { return p.x * p.x; }) > 1e-3);  // the test can fail
        }
}

TEST_CASE("the first edge with a triangle of no area is returned") {
    Case setup = ring_case(6, 20, 0.5, 2);
    Bounded const equations(setup);
    harmorph::Mesh const& mesh = equations.core().problem().mesh;
    std::vector<double> x, y;
    for (Index k = 0; k < mesh.n_points; ++k) {
        x.push_back(mesh.points[k].x);
        y.push_back(mesh.points[k].y);
    }
    auto const area = [&](Index a, Index b, Index c) {
        std::size_t const i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
                          k = static_cast<std::size_t>(c);
        return (x[j] - x[i]) * (y[k] - y[i]) - (y[j] - y[i]) * (x[k] - x[i]);
    };
    for (std::size_t const chosen :
         {std::size_t{0}, equations.edges.size() / 2, equations.edges.size() - 1}) {
        DelaunayEdge const edge = equations.edges[chosen];
        std::size_t const apex = static_cast<std::size_t>(edge.left),
                          end = static_cast<std::size_t>(edge.end);
        double const right_x = x[apex], right_y = y[apex];
        x[apex] = x[end];
        y[apex] = y[end];
        Index first = 0;
        for (DelaunayEdge const& one : equations.edges) {
            if (!(area(one.begin, one.end, one.left) > 0)) break;
            if (one.right != harmorph::none && !(area(one.end, one.begin, one.right) > 0)) break;
            ++first;
        }
        CHECK(first <= static_cast<Index>(chosen));
        CHECK(assemble_bounded(span(equations.edges), {x.data(), y.data(), 1}, {},
                               equations.sparse->matrix) == first);
        x[apex] = right_x;
        y[apex] = right_y;
    }
}

TEST_CASE("on Delaunay triangles it is the compact scheme") {
    Case setup = two_body_case(Cells::triangles, 8, 6);
    improve(setup.mesh, 30);
    Bounded const scheme(setup);
    REQUIRE(scheme.core().triangulation().flips == 0);
    scheme.assemble();
    DenseMatrix const bounded_entries = scheme.sparse->unknowns();
    scheme.sparse->assemble();
    DenseMatrix const compact_entries = scheme.sparse->unknowns();
    CHECK(largest_difference(bounded_entries.entries, compact_entries.entries) < 1e-13);
}

TEST_CASE("0 <= F <= 1 to the last bit where the compact scheme is below 0") {
    Options const options = bounded();
    Case setup = stretched_bodies(Cells::hybrid, 0.2);
    Solved const compact(setup), scheme(setup, &options);
    CHECK(compact.report.min_value < -0.1);
    CHECK(scheme.report.min_value >= 0);
    CHECK(scheme.report.max_value <= 1);
    CHECK(scheme.report.residual < 1e-12);
    CHECK(scheme.report.partition_defect < 1e-14);
    CHECK(scheme.info().scheme == HM_BOUNDED);
    CHECK(largest_difference(scheme.values(3), compact.values(3)) > 1e-6);
    for (Cells const kind : kinds) {
        Case bodies = two_body_case(kind);
        perturb(bodies.mesh, 0.4, 5);
        Solved const solved(bodies, &options);
        CHECK(solved.report.min_value >= 0);
        CHECK(solved.report.max_value <= 1);
    }
}

TEST_CASE("the sum of all functions is the wall's harmonic measure, solved for by itself") {
    Options const options = bounded();
    for (Cells const kind : kinds) {
        Case setup = two_body_case(kind, 6, 5);
        perturb(setup.mesh, 0.4, 7);
        Bounded const scheme(setup);
        scheme.assemble();
        std::vector<double> const measure = scheme.solve([](Index) { return 1.0; });
        std::vector<double> const sum = Solved(setup, &options).sum();
        double worst = 0;
        for (std::size_t row = 0; row < measure.size(); ++row) {
            std::size_t const point =
                static_cast<std::size_t>(scheme.sparse->point_at(static_cast<Index>(row)));
            worst = std::fmax(worst, std::fabs(measure[row] - sum[point]));
        }
        CHECK(worst < 1e-13);
    }
}

TEST_CASE("second order on an annulus, whole and half with a free symmetry line, also perturbed") {
    double const pi = std::acos(-1.0), r0 = 0.5, r1 = 2;
    Options const options = bounded();
    for (bool const is_half : {false, true})
        for (double const amplitude : {0.0, 0.3})
            for (Cells const kind : kinds) {
                std::vector<double> error;
                for (int const refine : {1, 2, 4}) {
                    int const n_r = 8 * refine, n_t = (is_half ? 20 : 40) * refine;
                    Case setup;
                    setup.mesh = is_half ? half_annulus(n_r, n_t, r0, r1, kind)
                                         : annulus(n_r, n_t, r0, r1, kind, true);
                    perturb(setup.mesh, amplitude, 8);
                    put_on_polygon(setup, is_half ? n_t + 1 : n_t, !is_half);
                    if (is_half) setup.set_free(symmetry_line);
                    std::vector<double> cosines;
                    double const step = (is_half ? 2 : 4) * pi / n_t;  // of twice the angle
                    for (int k = 0; k < (is_half ? n_t + 1 : n_t); ++k)
                        cosines.push_back(std::cos(k * step));
                    std::vector<double> const found = Solved(setup, &options).combined(cosines);
                    error.push_back(0);
                    for (std::size_t k = 0; k < found.size(); ++k) {
                        Point const p = setup.mesh.point(static_cast<std::int32_t>(k));
                        double const squared = p.x * p.x + p.y * p.y, q0 = r0 * r0, q1 = r1 * r1;
                        double const cosine =
                            (p.x * p.x - p.y * p.y) / squared;  // of twice the angle
                        double const exact =
                            cosine * (q1 * q1 / squared - squared) / (q1 * q1 / q0 - q0);
                        double const share = 1 / std::sqrt(1.0 * setup.mesh.n_points());
                        error.back() = std::hypot(error.back(), share * (found[k] - exact));
                    }
                }
                INFO("errors " << error[0] << " " << error[1] << " " << error[2] << ", amplitude "
                               << amplitude);
                CHECK(error[2] < 1e-3);
                CHECK(std::log2(error[0] / error[2]) / 2 > 1.75);
            }
}

TEST_CASE("numbering, order and sense of cells do not matter") {
    Options const options = bounded();
    Case setup = stretched_bodies(Cells::hybrid, 0.2);
    Solved const first(setup, &options);
    Case other = setup;
    reverse_some(other.mesh, 2);
    shuffle_cells(other.mesh, 3);
    std::vector<std::int32_t> const new_of = renumber_points(other.mesh, 4);
    Solved const second(other, &options);
    for (std::int32_t const function : {0, 5}) {
        std::vector<double> const a = first.values(function), b = second.values(function);
        double worst = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            worst = std::fmax(worst, std::fabs(a[k] - b[static_cast<std::size_t>(new_of[k])]));
        CHECK(worst < 1e-12);
    }
}

TEST_CASE("the plan factors on the analysed coordinates alone") {
    Options const options = bounded();
    Case setup = two_body_case(Cells::hybrid, 6, 4);
    Attempt tried(setup.problem(), &options);
    REQUIRE(tried.status == HM_OK);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    CHECK(hm_plan_factor(tried.plan, points_in(x, y), nullptr) == HM_OK);
    x[40] += 1e-9;
    CHECK(hm_plan_factor(tried.plan, points_in(x, y), &tried.error) == HM_UNSUPPORTED);
    CHECK(hm_plan_solve(tried.plan, tried.basis, nullptr, nullptr) ==
          HM_BAD_ARGUMENT);  // no factor
    CHECK(hm_plan_factor(tried.plan, nullptr, nullptr) == HM_OK);
    CHECK(hm_plan_solve(tried.plan, tried.basis, nullptr, nullptr) == HM_OK);
}

TEST_CASE("weights of edges are powers of their midpoints' distances from what moves") {
    Case setup = stretched_bodies(Cells::hybrid, 0.5);
    Bounded const scheme(setup);
    harmorph::Analysis const& a = scheme.core();
    harmorph::FaceDistance faces;
    auto const block = laid_out_part(faces, static_cast<std::size_t>(a.count_wall_faces()));
    faces.choose(a.boundary(), [&](Index face) { return a.is_wall_face(face); });
    faces.build(a.problem().mesh.points);
    std::vector<double> k(scheme.edges.size());
    weigh_edges(faces, span(scheme.edges), a.problem().mesh.points, 6, span(k), {});
    for (std::size_t edge = 0; edge < k.size(); ++edge) {
        Point const begin = setup.mesh.point(scheme.edges[edge].begin),
                    end = setup.mesh.point(scheme.edges[edge].end);
        double const d =
            faces.distance({0.5 * (begin.x + end.x), 0.5 * (begin.y + end.y)}) / faces.unit;
        if (d < 1e-12) continue;  // a face
        CHECK(k[edge] == doctest::Approx(std::pow(d, -1.5)).epsilon(1e-12));
    }
}

TEST_CASE("weighted functions stay between 0 and 1; slip and the conformal operator are refused") {
    for (Cells const kind : kinds) {
        Case setup = stretched_bodies(kind, 0.2);
        Options options = bounded(), compact{};
        options.operator_kind = compact.operator_kind = HM_WEIGHTED;
        for (double const exponent : {0.25, 1.5, 4.0}) {
            options.exponent = compact.exponent = exponent;
            Solved const solved(setup, &options);
            CHECK(solved.report.min_value >= 0);
            CHECK(solved.report.max_value <= 1);
            CHECK(solved.report.residual < 1e-11);
            CHECK(Solved(setup, &compact).report.min_value < -1e-3);
        }
        options.operator_kind = HM_CONFORMAL;
        CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
        options.operator_kind = HM_WEIGHTED;
        setup.set_slip(far_field);
        CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
    }
}
