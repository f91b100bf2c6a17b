// Smooth bounds of heights and angles of the first layer: those that reports of safe morphs
// measure, with derivatives that agree with differences.
#include <fixtures/bounded.hpp>
#include <fixtures/core.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

std::vector<std::int32_t> const layer_kinds = {HM_BOUND_HEIGHT, HM_BOUND_STRETCH, HM_BOUND_ANGLE};

// An airfoil with layers, a ring of triangles, and a wall with two ends.
std::vector<Case> layered_cases() {
    Case half;
    half.mesh = half_annulus(6, 20, 0.5, 2);
    half.set_given(body);
    return {airfoil_case(20), ring_case(6, 24, 0.5, 2, Cells::triangles), half};
}

}  // namespace

TEST_CASE("heights and angles are those of the first layer") {
    for (Case const& given : {airfoil_case(20), ring_case(6, 24, 0.5, 2, Cells::triangles)}) {
        Bounded const mesh(given);
        Walls walls(given.mesh);
        for (double const amount : {0.0, 0.05, 0.2}) {
            Field const at = moved(mesh.start(), amount, 3, 0);
            for (std::size_t k = 0; k < at.size(); ++k) {
                walls.deformed.x[k] = at[k].real();
                walls.deformed.y[k] = at[k].imag();
            }
            harmorph::FirstLayerChange const change = walls.change();
            double const n = change.points;
            for (double const sharpness : {1.0, 100.0, 1e5}) {
                std::vector<BoundResult> const found = bounds_of(mesh, at, layer_kinds, sharpness);
                CHECK(found[0].value.extreme == doctest::Approx(change.min_ratio).epsilon(1e-12));
                CHECK(found[1].value.extreme == doctest::Approx(change.max_ratio).epsilon(1e-12));
                CHECK(found[2].value.extreme ==
                      doctest::Approx(std::cos(change.largest_angle * pi / 180)).epsilon(1e-12));
                CHECK(found[0].value.bound <= found[0].value.extreme);
                CHECK(found[1].value.bound >= found[1].value.extreme);
                CHECK(found[2].value.bound <= found[2].value.extreme);
                for (BoundResult const& one : found) {
                    CHECK(one.value.count == change.points);
                    CHECK(std::fabs(one.value.bound - one.value.extreme) <=
                          std::log(n) / sharpness + 1e-13);
                    CHECK(one.value.item_kind == HM_ITEM_POINT);
                }
            }
            if (amount == 0) continue;
            std::vector<BoundResult> const found = bounds_of(mesh, at, layer_kinds);
            CHECK(found[0].value.item == change.min_ratio_point);
            CHECK(found[1].value.item == change.max_ratio_point);
            CHECK(found[2].value.item == change.largest_angle_point);
        }
    }
}

TEST_CASE("derivatives by the points agree with differences, also at the start") {
    for (Case const& given : layered_cases()) {
        Bounded const mesh(given);
        for (double const amount : {0.0, 0.1}) {
            Field const at = moved(mesh.start(), amount, 3, 0);
            Field direction = some_field(at.size(), 5, 1e-4);
            for (std::size_t k = 0; k < at.size(); ++k)
                direction[k] +=
                    0.3 * std::complex<double>(std::sin(2 * at[k].imag()), at[k].real());
            for (std::int32_t const kind : layer_kinds) {
                double const slope = dot(bound_of(mesh, at, kind, 50).gradient, direction);
                double const least = check_slope(slope, 0.02, [&](double step) {
                    return bound_of(mesh, along(at, direction, step), kind, 50).value.bound;
                });
                INFO("kind " << kind << ", amount " << amount << ", slope " << slope);
                CHECK(least < 1e-5);
            }
        }
    }
}

