// Numbers at the points of a mesh, such as the results of a flow solver, and their interpolation to
// another mesh.
#pragma once

#include "basics/geometry.hpp"
#include "files/output_file.hpp"
#include "files/threads.hpp"
#include "mesh/mesh_file.hpp"
#include "options/arguments.hpp"

#include <harmorph_fields.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Column {
    std::string name;
    std::vector<double> values;  // one for each point
};

// Reads the columns of a table of point_table.hpp that have these names; no names: all columns
// except numbers and coordinates of points. Each point of the mesh must have one row; in_order: see
// points_of().
std::vector<Column> read_fields(const std::string& path, const std::vector<std::string>& names,
                                const Mesh& mesh, bool in_order);

// Writes a table with commas: the columns point (the number in the mesh file), x, y, and the named
// columns.
void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns);

// Writes a .vtu file, or else a table with the columns point, x, y and those of the fields. This
// function does not commit the file.
void write_fields(OutputFiles& files, const std::string& path, const Mesh& mesh,
                  const std::vector<Column>& fields);

struct Interpolated {
    std::vector<Column> fields;
    hm_interpolation_report report;
};

// Interpolates fields of `from`, whose points are at `at`, to the points of `to`.
Interpolated interpolated(const Mesh& from, const Field& at, const std::vector<Column>& fields,
                          const Mesh& to, const Threads& threads);

// Refuses points that are farther than --max-outside from the mesh with the fields; otherwise warns
// of points outside.
void judge_outside(const Arguments& arguments, const Interpolated& found, const std::string& from,
                   const std::string& to);

}  // namespace cli
