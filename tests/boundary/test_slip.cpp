// Slip boundaries: points slide along straight lines, and a slip line is a line of symmetry.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/half_ring.hpp>

using namespace fixtures;
using harmorph::PointKind;

namespace {

double const pi = std::acos(-1.0);
constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};
constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};

}  // namespace

TEST_CASE("a line of symmetry: the half with slip moves as the half of the whole does") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : kinds) {
            Case half = half_ring(6, 16, kind, 0.3, 3), whole = mirrored(half);
            hm_options const options = options_of(operator_kind);
            Solved const a(half, &options), b(whole, &options);
            std::vector<double> const move = symmetric_move(4);
            Field const of_half = displacement(a, move);
            Field of_whole = displacement(b, move);
            of_whole.resize(of_half.size());
            CHECK(largest_difference(of_half, of_whole) < 1e-12);
            half.conditions.back().kind = HM_FIXED;   // and this is not for nothing
            Solved const fixed(half, &options);
            CHECK(largest_difference(displacement(fixed, move), of_whole) > 1e-2);
        }
}

TEST_CASE("at any angle points stay on their line to rounding, and slide") {
    for (std::int32_t const operator_kind : operators)
        for (double const angle : {0.0, 0.3, pi / 2, 2.2, -1.0}) {
            Complex const turn = std::polar(1.0, angle);
            Case its = similar(half_ring(6, 16, Cells::hybrid, 0.3, 5), turn, {0.4, -7});
            hm_options const options = options_of(operator_kind);
            Solved const solved(its, &options);
            Field const moved = displacement(solved, turned(some_move(8, 1, 6), turn));
            double off = 0, along = 0;
            for (std::int32_t const point : points_on(its.mesh, slip_line)) {
                if (point == 0 || point == 16) continue;   // on the body, which moves as its curve does
                Complex const d = moved[static_cast<std::size_t>(point)] / turn;
                off = std::fmax(off, std::fabs(d.imag()));
                along = std::fmax(along, std::fabs(d.real()));
            }
            CHECK(off < 2e-16 * 8);
            CHECK(along > 0.05);
            // And the whole does not depend on the angle.
            Case straight = half_ring(6, 16, Cells::hybrid, 0.3, 5);
            Solved const reference(straight, &options);
            Field expected = displacement(reference, some_move(8, 1, 6));
            for (Complex& d : expected) d *= turn;
            CHECK(largest_difference(moved, expected) < 1e-11);
        }
}

TEST_CASE("many small steps later they are still on it") {
    Complex const turn = std::polar(1.0, 0.4);
    Case its = similar(half_ring(6, 16, Cells::quads, 0.3, 7), turn, 0);
    hm_options const options = options_of(HM_CONFORMAL);
    Solved const solved(its, &options);
    Mesh mesh = its.mesh;
    for (unsigned step = 0; step < 100; ++step) {
        std::vector<double> const move = some_move(8, 0.01, step);
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(mesh.x, mesh.y), points_out(mesh.x, mesh.y), nullptr,
                         nullptr) == HM_OK);
    }
    for (std::int32_t const point : points_on(its.mesh, slip_line))
        if (point != 0 && point != 16) CHECK(std::fabs((to_complex(mesh.point(point)) / turn).imag()) < 1e-14);
}

TEST_CASE("kinds of points: corners of two lines are fixed, what is stronger wins, and lines go on over markers") {
    auto const kinds_of = [](Case& its, std::int32_t operator_kind) {
        hm_options const options = options_of(operator_kind);
        Attempt seen;
        bool const done = seen.analyse(its.problem(), &options);
        INFO(seen.error.text);
        REQUIRE(done);
        std::vector<PointKind> out;
        for (PointKind const kind : inside(seen.analysis).kinds) out.push_back(kind);
        return out;
    };
    Case its = tiny_case();   // point (i, j) below the hole is i + 7 j
    for (std::int32_t const side : {bottom, right, top, left}) its.set_slip(side);
    std::vector<PointKind> found = kinds_of(its, HM_CONFORMAL);
    CHECK(found[0] == PointKind::fixed);
    CHECK(found[6] == PointKind::fixed);
    CHECK(found[1] == PointKind::slip);
    CHECK(found[5] == PointKind::slip);
    CHECK(found[7] == PointKind::slip);
    CHECK(found[8] == PointKind::inside);
    CHECK(found[16] == PointKind::on_wall);
    CHECK(std::count(found.begin(), found.end(), PointKind::slip) == 20);
    CHECK(std::count(found.begin(), found.end(), PointKind::fixed) == 4);

    its = tiny_case();   // a free neighbour leaves the corner on the line, a fixed one holds it
    its.set_slip(bottom);
    its.set_free(right);
    found = kinds_of(its, HM_LAPLACE);
    CHECK(found[0] == PointKind::fixed);
    CHECK(found[6] == PointKind::slip);
    CHECK(found[13] == PointKind::free);

    its = tiny_case();   // one line over two markers
    for (std::size_t face = 0; face < its.mesh.face_markers.size(); ++face)
        if (its.mesh.face_markers[face] == bottom && its.mesh.x[static_cast<std::size_t>(its.mesh.faces[2 * face])] > 2.5)
            its.mesh.face_markers[face] = 40;
    its.set_slip(bottom);
    its.set_slip(40);
    found = kinds_of(its, HM_CONFORMAL);
    for (std::size_t k = 1; k < 6; ++k) CHECK(found[k] == PointKind::slip);
}

