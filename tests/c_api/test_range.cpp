// The range of coordinates: what is outside is refused by name, and inside, at any scale and far
// from the origin, a call that succeeds keeps what the header promises, by measures taken here.
#include <harmorph_study.h>

#include "basis/options.hpp"
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>
#include <fixtures/perturb.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/wrong.hpp>

#include <random>

using namespace fixtures;

namespace {

// A block of 0.2 x 0.2 in a square of 10 x 10 cells.
Case block(Cells kind) {
    Case out;
    out.mesh = square(10, kind, 2, 2);
    out.curves = polyline({{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}});
    out.put_on_curves(body);
    return out;
}

long double exact_twice_area(Mesh const& mesh, std::int32_t a, std::int32_t b, std::int32_t c) {
    auto const x = [&](std::int32_t k) -> long double { return mesh.x[std::size_t(k)]; };
    auto const y = [&](std::int32_t k) -> long double { return mesh.y[std::size_t(k)]; };
    return (x(b) - x(a)) * (y(c) - y(a)) - (x(c) - x(a)) * (y(b) - y(a));
}

// Cells with a corner that has no positive area, or no area at all; all of square() run
// counter-clockwise.
int inverted_cells(Mesh const& mesh) {
    int out = 0;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        std::size_t const begin = std::size_t(mesh.cell_start[cell]);
        std::size_t const n = std::size_t(mesh.cell_start[cell + 1]) - begin;
        bool valid = true;
        for (std::size_t k = 0; k < n; ++k)
            valid = valid &&
                    exact_twice_area(mesh, mesh.cells[begin + k], mesh.cells[begin + (k + 1) % n],
                                     mesh.cells[begin + (k + n - 1) % n]) > 0;
        out += valid ? 0 : 1;
    }
    return out;
}

// Pairs of faces whose ends lie on both sides of each other.
int crossings(Mesh const& mesh) {
    auto const parts = [&](std::size_t face, std::size_t other) {
        long double const c =
            exact_twice_area(mesh, mesh.faces[face], mesh.faces[face + 1], mesh.faces[other]);
        long double const d =
            exact_twice_area(mesh, mesh.faces[face], mesh.faces[face + 1], mesh.faces[other + 1]);
        return (c > 0 && d < 0) || (c < 0 && d > 0);
    };
    int out = 0;
    for (std::size_t face = 0; face < mesh.faces.size(); face += 2)
        for (std::size_t other = 0; other < face; other += 2)
            out += parts(face, other) && parts(other, face) ? 1 : 0;
    return out;
}

Attempt analysed(Case& setup) {
    Attempt out;
    out.analyse(setup.problem());
    return out;
}

// Checks the admissible step, the assessment and a safe morph by relations that hold for any
// movement of any mesh.
void check_promises(Case& setup, Options const& options, std::vector<double> const& move,
                    bool& ended) {
    Solved const solved(setup, &options);
    Mesh moved = setup.mesh;
    std::size_t const n = moved.x.size();
    double size = 0, way = 0;
    for (std::size_t k = 0; k < n; ++k)
        size = std::max({size, std::fabs(moved.x[k]), std::fabs(moved.y[k])});
    for (double const component : move) way = std::max(way, std::fabs(component));

    Moved const by = displaced(solved.basis, move);
    hm_mesh const mesh = setup.mesh_view();
    auto assessed = sized<hm_quality_report>();
    hm_step_report const step = step_of(solved.basis, mesh, by, &assessed);
    for (std::size_t k = 0; k < n; ++k) {
        moved.x[k] += by.x[k];
        moved.y[k] += by.y[k];
    }
    hm_quality_report const measured = quality_of(solved.basis, mesh, moved, &mesh.points);
    CHECK(assessed.inverted == measured.inverted);
    CHECK(assessed.first_inverted == measured.first_inverted);
    CHECK(assessed.min_area == measured.min_area);
    CHECK(step.admissible > 0);
    if (step.admissible > 1.001) CHECK(inverted_cells(moved) == 0);
    if (inverted_cells(moved) > 0) CHECK(step.admissible < 1.001);

    Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
    std::vector<double> reached(move.size());
    auto safe = sized<hm_safe_options>();
    safe.max_resolves = 3;
    safe.reached = reached.data();
    hm_status const status =
        safe_move(solved.plan, solved.basis, move.data(), points_out(moved.x, moved.y), nullptr,
                  work.data(), work.size(), &safe, nullptr, nullptr);
    ended = status == HM_OK;
    if (status < 0) {
        CHECK(status == HM_CROSSING);
        return;
    }
    Wrong not_finite;
    for (std::size_t k = 0; k < n; ++k)
        not_finite.add(!std::isfinite(moved.x[k] + moved.y[k]), k, moved.x[k]);
    CHECK(not_finite == 0);
    CHECK(inverted_cells(moved) == 0);
    CHECK(quality_of(solved.basis, mesh, moved, &mesh.points).inverted == 0);
    CHECK(crossings(moved) == 0);
    CHECK(boundary_error(solved.basis, reached, setup.mesh, moved) <= 4e-16 * (size + 4 * way));
    if (status == HM_OK) CHECK(same_bits(reached, move));
}

}  // namespace

TEST_CASE("coordinates beyond 1e100 are refused, with the point and the value") {
    Case setup = block(Cells::quads);
    setup.mesh.y[17] = -1.5e100;
    Attempt const refused = analysed(setup);
    CHECK(refused.status == HM_BAD_MESH);
    CHECK(refused.error.item == 17);
    CHECK(refused.error.value == -1.5e100);
    CHECK(refused.error.text ==
          std::string(
              "point 17 has the coordinate -1.50000e100, which is larger than the limit of 1e100"));
}

