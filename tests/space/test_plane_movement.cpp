// Movements of the plane in space, and the adjoint: in coordinate planes, inclined planes and
// wedges.
#include <harmorph_space.h>

#include <fixtures/executors.hpp>
#include <fixtures/extruded.hpp>

using namespace fixtures;

namespace {

// The problem of the case on the mesh of the plane.
hm_problem on_plane(Case& setup, Plane const& plane) {
    setup.known_points.clear();
    setup.known_curves.clear();
    setup.known_u.clear();
    return setup.problem(plane.mesh);
}

double dot(hm_plane_info const&, const double* direction, Vec3 const& v) {
    return direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2];
}

}  // namespace

TEST_CASE("the mesh of a coordinate plane has the coordinates' bits, and so has its morph") {
    for (int const normal : {0, 1, 2}) {
        for (unsigned const seed : {0u, 7u}) {
            Case setup = airfoil_case(20, 8);
            Extruded const space(setup.mesh, along_axis(normal), 2, seed);
            Plane const plane(space.view());
            INFO(plane.error.text);
            REQUIRE(plane.status == HM_OK);
            CHECK(plane.info.kind == HM_PLANES);
            CHECK(plane.info.layers == 2);
            CHECK(plane.info.max_distance == 0);
            CHECK(plane.info.max_distance_point == -1);
            CHECK(plane.mesh.cell_layout == HM_CELLS_ROWS);
            CHECK(plane.info.n_points == setup.mesh.n_points());
            CHECK(all_follow(plane, space));
            bool same = true;
            for (std::int32_t p = 0; p < plane.info.n_points; ++p) {
                std::size_t const from =
                    std::size_t(space.plane_point[std::size_t(plane.info.space_point[p])]);
                same = same && plane.mesh.points.x[p] == setup.mesh.x[from] &&
                       plane.mesh.points.y[p] == setup.mesh.y[from];
            }
            CHECK(same);
            Attempt const solved(on_plane(setup, plane));
            INFO(solved.error.text);
            REQUIRE(solved.status == HM_OK);
            std::vector<double> const move = some_move(solved.report.functions, 0.01, 1);
            std::size_t const n = std::size_t(plane.info.n_points);
            std::vector<double> x(n), y(n), sx = space.x, sy = space.y, sz = space.z;
            REQUIRE(hm_morph(solved.basis, move.data(), &plane.mesh.points, points_out(x, y),
                             nullptr, nullptr) == HM_OK);
            hm_space_points const from = space.points();
            hm_space_points_out const to{sx.data(), sy.data(), sz.data(), 1};
            REQUIRE(hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &to, nullptr,
                                   nullptr) == HM_OK);
            std::vector<double> const& first = normal == 0 ? sy : sx;
            std::vector<double> const& second = normal == 2 ? sy : sz;
            std::vector<double> const& across = normal == 0 ? sx : normal == 1 ? sy : sz;
            CHECK(same_bits(across, normal == 0 ? space.x : normal == 1 ? space.y : space.z));
            bool alike = true;
            for (std::size_t k = 0; k < first.size(); ++k) {
                std::size_t const p = std::size_t(plane.info.follows[k]);
                alike = alike && first[k] == x[p] && second[k] == y[p];
            }
            CHECK(alike);
        }
    }
}

