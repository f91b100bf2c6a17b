// Callers that are older or younger than the library: structs that are shorter or longer than it
// knows them.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/mesh.hpp>

#include <cstddef>

using namespace fixtures;

namespace {

// Returns the size of a struct that ends before the field at this place. A struct's size is a
// multiple of its alignment: where pointers have 32 bits, that field may still be in it.
template <class Struct>
std::uint64_t size_before(std::size_t place) {
    return (place + alignof(Struct) - 1) / alignof(Struct) * alignof(Struct);
}

}  // namespace

TEST_CASE("a struct of an older caller is shorter: what is missing has its default") {
    Case setup = tiny_case();
    Solved const reference(setup);
    hm_mesh mesh = setup.mesh.view();
    mesh.struct_size = size_before<hm_mesh>(offsetof(hm_mesh, n_lists));  // no boundary lists yet
    if (mesh.struct_size <= offsetof(hm_mesh, n_lists)) mesh.n_lists = 1000;  // not looked at
    hm_problem problem = setup.problem(mesh);
    problem.struct_size = offsetof(hm_problem, n_known);
    problem.n_known = 1000;
    Options options = laplace();
    options.hm_options::struct_size = offsetof(hm_options, tolerance);
    options.tolerance = 5;
    Attempt const attempt(problem, &options);
    INFO(attempt.error.text);
    REQUIRE(attempt.status == HM_OK);
    CHECK(same_bits(all_numbers(attempt.basis), all_numbers(reference.basis)));
}

TEST_CASE("no bytes behind a mesh of an older caller are read as a second array of cells") {
    Case setup = tiny_case();
    Solved const reference(setup);
    hm_mesh mesh = setup.mesh.view();
    mesh.struct_size = size_before<hm_mesh>(offsetof(hm_mesh, n_quads));
    bool const has_no_quads = mesh.struct_size <= offsetof(hm_mesh, n_quads);
    if (has_no_quads) mesh.n_quads = 1000;
    Attempt const attempt(setup.problem(mesh));
    INFO(attempt.error.text);
    REQUIRE(attempt.status == HM_OK);
    CHECK(same_bits(all_numbers(attempt.basis), all_numbers(reference.basis)));
    if (!has_no_quads) return;
    Mixed const mixed(setup.mesh);
    hm_mesh short_of_quads = mixed.put_into(setup.mesh.view());
    short_of_quads.struct_size = offsetof(hm_mesh, n_quads);  // then all cells are triangles
    short_of_quads.n_cells = mixed.n_triangles();
    Attempt const triangles(setup.problem(short_of_quads));
    CHECK(triangles.status == HM_BAD_MESH);
    CHECK(says(triangles.error, "check whether cells are missing"));
}

TEST_CASE("a struct of a younger caller is longer: fields that are set and unknown are refused") {
    Case setup = tiny_case();
    Solved const reference(setup);
    struct LongMesh {
        hm_mesh mesh;
        double more[4] = {};
    } mesh;
    mesh.mesh = setup.mesh.view();
    mesh.mesh.struct_size = sizeof mesh;
    struct LongCondition {
        hm_condition condition;
        double more[3] = {};
    };
    setup.add_condition(top, HM_FIXED);
    LongCondition conditions[2];  // an array whose elements are as long as the first one says
    for (std::size_t k = 0; k < 2; ++k) {
        conditions[k].condition = setup.conditions[k];
        conditions[k].condition.struct_size = sizeof(LongCondition);
    }
    struct LongProblem {
        hm_problem problem;
        double more[2] = {};
    } problem;
    problem.problem = setup.problem(mesh.mesh);
    problem.problem.struct_size = sizeof problem;
    problem.problem.n_conditions = 2;
    problem.problem.conditions = &conditions[0].condition;
    Attempt const attempt(problem.problem);
    INFO(attempt.error.text);
    REQUIRE(attempt.status == HM_OK);
    CHECK(same_bits(all_numbers(attempt.basis), all_numbers(reference.basis)));

    auto const refused = [&](double& field, char const* what) {
        field = 1e-300;
        std::size_t bytes = 0;
        hm_error error{};
        hm_status const status = fixtures::analysis_size(&problem.problem, nullptr, &bytes, &error);
        field = 0;
        INFO(error.text);
        CHECK(status == HM_UNSUPPORTED);
        CHECK(std::string(error.text) ==
              what + std::string(" contains fields that are set but unknown to this version of the "
                                 "library; use the header of this version"));
        CHECK(bytes == 0);
    };
    refused(mesh.more[3], "mesh");
    refused(problem.more[0], "problem");
    refused(conditions[0].more[1], "condition 0");
    refused(conditions[1].more[2], "condition 1");

    struct {
        hm_basis_info info;
        unsigned char more[64];
    } info;
    std::memset(static_cast<void*>(&info), 0x5A, sizeof info);
    info.info.struct_size = sizeof info;
    REQUIRE(hm_basis_info_get(attempt.basis, &info.info, nullptr) == HM_OK);
    CHECK(info.info.points == 48);
    CHECK(info.info.struct_size == sizeof info);  // stays the caller's
    for (unsigned char const byte : info.more) CHECK(byte == 0x5A);
}

