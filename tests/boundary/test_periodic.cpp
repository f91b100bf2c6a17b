// Periodic pairs: both sides move alike, and one period is equivalent to many.
#include <fixtures/cascade.hpp>

using namespace fixtures;

namespace {

constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};
constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

std::vector<double> repeated(std::vector<double> const& move, int n) {
    std::vector<double> out;
    for (int k = 0; k < n; ++k) out.insert(out.end(), move.begin(), move.end());
    return out;
}

hm_status refused(Case& setup, const char* words, std::int32_t item) {
    Options const options = options_of(HM_CONFORMAL);
    Attempt const attempt(setup.problem(), &options);
    INFO(attempt.error.text);
    CHECK(says(attempt.error, words));
    CHECK(attempt.error.item == item);
    return attempt.status;
}

// Gives another marker to the faces of the right side that begin at such heights.
void mark_right(Case& setup, bool (*at)(double)) {
    for (std::size_t face = 0; face < setup.mesh.face_markers.size(); ++face)
        if (setup.mesh.face_markers[face] == right &&
            at(setup.mesh.point(setup.mesh.faces[2 * face]).y))
            setup.mesh.face_markers[face] = 50;
}

}  // namespace

TEST_CASE("both sides of a periodic pair move alike to the last bit, and not only along the wall") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds) {
            Case setup = cascade(kind);
            Solved const solved(setup, options_of(operator_kind));
            Field const moved = displacement(solved, some_move(4, 1, 4));
            for (std::size_t j = 0; j <= 8; ++j) {
                std::vector<std::int32_t> const l = points_on(setup.mesh, left),
                                                r = points_on(setup.mesh, right);
                Complex const a = moved[std::size_t(l[j])], b = moved[std::size_t(r[j])];
                CHECK(a == b);
                CHECK((j == 0 || j == 8 ? a == 0.0
                                        : std::abs(a) > 1e-3));  // top and bottom are fixed
            }
        }
}

TEST_CASE("two and three periods with bodies that move alike are one period, repeated") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds)
            for (int const n : {2, 3}) {
                Case one = cascade(kind), many = periods(one, n);
                Options const options = options_of(operator_kind);
                Solved const a(one, &options), b(many, &options);
                std::vector<double> const move = some_move(4, 0.3, 5);
                Field const expected = displacement(a, move);
                Field found = displacement(b, repeated(move, n));
                found.resize(expected.size());
                // Weights take the bodies of all periods into account where there are several, and
                // one where there is one.
                bool const weighted = operator_kind != HM_LAPLACE;
                CHECK(largest_difference(found, expected) < (weighted ? 1e-2 : 1e-13));
                Case fixed = one;
                fixed.conditions.pop_back();
                Solved const c(fixed, &options);
                CHECK(largest_difference(displacement(c, move), expected) > 3e-2);
            }
}

TEST_CASE("weighted and conformal functions count the wall's images in other periods") {
    for (std::int32_t const kind : {HM_CONFORMAL, HM_WEIGHTED})
        for (double const exponent : {-1, 1, 4})
            for (int const n : {2, 3}) {
                Case one = cascade(Cells::hybrid), several = periods(one, n);
                Options const options = options_of(kind, exponent);
                Solved const a(one, &options), b(several, &options);
                std::vector<double> const move = some_move(4, 0.3, 6);
                Field const expected = displacement(a, move);
                Field found = displacement(b, repeated(move, n));
                found.resize(expected.size());
                CHECK(largest_difference(found, expected) < 1e-12);
            }
}

TEST_CASE("the place where the mesh is cut does not matter, and the mesh may be turned") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL})
        for (int const column : {1, 2})
            for (Cells const cells : kinds)
                for (Complex const turn : {Complex(1, 0), std::polar(3.0, 0.8)}) {
                    std::vector<std::int32_t> number;
                    Case a = similar(cascade(cells), turn, {1, 2});
                    Case b = similar(cut_elsewhere(cells, column, number), turn, {1, 2});
                    Options const options = options_of(kind);
                    std::vector<double> const move = some_move(4, 0.3, 6);
                    Field const expected = displacement(Solved(a, &options), move);
                    Field const all = displacement(Solved(b, &options), move);
                    Field found;
                    for (std::int32_t const k : number) found.push_back(all[std::size_t(k)]);
                    CHECK(largest_difference(found, expected) < 1e-12);
                }
}

