// Parts of meshes, cut in any way, together have the equations of the whole mesh and its functions.
#include "fixtures/parted.hpp"
#include "fixtures/polygons.hpp"
#include "fixtures/refused.hpp"

using namespace fixtures;

namespace {

hm_options with(std::int32_t operator_kind) {
    hm_options out{};
    out.struct_size = sizeof out;
    out.operator_kind = operator_kind;
    return out;
}

void check_agreement(Case& its, hm_options const& options, Partition const& partition, bool ghosts,
                     double within = 1e-11) {
    Solved const whole(its, &options);
    Parted parted(cut(its.mesh, partition, ghosts));
    REQUIRE(parted.match());
    bool const equated = parted.equate(its.problem(), options);
    INFO(parted.error.text);
    REQUIRE(equated);
    CHECK(parted.size() == static_cast<std::size_t>(whole.report.unknowns * parted.parts[0].info().numbers));
    parted.solve();
    CHECK(parted.difference(whole) < within);
    for (PartOfMesh const& part : parted.parts) CHECK(info_of(part.rows).solved == 1);
}

// Morph, step and quality of parts, after a movement of this size, and the sum of their adjoints.
void check_judgement(Case& its, hm_options const& options, double size, double within = 1e-13) {
    Solved const whole(its, &options);
    Parted parted(cut(its.mesh, stripes(its.mesh, 3), true));
    REQUIRE(parted.match());
    REQUIRE(parted.equate(its.problem(), options));
    parted.solve();
    std::vector<double> const move = some_move(whole.info().control_points, size, 3);
    std::size_t const n = its.mesh.x.size();
    std::vector<double> x(n), y(n), gradient(move.size(), 0.0);
    hm_points_out const all{x.data(), y.data(), 1};
    REQUIRE(hm_morph(whole.basis, move.data(), nullptr, &all, nullptr, nullptr) == HM_OK);
    hm_step_report step{};
    hm_quality_report quality{};
    step.struct_size = sizeof step;
    quality.struct_size = sizeof quality;
    hm_points const moved{x.data(), y.data(), 1};
    REQUIRE(hm_assess(whole.basis, &its.mesh_view(), nullptr, &moved, nullptr, &step, &quality, nullptr) == HM_OK);
    double admissible = 1e300, least = 1;
    std::int32_t cells = 0, inverted = 0;
    for (PartOfMesh& part : parted.parts) {
        std::size_t const own = part.mesh.x.size();
        std::vector<double> dx(own), dy(own);
        hm_points_out const to{dx.data(), dy.data(), 1};
        REQUIRE(hm_morph(part.rows, move.data(), nullptr, &to, nullptr, nullptr) == HM_OK);
        double worst = 0;
        for (std::size_t k = 0; k < own; ++k) {
            std::size_t const at = static_cast<std::size_t>(part.global_point[k]);
            worst = std::max({worst, std::fabs(dx[k] - x[at]), std::fabs(dy[k] - y[at])});
        }
        CHECK(worst < within);
        hm_mesh mesh{};
        mesh.struct_size = sizeof mesh;
        const std::int32_t* cell = nullptr;
        REQUIRE(hm_part_cells(part.part, &mesh, &cell, nullptr) == HM_OK);
        cells += mesh.n_cells;
        hm_step_report its_step{};
        hm_quality_report its_quality{};
        its_step.struct_size = sizeof its_step;
        its_quality.struct_size = sizeof its_quality;
        hm_points const displacement{dx.data(), dy.data(), 1};
        REQUIRE(hm_assess(part.rows, &mesh, nullptr, &displacement, nullptr, &its_step, &its_quality, nullptr) ==
                HM_OK);
        admissible = std::min(admissible, its_step.admissible);
        least = std::min(least, its_quality.min_quality);
        inverted += its_quality.inverted;
    }
    // Every point of the mesh counts in the first part that has it.
    std::vector<double> dj_x(n), dj_y(n), expected(move.size()), sum(move.size(), 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        dj_x[k] = std::sin(1.7 * static_cast<double>(k));
        dj_y[k] = std::cos(2.3 * static_cast<double>(k));
    }
    hm_points const dj{dj_x.data(), dj_y.data(), 1};
    REQUIRE(hm_adjoint(whole.basis, &dj, expected.data(), nullptr, nullptr) == HM_OK);
    std::vector<bool> counted(n, false);
    for (PartOfMesh& part : parted.parts) {
        std::vector<double> own_x, own_y;
        for (std::int32_t const point : part.global_point) {
            std::size_t const at = static_cast<std::size_t>(point);
            own_x.push_back(counted[at] ? 0 : dj_x[at]);
            own_y.push_back(counted[at] ? 0 : dj_y[at]);
            counted[at] = true;
        }
        hm_points const own{own_x.data(), own_y.data(), 1};
        REQUIRE(hm_adjoint(part.rows, &own, gradient.data(), nullptr, nullptr) == HM_OK);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += gradient[k];
    }
    for (std::size_t k = 0; k < sum.size(); ++k) CHECK(std::fabs(sum[k] - expected[k]) < 1e-9);

    CHECK(cells == its.mesh.n_cells());
    CHECK(inverted == quality.inverted);
    CHECK(admissible == doctest::Approx(step.admissible).epsilon(1e-9));
    CHECK(least == doctest::Approx(quality.min_quality).epsilon(1e-9));
}

// Two ellipses, projected parameters.
Case airfoils() { return two_body_case(Cells::hybrid, 8, 5); }

} // namespace

