// A mesh of three dimensions that is one cell thick, and the mesh of its symmetry plane. The
// library assigns each point of space to the point of the plane with which it moves, between planes
// of any direction and in wedges.
#pragma once

#include "mesh/mesh_file.hpp"

#include <harmorph_space.h>

#include <array>

namespace cli {

// The points of a file that are corners of cells, in its order.
struct SpacePoints {
    std::array<std::vector<double>, 3> x;            // x, y, z
    std::array<std::vector<std::size_t>, 3> offset;  // the places of the coordinates in the file
    std::vector<std::int32_t> number;  // among all points of the file; empty: no other points
    std::int32_t n_in_file = 0;        // all points of the file, if `number` is not empty

    std::int32_t points() const { return static_cast<std::int32_t>(x[0].size()); }
    std::int64_t number_of(std::size_t point) const {
        return number.empty() ? static_cast<std::int64_t>(point) : number[point];
    }
    std::int64_t all_points() const { return number.empty() ? points() : n_in_file; }
};

// A point of the file at the place of another point, which the cells use instead.
struct SpaceCopy {
    std::int32_t original;
    std::array<double, 3> x;
    std::array<std::size_t, 3> offset;
    std::int32_t number;  // among all points of the file
};

// A node of an element of second order that is no corner.
struct SpaceMiddle {
    std::vector<std::int32_t> corners;  // points of which the node is the middle
    std::array<double, 3> x;
    std::array<std::size_t, 3> offset;
    std::int32_t number;  // among all points of the file
};

struct SpaceMesh {
    SpacePoints points;
    std::vector<SpaceMiddle> middles;
    std::vector<SpaceCopy> copies;  // copies move as their originals
    std::vector<std::int32_t> face_start = {0},
                              face_points;  // of one symmetry plane; counted from 0
    std::vector<std::size_t> face_offset;   // place of each face in the file, for messages
    std::vector<std::int32_t> side_points, side_markers;  // four points each; markers of the mesh
    std::vector<std::size_t> side_offset;
    std::int32_t kind = 0;  // HM_SPACE_AUTO, HM_PLANES or HM_WEDGE

    template <class Points>
    void add_face(const Points& points_of_face, std::size_t offset) {
        face_points.insert(face_points.end(), std::begin(points_of_face), std::end(points_of_face));
        face_start.push_back(static_cast<std::int32_t>(face_points.size()));
        face_offset.push_back(offset);
    }
};

// Fills the points and slots of a mesh whose points all lie in one plane x, y or z = constant.
// Refuses other points.
void take_flat(Mesh& mesh, const SpacePoints& points, const std::vector<SpaceCopy>& copies);

// Fills points, cells, faces and slots of the mesh. Refuses a mesh that is not one cell thick, and
// names the point and the line.
void take_plane(Mesh& mesh, const SpaceMesh& space);

}  // namespace cli
