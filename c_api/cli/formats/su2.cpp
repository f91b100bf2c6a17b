// SU2 mesh files (https://su2code.github.io/docs_v7/Mesh-File): two dimensions, triangles and
// quadrilaterals.
#include "formats/su2.hpp"

#include "basics/text_out.hpp"
#include "files/ordered_output.hpp"

#include <ostream>

namespace cli {

namespace {

bool probe_su2(const TextFile& file) {
    LineReader lines(file, '%');
    if (!lines.next()) return false;
    const std::string_view line = lines.line().substr(0, 64);
    const std::size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, equals));
    const bool is_tecplot = key == "TITLE" || key == "VARIABLES" || key == "ZONE";
    return equals != std::string_view::npos && !is_tecplot &&
           key.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
}

void create_su2(std::ostream& out, const Mesh& mesh) {
    mesh.refuse_polygons("SU2");
    out << "NDIME= 2\nNELEM= " << mesh.cells() << '\n';
    write_rows(out, mesh.cell_start.size() - 1, mesh.threads, [&](std::size_t cell, TextOut& to) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        to << static_cast<int>(end - begin == 3 ? element_triangle : element_quad);
        for (std::int32_t i = begin; i < end; ++i)
            to << ' ' << mesh.cell_points[static_cast<std::size_t>(i)];
        to << ' ' << cell << '\n';
    });
    out << "NPOIN= " << mesh.points() << '\n';
    write_rows(out, mesh.x.size(), mesh.threads, [&](std::size_t point, TextOut& to) {
        to << mesh.x[point] << ' ' << mesh.y[point] << ' ' << point << '\n';
    });
    out << "NMARK= " << mesh.markers.size() << '\n';
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        const auto number = static_cast<std::int32_t>(marker);
        out << "MARKER_TAG= " << mesh.markers[marker] << "\nMARKER_ELEMS= " << mesh.faces(number)
            << '\n';
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            if (mesh.face_markers[face] != number) continue;
            out << static_cast<int>(element_line) << ' ' << mesh.face_points[2 * face] << ' '
                << mesh.face_points[2 * face + 1] << '\n';
        }
    }
}

}  // namespace

const Format su2_format = {"su2", ".su2", "SU2", probe_su2, read_su2, create_su2, true, "%"};

}  // namespace cli