TEST_CASE("functions of parts are those of the whole mesh, for each operator and any partition") {
    Case its = airfoils();
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
        hm_options const options = with(operator_kind);
        CAPTURE(operator_kind);
        check_agreement(its, options, stripes(its.mesh, 1), false);
        check_agreement(its, options, stripes(its.mesh, 3), false);
        check_agreement(its, options, at_random(its.mesh, 4), false);
        check_agreement(its, options, stripes(its.mesh, 2), true);
    }
}

TEST_CASE("rigid bodies, sliding and free boundaries, offset correction in parts") {
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        hm_options options = with(operator_kind);
        CAPTURE(operator_kind);
        Case rigid = airfoils();
        rigid.conditions.clear();
        rigid.put_on_curves(body, 0);
        rigid.set_rigid(second_body, 0.4, 0.6);
        check_agreement(rigid, options, stripes(rigid.mesh, 3), true);
        Case slip = airfoils();
        slip.set_slip(far_field);
        check_agreement(slip, options, at_random(slip.mesh, 3), false);
        check_agreement(slip, options, stripes(slip.mesh, 2), true);
        if (operator_kind == HM_CONFORMAL) {
            options.offset_correction = 1;
            Case its = airfoils();
            check_agreement(its, options, stripes(its.mesh, 2), false);
        } else {
            Case free = airfoils();
            free.set_free(far_field);
            check_agreement(free, options, at_random(free.mesh, 3), false);
        }
    }
}

TEST_CASE("periodic pairs whose sides lie in different parts") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
            Case its = cascade(kind);
            check_agreement(its, with(operator_kind), at_random(its.mesh, 3), false);
            check_agreement(its, with(operator_kind), stripes(its.mesh, 4), true);
        }
    }
}

