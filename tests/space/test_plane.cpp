// Meshes of three dimensions that are one cell thick: the plane's mesh, who follows whom, movements and derivatives.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/extruded.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/traps.hpp>

#include <harmorph/space/frame.hpp>

using namespace fixtures;

namespace {

struct Plane {
    hm_status status = HM_OK;
    hm_error error{};
    hm_plane* plane = nullptr;
    hm_plane_info info{};
    hm_mesh mesh{};
    std::unique_ptr<Guarded> block;

    explicit Plane(hm_space_mesh const& space) {
        std::size_t bytes = 0;
        status = hm_plane_size(&space, &bytes, &error);
        if (status < 0) return;
        block = std::make_unique<Guarded>(bytes, 8);
        status = hm_plane_init(&plane, block->data(), bytes, &space, &error);
        CHECK(block->guards_intact());
        if (status < 0) return;
        info.struct_size = sizeof info;
        mesh.struct_size = sizeof mesh;
        REQUIRE(hm_plane_info_get(plane, &info, nullptr) == HM_OK);
        REQUIRE(hm_plane_mesh(plane, &mesh, nullptr) == HM_OK);
    }
};

bool says(hm_error const& error, const char* words) {
    return std::string(error.text).find(words) != std::string::npos;
}

// The plane point of every point is that of the same point of the mesh that was extruded.
bool all_follow(Plane const& plane, Extruded const& space) {
    for (std::size_t k = 0; k < space.x.size(); ++k) {
        std::size_t const p = static_cast<std::size_t>(plane.info.follows[k]);
        if (space.plane_point[static_cast<std::size_t>(plane.info.space_point[p])] != space.plane_point[k])
            return false;
    }
    return true;
}

// The case, moved to the plane's mesh.
hm_problem on_plane(Case& its, Plane const& plane) {
    its.given_points.clear();
    its.given_curves.clear();
    its.given_u.clear();
    return its.problem(plane.mesh);
}

double dot(hm_plane_info const&, const double* direction, Vec3 const& v) {
    return direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2];
}

// A mesh above the x axis, away from it.
Case raised_case(double by) {
    Case its = tiny_case();
    for (double& y : its.mesh.y) y += by;
    for (std::size_t k = 1; k < its.curves.control.size(); k += 2) its.curves.control[k] += by;
    return its;
}

}  // namespace

TEST_CASE("coordinate planes: the plane's mesh has the coordinates' bits, and a morph is that of the plane") {
    for (int const normal : {0, 1, 2}) {
        for (unsigned const seed : {0u, 7u}) {
            Case its = airfoil_case(20, 8);
            Extruded const space(its.mesh, along_axis(normal), 2, seed);
            Plane const plane(space.view());
            INFO(plane.error.text);
            REQUIRE(plane.status == HM_OK);
            CHECK(plane.info.kind == HM_PLANES);
            CHECK(plane.info.layers == 2);
            CHECK(plane.info.max_distance == 0);
            CHECK(plane.info.max_distance_point == -1);
            CHECK(plane.mesh.cell_layout == HM_CELLS_ROWS);
            CHECK(plane.info.n_points == its.mesh.n_points());
            CHECK(all_follow(plane, space));
            bool same = true;
            for (std::int32_t p = 0; p < plane.info.n_points; ++p) {
                std::size_t const from =
                    static_cast<std::size_t>(space.plane_point[static_cast<std::size_t>(plane.info.space_point[p])]);
                same =
                    same && plane.mesh.points.x[p] == its.mesh.x[from] && plane.mesh.points.y[p] == its.mesh.y[from];
            }
            CHECK(same);
            Attempt const solved(on_plane(its, plane));
            INFO(solved.error.text);
            REQUIRE(solved.status == HM_OK);
            std::vector<double> const move = some_move(solved.report.functions, 0.01, 1);
            std::size_t const n = static_cast<std::size_t>(plane.info.n_points);
            std::vector<double> x(n), y(n), sx = space.x, sy = space.y, sz = space.z;
            REQUIRE(hm_morph(solved.basis, move.data(), &plane.mesh.points, points_out(x, y), nullptr, nullptr) ==
                    HM_OK);
            hm_space_points const from = space.points();
            hm_space_points_out const to{sx.data(), sy.data(), sz.data(), 1};
            REQUIRE(hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &to, nullptr, nullptr) == HM_OK);
            std::vector<double> const& first = normal == 0 ? sy : sx;
            std::vector<double> const& second = normal == 2 ? sy : sz;
            std::vector<double> const& across = normal == 0 ? sx : normal == 1 ? sy : sz;
            CHECK(same_bits(across, normal == 0 ? space.x : normal == 1 ? space.y : space.z));
            bool alike = true;
            for (std::size_t k = 0; k < first.size(); ++k) {
                std::size_t const p = static_cast<std::size_t>(plane.info.follows[k]);
                alike = alike && first[k] == x[p] && second[k] == y[p];
            }
            CHECK(alike);
        }
    }
}

