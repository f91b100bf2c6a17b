// What a problem may have wrong, with the whole sentence that says so: options, counts and arrays,
// curves, conditions.
#include <harmorph_study.h>
#include "fixtures/options.hpp"
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
        Case its = tiny_case();
        hm_mesh mesh = its.mesh_view();
        hm_problem problem = its.problem(mesh);
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

// The same, where the case itself is spoiled.
void check(std::initializer_list<std::pair<const char*, std::function<void(Case&)>>> all,
           hm_status status) {
    for (auto const& bad : all) {
        Case its = tiny_case();
        bad.second(its);
        Attempt const attempt(its.problem());
        INFO(std::string(bad.first));
        CHECK(attempt.status == status);
        CHECK(std::string(attempt.error.text) == bad.first);
        CHECK(attempt.basis == nullptr);
    }
}

}  // namespace

TEST_CASE("options that are out of range or unknown") {
    static hm_executor executor;
    executor = {};
    check({
        {HM_UNSUPPORTED, "options.operator_kind is 7, which is unknown",
         [](auto&, auto& o, auto&) { o.operator_kind = 7; }},
        {HM_UNSUPPORTED, "options.operator_kind is -1, which is unknown",
         [](auto&, auto& o, auto&) { o.operator_kind = -1; }},
        {HM_UNSUPPORTED, "study options: scheme is 9, which is unknown",
         [](auto&, auto& o, auto&) { o.scheme = 9; }},
        {HM_UNSUPPORTED, "study options: scheme is -1, which is unknown",
         [](auto&, auto& o, auto&) { o.scheme = -1; }},
        {HM_UNSUPPORTED, "options.engine is 5, which is unknown",
         [](auto&, auto& o, auto&) { o.engine = 5; }},
        {HM_UNSUPPORTED, "options.engine is -2, which is unknown",
         [](auto&, auto& o, auto&) { o.engine = -2; }},
        {HM_BAD_ARGUMENT, "options.exponent_quarters must be between -1 and 16, not 17",
         [](auto&, auto& o, auto&) { o.exponent_quarters = 17; }},
        {HM_BAD_ARGUMENT, "options.exponent_quarters must be between -1 and 16, not -2",
         [](auto&, auto& o, auto&) { o.exponent_quarters = -2; }},
        {HM_UNSUPPORTED, "the Laplace operator has no weight; HM_WEIGHTED has one",
         [](auto&, auto& o, auto&) { o.exponent_quarters = 4; }},
        {HM_BAD_ARGUMENT, "options.offset_correction must be 0 or 1, not 2",
         [](auto&, auto& o, auto&) { o.offset_correction = 2; }},
        {HM_BAD_ARGUMENT, "options.offset_correction must be 0 or 1, not -1",
         [](auto&, auto& o, auto&) { o.offset_correction = -1; }},
        {HM_BAD_ARGUMENT, "study options: levels must be between 0 and 20, not 21",
         [](auto&, auto& o, auto&) { o.levels = 21; }},
        {HM_BAD_ARGUMENT, "study options: levels must be between 0 and 20, not -1",
         [](auto&, auto& o, auto&) { o.levels = -1; }},
        {HM_BAD_ARGUMENT, "study options: agglomeration is 9, which is unknown",
         [](auto&, auto& o, auto&) { o.agglomeration = 9; }},
        {HM_BAD_ARGUMENT, "study options: agglomeration is -1, which is unknown",
         [](auto&, auto& o, auto&) { o.agglomeration = -1; }},
        {HM_BAD_ARGUMENT, "study options: block_width must be 0, 4, 8 or 16, not 5",
         [](auto&, auto& o, auto&) { o.block_width = 5; }},
        {HM_BAD_ARGUMENT,
         "study options: max_iterations or history_length is negative, or history is NULL",
         [](auto&, auto& o, auto&) { o.max_iterations = -1; }},
        {HM_BAD_ARGUMENT,
         "study options: max_iterations or history_length is negative, or history is NULL",
         [](auto&, auto& o, auto&) { o.history_length = -1; }},
        {HM_BAD_ARGUMENT,
         "study options: max_iterations or history_length is negative, or history is NULL",
         [](auto&, auto& o, auto&) { o.history_length = 3; }},
        {HM_BAD_ARGUMENT, "study options: start is 7, which is unknown",
         [](auto&, auto& o, auto&) { o.start = 7; }},
        {HM_BAD_ARGUMENT, "study options: start is -1, which is unknown",
         [](auto&, auto& o, auto&) { o.start = -1; }},
        {HM_BAD_ARGUMENT, "options.struct_size is wrong",
         [](auto&, auto& o, auto&) { o.hm_options::struct_size = 0; }},
        {HM_BAD_ARGUMENT, "options.struct_size is wrong",
         [](auto&, auto& o, auto&) { o.hm_options::struct_size = 5000; }},
        {HM_UNSUPPORTED, "study options: block_width goes with the engines multigrid and fas only",
         [](auto&, auto& o, auto&) { o.block_width = 4; }},
        {HM_UNSUPPORTED,
         "study options: max_iterations goes with the engines multigrid and fas only",
         [](auto&, auto& o, auto&) { o.max_iterations = 1; }},
        {HM_UNSUPPORTED, "study options: history goes with the engines multigrid and fas only",
         [](auto&, auto& o, auto&) {
             static double history[2];
             o.history = history, o.history_length = 2;
         }},
        {HM_UNSUPPORTED, "study options: start goes with the engine fas only",
         [](auto&, auto& o, auto&) { o.engine = HM_MULTIGRID, o.start = HM_START_ZERO; }},
        {HM_BAD_ARGUMENT, "options.tolerance must be at least 0 and below 1, not 1",
         [](auto&, auto& o, auto&) { o.tolerance = 1; }},
        {HM_BAD_ARGUMENT, "options.tolerance must be at least 0 and below 1, not -2",
         [](auto&, auto& o, auto&) { o.tolerance = -2; }},
        {HM_UNSUPPORTED, "options.precision 3 is unknown",
         [](auto&, auto& o, auto&) { o.precision = 3; }},
        {HM_UNSUPPORTED, "options.precision -1 is unknown",
         [](auto&, auto& o, auto&) { o.precision = -1; }},
        {HM_BAD_ARGUMENT, "executor.struct_size is wrong",
         [](auto&, auto& o, auto&) { o.executor = &executor; }},
        {HM_UNSUPPORTED, "executor.kernel is 99, which is unknown",
         [](auto&, auto& o, auto&) {
             executor.struct_size = sizeof executor;
             executor.kernel = 99;
             o.executor = &executor;
         }},
        {HM_BAD_ARGUMENT, "executor.n_threads must be between 1 and 256, not 257",
         [](auto&, auto& o, auto&) {
             executor.kernel = 0;
             executor.n_threads = 257;
             o.executor = &executor;
         }},
    });
}

