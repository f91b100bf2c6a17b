// VTK's legacy files (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html),
// unstructured and structured grids of versions 1 to 5.1, in text and binary, of two dimensions or
// one cell thick.
#include "basics/numbers.hpp"
#include "basics/text_out.hpp"
#include "files/threads.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "formats/vtk_cells.hpp"

#include <algorithm>
#include <ostream>

namespace cli {

namespace {

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
    void begin_numbers();  // goes to the next line
    std::int64_t text_count(const char* what);

    Mesh& mesh_;
    NumberReader numbers_;
    bool binary_ = false;
    VtkCells cells_;
    Elements elements_;
    bool is_structured_ = false;
    std::int64_t size_[3] = {0, 0, 0};  // points of a structured grid along i, j, k
    bool points_read_ = false, cells_read_ = false, types_read_ = false;
};

void VtkReader::read() {
    read_head();
    while (is_structured_ && !points_read_) {
        numbers_.is_binary = false;
        const std::string name(numbers_.word());
        if (name == "DIMENSIONS") {
            for (std::int64_t& n : size_) n = numbers_.count("a number of points");
        } else if (name == "POINTS" && size_[0] > 0) {
            read_points();
        } else if (name == "METADATA" || name == "FIELD") {
            pass_over();
        } else {
            numbers_.expected("DIMENSIONS, then POINTS");
        }
    }
    if (is_structured_) {
        const std::int64_t points = elements_.points.points();
        if (!has_vtk_size(size_, points)) {
            numbers_.fail("DIMENSIONS " + std::to_string(size_[0]) + " " +
                          std::to_string(size_[1]) + " " + std::to_string(size_[2]) +
                          " are not those of " + plural(points, "point"));
        }
        if (!add_vtk_blocks(size_, 0, elements_))
            numbers_.fail("the grid has no cells: two of its DIMENSIONS are 1");
        return build_mesh(mesh_, elements_);
    }
    while (!(points_read_ && cells_read_ && types_read_)) {
        numbers_.is_binary = false;
        const std::string name(numbers_.word());
        if (name.empty()) {
            if (!points_read_) numbers_.expected("a section POINTS");
            numbers_.expected(!cells_read_ ? "a section CELLS" : "a section CELL_TYPES");
        }
        read_section(name);
    }
    if (cells_.starts.size() != cells_.types.size() + 1) {
        numbers_.fail("CELLS has " +
                      plural(static_cast<std::int64_t>(cells_.starts.size()) - 1, "cell") +
                      ", CELL_TYPES " + std::to_string(cells_.types.size()));
    }
    add_vtk_cells(mesh_.file, cells_, 0, elements_);
    build_mesh(mesh_, elements_);
}

void VtkReader::read_head() {
    if (numbers_.next_line().substr(0, 5) != "# vtk") numbers_.expected("# vtk DataFile Version");
    // The title may be empty, so lines are counted.
    const std::string_view text = mesh_.file.text();
    const std::size_t title = text.find('\n');
    const std::size_t kind = title == std::string::npos ? title : text.find('\n', title + 1);
    numbers_.jump(kind == std::string::npos ? text.size() : kind);
    const std::string_view format = numbers_.next_line();
    if (format != "ASCII" && format != "BINARY") numbers_.expected("ASCII or BINARY");
    binary_ = format == "BINARY";
    numbers_.swapped = mesh_.in_file.swapped =
        binary_ && little_endian_machine();  // these files are always big-endian
    if (numbers_.word() != "DATASET") numbers_.expected("DATASET");
    const std::string_view set = numbers_.word();
    is_structured_ = set == "STRUCTURED_GRID";
    if (!is_structured_ && set != "UNSTRUCTURED_GRID") {
        numbers_.expected(
            "UNSTRUCTURED_GRID or STRUCTURED_GRID (ParaView's filter Append Datasets makes the "
            "first of "
            "other kinds)");
    }
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

// Skips a section that is not read.
void VtkReader::pass_over() {
    std::size_t next = std::string::npos;
    for (const char* name : {"\nDIMENSIONS ", "\nPOINTS ", "\nCELLS ", "\nCELL_TYPES "}) {
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
    const std::string_view text = mesh_.file.text();
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
    for (std::int64_t i = 0; i < 3 * n; ++i) {
        const auto d = static_cast<std::size_t>(i % 3);
        elements_.points.x[d].push_back(numbers_.real("a coordinate of a point", bytes));
        elements_.points.offset[d].push_back(numbers_.number_offset());
    }
    points_read_ = true;
}

// Version 5.1 has two arrays. In older versions each cell begins with the number of its points.
void VtkReader::read_cells() {
    const std::int64_t n = text_count("the number of cells"),
                       size = text_count("the number of whole numbers of cells");
    const std::size_t here = numbers_.offset();
    if (numbers_.word() == "OFFSETS") {
        numbers_.jump(here);
        read_array("OFFSETS", n, cells_.starts);
        read_array("CONNECTIVITY", size, cells_.points);
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
    if (type != "vtktypeint64" && type != "vtktypeint32")
        numbers_.expected("vtktypeint64 or vtktypeint32");
    begin_numbers();
    if (&values == &cells_.starts) cells_.starts_offset = numbers_.offset();
    for (std::int64_t i = 0; i < n; ++i) {
        values.push_back(numbers_.whole("a number of the cells", type == "vtktypeint64" ? 8 : 4));
        if (&values == &cells_.points) cells_.offsets.push_back(numbers_.number_offset());
    }
}

void VtkReader::read_old_cells(std::int64_t n, std::int64_t size) {
    begin_numbers();
    cells_.starts.push_back(0);
    for (std::int64_t cell = 0; cell < n; ++cell) {
        const std::int64_t corners = numbers_.count("the number of a cell's points");
        for (std::int64_t k = 0; k < corners; ++k) {
            cells_.points.push_back(numbers_.whole("a point of a cell"));
            cells_.offsets.push_back(numbers_.number_offset());
        }
        cells_.starts.push_back(static_cast<std::int64_t>(cells_.points.size()));
    }
    if (n + static_cast<std::int64_t>(cells_.points.size()) != size) {
        numbers_.fail("CELLS announces " + plural(size, "whole number") + ", but its cells have " +
                      std::to_string(n + static_cast<std::int64_t>(cells_.points.size())));
    }
}

void VtkReader::read_types() {
    const std::int64_t n = text_count("the number of cells");
    begin_numbers();
    for (std::int64_t i = 0; i < n; ++i) cells_.types.push_back(numbers_.whole("a cell's type"));
    types_read_ = true;
}

void read_vtk(Mesh& mesh, const ReadOptions&) { VtkReader(mesh).read(); }

void create_vtk(std::ostream& out, const Mesh& mesh) {
    out << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
        << mesh.points() << " double\n";
    write_rows(out, mesh.x.size(), mesh.threads, [&](std::size_t i, TextOut& to) {
        (to.exact(mesh.x[i]) << ' ').exact(mesh.y[i]) << " 0\n";
    });
    out << "CELLS " << mesh.cells() << ' '
        << mesh.cell_points.size() + static_cast<std::size_t>(mesh.cells()) << '\n';
    const std::size_t n = mesh.cell_start.size() - 1;
    write_rows(out, n, mesh.threads, [&](std::size_t cell, TextOut& to) {
        to << mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i)
            to << ' ' << mesh.cell_points[static_cast<std::size_t>(i)];
        to << '\n';
    });
    out << "CELL_TYPES " << mesh.cells() << '\n';
    write_rows(out, n, mesh.threads,
               [&](std::size_t cell, TextOut& to) { to << vtk_type(mesh, cell) << '\n'; });
}

}  // namespace

const Format vtk_format = {"vtk",         ".vtk",   "VTK legacy unstructured and structured grids",
                           is_vtk_legacy, read_vtk, create_vtk,
                           false};

}  // namespace cli
