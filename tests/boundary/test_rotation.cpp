// Rotation pairs: one passage of an annulus is equivalent to the whole annulus.
#include <fixtures/displaced.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/cascade.hpp>

using namespace fixtures;

namespace {

constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};
constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};
constexpr int n_control = 8;

Field of_passage(Field const& all, std::vector<std::int32_t> const& number) {
    Field out;
    for (std::int32_t const k : number) out.push_back(all[std::size_t(k)]);
    return out;
}

void refused(Case& setup, hm_status status, const char* words, Options const& options) {
    Attempt const attempt(setup.problem(), &options);
    INFO(attempt.error.text);
    CHECK(attempt.status == status);
    CHECK(says(attempt.error, words));
}

}  // namespace

TEST_CASE("one passage moves as the annulus of turned copies for all operators and cells") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds)
            for (int const n : {2, 3, 5}) {
                INFO("operator " << operator_kind << ", cells " << int(kind) << ", passages " << n);
                Case one = passage(kind, n);
                std::vector<std::vector<std::int32_t>> number;
                Case all = annulus_of(one, n, number);
                Options const options = options_of(operator_kind);
                Solved const a(one, &options), b(all, &options);
                std::vector<double> const move = some_move(n_control, 0.05, 5);
                Field const found = displacement(a, move),
                            expected = displacement(b, turned_copies(move, n));
                CHECK(largest_difference(found, of_passage(expected, number[0])) < 1e-14);
                Complex const turn = turn_of_passage(n);
                CHECK(misfit_of_sides(one.mesh, found, turn) < 1e-16);
                CHECK(std::abs(found[std::size_t(points_on(one.mesh, left)[4])]) > 1e-4);
                CHECK(a.info().numbers_per_value == 2);
                Case fixed = one;
                fixed.conditions.pop_back();
                CHECK(largest_difference(displacement(Solved(fixed, &options), move), found) >
                      1e-4);
            }
}

TEST_CASE("a passage that is one cell wide has two sides that are one unknown") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds)
            for (int const n : {12, 30}) {
                Case one = bent(one_cell_apart(kind), n, 0.1);
                std::vector<std::vector<std::int32_t>> number;
                Case all = annulus_of(one, n, number);
                Options const options = options_of(operator_kind);
                std::vector<double> const move = some_move(4, 0.05, 7);
                Field const found = displacement(Solved(one, &options), move);
                Field const expected = displacement(Solved(all, &options), turned_copies(move, n));
                CHECK(largest_difference(found, of_passage(expected, number[0])) < 1e-14);
                CHECK(std::abs(found[4]) > 1e-4);
            }
}

TEST_CASE("one passage with thin cells gives the annulus") {
    int const n = 5;
    for (bool const at_sides : {false, true})
        for (std::int32_t const operator_kind : operators) {
            Case flat;
            flat.mesh = square(40, Cells::quads, 6, 6);
            auto const squeeze = [](double t) {
                return 0.5 * (1 + std::tanh(6 * (2 * t - 1)) / std::tanh(6.0));
            };
            for (double& t : at_sides ? flat.mesh.x : flat.mesh.y)
                t = squeeze(t);  // heights of 1e-6
            Case one = bent(flat, n, 0.3);
            std::vector<std::vector<std::int32_t>> number;
            Case all = annulus_of(one, n, number);
            Options options = options_of(operator_kind);
            Solved const a(one, &options), b(all, &options);
            std::vector<double> const move = some_move(one.curves.n_control(), 0.05, 3);
            Field const found = displacement(a, move),
                        expected = displacement(b, turned_copies(move, n));
            CHECK(largest_difference(found, of_passage(expected, number[0])) < 1e-11);
            CHECK(a.report.residual < 1e-11);
        }
}

TEST_CASE("any number of threads gives the same bits") {
    Case flat;
    flat.mesh = square(130, Cells::hybrid, 6, 6);  // several ranges of rows
    Case setup = bent(flat, 7, 0.3);
    std::vector<double> const move = some_move(setup.curves.n_control(), 0.05, 3);
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Options options = options_of(operator_kind);
        Field const expected = displacement(Solved(setup, &options), move);
        Backwards pool;
        hm_executor const executor = pool.executor(4);
        options.executor = &executor;
        Field const found = displacement(Solved(setup, &options), move);
        CHECK(pool.tasks > 4);
        CHECK(same_bits(found, expected));
    }
}

