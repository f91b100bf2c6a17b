// Every kind of bad input is refused with a sentence that names the first offender;
// the caller's arrays stay as they are.
#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/memory.hpp>
#include <fixtures/bodies.hpp>
#include <fixtures/mesh.hpp>

#include <functional>
#include <limits>

using namespace fixtures;

namespace {

constexpr std::int32_t nobody = -1;
double const not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Spoiled {
    hm_status status;
    const char* word;   // in the sentence
    std::int32_t item;  // from 0, or the number found
    std::function<void(Case&)> change;
    std::function<void(hm_mesh&)> change_view = {};
};

Spoiled in_view(hm_status status, const char* word, std::int32_t item,
                std::function<void(hm_mesh&)> const& change) {
    return {status, word, item, {}, change};
}

void check_refused(Spoiled const& bad) {
    for (std::int32_t const base : {0, 1}) {
        Case setup = tiny_case();
        setup.index_base = base;
        if (bad.change) bad.change(setup);
        hm_mesh view = setup.mesh_view();
        if (bad.change_view) bad.change_view(view);
        hm_problem const problem = setup.problem(view);
        Mesh const mesh = setup.mesh;
        std::vector<double> const control = setup.curves.control;

        Attempt attempt(problem);
        INFO(std::string(bad.word)
             << ", index_base " << base << ": " << attempt.reached << ": " << attempt.error.text);
        CHECK(attempt.status == bad.status);
        CHECK(attempt.error.code == attempt.status);
        CHECK(says(attempt.error, bad.word));
        CHECK(std::string(attempt.error.text).find_first_of("#@~") == std::string::npos);
        std::int32_t const kind = attempt.error.item_kind;
        CHECK(attempt.error.item_base ==
              (kind == HM_ITEM_NONE || kind == HM_ITEM_MARKER ? 0 : base));
        std::int32_t const item = attempt.error.item - attempt.error.item_base;
        if (kind != HM_ITEM_NONE) CHECK(item == bad.item);
        else CHECK(attempt.error.item == nobody);
        if (kind == HM_ITEM_NONE && bad.item != nobody) CHECK(attempt.error.value == bad.item);
        CHECK(attempt.guards_intact());
        CHECK(attempt.basis == nullptr);
        CHECK(same_bits(mesh.x, setup.mesh.x));
        CHECK(mesh.cells == setup.mesh.cells);
        CHECK(same_bits(control, setup.curves.control));
    }
}

void replace_cell(Mesh& mesh, std::int32_t cell, std::vector<std::int32_t> const& points) {
    Mesh const old = mesh;
    mesh.cells.clear();
    mesh.cell_start.assign(1, 0);
    for (std::int32_t i = 0; i < old.n_cells(); ++i) {
        auto const begin = old.cells.begin() + old.cell_start[std::size_t(i)];
        auto const end = old.cells.begin() + old.cell_start[std::size_t(i) + 1];
        if (i == cell) mesh.cells.insert(mesh.cells.end(), points.begin(), points.end());
        else mesh.cells.insert(mesh.cells.end(), begin, end);
        mesh.cell_start.push_back(std::int32_t(mesh.cells.size()));
    }
}

}  // namespace

TEST_CASE("what the others spoil is sound") {
    for (std::int32_t const base : {0, 1}) {
        Case setup = tiny_case();
        setup.index_base = base;
        Solved const solved(setup);
        CHECK(solved.report.curve_points == 8);
        CHECK(solved.report.unknowns == 48 - 8 - 24);
    }
}

