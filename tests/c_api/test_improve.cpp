// Improving the mesh of a plan: conditions hold, first layers stay, bad input is refused and
// nothing has moved.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/cascade.hpp>
#include <fixtures/check.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/traps.hpp>

#include <complex>

using namespace fixtures;

namespace {

// A solved case, a linear morph of it, and the improved mesh.
struct Morphed {
    Case setup;
    Solved solved;
    std::vector<double> x, y, better_x, better_y;
    hm_improve_report report{};
    hm_error error{};
    std::size_t bytes = 0;

    Morphed(Case const& shown, std::vector<double> const& move,
            Options const& options = options_of(HM_CONFORMAL))
        : setup(shown),
          solved(setup.problem(), &options),
          better_x(setup.mesh.x.size()),
          better_y(better_x) {
        Moved const to = morphed(solved.basis, setup.mesh, move);
        x = to.x;
        y = to.y;
        REQUIRE(fixtures::improve_size(solved.plan, &bytes, nullptr) == HM_OK);
        report.struct_size = sizeof report;
    }
    hm_status improve(hm_improve_options const* options = nullptr) {
        Guarded work(bytes);
        hm_status const status =
            hm_improve(solved.plan, points_in(x, y), points_out(better_x, better_y),
                       fixtures::Memory(work.data(), bytes), options, &report, &error);
        CHECK(work.guards_intact());
        CHECK(solved.guards_intact());
        return status;
    }
    hm_quality_report quality(std::vector<double> const& at_x, std::vector<double> const& at_y) {
        return quality_of(solved.basis, setup.mesh_view(), Moved{at_x, at_y},
                          points_in(setup.mesh.x, setup.mesh.y));
    }
    bool stays(std::int32_t point) const {
        auto const k = std::size_t(point);
        return x[k] == better_x[k] && y[k] == better_y[k];
    }
};

Case sliding_block() {
    Case out;
    out.mesh = square(20, Cells::hybrid, 4, 2);
    out.curves = polyline({{0.4, 0.45}, {0.6, 0.45}, {0.6, 0.55}, {0.4, 0.55}});
    out.put_on_curves(body);
    for (std::int32_t const side : {bottom, right, top, left}) out.set_slip(side);
    return out;
}

}  // namespace

TEST_CASE("hm_improve: better cells, the report is that of hm_assess, and walls keep their bits") {
    Case setup = airfoil_case();
    Complex const turn = std::polar(1.0, 0.6);
    Morphed out(setup, similarity_move(setup.curves, turn, 0.25));
    REQUIRE(out.improve() == HM_OK);
    hm_quality_report const before = out.quality(out.x, out.y),
                            after = out.quality(out.better_x, out.better_y);
    CHECK(out.report.min_quality_before == before.min_quality);
    CHECK(out.report.mean_quality_before == before.mean_quality);
    CHECK(out.report.min_quality_cell_before == before.min_quality_cell);
    CHECK(out.report.min_quality == after.min_quality);
    CHECK(out.report.mean_quality == after.mean_quality);
    CHECK(out.report.min_quality_cell == after.min_quality_cell);
    CHECK(after.inverted == 0);
    CHECK(after.self_crossing == 0);
    CHECK(after.mean_quality > before.mean_quality);
    CHECK(out.report.solutions > 0);
    std::vector<std::int32_t> const on_wall = points_on(setup.mesh, body);
    std::int32_t held = setup.mesh.n_points() - out.report.movable;
    CHECK(held >= std::int32_t(on_wall.size() + points_on(setup.mesh, far_field).size()));
    for (std::int32_t const marker : {std::int32_t(body), std::int32_t(far_field)})
        for (std::int32_t const point : points_on(setup.mesh, marker)) CHECK(out.stays(point));
}

TEST_CASE("hm_improve: in the arrays of the mesh itself, the report is that of separate arrays") {
    Case setup = airfoil_case();
    Morphed out(setup, similarity_move(setup.curves, std::polar(1.0, 0.6), 0.25));
    REQUIRE(out.improve() == HM_OK);
    hm_improve_report const apart = out.report;
    Guarded work(out.bytes);
    std::vector<double>&x = out.setup.mesh.x, &y = out.setup.mesh.y;
    REQUIRE(hm_improve(out.solved.plan, points_in(out.x, out.y), points_out(x, y),
                       fixtures::Memory(work.data(), out.bytes), nullptr, &out.report,
                       &out.error) == HM_OK);
    CHECK(std::memcmp(&out.report, &apart, sizeof apart) == 0);
    CHECK(same_bits(x, out.better_x));
    CHECK(same_bits(y, out.better_y));
}

TEST_CASE("hm_improve: arrays that overlap at other points are refused") {
    Case setup = airfoil_case();
    Morphed out(setup, similarity_move(setup.curves, std::polar(1.0, 0.6), 0.25));
    Guarded work(out.bytes);
    std::vector<double> const before = out.x;
    hm_points_out const shifted{out.x.data() + 1, out.better_y.data(), 1};
    CHECK(hm_improve(out.solved.plan, points_in(out.x, out.y), &shifted,
                     fixtures::Memory(work.data(), out.bytes), nullptr, &out.report,
                     &out.error) == HM_BAD_ARGUMENT);
    CHECK(says(out.error, "to and from have numbers in common, but at other points"));
    CHECK(out.x == before);
}

