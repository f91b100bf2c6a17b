// VTK's XML files of unstructured grids (.vtu,
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html) with triangles and
// quadrilaterals in one plane z = constant: arrays in text, or raw in the section AppendedData.
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/number_reader.hpp"
#include "formats/one_plane.hpp"
#include "formats/vtk_cells.hpp"
#include "formats/xml.hpp"
#include "basics/numbers.hpp"
#include "formats/vtu.hpp"

namespace cli {

namespace {

class VtkXmlReader {
public:
    explicit VtkXmlReader(Mesh& mesh) : mesh_(mesh), tags_(mesh.file), numbers_(mesh.file) {}

    void read() {
        read_tags();
        read_points();
        read_cells();
        add_vtk_cells(mesh_, cells_);
    }

private:
    struct Array {
        bool is_there = false;
        XmlTag tag;
        std::size_t text_end = 0;  // of an array in text
    };

    void read_tags();
    void read_tag(std::string_view section);
    void read_head(const XmlTag& tag);
    void begin_piece(const XmlTag& tag);
    void begin_appended(const XmlTag& tag);
    std::int64_t count(const XmlTag& tag, std::string_view key) const;

    void begin_array(const Array& array, const char* name, int bytes);
    void read_points();
    void read_cells();
    void read_wholes(const Array& array, const char* name, std::vector<std::int64_t>& values,
                     std::vector<std::size_t>* offsets);
    void check_length(const Array& array, const char* name, std::size_t length) const;

