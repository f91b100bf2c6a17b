// Slip boundaries: points slide along straight lines, and a slip line is a line of symmetry.
#include <fixtures/core.hpp>
#include <fixtures/channels.hpp>

using namespace fixtures;
using harmorph::PointKind;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};
constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};

}  // namespace

TEST_CASE("a half mesh with slip on the line of symmetry moves as half of the whole mesh does") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds) {
            Case half = half_ring(6, 16, kind, 0.3, 3), whole = mirrored(half);
            Options const options = options_of(operator_kind);
            Solved const a(half, &options), b(whole, &options);
            std::vector<double> const move = symmetric_move(4);
            Field const of_half = displacement(a, move);
            Field of_whole = displacement(b, move);
            of_whole.resize(of_half.size());
            CHECK(largest_difference(of_half, of_whole) < 1e-12);
            half.conditions.back().kind = HM_FIXED;  // and this is not for nothing
            Solved const fixed(half, &options);
            CHECK(largest_difference(displacement(fixed, move), of_whole) > 1e-2);
        }
}

TEST_CASE("points slide and stay on a line at any angle to rounding") {
    for (std::int32_t const operator_kind : operators)
        for (double const angle : {0.0, 0.3, pi / 2, 2.2, -1.0}) {
            Complex const turn = std::polar(1.0, angle);
            Case setup = similar(half_ring(6, 16, Cells::hybrid, 0.3, 5), turn, {0.4, -7});
            Options const options = options_of(operator_kind);
            Solved const solved(setup, &options);
            Field const moved = displacement(solved, turned(some_move(8, 1, 6), turn));
            double off = 0, along = 0;
            for (std::int32_t const point : points_on(setup.mesh, slip_line)) {
                if (point == 0 || point == 16)
                    continue;  // on the body, which moves as its curve does
                Complex const d = moved[std::size_t(point)] / turn;
                off = std::fmax(off, std::fabs(d.imag()));
                along = std::fmax(along, std::fabs(d.real()));
            }
            CHECK(off < 2e-16 * 8);
            CHECK(along > 0.05);
            // The functions of the whole mesh do not depend on the angle.
            Case straight = half_ring(6, 16, Cells::hybrid, 0.3, 5);
            Solved const reference(straight, &options);
            Field expected = displacement(reference, some_move(8, 1, 6));
            for (Complex& d : expected) d *= turn;
            CHECK(largest_difference(moved, expected) < 1e-11);
        }
}

TEST_CASE("after many small steps, points are still on their slip line") {
    Complex const turn = std::polar(1.0, 0.4);
    Case setup = similar(half_ring(6, 16, Cells::quads, 0.3, 7), turn, 0);
    Solved const solved(setup, options_of(HM_CONFORMAL));
    Mesh mesh = setup.mesh;
    for (unsigned step = 0; step < 100; ++step) {
        std::vector<double> const move = some_move(8, 0.01, step);
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(mesh.x, mesh.y),
                         points_out(mesh.x, mesh.y), nullptr, nullptr) == HM_OK);
    }
    for (std::int32_t const point : points_on(setup.mesh, slip_line))
        if (point != 0 && point != 16)
            CHECK(std::fabs((to_complex(mesh.point(point)) / turn).imag()) < 1e-14);
}