TEST_CASE("inclined planes, wedges and many layers: the movement in space is that of the plane") {
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
        Case its = raised_case(kind.raised);
        Extruded const space(its.mesh, kind.place, kind.layers, 3);
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
            std::size_t const k = static_cast<std::size_t>(info.space_point[p]);
            Vec3 const at{space.x[k], space.y[k], space.z[k]};
            for (std::size_t d = 0; d < 3; ++d) {
                double const back = info.origin[d] + plane.mesh.points.x[p] * info.x_direction[d] +
                                    plane.mesh.points.y[p] * info.y_direction[d];
                in_place = in_place && std::fabs(back - at[d]) < 1e-13;
            }
        }
        CHECK(in_place);
        // The plane's coordinates may be turned against those of the fixture, so the curve is a movement of the mesh.
        std::size_t const n = static_cast<std::size_t>(info.n_points);
        std::vector<double> dx(n), dy(n);
        for (std::size_t p = 0; p < n; ++p) {
            dx[p] = 0.01 * std::sin(plane.mesh.points.x[p]);
            dy[p] = 0.02 * plane.mesh.points.y[p];
        }
        std::vector<double> sx = space.x, sy = space.y, sz = space.z;
        hm_space_points const from = space.points();
        hm_space_points_out const to{sx.data(), sy.data(), sz.data(), 1};
        REQUIRE(hm_plane_spread(plane.plane, points_in(dx, dy), &from, &to, nullptr, nullptr) == HM_OK);
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
            if (static_cast<std::size_t>(q) != k) continue;
            Vec3 const step{sx[k] - space.x[k], sy[k] - space.y[k], sz[k] - space.z[k]};
            worst = std::max(worst, std::fabs(dot(info, info.x_direction, step) - dx[static_cast<std::size_t>(p)]));
            worst = std::max(worst, std::fabs(dot(info, info.y_direction, step) - dy[static_cast<std::size_t>(p)]));
            worst = std::max(worst, std::fabs(dot(info, info.normal, step)));
        }
        CHECK(worst < 1e-13);
    }
}

