// What the library finds out about a mesh by itself, without curves.
#pragma once

#include <harmorph_study.h>
#include "basics/geometry.hpp"
#include "basics/library.hpp"

#include <vector>

namespace cli {

struct BoundaryPiece {  // points in order, the mesh on their left
    std::vector<std::int32_t> points;
    bool is_loop = false;
};

class MeshAnalysis {
public:
    explicit MeshAnalysis(
        const Mesh& mesh);  // refuses a mesh that is not well formed; inverted cells are allowed
    MeshAnalysis(const MeshAnalysis&) = delete;

    hm_mesh_report report() const;
    // Refuses more than one piece, unless the one nearest to a point is asked for.
    BoundaryPiece boundary(const std::vector<std::int32_t>& markers,
                           const Point* near = nullptr) const;

private:
    const Mesh& mesh_;
    hm_mesh view_;
    Block block_;
    hm_analysis* analysis_ = nullptr;
};

}  // namespace cli
