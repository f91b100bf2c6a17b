// VTK's legacy files (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html), unstructured grids of
// versions 1 to 5.1, in text and binary, with triangles and quadrilaterals in one plane z = constant.
//
// VTK knows no boundaries: each loop of boundary edges is a marker, boundary1, boundary2, ... by the least point in it.
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/number_reader.hpp"
#include "formats/tidy.hpp"
#include "numbers.hpp"

#include <cmath>
#include <ostream>

namespace cli {

namespace {

enum CellType { vertex = 1, poly_vertex, line, poly_line, triangle, strip, polygon, pixel, quad, tetrahedron };

class VtkReader {
public:
    explicit VtkReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    void read();

private:
    void read_head();
    void read_section(const std::string& name);
    void read_points();
    void read_cells();
    void read_old_cells(std::int64_t n, std::int64_t size);
    void read_array(const char* name, std::int64_t n, std::vector<std::int64_t>& values);
    void read_types();
    void pass_over();
    void build();
    void begin_numbers(); // behind the end of the line
    std::int64_t text_count(const char* what);

    Mesh& mesh_;
    NumberReader numbers_;
    bool binary_ = false;
    std::vector<std::int64_t> starts_, points_, types_;
    std::vector<std::size_t> offsets_;
    bool points_read_ = false, cells_read_ = false, types_read_ = false;
};

void VtkReader::read() {
    read_head();
    while (!(points_read_ && cells_read_ && types_read_)) {
        numbers_.is_binary = false;
        const std::string name(numbers_.word());
        if (name.empty()) {
            numbers_.expected(!points_read_  ? "a section POINTS"
                              : !cells_read_ ? "a section CELLS"
                                             : "a section CELL_TYPES");
        }
        read_section(name);
    }
    build();
}

void VtkReader::read_head() {
    if (numbers_.next_line().substr(0, 5) != "# vtk") numbers_.expected("# vtk DataFile Version");
    // The title may be empty, so lines are counted.
    const std::string& text = mesh_.file.text();
    const std::size_t title = text.find('\n');
    const std::size_t kind = title == std::string::npos ? title : text.find('\n', title + 1);
    numbers_.jump(kind == std::string::npos ? text.size() : kind);
    const std::string_view format = numbers_.next_line();
    if (format != "ASCII" && format != "BINARY") numbers_.expected("ASCII or BINARY");
    binary_ = format == "BINARY";
    numbers_.swapped = mesh_.in_file.swapped = binary_ && little_endian_machine(); // always big-endian
    if (numbers_.word() != "DATASET") numbers_.expected("DATASET");
    if (numbers_.word() != "UNSTRUCTURED_GRID") numbers_.expected("UNSTRUCTURED_GRID");
}

void VtkReader::read_section(const std::string& name) {
    if (name == "POINTS" && !points_read_) {
        read_points();
    } else if (name == "CELLS" && !cells_read_) {
        read_cells();
    } else if (name == "CELL_TYPES" && !types_read_) {
        read_types();
    } else if (name == "METADATA" || name == "FIELD") {
        pass_over();
    } else {
        numbers_.expected("POINTS, CELLS or CELL_TYPES");
    }
}

// Other sections stay as they are.
void VtkReader::pass_over() {
    std::size_t next = std::string::npos;
    for (const char* name : {"\nPOINTS ", "\nCELLS ", "\nCELL_TYPES "}) {
        next = std::min(next, mesh_.file.text().find(name, numbers_.offset()));
    }
    numbers_.jump(std::min(next, mesh_.file.text().size()));
}

std::int64_t VtkReader::text_count(const char* what) {
    numbers_.is_binary = false;
    return numbers_.count(what);
}

void VtkReader::begin_numbers() {
    if (!binary_) return;
    const std::string& text = mesh_.file.text();
    const std::size_t end = text.find('\n', numbers_.offset());
    numbers_.jump(end == std::string::npos ? text.size() : end + 1);
    numbers_.is_binary = true;
}

void VtkReader::read_points() {
    const std::int64_t n = text_count("the number of points");
    const std::string type(numbers_.word());
    if (type != "float" && type != "double") numbers_.expected("points of type float or double");
    const int bytes = type == "float" ? 4 : 8;
    if (binary_) mesh_.in_file.kind = bytes == 4 ? NumberKind::real32 : NumberKind::real64;
    begin_numbers();
    double z_of_all = 0;
    for (std::int64_t i = 0; i < n; ++i) {
        const double x = numbers_.real("a point's x", bytes);
        const std::size_t x_offset = numbers_.number_offset();
        const double y = numbers_.real("a point's y", bytes);
        const std::size_t y_offset = numbers_.number_offset();
        const double z = numbers_.real("a point's z", bytes);
        if (i == 0) z_of_all = z;
        if (std::fabs(z - z_of_all) > 1e-9 * (1 + std::fabs(z_of_all))) {
            numbers_.fail("expected points in one plane z = " + brief(z_of_all) + ", found " + brief(z) +
                          ": the mesh has three dimensions");
        }
        mesh_.add_point(x, y, x_offset, y_offset);
    }
    points_read_ = true;
}

// Version 5.1 has two arrays; before it, each cell began with the number of its points.
void VtkReader::read_cells() {
    const std::int64_t n = text_count("the number of cells"), size = text_count("the number of whole numbers of cells");
    const std::size_t here = numbers_.offset();
    if (numbers_.word() == "OFFSETS") {
        numbers_.jump(here);
        read_array("OFFSETS", n, starts_);
        read_array("CONNECTIVITY", size, points_);
    } else {
        numbers_.jump(here);
        read_old_cells(n, size);
    }
    cells_read_ = true;
}

void VtkReader::read_array(const char* name, std::int64_t n, std::vector<std::int64_t>& values) {
    numbers_.is_binary = false;
    if (numbers_.word() != name) numbers_.expected(name);
    const std::string type(numbers_.word());
    if (type != "vtktypeint64" && type != "vtktypeint32") numbers_.expected("vtktypeint64 or vtktypeint32");
    begin_numbers();
    for (std::int64_t i = 0; i < n; ++i) {
        values.push_back(numbers_.whole("a number of the cells", type == "vtktypeint64" ? 8 : 4));
        if (&values == &points_) offsets_.push_back(numbers_.number_offset());
    }
}

void VtkReader::read_old_cells(std::int64_t n, std::int64_t size) {
    begin_numbers();
    starts_.push_back(0);
    for (std::int64_t cell = 0; cell < n; ++cell) {
        const std::int64_t corners = numbers_.count("the number of a cell's points");
        for (std::int64_t k = 0; k < corners; ++k) {
            points_.push_back(numbers_.whole("a point of a cell"));
            offsets_.push_back(numbers_.number_offset());
        }
        starts_.push_back(static_cast<std::int64_t>(points_.size()));
    }
    if (n + static_cast<std::int64_t>(points_.size()) != size) {
        numbers_.fail("CELLS announces " + plural(size, "whole number") + ", but its cells have " +
                      std::to_string(n + static_cast<std::int64_t>(points_.size())));
    }
}

void VtkReader::read_types() {
    const std::int64_t n = text_count("the number of cells");
    begin_numbers();
    for (std::int64_t i = 0; i < n; ++i) types_.push_back(numbers_.whole("a cell's type"));
    types_read_ = true;
}

void VtkReader::build() {
    if (starts_.size() != types_.size() + 1) {
        numbers_.fail("CELLS has " + plural(static_cast<std::int64_t>(starts_.size()) - 1, "cell") + ", CELL_TYPES " +
                      std::to_string(types_.size()));
    }
    const auto total = static_cast<std::int64_t>(points_.size());
    std::vector<std::int32_t> cell;
    for (std::size_t i = 0; i < types_.size(); ++i) {
        const std::int64_t type = types_[i], begin = starts_[i], n = starts_[i + 1] - begin;
        if (begin < 0 || n < 1 || begin > total - n)
            numbers_.fail("OFFSETS of cell " + std::to_string(i) + " are out of range");
        const std::size_t offset = offsets_[static_cast<std::size_t>(begin)];
        if (type >= vertex && type <= poly_line) continue; // no part of the mesh
        const bool is_read = (type == triangle && n == 3) || ((type == quad || type == pixel) && n == 4) ||
                             (type == polygon && (n == 3 || n == 4));
        if (!is_read) {
            mesh_.file.fail(offset, "cell " + std::to_string(i) + " is of type " + std::to_string(type) + " with " +
                                        plural(n, "point") + ": triangles and quadrilaterals are read" +
                                        (type >= tetrahedron && type <= 14 ? "; the mesh has three dimensions" : ""));
        }
        cell.clear();
        for (std::int64_t k = 0; k < n; ++k) {
            const std::int64_t at = type == pixel && k >= 2 ? begin + 5 - k : begin + k; // a pixel goes line by line
            const std::int64_t point = points_[static_cast<std::size_t>(at)];
            if (point < 0 || point >= mesh_.points()) {
                mesh_.file.fail(offset, "expected points between 0 and " + std::to_string(mesh_.points() - 1) +
                                            ", found " + std::to_string(point));
            }
            cell.push_back(static_cast<std::int32_t>(point));
        }
        mesh_.add_cell(cell, offset);
    }
    name_open_boundary(mesh_, "boundary");
}

bool probe(const TextFile& file) { return file.text().compare(0, 22, "# vtk DataFile Version") == 0; }

void read(Mesh& mesh, const ReadOptions&) { VtkReader(mesh).read(); }

void create(std::ostream& out, const Mesh& mesh) {
    out << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << mesh.points()
        << " double\n";
    for (std::size_t i = 0; i < mesh.x.size(); ++i) out << exact(mesh.x[i]) << ' ' << exact(mesh.y[i]) << " 0\n";
    out << "CELLS " << mesh.cells() << ' ' << mesh.cell_points.size() + static_cast<std::size_t>(mesh.cells()) << '\n';
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        out << mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            out << ' ' << mesh.cell_points[static_cast<std::size_t>(i)];
        }
        out << '\n';
    }
    out << "CELL_TYPES " << mesh.cells() << '\n';
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        out << (mesh.cell_start[cell + 1] - mesh.cell_start[cell] == 3 ? triangle : quad) << '\n';
    }
}

} // namespace

const Format vtk_format = {"vtk", ".vtk", "VTK legacy unstructured grids, text and binary", probe, read, create};

} // namespace cli
