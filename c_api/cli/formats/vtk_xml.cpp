// VTK's XML files of unstructured grids (.vtu,
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html), of one piece or
// several, in two dimensions or one cell thick: arrays in text, in base64, or behind each other in
// the section AppendedData, also compressed by zlib. Pieces meet where their points have equal
// coordinates, as cuts do.
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/number_reader.hpp"
#include "formats/vtk_cells.hpp"
#include "formats/vtk_data.hpp"
#include "formats/xml.hpp"
#include "basics/numbers.hpp"
#include "formats/vtu.hpp"

#include <algorithm>

namespace cli {

namespace {

class VtkXmlReader {
public:
    explicit VtkXmlReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    void read();

private:
    struct Piece {
        std::size_t tag = 0;
        std::int64_t n_points = 0, n_cells = 0;
        VtkArray points, connectivity, offsets, types;
    };
    struct Source {  // of an array's numbers in mesh_.file, as soon as it is decoded
        std::size_t begin, end;
        bool is_binary;
    };

    void read_tags();
    void read_tag(const XmlReader& tags, std::string_view section);
    void read_array(const XmlReader& tags, std::string_view section);
    void read_head(const XmlTag& tag);
    void begin_piece(const XmlTag& tag);
    void begin_appended(const XmlTag& tag);
    std::int64_t count(const XmlTag& tag, std::string_view key) const;

    void decode();
    Source source_of(const VtkArray& array, const char* name, int bytes) const;
    void begin_numbers(const VtkArray& array, const char* name, int bytes);
    void read_points(const Piece& piece);
    void read_cells(const Piece& piece);
    void read_wholes(const VtkArray& array, const char* name, std::vector<std::int64_t>& values,
                     std::vector<std::size_t>* offsets);
    void check_length(const VtkArray& array, const char* name, std::size_t length,
                      std::int64_t wanted) const;
    void check_total(const Piece& piece);

