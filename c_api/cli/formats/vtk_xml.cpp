// VTK's XML files of unstructured grids (.vtu, .pvtu) and of structured grids (.vts,
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html), of one piece or
// several, in two dimensions or one cell thick. Arrays are in text, in base64, or in the section
// AppendedData, also compressed by zlib. Pieces meet where their points have equal
// coordinates, as cuts do.
#include "basics/numbers.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "formats/vtk_cells.hpp"
#include "formats/vtk_parallel.hpp"
#include "formats/vtk_xml_file.hpp"
#include "formats/vtu.hpp"

#include <algorithm>

namespace cli {

namespace {

class VtkXmlReader {
public:
    explicit VtkXmlReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    void read();

private:
    struct Source {  // the place of the numbers of an array in mesh_.file after decode()
        std::size_t begin, end;
        bool is_binary;
    };

    void decode();
    Source source_of(const VtkArray& array, const char* name, int bytes) const;
    void begin_numbers(const VtkArray& array, const char* name, int bytes);
    void read_points(const VtkPiece& piece);
    void read_cells(const VtkPiece& piece);
    void read_wholes(const VtkArray& array, const char* name, std::vector<std::int64_t>& values,
                     std::vector<std::size_t>* offsets);
    void check_length(const VtkArray& array, const char* name, std::size_t length,
                      std::int64_t wanted) const;
    void check_total(const VtkPiece& piece);

    Mesh& mesh_;
    NumberReader numbers_;
    VtkXmlFile content_;
    VtkStore store_;
    std::vector<std::pair<std::size_t, VtkDecoded>> decoded_;  // in the order of the tags
    Elements elements_;
    std::int32_t first_point_ = 0;  // the first point of the piece
    std::size_t numbers_read_ = 0;
    bool has_kind_ = false;
};

void VtkXmlReader::read() {
    content_ = read_vtk_xml_tags(mesh_.file);
    numbers_.swapped = mesh_.in_file.swapped = content_.encoding.swapped;
    decode();
    for (const VtkPiece& piece : content_.pieces) {
        first_point_ = elements_.points.points();
        if (piece.n_points > 0) read_points(piece);
        if (content_.is_structured) {
            if (!add_vtk_blocks(piece.size, first_point_, elements_)) {
                mesh_.file.fail(piece.tag,
                                "the grid has no cells, as two directions have one point");
            }
        } else if (piece.n_cells > 0) {
            read_cells(piece);
        }
        check_total(piece);
    }
    build_mesh(mesh_, elements_);
}

// Returns the bytes that an array has at most. Cells have up to 27 points each, except for
// polygons: those in a plane have up to 6 corners for each point together, as a plane graph has at
// most three edges for each point, and an edge is a side of at most two polygons.
std::size_t most_bytes(const VtkPiece& piece, const VtkArray& array) {
    const std::int64_t numbers = &array == &piece.points ? 3 * piece.n_points
                                 : &array == &piece.connectivity
                                     ? 27 * piece.n_cells + 6 * piece.n_points
                                     : piece.n_cells;
    return static_cast<std::size_t>(numbers * array.number_bytes());
}

// Appends encoded arrays to the text of the file, where they are read, and changed, as raw arrays.
void VtkXmlReader::decode() {
    const VtkEncoding& as = content_.encoding;
    store_.file_size = mesh_.file.text().size();
    std::string text;
    for (const VtkPiece& piece : content_.pieces) {
        const std::pair<const VtkArray*, const char*> arrays[] = {
            {&piece.points, "Points"},
            {&piece.connectivity, "connectivity"},
            {&piece.offsets, "offsets"},
            {&piece.types, "types"}};
        for (const auto& [array, name] : arrays) {
            const bool is_needed = array == &piece.points ? piece.n_points > 0 : piece.n_cells > 0;
            if (!array->is_there || !is_needed || !array->is_encoded(as)) continue;
            if (array->is_appended && as.appended == 0) continue;  // source_of() refuses the array
            if (decoded_.empty()) text = mesh_.file.text();
            decoded_.emplace_back(array->tag, decode_vtk(mesh_.file, as, *array, name,
                                                         most_bytes(piece, *array), text));
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
    store_.encoding = content_.encoding;
    store_.appended = content_.appended;
    mesh_.in_file.store = store_;
}

VtkXmlReader::Source VtkXmlReader::source_of(const VtkArray& array, const char* name,
                                             int bytes) const {
    if (!array.is_there)
        mesh_.file.fail(content_.pieces.back().tag, "the file has no array " + std::string(name));
    const auto found =
        std::lower_bound(decoded_.begin(), decoded_.end(), array.tag,
                         [](const auto& one, std::size_t tag) { return one.first < tag; });
    Source source = {array.begin, array.end, array.is_binary || array.is_appended};
    if (found != decoded_.end() && found->first == array.tag) {
        source.begin = found->second.bytes;
        source.end = found->second.bytes_end;
    } else if (array.is_appended) {
        const VtkEncoding& as = content_.encoding;
        if (as.appended == 0) {
            mesh_.file.fail(array.tag,
                            "the array is appended, but the file has no section AppendedData");
        }
        const std::size_t there = store_.file_size - as.appended;
        if (array.begin > there ||
            there - array.begin < static_cast<std::size_t>(as.header_bytes)) {
            mesh_.file.fail(array.tag, "the offset must be between 0 and " + std::to_string(there) +
                                           ", not '" + std::to_string(array.begin) + "'");
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

void VtkXmlReader::read_points(const VtkPiece& piece) {
    const VtkArray& array = piece.points;
    const int bytes = array.type == "Float32" ? 4 : 8;
    begin_numbers(array, "Points", bytes);
    if (array.type != "Float32" && array.type != "Float64") {
        mesh_.file.fail(array.tag, "the type of points must be Float32 or Float64, not " +
                                       in_quotes(array.type));
    }
    if (array.components != "3")
        mesh_.file.fail(array.tag, "points must have NumberOfComponents=\"3\"");
    const NumberKind kind = !numbers_.is_binary ? NumberKind::text
                            : bytes == 4        ? NumberKind::real32
                                                : NumberKind::real64;
    if (has_kind_ && kind != mesh_.in_file.kind) {
        mesh_.file.fail(
            array.tag,
            "the points of the pieces have different number formats: save the grid as one piece");
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

void VtkXmlReader::read_cells(const VtkPiece& piece) {
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
        mesh_.file.fail(array.tag, "whole numbers must have 8, 32 or 64 bits, but the type is " +
                                       in_quotes(type));
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

// Pieces that share arrays could have more points and cells than the file can hold.
void VtkXmlReader::check_total(const VtkPiece& piece) {
    numbers_read_ += static_cast<std::size_t>(piece.n_points);
    if (numbers_read_ > mesh_.file.text().size() || elements_.points.x[0].size() > INT32_MAX) {
        mesh_.file.fail(piece.tag, "the pieces have more points and cells than the file can hold");
    }
}

void read_vtu(Mesh& mesh, const ReadOptions&) {
    if (is_parallel_vtk(mesh.file)) {
        mesh.file = joined_pieces(mesh.file);
        mesh.in_file.is_joined = true;
    }
    VtkXmlReader(mesh).read();
}

void create_vtu(std::ostream& out, const Mesh& mesh) { write_vtu(out, mesh); }

}  // namespace

const Format vtk_xml_format = {
    "vtu",      ".vtu",   "VTK XML unstructured and structured grids: text, base64, appended, zlib",
    is_vtk_xml, read_vtu, create_vtu,
    false};

}  // namespace cli
