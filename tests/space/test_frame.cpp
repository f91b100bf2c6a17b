// The frame of the plane, from the points of the faces alone.
#include <doctest/doctest.h>

#include <fixtures/plane.hpp>
#include "space/frame.hpp"

using namespace fixtures;

TEST_CASE(
    "the frame depends on the given points alone: numbers behind the end of the arrays are not "
    "read") {
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
            CHECK(find_frame(mesh, {in_faces.data(), n}, frames[side], fault) ==
                  harmorph::Status::ok);
        }
        for (harmorph::Index axis = 0; axis < 3; ++axis)
            CHECK(frames[0].normal[axis] == frames[1].normal[axis]);
        CHECK(frames[0].tolerance == frames[1].tolerance);
        CHECK(frames[0].tolerance < 1e-3);
    }
}