TEST_CASE("control points and centres beyond 1e100 are refused") {
    Case setup = block(Cells::quads);
    setup.curves.control[3] = 2e100;
    CHECK(analysed(setup).status == HM_BAD_CURVE);

    setup = block(Cells::quads);
    setup.set_rigid(body, 0, -3e100);
    setup.conditions.erase(setup.conditions.begin());
    CHECK(analysed(setup).status == HM_BAD_CONDITION);
}

TEST_CASE("cells whose heights are lost in the digits of their coordinates are refused") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        double const height = kind == Cells::quads ? 0.1 : 0.1 * std::sqrt(0.5);
        for (double const offset : {0x1p40, 0x1p46, 0x1p48}) {
            Case setup = similar(block(kind), 10, Complex(offset, 0));
            bool const resolved = 10 * height >= 0x1p-46 * (offset + 10);
            Attempt const attempt = analysed(setup);
            INFO(offset << ": " << attempt.error.text);
            CHECK((attempt.status == HM_OK) == resolved);
            if (resolved) continue;
            CHECK(attempt.status == HM_BAD_MESH);
            CHECK(attempt.error.item >= 0);
        }
    }
}

TEST_CASE("heights below 1e-100 are refused") {
    Case setup = similar(block(Cells::quads), 1e-98, 0);
    CHECK(analysed(setup).status == HM_OK);
    setup = similar(block(Cells::quads), 1e-100, 0);
    Attempt const refused = analysed(setup);
    CHECK(refused.status == HM_BAD_MESH);
    CHECK(refused.error.value == doctest::Approx(1e-101));
}

TEST_CASE("a unit of length that is a power of two changes no bit of functions and steps") {
    for (std::int32_t operator_kind = 0;
         harmorph::has_row(harmorph::operator_traits, operator_kind); ++operator_kind)
        for (double const degrees : {20.0, 100.0}) {
            Case setup = block(Cells::hybrid);
            Options const options = options_of(operator_kind);
            Complex const turn = std::polar(1.0, degrees * pi / 180);
            std::vector<double> const move = similarity_move(setup.curves, turn, {0.5, 0.5}, 0.03);
            std::vector<double> expected_values, expected_x;
            double expected_step = 0;
            for (double const unit : {1.0, 0x1p-310, 0x1p-265, 0x1p265, 0x1p320}) {
                INFO(operator_kind << ", " << degrees << " degrees, unit " << unit);
                Case scaled = similar(setup, unit, 0);
                Solved const solved(scaled, &options);
                std::vector<double> const scaled_move = turned(move, unit);
                std::vector<double> x(scaled.mesh.x.size()), y = x;
                double const step =
                    step_of(solved.basis, scaled.mesh_view(), displaced(solved.basis, scaled_move))
                        .admissible;
                Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
                REQUIRE(safe_move(solved.plan, solved.basis, scaled_move.data(), points_out(x, y),
                                  nullptr, work.data(), work.size(), nullptr, nullptr,
                                  nullptr) >= HM_OK);
                for (double& coordinate : x) coordinate /= unit;
                std::vector<double> const values = solved.all_values();
                if (unit == 1) {
                    expected_values = values;
                    expected_x = x;
                    expected_step = step;
                }
                CHECK(same_bits(values, expected_values));
                CHECK(step == expected_step);
                CHECK(same_bits(x, expected_x));
            }
        }
}

TEST_CASE("random problems of scales 1e-80 to 1e80, near the origin and far from it") {
    std::mt19937 random(20);
    auto const between = [&](double low, double high) {
        return low + (high - low) * uniform(random);
    };
    int ended = 0, short_of_target = 0;
    for (int problem = 0; problem < 240; ++problem) {
        Cells const kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};
        Case setup = block(kinds[problem % 3]);
        perturb(setup.mesh, between(0, 0.3), static_cast<unsigned>(problem));
        Options options = options_of(problem % 4 == 3 ? HM_LAPLACE : problem % 4);
        if (problem % 4 == 3) options.scheme = HM_BOUNDED;
        double const scale = std::pow(10.0, between(-80, 80)),
                     far = std::pow(10.0, between(-2, 10));
        Complex const offset = scale * far * Complex(between(-1, 1), between(-1, 1));
        setup = similar(setup, std::polar(scale, between(0, 6.28)), problem % 2 == 0 ? 0 : offset);
        double const way = scale * std::pow(10.0, between(-3, 1));
        std::vector<double> move(setup.curves.control.size());
        Complex const shift = scale * between(0, 0.3) * Complex(between(-1, 1), between(-1, 1));
        for (std::size_t k = 0; k < move.size(); k += 2) {
            move[k] = shift.real() + 0.2 * way * between(-1, 1);
            move[k + 1] = shift.imag() + 0.2 * way * between(-1, 1);
        }
        INFO("problem " << problem << ", scale " << scale << ", offset " << offset.real() << ", "
                        << offset.imag());
        bool reached = false;
        check_promises(setup, options, move, reached);
        ++(reached ? ended : short_of_target);
    }
    CHECK(ended > 60);
    CHECK(short_of_target > 20);
}

// The functions of a body are the offsets of its points from the centre.
TEST_CASE("bodies of any size have finite functions") {
    for (double const scale : {1e-40, 1e-8, 1.0, 1e20, 1e40}) {
        Case setup = block(Cells::hybrid);
        setup.conditions.clear();
        setup.curves = {};
        setup = similar(setup, scale, 0);
        setup.set_rigid(body, 0.5 * scale, 0.5 * scale);
        Options const options = options_of(HM_LAPLACE);
        for (double const value : Solved(setup, &options).all_values())
            CHECK_MESSAGE(std::isfinite(value), "scale " << scale);
    }
}
