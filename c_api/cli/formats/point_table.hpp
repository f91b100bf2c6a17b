// Tables of numbers at mesh points, as flow solvers write them:
//
//     text       lines "point dJ/dx dJ/dy", points counted from 0 in the order of the mesh file
//     CSV        a first line with the names of the columns (SU2, ParaView), see csv_cells.hpp
//     restart    SU2's binary restart files (.dat)
//     fields     files of VTK and OpenFOAM (point_fields.hpp) and CGNS (cgns_fields.hpp)
#pragma once

#include "formats/point_columns.hpp"
#include "mesh/mesh_file.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cli {

struct PointTable {
    std::shared_ptr<const TextFile> file;
    std::vector<std::string> names;    // of the columns
    std::vector<double> values;        // [rows * columns]
    std::vector<std::size_t> offsets;  // [rows] of the lines in the file; empty: a binary file
    bool has_file_points = false;      // rows may be points of a mesh file with three coordinates
    std::string left_out;              // the reason why arrays of the file are not columns, if any

    std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
    double at(std::size_t row, std::size_t column) const {
        return values[row * names.size() + column];
    }
    // NAME_x is also the name of a column NAMEX, NAME:0 or NAME_0, as CGNS and ParaView name the
    // components of vectors.
    bool has(const std::string& name) const { return find(name) < names.size(); }
    std::size_t column(const std::string& name) const;  // throws a Failure that lists all names
    std::string name_list() const;                      // of the columns, for messages
    // The columns that say where a row is. In files of points (has_file_points), these are never
    // numbers, as such a file may be a part of a mesh.
    PointColumns point_columns() const;
    std::string place(std::size_t row) const;

private:
    std::size_t find(const std::string& name) const;  // names.size() if there is no such column
};

PointTable read_point_table(const std::string& path);
PointTable read_point_table(const std::shared_ptr<const TextFile>& file);

// Tells whether the table is text in lines "point value value", whose columns have no names.
bool is_plain_table(const TextFile& file);

}  // namespace cli
