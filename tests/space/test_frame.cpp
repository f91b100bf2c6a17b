// The frame of the plane, from the points of the faces alone.
#include <fixtures/extruded.hpp>
#include "space/frame.hpp"

using namespace fixtures;

TEST_CASE("the frame depends on the given points alone; numbers behind the arrays are not read") {
    Case const setup = tiny_case();
    Extruded space(setup.mesh, inclined());
    std::size_t const n = std::size_t(space.n_points());
    std::vector<std::uint8_t> in_faces(n + 1, 0);
    for (std::int32_t const point : space.faces)
        if (point >= 0) in_faces[std::size_t(point)] = 1;
    for (double const behind : {1e3, -1e3}) {
        for (std::vector<double>* const axis : {&space.x, &space.y, &space.z}) {
            axis->resize(n);
            axis->push_back(behind * double(n + axis->size()));
        }
        harmorph::SpaceMesh mesh;
        mesh.n_points = harmorph::Index(n);
        mesh.points = {space.x.data(), space.y.data(), space.z.data(), 1};
        harmorph::Frame frames[2];
        for (std::size_t const side : {0u, 1u}) {
            in_faces[n] = std::uint8_t(side);
            harmorph::Fault fault;
            CHECK(find_frame(mesh, {in_faces.data(), n}, frames[side], fault) ==
                  harmorph::Status::ok);
        }
        for (harmorph::Index axis = 0; axis < 3; ++axis)
            CHECK(frames[0].normal[axis] == frames[1].normal[axis]);
        CHECK(frames[0].tolerance == frames[1].tolerance);
        CHECK(frames[0].tolerance < 1e-3);
    }
}

TEST_CASE("a point within the tolerance of the axis of a wedge has no angle of its own") {
    harmorph::Frame frame;
    frame.kind = harmorph::SpaceKind::wedge;
    frame.x = {1, 0, 0};
    frame.y = {0, 1, 0};
    frame.normal = {0, 0, 1};
    frame.tolerance = 1e-5;
    for (double const r : {0.0, 1e-12, 9e-6, 1.1e-5, 0.3}) {
        for (double const angle : {0.5, 2.5, -1.0}) {
            harmorph::PlacedPoint const placed =
                frame.placed({0.7, r * std::cos(angle), r * std::sin(angle)});
            bool const is_on_axis = r < 1e-5;
            CHECK(placed.place.x == 0.7);
            CHECK(placed.place.y == doctest::Approx(r).epsilon(1e-12));
            CHECK(placed.rotation.x ==
                  doctest::Approx(is_on_axis ? 1 : std::cos(angle)).epsilon(1e-12));
            CHECK(placed.rotation.y ==
                  doctest::Approx(is_on_axis ? 0 : std::sin(angle)).epsilon(1e-12));
        }
    }
}
