// What a report shows of a moved mesh: the quality of each cell, the first layer along the walls,
// and the measures of closed walls.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace cli {

// A wall that moves, in order, the mesh on the left. The other members of a point without an edge
// of the first layer are NaN.
struct JudgedWall {
    std::int32_t marker = 0;
    bool is_closed = false;
    std::vector<std::int32_t> points;
    std::vector<double> arc;     // [length] before anything moved, from the first wall on
    std::vector<double> angle;   // [degrees] change of the first layer
    std::vector<double> height;  // [-] of the first layer, after over before
};

// The measures of a closed wall, the straight lines between its points. The chord joins the two
// points that are farthest apart at the start, and the one on the left is the leading edge.
struct OutlineMeasures {
    double thickness, camber, area;  // [chords], [chords], [length^2]; NaN where there is none
};

class JudgedMesh {
public:
    // Judges a mesh that moves from its own coordinates.
    JudgedMesh(const Mesh& mesh, const hm_basis* basis, const std::vector<hm_condition>& conditions,
               const Field& displacement);

    std::vector<double> before, after;  // quality of each cell; 0: inverted
    std::vector<JudgedWall> walls;

    // The measures of a closed wall before and after the movement.
    std::pair<OutlineMeasures, OutlineMeasures> measures(const JudgedWall& wall) const;

private:
    void judge_cells(const hm_basis* basis, const Field& displacement);
    void find_walls(const std::vector<std::int32_t>& markers);

    const Mesh& mesh_;
    Field moved_;
};

}  // namespace cli
