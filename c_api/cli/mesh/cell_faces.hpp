// The faces of cells in three dimensions, and the faces that two cells share. Only the topology is
// used, not the coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cli {

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

}  // namespace cli
