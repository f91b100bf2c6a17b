// Meshes of three dimensions that are one cell thick, from their cells: between two planes of any
// direction, or in a wedge round an axis.
#pragma once

#include "mesh/cell_faces.hpp"
#include "mesh/space_mesh.hpp"

namespace cli {

// A plane of such a mesh is a set of boundary faces, one of each cell, that are connected by their
// edges. Planes are found from the topology alone, so they do not depend on rounding.
class OneCellThick {
public:
    OneCellThick(Mesh& mesh, SpacePoints points) : mesh_(mesh) {
        space_.points = std::move(points);
    }

    // Adds a cell that is given by its corners, as CellFaces::add() does. `offset` is the place of
    // the cell in the file.
    void add_cell(const std::int32_t* points, std::size_t n, std::size_t offset);

    // Adds a face to the cell that the next call of end_cell() ends.
    void add_cell_face(const std::int32_t* points, std::size_t n) { cells_.add_face(points, n); }
    void end_cell(std::size_t offset);

    // Adds a face of the boundary with a marker of the mesh. finish() ignores faces in the planes,
    // and refuses other faces of more than 4 points.
    void add_side(const std::int32_t* points, std::size_t n, std::int32_t marker,
                  std::size_t offset);
    void add_middle(SpaceMiddle middle) { space_.middles.push_back(std::move(middle)); }
    void add_copy(const SpaceCopy& copy) { space_.copies.push_back(copy); }
    const SpacePoints& points() const { return space_.points; }

    // Fills the mesh and removes the markers of the planes. Refuses a mesh that is not one cell
    // thick and names a cell or a point.
    void finish();

private:
    // [cells] The face of each cell in a plane; -1: not known.
    using PlaneFaces = std::vector<std::int32_t>;

    struct Side {
        std::size_t first, n, offset;  // its points are side_points_[first], ...
        std::int32_t marker;
    };
    bool spread(std::int32_t face, PlaneFaces& plane, std::vector<std::int32_t>& cells) const;
    void find_planes(std::int32_t cell);
    void add_plane_face(std::int32_t cell);
    void keep_side(const Side& side);
    bool put_in_order(std::int32_t cell);
    double distance(const PlaneFaces& plane, const std::vector<std::int32_t>& cells) const;
    std::array<double, 3> corner(std::int32_t face, std::size_t k) const;
    std::string coordinates(std::int32_t point) const;

    Mesh& mesh_;
    SpaceMesh space_;
    CellFaces cells_;
    std::vector<std::size_t> cell_offset_;
    std::vector<Side> sides_;
    std::vector<std::int32_t> side_points_;
    PlaneFaces planes_[2];  // the plane of the mesh, and the opposite one
    PlaneFaces found_[2];   // the planes of one connected part of the mesh
    std::array<double, 3> origin_ = {}, normal_ = {};  // of the first face in the plane
};

}  // namespace cli
