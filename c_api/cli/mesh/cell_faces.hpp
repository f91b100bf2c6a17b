// Cells of three dimensions by their faces, and which faces two cells have in common. All of it is
// topology: no coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace cli {

struct CellFaces {
    struct Face {
        std::array<std::int32_t, 4> points;  // in order; a triangle repeats its last point
        std::int32_t cell;
        std::int32_t other =
            -1;  // the same face of the neighbour; -1: there is none, or not connected yet

        std::size_t n() const { return points[3] == points[2] ? 3 : 4; }
        bool has(std::int32_t point) const {
            return points[0] == point || points[1] == point || points[2] == point ||
                   points[3] == point;
        }
    };
    std::vector<Face> faces;                // cell by cell
    std::vector<std::int32_t> start = {0};  // [cells + 1] first face of each

    std::int32_t cells() const { return static_cast<std::int32_t>(start.size()) - 1; }
    // 4 points of a tetrahedron, 5 of a pyramid (its base first), 6 of a prism or 8 of a
    // hexahedron: those of one side, then in the same order those of the other. Points may be the
    // same where sides have collapsed.
    void add(const std::int32_t* points, std::size_t n);

    // Finds the neighbours of all cells. Returns a face that three cells have; -1: there is none.
    std::int32_t connect();
    // After connect(): a face with these points (3 or 4), or -1.
    std::int32_t find(const std::int32_t* points, std::size_t n) const;

private:
    using Points = std::array<std::int32_t, 4>;  // rising
    std::vector<std::pair<Points, std::int32_t>> by_points_;
};

}  // namespace cli