TEST_CASE("the adjoint is the transpose of the morph, in planes and wedges, for any number of threads") {
    for (Placement const& place : {along_axis(1), inclined(), wedge(4)}) {
        Case its = raised_case(1);
        Extruded const space(its.mesh, place, 2, 5);
        Plane plane(space.view());
        REQUIRE(plane.status == HM_OK);
        // A curve of degree 1 through the points of the body, wherever the plane's coordinates have it.
        std::vector<Point> corners;
        for (std::int32_t const p : {2 + 7 * 2, 4 + 7 * 2, 4 + 7 * 4 - 1, 2 + 7 * 4 - 1}) {
            for (std::int32_t q = 0; q < plane.info.n_points; ++q) {
                if (space.plane_point[static_cast<std::size_t>(plane.info.space_point[q])] != p) continue;
                corners.push_back({plane.mesh.points.x[q], plane.mesh.points.y[q]});
            }
        }
        its.curves = polyline(corners);
        Attempt const solved(on_plane(its, plane));
        INFO(solved.error.text);
        REQUIRE(solved.status >= HM_OK);
        std::vector<double> const move = some_move(solved.report.functions, 0.1, 2);
        std::size_t const n = space.x.size();
        std::vector<double> step(3 * n), dj(3 * n);
        std::mt19937 random(9);
        for (double& d : dj) d = uniform(random) - 0.5;
        hm_space_points_out const to{step.data(), step.data() + n, step.data() + 2 * n, 1};
        hm_space_points const by{dj.data(), dj.data() + n, dj.data() + 2 * n, 1};
        REQUIRE(hm_plane_morph(plane.plane, solved.basis, move.data(), nullptr, &to, nullptr, nullptr) == HM_OK);
        std::vector<double> gradient(move.size()), again(move.size());
        REQUIRE(hm_plane_adjoint(plane.plane, solved.basis, &by, gradient.data(), nullptr, nullptr) == HM_OK);
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
        REQUIRE(hm_plane_adjoint(plane.plane, solved.basis, &by, again.data(), &executor, nullptr) == HM_OK);
        CHECK(same_bits(gradient, again));
        std::vector<double> px(static_cast<std::size_t>(plane.info.n_points)), py = px;
        REQUIRE(hm_plane_gather(plane.plane, &by, points_out(px, py), nullptr, nullptr) == HM_OK);
        REQUIRE(hm_adjoint(solved.basis, points_in(px, py), again.data(), nullptr, nullptr) == HM_OK);
        CHECK(same_bits(gradient, again));
    }
}

TEST_CASE("a wedge of many layers needs its axis; a wedge whose axis is given finds the same plane") {
    Case its = raised_case(2);
    Extruded const many(its.mesh, wedge(3), 4, 2), two(its.mesh, wedge(3), 2, 2);
    hm_space_mesh space = many.view();
    space.kind = HM_WEDGE;
    CHECK(Plane(space).status == HM_BAD_ARGUMENT);
    CHECK(says(Plane(space).error, "the axis"));
    space.axis[0] = -5;
    space.axis_point[0] = 3;
    Plane const of_many(space);
    INFO(of_many.error.text);
    REQUIRE(of_many.status == HM_OK);
    CHECK(of_many.info.layers == 4);
    CHECK(all_follow(of_many, many));
    Plane const of_two(two.view());
    REQUIRE(of_two.status == HM_OK);
    CHECK(of_two.info.x_direction[0] == 1);
    CHECK(of_two.info.x_direction[1] == 0);
    CHECK(of_two.info.origin[1] == 0);
    CHECK(of_two.info.origin[2] == 0);
    space.axis[1] = 1;
    CHECK(Plane(space).status == HM_BAD_ARGUMENT);
    CHECK(says(Plane(space).error, "does not lie in the plane"));
    space.axis[1] = 0;
    space.axis_point[1] = 4 * std::cos(-1.5 * std::acos(-1.0) / 180);
    space.axis_point[2] = 4 * std::sin(-1.5 * std::acos(-1.0) / 180);
    CHECK(Plane(space).status == HM_BAD_MESH);
    CHECK(says(Plane(space).error, "axis of the wedge crosses the mesh"));
}

TEST_CASE("numbers of six digits, as text files have them, are accurate enough") {
    for (Placement const& place : {along_axis(2), wedge(5)}) {
        Case its = raised_case(1);
        Extruded space(its.mesh, place, 2, 4);
        for (std::vector<double>* values : {&space.x, &space.y, &space.z}) {
            for (double& value : *values) {
                char text[32];
                std::snprintf(text, sizeof text, "%.6g", value);
                value = std::strtod(text, nullptr);
            }
        }
        Plane const plane(space.view());
        INFO(plane.error.text);
        REQUIRE(plane.status == HM_OK);
        CHECK(all_follow(plane, space));
        CHECK(plane.info.max_distance < 1e-5);
    }
}