TEST_CASE("hm_improve: cells are as good by an engine that has no factor of the mesh") {
    Case setup = airfoil_case();
    std::vector<double> const move = similarity_move(setup.curves, std::polar(1.0, 0.6), 0.25);
    Options const conformal = options_of(HM_CONFORMAL);
    Solved const solved(setup.problem(), &conformal);
    Moved const start = morphed(solved.basis, setup.mesh, move);
    double mean[2] = {}, smallest[2] = {};
    for (int which = 0; which < 2; ++which) {
        Options options = options_of(HM_LAPLACE);
        options.engine = which == 0 ? HM_DIRECT : HM_MULTIGRID;
        Morphed out(setup, std::vector<double>(move.size()), options);
        out.x = start.x;
        out.y = start.y;
        REQUIRE(out.improve() == HM_OK);
        mean[which] = out.report.mean_quality;
        smallest[which] = out.report.min_quality;
    }
    CHECK(mean[1] == doctest::Approx(mean[0]).epsilon(1e-3));
    CHECK(smallest[1] == doctest::Approx(smallest[0]).epsilon(1e-2));
}

// A ring of 60 layers, whose faces on the wall are 5 times as long as the first layer is high.
constexpr std::size_t around = 24;
Case layered_ring(Cells kind) { return ring_case(60, int(around), 0.5, 2, kind); }

// The largest relative change of the first layer's heights, with the points above in the next ring.
double change_of_heights(Case const& setup, std::vector<double> const& x,
                         std::vector<double> const& y) {
    double worst = 0;
    auto const height = [&](std::vector<double> const& at_x, std::vector<double> const& at_y,
                            std::size_t k) {
        return std::hypot(at_x[k + around] - at_x[k], at_y[k + around] - at_y[k]);
    };
    for (std::size_t k = 0; k < around; ++k) {
        double const wanted = height(setup.mesh.x, setup.mesh.y, k);
        worst = std::fmax(worst, std::fabs(height(x, y, k) / wanted - 1));
    }
    return worst;
}

TEST_CASE("hm_improve: a layer gets back the heights that a conformal morph has changed") {
    Case with_hanging_nodes = layered_ring(Cells::quads);
    // Points between those above the wall: the mesh is finer behind the first layer.
    with_hanging_nodes.mesh =
        refined(with_hanging_nodes.mesh, [](Point p) { return std::hypot(p.x, p.y) > 0.54; });
    with_hanging_nodes.mesh.cell_layout = HM_CELLS_POLYGONS;
    for (Case const& setup :
         {layered_ring(Cells::quads), layered_ring(Cells::hybrid), with_hanging_nodes}) {
        Morphed out(setup, some_move(8, 0.12, 3));
        REQUIRE(out.improve() == HM_OK);
        CHECK(change_of_heights(setup, out.x, out.y) > 0.1);
        CHECK(change_of_heights(setup, out.better_x, out.better_y) < 1e-9);
        CHECK(out.report.min_quality >= out.report.min_quality_before);
    }
}

TEST_CASE("hm_improve: without a layer the points beside a wall are free") {
    Case const setup = ring_case(12, int(around), 0.5, 2);
    Morphed out(setup, some_move(8, 0.12, 3));
    REQUIRE(out.improve() == HM_OK);
    CHECK(change_of_heights(setup, out.better_x, out.better_y) > 0.05);
    CHECK(out.report.min_quality > 1.1 * out.report.min_quality_before);
}

TEST_CASE("hm_improve does not restore heights that would make a cell worse") {
    // The gap of three layers becomes narrower than the first layer was high.
    Case setup = ring_case(3, int(around), 0.5, 0.56);
    for (double const growth : {0.07, 0.08}) {
        std::vector<double> const move = similarity_move(setup.curves, 1 + growth, 0);
        Morphed out(setup, move, options_of(HM_LAPLACE));
        REQUIRE(out.improve() == HM_OK);
        CHECK(change_of_heights(setup, out.better_x, out.better_y) > 0.3);
        CHECK(out.report.min_quality >= out.report.min_quality_before);
    }
}

TEST_CASE("hm_improve: a mesh where it was does not move, with each kind of condition") {
    for (Case setup : {airfoil_case(), cascade(Cells::hybrid), sliding_block()}) {
        Morphed out(setup, std::vector<double>(setup.curves.control.size(), 0.0));
        REQUIRE(out.improve() == HM_OK);
        CHECK(out.better_x == setup.mesh.x);
        CHECK(out.better_y == setup.mesh.y);
    }
}

