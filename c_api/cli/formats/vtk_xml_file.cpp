#include "formats/vtk_xml_file.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"
#include "formats/deflate.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

namespace cli {

namespace {

constexpr const char* zlib_compressor = "vtkZLibDataCompressor";

// Takes the bytes of an array one after another, from base64 or raw data.
class EncodedBytes {
public:
    EncodedBytes(const TextFile& file, bool is_raw, std::size_t begin, std::size_t end,
                 const std::string& name)
        : file_(file),
          text_(file.text().substr(0, end)),
          is_raw_(is_raw),
          at_(begin),
          name_(name) {}

    std::string_view take(std::size_t n) {
        if (is_raw_) {
            if (n > text_.size() - at_) fail(n);
            at_ += n;
            return text_.substr(at_ - n, n);
        }
        // Base64 has more characters than bytes, so a number of bytes that the file cannot have is
        // refused here.
        const std::size_t there = decoded_.size() - used_;
        if (n > there &&
            (n - there > text_.size() - at_ || !decode_base64(text_, at_, n - there, decoded_)))
            fail(n);
        used_ += n;
        return std::string_view(decoded_).substr(used_ - n, n);
    }
    std::int64_t number(const VtkEncoding& as) {
        const char* const bytes = take(static_cast<std::size_t>(as.header_bytes)).data();
        const std::int64_t value = as.header_bytes == 8 ? load<std::int64_t>(bytes, as.swapped)
                                                        : load<std::uint32_t>(bytes, as.swapped);
        if (value < 0) fail(0);
        return value;
    }
    std::size_t offset() const { return at_; }
    bool at_padding() const {
        return !is_raw_ && used_ == decoded_.size() && at_ > 0 && text_[at_ - 1] == '=';
    }
    [[noreturn]] void fail(std::size_t n) const {
        file_.fail(at_, "the array " + name_ + " is damaged or cut off" +
                            (n > 0 ? ": " + plural(static_cast<std::int64_t>(n), "byte") +
                                         " more are expected"
                                   : ""));
    }

private:
    const TextFile& file_;
    std::string_view text_;
    bool is_raw_;
    std::size_t at_;
    std::string name_;
    std::string decoded_;
    std::size_t used_ = 0;
};

void put_number(const VtkEncoding& as, std::size_t value, std::string& to) {
    const std::uint64_t whole = value;
    for (int k = 0; k < as.header_bytes; ++k) {
        const bool is_little = as.swapped != little_endian_machine();
        const int shift = 8 * (is_little ? k : as.header_bytes - 1 - k);
        to += static_cast<char>(whole >> shift & 0xff);
    }
}

void check_bytes(const TextFile& file, const VtkArray& array, const std::string& name, double bytes,
                 std::size_t max_bytes) {
    if (bytes <= static_cast<double>(max_bytes)) return;
    file.fail(array.tag, "the array " + name + " unpacks to " + brief(bytes) +
                             " bytes, but the points and cells of its piece need " +
                             std::to_string(max_bytes) + " at most");
}

void decode_blocks(EncodedBytes& bytes, const TextFile& file, const VtkEncoding& as,
                   const VtkArray& array, const std::string& name, std::size_t max_bytes,
                   VtkDecoded& found, std::string& text) {
    const std::int64_t n = bytes.number(as);
    if (n == 0) return;
    const std::int64_t block = bytes.number(as), last = bytes.number(as);
    const double whole_blocks = static_cast<double>(last > 0 ? n - 1 : n);
    check_bytes(file, array, name,
                whole_blocks * static_cast<double>(block) + static_cast<double>(last), max_bytes);
    std::vector<std::size_t> sizes;
    for (std::int64_t k = 0; k < n; ++k)
        sizes.push_back(static_cast<std::size_t>(bytes.number(as)));
    found.block = static_cast<std::size_t>(block);
    found.has_own_header = bytes.at_padding();
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const bool is_short = k + 1 == sizes.size() && last > 0;
        const std::string_view data = bytes.take(sizes[k]);
        if (!inflate_block(data, static_cast<std::size_t>(is_short ? last : block), text)) {
            file.fail(array.tag,
                      "block " + std::to_string(k + 1) + " of the array " + name + " is damaged");
        }
    }
}

}  // namespace

int VtkArray::number_bytes() const {
    if (type == "Int8" || type == "UInt8") return 1;
    if (type == "Int16" || type == "UInt16") return 2;
    return type == "Float32" || type == "Int32" || type == "UInt32" ? 4 : 8;
}