TEST_CASE("a pair one cell apart is one period of many for every scheme and engine") {
    struct {
        std::int32_t operator_kind;
        double exponent;
        std::int32_t scheme, engine;
        bool slip;
    } const all[] = {{HM_CONFORMAL, -1, HM_COMPACT, HM_DIRECT, false},
                     {HM_LAPLACE, 0, HM_COMPACT, HM_DIRECT, true},
                     {HM_LAPLACE, 0, HM_COMPACT, HM_DIRECT, false},
                     {HM_LAPLACE, 0, HM_COMPACT, HM_MULTIGRID, false},
                     {HM_LAPLACE, 0, HM_COMPACT, HM_FAS, false},
                     {HM_LAPLACE, 0, HM_NODAL_GRADIENT, HM_DIRECT, false},
                     {HM_LAPLACE, 0, HM_NODAL_GRADIENT, HM_FAS, false}};
    for (auto const& way : all)
        for (Cells const kind : kinds) {
            Case one = one_cell_apart(kind);
            if (way.slip) one.set_slip(top);
            Case two = periods(one, 2);
            Options options = options_of(way.operator_kind, way.exponent);
            options.scheme = way.scheme;
            options.engine = way.engine;
            INFO("operator " << way.operator_kind << ", scheme " << way.scheme << ", engine "
                             << way.engine);
            std::vector<double> const move = some_move(4, 0.3, 7);
            Field const expected = displacement(Solved(one, &options), move);
            Field found = displacement(Solved(two, &options), repeated(move, 2));
            found.resize(expected.size());
            CHECK(largest_difference(found, expected) < (way.engine == HM_DIRECT ? 1e-13 : 1e-9));
            CHECK(std::abs(expected[4]) > 1e-3);
            CHECK(expected[4] == expected[5]);
        }
}

TEST_CASE("numbering, orientation and the order of markers do not change a periodic pair") {
    Case const origin = cascade(Cells::hybrid);
    Options const options = options_of(HM_CONFORMAL);
    std::vector<double> const move = some_move(4, 0.3, 7);
    Case setup = origin;
    Solved const reference(setup, &options);
    Field const expected = displacement(reference, move);

    Case changed = origin;
    changed.conditions.pop_back();
    changed.set_periodic(right, left);
    CHECK(largest_difference(displacement(Solved(changed, &options), move), expected) < 1e-13);

    changed = origin;
    std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 8);
    shuffle_cells(changed.mesh, 9);
    reverse_some(changed.mesh, 10);
    reverse_some_faces(changed.mesh, 11);
    Field const mangled = displacement(Solved(changed, &options), move);
    for (std::size_t k = 0; k < expected.size(); ++k)
        CHECK(std::abs(mangled[std::size_t(new_of[k])] - expected[k]) < 1e-12);

    Complex const turn = std::polar(2.0, 0.8);
    changed = similar(origin, turn, {3, 4});
    Field const turned_field = displacement(Solved(changed, &options), turned(move, turn));
    for (std::size_t k = 0; k < expected.size(); ++k)
        CHECK(std::abs(turned_field[k] / turn - expected[k]) < 1e-12);

    changed = origin;  // sheared: the sides are slanting, and still translates
    for (std::size_t k = 0; k < changed.mesh.x.size(); ++k)
        changed.mesh.x[k] += 0.3 * changed.mesh.y[k];
    for (std::size_t k = 0; k < changed.curves.control.size(); k += 2)
        changed.curves.control[k] += 0.3 * changed.curves.control[k + 1];
    Solved const sheared(changed, &options);
    Field const moved = displacement(sheared, move);
    for (std::size_t j = 0; j <= 8; ++j)
        CHECK(moved[std::size_t(points_on(changed.mesh, left)[j])] ==
              moved[std::size_t(points_on(changed.mesh, right)[j])]);
}

TEST_CASE("the four corners of two pairs are one point, and a translation moves the whole mesh") {
    for (std::int32_t const operator_kind : operators) {
        Case setup = cascade(Cells::hybrid);
        setup.set_periodic(top, bottom);
        Solved const solved(setup, options_of(operator_kind));
        Field const moved = displacement(solved, some_move(4, 0.2, 12));
        std::size_t const last =
            moved.size() - 1;  // the corners: the mesh's first and last points, and two more
        std::vector<std::int32_t> const b = points_on(setup.mesh, bottom),
                                        t = points_on(setup.mesh, top);
        CHECK(moved[0] == moved[last]);
        CHECK(moved[std::size_t(b.back())] == moved[0]);
        CHECK(moved[std::size_t(t.front())] == moved[0]);
        CHECK(std::abs(moved[0]) > 1e-3);
        Field const translated =
            displacement(solved, similarity_move(setup.curves, 1, 0, {0.5, -1}));
        for (Complex const d : translated) CHECK(std::abs(d - Complex(0.5, -1)) < 1e-12);
    }
}