TEST_CASE("corners of slip lines are fixed, stronger conditions win, and lines cross markers") {
    auto const kinds_of = [](Case& setup, std::int32_t operator_kind) {
        Options const options = options_of(operator_kind);
        Attempt seen;
        bool const done = seen.analyse(setup.problem(), &options);
        INFO(seen.error.text);
        REQUIRE(done);
        std::vector<PointKind> out;
        for (PointKind const kind : inside(seen.analysis).kinds()) out.push_back(kind);
        return out;
    };
    Case setup = tiny_case();  // point (i, j) below the hole is i + 7 j
    for (std::int32_t const side : {bottom, right, top, left}) setup.set_slip(side);
    std::vector<PointKind> found = kinds_of(setup, HM_CONFORMAL);
    CHECK(found[0] == PointKind::fixed);
    CHECK(found[6] == PointKind::fixed);
    CHECK(found[1] == PointKind::slip);
    CHECK(found[5] == PointKind::slip);
    CHECK(found[7] == PointKind::slip);
    CHECK(found[8] == PointKind::inside);
    CHECK(found[16] == PointKind::on_wall);
    CHECK(std::count(found.begin(), found.end(), PointKind::slip) == 20);
    CHECK(std::count(found.begin(), found.end(), PointKind::fixed) == 4);

    setup = tiny_case();  // a free neighbour leaves the corner on the line, a fixed one holds it
    setup.set_slip(bottom);
    setup.set_free(right);
    found = kinds_of(setup, HM_LAPLACE);
    CHECK(found[0] == PointKind::fixed);
    CHECK(found[6] == PointKind::slip);
    CHECK(found[13] == PointKind::free);

    setup = tiny_case();  // one line over two markers
    for (std::size_t face = 0; face < setup.mesh.face_markers.size(); ++face)
        if (setup.mesh.face_markers[face] == bottom &&
            setup.mesh.x[std::size_t(setup.mesh.faces[2 * face])] > 2.5)
            setup.mesh.face_markers[face] = 40;
    setup.set_slip(bottom);
    setup.set_slip(40);
    found = kinds_of(setup, HM_CONFORMAL);
    for (std::size_t k = 1; k < 6; ++k) CHECK(found[k] == PointKind::slip);
}

TEST_CASE("corner points beside a free boundary stay on the slip line as Laplace's functions do") {
    Case setup = tiny_case();
    setup.set_slip(bottom);
    setup.set_free(right);
    Solved const solved(setup, options_of(HM_LAPLACE));
    std::vector<double> const move = some_move(4, 1, 9);
    Field const moved = displacement(solved, move);
    for (std::size_t k = 0; k < 7; ++k) CHECK(moved[k].imag() == 0);
    CHECK(moved[0] == 0.0);
    CHECK(std::fabs(moved[6].real()) > 1e-3);
    // x and y are not coupled by lines along x: x moves as with a free bottom, y as with a fixed
    // one.
    Case free_bottom = setup, fixed_bottom = setup;
    free_bottom.conditions[1].kind = HM_FREE;
    fixed_bottom.conditions[1].kind = HM_FIXED;
    Solved const for_x(free_bottom), for_y(fixed_bottom);
    Field const by_x = displacement(for_x, move), by_y = displacement(for_y, move);
    for (std::size_t k = 0; k < moved.size(); ++k) {
        CHECK(std::fabs(moved[k].real() - by_x[k].real()) < 1e-14);
        CHECK(std::fabs(moved[k].imag() - by_y[k].imag()) < 1e-14);
    }
}

TEST_CASE("in a channel with slip on all sides and two bodies, all points stay in the rectangle") {
    for (std::int32_t const operator_kind : operators) {
        Case setup = similar(two_body_case(Cells::hybrid, 6, 5), std::polar(1.5, 0.7), {1, 2});
        setup.conditions.clear();
        setup.put_on_curves(body, 0);
        Complex const centre = std::polar(1.5, 0.7) * Complex(1.5, 0.5) + Complex(1, 2);
        setup.set_rigid(second_body, centre.real(), centre.imag());
        setup.set_slip(far_field);  // one marker, four lines
        Solved const solved(setup, options_of(operator_kind));
        std::vector<double> const move = some_move(solved.info().functions, 0.2, 10);
        Field const moved = displacement(solved, move);
        double most = 0;
        for (std::int32_t const point : points_on(setup.mesh, far_field)) {
            Complex const d = moved[std::size_t(point)] / std::polar(1.0, 0.7);
            CHECK(std::fmin(std::fabs(d.real()), std::fabs(d.imag())) < 1e-15);
            Complex const at =
                (to_complex(setup.mesh.point(point)) - Complex(1, 2)) / std::polar(1.5, 0.7);
            bool const corner = (at.real() < 1e-9 || at.real() > 2 - 1e-9) &&
                                (at.imag() < 1e-9 || at.imag() > 1 - 1e-9);
            if (corner) CHECK(d == 0.0);
            most = std::fmax(most, std::abs(d));
        }
        CHECK(most > 0.01);
    }
}

