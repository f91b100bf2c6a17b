// Cuts whose two sides differ by rounding, and cuts that are open.
#include <fixtures/bodies.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/memory.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/parted.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

// A mesh with a cut along which every point exists twice.
struct CutCase {
    Case setup;
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // the trailing edge is the first one

    // Moves the second sides of the first n pairs away from the first ones.
    void open(double dx, double dy, std::size_t n) {
        for (std::size_t k = 0; k < std::min(n, pairs.size()); ++k) {
            auto const upper = std::size_t(pairs[k].second);
            setup.mesh.x[upper] += dx;
            setup.mesh.y[upper] += dy;
        }
    }
    void renumber(unsigned seed) {
        std::vector<std::int32_t> const to = renumber_points(setup.mesh, seed);
        for (auto& [lower, upper] : pairs) {
            lower = to[std::size_t(lower)];
            upper = to[std::size_t(upper)];
        }
        shuffle_cells(setup.mesh, seed + 1);
    }
};

CutCase c_case() {
    CutCase out;
    CMesh const c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 14));
    out.setup = airfoil_case(24, 12);
    out.setup.mesh = c.mesh;
    for (std::int32_t k = c.n_wake; k >= 0; --k) out.pairs.push_back({k, c.ni - 1 - k});
    return out;
}

CutCase o_case() {
    CutCase out;
    Outline const outline = naca4({}, 24);
    Rings const rings = o_rings(outline, stretched(5e-3, 8, 14));
    std::int32_t const n = rings.n_columns, row = n + 1;
    out.setup = airfoil_case(24, 12);
    Mesh& mesh = out.setup.mesh = Mesh{};
    for (std::int32_t ring = 0; ring <= rings.n_rings; ++ring) {
        for (std::int32_t i = 0; i <= n; ++i) mesh.add_point(rings.at(i, ring));
        out.pairs.push_back({row * ring, row * ring + n});
    }
    for (std::int32_t ring = 0; ring < rings.n_rings; ++ring) {
        for (std::int32_t k = row * ring; k < row * ring + n; ++k)
            mesh.add_cell({k, k + 1, k + 1 + row, k + row});
    }
    for (std::int32_t i = 0; i < n; ++i) {
        mesh.add_face(i + 1, i, body);
        mesh.add_face(row * rings.n_rings + i, row * rings.n_rings + i + 1, far_field);
    }
    return out;
}

// The largest difference of the functions of two meshes, point by point in the order of the cut and
// of all points if the numbers are the same.
double difference(Solved const& a, Solved const& b) {
    double worst = 0;
    for (std::int32_t i = 0; i < a.report.functions; ++i) {
        std::vector<double> const f = a.values(i), g = b.values(i);
        for (std::size_t k = 0; k < f.size(); ++k) worst = std::fmax(worst, std::fabs(f[k] - g[k]));
    }
    return worst;
}

// Both sides have the same displacements, bit by bit, and keep their gap.
void check_sides(CutCase const& open, std::vector<double> const& x, std::vector<double> const& y) {
    Mesh const& mesh = open.setup.mesh;
    for (auto const& [lower, upper] : open.pairs) {
        auto const a = std::size_t(lower), b = std::size_t(upper);
        CHECK(std::fabs((x[b] - x[a]) - (mesh.x[b] - mesh.x[a])) < 1e-14);
        CHECK(std::fabs((y[b] - y[a]) - (mesh.y[b] - mesh.y[a])) < 1e-14);
    }
}

}  // namespace

TEST_CASE("the sides of a cut that differ by rounding are one, and keep their gap") {
    for (auto const make : {c_case, o_case}) {
        CutCase exact = make();
        Solved const expected(exact.setup, options_of(HM_CONFORMAL));
        for (double const gap : {1e-16, -1e-14, 5e-12}) {
            for (std::size_t const n : {std::size_t{1}, std::size_t{4}, exact.pairs.size()}) {
                CAPTURE(gap);
                CAPTURE(n);
                CutCase open = make();
                open.open(0.4 * gap, gap, n);
                Solved const solved(open.setup, options_of(HM_CONFORMAL));
                CHECK(solved.report.unknowns == expected.report.unknowns);
                CHECK(solved.report.curve_points == expected.report.curve_points);
                CHECK(difference(solved, expected) < 1e-12 + 100 * std::fabs(gap));
                std::vector<double> const move = some_move(solved.report.functions, 0.01, 7);
                std::vector<double> dx = open.setup.mesh.x, dy = dx;
                REQUIRE(hm_morph(solved.basis, move.data(), nullptr, points_out(dx, dy), nullptr,
                                 nullptr) == HM_OK);
                for (auto const& [lower, upper] : open.pairs) {
                    CHECK(dx[std::size_t(lower)] == dx[std::size_t(upper)]);
                    CHECK(dy[std::size_t(lower)] == dy[std::size_t(upper)]);
                }
            }
        }
    }
}

