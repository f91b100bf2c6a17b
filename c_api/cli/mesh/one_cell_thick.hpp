// Meshes of three dimensions that are one cell thick, from their cells: between two planes of any
// direction, or in a wedge round an axis.
#pragma once

#include "mesh/cell_faces.hpp"
#include "mesh/space_mesh.hpp"

namespace cli {

// A plane of such a mesh is a set of boundary faces, one of each cell, that are connected by their
// edges. Where cells meet does not depend on rounding, and neither does this.
class OneCellThick {
public:
    OneCellThick(Mesh& mesh, SpacePoints points) : mesh_(mesh) {
        space_.points = std::move(points);
    }

    void add_cell(const std::int32_t* points, std::size_t n,
                  std::size_t offset);  // as in CellFaces::add
    // A face of the boundary, of 3 or 4 points, with a marker of the mesh. Faces in the planes are
    // passed over.
    void add_side(const std::int32_t* points, std::size_t n, std::int32_t marker,
                  std::size_t offset);
    void add_copy(const SpaceCopy& copy) { space_.copies.push_back(copy); }
    const SpacePoints& points() const { return space_.points; }
    // Fills the mesh, which loses the markers of the planes; refuses, naming a cell or a point,
    // what is not one cell thick.
    void finish();

private:
    using PlaneFaces = std::vector<std::int32_t>;  // [cells] the face of each cell that lies in a
                                                   // plane; -1: not known

    struct Side {
        std::array<std::int32_t, 4> points;
        std::size_t n, offset;
        std::int32_t marker;
    };
    bool spread(std::int32_t face, PlaneFaces& plane, std::vector<std::int32_t>& cells) const;
    void find_planes(std::int32_t cell);
    double distance(const PlaneFaces& plane, const std::vector<std::int32_t>& cells) const;
    std::array<double, 3> corner(std::int32_t face, std::size_t k) const;
    std::string place(std::int32_t point) const;

    Mesh& mesh_;
    SpaceMesh space_;
    CellFaces cells_;
    std::vector<std::size_t> cell_offset_;
    std::vector<Side> sides_;
    PlaneFaces planes_[2];  // that of the mesh, and the one opposite
    PlaneFaces found_[2];   // of the part of the mesh at which find_planes is; -1 elsewhere
    std::array<double, 3> origin_ = {}, normal_ = {};  // of the first face in the plane
};

}  // namespace cli
