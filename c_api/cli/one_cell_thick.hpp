// Meshes of three dimensions that are one cell thick: two planes of points, and cells from one to the other.
#pragma once

#include "mesh.hpp"

#include <array>

namespace cli {

// All points of a file, in its order.
struct SpacePoints {
    std::array<std::vector<double>, 3> x;           // x, y, z
    std::array<std::vector<std::size_t>, 3> offset; // where each stands in the file

    std::int32_t points() const { return static_cast<std::int32_t>(x[0].size()); }
};

// The direction across, and which of the two planes each point lies in.
struct Planes {
    int normal;               // 0, 1, 2: the planes are x = constant, y = constant, z = constant
    int first, second;        // what x and y of the plane's mesh are: x-y, x-z or y-z
    std::vector<char> upper;  // [points] 1: in the plane of the larger coordinate
};

// Refuses, naming a point, what is no pair of such planes.
Planes find_planes(const Mesh& mesh, const SpacePoints& space);

// Makes a point of the plane's mesh of two points opposite each other, which both follow it; or of one, in two
// dimensions (partner -1). Refuses points whose coordinates in the plane are not the same.
void add_plane_point(Mesh& mesh, const SpacePoints& space, const Planes& planes, std::int32_t point,
                     std::int32_t partner);

// The same for a place where the plane's mesh has a point, `number`, already.
void follow_both(Mesh& mesh, const SpacePoints& space, const Planes& planes, std::int32_t number, std::int32_t point,
                 std::int32_t partner);

// From cells and boundary faces of three dimensions to the mesh of the lower plane.
class OneCellThick {
public:
    OneCellThick(Mesh& mesh, const SpacePoints& space);

    // 6 points of a prism or 8 of a hexahedron: those of one side, then in the same order those of the other.
    void add_cell(const std::int32_t* points, std::size_t n, std::size_t offset);
    void add_side(const std::int32_t* points, std::size_t n, const std::string& marker, std::size_t offset); // 3 or 4
    void finish(); // fills the mesh

private:
    struct Item {
        std::array<std::int32_t, 4> points; // in the lower plane
        std::int32_t n, marker;
        std::size_t offset;
    };
    bool is_upper(std::int32_t point) const { return planes_.upper[static_cast<std::size_t>(point)] != 0; }
    void pair(std::int32_t lower, std::int32_t upper, std::size_t offset);

    Mesh& mesh_;
    const SpacePoints& space_;
    Planes planes_;
    std::vector<std::int32_t> partner_; // [points] of those in the lower plane; -1: none
    std::vector<Item> cells_, sides_;
};

} // namespace cli
