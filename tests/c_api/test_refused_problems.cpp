// A wrong problem is refused with a whole sentence: options, counts and arrays, curves, conditions.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/refused.hpp>

#include <functional>

using namespace fixtures;

namespace {

struct Bad {
    hm_status status;
    const char* text;
    std::function<void(hm_problem&, Options&, hm_mesh&)> spoil;
};

// The analysis of the tiny case, spoiled, which the size query or the initialisation refuses.
void check(std::initializer_list<Bad> all) {
    for (Bad const& bad : all) {
        Case setup = tiny_case();
        hm_mesh mesh = setup.mesh_view();
        hm_problem problem = setup.problem(mesh);
        Options options = laplace();
        bad.spoil(problem, options, mesh);
        Attempt attempt;
        attempt.analyse(problem, &options);
        INFO(std::string(bad.text));
        CHECK(attempt.status == bad.status);
        CHECK(std::string(attempt.error.text) == bad.text);
        CHECK(attempt.analysis == nullptr);
    }
}

// Does the same with cases that are spoiled before a problem is made of them.
void check(std::initializer_list<std::pair<const char*, std::function<void(Case&)>>> all,
           hm_status status) {
    for (auto const& bad : all) {
        Case setup = tiny_case();
        bad.second(setup);
        Attempt const attempt(setup.problem());
        INFO(std::string(bad.first));
        CHECK(attempt.status == status);
        CHECK(std::string(attempt.error.text) == bad.first);
        CHECK(attempt.basis == nullptr);
    }
}

std::string with_number(std::string text, std::string const& number) {
    std::size_t const place = text.find('#');
    return place == std::string::npos ? text : text.replace(place, 1, number);
}

}  // namespace

