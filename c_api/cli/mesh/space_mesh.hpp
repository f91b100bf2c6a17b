// From a file's mesh of three dimensions that is one cell thick to the mesh of its symmetry plane:
// the library finds who follows whom, between planes of any direction and in wedges.
#pragma once

#include <harmorph_space.h>
#include "mesh/mesh_file.hpp"

#include <array>

namespace cli {

// All points of a file, in its order.
struct SpacePoints {
    std::array<std::vector<double>, 3> x;            // x, y, z
    std::array<std::vector<std::size_t>, 3> offset;  // where each stands in the file

    std::int32_t points() const { return static_cast<std::int32_t>(x[0].size()); }
};

// A point that the file has again at the place of another one, of which alone cells consist.
struct SpaceCopy {
    std::int32_t of;
    std::array<double, 3> x;
    std::array<std::size_t, 3> offset;
};

struct SpaceMesh {
    SpacePoints points;
    std::vector<SpaceCopy> copies;  // they move as their points
    std::vector<std::int32_t> face_start = {0},
                              face_points;  // of one symmetry plane; counted from 0
    std::vector<std::size_t> face_offset;   // where each stands in the file, for messages
    std::vector<std::int32_t> side_points, side_markers;  // four points each; markers of the mesh
    std::vector<std::size_t> side_offset;
    std::int32_t kind = 0;  // HM_SPACE_AUTO, HM_PLANES or HM_WEDGE

    template <class Points>
    void add_face(const Points& its, std::size_t offset) {
        face_points.insert(face_points.end(), std::begin(its), std::end(its));
        face_start.push_back(static_cast<std::int32_t>(face_points.size()));
        face_offset.push_back(offset);
    }
};

// Fills the points of a mesh whose file has one plane of them, x, y or z = constant, and their
// slots. Refuses others.
void take_flat(Mesh& mesh, const SpacePoints& points, const std::vector<SpaceCopy>& copies);

// Fills points, cells, faces and slots of the mesh. Refuses, naming the point and its line, what is
// not one cell thick.
void take_plane(Mesh& mesh, const SpaceMesh& space);

}  // namespace cli