VtkDecoded decode_vtk(const TextFile& file, const VtkEncoding& as, const VtkArray& array,
                      const std::string& name, std::size_t max_bytes, std::string& text) {
    VtkDecoded found;
    found.is_appended = array.is_appended;
    found.is_raw = array.is_appended && as.is_raw;
    found.begin = array.is_appended ? as.appended + array.begin : array.begin;
    found.bytes = text.size();
    const std::size_t end = array.is_appended ? file.text().size() : array.end;
    while (!found.is_raw && found.begin < end &&
           blanks.find(file.text()[found.begin]) != blanks.npos)
        ++found.begin;
    if (found.begin > end)
        file.fail(array.tag, "the array " + name + " begins after the end of the file");
    EncodedBytes bytes(file, found.is_raw, found.begin, end, name);
    if (as.compressor.empty()) {
        const auto n = static_cast<std::size_t>(bytes.number(as));
        check_bytes(file, array, name, static_cast<double>(n), max_bytes);
        found.has_own_header = bytes.at_padding();
        text += bytes.take(n);
    } else {
        if (as.compressor != zlib_compressor) {
            file.fail(array.tag,
                      "the array " + name + " is compressed by " + in_quotes(as.compressor) +
                          ": save the file with the compressor ZLib, or without compression");
        }
        if (!lack_of_zlib().empty()) {
            file.fail(array.tag, "the array " + name + " is compressed, and " + lack_of_zlib() +
                                     ": save the file without compression");
        }
        decode_blocks(bytes, file, as, array, name, max_bytes, found, text);
    }
    // Arrays that overlap could need more memory than the file can hold.
    const std::size_t max_total = (as.compressor.empty() ? 1 : max_zlib_ratio) * file.text().size();
    if (text.size() - file.text().size() > max_total)
        file.fail(array.tag, "the arrays of the file overlap");
    found.end = bytes.offset();
    found.bytes_end = text.size();
    return found;
}

std::string encode_vtk(const VtkEncoding& as, const VtkDecoded& array, std::string_view bytes) {
    std::string header, data;
    if (as.compressor.empty()) {
        put_number(as, bytes.size(), header);
        data = std::string(bytes);
    } else {
        const std::size_t block = std::max<std::size_t>(array.block, 1),
                          n = (bytes.size() + block - 1) / block;
        put_number(as, n, header);
        put_number(as, block, header);
        put_number(as, bytes.size() % block, header);
        for (std::size_t k = 0; k < n; ++k) {
            const std::string compressed = deflate_block(bytes.substr(k * block, block));
            put_number(as, compressed.size(), header);
            data += compressed;
        }
    }
    if (array.is_raw) return header + data;
    return array.has_own_header ? encode_base64(header) + encode_base64(data)
                                : encode_base64(header + data);
}

void VtkStore::operator()(std::ostream& out, const Mesh& mesh, const std::string& text) const {
    struct Replaced {
        std::size_t begin, end;
        std::string text;
    };
    std::vector<Replaced> list;
    const std::string_view before = mesh.file.text();
    for (const VtkDecoded& array : points) {
        const std::size_t n = array.bytes_end - array.bytes;
        if (text.compare(array.bytes, n, before, array.bytes, n) == 0) continue;
        list.push_back(
            {array.begin, array.end, encode_vtk(encoding, array, {text.data() + array.bytes, n})});
    }
    const std::size_t n_arrays = list.size();
    for (const VtkArray& array : appended) {
        std::size_t offset = array.begin;
        for (std::size_t k = 0; k < n_arrays; ++k) {
            if (encoding.appended > 0 && list[k].begin >= encoding.appended &&
                list[k].begin < encoding.appended + array.begin) {
                offset += list[k].text.size() -
                          (list[k].end - list[k].begin);  // modulo 2^64 if the array shrinks
            }
        }
        if (offset == array.begin) continue;
        list.push_back(
            {array.offset_at, array.offset_at + array.offset_length, std::to_string(offset)});
    }
    std::sort(list.begin(), list.end(),
              [](const Replaced& a, const Replaced& b) { return a.begin < b.begin; });
    std::size_t copied = 0;
    const auto copy_to = [&](std::size_t end) {
        out.write(text.data() + copied, static_cast<std::streamsize>(end - copied));
    };
    for (const Replaced& one : list) {
        copy_to(one.begin);
        out << one.text;
        copied = one.end;
    }
    copy_to(file_size);
}

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
