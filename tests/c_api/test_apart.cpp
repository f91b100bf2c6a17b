// Calls that write arrays refuse arrays that have a number in common with those that they read,
// and leave all numbers as they were.
#include <harmorph_fields.h>
#include <harmorph_quality.h>
#include "apart.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/memory.hpp>

#include <functional>
#include <memory>
#include <set>
#include <string>

using namespace fixtures;

namespace {

// The addresses of the numbers of an array.
std::set<const double*> places(const double* begin, int n, int stride) {
    std::set<const double*> out;
    for (int k = 0; k < n; ++k) out.insert(begin + k * stride);
    return out;
}

// All numbers of the calls lie in one array, so that any two arguments can be made to overlap.
struct Memory {
    std::vector<double> numbers, before;

    explicit Memory(Mesh const& mesh) : numbers(100 * mesh.x.size()) {
        for (std::size_t k = 0; k < mesh.x.size(); ++k)
            at_x()[k] = mesh.x[k], at_y(mesh)[k] = mesh.y[k];
        before = numbers;
    }
    double* at_x() { return numbers.data(); }
    double* at_y(Mesh const& mesh) { return numbers.data() + mesh.x.size(); }
    // A place behind all others.
    double* free(Mesh const& mesh, int blocks) {
        return numbers.data() + std::size_t(blocks) * mesh.x.size();
    }
    bool is_unchanged() const { return numbers == before; }
};

// A solved mesh whose coordinates are in the array.
struct Ready {
    Case setup = tiny_case();
    Mesh const& mesh = setup.mesh;
    std::int32_t n = mesh.n_points();
    Solved solved{setup};
    hm_mesh view = setup.mesh_view();
    Memory memory{mesh};
    hm_points at{memory.at_x(), memory.at_y(mesh), 1};
    hm_error error{};
    std::unique_ptr<Guarded> walls_block;

    // The walls of the first condition, once.
    hm_walls* walls() {
        std::int32_t const marker = setup.conditions[0].marker;
        std::size_t bytes = 0;
        REQUIRE(fixtures::walls_size(solved.analysis, 1, &marker, &bytes, &error) == HM_OK);
        walls_block = std::make_unique<Guarded>(bytes);
        hm_walls* made = nullptr;
        REQUIRE(hm_walls_init(&made, fixtures::Memory(walls_block->data(), bytes), solved.analysis,
                              1, &marker, nullptr, &error) == HM_OK);
        return made;
    }
};

void check_refused(Memory const& memory, hm_status status, hm_error const& error,
                   std::string const& first, std::string const& second) {
    INFO(error.text);
    CHECK(status == HM_BAD_ARGUMENT);
    std::string const named = first == second ? "two arrays of " + first : first + " and " + second;
    CHECK(std::string(error.text) == named + " have numbers in common; give separate arrays");
    CHECK(memory.is_unchanged());
}

}  // namespace

TEST_CASE("arrays of equal steps have a number in common or not, wherever they begin") {
    std::vector<double> numbers(200);
    double* const middle = numbers.data() + 100;
    for (int stride : {1, 2, 3, 5})
        for (int n : {1, 2, 7})
            for (int m : {1, 3, 9})
                for (int shift = -50; shift <= 50; ++shift) {
                    double* const other = middle + shift;
                    std::set<const double*> const a = places(middle, n, stride);
                    bool common = false;
                    for (const double* p : places(other, m, stride)) common |= a.count(p) > 0;
                    harmorph::Apart arrays;
                    harmorph::Fault fault;
                    arrays.add("a", middle, n, stride);
                    bool const refused = failed(arrays.check("b", other, m, fault, stride));
                    INFO("stride " << stride << ", " << n << " and " << m << " numbers, shift "
                                   << shift);
                    CHECK(refused == common);
                }
}

TEST_CASE("arrays of different steps that have a number in common are refused") {
    std::vector<double> numbers(400);
    double* const middle = numbers.data() + 200;
    int refusals = 0, apart = 0;
    for (int stride : {1, 2, 4})
        for (int step : {2, 3, 6})
            for (int shift = -60; shift <= 60; ++shift) {
                std::set<const double*> const a = places(middle, 10, stride);
                bool common = false;
                for (const double* p : places(middle + shift, 9, step)) common |= a.count(p) > 0;
                harmorph::Apart arrays;
                harmorph::Fault fault;
                arrays.add("a", middle, 10, stride);
                bool const refused = failed(arrays.check("b", middle + shift, 9, fault, step));
                if (common) CHECK(refused);
                ++(refused ? refusals : apart);
            }
    CHECK(refusals > 100);
    CHECK(apart > 100);
}