    Mesh& mesh_;
    XmlReader tags_;
    NumberReader numbers_;
    bool is_compressed_ = false, has_piece_ = false;
    int header_bytes_ = 4;      // of the length before each appended array
    std::size_t appended_ = 0;  // where appended arrays begin; 0: there are none
    std::int64_t n_points_ = 0, n_cells_ = 0;
    Array points_, connectivity_, offsets_, types_;
    VtkCells cells_;
};

void VtkXmlReader::read_tags() {
    std::string_view section;  // Points, Cells, PointData, ...
    bool has_head = false;
    while (appended_ == 0 && tags_.next()) {
        const XmlTag& tag = tags_.tag();
        if (tag.name == "VTKFile") {
            has_head = true;
            read_head(tag);
        } else if (!has_head) {
            mesh_.file.fail(tag.begin,
                            "expected <VTKFile, found " + in_quotes("<" + std::string(tag.name)));
        } else if (tag.name == "Points" || tag.name == "Cells" || tag.name == "/Points" ||
                   tag.name == "/Cells") {
            section = tag.is_empty ? "" : tag.name;
        } else {
            read_tag(section);
        }
    }
    if (!has_piece_)
        mesh_.file.fail(mesh_.file.text().size(), "expected <Piece, found the end of the file");
}

void VtkXmlReader::read_tag(std::string_view section) {
    const XmlTag& tag = tags_.tag();
    if (tag.name == "Piece") return begin_piece(tag);
    if (tag.name == "AppendedData") return begin_appended(tag);
    if (tag.name != "DataArray") return;
    const std::string_view name = tag.attribute("Name");
    Array* array = nullptr;
    if (section == "Points") array = &points_;
    if (section == "Cells" && name == "connectivity") array = &connectivity_;
    if (section == "Cells" && name == "offsets") array = &offsets_;
    if (section == "Cells" && name == "types") array = &types_;
    if (!array) return;  // stays as it is
    if (array->is_there) mesh_.file.fail(tag.begin, "the array stands here a second time");
    *array = {true, tag, tag.is_empty ? tag.end : tags_.text_end()};
}

void VtkXmlReader::read_head(const XmlTag& tag) {
    const auto refuse = [&](const std::string& expected, std::string_view found) {
        mesh_.file.fail(tag.begin, "expected " + expected + ", found " + in_quotes(found));
    };
    const std::string_view type = tag.attribute("type"), order = tag.attribute("byte_order");
    const std::string_view header = tag.attribute("header_type");
    if (type != "UnstructuredGrid") refuse("a file of type UnstructuredGrid", type);
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
        refuse("LittleEndian or BigEndian", order);
    if (!header.empty() && header != "UInt32" && header != "UInt64")
        refuse("header_type UInt32 or UInt64", header);
    numbers_.swapped = mesh_.in_file.swapped = (order != "BigEndian") != little_endian_machine();
    header_bytes_ = header == "UInt64" ? 8 : 4;
    is_compressed_ =
        !tag.attribute("compressor").empty();  // VTK writes the name into files in text, too
}

void VtkXmlReader::begin_piece(const XmlTag& tag) {
    if (has_piece_) mesh_.file.fail(tag.begin, "the file has several pieces: save the grid as one");
    has_piece_ = true;
    n_points_ = count(tag, "NumberOfPoints");
    n_cells_ = count(tag, "NumberOfCells");
}

void VtkXmlReader::begin_appended(const XmlTag& tag) {
    const std::string_view encoding = tag.attribute("encoding"), text = mesh_.file.text();
    if (encoding != "raw") {
        mesh_.file.fail(tag.begin, "appended data with encoding raw are read, these have " +
                                       in_quotes(encoding));
    }
    const std::size_t mark = text.find_first_not_of(" \t\r\n", tag.end);
    if (mark == text.npos || text[mark] != '_')
        mesh_.file.fail(tag.end, "expected _ before the appended data");
    appended_ = mark + 1;
}

std::int64_t VtkXmlReader::count(const XmlTag& tag, std::string_view key) const {
    std::int64_t value = 0;
    const std::string_view text = trimmed(tag.attribute(key));
    if (!parse(text, value) || value < 0 || value > INT32_MAX) {
        mesh_.file.fail(tag.begin, "expected " + std::string(key) +
                                       " between 0 and 2147483647, found " + in_quotes(text));
    }
    return value;
}

// To the array's first number; `bytes` each, if they are not text.
void VtkXmlReader::begin_array(const Array& array, const char* name, int bytes) {
    if (!array.is_there)
        mesh_.file.fail(mesh_.file.text().size(), "the file has no array " + std::string(name));
    const std::string_view format = array.tag.attribute("format");
    const std::size_t at = array.tag.begin;
    numbers_.is_binary = format == "appended";
    if (format == "ascii") {
        numbers_.jump(array.tag.end);
        return numbers_.stop_at(array.text_end);
    }
    if (!numbers_.is_binary) {
        mesh_.file.fail(
            at, "arrays of format ascii and appended are read, this one has " + in_quotes(format));
    }
    if (is_compressed_)
        mesh_.file.fail(at, "the array is compressed: save the file without compression");
    if (appended_ == 0)
        mesh_.file.fail(at, "the array is appended, but the file has no section AppendedData");
    std::int64_t offset = 0;
    const std::size_t there = mesh_.file.text().size() - appended_;
    if (!parse(array.tag.attribute("offset"), offset) || offset < 0 ||
        static_cast<std::size_t>(offset) > there) {
        mesh_.file.fail(at, "expected an offset between 0 and " + std::to_string(there) +
                                ", found " + in_quotes(array.tag.attribute("offset")));
    }
    numbers_.jump(appended_ + static_cast<std::size_t>(offset));
    numbers_.stop_at(mesh_.file.text().size());
    std::int64_t length = numbers_.whole("the length of an array", header_bytes_);
    if (header_bytes_ == 4) length &= 0xffffffff;  // has no sign
    const std::size_t rest = mesh_.file.text().size() - numbers_.offset();
    if (length < 0 || static_cast<std::size_t>(length) > rest || length % bytes != 0) {
        numbers_.fail("the array " + std::string(name) + " has " + std::to_string(length) +
                      " bytes, " + std::to_string(bytes) + " for each number, but only " +
                      std::to_string(rest) + " follow");
    }
    numbers_.stop_at(numbers_.offset() + static_cast<std::size_t>(length));
}

void VtkXmlReader::read_points() {
    const std::string_view type = points_.tag.attribute("type");
    const int bytes = type == "Float32" ? 4 : 8;
    begin_array(points_, "Points", bytes);
    if (type != "Float32" && type != "Float64") {
        mesh_.file.fail(points_.tag.begin,
                        "expected points of type Float32 or Float64, found " + in_quotes(type));
    }
    if (points_.tag.attribute("NumberOfComponents") != "3") {
        mesh_.file.fail(points_.tag.begin, "expected points with NumberOfComponents=\"3\"");
    }
    if (numbers_.is_binary)
        mesh_.in_file.kind = bytes == 4 ? NumberKind::real32 : NumberKind::real64;
    OnePlane plane;
    for (std::int64_t i = 0; i < n_points_; ++i) {
        const double x = numbers_.real("a point's x", bytes);
        const std::size_t x_offset = numbers_.number_offset();
        const double y = numbers_.real("a point's y", bytes);
        const std::size_t y_offset = numbers_.number_offset();
        plane.check(numbers_.real("a point's z", bytes), numbers_);
        mesh_.add_point(x, y, x_offset, y_offset);
    }
    if (!numbers_.at_end()) {
        mesh_.file.fail(numbers_.offset(),
                        "the array Points has more numbers than " + plural(n_points_, "point"));
    }
}

void VtkXmlReader::read_cells() {
    cells_.starts = {0};
    read_wholes(offsets_, "offsets", cells_.starts, nullptr);
    check_length(offsets_, "offsets", cells_.starts.size() - 1);
    read_wholes(types_, "types", cells_.types, nullptr);
    check_length(types_, "types", cells_.types.size());
    read_wholes(connectivity_, "connectivity", cells_.points, &cells_.offsets);
    cells_.starts_offset = offsets_.tag.begin;
}

void VtkXmlReader::read_wholes(const Array& array, const char* name,
                               std::vector<std::int64_t>& values,
                               std::vector<std::size_t>* offsets) {
    const std::string_view type = array.tag.attribute("type");
    const int bytes = type == "Int8" || type == "UInt8"     ? 1
                      : type == "Int32" || type == "UInt32" ? 4
                      : type == "Int64" || type == "UInt64" ? 8
                                                            : 0;
    begin_array(array, name, bytes > 0 ? bytes : 1);
    if (bytes == 0) {
        mesh_.file.fail(array.tag.begin,
                        "expected whole numbers of 8, 32 or 64 bits, found " + in_quotes(type));
    }
    while (!numbers_.at_end()) {
        values.push_back(numbers_.whole("a whole number", bytes));
        if (offsets) offsets->push_back(numbers_.number_offset());
    }
}

void VtkXmlReader::check_length(const Array& array, const char* name, std::size_t length) const {
    if (static_cast<std::int64_t>(length) == n_cells_) return;
    const std::string numbers = plural(static_cast<std::int64_t>(length), "number"),
                      cells = plural(n_cells_, "cell");
    mesh_.file.fail(array.tag.begin,
                    "the array " + std::string(name) + " has " + numbers + " for " + cells);
}

bool probe_vtu(const TextFile& file) {
    const std::string_view start = std::string_view(file.text()).substr(0, 1024);
    return trimmed(start).substr(0, 1) == "<" && start.find("<VTKFile") != start.npos;
}

void read_vtu(Mesh& mesh, const ReadOptions&) { VtkXmlReader(mesh).read(); }

void create_vtu(std::ostream& out, const Mesh& mesh) { write_vtu(out, mesh); }

}  // namespace

const Format vtk_xml_format = {
    "vtu",     ".vtu",   "VTK XML unstructured grids, text and appended raw data",
    probe_vtu, read_vtu, create_vtu,
    false};

}  // namespace cli