TEST_CASE("bad counts and missing arrays of a mesh") {
    const char *const negative = "mesh.n_faces and mesh.n_lists must not be negative",
                      *const no_points = "mesh.points.x or mesh.points.y is NULL",
                      *const no_faces = "mesh.face_points or mesh.face_markers is NULL";
    Spoiled const all[] = {
        in_view(HM_BAD_ARGUMENT, "mesh.index_base must be 0 or 1, not 2", 2,
                [](hm_mesh& m) { m.index_base = 2; }),
        in_view(HM_BAD_MESH, "mesh.n_points must be between 3 and 2^30, not 2", 2,
                [](hm_mesh& m) { m.n_points = 2; }),
        in_view(HM_BAD_MESH, "n_points", -5, [](hm_mesh& m) { m.n_points = -5; }),
        in_view(HM_BAD_MESH, "mesh.n_cells must be between 1 and 2^29, not 0", 0,
                [](hm_mesh& m) { m.n_cells = 0; }),
        in_view(HM_BAD_ARGUMENT, negative, nobody, [](hm_mesh& m) { m.n_faces = -1; }),
        in_view(HM_BAD_ARGUMENT, negative, nobody, [](hm_mesh& m) { m.n_lists = -1; }),
        in_view(HM_BAD_ARGUMENT,
                "mesh.cell_layout is 9, but it must be one of HM_CELLS_ROWS to HM_CELLS_POLYGONS",
                9, [](hm_mesh& m) { m.cell_layout = 9; }),
        in_view(HM_BAD_ARGUMENT, "mesh.reserved must be 0, not 7", 7,
                [](hm_mesh& m) { m.reserved = 7; }),
        in_view(HM_BAD_ARGUMENT,
                "mesh.struct_size is not the size of an hm_mesh; begin with HM_INIT(mesh)", nobody,
                [](hm_mesh& m) { m.struct_size = 0; }),
        in_view(HM_BAD_ARGUMENT, "mesh.cell_points is NULL", nobody,
                [](hm_mesh& m) { m.cell_points = nullptr; }),
        in_view(HM_BAD_ARGUMENT, "mesh.cell_start is NULL", nobody,
                [](hm_mesh& m) { m.cell_start = nullptr; }),
        in_view(HM_BAD_ARGUMENT, no_points, nobody, [](hm_mesh& m) { m.points.x = nullptr; }),
        in_view(HM_BAD_ARGUMENT, no_points, nobody, [](hm_mesh& m) { m.points.y = nullptr; }),
        in_view(HM_BAD_ARGUMENT, "mesh.points.stride is negative", nobody,
                [](hm_mesh& m) { m.points.stride = -1; }),
        in_view(HM_BAD_ARGUMENT, no_faces, nobody, [](hm_mesh& m) { m.face_points = nullptr; }),
        in_view(HM_BAD_ARGUMENT, no_faces, nobody, [](hm_mesh& m) { m.face_markers = nullptr; }),
        in_view(HM_BAD_ARGUMENT, "mesh.list_start, mesh.list_points or mesh.list_markers is NULL",
                nobody, [](hm_mesh& m) { m.n_lists = 1; }),
    };
    for (Spoiled const& bad : all) check_refused(bad);
}

