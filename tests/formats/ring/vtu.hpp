// The ring in XML files of VTK.
#pragma once

#include "ring.hpp"

namespace ring {

// header_bytes: of the length before each array, 0: all is text.
inline std::string vtu(int header_bytes, bool swapped, bool is_single) {
    std::string arrays;
    Bytes appended{swapped};
    std::size_t after_mark = 0;
    const auto array = [&](const char* type, const char* attributes, int count, int bytes,
                           const std::function<void(int, Bytes&)>& put,
                           const std::function<std::string(int)>& text) {
        arrays += std::string("<DataArray type=\"") + type + "\" " + attributes;
        if (header_bytes == 0) {
            arrays += " format=\"ascii\">";
            for (int k = 0; k < count; ++k) arrays += (k > 0 ? " " : "") + text(k);
            arrays += "</DataArray>\n";
            return;
        }
        arrays += " format='appended'  offset=\"" + std::to_string(after_mark) + "\"/>\n";
        const int length = count * bytes;
        header_bytes == 8 ? appended.put(std::uint64_t(length))
                          : appended.put(std::uint32_t(length));
        for (int k = 0; k < count; ++k) put(k, appended);
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
    const std::string more = header_bytes == 0   ? " compressor=\"vtkZLibDataCompressor\""
                             : header_bytes == 8 ? " header_type=\"UInt64\""
                                                 : "";
    std::string text = "<?xml version=\"1.0\"?>\n<!-- a <comment> -->\n";
    text += "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"";
    text += std::string(" byte_order=\"") + (swapped ? "Big" : "Little") + "Endian\"" + more;
    text += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"168\" NumberOfCells=\"" +
            std::to_string(n) + "\">\n";
    text += arrays + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (header_bytes > 0)
        text += "<AppendedData encoding=\"raw\">\n _" + appended.text + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
}

inline Kinds vtu_kinds() {
    return {
        {"text.vtu", [] { return vtu(0, false, false); }},
        {"appended-32.vtu", [] { return vtu(4, false, false); }},
        {"appended-64.vtu", [] { return vtu(8, false, false); }},
        {"appended-single.vtu", [] { return vtu(4, false, true); }},
        {"appended-swapped.vtu", [] { return vtu(8, true, false); }},
    };
}

}  // namespace ring