TEST_CASE("fields of moving meshes and adjoints") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    double* const x = memory.at_x();

    check_refused(memory, hm_adjoint(solved.basis, &at, x + n - 1, nullptr, &error), error,
                  "gradient", "dj");
    check_refused(
        memory,
        hm_swept_areas(&view, nullptr, &at, x + 2 * n - 1, nullptr, nullptr, nullptr, &error),
        error, "sides", "to");
    double* const sides = memory.free(mesh, 4);
    check_refused(memory,
                  hm_swept_areas(&view, nullptr, &at, sides, sides + 1, nullptr, nullptr, &error),
                  error, "duals", "sides");
    check_refused(memory, hm_swept_areas(&view, &at, &at, nullptr, nullptr, x + n, nullptr, &error),
                  error, "halves", "from");

    hm_walls* const walls = ready.walls();
    std::vector<std::int32_t> face(std::size_t(n), view.index_base);
    double* const free = memory.free(mesh, 10);
    check_refused(
        memory, hm_wall_distance(walls, n, &at, nullptr, x + 1, nullptr, nullptr, nullptr, &error),
        error, "distance", "points");
    check_refused(
        memory,
        hm_wall_distance(walls, n, &at, nullptr, free, nullptr, free + n - 1, nullptr, &error),
        error, "parameter", "distance");
    check_refused(memory,
                  hm_wall_distance_change(walls, n, &at, face.data(), &at, nullptr, x, &error),
                  error, "change", "points");
    hm_points_out const on_points{x, x + n, 1}, apart{free, free + n, 1};
    check_refused(memory,
                  hm_wall_distance_adjoint(walls, n, &at, face.data(), free + 3 * n, &on_points,
                                           nullptr, &error),
                  error, "point_dj", "points");
    check_refused(
        memory,
        hm_wall_distance_adjoint(walls, n, &at, face.data(), free + n, &apart, nullptr, &error),
        error, "point_dj", "dj");
    CHECK(hm_wall_distance_adjoint(walls, n, &at, face.data(), free + 4 * n, &apart, &apart,
                                   &error) == HM_OK);
    memory.before = memory.numbers;
    check_refused(memory, hm_first_layer(walls, nullptr, &at, x + n, nullptr, nullptr, &error),
                  error, "heights", "at");
    hm_points const moved{x + 2 * n, x + 3 * n, 1};
    check_refused(memory, hm_first_layer(walls, &at, &moved, nullptr, x, nullptr, &error), error,
                  "ratios", "before");
    check_refused(memory, hm_first_layer(walls, &at, &at, nullptr, free, free + 1, &error), error,
                  "angles", "ratios");
}

TEST_CASE("both derivatives of distances may be in the same arrays, but not with another step") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    hm_walls* const walls = ready.walls();
    std::vector<std::int32_t> const face(std::size_t(n), view.index_base);
    double* const free = memory.free(mesh, 10);
    double* const dj = free + 10 * n;
    hm_points_out const one{free, free + 4 * n, 1}, two{free, free + 4 * n, 2};
    check_refused(memory,
                  hm_wall_distance_adjoint(walls, n, &at, face.data(), dj, &one, &two, &error),
                  error, "mesh_dj", "point_dj");
    // The arrays for all mesh points reach into those of fewer points.
    double* const behind = free + n - 1;
    check_refused(memory,
                  hm_wall_distance_adjoint(walls, 2, &at, face.data(), behind, &one, &one, &error),
                  error, "point_dj", "dj");
}

TEST_CASE("the first layer is refused where the mesh before has none") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    hm_walls* const walls = ready.walls();
    std::vector<double> x = mesh.x, y(mesh.y.size(), 0.0), ratios(mesh.x.size(), 5.0);
    hm_points const flat{x.data(), y.data(), 1};
    CHECK(hm_first_layer(walls, &flat, &at, nullptr, ratios.data(), nullptr, &error) ==
          HM_BAD_MESH);
    CHECK(says(error, "has no height in `before`"));
    CHECK(error.item_kind == HM_ITEM_POINT);
    y = mesh.y;
    y.assign(y.size(), std::nan(""));
    CHECK(hm_first_layer(walls, nullptr, &flat, ratios.data(), nullptr, nullptr, &error) ==
          HM_BAD_MESH);
    CHECK(says(error, "not finite or beyond 1e100"));
    for (double const ratio : ratios) CHECK(ratio == 5);
}

TEST_CASE("the derivative of slipping points, and curves moved by a basis") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    double* const free = memory.free(mesh, 10);
    hm_points const velocity{free, free + n, 1};
    hm_points_out const on_from{memory.at_x(), memory.at_y(mesh), 1};
    check_refused(memory, hm_slip_derivative(solved.analysis, &at, &velocity, &on_from, &error),
                  error, "d_to", "from");
    check_refused(memory, hm_slip_adjoint(solved.analysis, &at, &velocity, &on_from, &error), error,
                  "dj_from", "from");
    hm_points_out const in_place{free, free + n, 1};
    CHECK(hm_slip_derivative(solved.analysis, &at, &velocity, &in_place, &error) == HM_OK);

    hm_basis_info info{};
    info.struct_size = sizeof info;
    REQUIRE(hm_basis_info_get(solved.basis, &info, &error) == HM_OK);
    std::vector<hm_curve> curve(static_cast<std::size_t>(info.curves));
    hm_curves curves{};
    curves.struct_size = sizeof curves;
    check_refused(
        memory,
        hm_basis_curves(solved.basis, free, free + 1, &curves, curve.data(), info.curves, &error),
        error, "control", "move");
}