TEST_CASE("both sides of a cut are followed by their own points, layer by layer") {
    CMesh const c = c_mesh(naca4(Naca4{}, 12), 6, 4, stretched(1e-2, 4, 8));
    for (int const layers : {2, 3}) {
        Extruded const space(c.mesh, along_axis(2), layers);
        Plane const plane(space.view());
        INFO(plane.error.text);
        REQUIRE(plane.status == HM_OK);
        CHECK(all_follow(plane, space));
    }
    // A layer that has joined the two sides follows the first.
    Extruded space(c.mesh, along_axis(2));
    std::int32_t const lower = 0, upper = c.ni - 1, n = c.mesh.n_points();
    space.x.pop_back();  // the last point of the second layer is the far corner; the cut's end is joined instead
    space.x.push_back(space.x[static_cast<std::size_t>(n + lower)]);
    space.y.back() = space.y[static_cast<std::size_t>(n + lower)];
    CHECK(space.x[static_cast<std::size_t>(lower)] == space.x[static_cast<std::size_t>(upper)]);
    hm_space_mesh view = space.view();
    view.n_sides = 0;
    CHECK(Plane(view).status == HM_BAD_MESH);  // the far corner has lost its partner
}

TEST_CASE("threads, strides, both index bases, and four entries for each face give the same plane") {
    Case its = tiny_case();
    Extruded const space(its.mesh, along_axis(1), 2, 8);
    Plane const plane(space.view());
    REQUIRE(plane.status == HM_OK);
    std::vector<double> all(3 * space.x.size());
    for (std::size_t k = 0; k < space.x.size(); ++k) {
        all[3 * k] = space.x[k];
        all[3 * k + 1] = space.y[k];
        all[3 * k + 2] = space.z[k];
    }
    hm_space_mesh other = space.view();
    other.index_base = 1;
    other.points = {all.data(), all.data() + 1, all.data() + 2, 3};
    std::vector<std::int32_t> four, sides = space.sides;
    for (std::size_t face = 0; face + 1 < space.face_start.size(); ++face) {
        for (std::int32_t k = 0; k < 4; ++k) {
            std::int32_t const at = std::min(space.face_start[face] + k, space.face_start[face + 1] - 1);
            four.push_back(space.faces[static_cast<std::size_t>(at)] + 1);
        }
    }
    for (std::int32_t& point : sides) ++point;
    other.face_start = nullptr;
    other.face_points = four.data();
    other.side_points = sides.data();
    Plane const again(other);
    INFO(again.error.text);
    REQUIRE(again.status == HM_OK);
    CHECK(again.mesh.index_base == 1);
    bool same = plane.mesh.n_cells == again.mesh.n_cells && plane.mesh.n_faces == again.mesh.n_faces;
    for (std::size_t k = 0; k < space.x.size(); ++k)
        same = same && plane.info.follows[k] + 1 == again.info.follows[k];
    for (std::int32_t c = 0; c <= plane.mesh.n_cells; ++c) {
        same = same && plane.mesh.cell_start[c] + 1 == again.mesh.cell_start[c];
    }
    for (std::int32_t k = 0; k < plane.mesh.cell_start[plane.mesh.n_cells]; ++k) {
        same = same && plane.mesh.cell_points[k] + 1 == again.mesh.cell_points[k];
    }
    for (std::int32_t f = 0; f < 2 * plane.mesh.n_faces; ++f) {
        same = same && plane.mesh.face_points[f] + 1 == again.mesh.face_points[f];
    }
    CHECK(same);
}

