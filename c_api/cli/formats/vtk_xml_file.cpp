#include "formats/vtk_xml_file.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"

#include <sstream>

namespace cli {

namespace {

class TagReader {
public:
    explicit TagReader(const TextFile& file) : file_(file), tags_(file) {}
    VtkXmlFile read();

private:
    void read_tag();
    void read_head();
    void read_array();
    void begin_piece();
    void read_extent();
    VtkArray* place_of(std::string_view name);
    std::int64_t count(std::string_view key) const;
    const XmlTag& tag() const { return tags_.tag(); }

    const TextFile& file_;
    XmlReader tags_;
    std::string_view section_;  // Points, Cells, PointData, ...
    VtkXmlFile found_;
};

VtkXmlFile TagReader::read() {
    bool has_head = false;
    while (found_.encoding.appended == 0 && tags_.next()) {
        const std::string_view name = tag().name;
        if (name == "VTKFile") {
            has_head = true;
            read_head();
        } else if (!has_head) {
            file_.fail(tag().begin, "the file needs <VTKFile here, but " +
                                        in_quotes("<" + std::string(name)) + " follows");
        } else if (name == "Points" || name == "Cells" || name == "PointData" ||
                   name == "/Points" || name == "/Cells" || name == "/PointData") {
            section_ = tag().is_empty ? "" : name;
        } else {
            read_tag();
        }
    }
    if (found_.pieces.empty())
        file_.fail(file_.text().size(),
                   "the file needs <Piece here, but the end of the file follows");
    return std::move(found_);
}

void TagReader::read_tag() {
    if (tag().name == "Piece") return begin_piece();
    if (tag().name == "AppendedData") return find_appended(file_, tag(), found_.encoding);
    if (tag().name == "DataArray") return read_array();
}

void TagReader::read_head() {
    const std::string_view type = tag().attribute("type");
    found_.is_structured = type == "StructuredGrid";
    if (!found_.is_structured && type != "UnstructuredGrid") {
        file_.fail(tag().begin,
                   "the type of the file must be UnstructuredGrid or StructuredGrid (ParaView's "
                   "filter Append Datasets makes the first of other kinds), not " +
                       in_quotes(type));
    }
    found_.encoding = vtk_encoding(file_, tag());
}

void TagReader::begin_piece() {
    found_.pieces.emplace_back();
    found_.pieces.back().tag = tag().begin;
    if (found_.is_structured) return read_extent();
    found_.pieces.back().n_points = count("NumberOfPoints");
    found_.pieces.back().n_cells = count("NumberOfCells");
}

// An extent has the first and the last point along i, j and k.
void TagReader::read_extent() {
    VtkPiece& piece = found_.pieces.back();
    const std::string_view extent = tag().attribute("Extent");
    std::istringstream numbers{std::string(extent)};
    piece.n_points = 1;
    for (std::int64_t& n : piece.size) {
        std::int64_t first = 0, last = -1;
        numbers >> first >> last;
        if (!numbers || first < 0 || last < first || last > INT32_MAX - 1 ||
            piece.n_points > INT32_MAX / (last - first + 1)) {
            file_.fail(tag().begin,
                       "the tag needs an Extent of six whole numbers, the first and the last point "
                       "along i, j and k, not " +
                           in_quotes(extent));
        }
        n = last - first + 1;
        piece.n_points *= n;
    }
}

// Returns the member of the last piece that the array belongs to, or NULL for other arrays.
VtkArray* TagReader::place_of(std::string_view name) {
    if (found_.pieces.empty()) return nullptr;
    VtkPiece& piece = found_.pieces.back();
    if (section_ == "Points") return &piece.points;
    if (section_ != "Cells") return nullptr;
    if (name == "connectivity") return &piece.connectivity;
    if (name == "offsets") return &piece.offsets;
    return name == "types" ? &piece.types : nullptr;
}

void TagReader::read_array() {
    VtkArray array;
    array.is_there = true;
    array.type = std::string(tag().attribute("type"));
    array.components = std::string(tag().attribute("NumberOfComponents"));
    array.tag = tag().begin;
    array.begin = tag().end;
    array.end = tag().is_empty ? tag().end : tags_.text_end();
    std::string format(tag().attribute("format"));
    for (char& c : format) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    array.is_appended = format == "appended";
    array.is_binary = format == "binary";
    if (array.is_appended) {
        const std::string_view value = tag().attribute("offset");
        array.begin = appended_offset(file_, tag());
        array.offset_at = static_cast<std::size_t>(value.data() - file_.text().data());
        array.offset_length = value.size();
        found_.appended.push_back(array);
    }
    VtkArray* const place = place_of(tag().attribute("Name"));
    if (!place) {  // the array stays as it is
        if (section_ == "PointData" && !found_.pieces.empty())
            found_.pieces.back().point_data.emplace_back(xml_decoded(tag().attribute("Name")),
                                                         array);
        return;
    }
    if (place->is_there) file_.fail(tag().begin, "the piece has this array a second time");
    if (!array.is_appended && !array.is_binary && !format.empty() && format != "ascii") {
        file_.fail(tag().begin, "the array has the format " + in_quotes(tag().attribute("format")) +
                                    ", but only the formats ascii, binary and appended are read");
    }
    *place = array;
}

std::int64_t TagReader::count(std::string_view key) const {
    std::int64_t value = 0;
    const std::string_view text = trimmed(tag().attribute(key));
    if (!parse(text, value) || value < 0 || value > INT32_MAX) {
        file_.fail(tag().begin, "the file needs " + std::string(key) +
                                    " between 0 and 2147483647 here, but " + in_quotes(text) +
                                    " follows");
    }
    return value;
}

}  // namespace

bool is_vtk_xml(const TextFile& file) {
    const std::string_view start = file.text().substr(0, 1024);
    return trimmed(start).substr(0, 1) == "<" && start.find("<VTKFile") != start.npos;
}

VtkXmlFile read_vtk_xml_tags(const TextFile& file) { return TagReader(file).read(); }

VtkEncoding vtk_encoding(const TextFile& file, const XmlTag& tag) {
    const std::string_view order = tag.attribute("byte_order");
    const std::string_view header = tag.attribute("header_type");
    const auto refuse = [&](const char* expected, std::string_view found) {
        file.fail(tag.begin, std::string(expected) + ", not " + in_quotes(found));
    };
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
        refuse("byte_order must be LittleEndian or BigEndian", order);
    if (!header.empty() && header != "UInt32" && header != "UInt64")
        refuse("header_type must be UInt32 or UInt64", header);
    VtkEncoding encoding;
    encoding.swapped = (order != "BigEndian") != little_endian_machine();
    encoding.header_bytes = header == "UInt64" ? 8 : 4;
    // VTK also names a compressor in files that are text.
    encoding.compressor = std::string(tag.attribute("compressor"));
    return encoding;
}

void find_appended(const TextFile& file, const XmlTag& tag, VtkEncoding& encoding) {
    const std::string_view kind = tag.attribute("encoding"), text = file.text();
    if (kind != "raw" && kind != "base64") {
        file.fail(tag.begin,
                  "the encoding of appended data must be raw or base64, not " + in_quotes(kind));
    }
    const std::size_t mark = text.find_first_not_of(" \t\r\n", tag.end);
    if (mark == text.npos || text[mark] != '_')
        file.fail(tag.end, "the file needs the character _ before the appended data");
    encoding.is_raw = kind == "raw";
    encoding.appended = mark + 1;
}

std::size_t appended_offset(const TextFile& file, const XmlTag& tag) {
    const std::string_view value = tag.attribute("offset");
    const std::size_t size = file.text().size();
    std::int64_t offset = 0;
    if (!parse(trimmed(value), offset) || offset < 0 || static_cast<std::size_t>(offset) > size) {
        file.fail(tag.begin, "the offset must be between 0 and " + std::to_string(size) + ", not " +
                                 in_quotes(value));
    }
    return static_cast<std::size_t>(offset);
}

}  // namespace cli
