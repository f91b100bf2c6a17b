// Tables of numbers at mesh points, as flow solvers write them:
//
//     text       lines "point dJ/dx dJ/dy", points counted from 0 in the order of the mesh file
//     CSV        a first line with the names of the columns, in quotes or not (SU2, ParaView)
//     restart    SU2's binary restart files (.dat)
//     fields     files of VTK and OpenFOAM (point_fields.hpp) and CGNS (cgns_fields.hpp)
#pragma once

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
    // NAME_x is also the name of a column NAMEX, as CGNS names the components of vectors.
    bool has(const std::string& name) const { return find(name) < names.size(); }
    std::size_t column(const std::string& name) const;  // throws a Failure that lists all names
    std::string place(std::size_t row) const;

private:
    std::size_t find(const std::string& name) const;  // names.size() if there is no such column
};

PointTable read_point_table(const std::string& path);

// Returns the distance within which a place in a table is a point of the mesh. Coordinates in text
// have 6 digits or more.
double reach_of(const Mesh& mesh);

// Returns the mesh point of each row: by the column PointID, or else by the columns x and y, or
// else by the order of the rows, whose number must then be that of the points. Refuses a table
// whose numbers and coordinates do not agree, or in which a point occurs twice.
std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh);

}  // namespace cli