TEST_CASE("a cut with a gap of rounding is found for any numbering and orientation") {
    for (auto const make : {c_case, o_case}) {
        CutCase exact = make();
        Solved const expected(exact.setup, options_of(HM_CONFORMAL));
        for (unsigned const seed : {1u, 2u, 3u}) {
            CutCase open = make();
            open.open(0, 1e-15, seed == 1 ? 1 : open.pairs.size());
            double const s = std::sin(seed), c = std::cos(seed);  // turned by 1, 2, 3 radians
            for (std::vector<double>* const numbers :
                 {&open.setup.mesh.x, &open.setup.curves.control})
                REQUIRE(!numbers->empty());
            Mesh& mesh = open.setup.mesh;
            for (std::size_t k = 0; k < mesh.x.size(); ++k) {
                double const x = mesh.x[k], y = mesh.y[k];
                mesh.x[k] = c * x - s * y;
                mesh.y[k] = s * x + c * y;
            }
            std::vector<double>& control = open.setup.curves.control;
            for (std::size_t k = 0; k < control.size(); k += 2) {
                double const x = control[k], y = control[k + 1];
                control[k] = c * x - s * y;
                control[k + 1] = s * x + c * y;
            }
            open.renumber(seed);
            Solved const solved(open.setup, options_of(HM_CONFORMAL));
            CHECK(solved.report.unknowns == expected.report.unknowns);
            CHECK(solved.report.curve_points == expected.report.curve_points);
        }
    }
}

TEST_CASE("safe morphs keep the gap of a cut, however far the body turns") {
    for (auto const make : {c_case, o_case}) {
        for (double const heights : {0.0, 1.0}) {
            CutCase open = make();
            open.open(0, 2e-12, open.pairs.size());
            Safe safe(open.setup);
            safe.safe_options.heights = heights;
            std::vector<double> const move =
                similarity_move(open.setup.curves, std::polar(1.3, 0.5), 0.5);
            REQUIRE(safe.run(move) >= 0);
            CHECK(safe.report.inverted == 0);
            CHECK((safe.report.heights > 0) == (heights > 0));
            check_sides(open, safe.x, safe.y);
        }
    }
}

TEST_CASE("cuts with a gap of rounding inside and between parts are those of the whole mesh") {
    for (auto const make : {c_case, o_case}) {
        CutCase open = make();
        open.open(0, 1e-15, 3);
        check_agreement(open.setup, options_of(HM_LAPLACE), stripes(open.setup.mesh, 3), true);
        check_agreement(open.setup, options_of(HM_CONFORMAL), at_random(open.setup.mesh, 3), false);
    }
}

TEST_CASE("a wider gap is refused with both points and its width, in parts as well") {
    for (auto const make : {c_case, o_case}) {
        for (double const gap : {1e-10, -1e-6}) {
            for (std::size_t const n : {std::size_t{1}, std::size_t{100}}) {
                CutCase open = make();
                open.open(0, gap, n);
                Attempt const attempt(open.setup.problem());
                CHECK(attempt.status == HM_BAD_MESH);
                INFO(attempt.error.text);
                CHECK(says(attempt.error, "of edges without a marker are"));
                CHECK(says(attempt.error, "give them equal coordinates"));
                CHECK(attempt.error.value == doctest::Approx(std::fabs(gap)).epsilon(1e-5));
                bool named = false;
                for (auto const& [lower, upper] : open.pairs) {
                    named = named || (std::min(lower, upper) ==
                                          std::min(attempt.error.item, attempt.error.other) &&
                                      std::max(lower, upper) ==
                                          std::max(attempt.error.item, attempt.error.other));
                }
                CHECK(named);
                Parted parted(cut(open.setup.mesh, stripes(open.setup.mesh, 3), false));
                REQUIRE(parted.match());
                Options const options = options_of(HM_LAPLACE);
                CHECK(!parted.equate(open.setup.problem(), options));
                CHECK(says(parted.error, "of edges without a marker are"));
                CHECK(parted.error.value == attempt.error.value);
            }
        }
    }
}