TEST_CASE("bad cells") {
    static std::int32_t const five = 5;
    auto const cell_becomes = [](std::int32_t cell, std::vector<std::int32_t> const& points) {
        return [=](Case& c) { replace_cell(c.mesh, cell, points); };
    };
    Spoiled const all[] = {
        in_view(HM_BAD_MESH, "begin with", 5, [](hm_mesh& m) { m.cell_start = &five; }),
        {HM_BAD_MESH, "3 or 4", 9, cell_becomes(9, {10, 11, 18, 17, 3})},
        {HM_BAD_MESH, "3 or 4", 5, cell_becomes(5, {5, 6})},
        {HM_BAD_MESH, "does not exist", 7, cell_becomes(7, {8, 9, 48, 15})},
        {HM_BAD_MESH, "does not exist", 7, cell_becomes(7, {8, -1, 16, 15})},
        {HM_BAD_MESH, "does not exist", 20, cell_becomes(20, {24, 25, 2000000000})},
        {HM_BAD_MESH, "twice", 18, cell_becomes(18, {22, 23, 22})},
        {HM_BAD_MESH, "twice", 3, cell_becomes(3, {3, 4, 3, 10})},
        {HM_BAD_MESH, "twice", 3, cell_becomes(3, {3, 3, 11, 10})},
        {HM_BAD_MESH, "more than two cells", 8,
         [](Case& c) {
             c.mesh.add_cell({8, 9, 5});
         }},
        {HM_BAD_MESH, "inverted or has no area", 0, [](Case& c) { c.mesh.x[8] = -1; }},
        {HM_BAD_MESH, "inverted or has no area", 24, [](Case& c) { c.mesh.y[35] = 4; }},  // flat
        {HM_BAD_MESH, "inverted or has no area", 0,
         [](Case& c) { c.mesh.x[8] = c.mesh.y[8] = 0.4; }},  // not convex
        {HM_BAD_MESH, "not finite", 12, [](Case& c) { c.mesh.x[12] = not_a_number; }},
        {HM_BAD_MESH, "not finite", 47, [](Case& c) { c.mesh.y[47] = -HUGE_VAL; }},
    };
    for (Spoiled const& bad : all) check_refused(bad);
}