TEST_CASE("cuts between and inside parts") {
    Case its = ring_case(6, 24, 1, 3);
    its.given_points.clear();
    its.given_curves.clear();
    its.given_u.clear();
    // The points at angle 0 a second time, for the cells behind them: a seam.
    Mesh& mesh = its.mesh;
    std::vector<std::int32_t> twin(mesh.x.size(), -1);
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        double y = 0;
        for (std::int32_t k = mesh.cell_start[cell]; k < mesh.cell_start[cell + 1]; ++k)
            y += mesh.y[static_cast<std::size_t>(mesh.cells[static_cast<std::size_t>(k)])];
        for (std::int32_t k = mesh.cell_start[cell]; y < 0 && k < mesh.cell_start[cell + 1]; ++k) {
            std::int32_t& point = mesh.cells[static_cast<std::size_t>(k)];
            std::size_t const at = static_cast<std::size_t>(point);
            if (mesh.x[at] < 0 || std::fabs(mesh.y[at]) > 1e-9) continue;
            if (twin[at] < 0) {
                twin[at] = mesh.add_point(mesh.point(point));
                twin.resize(mesh.x.size(), -1);
            }
            point = twin[at];
        }
    }
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        std::size_t const a = static_cast<std::size_t>(mesh.faces[2 * face]),
                          b = static_cast<std::size_t>(mesh.faces[2 * face + 1]);
        if (mesh.y[a] + mesh.y[b] >= 0) continue;
        for (std::size_t const k : {2 * face, 2 * face + 1})
            if (twin[static_cast<std::size_t>(mesh.faces[k])] >= 0)
                mesh.faces[k] = twin[static_cast<std::size_t>(mesh.faces[k])];
    }
    REQUIRE(mesh.n_points() == ring_case(6, 24, 1, 3).mesh.n_points() + 7);
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        check_agreement(its, with(operator_kind), stripes(mesh, 1), false);
        check_agreement(its, with(operator_kind), stripes(mesh, 3), true);
        check_agreement(its, with(operator_kind), at_random(mesh, 4), false);
    }
}

TEST_CASE("given displacements in parts") {
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        for (bool const slides : {false, true}) {
            Case its = given_instead(airfoils());
            if (slides) its.set_slip(far_field);
            hm_options const options = with(operator_kind);
            Displaced whole(its, &options);
            Field wanted(its.mesh.x.size());
            for (std::int32_t const point : whole.points)
                wanted[static_cast<std::size_t>(point)] = {0.01 * std::sin(3.0 * point), 0.02 * std::cos(5.0 * point)};
            Field const expected = whole.displace(whole.on_wall(wanted));
            Parted parted(cut(its.mesh, at_random(its.mesh, 3), true));
            REQUIRE(parted.match());
            REQUIRE(parted.equate(its.problem(), options));
            std::vector<Field> const found = parted.displace(wanted);
            double worst = 0;
            for (std::size_t p = 0; p < found.size(); ++p)
                for (std::size_t k = 0; k < found[p].size(); ++k)
                    worst =
                        std::max(worst, std::abs(found[p][k] -
                                                 expected[static_cast<std::size_t>(parted.parts[p].global_point[k])]));
            CHECK(worst < 1e-12);
        }
    }
}

TEST_CASE("morph, adjoint, step and quality of parts are those of the whole mesh") {
    Case its = airfoils();
    check_judgement(its, with(HM_CONFORMAL), 0.02);
    check_judgement(its, with(HM_CONFORMAL), 2);   // inverts cells
}

TEST_CASE("polygons in parts: divided as in the whole mesh, and judged so") {
    Case honeycombs, hanging;
    honeycombs.mesh = honeycomb(6, 24, 0.5, 4);
    honeycombs.curves = ring(3, 8, 0.5, 0.5);
    honeycombs.put_on_curves(body);
    hanging.mesh = refined(square(12, Cells::quads, 4, 4),
                           [](Point p) { return std::fabs(p.x - 0.5) < 0.3 && std::fabs(p.y - 0.5) < 0.3; });
    hanging.curves = polyline({{1.0 / 3, 1.0 / 3}, {2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1.0 / 3, 2.0 / 3}});
    hanging.put_on_curves(body);
    for (Case* const its : {&honeycombs, &hanging}) {
        its->mesh.cell_layout = HM_CELLS_POLYGONS;
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
            CAPTURE(operator_kind);
            check_agreement(*its, with(operator_kind), stripes(its->mesh, 1), false);
            check_agreement(*its, with(operator_kind), at_random(its->mesh, 3), false);
            check_agreement(*its, with(operator_kind), stripes(its->mesh, 3), true);
        }
        check_judgement(*its, with(HM_CONFORMAL), 0.02);
        check_judgement(*its, with(HM_CONFORMAL), 0.4);   // inverts cells
    }
}