TEST_CASE("all points of space move in place, and arrays that overlap otherwise are refused") {
    Case setup = airfoil_case(20, 8);
    Extruded space(setup.mesh, along_axis(2), 2, 0);
    Plane const plane(space.view());
    REQUIRE(plane.status == HM_OK);
    Attempt const solved(on_plane(setup, plane));
    REQUIRE(solved.status == HM_OK);
    std::vector<double> const move = some_move(solved.report.functions, 0.01, 1);
    std::size_t const n = space.x.size(), n_plane = std::size_t(plane.info.n_points);
    std::vector<double> all(4 * n), apart(3 * n);
    auto const put = [&] {
        std::copy(space.x.begin(), space.x.end(), all.begin());
        std::copy(space.y.begin(), space.y.end(), all.begin() + std::ptrdiff_t(n));
        std::copy(space.z.begin(), space.z.end(), all.begin() + std::ptrdiff_t(2 * n));
    };
    put();
    std::vector<double> const before = all;
    double* const x = all.data();
    hm_space_points const from{x, x + n, x + 2 * n, 1};
    hm_space_points_out const separate{apart.data(), apart.data() + n, apart.data() + 2 * n, 1},
        same{x, x + n, x + 2 * n, 1}, shifted{x + 1, x + n + 1, x + 2 * n + 1, 1},
        narrow{apart.data(), apart.data() + 1, apart.data() + 2 * n, 1};
    hm_error error{};
    auto const morph = [&](hm_space_points_out const& to) {
        return hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &to, nullptr, &error);
    };
    REQUIRE(morph(separate) == HM_OK);
    for (hm_space_points_out const& wrong : {shifted, narrow}) {
        CHECK(morph(wrong) == HM_BAD_ARGUMENT);
        CHECK(says(error, "have numbers in common; give separate arrays"));
    }
    hm_points const step{x, x + n_plane, 1};
    CHECK(hm_plane_spread(plane.plane, &step, nullptr, &same, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(says(error, "to and displacement have numbers in common"));
    hm_points_out const sums{x, x + n_plane, 1};
    CHECK(hm_plane_gather(plane.plane, &from, &sums, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(says(error, "plane_dj and dj have numbers in common"));
    CHECK(all == before);
    REQUIRE(morph(same) == HM_OK);
    all.resize(3 * n);
    CHECK(same_bits(all, apart));
}

TEST_CASE("the movement of inclined planes, wedges and many layers is that of the plane") {
    struct Kind {
        const char* name;
        Placement place;
        int layers;
        std::int32_t kind;
        double raised;
    };
    Inclined const tilted;
    Placement const turned_wedge = [tilted](Point p, int layer) {
        double const turn = 0.1 * layer;
        return tilted.at(p.x, p.y * std::cos(turn), p.y * std::sin(turn));
    };
    Kind const kinds[] = {{"inclined", inclined(), 2, HM_PLANES, 0},
                          {"inclined, four layers", inclined(), 4, HM_PLANES, 0},
                          {"z, three layers", along_axis(2), 3, HM_PLANES, 0},
                          {"wedge from the axis", wedge(5), 2, HM_WEDGE, 0},
                          {"wedge away from the axis", wedge(0.2), 2, HM_WEDGE, 3},
                          {"inclined wedge", turned_wedge, 2, HM_WEDGE, 1}};
    for (Kind const& kind : kinds) {
        CAPTURE(kind.name);
        Case setup = raised_case(kind.raised);
        Extruded const space(setup.mesh, kind.place, kind.layers, 3);
        Plane const plane(space.view());
        INFO(plane.error.text);
        REQUIRE(plane.status == HM_OK);
        CHECK(plane.info.kind == kind.kind);
        CHECK(plane.info.layers == kind.layers);
        CHECK(plane.info.max_distance < 1e-13);
        CHECK(all_follow(plane, space));
        hm_plane_info const& info = plane.info;
        bool in_place = true;
        for (std::int32_t p = 0; p < info.n_points; ++p) {
            std::size_t const k = std::size_t(info.space_point[p]);
            Vec3 const at{space.x[k], space.y[k], space.z[k]};
            for (std::size_t d = 0; d < 3; ++d) {
                double const back = info.origin[d] + plane.mesh.points.x[p] * info.x_direction[d] +
                                    plane.mesh.points.y[p] * info.y_direction[d];
                in_place = in_place && std::fabs(back - at[d]) < 1e-13;
            }
        }
        CHECK(in_place);
        // The plane's coordinates may be turned against those of the fixture, so the curve is a
        // movement of the mesh.
        std::size_t const n = std::size_t(info.n_points);
        std::vector<double> dx(n), dy(n);
        for (std::size_t p = 0; p < n; ++p) {
            dx[p] = 0.01 * std::sin(plane.mesh.points.x[p]);
            dy[p] = 0.02 * plane.mesh.points.y[p];
        }
        std::vector<double> sx = space.x, sy = space.y, sz = space.z;
        hm_space_points const from = space.points();
        hm_space_points_out const to{sx.data(), sy.data(), sz.data(), 1};
        REQUIRE(hm_plane_spread(plane.plane, points_in(dx, dy), &from, &to, nullptr, nullptr) ==
                HM_OK);
        // The moved points are again a mesh of that kind, and its plane has moved as it should.
        hm_space_mesh moved = space.view();
        moved.points = {sx.data(), sy.data(), sz.data(), 1};
        Plane const after(moved);
        INFO(after.error.text);
        REQUIRE(after.status == HM_OK);
        CHECK(after.info.max_distance < 1e-13);
        CHECK(all_follow(after, space));
        double worst = 0;
        for (std::size_t k = 0; k < sx.size(); ++k) {
            std::int32_t const p = info.follows[k], q = info.space_point[p];
            if (std::size_t(q) != k) continue;
            Vec3 const step{sx[k] - space.x[k], sy[k] - space.y[k], sz[k] - space.z[k]};
            worst =
                std::max(worst, std::fabs(dot(info, info.x_direction, step) - dx[std::size_t(p)]));
            worst =
                std::max(worst, std::fabs(dot(info, info.y_direction, step) - dy[std::size_t(p)]));
            worst = std::max(worst, std::fabs(dot(info, info.normal, step)));
        }
        CHECK(worst < 1e-13);
    }
}

TEST_CASE("the adjoint is the transpose of the morph in planes and wedges") {
    for (Placement const& place : {along_axis(1), inclined(), wedge(4)}) {
        Case setup = raised_case(1);
        Extruded const space(setup.mesh, place, 2, 5);
        Plane plane(space.view());
        REQUIRE(plane.status == HM_OK);
        // A curve of degree 1 through the points of the body, wherever the plane's coordinates have
        // it.
        std::vector<Point> corners;
        for (std::int32_t const p : {2 + 7 * 2, 4 + 7 * 2, 4 + 7 * 4 - 1, 2 + 7 * 4 - 1}) {
            for (std::int32_t q = 0; q < plane.info.n_points; ++q) {
                if (space.plane_point[std::size_t(plane.info.space_point[q])] != p) continue;
                corners.push_back({plane.mesh.points.x[q], plane.mesh.points.y[q]});
            }
        }
        setup.curves = polyline(corners);
        Attempt const solved(on_plane(setup, plane));
        INFO(solved.error.text);
        REQUIRE(solved.status >= HM_OK);
        std::vector<double> const move = some_move(solved.report.functions, 0.1, 2);
        std::size_t const n = space.x.size();
        std::vector<double> step(3 * n), dj(3 * n);
        std::mt19937 random(9);
        for (double& d : dj) d = uniform(random) - 0.5;
        hm_space_points_out const to{step.data(), step.data() + n, step.data() + 2 * n, 1};
        hm_space_points const by{dj.data(), dj.data() + n, dj.data() + 2 * n, 1};
        REQUIRE(hm_plane_morph(plane.plane, solved.basis, move.data(), nullptr, &to, nullptr,
                               nullptr) == HM_OK);
        std::vector<double> gradient(move.size()), again(move.size());
        REQUIRE(hm_plane_adjoint(plane.plane, solved.basis, &by, gradient.data(), nullptr,
                                 nullptr) == HM_OK);
        double left = 0, right = 0, size = 0;
        for (std::size_t k = 0; k < 3 * n; ++k) {
            left += step[k] * dj[k];
            size += std::fabs(step[k] * dj[k]);
        }
        for (std::size_t i = 0; i < move.size(); ++i) right += move[i] * gradient[i];
        CHECK(size > 0.1);
        CHECK(std::fabs(left - right) < 1e-14 * size);
        Backwards order;
        hm_executor const executor = order.executor(3);
        REQUIRE(hm_plane_adjoint(plane.plane, solved.basis, &by, again.data(), &executor,
                                 nullptr) == HM_OK);
        CHECK(same_bits(gradient, again));
        std::vector<double> px(std::size_t(plane.info.n_points)), py = px;
        REQUIRE(hm_plane_gather(plane.plane, &by, points_out(px, py), nullptr, nullptr) == HM_OK);
        REQUIRE(hm_adjoint(solved.basis, points_in(px, py), again.data(), nullptr, nullptr) ==
                HM_OK);
        CHECK(same_bits(gradient, again));
    }
}
