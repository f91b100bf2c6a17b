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

// Returns whether the rows are the points of the mesh's own file, which has three coordinates.
bool has_points_of_file(const PointTable& table, const Mesh& mesh);

// Returns the distance within which a place in a table is a point of the mesh. Coordinates in text
// have 6 digits or more.
double reach_of(const Mesh& mesh);

// Returns the mesh point of each row: by its number, or else by its coordinates, which are compared
// with the mesh if the table has both. Refuses rows whose coordinates are not those of a point of
// the mesh, points that occur twice, and values at all points in space of a mesh that is one cell
// thick. Where a table has neither, the rows must be all points of the mesh in their order: such a
// table is refused, with the list of its columns, unless `in_order` is set or the kind of file says
// so (fields of OpenFOAM).
std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh, bool in_order);

}  // namespace cli
