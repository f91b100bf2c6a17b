#include "mesh/region_counts.hpp"

namespace harmorph {

RegionCounts RegionCounts::of(Topology const& topology) noexcept {
    Mesh const& mesh = topology.mesh;
    RegionCounts counts;
    counts.points = mesh.n_points;
    counts.cells = mesh.n_checked();
    counts.pairs = topology.edges.count();
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Index const n = mesh.cell(i).n;
        counts.cell_corners += n;
        if (n == 4) counts.pairs += 2;  // the diagonals
    }
    counts.cell_corners += 3 * Offset{mesh.n_guards};
    counts.pairs += mesh.n_guards;  // the neighbours of a corner
    return counts;
}

}  // namespace harmorph