TEST_CASE("rigid bodies in a passage turn and move as turned copies") {
    for (std::int32_t const operator_kind : operators) {
        int const n = 3;
        Case one = passage(Cells::hybrid, n, 0.2);
        std::vector<std::vector<std::int32_t>> number;
        Case all = annulus_of(one, n, number);
        Complex const turn = turn_of_passage(n),
                      centre = 1.5 * std::polar(1.0, 0.5 * std::arg(turn));
        one.curves = {};
        one.conditions = {};
        all.curves = {};
        all.conditions = {};
        one.set_rotation(left, right);
        one.set_rigid(body, centre.real(), centre.imag());
        for (int m = 0; m < n; ++m) {
            Complex const c = centre * std::pow(turn, m);
            all.set_rigid(100 + m, c.real(), c.imag(), m);
        }
        Options const options = options_of(operator_kind);
        std::vector<double> const move = {0.02, -0.03, 0.1, 0.2};
        std::vector<double> copies;  // translations turn with the passage, rotations are the same
        for (int m = 0; m < n; ++m) {
            Complex const shift = Complex(move[0], move[1]) * std::pow(turn, m);
            copies.insert(copies.end(), {shift.real(), shift.imag(), move[2], move[3]});
        }
        Field const found = displacement(Solved(one, &options), move);
        Field const expected = of_passage(displacement(Solved(all, &options), copies), number[0]);
        CHECK(largest_difference(found, expected) < 1e-14);
    }
}

TEST_CASE("the order of the sides, the numbering, the orientation and the centre do not matter") {
    Case const origin = passage(Cells::hybrid, 5);
    std::vector<double> const move = some_move(n_control, 0.05, 7);
    for (std::int32_t const operator_kind : operators) {
        Options const options = options_of(operator_kind);
        Case setup = origin;
        Field const expected = displacement(Solved(setup, &options), move);

        Case changed = origin;
        changed.conditions.pop_back();
        changed.set_rotation(right, left);
        CHECK(largest_difference(displacement(Solved(changed, &options), move), expected) < 1e-14);

        changed = origin;
        std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 8);
        shuffle_cells(changed.mesh, 9);
        reverse_some(changed.mesh, 10);
        reverse_some_faces(changed.mesh, 11);
        CHECK(largest_difference(of_passage(displacement(Solved(changed, &options), move), new_of),
                                 expected) < 1e-14);

        Complex const turn = std::polar(2.0, 0.8);
        changed = similar(origin, turn, {3, 4});
        Field const moved = displacement(Solved(changed, &options), turned(move, turn));
        for (std::size_t k = 0; k < expected.size(); ++k)
            CHECK(std::abs(moved[k] / turn - expected[k]) < 1e-13);
    }
}

TEST_CASE("a pair in two pieces, each a pair of its own, works in either sense") {
    Case const whole = passage(Cells::hybrid, 5);
    std::vector<double> const move = some_move(n_control, 0.05, 7);
    for (bool const same_sense : {false, true}) {
        Case parts = whole;
        for (std::size_t face = 0; face < parts.mesh.face_markers.size(); ++face) {
            std::int32_t& marker = parts.mesh.face_markers[face];
            Complex const a = to_complex(parts.mesh.point(parts.mesh.faces[2 * face]));
            Complex const b = to_complex(parts.mesh.point(parts.mesh.faces[2 * face + 1]));
            if (std::abs(a) + std::abs(b) < radius_of_hub + radius_of_shroud) continue;
            if (marker == left) marker = 51;
            if (marker == right) marker = 52;
        }
        if (same_sense) parts.set_rotation(51, 52);
        else parts.set_rotation(52, 51);
        for (std::int32_t const operator_kind : operators) {
            Options const options = options_of(operator_kind);
            Case setup = whole;
            Field const expected = displacement(Solved(setup, &options), move);
            CHECK(largest_difference(displacement(Solved(parts, &options), move), expected) <
                  1e-14);
        }
    }
}