TEST_CASE("the largest and smallest of numbers as an index") {
    for (std::int32_t const base : {0, 1})
        for (std::int32_t const number :
             {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
            Case setup = tiny_case();
            setup.index_base = base;
            hm_mesh view = setup.mesh_view();
            std::vector<std::int32_t> cells(view.cell_points,
                                            view.cell_points + setup.mesh.cells.size());
            cells[17] = number;
            view.cell_points = cells.data();
            Attempt const in_cell(setup.problem(view));
            CHECK(in_cell.status == HM_BAD_MESH);
            CHECK(in_cell.error.item == 4 + base);

            view = setup.mesh_view();
            std::vector<std::int32_t> faces(view.face_points,
                                            view.face_points + setup.mesh.faces.size());
            faces[17] = number;
            view.face_points = faces.data();
            Attempt const in_face(setup.problem(view));
            CHECK(in_face.status == HM_BAD_MESH);
            CHECK(in_face.error.item == 8 + base);
        }
}

TEST_CASE("bad structured blocks") {
    auto const block = [](std::int32_t ni, std::int32_t nj) {
        return [=](hm_mesh& m) {
            m.cell_layout = HM_CELLS_STRUCTURED;
            m.n_cells = 0;
            m.ni = ni;
            m.nj = nj;
        };
    };
    check_refused(in_view(HM_BAD_MESH, "ni*nj", 7, block(7, 8)));
    check_refused(in_view(HM_BAD_MESH, "n_cells", 0, block(1, 48)));
    check_refused(in_view(HM_BAD_MESH, "n_cells", 0, block(48, 1)));
    check_refused(in_view(HM_BAD_MESH, "n_cells", 0, block(-6, -8)));
    check_refused(in_view(HM_BAD_MESH, "n_cells", 0, block(2000000000, 2000000000)));
    check_refused(in_view(HM_BAD_MESH,
                          "a structured mesh has (ni-1)*(nj-1) cells, but mesh.n_cells is 34", 34,
                          [](hm_mesh& m) {
                              m.cell_layout = HM_CELLS_STRUCTURED;
                              m.n_cells = 34;
                              m.ni = 6;
                              m.nj = 8;
                          }));
}

TEST_CASE("bad boundaries") {
    auto const drop_last_face = [](Case& c) {
        c.mesh.faces.resize(c.mesh.faces.size() - 2);
        c.mesh.face_markers.pop_back();
    };
    Spoiled const all[] = {
        {HM_BAD_MESH, "does not exist", 3, [](Case& c) { c.mesh.faces[6] = 48; }},
        {HM_BAD_MESH, "does not exist", 3, [](Case& c) { c.mesh.faces[7] = -1; }},
        {HM_BAD_MESH, "on both sides", 8,
         [](Case& c) { c.mesh.faces[8] = 8, c.mesh.faces[9] = 9; }},
        {HM_BAD_MESH, "is not an edge of any cell", 1,
         [](Case& c) { c.mesh.faces[8] = 1, c.mesh.faces[9] = 12; }},
        {HM_BAD_MESH, "the same point", 7, [](Case& c) { c.mesh.faces[8] = c.mesh.faces[9] = 7; }},
        {HM_BAD_MESH, "no marker", 24, drop_last_face},
        {HM_BAD_MESH, "no marker", 0,
         [](Case& c) { c.mesh.faces.clear(), c.mesh.face_markers.clear(); }},
        {HM_BAD_MESH, "belongs to two markers", 1, [](Case& c) { c.mesh.add_face(1, 0, right); }},
    };
    for (Spoiled const& bad : all) check_refused(bad);

    // Lists of points, counted from 0 here.
    static std::vector<std::int32_t> starts, points;
    static std::int32_t const markers[] = {bottom, right};
    auto const lists = [](std::vector<std::int32_t> const& new_starts,
                          std::vector<std::int32_t> const& new_points) {
        return [=](hm_mesh& m) {
            starts = new_starts;
            points = new_points;
            for (std::int32_t& start : starts) start += m.index_base;
            for (std::int32_t& point : points) point += m.index_base;
            m.n_lists = std::int32_t(starts.size()) - 1;
            m.list_start = starts.data();
            m.list_points = points.data();
            m.list_markers = markers;
        };
    };
    check_refused(in_view(HM_BAD_MESH, "must not decrease", 1, lists({0, 3, 2}, {0, 1, 2})));
    check_refused(in_view(HM_BAD_MESH, "begin with", 0, lists({1, 3}, {0, 1, 2})));
    check_refused(in_view(HM_BAD_MESH, "on both sides", 1, lists({0, 3}, {0, 1, 8})));
    check_refused(in_view(HM_BAD_MESH, "is not an edge of any cell", 13,
                          lists({0, 3, 6}, {0, 1, 2, 6, 13, 26})));
    check_refused(in_view(HM_BAD_MESH, "does not exist", 1, lists({0, 3}, {0, 1, 48})));
    check_refused(in_view(HM_BAD_MESH, "two markers", 0, lists({0, 0, 2}, {0, 1})));
}

TEST_CASE("boundary edges of cells that are not given are refused by the numbers of their points") {
    // Triangles alone of a hybrid mesh. Lists begin with the bottom, whose cells are quads.
    std::int32_t const start[] = {1, 8, 15}, markers[] = {bottom, top};
    std::vector<std::int32_t> points;
    for (std::int32_t k = 1; k <= 7; ++k) points.push_back(k);
    for (std::int32_t k = 48; k > 41; --k) points.push_back(k);
    Case setup = tiny_case();
    setup.index_base = 1;
    Mixed const mixed(setup.mesh, 1);
    hm_mesh view = mixed.put_into(setup.mesh_view());
    view.n_cells = mixed.n_triangles();
    view.n_quads = 0;
    for (bool const in_lists : {true, false}) {
        if (in_lists) {
            view.n_lists = 2;
            view.list_start = start;
            view.list_points = points.data();
            view.list_markers = markers;
            view.n_faces = 0;
        } else {
            view.n_lists = 0;
            view.n_faces = setup.mesh.n_faces();
        }
        Attempt const attempt(setup.problem(view));
        INFO(attempt.error.text);
        CHECK(attempt.status == HM_BAD_MESH);
        std::string const text = attempt.error.text;
        CHECK(text.find("is not an edge of any cell") != std::string::npos);
        std::int32_t const* const ends = in_lists ? points.data() : view.face_points;
        CHECK(attempt.error.item == ends[0]);
        CHECK(text.find("points " + std::to_string(ends[0]) + " and " + std::to_string(ends[1])) !=
              std::string::npos);
    }
}

TEST_CASE("bad cells in two arrays") {
    for (std::int32_t const base : {0, 1}) {
        Case setup = tiny_case();
        setup.index_base = base;
        Mixed mixed(setup.mesh, base);
        auto const refused = [&](hm_status status, const char* word, std::int32_t item,
                                 auto change) {
            hm_mesh view = mixed.put_into(setup.mesh_view());
            change(view);
            Attempt const attempt(setup.problem(view));
            INFO(std::string(word) << ": " << attempt.error.text);
            CHECK(attempt.status == status);
            CHECK(says(attempt.error, word));
            CHECK(fixtures::found(attempt.error) == item);
        };
        refused(HM_BAD_ARGUMENT, "n_quads", -1, [](hm_mesh& m) { m.n_quads = -1; });
        refused(HM_BAD_ARGUMENT, "n_quads", mixed.rows.n_cells() + 1,
                [](hm_mesh& m) { m.n_quads = m.n_cells + 1; });
        refused(HM_BAD_ARGUMENT, "quad_points is NULL", nobody,
                [](hm_mesh& m) { m.quad_points = nullptr; });
        refused(HM_BAD_ARGUMENT, "cell_points is NULL", nobody,
                [](hm_mesh& m) { m.cell_points = nullptr; });
        refused(HM_BAD_ARGUMENT, "only the layout HM_CELLS_MIXED", mixed.n_quads(),
                [](hm_mesh& m) { m.cell_layout = HM_CELLS_TRIANGLES; });
        // Cells are counted through: quad k is cell n_triangles + k.
        mixed.quads[4 * 5 + 2] = 48 + base;
        refused(HM_BAD_MESH, "does not exist", mixed.n_triangles() + 5 + base, [](hm_mesh&) {});
        mixed.triangles[3 * 2] = -1;
        refused(HM_BAD_MESH, "does not exist", 2 + base, [](hm_mesh&) {});
    }
}

TEST_CASE("bad conditions and parameters") {
    Spoiled const all[] = {
        {HM_BAD_CONDITION, "no condition", nobody, [](Case& c) { c.conditions.clear(); }},
        {HM_BAD_CONDITION, "no boundary face has marker", 77, [](Case& c) { c.set_free(77); }},
        {HM_BAD_CONDITION, "two conditions", body, [](Case& c) { c.set_free(body); }},
        {HM_BAD_ARGUMENT, "is 9, but it must be one of HM_ON_CURVE to HM_INTERFACE", 0,
         [](Case& c) { c.conditions[0].kind = HM_INTERFACE + 1; }},
        {HM_BAD_ARGUMENT, "is -1, but it must be one of HM_ON_CURVE to HM_INTERFACE", 0,
         [](Case& c) { c.conditions[0].kind = -1; }},
        {HM_BAD_ARGUMENT, "is not the size of an hm_condition; begin with HM_INIT", 0,
         [](Case& c) { c.conditions[0].struct_size = 0; }},
        {HM_BAD_CONDITION, "curves that do not exist", 0,
         [](Case& c) { c.conditions[0].n_curves = 2; }},
        {HM_BAD_CONDITION, "its n_curves is 0; there are 1", 0,
         [](Case& c) { c.conditions[0].n_curves = 0; }},
        {HM_BAD_CONDITION, "curves that do not exist", 0,
         [](Case& c) { c.conditions[0].first_curve = -1; }},
        {HM_BAD_CONDITION, "nothing moves", nobody,
         [](Case& c) { c.conditions.clear(), c.set_free(body); }},
        {HM_BAD_CONDITION, "does not exist", 48, [](Case& c) { c.give(48, 0); }},
        {HM_BAD_CONDITION, "marker is not on a curve", 8, [](Case& c) { c.give(8, 0); }},
        {HM_BAD_CONDITION, "marker is not on a curve", 0,
         [](Case& c) { c.give(0, 0); }},  // on a fixed marker
        {HM_BAD_CONDITION, "which does not exist", 0, [](Case& c) { c.give(16, 0, 1); }},
        {HM_BAD_CONDITION, "outside the range of its curve", 17,
         [](Case& c) { c.give(16, 4), c.give(17, 4.001); }},
        {HM_BAD_CONDITION, "outside the range of its curve", 17,
         [](Case& c) { c.give(17, not_a_number); }},
    };
    for (Spoiled const& bad : all) check_refused(bad);
}

TEST_CASE("fields that a condition of this kind does not have are refused by name") {
    struct {
        const char* name;
        std::int32_t kind, also;  // whose they are; `partner` is that of interfaces, too
        void (*set)(hm_condition& c);
    } const fields[] = {
        {"first_curve", HM_ON_CURVE, HM_ON_CURVE, [](hm_condition& c) { c.first_curve = 1; }},
        {"n_curves", HM_ON_CURVE, HM_SLIP, [](hm_condition& c) { c.n_curves = 1; }},
        {"body", HM_RIGID, HM_RIGID, [](hm_condition& c) { c.body = 1; }},
        {"x or y", HM_RIGID, HM_ROTATION_PAIR, [](hm_condition& c) { c.x = 0.5; }},
        {"x or y", HM_RIGID, HM_ROTATION_PAIR, [](hm_condition& c) { c.y = -1e-300; }},
        {"x or y", HM_RIGID, HM_ROTATION_PAIR, [](hm_condition& c) { c.y = not_a_number; }},
        {"partner", HM_PERIODIC_PAIR, HM_ROTATION_PAIR, [](hm_condition& c) { c.partner = -7; }},
    };
    for (std::int32_t kind = HM_ON_CURVE; kind <= HM_INTERFACE; ++kind)
        for (auto const& field : fields) {
            if (field.kind == kind || field.also == kind) continue;
            if (field.kind == HM_PERIODIC_PAIR && kind == HM_INTERFACE) continue;
            Case setup = tiny_case();
            setup.add_condition(far_field, kind);
            setup.conditions[1].n_curves = kind == HM_ON_CURVE ? 1 : 0;
            field.set(setup.conditions[1]);
            Attempt const attempt(setup.problem());
            INFO("kind " << kind << ", " << std::string(field.name) << ": " << attempt.error.text);
            CHECK(attempt.status == HM_BAD_CONDITION);
            CHECK(attempt.error.item == 1);
            CHECK(says(attempt.error, field.name));
        }
}

TEST_CASE("nothing inside: a mesh all of whose points are on fixed markers and curves") {
    Case setup = tiny_case();
    setup.mesh = square(4, Cells::hybrid, 2, 2);
    setup.curves = polyline({{.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}});
    Attempt const attempt(setup.problem());
    CHECK(attempt.status == HM_BAD_CONDITION);
    CHECK(says(attempt.error, "nothing to solve"));
}

TEST_CASE("a region of the mesh in which no value is known is refused") {
    // A second square beside the first, all of whose sides are free: constants are in the matrix's
    // kernel.
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (int const n : {1, 2, 3, 10, 30}) {
            Case setup = tiny_case();
            Mesh island = square(n, kind);
            for (double& y : island.y) y *= 0.7;
            for (std::int32_t& marker : island.face_markers) marker = 50;
            std::int32_t const first = setup.mesh.append(island, 10, 1);
            setup.set_free(50);
            Attempt const attempt(setup.problem());
            INFO(n << " x " << n << ": " << attempt.reached << ": " << attempt.error.text);
            CHECK(attempt.status == HM_BAD_CONDITION);
            CHECK(attempt.error.item >= first);  // a point of the island
            CHECK(std::string(attempt.error.text) ==
                  "point " + std::to_string(attempt.error.item) +
                      " is in a region of the mesh in which no boundary is fixed or prescribed");
        }
}
