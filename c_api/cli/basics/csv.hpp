// Tables whose columns are separated by commas.
#pragma once

#include "mesh/mesh_file.hpp"
#include "commands/morph.hpp"
#include "pictures/contour_lines.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Column {
    std::string name;
    std::vector<double> values;  // one for each point
};

// Writes the columns point (the number in the mesh file), x, y, and the named columns.
void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns);

// Writes contour lines with the columns panel (from 1), value, line (from 1 in each panel), x, y.
void write_contours_csv(std::ostream& out, const std::vector<std::vector<ContourLine>>& panels,
                        double step);

// Writes a morph with the columns what, curve, number, u, x, y, moved_x, moved_y. `curve`: samples
// of the B-splines, between whose knots u runs; `control`: the control points; `mesh`: the mesh's
// points on curves and rigid bodies, as the functions moved them.
void write_moved_curves_csv(std::ostream& out, const Mesh& mesh, const Basis& basis,
                            const Morph& morph);

}  // namespace cli
