// The part of a mesh that a report shows, so that the report is small enough for any browser: all
// cells near the moving body, and a selection of the other points and edges, which is only drawn.
#pragma once

#include "mesh/loops.hpp"

#include <cstdint>
#include <vector>

namespace cli {

struct ReportSelection {
    std::vector<std::int32_t> points;  // places in the mesh; points of whole cells come first
    std::int32_t in_cells = 0;         // number of points of whole cells
    std::vector<std::int32_t> cells;   // all cells with no other points
    std::vector<Edge> edges;           // lines beyond the cells: places in `points`
};

// Selects the cells all of whose points are among the max_points points nearest to the body. body:
// its mesh points.
ReportSelection select_for_report(const Mesh& mesh, const std::vector<std::int32_t>& body,
                                  std::int32_t max_points);

}  // namespace cli