TEST_CASE("the adjoint is the transpose") {
    for (std::int32_t const operator_kind : operators) {
        Case setup = passage(Cells::hybrid, 7);
        Solved const solved(setup, options_of(operator_kind));
        check_adjoint(solved.basis, some_move(n_control, 0.5, 3), 1e-14);
    }
}

TEST_CASE("given displacements of a passage are those of the annulus, with the exact transpose") {
    int const n = 3;
    for (std::int32_t const operator_kind : operators) {
        Case curved = passage(Cells::hybrid, n);
        std::vector<std::vector<std::int32_t>> number;
        Case of_all = annulus_of(curved, n, number);
        Case one = given_instead(curved), all = given_instead(of_all);
        Options const options = options_of(operator_kind);
        Displaced a(one, &options), b(all, &options);
        Complex const turn = turn_of_passage(n);
        Field const some = some_field(curved.mesh.x.size(), 9, 0.03);
        Field everywhere(all.mesh.x.size());
        for (std::size_t m = 0; m < number.size(); ++m)
            for (std::size_t k = 0; k < some.size(); ++k)
                everywhere[std::size_t(number[m][k])] = some[k] * std::pow(turn, int(m));
        Field const found = a.displace(a.on_wall(some)),
                    expected = b.displace(b.on_wall(everywhere));
        CHECK(largest_difference(found, of_passage(expected, number[0])) < 1e-14);
        CHECK(misfit_of_sides(curved.mesh, found, turn) < 1e-16);
        Field const dj = some_field(found.size(), 10);
        CHECK(std::fabs(dot(a.adjoint(dj), a.on_wall(some)) - dot(found, dj)) <
              1e-14 * dot_of_sizes(found, dj));
    }
}

TEST_CASE("the centre where sides meet stays, and displacements obey the rotation") {
    int const n = 6;
    Complex const turn = turn_of_passage(n);
    for (std::int32_t const operator_kind : operators) {
        Case setup = passage(Cells::triangles, n, 0.0);  // filled up to the centre
        std::int32_t const centre = setup.mesh.add_point({0, 0});
        std::vector<std::int32_t> hub;
        for (std::size_t face = 0; face < setup.mesh.face_markers.size();) {
            if (setup.mesh.face_markers[face] != top) {
                ++face;
                continue;
            }
            std::int32_t const a = setup.mesh.faces[2 * face], b = setup.mesh.faces[2 * face + 1];
            setup.mesh.cells.insert(setup.mesh.cells.end(), {a, b, centre});
            setup.mesh.cell_start.push_back(std::int32_t(setup.mesh.cells.size()));
            hub.insert(hub.end(), {a, b});
            setup.mesh.face_markers.erase(setup.mesh.face_markers.begin() +
                                          static_cast<std::ptrdiff_t>(face));
            setup.mesh.faces.erase(
                setup.mesh.faces.begin() + static_cast<std::ptrdiff_t>(2 * face),
                setup.mesh.faces.begin() + static_cast<std::ptrdiff_t>(2 * face + 2));
        }
        std::int32_t first = -1, last = -1;
        for (std::int32_t const k : points_on(setup.mesh, left))
            if (std::fabs(std::abs(to_complex(setup.mesh.point(k))) - radius_of_hub) < 1e-12)
                first = k;
        for (std::int32_t const k : points_on(setup.mesh, right))
            if (std::fabs(std::abs(to_complex(setup.mesh.point(k))) - radius_of_hub) < 1e-12)
                last = k;
        setup.mesh.add_face(first, centre, left);
        setup.mesh.add_face(centre, last, right);
        Options const options = options_of(operator_kind);
        Field const found = displacement(Solved(setup, &options), some_move(n_control, 0.05, 5));
        CHECK(found[std::size_t(centre)] == 0.0);
        CHECK(std::abs(found[std::size_t(first)]) > 1e-4);
        CHECK(std::abs(found[std::size_t(last)] - turn * found[std::size_t(first)]) < 1e-17);
    }
}

