// Results of the library about a mesh alone, without curves.
#pragma once

#include "basics/geometry.hpp"
#include "basics/library.hpp"
#include "mesh/mesh_file.hpp"

#include <harmorph_study.h>

#include <vector>

namespace cli {

struct BoundaryPiece {  // points in order, with the mesh on the left
    std::vector<std::int32_t> points;
    bool is_loop = false;
};

class MeshAnalysis {
public:
    // Refuses a mesh that is not well formed, but allows inverted cells.
    explicit MeshAnalysis(const Mesh& mesh);
    MeshAnalysis(const MeshAnalysis&) = delete;

    const hm_analysis* get() const { return analysis_; }
    hm_mesh_report report() const;
    // Returns the piece of the markers nearest to a point. Without a point, refuses several pieces.
    BoundaryPiece boundary(const std::vector<std::int32_t>& markers,
                           const Point* near = nullptr) const;

private:
    const Mesh& mesh_;
    hm_mesh view_;
    Block block_;
    hm_analysis* analysis_ = nullptr;
};

}  // namespace cli
