#include "formats/vtu.hpp"

#include "basics/text_out.hpp"
#include "files/threads.hpp"
#include "formats/vtk_cells.hpp"
#include "formats/xml.hpp"

#include <ostream>

namespace cli {

namespace {

void begin_array(std::ostream& out, const std::string& type, const std::string& name,
                 std::size_t components) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << xml_encoded(name)
        << "\" NumberOfComponents=\"" << components << "\" format=\"ascii\">\n";
}

void write_points(std::ostream& out, const std::vector<double>& x, const std::vector<double>& y,
                  std::int32_t threads) {
    out << "<Points>\n";
    begin_array(out, "Float64", "Points", 3);
    write_rows(out, x.size(), threads, [&](std::size_t point, TextOut& to) {
        (to.exact(x[point]) << ' ').exact(y[point]) << " 0\n";
    });
    out << "</DataArray>\n</Points>\n";
}

void write_cells(std::ostream& out, const Mesh& mesh) {
    const std::size_t n = mesh.cell_start.size() - 1;
    out << "<Cells>\n";
    begin_array(out, "Int32", "connectivity", 1);
    write_rows(out, n, mesh.threads, [&](std::size_t cell, TextOut& to) {
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            to << mesh.cell_points[static_cast<std::size_t>(i)]
               << (i + 1 < mesh.cell_start[cell + 1] ? ' ' : '\n');
        }
    });
    out << "</DataArray>\n";
    begin_array(out, "Int32", "offsets", 1);
    write_rows(out, n, mesh.threads,
               [&](std::size_t cell, TextOut& to) { to << mesh.cell_start[cell + 1] << '\n'; });
    out << "</DataArray>\n";
    begin_array(out, "UInt8", "types", 1);
    write_rows(out, n, mesh.threads,
               [&](std::size_t cell, TextOut& to) { to << vtk_type(mesh, cell) << '\n'; });
    out << "</DataArray>\n</Cells>\n";
}

void write_point_data(std::ostream& out, const std::vector<PointData>& arrays,
                      std::int32_t threads) {
    const PointData& shown = arrays[0];
    out << "<PointData " << (shown.components == 3 ? "Vectors" : "Scalars") << "=\""
        << xml_encoded(shown.name) << "\">\n";
    for (const PointData& data : arrays) {
        begin_array(out, "Float64", data.name, data.components);
        write_rows(out, data.values.size(), threads, [&](std::size_t i, TextOut& to) {
            to.exact(data.values[i]) << ((i + 1) % data.components == 0 ? '\n' : ' ');
        });
        out << "</DataArray>\n";
    }
    out << "</PointData>\n";
}

void write_grid(std::ostream& out, const Mesh& mesh, const std::vector<double>& x,
                const std::vector<double>& y, const std::vector<PointData>& data) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n"
        << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << mesh.points() << "\" NumberOfCells=\""
        << mesh.cells() << "\">\n";
    write_points(out, x, y, mesh.threads);
    write_cells(out, mesh);
    if (!data.empty()) write_point_data(out, data, mesh.threads);
    out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

PointData displacement_data(const Field& displacement) {
    PointData data = {"displacement", 3, {}};
    for (std::size_t point = 0; point < displacement.x.size(); ++point)
        data.values.insert(data.values.end(), {displacement.x[point], displacement.y[point], 0.0});
    return data;
}

void write_vtu(std::ostream& out, const Mesh& mesh) { write_grid(out, mesh, mesh.x, mesh.y, {}); }

void write_vtu(std::ostream& out, const Mesh& mesh, const std::vector<double>& x,
               const std::vector<double>& y, const std::vector<PointData>& data) {
    write_grid(out, mesh, x, y, data);
}

}  // namespace cli