TEST_CASE("slip beside a free boundary: points of the corner stay on the line, and the functions are Laplace's") {
    Case its = tiny_case();
    its.set_slip(bottom);
    its.set_free(right);
    hm_options const options = options_of(HM_LAPLACE);
    Solved const solved(its, &options);
    std::vector<double> const move = some_move(4, 1, 9);
    Field const moved = displacement(solved, move);
    for (std::size_t k = 0; k < 7; ++k) CHECK(moved[k].imag() == 0);
    CHECK(moved[0] == 0.0);
    CHECK(std::fabs(moved[6].real()) > 1e-3);
    // x and y are not coupled by lines along x: x moves as with a free bottom, y as with a fixed one.
    Case free_bottom = its, fixed_bottom = its;
    free_bottom.conditions[1].kind = HM_FREE;
    fixed_bottom.conditions[1].kind = HM_FIXED;
    Solved const for_x(free_bottom), for_y(fixed_bottom);
    Field const by_x = displacement(for_x, move), by_y = displacement(for_y, move);
    for (std::size_t k = 0; k < moved.size(); ++k) {
        CHECK(std::fabs(moved[k].real() - by_x[k].real()) < 1e-14);
        CHECK(std::fabs(moved[k].imag() - by_y[k].imag()) < 1e-14);
    }
}

TEST_CASE("all sides of a channel slip, two bodies, one of them rigid: everything stays in its rectangle") {
    for (std::int32_t const operator_kind : operators) {
        Case its = similar(two_body_case(Cells::hybrid, 6, 5), std::polar(1.5, 0.7), {1, 2});
        its.conditions.clear();
        its.put_on_curves(body, 0);
        Complex const centre = std::polar(1.5, 0.7) * Complex(1.5, 0.5) + Complex(1, 2);
        its.set_rigid(second_body, centre.real(), centre.imag());
        its.set_slip(far_field);   // one marker, four lines
        hm_options const options = options_of(operator_kind);
        Solved const solved(its, &options);
        std::vector<double> const move = some_move(solved.info().functions, 0.2, 10);
        Field const moved = displacement(solved, move);
        double most = 0;
        for (std::int32_t const point : points_on(its.mesh, far_field)) {
            Complex const d = moved[static_cast<std::size_t>(point)] / std::polar(1.0, 0.7);
            CHECK(std::fmin(std::fabs(d.real()), std::fabs(d.imag())) < 1e-15);
            Complex const at = (to_complex(its.mesh.point(point)) - Complex(1, 2)) / std::polar(1.5, 0.7);
            bool const corner = (at.real() < 1e-9 || at.real() > 2 - 1e-9) && (at.imag() < 1e-9 || at.imag() > 1 - 1e-9);
            if (corner) CHECK(d == 0.0);
            most = std::fmax(most, std::abs(d));
        }
        CHECK(most > 0.01);
    }
}

TEST_CASE("what is not straight is refused with the place, however little it bends") {
    Case const straight = tiny_case();
    for (double const bend : {1e-3, 1e-5}) {
        Case its = straight;
        its.set_slip(bottom);
        its.mesh.y[3] -= bend;
        hm_options const options = options_of(HM_CONFORMAL);
        Attempt const attempt(its.problem(), &options);
        CHECK(attempt.status == HM_BAD_CONDITION);
        std::string const marker = "marker " + std::to_string(bottom) + " slips";
        std::string const point = "not straight at point " + std::to_string(attempt.error.item);
        INFO(attempt.error.text);
        CHECK(std::string(attempt.error.text).find(marker) != std::string::npos);
        CHECK(std::string(attempt.error.text).find(point) != std::string::npos);
        // Points count from the mesh's base, markers have the numbers that they were given.
        its.index_base = 1;
        Attempt const from_one(its.problem(), &options);
        CHECK(from_one.error.item == attempt.error.item + 1);
        CHECK(std::string(from_one.error.text).find(marker) != std::string::npos);
    }
    Case ring = ring_case(6, 120, 0.5, 2);   // a circle: three degrees from face to face
    ring.set_slip(far_field);
    hm_options const options = options_of(HM_LAPLACE);
    Attempt const round(ring.problem(), &options);
    CHECK(round.status == HM_BAD_CONDITION);
    Case nearly = straight;   // as little as coordinates in files are rounded is straight
    nearly.set_slip(bottom);
    nearly.mesh.y[3] -= 1e-7;
    CHECK(Attempt(nearly.problem(), &options).status == HM_OK);
}

TEST_CASE("an arc with corners of more than six degrees: every point is a corner, and fixed") {
    Case its = ring_case(6, 24, 0.5, 2);   // 15 degrees from face to face
    its.set_slip(far_field);
    hm_options const options = options_of(HM_CONFORMAL);
    Solved const solved(its, &options);
    its.conditions.back().kind = HM_FIXED;
    Solved const fixed(its, &options);
    std::vector<double> const move = some_move(8, 1, 11);
    CHECK(largest_difference(displacement(solved, move), displacement(fixed, move)) < 1e-12);
}
