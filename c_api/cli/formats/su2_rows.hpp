// The rows of points and cells of SU2 files, as read_plain_rows() reads them into a mesh.
#pragma once

#include "formats/plain_rows.hpp"
#include "formats/su2.hpp"

namespace cli {

// Rows "x y", with up to two whole numbers more.
struct Su2PointRows {
    Mesh& mesh;

    std::int64_t items(PlainRow) const { return 0; }
    void resize(TableEnd end) {
        const auto n = static_cast<std::size_t>(end.rows);
        mesh.x.resize(n);
        mesh.y.resize(n);
        mesh.point_offset.resize(n);
    }
    bool read(PlainRow& row, TableEnd& end) {
        row.over_blanks();
        const auto point = static_cast<std::size_t>(end.rows);
        std::int32_t number = 0;
        const std::size_t x_offset = row.offset();
        if (!row.real(mesh.x[point]) || !row.real(mesh.y[point])) return false;
        for (int more = 0; more < 2 && row.at_digit(); ++more) {
            if (!row.whole(number)) return false;
        }
        mesh.point_offset[point] = x_offset;
        if (!row.end_of_line()) return false;
        ++end.rows;
        return true;
    }
};

// Rows "type points [number]".
struct Su2CellRows {
    Mesh& mesh;

    static std::int64_t corners(std::int32_t type) {
        return type == element_triangle ? 3 : type == element_quad ? 4 : 0;
    }
    std::int64_t items(PlainRow row) const {
        std::int32_t type = 0;
        row.over_blanks();
        return row.whole(type) ? corners(type) : 0;
    }
    void resize(TableEnd end) {
        mesh.cell_start.resize(static_cast<std::size_t>(end.rows) + 1);
        mesh.cell_offset.resize(static_cast<std::size_t>(end.rows));
        mesh.cell_points.resize(static_cast<std::size_t>(end.items));
    }
    bool read(PlainRow& row, TableEnd& end) {
        row.over_blanks();
        const std::size_t offset = row.offset();
        std::int32_t type = 0;
        if (!row.whole(type) || corners(type) == 0) return false;
        const std::int64_t after = end.items + corners(type);
        for (std::int64_t k = end.items; k < after; ++k) {
            if (!row.whole(mesh.cell_points[static_cast<std::size_t>(k)])) return false;
        }
        if (row.at_digit() && !row.whole(type)) return false;
        if (!row.end_of_line()) return false;
        mesh.cell_offset[static_cast<std::size_t>(end.rows)] = offset;
        ++end.rows;
        end.items = after;
        mesh.cell_start[static_cast<std::size_t>(end.rows)] = static_cast<std::int32_t>(after);
        return true;
    }
};

}  // namespace cli
