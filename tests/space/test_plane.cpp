// The plane of meshes of three dimensions that are one cell thick: which point follows which, kinds
// and axes.
#include <harmorph_space.h>

#include <algorithm>

#include <fixtures/o_mesh.hpp>
#include <fixtures/extruded.hpp>

using namespace fixtures;

TEST_CASE("a wedge of many layers needs its axis, and a given axis finds the same plane") {
    Case setup = raised_case(2);
    Extruded const many(setup.mesh, wedge(3), 4, 2), two(setup.mesh, wedge(3), 2, 2);
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
    space.axis_point[1] = 4 * std::cos(-1.5 * pi / 180);
    space.axis_point[2] = 4 * std::sin(-1.5 * pi / 180);
    CHECK(Plane(space).status == HM_BAD_MESH);
    CHECK(says(Plane(space).error, "axis of the wedge crosses the mesh"));
}

TEST_CASE("numbers of six digits, as in text files, are accurate enough") {
    for (Placement const& place : {along_axis(2), wedge(5)}) {
        Case setup = raised_case(1);
        Extruded space(setup.mesh, place, 2, 4);
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
    space.x.pop_back();  // the last point of the second layer is the far corner; the cut's end is
                         // joined instead
    space.x.push_back(space.x[std::size_t(n + lower)]);
    space.y.back() = space.y[std::size_t(n + lower)];
    CHECK(space.x[std::size_t(lower)] == space.x[std::size_t(upper)]);
    hm_space_mesh view = space.view();
    view.n_sides = 0;
    CHECK(Plane(view).status == HM_BAD_MESH);  // the far corner has lost its partner
}

TEST_CASE(
    "sides say which points of an interface follow which, also where they differ by rounding") {
    // Two squares side by side with points of their own on the common line. The layer at z = 1 has
    // the points of the right square first.
    double const x[] = {0, 1, 1, 0, 1, 2, 2, 1}, y[] = {0, 0, 1, 1, 0, 0, 1, 1};
    for (double const rounding : {0.0, 1e-15}) {
        double space_x[16], space_y[16], space_z[16];
        std::int32_t opposite[8];
        for (std::int32_t k = 0; k < 8; ++k) {
            opposite[k] = 8 + (k + 4) % 8;
            for (std::int32_t const at : {k, opposite[k]}) {
                space_x[at] = x[k] + (k >= 4 ? rounding : 0.0) * (at >= 8 ? -1 : 1);
                space_y[at] = y[k];
                space_z[at] = at >= 8;
            }
        }
        std::int32_t const faces[] = {0, 1, 2, 3, 4, 5, 6, 7};
        std::int32_t sides[32], markers[8];
        for (std::int32_t k = 0; k < 8; ++k) {
            std::int32_t const next = k / 4 * 4 + (k + 1) % 4;
            std::int32_t const side[] = {k, next, opposite[next], opposite[k]};
            std::copy_n(side, 4, sides + 4 * k);
            markers[k] = k;
        }
        hm_space_mesh space;
        HM_INIT(space);
        space.n_points = 16;
        space.points = {space_x, space_y, space_z, 1};
        space.n_faces = 2;
        space.face_points = faces;
        space.n_sides = 8;
        space.side_points = sides;
        space.side_markers = markers;
        Plane const plane(space);
        INFO(plane.error.text);
        REQUIRE(plane.status == HM_OK);
        for (std::int32_t k = 0; k < 8; ++k) {
            CHECK(plane.info.follows[k] == k);
            CHECK(plane.info.follows[opposite[k]] == k);
        }
    }
}

TEST_CASE("layers may number the points at one place in any order, also those without a side") {
    // Three triangles around a point of the wall have points of their own along the two cuts
    // between them. The middle one, whose point at the wall has no side, lies between the others.
    Mesh mesh;
    Point const left{-1, 0}, wall{0, 0}, upper_left{-.5, 1}, upper_right{.5, 1}, right{1, 0};
    for (Point const& p :
         {left, wall, upper_left, wall, upper_right, upper_left, wall, right, upper_right})
        mesh.add_point(p);
    for (std::int32_t k = 0; k < 9; ++k) mesh.cells.push_back(k);
    mesh.cell_start = {0, 3, 6, 9};
    mesh.faces = {0, 1, 2, 0, 4, 5, 6, 7, 7, 8};
    mesh.face_markers = {1, 2, 2, 1, 2};
    for (int const layers : {2, 3, 4, 5}) {
        for (unsigned seed = 1; seed <= 40; ++seed) {
            Extruded const space(mesh, along_axis(2), layers, seed);
            Plane const plane(space.view());
            INFO(layers << " layers, seed " << seed << ": " << plane.error.text);
            REQUIRE(plane.status == HM_OK);
            CHECK(plane.info.layers == layers);
            CHECK(all_follow(plane, space));
        }
    }
}

TEST_CASE("threads, strides, index bases and four entries for each face give the same plane") {
    Case setup = tiny_case();
    Extruded const space(setup.mesh, along_axis(1), 2, 8);
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
            std::int32_t const at =
                std::min(space.face_start[face] + k, space.face_start[face + 1] - 1);
            four.push_back(space.faces[std::size_t(at)] + 1);
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
    bool same =
        plane.mesh.n_cells == again.mesh.n_cells && plane.mesh.n_faces == again.mesh.n_faces;
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

TEST_CASE("a single plane of points is a mesh of one layer, in which each point follows itself") {
    Case setup = tiny_case();
    Extruded const space(setup.mesh, inclined(), 1, 2);
    Plane const plane(space.view());
    INFO(plane.error.text);
    REQUIRE(plane.status == HM_OK);
    CHECK(plane.info.layers == 1);
    CHECK(plane.info.kind == HM_PLANES);
    CHECK(all_follow(plane, space));
}