TEST_CASE("a periodic pair may end on slip lines and on free boundaries") {
    Case setup = cascade(Cells::hybrid);
    setup.set_slip(top);
    Options options = options_of(HM_CONFORMAL);
    Solved const slipping(setup, &options);
    Field const moved = displacement(slipping, some_move(4, 0.2, 13));
    std::size_t const corner[] = {moved.size() - 9, moved.size() - 1};
    CHECK(moved[corner[0]] == moved[corner[1]]);
    CHECK(moved[corner[0]].imag() == 0);
    CHECK(std::abs(moved[corner[0]]) > 1e-4);
    setup.conditions.back().kind = HM_FREE;
    options = options_of(HM_LAPLACE);
    Solved const free_top(setup, &options);
    Field const freely = displacement(free_top, some_move(4, 0.2, 13));
    CHECK(freely[corner[0]] == freely[corner[1]]);
    CHECK(std::fabs(freely[corner[0]].imag()) > 1e-4);
}

TEST_CASE("a point at the end of a pair on slip lines of two directions cannot slide") {
    for (double const slope : {0.3, 0.0}) {
        Case setup = cascade(Cells::hybrid, 0, 0);  // the top is a roof
        for (std::size_t k = 0; k < setup.mesh.x.size(); ++k)
            setup.mesh.y[k] += slope * (0.5 - std::fabs(setup.mesh.x[k] - 0.5)) *
                               std::fmax(setup.mesh.y[k] - 0.75, 0.0) * 4;
        setup.set_slip(top);
        Solved const solved(setup, options_of(HM_CONFORMAL));
        Field const moved = displacement(solved, some_move(4, 0.2, 14));
        std::vector<std::int32_t> const roof = points_on(setup.mesh, top);
        Complex const a = moved[std::size_t(roof.front())], b = moved[std::size_t(roof.back())];
        CHECK(a == b);
        CHECK((slope == 0 ? std::abs(a) > 1e-4 : a == 0.0));
        Complex const beside = moved[std::size_t(roof[1])];
        CHECK(std::abs(beside) > 1e-4);
        CHECK(std::fabs(beside.imag() - slope * beside.real()) < 1e-15);
    }
}

TEST_CASE("markers that are no periodic pair are refused with the place") {
    Case const good = cascade(Cells::quads);
    Case setup = good;
    setup.mesh.y[std::size_t(points_on(setup.mesh, right)[4])] += 1e-4;
    Options const options = options_of(HM_CONFORMAL);
    {
        Attempt const attempt(setup.problem(), &options);
        CHECK(attempt.status == HM_BAD_CONDITION);
        CHECK(says(attempt.error, "the translated point is"));
        std::int32_t const l = points_on(setup.mesh, left)[4], r = points_on(setup.mesh, right)[4];
        CHECK((attempt.error.item == l || attempt.error.item == r));
        CHECK(attempt.error.value == doctest::Approx(1e-4).epsilon(0.2));
    }
    setup = good;  // coordinates rounded as in a file
    for (std::int32_t const point : points_on(setup.mesh, right))
        setup.mesh.x[std::size_t(point)] += 1e-8 * (point % 3);
    CHECK(Attempt(setup.problem(), &options).status == HM_OK);

    struct {
        const char* words;
        std::int32_t item;
        void (*spoil)(Case&);
    } const cases[] = {
        {"same number of points", left,
         [](Case& c) { mark_right(c, [](double y) { return y > 0.8; }); }},
        {"must form one connected line", right,  // two pieces
         [](Case& c) { mark_right(c, [](double y) { return std::fabs(y - 0.5) < 0.01; }); }},
        {"its own periodic partner", left, [](Case& c) { c.conditions.back().partner = left; }},
        {"condition of its own", right, [](Case& c) { c.set_slip(right); }},
        {"condition of its own", right, [](Case& c) { c.set_periodic(right, left); }},
        {"no boundary face has marker", 99, [](Case& c) { c.conditions.back().partner = 99; }},
    };
    for (auto const& one : cases) {
        setup = good;
        one.spoil(setup);
        CHECK(refused(setup, one.words, one.item) == HM_BAD_CONDITION);
    }
    setup = two_body_case(Cells::quads, 4, 3);  // closed
    setup.conditions.pop_back();
    setup.set_periodic(second_body, far_field);
    CHECK(refused(setup, "must form one connected line", second_body) == HM_BAD_CONDITION);

    setup = good;  // a wall that ends on the pair
    setup.curves.add([] {
        Spline floor;
        floor.degree = 1;
        floor.knots = {0, 0, 1, 1};
        floor.control = {0, 0, 1, 0};
        return floor;
    }());
    setup.put_on_curves(bottom, 1);
    Attempt const attempt(setup.problem(), &options);
    CHECK(attempt.status == HM_BAD_CONDITION);
    CHECK(says(attempt.error, "a moving wall"));
    CHECK((attempt.error.item == 0 || attempt.error.item == 8));
}

TEST_CASE("a side that is the partner of two others is refused") {
    Case setup = cascade(Cells::quads);
    setup.set_periodic(top, right);  // right is left's partner already, and no translate of the top
    Options const options = options_of(HM_CONFORMAL);
    CHECK(Attempt(setup.problem(), &options).status == HM_BAD_CONDITION);
}