TEST_CASE("reports are filled as far as the caller's struct goes, for each of them") {
    Case setup = tiny_case();
    Solved const solved(setup);
    hm_mesh const mesh = setup.mesh.view();
    std::vector<double> const d(48, 0.0);
    auto const shortened = [&](auto whole, auto call) {
        using Report = decltype(whole);
        for (std::size_t size = sizeof(std::uint64_t); size <= sizeof(Report);
             size += alignof(Report)) {
            Report report;
            std::memset(static_cast<void*>(&report), 0x5A, sizeof report);
            report.struct_size = size;
            REQUIRE(call(&report) >= 0);
            CHECK(report.struct_size == size);
            const unsigned char* const bytes = reinterpret_cast<const unsigned char*>(&report);
            for (std::size_t k = size; k < sizeof report; ++k) CHECK(bytes[k] == 0x5A);
        }
    };
    shortened(hm_mesh_report{},
              [&](hm_mesh_report* r) { return hm_analysis_report(solved.analysis, r, nullptr); });
    shortened(hm_basis_info{},
              [&](hm_basis_info* r) { return hm_basis_info_get(solved.basis, r, nullptr); });
    shortened(hm_solve_report{}, [&](hm_solve_report* r) {
        return hm_plan_solve(solved.plan, solved.basis, r, nullptr);
    });
    shortened(hm_step_report{}, [&](hm_step_report* r) {
        return hm_assess(solved.basis, &mesh, nullptr, points_in(d, d), nullptr, nullptr, r,
                         nullptr, nullptr);
    });
    // The array is not looked for in a struct that ends before it.
    shortened(hm_quality_report{}, [&](hm_quality_report* r) {
        if (r->struct_size == sizeof *r) r->cell_quality = nullptr;
        return hm_assess(solved.basis, &mesh, &mesh.points, nullptr, nullptr, nullptr, nullptr, r,
                         nullptr);
    });
}

TEST_CASE("a struct_size that was never set or breaks the alignment of an array is refused") {
    Case setup = tiny_case();
    std::size_t bytes = 0;
    for (std::uint64_t const size :
         {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{75}, std::uint64_t{1} << 40}) {
        hm_problem problem = setup.problem();
        Options options{};
        hm_error error{};
        problem.struct_size = size;
        CHECK(fixtures::analysis_size(&problem, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
        CHECK(says(error, "problem.struct_size"));
        problem = setup.problem();
        options.hm_options::struct_size = size;
        CHECK(fixtures::analysis_size(&problem, &options, &bytes, &error) == HM_BAD_ARGUMENT);
        CHECK(says(error, "options.struct_size"));
        std::vector<hm_condition> conditions(2, setup.conditions[0]);
        for (hm_condition& condition : conditions) condition.struct_size = size;
        problem.conditions = conditions.data();
        problem.n_conditions = 2;
        CHECK(fixtures::analysis_size(&problem, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
        CHECK(says(error, "struct_size of condition 0"));
    }
    CHECK(bytes == 0);
}
