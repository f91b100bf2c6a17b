// The ring in XML files of VTK.
#pragma once

#include "ring.hpp"

namespace ring {

inline std::string base64(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bits, text;
    for (const char c : bytes) {
        for (int bit = 7; bit >= 0; --bit) bits += (c >> bit & 1) != 0 ? '1' : '0';
    }
    while (bits.size() % 6 != 0) bits += '0';
    for (std::size_t at = 0; at < bits.size(); at += 6)
        text += digits[std::stoul(bits.substr(at, 6), nullptr, 2)];
    while (text.size() % 4 != 0) text += '=';
    return text;
}

// A stream of zlib that stores its bytes as they are (RFC 1950 and 1951).
inline std::string stored(const std::string& bytes) {
    std::string text = "\x78\x01\x01";
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const std::size_t n = bytes.size();
    for (const std::size_t part : {n, n >> 8, ~n, ~n >> 8}) text += static_cast<char>(part & 255);
    text += bytes;
    for (const std::uint32_t part : {b >> 8, b, a >> 8, a}) text += static_cast<char>(part & 255);
    return text;
}

// raw: appended; in_place, in_base64: both in base64, the second one appended; packed,
// packed_in_place: compressed.
enum Coding { raw, in_place, in_base64, packed, packed_in_place };

// header_bytes: of the length before each array, 0: all is text.
inline std::string vtu(int header_bytes, bool swapped, bool is_single, Coding coding = raw) {
    std::string arrays;
    Bytes appended{swapped};
    std::size_t after_mark = 0;
    const auto array = [&](const char* type, const char* attributes, int count, int bytes,
                           const std::function<void(int, Bytes&)>& put,
                           const std::function<std::string(int)>& text) {
        arrays += std::string("<DataArray type=\"") + type + "\" " + attributes;
        if (header_bytes == 0) {
            arrays += swapped ? ">" : " format=\"ascii\">";  // text, too, where nothing is said
            for (int k = 0; k < count; ++k) arrays += (k > 0 ? " " : "") + text(k);
            arrays += "</DataArray>\n";
            return;
        }
        Bytes data{swapped}, head{swapped};
        for (int k = 0; k < count; ++k) put(k, data);
        const auto whole = [&](std::size_t value) {
            header_bytes == 8 ? head.put(std::uint64_t(value)) : head.put(std::uint32_t(value));
        };
        const bool is_packed = coding == packed || coding == packed_in_place;
        if (is_packed) {
            const std::size_t block = 1000, n = (data.text.size() + block - 1) / block;
            std::vector<std::string> blocks;
            for (std::size_t k = 0; k < n; ++k)
                blocks.push_back(stored(data.text.substr(k * block, block)));
            for (const std::size_t value : {n, block, data.text.size() % block}) whole(value);
            data.text.clear();
            for (const std::string& one : blocks) {
                whole(one.size());
                data.text += one;
            }
        } else {
            whole(data.text.size());
        }
        const bool has_text = coding != raw && coding != packed;
        std::string all = head.text + data.text;
        if (has_text) all = is_packed ? base64(head.text) + base64(data.text) : base64(all);
        if (coding == in_place || coding == packed_in_place) {
            arrays += " Format=\"binary\">\n   " + all + "\n</DataArray>\n";
            return;
        }
        arrays += " format='appended'  offset=\"" + std::to_string(after_mark) + "\"/>\n";
        appended.text += all;
        after_mark = appended.text.size();
    };
    const auto wholes = [&](const char* type, const char* attributes, int count, int bytes,
                            const std::function<int(int)>& value) {
        array(
            type, attributes, count, bytes,
            [&](int k, Bytes& out) {
                if (bytes == 8) out.put(std::int64_t{value(k)});
                else if (bytes == 4) out.put(std::int32_t{value(k)});
                else out.put(std::uint8_t(value(k)));
            },
            [&](int k) { return std::to_string(value(k)); });
    };
    const auto coordinate = [](int k) {
        const auto p = std::size_t(k / 3);
        return k % 3 == 0 ? x[p] : k % 3 == 1 ? y[p] : 0;
    };
    const int n = around * outwards, size = header_bytes == 8 ? 8 : 4;
    const char* const type = size == 8 ? "Int64" : "Int32";
    arrays += "<PointData>\n";  // an array of the same name elsewhere
    wholes("UInt8", "Name=\"types\"", 168, 1, [](int) { return 60; });  // the character <
    arrays += "</PointData>\n<Points>\n";
    array(
        is_single ? "Float32" : "Float64", "Name=\"xyz\" NumberOfComponents=\"3\"", 3 * 168,
        is_single ? 4 : 8,
        [&](int k, Bytes& out) {
            is_single ? out.put(float(coordinate(k))) : out.put(coordinate(k));
        },
        [&](int k) { return print("%.16g", coordinate(k)); });
    arrays += "</Points>\n<Cells>\n";
    wholes(type, "Name=\"connectivity\"", 4 * n, size, [](int k) {
        const int i = k / 4 % around, j = k / 4 / around;
        return point(i + (k % 4 == 1 || k % 4 == 2), j + (k % 4 >= 2));
    });
    wholes(type, "Name=\"offsets\"", n, size, [](int k) { return 4 * k + 4; });
    wholes("UInt8", "Name=\"types\"", n, 1, [](int) { return 9; });
    // VTK names a compressor in text, too.
    const std::string compressor = coding == packed || coding == packed_in_place
                                       ? " compressor=\"vtkZLibDataCompressor\""
                                       : "";
    const std::string more =
        compressor + (header_bytes == 0   ? " compressor=\"vtkZLibDataCompressor\""
                      : header_bytes == 8 ? " header_type=\"UInt64\""
                                          : "");
    std::string text = "<?xml version=\"1.0\"?>\n<!-- a <comment> -->\n";
    text += "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"";
    text += std::string(" byte_order=\"") + (swapped ? "Big" : "Little") + "Endian\"" + more;
    text += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"168\" NumberOfCells=\"" +
            std::to_string(n) + "\">\n";
    text += arrays + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    const std::string encoding = coding == in_base64 ? "base64" : "raw";
    if (after_mark > 0)
        text += "<AppendedData encoding=\"" + encoding + "\">\n _" + appended.text +
                "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
}

inline Kinds vtu_kinds() {
    return {
        {"in-place.vtu", [] { return vtu(4, false, false, in_place); }},
        {"in-place-single.vtu", [] { return vtu(8, true, true, in_place); }},
        {"base64.vtu", [] { return vtu(8, false, false, in_base64); }},
        {"packed.vtu", [] { return vtu(4, false, false, packed); }},
        {"packed-in-place.vtu", [] { return vtu(8, true, false, packed_in_place); }},
        {"no-format.vtu", [] { return vtu(0, true, false); }},
        {"text.vtu", [] { return vtu(0, false, false); }},
        {"appended-32.vtu", [] { return vtu(4, false, false); }},
        {"appended-64.vtu", [] { return vtu(8, false, false); }},
        {"appended-single.vtu", [] { return vtu(4, false, true); }},
        {"appended-swapped.vtu", [] { return vtu(8, true, false); }},
    };
}

}  // namespace ring
