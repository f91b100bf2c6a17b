// Types of elements, and the reader of SU2 files.
#pragma once

#include "formats/format.hpp"

namespace cli {

enum Su2Element {
    element_vertex = 1,
    element_line = 3,
    element_triangle = 5,
    element_quad = 9
};  // the numbers of VTK

void read_su2(Mesh& mesh, const ReadOptions& options);  // fills the mesh, or throws a Failure

}  // namespace cli
