// Bounds in what a part of a mesh says of its cells, columns and unknowns: the last value inside is
// accepted, the first one outside is refused by name.
#include "private.h"
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/spoiled_arguments.hpp>
#include <fixtures/parted.hpp>

using namespace fixtures;

TEST_CASE("two cells of a part on one side of an edge") {
    Mesh mesh;
    for (Point const p : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 2}}) mesh.add_point(p);
    mesh.add_cell({0, 1, 2});
    mesh.add_cell({0, 1, 3});
    std::vector<std::int64_t> const numbers = {10, 11, 12, 13};
    hm_mesh const view = mesh.view();
    hm_private_part_mesh part = sized<hm_private_part_mesh>();
    part.mesh = &view;
    part.numbers = numbers.data();
    Guarded block = block_of(hm_private_part_size, &part);
    hm_private_part* made = nullptr;
    hm_error error{};
    CHECK(hm_private_part_init(&made, block.data(), block.size(), &part, &error) == HM_BAD_MESH);
    CHECK(std::string(error.text) ==
          "the cells on both sides of the edge between points 0 and 1 overlap");
}

TEST_CASE("columns and unknowns of a part's equations") {
    Case setup = tiny_case();
    Options const options = laplace();
    Parted parted(cut(setup.mesh, stripes(setup.mesh, 1), false));
    REQUIRE(parted.match());
    REQUIRE(parted.equate(setup.problem(), options));
    hm_private_equations* const equations = parted.parts[0].equations;
    hm_private_equations_info const& info = parted.parts[0].info();
    hm_private_part* const part = parted.parts[0].part;
    std::int32_t const n_edges = std::int32_t(parted.edges.size());
    std::size_t bytes = 0;
    Guarded block = block_of(hm_private_rows_size, equations);
    hm_basis* rows = nullptr;
    REQUIRE(hm_private_rows_init(&rows, block.data(), block.size(), equations, nullptr) == HM_OK);
    std::vector<double> numbers(1000, 0.0);
    std::int64_t n = 0;
    hm_error error{};
    auto const says = [&](hm_status status, std::string const& text) {
        CHECK(status < 0);
        CHECK(error.text == text);
    };
    for (std::int32_t const column : {-1, info.columns})
        says(hm_private_rows_get(equations, rows, column, numbers.data(), &error),
             "column " + std::to_string(column) + " does not exist; there are " +
                 std::to_string(info.columns) + " columns");
    CHECK(hm_private_rows_get(equations, rows, info.columns - 1, numbers.data(), &error) == HM_OK);
    for (double const largest : {-1.0, not_a_number, HUGE_VAL}) {
        CHECK(hm_private_rows_finish(equations, rows, largest, &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text).find("largest must be finite and at least 0") == 0);
    }
    struct {
        std::int32_t first, n;
    } const outside[] = {{-1, 1}, {0, -1}, {0, info.unknowns + 1}, {info.unknowns, 1}};
    for (auto const& range : outside) {
        says(hm_private_equations_entries(equations, range.first, range.n, nullptr, nullptr,
                                          nullptr, 0, &n, &error),
             "first is " + std::to_string(range.first) + " and n is " + std::to_string(range.n) +
                 ", but unknowns first to first + n - 1 must exist in this part");
    }
    CHECK(hm_private_equations_entries(equations, info.unknowns, 0, nullptr, nullptr, nullptr, 0,
                                       &n, &error) == HM_OK);
    CHECK(n == 0);

    Case other = tiny_case();
    other.conditions[0] = hm_condition{};
    other.conditions[0].struct_size = sizeof(hm_condition);
    other.conditions[0].marker = body;
    other.conditions[0].kind = HM_FIXED;
    other.curves = {};
    hm_problem problem = other.problem();
    problem.mesh = nullptr;
    says(hm_private_equations_size(part, n_edges, &problem, &options, &bytes, &error),
         "there is nothing to solve, because the problem has no curves, rigid bodies or given "
         "displacements");
    problem = setup.problem();
    problem.mesh = nullptr;
    for (std::int32_t const count : {-1, (1 << 29) + 1})
        says(hm_private_equations_size(part, count, &problem, &options, &bytes, &error),
             "n_edges must be between 0 and 2^29, not " + std::to_string(count));
    REQUIRE(hm_private_rows_finish(equations, rows, 1, &error) == HM_OK);
    says(hm_private_rows_get(equations, rows, 0, numbers.data(), &error),
         "the rows are finished; make new ones by hm_private_rows_init");
    Solved const whole(setup, &options);
    says(hm_private_rows_get(equations, whole.basis, 0, numbers.data(), &error),
         "the rows were made from other equations");
    Case two = two_body_case(Cells::hybrid, 4, 3);
    Solved const elsewhere(two, &options);
    says(hm_private_rows_get(equations, elsewhere.basis, 0, numbers.data(), &error),
         "the rows were made from other equations");

    hm_private_part_mesh nobody = sized<hm_private_part_mesh>();
    hm_mesh const mesh = parted.parts[0].mesh.view();
    nobody.mesh = &mesh;
    says(hm_private_part_size(&nobody, &bytes, &error), "mesh.numbers is NULL");
    nobody.numbers = parted.parts[0].numbers.data();
    nobody.mesh = nullptr;
    says(hm_private_part_size(&nobody, &bytes, &error), "mesh is NULL");
    n = -1;
    hm_private_edge edge{};
    says(hm_private_match_edges(&edge, &n, &error),
         "*n must be the number of edges, but it is negative");
    n = 0;
    CHECK(hm_private_match_edges(nullptr, &n, &error) == HM_OK);
}