TEST_CASE("what is no plane mesh in layers is refused, and the point, face or side is named") {
    Untrapped const untrapped;
    Case its = tiny_case();
    Extruded const good(its.mesh, along_axis(2));
    std::int32_t const n = its.mesh.n_points();
    auto refused = [](Extruded const& space, const char* words, std::int32_t item) {
        Plane const plane(space.view());
        INFO(plane.error.text);
        CHECK(plane.status == HM_BAD_MESH);
        CHECK(says(plane.error, words));
        CHECK(plane.error.item == item);
        CHECK(plane.plane == nullptr);
    };
    REQUIRE(Plane(good.view()).status == HM_OK);
    Extruded bad = good;
    bad.x[static_cast<std::size_t>(n + 9)] += 0.1;
    refused(bad, "point 57 is 1.00000e-1 away from being opposite", n + 9);
    bad = good;
    for (std::size_t k = static_cast<std::size_t>(n); k < bad.x.size(); ++k) bad.x[k] *= 1.01;  // a tapered wing
    refused(bad, "away from being opposite", n + 1);
    bad = good;
    bad.z[5] += 0.2;
    refused(bad, "point 5 of the faces is 2.00000e-1 outside the plane", 5);
    bad = good;
    bad.x[3] = std::nan("");
    refused(bad, "point 3 has a coordinate that is not finite", 3);
    bad = good;
    bad.y[3] = 1e101;
    refused(bad, "1e100", 3);
    bad.y[3] = 1e100;
    refused(bad, "away from being opposite", n + 3);
    bad = good;
    bad.faces[6] = 2 * n;
    refused(bad, "face 1 names point 96", 1);
    bad = good;
    bad.sides[1] = -1;
    refused(bad, "side 0 names point -1", 0);
    bad = good;
    bad.sides[1] = bad.sides[0];
    bad.sides[2] = bad.sides[3];
    refused(bad, "side 0 has points of 1 different points of the plane", 0);
    bad = good;
    bad.sides[1] = 20;
    refused(bad, "side 0 has points of 3 different", 0);
    bad = good;
    bad.x[static_cast<std::size_t>(n + 9)] = bad.x[static_cast<std::size_t>(n + 10)];
    bad.y[static_cast<std::size_t>(n + 9)] = bad.y[static_cast<std::size_t>(n + 10)];
    refused(bad, "point 9 of the faces has no point opposite", 9);
    bad = good;
    bad.face_start[0] = 1;
    refused(bad, "face_start must begin with index_base, not 1", 1);
    bad = good;
    bad.face_start[3] = bad.face_start[2] + 2;
    refused(bad, "face 2 has 2 points", 2);
    bad = good;
    for (double& y : bad.y) y = 0;
    refused(bad, "on one line", -1);
}