TEST_CASE("numbers of options that are out of range or unknown") {
    using Numbers = std::vector<std::int32_t>;
    struct Field {
        hm_status status;
        std::int32_t Options::*field;
        Numbers wrong;
        const char* text;  // # stands for the number
        Field(hm_status s, std::int32_t Options::*f, Numbers const& w, const char* t)
            : status(s), field(f), wrong(w), text(t) {}
    };
    Field const fields[] = {
        Field(HM_UNSUPPORTED, &Options::operator_kind, Numbers{-1, 7},
              "options.operator_kind is #, but it must be HM_CONFORMAL, HM_LAPLACE or HM_WEIGHTED"),
        Field(HM_UNSUPPORTED, &Options::scheme, Numbers{-1, 9},
              "options.study.scheme is #, but it must be HM_COMPACT, HM_BOUNDED, HM_NODAL_GRADIENT "
              "or "
              "HM_NODAL_GRADIENT_PLAIN"),
        Field(HM_UNSUPPORTED, &Options::engine, Numbers{-2, 5},
              "options.engine is #, but it must be HM_DIRECT, HM_MULTIGRID or HM_FAS"),
        Field(HM_BAD_ARGUMENT, &Options::offset_correction, Numbers{-1, 2},
              "options.offset_correction must be 0 or 1, not #"),
        Field(HM_BAD_ARGUMENT, &Options::levels, Numbers{-1, 21},
              "options.study.levels must be between 0 and 20, not #"),
        Field(HM_BAD_ARGUMENT, &Options::agglomeration, Numbers{-1, 9},
              "options.study.agglomeration is #, but it must be one of the constants "
              "HM_AGGLOMERATE_..."),
        Field(HM_BAD_ARGUMENT, &Options::start, Numbers{-1, 7},
              "options.study.start is #, but it must be HM_START_COARSEST or HM_START_ZERO"),
        Field(HM_BAD_ARGUMENT, &Options::block_width, Numbers{5},
              "options.study.block_width must be 0, 4, 8 or 16, not #"),
        Field(HM_UNSUPPORTED, &Options::block_width, Numbers{4},
              "options.study.block_width must be 0 unless the engine is HM_MULTIGRID or HM_FAS"),
        Field(HM_BAD_ARGUMENT, &Options::max_iterations, Numbers{-1},
              "options.study.max_iterations must be at least 0, not #"),
        Field(HM_UNSUPPORTED, &Options::max_iterations, Numbers{1},
              "options.study.max_iterations must be 0 unless the engine is HM_MULTIGRID or HM_FAS"),
        Field(HM_BAD_ARGUMENT, &Options::history_length, Numbers{-1},
              "options.study.history_length must be at least 0, not #"),
        Field(HM_BAD_ARGUMENT, &Options::history_length, Numbers{3},
              "options.study.history is NULL, but history_length is #"),
    };
    for (Field const& field : fields)
        for (std::int32_t const number : field.wrong)
            check({{field.status, with_number(field.text, std::to_string(number)).c_str(),
                    [&](auto&, auto& o, auto&) { o.*field.field = number; }}});
    struct {
        double wrong;
        const char* words;
    } const tolerances[] = {{1, "1"}, {-2, "-2"}, {-1e-10, "-1.00000e-10"}, {std::nan(""), "NaN"}};
    for (auto const& tolerance : tolerances)
        check({{HM_BAD_ARGUMENT,
                with_number("options.tolerance must be at least 0 and below 1, not #",
                            tolerance.words)
                    .c_str(),
                [&](auto&, auto& o, auto&) { o.tolerance = tolerance.wrong; }}});
    check({{HM_BAD_ARGUMENT,
            "options.exponent must be a multiple of 0.25 up to 4, or negative for no weight, not 5",
            [&](auto&, auto& o, auto&) { o.exponent = 5; }},
           {HM_UNSUPPORTED,
            "options.exponent must not be positive for HM_LAPLACE, which has no weight; "
            "HM_WEIGHTED has one",
            [&](auto&, auto& o, auto&) { o.exponent = 1; }}});
    auto executor = sized<hm_executor>();
    for (std::int32_t const number : {-1, 257}) {
        executor.n_threads = number;
        check({{HM_BAD_ARGUMENT,
                with_number("executor.n_threads must be between 1 and 256, not #",
                            std::to_string(number))
                    .c_str(),
                [&](auto&, auto& o, auto&) { o.executor = &executor; }}});
    }
    executor.n_threads = 1;
    for (std::int32_t const number : {-1, 5, 99}) {
        executor.kernel = number;
        check({{HM_UNSUPPORTED,
                with_number("executor.kernel is #, but it must be one of HM_KERNEL_AUTO to "
                            "HM_KERNEL_NEON",
                            std::to_string(number))
                    .c_str(),
                [&](auto&, auto& o, auto&) { o.executor = &executor; }}});
    }
}

TEST_CASE("options that do not go together, and structs without a size") {
    static hm_executor executor;
    auto const slip_at_far_field = [](hm_problem& problem) {
        static hm_condition conditions[2];
        conditions[0] = conditions[1] = problem.conditions[0];
        conditions[1].marker = far_field;
        conditions[1].kind = HM_SLIP;
        conditions[1].n_curves = 0;
        problem.conditions = conditions;
        problem.n_conditions = 2;
    };
    check({
        {HM_UNSUPPORTED, "slip (HM_SLIP) needs the engine HM_DIRECT or HM_MULTIGRID",
         [&](auto& p, auto& o, auto&) {
             slip_at_far_field(p);
             o.engine = HM_FAS;
         }},
        {HM_UNSUPPORTED,
         "the conformal operator with slip (HM_SLIP) needs the direct engine (HM_DIRECT)",
         [&](auto& p, auto& o, auto&) {
             slip_at_far_field(p);
             o.engine = HM_MULTIGRID;
             o.operator_kind = HM_CONFORMAL;
         }},
        {HM_UNSUPPORTED, "the schemes of nodal gradients need the operator laplace",
         [](auto&, auto& o, auto&) {
             o.operator_kind = HM_WEIGHTED;
             o.scheme = HM_NODAL_GRADIENT;
         }},
        {HM_BAD_ARGUMENT,
         "options.struct_size is not the size of an hm_options; begin with HM_INIT(options)",
         [](auto&, auto& o, auto&) { o.hm_options::struct_size = 0; }},
        {HM_BAD_ARGUMENT,
         "options.struct_size is not the size of an hm_options; begin with HM_INIT(options)",
         [](auto&, auto& o, auto&) { o.hm_options::struct_size = 5000; }},
        {HM_BAD_ARGUMENT,
         "executor.struct_size is not the size of an hm_executor; begin with HM_INIT(executor)",
         [](auto&, auto& o, auto&) { o.executor = &executor; }},
    });
}