TEST_CASE("x and y of moved points are apart, with coordinates before and without") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    std::vector<double> const move(2 * std::size_t(setup.curves.n_control()), 0.01);
    double* const free = memory.free(mesh, 10);
    hm_points const* const none = nullptr;
    for (hm_points const* const from : {static_cast<hm_points const*>(&at), none})
        for (int const shift : {0, 5}) {
            hm_points_out const to{free, free + shift, 1};
            check_refused(memory, hm_morph(solved.basis, move.data(), from, &to, nullptr, &error),
                          error, "to", "to");
        }
    std::size_t bytes = 0;
    REQUIRE(fixtures::safe_move_size(solved.plan, solved.basis, &bytes, &error) == HM_OK);
    Guarded block(bytes);
    fixtures::Memory working(block.data(), bytes);
    auto target = sized<hm_safe_target>();
    auto options = sized<hm_safe_options>();
    target.move = free;
    std::copy(move.begin(), move.end(), free);
    memory.before = memory.numbers;
    hm_points_out const to{free + 2 * n, free + 4 * n, 1}, one{free + 2 * n, free + 2 * n, 1};
    auto const safe = [&](hm_points_out const& where, double* reached) {
        options.reached = reached;
        return hm_move_safe(solved.plan, solved.basis, &target, &where, working, &options, nullptr,
                            &error);
    };
    check_refused(memory, safe(one, nullptr), error, "to", "to");
    check_refused(memory, safe(to, free + 2 * n), error, "options.reached", "to");
    check_refused(memory, safe(to, free + 1), error, "options.reached", "target.move");
}

TEST_CASE("interpolated fields") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    std::size_t bytes = 0;
    REQUIRE(fixtures::interpolation_size(solved.analysis, n, &bytes, &error) == HM_OK);
    Guarded block(bytes);
    hm_interpolation* interpolation = nullptr;
    check_refused(memory,
                  hm_interpolation_init(&interpolation, fixtures::Memory(block.data(), bytes),
                                        solved.analysis, nullptr, n, &at, memory.at_x() + 1,
                                        nullptr, nullptr, &error),
                  error, "distance", "to");
    REQUIRE(hm_interpolation_init(&interpolation, fixtures::Memory(block.data(), bytes),
                                  solved.analysis, nullptr, n, &at, nullptr, nullptr, nullptr,
                                  &error) == HM_OK);
    double* const fields = memory.free(mesh, 10);
    for (std::int32_t const n_fields : {1, 3}) {
        std::int32_t const last = n_fields * n - 1;
        check_refused(
            memory, hm_interpolate(interpolation, n_fields, fields, fields + last, nullptr, &error),
            error, "to", "from");
        check_refused(
            memory, hm_interpolate_adjoint(interpolation, n_fields, fields + last, fields, &error),
            error, "from_dj", "to_dj");
        CHECK(hm_interpolate(interpolation, n_fields, fields, fields + last + 1, nullptr, &error) ==
              HM_OK);
    }
}

TEST_CASE("gradients of bounds of the quality") {
    Ready ready;
    auto& [setup, mesh, n, solved, view, memory, at, error, walls_block] = ready;
    std::size_t bytes = 0;
    REQUIRE(fixtures::quality_size(solved.basis, &view, &bytes, &error) == HM_OK);
    Guarded block(bytes);
    hm_quality* quality = nullptr;
    REQUIRE(hm_quality_init(&quality, fixtures::Memory(block.data(), bytes), solved.basis, &view,
                            nullptr, &error) == HM_OK);
    hm_bound bounds[2];
    hm_bound_value values[2];
    for (int k = 0; k < 2; ++k) HM_INIT(bounds[k]), HM_INIT(values[k]);
    bounds[0].kind = HM_BOUND_QUALITY;
    bounds[1].kind = HM_BOUND_AREA;
    double* const free = memory.free(mesh, 10);
    hm_points_out gradients[2] = {{free, free + 1, 2}, {memory.at_x() + 1, free + 5 * n, 1}};
    check_refused(memory,
                  hm_quality_bounds(quality, &at, 2, bounds, values, gradients, nullptr, &error),
                  error, "gradients", "at");
    gradients[1] = {free + 2 * n - 2, free + 5 * n, 2};
    check_refused(memory,
                  hm_quality_bounds(quality, &at, 2, bounds, values, gradients, nullptr, &error),
                  error, "gradients", "gradients");
    gradients[1] = {free + 2 * n, free + 2 * n + 1, 2};
    CHECK(hm_quality_bounds(quality, &at, 2, bounds, values, gradients, nullptr, &error) == HM_OK);
}
