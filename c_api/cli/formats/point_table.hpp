// Tables of numbers at mesh points, as flow solvers write them:
//
//     text       lines "point dJ/dx dJ/dy", points counted from 0 in the order of the mesh file
//     CSV        a first line with the names of the columns, in quotes or not (SU2, ParaView)
//     restart    SU2's binary restart files (.dat)
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

    std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
    double at(std::size_t row, std::size_t column) const {
        return values[row * names.size() + column];
    }
    bool has(const std::string& name) const;
    std::size_t column(const std::string& name) const;  // a Failure lists the names that there are
    std::string place(std::size_t row) const;
};

PointTable read_point_table(const std::string& path);

// The mesh point of each row: by the column PointID, else by the columns x and y, else by the order
// of the rows, which must then be as many as the points. Where a file has numbers and coordinates,
// both must agree. No point may come twice.
std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh);

}  // namespace cli
