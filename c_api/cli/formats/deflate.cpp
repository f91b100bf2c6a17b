#include "formats/deflate.hpp"

#include "basics/failure.hpp"

#ifdef HARMORPH_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <limits>

namespace cli {

bool is_gzip(std::string_view data) { return data.substr(0, 2) == "\x1f\x8b"; }

TextFile read_unpacked(const std::string& path) {
    TextFile file(path);
    return is_gzip(file.text()) ? unpacked(file) : std::move(file);
}

#ifdef HARMORPH_ZLIB
namespace {

constexpr int window_bits = 15, gzip_header = 16;  // flags of zlib: largest window, gzip format
constexpr std::size_t max_at_once = 1 << 30;       // zlib counts bytes in 32 bits

// Appends the bytes of all compressed streams in the data. Returns false if the data are damaged or
// hold more than max_bytes.
bool inflate_all(std::string_view data, int bits, std::size_t max_bytes, std::string& to) {
    z_stream stream = {};
    if (inflateInit2(&stream, bits) != Z_OK) return false;
    char buffer[1 << 16];
    int status = Z_OK;
    std::size_t taken = 0, appended = 0;
    while (status == Z_OK || (status == Z_STREAM_END && taken < data.size())) {
        if (status == Z_STREAM_END &&
            (!is_gzip(data.substr(taken)) || inflateReset(&stream) != Z_OK))
            break;
        const std::size_t part = std::min(data.size() - taken, max_at_once);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + taken));
        stream.avail_in = static_cast<uInt>(part);
        stream.next_out = reinterpret_cast<Bytef*>(buffer);
        stream.avail_out = sizeof buffer;
        status = inflate(&stream, Z_NO_FLUSH);
        taken += part - stream.avail_in;
        const std::size_t n = sizeof buffer - stream.avail_out;
        appended += n;
        if (appended > max_bytes) status = Z_DATA_ERROR;
        if (status == Z_OK || status == Z_STREAM_END) to.append(buffer, n);
    }
    inflateEnd(&stream);
    return status == Z_STREAM_END;
}

std::string deflate_all(std::string_view bytes, int bits) {
    z_stream stream = {};
    std::string data;
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, bits, 8, Z_DEFAULT_STRATEGY) !=
        Z_OK) {
        throw Failure(exit_file, "zlib cannot compress: there is too little memory");
    }
    char buffer[1 << 16];
    int status = Z_OK;
    for (std::size_t taken = 0; status == Z_OK;) {
        const std::size_t part = std::min(bytes.size() - taken, max_at_once);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
        stream.avail_in = static_cast<uInt>(part);
        stream.next_out = reinterpret_cast<Bytef*>(buffer);
        stream.avail_out = sizeof buffer;
        status = deflate(&stream, taken + part == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        taken += part - stream.avail_in;
        data.append(buffer, sizeof buffer - stream.avail_out);
    }
    deflateEnd(&stream);
    return data;
}

}  // namespace

std::string lack_of_zlib() { return ""; }

bool inflate_block(std::string_view data, std::size_t size, std::string& to) {
    const std::size_t before = to.size();
    if (size > max_zlib_ratio * (data.size() + 1)) return false;
    return inflate_all(data, window_bits, size, to) && to.size() == before + size;
}

std::string deflate_block(std::string_view bytes) { return deflate_all(bytes, window_bits); }

TextFile unpacked(const TextFile& file) {
    std::string text;
    if (!inflate_all(file.text(), window_bits + gzip_header,
                     std::numeric_limits<std::size_t>::max(), text)) {
        throw Failure(exit_file,
                      file.path() + ": the file is compressed by gzip, and damaged or cut off");
    }
    return TextFile(file.path(), std::move(text));
}

std::string gzip(std::string_view bytes) { return deflate_all(bytes, window_bits + gzip_header); }
#else
std::string lack_of_zlib() {
    return "this program was made without zlib (Debian's zlib1g-dev), which reads compressed data";
}
bool inflate_block(std::string_view, std::size_t, std::string&) { return false; }
std::string deflate_block(std::string_view bytes) { return std::string(bytes); }
TextFile unpacked(const TextFile& file) {
    throw Failure(exit_file, file.path() + ": the file is compressed by gzip, and " +
                                 lack_of_zlib() +
                                 ": gunzip it, or make the "
                                 "program where zlib is installed");
}
std::string gzip(std::string_view bytes) { return std::string(bytes); }
#endif

}  // namespace cli