TEST_CASE("counts and arrays of a problem and of the mesh") {
    static std::int32_t const sizes[] = {1, 5};
    check({
        {HM_BAD_ARGUMENT,
         "problem.struct_size is not the size of an hm_problem; begin with HM_INIT(problem)",
         [](auto& p, auto&, auto&) { p.struct_size = 4; }},
        {HM_BAD_ARGUMENT, "mesh is NULL", [](auto& p, auto&, auto&) { p.mesh = nullptr; }},
        {HM_BAD_ARGUMENT, "problem.n_conditions must be at least 0, not -1",
         [](auto& p, auto&, auto&) { p.n_conditions = -1; }},
        {HM_BAD_ARGUMENT, "problem.conditions is NULL, but problem.n_conditions is 1",
         [](auto& p, auto&, auto&) { p.conditions = nullptr; }},
        {HM_BAD_CONDITION, "the problem has curves, but no condition that puts a marker on a curve",
         [](auto& p, auto&, auto&) { p.n_conditions = 0; }},
        {HM_BAD_ARGUMENT, "problem.n_known must be at least 0, not -1",
         [](auto& p, auto&, auto&) { p.n_known = -1; }},
        {HM_BAD_ARGUMENT,
         "mesh.cell_layout is -1, but it must be one of HM_CELLS_ROWS to HM_CELLS_POLYGONS",
         [](auto&, auto&, auto& m) { m.cell_layout = -1; }},
        {HM_BAD_MESH,
         "a structured mesh needs ni, nj >= 2 and ni*nj = n_points, but ni is 1 and nj is 48",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_STRUCTURED, m.ni = 1, m.nj = 48; }},
        {HM_BAD_MESH,
         "a structured mesh needs ni, nj >= 2 and ni*nj = n_points, but ni is 7 and nj is 7",
         [](auto&, auto&, auto& m) {
             m.cell_layout = HM_CELLS_STRUCTURED, m.ni = m.nj = 7, m.n_cells = 36;
         }},
        {HM_BAD_ARGUMENT,
         "mesh.n_blocks is 1, but must be 0, as only the layout HM_CELLS_BLOCKS has blocks",
         [](auto&, auto&, auto& m) { m.n_blocks = 1; }},
        {HM_BAD_ARGUMENT, "mesh.n_blocks must be between 1 and 65536, not 0",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_BLOCKS; }},
        {HM_BAD_ARGUMENT, "mesh.block_sizes is NULL",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_BLOCKS, m.n_blocks = 1; }},
        {HM_BAD_MESH, "mesh.n_cells must be between 1 and 2^29, not 0",
         [](auto&, auto&, auto& m) {
             m.cell_layout = HM_CELLS_BLOCKS, m.n_blocks = 1, m.block_sizes = sizes, m.n_cells = 0;
         }},
        {HM_BAD_ARGUMENT, "mesh.cell_start is NULL",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_POLYGONS, m.cell_start = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.quad_points is NULL",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_MIXED, m.n_quads = 1; }},
    });
}

TEST_CASE("curves of a problem") {
    static hm_curves curves;
    auto const set = [](hm_problem& p) { curves = *p.curves, p.curves = &curves; };
    check({
        {HM_BAD_ARGUMENT,
         "curves.struct_size is not the size of an hm_curves; begin with HM_INIT(curves)",
         [&](auto& p, auto&, auto&) { set(p), curves.struct_size = 1; }},
        {HM_BAD_CURVE, "curve 0 uses 5 control points in order, but there are fewer",
         [&](auto& p, auto&, auto&) {
             static hm_curve curve;
             set(p);
             curve = curves.curve[0];
             curve.indices = nullptr;
             curves.curve = &curve;
         }},
    });
}

