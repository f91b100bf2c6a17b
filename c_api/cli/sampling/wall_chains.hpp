// The points of walls in order, with normals and arc lengths on moved meshes.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <vector>

namespace cli {

class WallChains {
public:
    // markers: those of the walls. A closed piece begins at the point of the largest x.
    WallChains(const Mesh& mesh, const std::vector<std::int32_t>& markers);

    const std::vector<std::int32_t>& points() const { return points_; }
    // Piece k has the points start[k] .. start[k+1] - 1. The first point of a closed piece is not
    // repeated.
    const std::vector<std::int32_t>& start() const { return start_; }

    // Appends the unit normals, as pairs, and the arc lengths. coordinates: pairs of all mesh
    // points. The normal is that of the line between both neighbours, into the mesh.
    void measure(const std::vector<double>& coordinates, std::vector<double>& normals,
                 std::vector<double>& arcs) const;

private:
    std::vector<std::int32_t> points_, start_ = {0};
    std::vector<bool> is_loop_;
};

}  // namespace cli