TEST_CASE("counts and arrays of a problem and of the mesh") {
    static std::int32_t const sizes[] = {1, 5};
    check({
        {HM_BAD_ARGUMENT, "problem.struct_size is wrong",
         [](auto& p, auto&, auto&) { p.struct_size = 4; }},
        {HM_BAD_ARGUMENT, "mesh is NULL", [](auto& p, auto&, auto&) { p.mesh = nullptr; }},
        {HM_BAD_ARGUMENT, "n_conditions is negative, or conditions is NULL",
         [](auto& p, auto&, auto&) { p.n_conditions = -1; }},
        {HM_BAD_ARGUMENT, "n_conditions is negative, or conditions is NULL",
         [](auto& p, auto&, auto&) { p.conditions = nullptr; }},
        {HM_BAD_CONDITION, "there are curves, but no condition that puts a marker on one",
         [](auto& p, auto&, auto&) { p.n_conditions = 0; }},
        {HM_BAD_ARGUMENT, "given parameters: negative number, or an array is NULL",
         [](auto& p, auto&, auto&) { p.n_given = -1; }},
        {HM_BAD_ARGUMENT, "mesh.struct_size is wrong",
         [](auto&, auto&, auto& m) { m.struct_size = 0; }},
        {HM_BAD_ARGUMENT, "mesh.cell_layout 99 is unknown",
         [](auto&, auto&, auto& m) { m.cell_layout = 99; }},
        {HM_BAD_ARGUMENT, "mesh.cell_layout -1 is unknown",
         [](auto&, auto&, auto& m) { m.cell_layout = -1; }},
        {HM_BAD_ARGUMENT, "mesh.index_base must be 0 or 1, not 2",
         [](auto&, auto&, auto& m) { m.index_base = 2; }},
        {HM_BAD_MESH, "mesh.n_points must be between 3 and 2^30, not 2",
         [](auto&, auto&, auto& m) { m.n_points = 2; }},
        {HM_BAD_MESH, "mesh.n_cells must be between 1 and 2^29, not 0",
         [](auto&, auto&, auto& m) { m.n_cells = 0; }},
        {HM_BAD_ARGUMENT, "mesh.n_faces and mesh.n_lists must not be negative",
         [](auto&, auto&, auto& m) { m.n_faces = -1; }},
        {HM_BAD_ARGUMENT, "mesh.n_faces and mesh.n_lists must not be negative",
         [](auto&, auto&, auto& m) { m.n_lists = -1; }},
        {HM_BAD_MESH,
         "a structured mesh needs ni, nj >= 2 and ni*nj = n_points, but ni is 1 and nj is 48",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_STRUCTURED, m.ni = 1, m.nj = 48; }},
        {HM_BAD_MESH,
         "a structured mesh needs ni, nj >= 2 and ni*nj = n_points, but ni is 7 and nj is 7",
         [](auto&, auto&, auto& m) {
             m.cell_layout = HM_CELLS_STRUCTURED, m.ni = m.nj = 7, m.n_cells = 36;
         }},
        {HM_BAD_MESH, "a structured mesh has (ni-1)*(nj-1) cells, but mesh.n_cells is 34",
         [](auto&, auto&, auto& m) {
             m.cell_layout = HM_CELLS_STRUCTURED, m.ni = 8, m.nj = 6, m.n_cells = 34;
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
         [](auto&, auto&, auto& m) { m.cell_start = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.cell_start is NULL",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_POLYGONS, m.cell_start = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.cell_points is NULL",
         [](auto&, auto&, auto& m) { m.cell_points = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.quad_points is NULL",
         [](auto&, auto&, auto& m) { m.cell_layout = HM_CELLS_MIXED, m.n_quads = 1; }},
        {HM_BAD_ARGUMENT, "mesh.points.x or mesh.points.y is NULL",
         [](auto&, auto&, auto& m) { m.points.x = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.points.stride is negative",
         [](auto&, auto&, auto& m) { m.points.stride = -1; }},
        {HM_BAD_ARGUMENT, "mesh.face_points or mesh.face_markers is NULL",
         [](auto&, auto&, auto& m) { m.face_points = nullptr; }},
        {HM_BAD_ARGUMENT, "mesh.list_start, mesh.list_points or mesh.list_markers is NULL",
         [](auto&, auto&, auto& m) { m.n_lists = 1; }},
    });
}

TEST_CASE("arrays of curves, and the kinds of conditions") {
    static hm_curves curves;
    static hm_condition condition;
    auto const set = [](hm_problem& p) { curves = *p.curves, p.curves = &curves; };
    auto const change = [](hm_problem& p) -> hm_condition& {
        condition = p.conditions[0];
        p.conditions = &condition;
        return condition;
    };
    check({
        {HM_BAD_ARGUMENT, "curves.struct_size is wrong",
         [&](auto& p, auto&, auto&) { set(p), curves.struct_size = 1; }},
        {HM_BAD_ARGUMENT, "curves.index_base must be 0 or 1",
         [&](auto& p, auto&, auto&) { set(p), curves.index_base = 2; }},
        {HM_BAD_ARGUMENT, "curves.control or curves.curve is NULL",
         [&](auto& p, auto&, auto&) { set(p), curves.control = nullptr; }},
        {HM_BAD_ARGUMENT, "curves.control or curves.curve is NULL",
         [&](auto& p, auto&, auto&) { set(p), curves.curve = nullptr; }},
        {HM_BAD_CURVE, "curves.n_control must be between 2 and 2^24, not 1",
         [&](auto& p, auto&, auto&) { set(p), curves.n_control = 1; }},
        {HM_BAD_CURVE, "curves.n_curves must be between 1 and 2^24, not 0",
         [&](auto& p, auto&, auto&) { set(p), curves.n_curves = 0; }},
        {HM_BAD_CURVE, "curve 0 uses 5 control points in order, but there are fewer",
         [&](auto& p, auto&, auto&) {
             static hm_curve curve;
             set(p);
             curve = curves.curve[0];
             curve.indices = nullptr;
             curves.curve = &curve;
         }},
        {HM_BAD_ARGUMENT, "condition 0 has the unknown kind 9",
         [&](auto& p, auto&, auto&) { change(p).kind = 9; }},
        {HM_BAD_ARGUMENT, "struct_size of condition 0 is wrong",
         [&](auto& p, auto&, auto&) { change(p).struct_size = 0; }},
        {HM_BAD_CONDITION, "condition 0 names rigid body -1, which there cannot be",
         [&](auto& p, auto&, auto&) { change(p).kind = HM_RIGID, condition.body = -1; }},
    });
}

TEST_CASE("a mesh that contradicts itself, and conditions that contradict each other") {
    check({{"the boundary face between points 0 and 1 belongs to two markers",
            [](Case& c) { c.mesh.add_face(0, 1, 77); }},
           {"cell 0 contains point 0 twice", [](Case& c) { c.mesh.cells[1] = 0; }}},
          HM_BAD_MESH);
    check({{"markers 1 and 13 belong to one rigid body, but have different centres",
            [](Case& c) {
                c.conditions.clear();
                c.curves = {};
                c.set_rigid(body, 3, 3);
                c.set_rigid(top, 2, 3);
            }},
           {"a parameter is given for point 0, whose marker is not on a curve",
            [](Case& c) { c.give(0, 0.5); }},
           {"point 16 is 1.41421e2 away from its curve, more than the extent of the curve or wall; "
            "check the marker of the condition",
            [](Case& c) {
                for (double& number : c.curves.control) number += 100;
            }}},
          HM_BAD_CONDITION);
}

TEST_CASE("polygons with more corners than cells can be counted") {
    std::vector<std::int32_t> start(
        600001);  // of these the library knows how many corners there are
    for (std::size_t k = 0; k < start.size(); ++k) start[k] = static_cast<std::int32_t>(1000 * k);
    Case its = tiny_case();
    hm_mesh mesh = its.mesh_view();
    mesh.cell_layout = HM_CELLS_POLYGONS;
    mesh.cell_start = start.data();
    mesh.n_cells = 600000;
    hm_problem const problem = its.problem(mesh);
    Options const options = laplace();
    std::size_t bytes = 0;
    check_texts({{HM_BAD_MESH, "all polygons together have more than 2^29 corners",
                  [&](hm_error* e) { return hm_analysis_size(&problem, &options, &bytes, e); }}});
}

TEST_CASE("a body that single precision cannot turn") {
    Case its = tiny_case();
    its.conditions.clear();
    its.curves = {};
    its.set_rigid(body, 1e25, 3);
    Options options = laplace();
    options.precision = HM_SINGLE;
    Attempt const attempt(its.problem(), &options);
    CHECK(attempt.status == HM_UNSUPPORTED);
    CHECK(
        std::string(attempt.error.text) ==
        "point 17 is 1.00000e25 from the centre of its body: single precision takes 1e-12 .. 1e24");
    its.conditions.back().x = 1e24;
    Attempt const nearer(its.problem(), &options);
    CHECK_MESSAGE(nearer.status >= HM_OK, nearer.error.text);
}

TEST_CASE("four translations of a periodic mesh, which no lattice has") {
    Case its = tiny_case();
    for (std::size_t face = 0; face < its.mesh.face_markers.size();
         ++face) {  // each side in two halves
        std::int32_t& marker = its.mesh.face_markers[face];
        if (marker == body) continue;
        Point const a = its.mesh.point(its.mesh.faces[2 * face]),
                    b = its.mesh.point(its.mesh.faces[2 * face + 1]);
        bool const upright = marker == left || marker == right;
        marker += (upright ? a.y + b.y : a.x + b.x) < 6 ? 20 : 40;
    }
    its.set_periodic(bottom + 20, top + 40);
    its.set_periodic(bottom + 40, top + 20);
    its.set_periodic(left + 20, right + 40);
    its.set_periodic(left + 40, right + 20);
    Attempt const attempt(its.problem());
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
            hm_fit_size(5, &options, &bytes, nullptr);
            std::vector<double> block(bytes / 8 + 1);
            return hm_fit(&curves, block.data(), bytes, &points, 5, 0, &options, nullptr, e);
        };
    };
    check_texts({
        {HM_BAD_CURVE, "the consecutive points 1 and 2 are equal", fit(twice, HM_OPEN)},
        {HM_BAD_CURVE, "a tied or periodic curve needs points that form a closed loop",
         fit(apart, HM_PERIODIC)},
        {HM_BAD_ARGUMENT, "fit options: struct_size is wrong",
         [&](hm_error* e) {
             return options.struct_size = 0, hm_fit_size(20, &options, &bytes, e);
         }},
        {HM_BAD_ARGUMENT, "fit options: closed is 9, which is unknown",
         [&](hm_error* e) {
             return options.struct_size = sizeof options, options.closed = 9,
                    hm_fit_size(20, &options, &bytes, e);
         }},
        {HM_BAD_CURVE, "2147483647 points are too many for a fit",
         [&](hm_error* e) {
             return options.closed = 0, hm_fit_size(2147483647, &options, &bytes, e);
         }},
        {HM_BAD_ARGUMENT, "bytes is NULL",
         [&](hm_error* e) { return hm_fit_size(20, &options, nullptr, e); }},
    });
}