TEST_CASE("hm_improve: sliding points stay on their lines, corners stay") {
    Case setup = sliding_block();
    Morphed out(setup,
                similarity_move(setup.curves, std::polar(1.0, 0.7), {0.5, 0.5}, {0.1, 0.12}));
    REQUIRE(out.improve() == HM_OK);
    CHECK(out.report.min_quality > out.report.min_quality_before);
    int slid = 0;
    for (std::int32_t const side : {bottom, right, top, left}) {
        for (std::int32_t const point : points_on(setup.mesh, side)) {
            auto const k = std::size_t(point);
            bool const level = side == bottom || side == top;
            CHECK((level ? out.better_y : out.better_x)[k] ==
                  (level ? setup.mesh.y : setup.mesh.x)[k]);
            slid += out.stays(point) ? 0 : 1;
        }
    }
    CHECK(slid > 40);
}

TEST_CASE("hm_improve: periodic pairs move together, and the cut between them is not felt") {
    for (Cells const kind : {Cells::quads, Cells::hybrid}) {
        Case setup = cascade(kind, 0.2);
        std::vector<double> const move =
            similarity_move(setup.curves, std::polar(1.0, 0.5), {0.5, 0.5}, {0.08, 0.02});
        Morphed out(setup, move);
        REQUIRE(out.improve() == HM_OK);
        CHECK(out.report.min_quality > out.report.min_quality_before);
        int moved = 0;
        for (std::int32_t const point : points_on(setup.mesh, left))
            for (std::int32_t const image : points_on(setup.mesh, right)) {
                auto const a = std::size_t(point), b = std::size_t(image);
                if (std::fabs(setup.mesh.y[a] - setup.mesh.y[b]) > 1e-9) continue;
                CHECK(out.better_x[b] - out.better_x[a] == doctest::Approx(1).epsilon(1e-14));
                CHECK(out.better_y[b] == doctest::Approx(out.better_y[a]).epsilon(1e-14));
                moved += out.stays(point) ? 0 : 1;
            }
        CHECK(moved > 4);
        std::vector<std::int32_t> number;
        Case const elsewhere = cut_elsewhere(kind, 2, number);
        Case plain = cascade(kind);  // cut_elsewhere has its own amplitude
        Morphed first(plain, move), second(elsewhere, move);
        REQUIRE(first.improve() == HM_OK);
        REQUIRE(second.improve() == HM_OK);
        for (std::size_t k = 0; k < number.size(); ++k) {
            auto const there = std::size_t(number[k]);
            double const shift = elsewhere.mesh.x[there] - plain.mesh.x[k];
            CHECK(second.better_x[there] - shift ==
                  doctest::Approx(first.better_x[k]).epsilon(1e-6));
            CHECK(second.better_y[there] == doctest::Approx(first.better_y[k]).epsilon(1e-6));
        }
    }
}

TEST_CASE("hm_improve: a periodic mesh one cell wide") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = one_cell_apart(kind);
        Morphed out(setup,
                    similarity_move(setup.curves, std::polar(1.0, 0.3), {0.5, 0.5}, {0, 0.1}));
        REQUIRE(out.improve() == HM_OK);
        for (int row = 0; row < 4; ++row) {
            auto const k = std::size_t(2 * row);
            CHECK(out.better_x[k + 1] - out.better_x[k] == doctest::Approx(1).epsilon(1e-14));
        }
        CHECK(out.report.min_quality >= out.report.min_quality_before);
    }
}

TEST_CASE("hm_improve: in place, and with threads, the same bits") {
    Case setup = sliding_block();
    std::vector<double> const move =
        similarity_move(setup.curves, std::polar(1.0, 0.5), {0.5, 0.5});
    Morphed out(setup, move);
    REQUIRE(out.improve() == HM_OK);
    Backwards order;
    hm_executor const executor = order.executor(3);
    Options options = options_of(HM_CONFORMAL);
    options.executor = &executor;
    Morphed other(setup, move, options);
    Guarded work(other.bytes);
    REQUIRE(hm_improve(other.solved.plan, points_in(other.x, other.y), points_out(other.x, other.y),
                       fixtures::Memory(work.data(), other.bytes), nullptr, nullptr,
                       nullptr) == HM_OK);
    CHECK(other.x == out.better_x);
    CHECK(other.y == out.better_y);
}

TEST_CASE("hm_improve: what cannot be improved is refused by name, and nothing has moved") {
    Case setup = sliding_block();
    Morphed out(setup, similarity_move(setup.curves, std::polar(1.0, 0.5), {0.5, 0.5}));
    std::vector<double> const untouched = out.better_x;
    auto const refuses = [&](hm_status status, const char* text) {
        INFO(out.error.text);
        CHECK(out.improve() == status);
        CHECK(says(out.error, text));
        CHECK(out.better_x == untouched);
    };
    double const x = out.x[25];
    out.x[25] = NAN;
    refuses(HM_BAD_MESH, "point 25");
    out.x[25] = x + 0.2;
    refuses(HM_BAD_MESH, "is inverted");
    out.x[25] = x;
    auto options = sized<hm_improve_options>();
    options.max_solutions = 1;
    CHECK(out.improve(&options) == HM_OK);
    CHECK(out.report.solutions == 1);
}
