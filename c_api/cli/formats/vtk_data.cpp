#include "formats/vtk_data.hpp"

#include "basics/numbers.hpp"
#include "formats/base64.hpp"
#include "formats/bytes.hpp"
#include "formats/deflate.hpp"

#include <algorithm>
#include <ostream>

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

}  // namespace cli