TEST_CASE("markers that are no rotation pair are refused with the place") {
    Case const good = passage(Cells::quads, 5), translates = cascade(Cells::quads);
    Options const options = options_of(HM_CONFORMAL);
    Case setup = good;
    setup.mesh.y[std::size_t(points_on(setup.mesh, right)[4])] += 1e-4;
    Attempt const attempt(setup.problem(), &options);
    CHECK(attempt.status == HM_BAD_CONDITION);
    CHECK(says(attempt.error, "the rotated point is"));
    CHECK(attempt.error.item == points_on(setup.mesh, left)[4]);
    CHECK(attempt.error.value == doctest::Approx(1e-4).epsilon(0.3));
    struct {
        Case const& start;
        hm_status status;
        const char* words;
        void (*spoil)(Case&);
    } const cases[] = {
        {good, HM_OK, "",  // coordinates rounded as in a file
         [](Case& c) {
             for (std::int32_t const point : points_on(c.mesh, right))
                 c.mesh.x[std::size_t(point)] += 1e-8 * (point % 3);
         }},
        {good, HM_OK, "", [](Case& c) { c = similar(c, 1e-90, 0); }},
        {good, HM_OK, "", [](Case& c) { c = similar(c, 1e90, 0); }},
        {good, HM_BAD_CONDITION, "the rotated point is",
         [](Case& c) { c.conditions.back().x = 0.01; }},
        {good, HM_BAD_CONDITION, "a coordinate beyond 1e100",
         [](Case& c) { c.conditions.back().x = 1e101; }},
        {good, HM_BAD_CONDITION, "is not finite",
         [](Case& c) { c.conditions.back().x = std::nan(""); }},
        {good, HM_BAD_CONDITION, "the translated point is",
         [](Case& c) { c.conditions.back().kind = HM_PERIODIC_PAIR; }},
        {translates, HM_BAD_CONDITION, "the rotated point is",
         [](Case& c) { c.conditions.pop_back(), c.set_rotation(left, right); }},
        {good, HM_BAD_CONDITION, "are not rotated; use HM_PERIODIC_PAIR",  // a whole annulus, cut
         [](Case& c) { c = bent(cascade(Cells::quads, 0), 1, 0); }},
        {translates, HM_OK, "",  // a quarter turn about a corner
         [](Case& c) { c.conditions.pop_back(), c.set_rotation(bottom, left); }},
        {translates, HM_BAD_CONDITION, "has another centre or angle",
         [](Case& c) {
             c.conditions.pop_back(), c.set_rotation(bottom, left);
             c.set_rotation(right, top, 1, 1);
         }},
        {good, HM_BAD_CONDITION, "chooses a piece of a marker",
         [](Case& c) { c.conditions.back().piece = 1; }},
        {good, HM_UNSUPPORTED, "cannot be combined with slip", [](Case& c) { c.set_slip(right); }},
        {good, HM_BAD_CONDITION, "its own periodic partner",
         [](Case& c) { c.conditions.back().partner = left; }},
    };
    for (auto const& one : cases) {
        INFO("case " << &one - cases);
        Case spoiled = one.start;
        one.spoil(spoiled);
        refused(spoiled, one.status, one.words, options);
    }
}

TEST_CASE("combinations that rotation pairs do not support are refused by name") {
    Case setup = passage(Cells::quads, 5);
    for (std::int32_t const engine : {std::int32_t{HM_MULTIGRID}, std::int32_t{HM_FAS}}) {
        Options options = options_of(HM_LAPLACE);
        options.engine = engine;
        refused(setup, HM_UNSUPPORTED, "needs the direct engine", options);
    }
    for (std::int32_t const scheme : {std::int32_t{HM_BOUNDED}, std::int32_t{HM_NODAL_GRADIENT}}) {
        Options options = options_of(HM_LAPLACE);
        options.scheme = scheme;
        refused(setup, HM_UNSUPPORTED, "needs the compact scheme", options);
    }
    setup.set_periodic(top, bottom);
    refused(setup, HM_UNSUPPORTED, "cannot be combined with HM_PERIODIC_PAIR",
            options_of(HM_CONFORMAL));
}