TEST_CASE("arguments of the plane: NULL, ranges, another mesh's basis") {
    Untrapped const untrapped;
    Case its = tiny_case();
    Extruded const good(its.mesh, along_axis(2));
    Plane plane(good.view());
    std::size_t bytes = 0;
    hm_plane* made = nullptr;
    hm_space_mesh space = good.view();
    unsigned char block[64];
    CHECK(hm_plane_size(nullptr, &bytes, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_size(&space, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_init(nullptr, block, 64, &space, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_init(&made, nullptr, 64, &space, nullptr) == HM_BAD_ARGUMENT);
    auto refused = [&](hm_status status, const char* text, auto change) {
        hm_space_mesh changed = good.view();
        change(changed);
        Plane const its_plane(changed);
        CHECK(its_plane.status == status);
        CHECK(std::string(its_plane.error.text) == text);
    };
    auto const bad_argument = [&](const char* text, auto change) { refused(HM_BAD_ARGUMENT, text, change); };
    bad_argument("space.struct_size is not set", [](hm_space_mesh& s) { s.struct_size = 0; });
    bad_argument("space.kind 3 is unknown", [](hm_space_mesh& s) { s.kind = 3; });
    bad_argument("space.kind -1 is unknown", [](hm_space_mesh& s) { s.kind = -1; });
    bad_argument("space.index_base must be 0 or 1, not 2", [](hm_space_mesh& s) { s.index_base = 2; });
    bad_argument("space.points.x, y or z is NULL", [](hm_space_mesh& s) { s.points.x = nullptr; });
    bad_argument("space.points.x, y or z is NULL", [](hm_space_mesh& s) { s.points.y = nullptr; });
    bad_argument("space.points.x, y or z is NULL", [](hm_space_mesh& s) { s.points.z = nullptr; });
    bad_argument("space.points.stride is negative", [](hm_space_mesh& s) { s.points.stride = -1; });
    bad_argument("space.face_points is NULL", [](hm_space_mesh& s) { s.face_points = nullptr; });
    bad_argument("space.side_points or space.side_markers is NULL", [](hm_space_mesh& s) { s.side_points = nullptr; });
    bad_argument("space.side_points or space.side_markers is NULL", [](hm_space_mesh& s) { s.side_markers = nullptr; });
    bad_argument("space.n_sides must be between 0 and 2^29, not -1", [](hm_space_mesh& s) { s.n_sides = -1; });
    bad_argument("space.n_sides must be between 0 and 2^29, not 536870913",
                 [](hm_space_mesh& s) { s.n_sides = (1 << 29) + 1; });
    bad_argument("space.tolerance must be a length, not -1", [](hm_space_mesh& s) { s.tolerance = -1; });
    bad_argument("space.tolerance must be a length, not NaN", [](hm_space_mesh& s) { s.tolerance = std::nan(""); });
    bad_argument("space.axis or axis_point is not finite, or the kind is not HM_WEDGE",
                 [](hm_space_mesh& s) { s.axis[2] = 1; });  // of no wedge
    bad_argument("space.axis or axis_point is not finite, or the kind is not HM_WEDGE", [](hm_space_mesh& s) {
        s.kind = HM_WEDGE;
        s.axis[2] = std::nan("");
    });
    bad_argument("space.axis is 0, but the other points lie in no inclined plane that would tell the axis",
                 [](hm_space_mesh& s) { s.kind = HM_WEDGE; });
    refused(HM_BAD_MESH, "space.n_points must be between 3 and 2^30, not 2", [](hm_space_mesh& s) { s.n_points = 2; });
    refused(HM_BAD_MESH, "space.n_points must be between 3 and 2^30, not 1073741825",
            [](hm_space_mesh& s) { s.n_points = (1 << 30) + 1; });
    refused(HM_BAD_MESH, "space.n_faces must be between 1 and 2^29, not 0", [](hm_space_mesh& s) { s.n_faces = 0; });
    refused(HM_BAD_MESH, "space.n_faces must be between 1 and 2^29, not 536870913",
            [](hm_space_mesh& s) { s.n_faces = (1 << 29) + 1; });
    struct {
        hm_space_mesh known;
        double more;
    } younger{good.view(), 1};
    younger.known.struct_size = sizeof younger;
    check_texts({{HM_UNSUPPORTED, "space: fields are set that this version of the library does not know",
                  [&](hm_error* e) { return hm_plane_size(&younger.known, &bytes, e); }}});
    static std::int32_t const no_corners[200] = {};
    refused(HM_BAD_MESH, "space.face_start says there are 0 corners of faces",
            [](hm_space_mesh& s) { s.face_start = no_corners; });
    REQUIRE(plane.status == HM_OK);
    Solved const solved(its);
    Case smaller = ring_case(4, 12, 0.5, 2);
    Solved const foreign(smaller);
    std::vector<double> const move(8, 0.0);
    std::vector<double> gradient(64);
    hm_space_points const from = good.points();
    std::vector<double> x = good.x, y = good.y, z = good.z;
    hm_space_points_out const to{x.data(), y.data(), z.data(), 1};
    hm_space_points_out const none{};
    CHECK(hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &to, nullptr, nullptr) == HM_OK);
    CHECK(same_bits(x, good.x));
    CHECK(same_bits(y, good.y));
    CHECK(same_bits(z, good.z));
    hm_space_points_out const backwards{x.data(), y.data(), z.data(), -1};
    auto const morph = [&](const hm_basis* basis, const hm_space_points_out* out) {
        return [&, basis, out](hm_error* e) {
            return hm_plane_morph(plane.plane, basis, move.data(), &from, out, nullptr, e);
        };
    };
    check_texts({{HM_BAD_BASIS, "the basis has 60 points, but the plane 48", morph(foreign.basis, &to)},
                 {HM_BAD_ARGUMENT, "to is NULL", morph(solved.basis, nullptr)},
                 {HM_BAD_ARGUMENT, "to.x, to.y or to.z is NULL", morph(solved.basis, &none)},
                 {HM_BAD_ARGUMENT, "to.stride is negative", morph(solved.basis, &backwards)}});
    CHECK(hm_plane_morph(plane.plane, foreign.basis, move.data(), &from, &to, nullptr, nullptr) == HM_BAD_BASIS);
    CHECK(hm_plane_morph(plane.plane, nullptr, move.data(), &from, &to, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_morph(nullptr, solved.basis, move.data(), &from, &to, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_morph(plane.plane, solved.basis, nullptr, &from, &to, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &none, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_adjoint(plane.plane, foreign.basis, &from, gradient.data(), nullptr, nullptr) == HM_BAD_BASIS);
    CHECK(hm_plane_adjoint(plane.plane, solved.basis, nullptr, gradient.data(), nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_adjoint(plane.plane, solved.basis, &from, nullptr, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_spread(plane.plane, nullptr, &from, &to, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_gather(plane.plane, &from, nullptr, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_info_get(plane.plane, nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_plane_mesh(plane.plane, nullptr, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("one plane of points is a plane mesh, too: each point follows itself") {
    Case its = tiny_case();
    Extruded const space(its.mesh, inclined(), 1, 2);
    Plane const plane(space.view());
    INFO(plane.error.text);
    REQUIRE(plane.status == HM_OK);
    CHECK(plane.info.layers == 1);
    CHECK(plane.info.kind == HM_PLANES);
    CHECK(all_follow(plane, space));
}

TEST_CASE("coordinates may be as large as 1e100, and no larger; cells of three and four corners are no polygons") {
    Extruded space(tiny_case().mesh, along_axis(2));
    CHECK(Plane(space.view()).mesh.cell_layout != HM_CELLS_POLYGONS);
    space.x[0] = 1e100;   // no plane mesh, but not for that
    CHECK(!says(Plane(space.view()).error, "may be as large"));
    space.x[0] = std::nextafter(1e100, 2e100);
    CHECK(says(Plane(space.view()).error, "may be as large as 1e100"));
}

TEST_CASE("the frame of the points that are given: what is behind them is not looked at") {
    Case const its = tiny_case();
    Extruded space(its.mesh, inclined());
    std::size_t const n = static_cast<std::size_t>(space.n_points());
    std::vector<std::uint8_t> in_faces(n + 1, 0);
    for (std::int32_t const point : space.faces)
        if (point >= 0) in_faces[static_cast<std::size_t>(point)] = 1;
    for (double const behind : {1e3, -1e3}) {
        for (std::vector<double>* const axis : {&space.x, &space.y, &space.z}) {
            axis->resize(n);
            axis->push_back(behind * static_cast<double>(n + axis->size()));
        }
        harmorph::SpaceMesh mesh;
        mesh.n_points = static_cast<harmorph::Index>(n);
        mesh.points = {space.x.data(), space.y.data(), space.z.data(), 1};
        harmorph::Frame frames[2];
        for (std::size_t const side : {0u, 1u}) {
            in_faces[n] = static_cast<std::uint8_t>(side);
            harmorph::Fault fault;
            CHECK(find_frame(mesh, {in_faces.data(), n}, frames[side], fault) == harmorph::Status::ok);
        }
        for (harmorph::Index axis = 0; axis < 3; ++axis) CHECK(frames[0].normal[axis] == frames[1].normal[axis]);
        CHECK(frames[0].tolerance == frames[1].tolerance);
        CHECK(frames[0].tolerance < 1e-3);
    }
}

TEST_CASE("what lies behind the arrays of a space mesh does not count") {
    Case const its = tiny_case();
    for (Placement const& place : {inclined(), along_axis(1), wedge(5)}) {
        Extruded space(its.mesh, place);
        Plane const plain(space.view());
        REQUIRE(plain.status == HM_OK);
        std::int32_t const n = space.n_points();
        space.x.push_back(1e90);
        space.y.push_back(-1e90);
        space.z.push_back(1e90);
        hm_space_mesh longer = space.view();
        longer.n_points = n;
        Plane const with(longer);
        REQUIRE(with.status == HM_OK);
        for (int d = 0; d < 3; ++d) {
            CHECK(with.info.normal[d] == plain.info.normal[d]);
            CHECK(with.info.origin[d] == plain.info.origin[d]);
        }
        CHECK(with.info.max_distance == plain.info.max_distance);
        CHECK(with.mesh.n_points == plain.mesh.n_points);
    }
}