    Mesh& mesh_;
    NumberReader numbers_;
    VtkStore store_;  // its encoding is that of the file
    std::vector<Piece> pieces_;
    std::vector<std::pair<std::size_t, VtkDecoded>> decoded_;  // by the tag of the array, rising
    Elements elements_;
    std::int32_t first_point_ = 0;  // of the piece
    std::size_t numbers_read_ = 0;
    bool has_kind_ = false;
};

void VtkXmlReader::read() {
    read_tags();
    decode();
    for (const Piece& piece : pieces_) {
        first_point_ = elements_.points.points();
        if (piece.n_points > 0) read_points(piece);
        if (piece.n_cells > 0) read_cells(piece);
        check_total(piece);
    }
    build_mesh(mesh_, elements_);
}

void VtkXmlReader::read_tags() {
    XmlReader tags(mesh_.file);
    std::string_view section;  // Points, Cells, PointData, ...
    bool has_head = false;
    while (store_.encoding.appended == 0 && tags.next()) {
        const XmlTag& tag = tags.tag();
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
            read_tag(tags, section);
        }
    }
    if (pieces_.empty())
        mesh_.file.fail(mesh_.file.text().size(), "expected <Piece, found the end of the file");
}

void VtkXmlReader::read_tag(const XmlReader& tags, std::string_view section) {
    const XmlTag& tag = tags.tag();
    if (tag.name == "Piece") return begin_piece(tag);
    if (tag.name == "AppendedData") return begin_appended(tag);
    if (tag.name == "DataArray") return read_array(tags, section);
}

void VtkXmlReader::read_array(const XmlReader& tags, std::string_view section) {
    const XmlTag& tag = tags.tag();
    VtkArray its;
    its.is_there = true;
    its.type = std::string(tag.attribute("type"));
    its.components = std::string(tag.attribute("NumberOfComponents"));
    its.tag = tag.begin;
    its.begin = tag.end;
    its.end = tag.is_empty ? tag.end : tags.text_end();
    std::string format(tag.attribute("format"));
    for (char& c : format) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    its.is_appended = format == "appended";
    its.is_binary = format == "binary";
    if (its.is_appended) {
        const std::string_view value = tag.attribute("offset");
        std::int64_t offset = 0;
        if (!parse(trimmed(value), offset) || offset < 0 ||
            static_cast<std::size_t>(offset) > mesh_.file.text().size()) {
            const std::string last = std::to_string(mesh_.file.text().size());
            mesh_.file.fail(tag.begin, "expected an offset between 0 and " + last + ", found " +
                                           in_quotes(value));
        }
        its.begin = static_cast<std::size_t>(offset);
        its.offset_at = static_cast<std::size_t>(value.data() - mesh_.file.text().data());
        its.offset_length = value.size();
        store_.appended.push_back(its);
    }
    const std::string_view name = tag.attribute("Name");
    VtkArray* array = nullptr;
    if (!pieces_.empty() && section == "Points") array = &pieces_.back().points;
    if (!pieces_.empty() && section == "Cells" && name == "connectivity")
        array = &pieces_.back().connectivity;
    if (!pieces_.empty() && section == "Cells" && name == "offsets")
        array = &pieces_.back().offsets;
    if (!pieces_.empty() && section == "Cells" && name == "types") array = &pieces_.back().types;
    if (!array) return;  // stays as it is
    if (array->is_there) mesh_.file.fail(tag.begin, "the array stands here a second time");
    if (!its.is_appended && !its.is_binary && !format.empty() && format != "ascii") {
        mesh_.file.fail(tag.begin,
                        "arrays of format ascii, binary and appended are read, this one has " +
                            in_quotes(tag.attribute("format")));
    }
    *array = its;
}

void VtkXmlReader::read_head(const XmlTag& tag) {
    const auto refuse = [&](const std::string& expected, std::string_view found) {
        mesh_.file.fail(tag.begin, "expected " + expected + ", found " + in_quotes(found));
    };
    const std::string_view type = tag.attribute("type"), order = tag.attribute("byte_order");
    const std::string_view header = tag.attribute("header_type");
    if (type.substr(0, 1) == "P" && type != "PolyData") {
        refuse(
            "a file of type UnstructuredGrid: a parallel file names the files of its pieces; save "
            "the grid as one "
            "file .vtu (in ParaView: Merge Blocks, then Save Data)",
            type);
    }
    if (type != "UnstructuredGrid") {
        refuse(
            "a file of type UnstructuredGrid (ParaView's filter Append Datasets makes such a grid)",
            type);
    }
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
        refuse("LittleEndian or BigEndian", order);
    if (!header.empty() && header != "UInt32" && header != "UInt64")
        refuse("header_type UInt32 or UInt64", header);
    VtkEncoding& encoding = store_.encoding;
    encoding.swapped = (order != "BigEndian") != little_endian_machine();
    numbers_.swapped = mesh_.in_file.swapped = encoding.swapped;
    encoding.header_bytes = header == "UInt64" ? 8 : 4;
    encoding.compressor =
        std::string(tag.attribute("compressor"));  // VTK names one in files in text, too
}

void VtkXmlReader::begin_piece(const XmlTag& tag) {
    pieces_.emplace_back();
    pieces_.back().tag = tag.begin;
    pieces_.back().n_points = count(tag, "NumberOfPoints");
    pieces_.back().n_cells = count(tag, "NumberOfCells");
}

void VtkXmlReader::begin_appended(const XmlTag& tag) {
    const std::string_view encoding = tag.attribute("encoding"), text = mesh_.file.text();
    if (encoding != "raw" && encoding != "base64") {
        mesh_.file.fail(tag.begin, "expected appended data with encoding raw or base64, found " +
                                       in_quotes(encoding));
    }
    const std::size_t mark = text.find_first_not_of(" \t\r\n", tag.end);
    if (mark == text.npos || text[mark] != '_')
        mesh_.file.fail(tag.end, "expected _ before the appended data");
    store_.encoding.is_raw = encoding == "raw";
    store_.encoding.appended = mark + 1;
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

// Encoded arrays go behind the text of the file, where they are read, and changed, as raw ones.
void VtkXmlReader::decode() {
    const VtkEncoding& as = store_.encoding;
    store_.file_size = mesh_.file.text().size();
    std::string text = mesh_.file.text();
    for (const Piece& piece : pieces_) {
        const std::pair<const VtkArray*, const char*> arrays[] = {
            {&piece.points, "Points"},
            {&piece.connectivity, "connectivity"},
            {&piece.offsets, "offsets"},
            {&piece.types, "types"}};
        for (const auto& [array, name] : arrays) {
            const bool is_needed = array == &piece.points ? piece.n_points > 0 : piece.n_cells > 0;
            if (!array->is_there || !is_needed || !array->is_encoded(as)) continue;
            if (array->is_appended && as.appended == 0) continue;  // refused where it is read
            decoded_.emplace_back(array->tag, decode_vtk(mesh_.file, as, *array, name, text));
            if (array == &piece.points) store_.points.push_back(decoded_.back().second);
        }
    }
    if (decoded_.empty()) return;
    std::sort(decoded_.begin(), decoded_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t size = store_.file_size;
    const TextFile file = mesh_.file;
    mesh_.file = TextFile(file.path(), std::move(text));
    mesh_.file.name_places([file, size, decoded = decoded_](std::size_t offset) {
        std::size_t place = offset;
        for (const auto& [tag, array] : decoded) {
            if (offset >= size && offset >= array.bytes && offset <= array.bytes_end) place = tag;
        }
        return file.place(place).substr(file.path().size() + 1);
    });
    mesh_.in_file.store = store_;
}

VtkXmlReader::Source VtkXmlReader::source_of(const VtkArray& array, const char* name,
                                             int bytes) const {
    if (!array.is_there)
        mesh_.file.fail(pieces_.back().tag, "the file has no array " + std::string(name));
    const auto found =
        std::lower_bound(decoded_.begin(), decoded_.end(), array.tag,
                         [](const auto& one, std::size_t tag) { return one.first < tag; });
    Source source = {array.begin, array.end, array.is_binary || array.is_appended};
    if (found != decoded_.end() && found->first == array.tag) {
        source.begin = found->second.bytes;
        source.end = found->second.bytes_end;
    } else if (array.is_appended) {
        const VtkEncoding& as = store_.encoding;
        if (as.appended == 0) {
            mesh_.file.fail(array.tag,
                            "the array is appended, but the file has no section AppendedData");
        }
        const std::size_t there = store_.file_size - as.appended;
        if (array.begin > there ||
            there - array.begin < static_cast<std::size_t>(as.header_bytes)) {
            mesh_.file.fail(array.tag, "expected an offset between 0 and " + std::to_string(there) +
                                           ", found '" + std::to_string(array.begin) + "'");
        }
        const char* const head = mesh_.file.text().data() + as.appended + array.begin;
        const std::int64_t length = as.header_bytes == 8 ? load<std::int64_t>(head, as.swapped)
                                                         : load<std::uint32_t>(head, as.swapped);
        source.begin = as.appended + array.begin + static_cast<std::size_t>(as.header_bytes);
        const std::size_t rest = store_.file_size - source.begin;
        if (length < 0 || static_cast<std::size_t>(length) > rest) {
            mesh_.file.fail(source.begin, "the array " + std::string(name) + " has " +
                                              std::to_string(length) + " bytes, but only " +
                                              std::to_string(rest) + " follow");
        }
        source.end = source.begin + static_cast<std::size_t>(length);
    }
    if (source.is_binary && (source.end - source.begin) % static_cast<std::size_t>(bytes) != 0) {
        mesh_.file.fail(array.tag, "the array " + std::string(name) + " has " +
                                       std::to_string(source.end - source.begin) + " bytes, and " +
                                       std::to_string(bytes) + " for each number");
    }
    return source;
}

void VtkXmlReader::begin_numbers(const VtkArray& array, const char* name, int bytes) {
    const Source source = source_of(array, name, bytes);
    numbers_.is_binary = source.is_binary;
    numbers_.jump(source.begin);
    numbers_.stop_at(source.end);
}

void VtkXmlReader::read_points(const Piece& piece) {
    const VtkArray& array = piece.points;
    const int bytes = array.type == "Float32" ? 4 : 8;
    begin_numbers(array, "Points", bytes);
    if (array.type != "Float32" && array.type != "Float64") {
        mesh_.file.fail(array.tag, "expected points of type Float32 or Float64, found " +
                                       in_quotes(array.type));
    }
    if (array.components != "3")
        mesh_.file.fail(array.tag, "expected points with NumberOfComponents=\"3\"");
    const NumberKind kind = !numbers_.is_binary ? NumberKind::text
                            : bytes == 4        ? NumberKind::real32
                                                : NumberKind::real64;
    if (has_kind_ && kind != mesh_.in_file.kind) {
        mesh_.file.fail(
            array.tag,
            "the points of the pieces are stored in several ways: save the grid as one piece");
    }
    has_kind_ = true;
    mesh_.in_file.kind = kind;
    for (std::int64_t i = 0; i < 3 * piece.n_points; ++i) {
        const auto d = static_cast<std::size_t>(i % 3);
        elements_.points.x[d].push_back(numbers_.real("a coordinate of a point", bytes));
        elements_.points.offset[d].push_back(numbers_.number_offset());
    }
    if (!numbers_.at_end()) {
        mesh_.file.fail(numbers_.offset(), "the array Points has more numbers than " +
                                               plural(piece.n_points, "point"));
    }
}

void VtkXmlReader::read_cells(const Piece& piece) {
    VtkCells cells;
    cells.starts = {0};
    read_wholes(piece.offsets, "offsets", cells.starts, nullptr);
    check_length(piece.offsets, "offsets", cells.starts.size() - 1, piece.n_cells);
    read_wholes(piece.types, "types", cells.types, nullptr);
    check_length(piece.types, "types", cells.types.size(), piece.n_cells);
    read_wholes(piece.connectivity, "connectivity", cells.points, &cells.offsets);
    cells.starts_offset = piece.offsets.tag;
    numbers_read_ += cells.types.size() + cells.points.size();
    add_vtk_cells(mesh_.file, cells, first_point_, elements_);
}

void VtkXmlReader::read_wholes(const VtkArray& array, const char* name,
                               std::vector<std::int64_t>& values,
                               std::vector<std::size_t>* offsets) {
    const std::string& type = array.type;
    const int bytes = type == "Int8" || type == "UInt8"     ? 1
                      : type == "Int32" || type == "UInt32" ? 4
                      : type == "Int64" || type == "UInt64" ? 8
                                                            : 0;
    begin_numbers(array, name, bytes > 0 ? bytes : 1);
    if (bytes == 0) {
        mesh_.file.fail(array.tag,
                        "expected whole numbers of 8, 32 or 64 bits, found " + in_quotes(type));
    }
    while (!numbers_.at_end()) {
        values.push_back(numbers_.whole("a whole number", bytes));
        if (offsets) offsets->push_back(numbers_.number_offset());
    }
}

void VtkXmlReader::check_length(const VtkArray& array, const char* name, std::size_t length,
                                std::int64_t wanted) const {
    if (static_cast<std::int64_t>(length) == wanted) return;
    const std::string numbers = plural(static_cast<std::int64_t>(length), "number"),
                      cells = plural(wanted, "cell");
    mesh_.file.fail(array.tag,
                    "the array " + std::string(name) + " has " + numbers + " for " + cells);
}

// Pieces with common arrays could ask for more than the file holds.
void VtkXmlReader::check_total(const Piece& piece) {
    numbers_read_ += static_cast<std::size_t>(piece.n_points);
    if (numbers_read_ > mesh_.file.text().size() || elements_.points.x[0].size() > INT32_MAX) {
        mesh_.file.fail(piece.tag, "the pieces have more points and cells than the file can hold");
    }
}

bool probe_vtu(const TextFile& file) {
    const std::string_view start = std::string_view(file.text()).substr(0, 1024);
    return trimmed(start).substr(0, 1) == "<" && start.find("<VTKFile") != start.npos;
}

void read_vtu(Mesh& mesh, const ReadOptions&) { VtkXmlReader(mesh).read(); }

void create_vtu(std::ostream& out, const Mesh& mesh) { write_vtu(out, mesh); }

}  // namespace

const Format vtk_xml_format = {
    "vtu",     ".vtu",   "VTK XML unstructured grids: text, base64, appended, zlib",
    probe_vtu, read_vtu, create_vtu,
    false};

}  // namespace cli
