// Meshes of three dimensions and arguments that are refused, each with a sentence and the place.
#include <harmorph_space.h>

#include <fixtures/memory.hpp>
#include <fixtures/extruded.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;

TEST_CASE("a mesh that is no plane mesh in layers is refused; the point, face or side is named") {
    Untrapped const untrapped;
    Case setup = tiny_case();
    Extruded const good(setup.mesh, along_axis(2));
    std::int32_t const n = setup.mesh.n_points();
    auto refused = [](Extruded const& space, const char* words, std::int32_t item) {
        Plane const plane(space.view());
        INFO(plane.error.text);
        CHECK(plane.status == HM_BAD_MESH);
        CHECK(says(plane.error, words));
        CHECK(fixtures::found(plane.error) == item);
        CHECK(plane.plane == nullptr);
    };
    REQUIRE(Plane(good.view()).status == HM_OK);
    Extruded bad = good;
    bad.x[std::size_t(n + 9)] += 0.1;
    refused(bad, "the projection of point 57 is 1.00000e-1 away", n + 9);
    bad = good;
    for (std::size_t k = std::size_t(n); k < bad.x.size(); ++k) bad.x[k] *= 1.01;  // a tapered wing
    refused(bad, "away from the nearest point", n + 1);
    bad = good;
    bad.z[5] += 0.2;
    refused(bad, "point 5 is 2.00000e-1 away from the plane", 5);
    bad = good;
    bad.x[3] = std::nan("");
    refused(bad, "point 3 has a coordinate that is not finite", 3);
    bad = good;
    bad.y[3] = 1e101;
    refused(bad, "1e100", 3);
    bad.y[3] = 1e100;
    refused(bad, "away from the nearest point", n + 3);
    bad = good;
    bad.faces[6] = 2 * n;
    refused(bad, "face 1 names point 96", 1);
    bad = good;
    bad.sides[1] = -1;
    refused(bad, "side 0 names point -1", 0);
    bad = good;
    bad.sides[1] = bad.sides[0];
    bad.sides[2] = bad.sides[3];
    refused(bad, "the points of side 0 belong to 1 points of the plane", 0);
    bad = good;
    bad.sides[1] = 20;
    refused(bad, "the points of side 0 belong to 3 points", 0);
    bad = good;
    bad.x[std::size_t(n + 9)] = bad.x[std::size_t(n + 10)];
    bad.y[std::size_t(n + 9)] = bad.y[std::size_t(n + 10)];
    refused(bad, "point 9 of the faces has no opposite point", 9);
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

TEST_CASE("fields of a space mesh out of range, and bases of another mesh, are refused") {
    Untrapped const untrapped;
    Case setup = tiny_case();
    Extruded const good(setup.mesh, along_axis(2));
    Plane plane(good.view());
    std::size_t bytes = 0;
    auto refused = [&](hm_status status, const char* text, auto change) {
        hm_space_mesh changed = good.view();
        change(changed);
        Plane const refused_plane(changed);
        CHECK(refused_plane.status == status);
        CHECK(std::string(refused_plane.error.text) == text);
    };
    auto const bad_argument = [&](const char* text, auto change) {
        refused(HM_BAD_ARGUMENT, text, change);
    };
    bad_argument("space.struct_size is not the size of an hm_space_mesh; begin with HM_INIT(space)",
                 [](hm_space_mesh& s) { s.struct_size = 0; });
    bad_argument("space.kind is 3, but it must be HM_SPACE_AUTO, HM_PLANES or HM_WEDGE",
                 [](hm_space_mesh& s) { s.kind = 3; });
    bad_argument("space.kind is -1, but it must be HM_SPACE_AUTO, HM_PLANES or HM_WEDGE",
                 [](hm_space_mesh& s) { s.kind = -1; });
    bad_argument("space.index_base must be 0 or 1, not 2",
                 [](hm_space_mesh& s) { s.index_base = 2; });
    bad_argument("space.points.x, space.points.y or space.points.z is NULL",
                 [](hm_space_mesh& s) { s.points.x = nullptr; });
    bad_argument("space.points.x, space.points.y or space.points.z is NULL",
                 [](hm_space_mesh& s) { s.points.y = nullptr; });
    bad_argument("space.points.x, space.points.y or space.points.z is NULL",
                 [](hm_space_mesh& s) { s.points.z = nullptr; });
    bad_argument("space.points.stride is negative", [](hm_space_mesh& s) { s.points.stride = -1; });
    bad_argument("space.face_points is NULL", [](hm_space_mesh& s) { s.face_points = nullptr; });
    bad_argument("space.side_points or space.side_markers is NULL",
                 [](hm_space_mesh& s) { s.side_points = nullptr; });
    bad_argument("space.side_points or space.side_markers is NULL",
                 [](hm_space_mesh& s) { s.side_markers = nullptr; });
    bad_argument("space.n_sides must be between 0 and 2^29, not -1",
                 [](hm_space_mesh& s) { s.n_sides = -1; });
    bad_argument("space.n_sides must be between 0 and 2^29, not 536870913",
                 [](hm_space_mesh& s) { s.n_sides = (1 << 29) + 1; });
    bad_argument("space.tolerance must be a length of 0 or more, not -1",
                 [](hm_space_mesh& s) { s.tolerance = -1; });
    bad_argument("space.tolerance must be a length of 0 or more, not NaN",
                 [](hm_space_mesh& s) { s.tolerance = std::nan(""); });
    bad_argument(
        "space.axis and space.axis_point must be finite, and 0 unless the kind is HM_WEDGE",
        [](hm_space_mesh& s) { s.axis[2] = 1; });  // of no wedge
    bad_argument(
        "space.axis and space.axis_point must be finite, and 0 unless the kind is HM_WEDGE",
        [](hm_space_mesh& s) {
            s.kind = HM_WEDGE;
            s.axis[2] = std::nan("");
        });
    bad_argument(
        "space.axis is 0, and the axis cannot be found, because the other points do not lie in one "
        "inclined plane; set space.axis",
        [](hm_space_mesh& s) { s.kind = HM_WEDGE; });
    refused(HM_BAD_MESH, "space.n_points must be between 3 and 2^30, not 2",
            [](hm_space_mesh& s) { s.n_points = 2; });
    refused(HM_BAD_MESH, "space.n_points must be between 3 and 2^30, not 1073741825",
            [](hm_space_mesh& s) { s.n_points = (1 << 30) + 1; });
    refused(HM_BAD_MESH, "space.n_faces must be between 1 and 2^29, not 0",
            [](hm_space_mesh& s) { s.n_faces = 0; });
    refused(HM_BAD_MESH, "space.n_faces must be between 1 and 2^29, not 536870913",
            [](hm_space_mesh& s) { s.n_faces = (1 << 29) + 1; });
    struct {
        hm_space_mesh known;
        double more;
    } younger{good.view(), 1};
    younger.known.struct_size = sizeof younger;
    check_texts({{HM_UNSUPPORTED,
                  "space contains fields that are set but unknown to this version of the library; "
                  "use the header of this version",
                  call_by(fixtures::plane_size, &younger.known, &bytes)}});
    static std::int32_t const no_corners[200] = {};
    refused(HM_BAD_MESH,
            "by space.face_start the faces have 0 corners, but there must be 3 to 2^31 - 2",
            [](hm_space_mesh& s) { s.face_start = no_corners; });
    REQUIRE(plane.status == HM_OK);
    Solved const solved(setup);
    Case smaller = ring_case(4, 12, 0.5, 2);
    Solved const foreign(smaller);
    std::vector<double> const move(8, 0.0);
    std::vector<double> gradient(64);
    hm_space_points const from = good.points();
    std::vector<double> x = good.x, y = good.y, z = good.z;
    hm_space_points_out const to{x.data(), y.data(), z.data(), 1};
    hm_space_points_out const none{};
    CHECK(hm_plane_morph(plane.plane, solved.basis, move.data(), &from, &to, nullptr, nullptr) ==
          HM_OK);
    CHECK(same_bits(x, good.x));
    CHECK(same_bits(y, good.y));
    CHECK(same_bits(z, good.z));
    hm_space_points_out const backwards{x.data(), y.data(), z.data(), -1};
    auto const morph = [&](const hm_basis* basis, const hm_space_points_out* out) {
        return [&, basis, out](hm_error* e) {
            return hm_plane_morph(plane.plane, basis, move.data(), &from, out, nullptr, e);
        };
    };
    check_texts(
        {{HM_BAD_BASIS, "the basis has 60 points, but the plane has 48", morph(foreign.basis, &to)},
         {HM_BAD_ARGUMENT, "to is NULL", morph(solved.basis, nullptr)},
         {HM_BAD_ARGUMENT, "to.x, to.y or to.z is NULL", morph(solved.basis, &none)},
         {HM_BAD_ARGUMENT, "to.stride is negative", morph(solved.basis, &backwards)}});
    CHECK(hm_plane_adjoint(plane.plane, foreign.basis, &from, gradient.data(), nullptr, nullptr) ==
          HM_BAD_BASIS);
}

TEST_CASE("coordinates up to 1e100 are accepted, and no polygons of three or four corners") {
    Extruded space(tiny_case().mesh, along_axis(2));
    CHECK(Plane(space.view()).mesh.cell_layout != HM_CELLS_POLYGONS);
    space.x[0] = 1e100;  // no plane mesh, but not for that
    CHECK(!says(Plane(space.view()).error, "larger than the limit"));
    space.x[0] = std::nextafter(1e100, 2e100);
    CHECK(says(Plane(space.view()).error, "larger than the limit of 1e100"));
}