TEST_CASE("rows of a part are combined like any basis") {
    Case its = airfoils();
    hm_options const options = with(HM_CONFORMAL);
    Solved const whole(its, &options);
    Parted parted(cut(its.mesh, stripes(its.mesh, 2), false));
    REQUIRE(parted.match());
    REQUIRE(parted.equate(its.problem(), options));
    parted.solve();
    std::vector<double> matrix;
    for (std::int32_t k = 0; k < 2 * whole.info().control_points; ++k) matrix.push_back(std::cos(3.0 * k));
    auto const combined = [&](const hm_basis* from, std::unique_ptr<Guarded>& block) {
        std::size_t bytes = 0;
        hm_basis* out = nullptr;
        REQUIRE(hm_combine_size(from, 2, 1, &bytes, nullptr) == HM_OK);
        block = std::make_unique<Guarded>(bytes);
        REQUIRE(hm_combine(&out, block->data(), bytes, from, 2, 1, matrix.data(), nullptr) == HM_OK);
        return out;
    };
    std::unique_ptr<Guarded> whole_block, part_block;
    const hm_basis* const all = combined(whole.basis, whole_block);
    std::vector<double> all_values(its.mesh.x.size());
    for (PartOfMesh& part : parted.parts) {
        const hm_basis* const own = combined(part.rows, part_block);
        std::vector<double> values(part.mesh.x.size());
        for (std::int32_t number = 0; number < 2; ++number) {
            REQUIRE(hm_basis_values(all, 1, number, all_values.data(), nullptr) == HM_OK);
            REQUIRE(hm_basis_values(own, 1, number, values.data(), nullptr) == HM_OK);
            double worst = 0;
            for (std::size_t k = 0; k < values.size(); ++k) {
                std::size_t const at = static_cast<std::size_t>(part.global_point[k]);
                worst = std::max(worst, std::fabs(values[k] - all_values[at]));
            }
            CHECK(worst < 1e-11);
        }
    }
}

