// Which part of a mesh the page of `harmorph explore` shows, so that any browser can follow: all of
// it near what moves; far from there fewer points, for drawing alone.
#pragma once

#include "pictures/edge_chains.hpp"

#include <cstdint>
#include <vector>

namespace cli {

struct PageSelection {
    std::vector<std::int32_t> points;  // places in the mesh; first those of whole cells
    std::int32_t in_cells = 0;  // how many of them are points of cells, or of faces between these
    std::vector<std::int32_t> cells;  // all cells with no other points than those
    std::vector<Edge> edges;          // what is drawn of the rest: places in `points`
    std::vector<std::int32_t> faces;  // of the boundary, both of whose points are among them
};

// The `most` points nearest to the body, which is given by its mesh points, as far as whole cells
// are made of them.
PageSelection select_for_page(const Mesh& mesh, const std::vector<std::int32_t>& body,
                              std::int32_t most);

}  // namespace cli
