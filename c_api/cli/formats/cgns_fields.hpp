// Solutions at the vertices of a CGNS file (FlowSolution_t with GridLocation Vertex) as a table:
// the columns x, y, z, and one column for each array, with the name of the array. The rows are the
// points of all zones, in the order in which the mesh of a CGNS file has them.
#pragma once

#include "formats/point_table.hpp"

namespace cli {

// A program without CGNS refuses the file.
PointTable read_cgns_fields(const TextFile& file);

}  // namespace cli