TEST_CASE("parts that do not fit together are refused with the place") {
    Case its = airfoils();
    Partition const partition = stripes(its.mesh, 2);
    auto const refusal = [&](std::function<void(std::vector<PartOfMesh>&)> const& spoil) {
        std::vector<PartOfMesh> parts = cut(its.mesh, partition, false);
        spoil(parts);
        Parted parted(std::move(parts));
        bool const accepted = parted.match() && parted.equate(its.problem(), with(HM_LAPLACE));
        CHECK(!accepted);
        CHECK(parted.status == HM_BAD_MESH);
        CHECK(parted.error.text[0] != 0);
        return std::string(parted.error.text);
    };
    auto const has = [](std::string const& text, const char* words) {
        CAPTURE(text);
        CAPTURE(std::string(words));
        CHECK(text.find(words) != std::string::npos);
    };
    auto const shared_point = [&](std::vector<PartOfMesh> const& parts) {
        std::set<std::int64_t> const first(parts[0].numbers.begin(), parts[0].numbers.end());
        for (std::size_t k = 0; k < parts[1].numbers.size(); ++k)
            if (first.count(parts[1].numbers[k]) > 0) return k;
        return std::size_t{0};
    };
    has(refusal([&](std::vector<PartOfMesh>& parts) { parts[1].mesh.x[shared_point(parts)] += 1e-9; }),
        "(global number) has different coordinates in two parts");
    has(refusal([&](std::vector<PartOfMesh>& parts) { // two numbers in each other's place
            std::size_t const at = shared_point(parts);
            std::swap(parts[1].numbers[at], parts[1].numbers[at == 0 ? 1 : 0]);
        }),
        "");
    has(refusal([&](std::vector<PartOfMesh>& parts) { parts[1].numbers[0] = parts[1].numbers[1]; }),
        "same global number");
    has(refusal([&](std::vector<PartOfMesh>& parts) { parts[0].numbers[3] = -1; }), "not between 0 and 2^61");
    has(refusal([&](std::vector<PartOfMesh>& parts) {
            parts[0].mesh.faces.resize(parts[0].mesh.faces.size() - 2);
            parts[0].mesh.face_markers.pop_back();
        }),
        "no marker");
    has(refusal([&](std::vector<PartOfMesh>& parts) { // a cell less: a gap
            Mesh& mesh = parts[1].mesh;
            mesh.cells.resize(static_cast<std::size_t>(mesh.cell_start[mesh.cell_start.size() - 2]));
            mesh.cell_start.pop_back();
        }),
        "edge");
    has(refusal([&](std::vector<PartOfMesh>& parts) { // a marker on an edge that has cells on both sides
            std::set<std::int64_t> const first(parts[0].numbers.begin(), parts[0].numbers.end());
            Mesh& mesh = parts[1].mesh;
            for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell)
                for (std::int32_t k = mesh.cell_start[cell]; k + 1 < mesh.cell_start[cell + 1]; ++k) {
                    std::int32_t const a = mesh.cells[static_cast<std::size_t>(k)],
                                       b = mesh.cells[static_cast<std::size_t>(k) + 1];
                    if (first.count(parts[1].numbers[static_cast<std::size_t>(a)]) == 0) continue;
                    if (first.count(parts[1].numbers[static_cast<std::size_t>(b)]) == 0) continue;
                    mesh.add_face(a, b, far_field);
                    return;
                }
        }),
        "(global numbers) is marked, but two parts have cells there");
    has(refusal([&](std::vector<PartOfMesh>& parts) { // a part twice
            PartOfMesh copy;
            copy.mesh = parts[0].mesh;
            copy.numbers = parts[0].numbers;
            copy.global_point = parts[0].global_point;
            parts.push_back(std::move(copy));
        }),
        "cells of two parts overlap at the edge between points");
    has(refusal([&](std::vector<PartOfMesh>& parts) { // two corners in one place
            Mesh& mesh = parts[0].mesh;
            std::size_t const one = static_cast<std::size_t>(mesh.cells[0]);
            std::size_t const other = static_cast<std::size_t>(mesh.cells[1]);
            mesh.x[one] = mesh.x[other];
            mesh.y[one] = mesh.y[other];
        }),
        "is inverted or empty: its smallest corner area is");
}

TEST_CASE("the conditions of a whole mesh are refused in parts as well") {
    Case its = airfoils();
    Parted parted(cut(its.mesh, stripes(its.mesh, 2), false));
    REQUIRE(parted.match());
    its.conditions[0].marker = 77;
    CHECK(!parted.equate(its.problem(), with(HM_LAPLACE)));
    CHECK(parted.status == HM_BAD_CONDITION);
    its.conditions[0].marker = body;
    auto const refusal = [&](std::function<void(hm_options&)> const& spoil) {
        hm_options options = with(HM_LAPLACE);
        spoil(options);
        CHECK(!parted.equate(its.problem(), options));
        CHECK(parted.status == HM_UNSUPPORTED);
        return std::string(parted.error.text);
    };
    CHECK(refusal([](hm_options& o) { o.scheme = HM_BOUNDED; }) == "meshes in parts go with the compact scheme only");
    CHECK(refusal([](hm_options& o) { o.engine = HM_MULTIGRID; }) ==
          "meshes in parts: options.engine must be HM_DIRECT");
    CHECK(refusal([](hm_options& o) { o.precision = HM_SINGLE; }) ==
          "meshes in parts: options.precision must be HM_DOUBLE");
    its.set_rotation(its.conditions[0].marker + 50, its.conditions[0].marker + 51);
    CHECK(refusal([](hm_options&) {}) == "meshes in parts do not go with HM_ROTATION_PAIR; HM_PERIODIC_PAIR does");
    its.conditions.pop_back();
    its.set_slip(far_field);
    its.conditions.back().along = &its.curves.view();
    its.conditions.back().n_curves = its.conditions.back().along->n_curves;
    CHECK(refusal([](hm_options&) {}) ==
          "meshes in parts do not go with curves that are given for sliding (hm_condition.along)");
    its.conditions.pop_back();
    its.give(0, 0.5);
    CHECK(refusal([](hm_options&) {}) == "meshes in parts: problem.n_given must be 0");
}