TEST_CASE("a rigid motion changes no height and no angle; a scale changes heights alone") {
    Bounded const mesh(airfoil_case(20));
    for (double const scale : {1.0, 1.7}) {
        std::complex<double> const turn = std::polar(scale, 0.9);
        Field at = mesh.start();
        for (std::complex<double>& z : at) z = turn * z + std::complex<double>(3, -2);
        std::vector<BoundResult> const found = bounds_of(mesh, at, layer_kinds);
        CHECK(found[0].value.extreme == doctest::Approx(scale).epsilon(1e-9));
        CHECK(found[1].value.extreme == doctest::Approx(scale).epsilon(1e-9));
        CHECK(found[2].value.extreme == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("calls that cannot succeed are refused, and leave their outputs as they were") {
    Bounded const mesh(ring_case(6, 24, 0.5, 2));
    Field const start = mesh.start();
    hm_points const at = pairs_in(start);
    hm_error error{};
    std::vector<double> gradient(2 * start.size(), -7);
    hm_points_out const to{gradient.data(), gradient.data() + 1, 2};
    auto const status = [&](hm_bound bound, hm_points const& points) {
        auto value = sized<hm_bound_value>();
        hm_status const found =
            hm_quality_bounds(mesh.quality, &points, 1, &bound, &value, &to, nullptr, &error);
        CHECK(value.count == 0);
        CHECK(gradient == std::vector<double>(gradient.size(), -7));
        return found;
    };
    CHECK(status({sizeof(hm_bound), 6, 0, 0}, at) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "the kind of bound 0 is 6, but it must be one of HM_BOUND_QUALITY to HM_BOUND_ANGLE");
    CHECK(status({sizeof(hm_bound), 0, 7, 0}, at) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "reserved of bound 0 must be 0, not 7");
    CHECK(status({sizeof(hm_bound), 0, 0, 0.5}, at) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "the sharpness of bound 0 is 5.00000e-1, but it must be 0 or between 1 and 1e6");
    CHECK(status({sizeof(hm_bound), 0, 0, std::nan("")}, at) == HM_BAD_ARGUMENT);
    CHECK(status({0, 0, 0, 0}, at) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "struct_size of bound 0 is not the size of an hm_bound; begin with HM_INIT");
    Field bad = start;
    bad[30] = {std::nan(""), 0};
    CHECK(status({sizeof(hm_bound), 0, 0, 0}, pairs_in(bad)) == HM_BAD_MESH);
    CHECK(error.item == 30);
    hm_bound const bound{sizeof(hm_bound), 0, 0, 0};
    hm_bound_value value{};
    CHECK(hm_quality_bounds(mesh.quality, &at, 1, &bound, &value, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    value.struct_size = sizeof value;
    CHECK(hm_quality_bounds(mesh.quality, &at, 0, &bound, &value, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);

    // A start with an inverted cell, and a block one byte too short.
    Field inverted = start;
    inverted[60] += 1.0;
    hm_points const wrong = pairs_in(inverted);
    Guarded block = block_of(fixtures::quality_size, mesh.attempt.basis, &mesh.mesh);
    std::size_t const bytes = block.size();
    hm_quality* quality = nullptr;
    CHECK(hm_quality_init(&quality, fixtures::Memory(block.data(), bytes), mesh.attempt.basis,
                          &mesh.mesh, &wrong, &error) == HM_BAD_MESH);
    CHECK(says(error, "is inverted at the start"));
    CHECK(hm_quality_init(&quality, fixtures::Memory(block.data(), bytes - 1), mesh.attempt.basis,
                          &mesh.mesh, &at, &error) == HM_BLOCK_TOO_SMALL);
    CHECK(quality == nullptr);

    // A mesh of which the wall is one layer of triangles without an edge that leaves the wall.
    Case none;
    for (Point const p : {Point{0, 0}, {1, 0}, {0.4, 1}}) none.mesh.add_point(p);
    none.mesh.add_cell({0, 1, 2});
    none.mesh.add_face(0, 1, body);
    none.mesh.add_face(1, 2, body);
    none.mesh.add_face(2, 0, body);
    none.set_given(body);
    Attempt attempt;
    if (attempt.analyse(none.problem()) && attempt.prepare()) {
        Bounded const walls_only(none);
        hm_bound const height{sizeof(hm_bound), HM_BOUND_HEIGHT, 0, 0};
        CHECK(hm_quality_bounds(walls_only.quality, nullptr, 1, &height, &value, nullptr, nullptr,
                                &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text) ==
              "bound 0 is one of the first layer, but no wall point has an edge of a first layer");
    }
}