TEST_CASE("points that are far away from their curve") {
    check({{"point 16 is 1.41421e2 away from its curve, more than the extent of the curve or wall; "
            "check the marker of the condition",
            [](Case& c) {
                for (double& number : c.curves.control) number += 100;
            }}},
          HM_BAD_CONDITION);
}

TEST_CASE("polygons with more corners than cells can be counted") {
    std::vector<std::int32_t> start(
        600001);  // of these the library knows how many corners there are
    for (std::size_t k = 0; k < start.size(); ++k) start[k] = std::int32_t(1000 * k);
    Case setup = tiny_case();
    hm_mesh mesh = setup.mesh_view();
    mesh.cell_layout = HM_CELLS_POLYGONS;
    mesh.cell_start = start.data();
    mesh.n_cells = 600000;
    hm_problem const problem = setup.problem(mesh);
    Options const options = laplace();
    std::size_t bytes = 0;
    check_texts({{HM_BAD_MESH, "all polygons together have more than 2^29 corners",
                  call_by(fixtures::analysis_size, &problem, &options, &bytes)}});
}

TEST_CASE("four translations of a periodic mesh, which no lattice has") {
    Case setup = tiny_case();
    for (std::size_t face = 0; face < setup.mesh.face_markers.size();
         ++face) {  // each side in two halves
        std::int32_t& marker = setup.mesh.face_markers[face];
        if (marker == body) continue;
        Point const a = setup.mesh.point(setup.mesh.faces[2 * face]),
                    b = setup.mesh.point(setup.mesh.faces[2 * face + 1]);
        bool const upright = marker == left || marker == right;
        marker += (upright ? a.y + b.y : a.x + b.x) < 6 ? 20 : 40;
    }
    setup.set_periodic(bottom + 20, top + 40);
    setup.set_periodic(bottom + 40, top + 20);
    setup.set_periodic(left + 20, right + 40);
    setup.set_periodic(left + 40, right + 20);
    Attempt const attempt(setup.problem());
    CHECK(attempt.status == HM_BAD_CONDITION);
    CHECK(std::string(attempt.error.text) ==
          "periodic marker 54 needs another translation, but periodic pairs can have at most 3 "
          "different translations");
}

TEST_CASE("a fit: options, and counts of points") {
    hm_fit_options options{};
    std::size_t bytes = 0;
    double const x[] = {0, 1, 1, 0, 3}, y[] = {0, 0, 0, 1, 1}, other_y[] = {0, 0, 1, 1, 2};
    hm_points const twice{x, y, 1}, apart{x, other_y, 1};
    const hm_curves* curves = nullptr;
    auto const fit = [&](hm_points const& points, std::int32_t closed) {
        return [&, closed](hm_error* e) {
            options = {};
            options.struct_size = sizeof options;
            options.degree = 1;
            options.n_control = 3;
            options.closed = closed;
            fixtures::fit_size(5, &options, &bytes, nullptr);
            std::vector<double> block(bytes / 8 + 1);
            return hm_fit(&curves, fixtures::Memory(block.data(), bytes), &points, 5, 0, &options,
                          nullptr, e);
        };
    };
    check_texts({
        {HM_BAD_CURVE, "the consecutive points 1 and 2 are equal", fit(twice, HM_OPEN)},
        {HM_BAD_CURVE, "a tied or periodic curve needs points that form a closed loop",
         fit(apart, HM_PERIODIC)},
        {HM_BAD_CURVE, "2147483647 points are too many for a fit",
         [&](hm_error* e) {
             return options.closed = 0, fixtures::fit_size(2147483647, &options, &bytes, e);
         }},
    });
}