TEST_CASE("calls with parts, equations and rows that do not go together") {
    Case its = airfoils();
    Parted parted(cut(its.mesh, stripes(its.mesh, 2), false)), conformal(cut(its.mesh, stripes(its.mesh, 2), false));
    REQUIRE(parted.match());
    REQUIRE(conformal.match());
    PartOfMesh& one = parted.parts[0];
    std::int32_t n = 0, none = 0;
    hm_part_edges(one.part, nullptr, 0, &n, nullptr);
    REQUIRE(parted.equate(its.problem(), with(HM_LAPLACE)));
    REQUIRE(conformal.equate(its.problem(), with(HM_CONFORMAL)));
    parted.solve();
    std::size_t bytes = 0;
    REQUIRE(hm_rows_size(one.equations, &bytes, nullptr) == HM_OK);
    Guarded block(bytes);
    hm_basis* rows = nullptr;
    REQUIRE(hm_rows_init(&rows, block.data(), bytes, one.equations, nullptr) == HM_OK);
    hm_equations* const of_others = conformal.parts[0].equations;
    std::vector<double> numbers(parted.size() * 4);
    std::int64_t entries = 0, negative = -1;
    hm_problem problem = its.problem();
    hm_options const options = with(HM_LAPLACE);
    hm_mesh const view = its.mesh.view();
    hm_part_mesh no_size{};
    no_size.mesh = &view;
    auto const entries_from = [&](std::int32_t first, hm_error* e) {
        return hm_equations_entries(one.equations, first, 1, nullptr, nullptr, nullptr, 0, &entries, e);
    };
    std::string const room = "edges has room for " + std::to_string(n - 1) + ", the part has " + std::to_string(n);
    check_texts({
        {HM_BAD_ARGUMENT, "part is NULL", [&](hm_error* e) { return hm_part_edges(nullptr, nullptr, 0, &none, e); }},
        {HM_BAD_ARGUMENT, "equations is NULL", [&](hm_error* e) { return hm_rows_size(nullptr, &bytes, e); }},
        {HM_BAD_ARGUMENT, "the struct_size of the part is not set",
         [&](hm_error* e) { return hm_part_size(&no_size, &bytes, e); }},
        {HM_BAD_ARGUMENT, room.c_str(),
         [&](hm_error* e) { return hm_part_edges(one.part, parted.edges.data(), n - 1, &none, e); }},
        {HM_BAD_ARGUMENT, "the number of edges is negative",
         [&](hm_error* e) { return hm_match_edges(nullptr, &negative, e); }},
        {HM_BAD_ARGUMENT, "n_edges must be between 0 and 2^29, not -1",
         [&](hm_error* e) { return hm_equations_size(one.part, -1, &problem, &options, &bytes, e); }},
        {HM_BAD_ARGUMENT, "from unknown -1 (from 0) on there are no 1 unknowns",
         [&](hm_error* e) { return entries_from(-1, e); }},
        {HM_BAD_ARGUMENT, "there is room for fewer entries than there are",
         [&](hm_error* e) { return entries_from(0, e); }},
        {HM_BAD_BASIS, "the rows were made of other equations",
         [&](hm_error* e) { return hm_rows_get(of_others, rows, 0, numbers.data(), e); }},
        {HM_BAD_BASIS, "the rows are finished: make new ones by hm_rows_init",
         [&](hm_error* e) { return hm_rows_finish(one.equations, one.rows, 0, e); }},
        {HM_BAD_ARGUMENT, "largest must be finite and not negative, not -1",
         [&](hm_error* e) { return hm_rows_finish(one.equations, rows, -1, e); }},
        {HM_BAD_ARGUMENT, "largest must be finite and not negative, not infinity",
         [&](hm_error* e) { return hm_rows_finish(one.equations, rows, HUGE_VAL, e); }},
    });
}
