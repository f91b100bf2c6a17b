// Analysis, plan and basis in two blocks.
#include <doctest/doctest.h>
#include <harmorph_design.h>

#include <fixtures/bodies.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

// The calls hm_setup_* for a problem, in blocks of exactly the sizes that the calls name.
struct Setup {
    hm_setup handles{};
    hm_solve_report report{};
    hm_error error{};
    hm_status status = HM_OK;
    std::unique_ptr<Guarded> first, second;

    explicit Setup(hm_problem const& problem, const hm_options* options = nullptr,
                   std::size_t missing = 0) {
        HM_INIT(handles);
        HM_INIT(report);
        std::size_t bytes = 0;
        status = fixtures::setup_size(&problem, options, &bytes, &error);
        if (status < 0) return;
        first = std::make_unique<Guarded>(bytes);
        status = hm_setup_init(&handles, fixtures::Memory(first->data(), bytes), &problem, options,
                               &error);
        if (status < 0) return;
        status = fixtures::setup_solve_size(&handles, &bytes, &error);
        if (status < 0) return;
        bytes -= missing;
        second = std::make_unique<Guarded>(bytes);
        status = hm_setup_solve(&handles, fixtures::Memory(second->data(), bytes), &report, &error);
    }
};

}  // namespace

TEST_CASE("two blocks of the exact sizes contain what the single calls make, byte by byte") {
    for (std::int32_t const kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Case setup = two_body_case(Cells::quads, 24, 6);
        hm_mesh const mesh = setup.mesh.view();
        hm_problem const problem = setup.problem(mesh);
        Options options;
        options.operator_kind = kind;
        Setup const made(problem, &options);
        INFO(made.error.text);
        REQUIRE(made.status == HM_OK);
        CHECK((made.first->guards_intact() && made.second->guards_intact()));
        Solved const apart(problem, &options);
        hm_basis_info const info = info_of(apart.basis);
        REQUIRE(info_of(made.handles.basis).bytes == info.bytes);
        CHECK(std::memcmp(made.handles.basis, apart.basis, info.bytes) == 0);
        CHECK(made.report.functions == info.functions);
        // The basis begins the block, and is enough for morphs elsewhere.
        std::vector<double> kept(info.bytes / 8 + 1);
        std::memcpy(kept.data(), made.handles.basis, info.bytes);
        const hm_basis* copy = nullptr;
        CHECK(hm_basis_attach(&copy, kept.data(), info.bytes, &mesh, nullptr) == HM_OK);
        CHECK(static_cast<const void*>(made.handles.basis) <
              static_cast<const void*>(made.handles.plan));
    }
}

TEST_CASE("a setup with given displacements alone has a factor and a basis without functions") {
    Case setup = two_body_case(Cells::quads, 24, 6);
    hm_mesh const mesh = setup.mesh.view();
    hm_problem problem = setup.problem(mesh);
    std::vector<hm_condition> conditions = setup.conditions;
    for (hm_condition& condition : conditions) {
        std::int32_t const marker = condition.marker;
        HM_INIT(condition);
        condition.marker = marker;
        condition.kind = HM_GIVEN;
    }
    problem.conditions = conditions.data();
    problem.curves = nullptr;
    Setup const made(problem);
    INFO(made.error.text);
    REQUIRE(made.status == HM_OK);
    CHECK(made.report.functions == 0);
    std::int32_t n = 0;
    std::vector<std::int32_t> points(mesh.n_points);
    REQUIRE(hm_given_points(made.handles.plan, points.data(), mesh.n_points, &n, nullptr) == HM_OK);
    std::vector<double> wall(2 * n, .01), to(2 * mesh.n_points);
    std::size_t bytes = 0;
    REQUIRE(fixtures::displace_size(made.handles.plan, 1, &bytes, nullptr) == HM_OK);
    std::vector<unsigned char> work(bytes);
    hm_points const at_wall{wall.data(), wall.data() + 1, 2};
    hm_points_out const everywhere{to.data(), to.data() + 1, 2};
    CHECK(hm_displace(made.handles.plan, n, points.data(), 1, &at_wall, nullptr, &everywhere,
                      fixtures::Memory(work.data(), bytes), nullptr, nullptr) == HM_OK);
    CHECK(to[2 * points[0]] == .01);
}

TEST_CASE("wrong setups and short blocks are refused, and the setup stays as it was") {
    Case setup = two_body_case(Cells::quads, 24, 6);
    hm_mesh const mesh = setup.mesh.view();
    hm_problem const problem = setup.problem(mesh);
    Setup const short_block(problem, nullptr, 1);
    CHECK(short_block.status == HM_BLOCK_TOO_SMALL);
    CHECK(short_block.error.value == 1);
    CHECK(short_block.handles.analysis != nullptr);
    CHECK(short_block.handles.plan == nullptr);
    CHECK(short_block.handles.basis == nullptr);

    hm_error error{};
    hm_setup none{};
    unsigned char block[64] = {};
    CHECK(hm_setup_init(nullptr, fixtures::Memory(block, sizeof block), &problem, nullptr,
                        &error) == HM_BAD_ARGUMENT);
    CHECK(hm_setup_init(&none, fixtures::Memory(block, sizeof block), &problem, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text).find("setup.struct_size") != std::string::npos);
    HM_INIT(none);
    CHECK(hm_setup_init(&none, fixtures::Memory(block, sizeof block), &problem, nullptr, &error) ==
          HM_BLOCK_TOO_SMALL);
    CHECK(hm_setup_solve(&none, fixtures::Memory(block, sizeof block), nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "setup.analysis is NULL; call hm_setup_init first");

    hm_problem of_mesh = problem;  // nothing to solve
    of_mesh.curves = nullptr;
    of_mesh.n_conditions = 0;
    of_mesh.conditions = nullptr;
    Setup const mesh_alone(of_mesh);
    CHECK(mesh_alone.status == HM_BAD_ARGUMENT);
    CHECK(mesh_alone.error.code == mesh_alone.status);
    CHECK(mesh_alone.handles.analysis == nullptr);
}
