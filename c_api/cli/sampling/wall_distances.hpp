// Distances of all mesh points to the moving walls, on one moved mesh after the other.
#pragma once

#include "files/threads.hpp"
#include "mesh/mesh_analysis.hpp"

#include <harmorph_fields.h>

#include <cstdint>
#include <vector>

namespace cli {

class WallDistances {
public:
    // markers: those of the walls.
    WallDistances(const Mesh& mesh, const std::vector<std::int32_t>& markers,
                  const Threads& threads);
    WallDistances(const WallDistances&) = delete;

    // coordinates: pairs of all mesh points. The array stays valid until the next call.
    const std::vector<double>& values(const std::vector<double>& coordinates);

private:
    const Mesh& mesh_;
    const Threads& threads_;
    Block block_;
    hm_walls* walls_ = nullptr;
    std::vector<std::int32_t> faces_;  // the nearest faces on the preceding mesh, as hints
    std::vector<double> distances_;
};

}  // namespace cli
