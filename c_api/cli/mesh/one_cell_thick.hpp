// Meshes of three dimensions that are one cell thick, from their cells: between two planes of any
// direction, or in a wedge round an axis.
#pragma once

#include "mesh/space_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cli {

// The faces of cells in three dimensions, and the faces that two cells share. Only the topology is
// used, not the coordinates.

class CellFaces {
public:
    struct Face {
        std::int32_t first, n;  // its points are points[first] ... points[first + n - 1], in order
        std::int32_t cell;
        std::int32_t other = -1;  // the same face of the neighbour; -1: no neighbour is known
    };
    std::vector<Face> faces;                // in the order of the cells
    std::vector<std::int32_t> points;       // of all faces
    std::vector<std::int32_t> start = {0};  // [cells + 1] the first face of each cell

    std::int32_t cells() const { return static_cast<std::int32_t>(start.size()) - 1; }

    // Adds a cell that is given by its corners: 4 points of a tetrahedron, 5 of a pyramid (the base
    // first), 6 of a prism or 8 of a hexahedron (the points of one side, then in the same order
    // those of the opposite side). Points may coincide where sides have collapsed.
    void add(const std::int32_t* corners, std::size_t n);

    // Adds a face, of at least three points, to the cell that the next call of end_cell() ends.
    void add_face(const std::int32_t* corners, std::size_t n);
    void end_cell() { start.push_back(static_cast<std::int32_t>(faces.size())); }

    // Finds the neighbours of all cells. Returns a face that three cells share, or -1 if there is
    // none.
    std::int32_t connect();

    // Returns a face with these points (at least three), or -1. Needs connect().
    std::int32_t find(const std::int32_t* corners, std::size_t n) const;

    // Returns the other face at the edge a, b of the cell of `face`, or -1 if there is none. Needs
    // connect(). The time grows at most with the logarithm of the number of edges.
    std::int32_t across(std::int32_t face, std::int32_t a, std::int32_t b) const;

private:
    // The four smallest points and the number of points identify a face: two faces of a mesh have
    // at most one edge in common.
    using Key = std::array<std::int32_t, 5>;
    struct Edge {
        std::int32_t cell, a, b, face;  // a < b
        bool operator<(const Edge& other) const;
    };
    static Key key(const std::int32_t* corners, std::size_t n);
    bool has_edge(const Face& face, std::int32_t a, std::int32_t b) const;
    void index_large_cells();

    std::vector<std::pair<Key, std::int32_t>> by_key_;
    std::vector<Edge> edges_;  // of cells with many faces, in order
};

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