TEST_CASE("a bend above the rounding of coordinates makes a curve, and a smaller one a line") {
    auto const bent = [](double by) {
        Case setup = tiny_case();
        setup.set_slip(bottom);
        setup.mesh.y[3] -= by;
        Solved const solved(setup, options_of(HM_CONFORMAL));
        Field const moved = displacement(solved, some_move(4, 1, 9));
        double angle = 0;
        for (std::size_t k = 1; k < 6; ++k)
            angle = std::fmax(angle, std::fabs(moved[k].imag() / moved[k].real()));
        return angle;
    };
    CHECK(bent(0) == 0);
    CHECK(bent(1e-7) < 1e-7);
    for (double const by : {1e-5, 1e-3}) {
        CHECK(bent(by) > 0.4 * by);
        CHECK(bent(by) < 1.1 * by);
    }
}

TEST_CASE("a corner is a jump of direction without neighbours like it, or above 30 degrees") {
    auto const kinds_of = [](double lift) {
        Case setup = tiny_case();
        setup.set_slip(bottom);
        setup.mesh.y[3] -= lift;  // of a line with faces of length 1
        Options const options = options_of(HM_CONFORMAL);
        Attempt seen;
        REQUIRE(seen.analyse(setup.problem(), &options));
        std::vector<PointKind> out;
        for (std::size_t k = 1; k < 6; ++k)
            out.push_back(inside(seen.analysis).kinds()[harmorph::Index(k)]);
        return out;
    };
    std::vector<PointKind> const flat(5, PointKind::slip);
    CHECK(kinds_of(0.005) == flat);  // half a degree
    // 5.7 degrees at the point, 2.9 to the other side beside it: all are corners.
    std::vector<PointKind> const corner = {PointKind::slip, PointKind::fixed, PointKind::fixed,
                                           PointKind::fixed, PointKind::slip};
    CHECK(kinds_of(0.05) == corner);

    // A circle: its corners of 45 degrees are corners, those of 15 and 3 are not.
    for (int const faces : {8, 24, 120}) {
        Case ring = ring_case(6, faces, 0.5, 2);
        ring.set_slip(far_field);
        Options const options = options_of(HM_CONFORMAL);
        Attempt seen;
        REQUIRE(seen.analyse(ring.problem(), &options));
        PointKind const expected = faces == 8 ? PointKind::fixed : PointKind::slip;
        for (std::int32_t const point : points_on(ring.mesh, far_field)) {
            CHECK(inside(seen.analysis).kinds()[point] == expected);
        }
    }
}

TEST_CASE("points on a circle move along tangents, also when factored on moved coordinates") {
    for (std::int32_t const operator_kind : operators) {
        Case setup = ring_case(6, 24, 0.5, 2, Cells::hybrid);
        setup.set_slip(far_field);
        Options const options = options_of(operator_kind);
        Solved solved(setup, &options);
        auto const largest_normal = [&](Mesh const& mesh) {
            Field const moved = displacement(solved, some_move(8, 1, 11));
            double normal = 0, along = 0;
            for (std::int32_t const point : points_on(mesh, far_field)) {
                Complex const radius = to_complex(mesh.point(point));
                Complex const part =
                    moved[std::size_t(point)] * std::conj(radius) / std::abs(radius);
                normal = std::fmax(normal, std::fabs(part.real()));
                along = std::fmax(along, std::fabs(part.imag()));
            }
            CHECK(along > 1e-2);
            return normal;
        };
        CHECK(largest_normal(setup.mesh) < 1e-15);
        Case turned_case = setup;  // by half a face
        for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
            Complex const z = Complex(setup.mesh.x[k], setup.mesh.y[k]) * std::polar(1.0, pi / 24);
            turned_case.mesh.x[k] = z.real();
            turned_case.mesh.y[k] = z.imag();
        }
        REQUIRE(hm_plan_factor(solved.plan, points_in(turned_case.mesh.x, turned_case.mesh.y),
                               nullptr) == HM_OK);
        REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
        CHECK(largest_normal(turned_case.mesh) < 1e-6);
        // The functions are those of the turned mesh, except for the circle through its points.
        Solved const other(turned_case, &options);
        CHECK(largest_difference(displacement(solved, some_move(8, 1, 11)),
                                 displacement(other, some_move(8, 1, 11))) < 1e-6);
    }
}
