// Finds the conditions that a list of markers names, where the conditions of one marker may hold on
// several pieces of the marker.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct ConditionsOfMesh {
    const Mesh& mesh;
    const std::vector<hm_condition>& conditions;
    // [points] What moves each point, as in hm_basis_info.point_curve, or -1. If this is empty, the
    // mesh has not moved, so that the places of conditions are on the mesh.
    std::vector<std::int32_t> mover;
    std::int32_t n_curves = 0;

    // Returns the conditions of this kind on the markers and pieces of the list. The name of a
    // marker alone stands for all conditions of the marker, but for the condition without a piece
    // if the kind is HM_RIGID and the marker has such a condition. Refuses names as find_pieces().
    std::vector<hm_condition> find(const std::string& list, std::int32_t kind) const;

private:
    void add_of_marker(std::int32_t marker, std::int32_t kind,
                       std::vector<hm_condition>& found) const;
    void add_of_piece(const MarkerPiece& piece, std::int32_t kind,
                      std::vector<hm_condition>& found) const;
    bool moves_by(const hm_condition& condition, std::int32_t number) const;
};

}  // namespace cli
