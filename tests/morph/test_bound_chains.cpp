// Derivatives of bounds by control points, design variables and wall displacements: the transposes
// that exist turn those by mesh points into them.
#include <fixtures/bounded.hpp>
#include <fixtures/single.hpp>

using namespace fixtures;

namespace {

std::vector<std::int32_t> const all_kinds = {HM_BOUND_QUALITY, HM_BOUND_KEPT_QUALITY,
                                             HM_BOUND_AREA,    HM_BOUND_HEIGHT,
                                             HM_BOUND_STRETCH, HM_BOUND_ANGLE};
double const sharpness = 40;

Field displacement_of(const hm_basis* basis, Field const& move, std::size_t n_points) {
    Field out(n_points);
    double* const xy = reinterpret_cast<double*>(out.data());
    hm_points_out const to{xy, xy + 1, 2};
    REQUIRE(hm_morph(basis, reinterpret_cast<const double*>(move.data()), nullptr, &to, nullptr,
                     nullptr) == HM_OK);
    return out;
}
Field gradient_of(const hm_basis* basis, Field const& dj, std::size_t n_functions) {
    Field out(n_functions);
    hm_points const points = pairs_in(dj);
    REQUIRE(hm_adjoint(basis, &points, reinterpret_cast<double*>(out.data()), nullptr, nullptr) ==
            HM_OK);
    return out;
}

// Checks the derivatives by unknowns u of the bounds at start + displacement(u): the transpose has
// the same work in u and in the points to rounding, and the bounds agree with differences.
template <class Displacement, class Transpose>
void check_chain(Bounded const& mesh, Field const& unknowns, Displacement const& displacement,
                 Transpose const& transpose) {
    Field const start = mesh.start(), at = along(start, displacement(unknowns), 1);
    Field const direction = some_field(unknowns.size(), 9, 0.01);
    Field const moves = displacement(direction);
    std::vector<BoundResult> const found = bounds_of(mesh, at, all_kinds, sharpness);
    for (std::size_t k = 0; k < all_kinds.size(); ++k) {
        INFO("kind " << all_kinds[k]);
        Field const gradient = transpose(found[k].gradient);
        double const slope = dot(gradient, direction),
                     terms = dot_of_sizes(found[k].gradient, moves);
        CHECK(std::fabs(slope - dot(found[k].gradient, moves)) <= 1e-14 * terms);
        double const least = check_slope(slope, 0.02, [&](double step) {
            return bound_of(mesh, along(start, displacement(along(unknowns, direction, step)), 1),
                            all_kinds[k], sharpness)
                .value.bound;
        });
        CHECK(least < 1e-5);
    }
}

}  // namespace

TEST_CASE("derivatives by control points, for real and for complex functions") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Case setup = airfoil_case(20);
        Options options{};
        options.operator_kind = kind;
        Solved const solved(setup, &options);
        Bounded const mesh(setup);
        std::size_t const n = std::size_t(solved.info().functions);
        check_chain(
            mesh, some_field(n, 2, 0.002),
            [&](Field const& move) { return displacement_of(solved.basis, move, mesh.n()); },
            [&](Field const& dj) { return gradient_of(solved.basis, dj, n); });
    }
}

TEST_CASE("derivatives by design variables, through a combined basis") {
    Case setup = airfoil_case(20);
    Options options{};
    options.operator_kind = HM_CONFORMAL;
    Solved const solved(setup, &options);
    Bounded const mesh(setup);
    Combination const variables(solved.info().functions, 4, 2, 5);
    Combined const few(solved.basis, variables);
    REQUIRE(few.status == HM_OK);
    check_chain(
        mesh, some_field(4, 2, 0.0005),
        [&](Field const& move) { return displacement_of(few.basis, move, mesh.n()); },
        [&](Field const& dj) { return gradient_of(few.basis, dj, 4); });
}

TEST_CASE("derivatives by displacements of wall points") {
    Case setup = given_instead(airfoil_case(20));
    Options const options = laplace();
    Displaced displaced(setup, &options);
    Bounded const mesh(setup);
    check_chain(
        mesh, some_field(displaced.points.size(), 2, 1e-5),
        [&](Field const& wall) { return displaced.displace(wall); },
        [&](Field const& dj) { return displaced.adjoint(dj); });
}

TEST_CASE("derivatives of the admissible step by control points") {
    Case setup = airfoil_case(20);
    Solved const solved(setup);
    Bounded const mesh(setup);
    std::size_t const n = std::size_t(solved.info().functions);
    Field const move = some_field(n, 6, 0.01), direction = some_field(n, 7, 0.001);
    auto const step_of = [&](double t, hm_step_corner* corner) {
        Field const displacement =
            displacement_of(solved.basis, along(move, direction, t), mesh.n());
        hm_points const change = pairs_in(displacement);
        hm_step_corner found[1];
        std::int32_t count = 0;
        REQUIRE(hm_step_gradient(mesh.attempt.basis, &mesh.mesh, nullptr, &change, 0, 1, found,
                                 &count, nullptr, nullptr) == HM_OK);
        REQUIRE(count == 1);
        if (corner != nullptr) *corner = found[0];
        return found[0].step;
    };
    hm_step_corner corner{};
    step_of(0, &corner);
    Field dj(mesh.n());
    for (std::size_t k = 0; k < 3; ++k)
        dj[std::size_t(corner.points[k])] +=
            corner.step * std::complex<double>(corner.by_from[2 * k], corner.by_from[2 * k + 1]);
    double const slope = dot(gradient_of(solved.basis, dj, n), direction);
    CHECK(check_slope(slope, 0.2, [&](double t) { return step_of(t, nullptr); }) < 1e-6);
}
