// The ring in Fluent files: faces with the cells beside them, numbers in hexadecimal, ends of lines
// CR LF.
#pragma once

#include "ring.hpp"

namespace ring {

inline std::string hexadecimal(int value) {
    char text[16];
    std::snprintf(text, sizeof text, "%x", static_cast<unsigned>(value));
    return text;
}

// Tight: no blanks and ends of lines but those that separate numbers; the nodes in two sections,
// the second first; no names of zones. Binary: nodes in double precision and faces in whole numbers
// of four bytes, little-endian.
inline std::string fluent(bool tight, bool binary = false) {
    const std::string line = tight ? "" : "\r\n",
                      n_faces = hexadecimal(around * (2 * outwards + 1));
    const int n = around * outwards;
    const auto head = [](std::initializer_list<int> values) {
        std::string text = "(";
        for (const int value : values) text += (text.size() > 1 ? " " : "") + hexadecimal(value);
        return text + ")";
    };
    std::string out = "(0 \"a comment (with one bracket\")\r\n(2 2)\r\n";
    if (!tight) {
        out += "(10 (0 1 a8 0 2))\r\n(12 (0 1 " + hexadecimal(n) + " 0))\r\n(13 (0 1 " + n_faces +
               " 0))\r\n";
    }
    const auto binary_section = [&](int number, const std::string& section_head,
                                    const std::string& body) {
        const std::string name = std::to_string(number);
        out += "(" + name + " " + section_head + "\r\n(" + body + ")\r\nEnd of Binary Section   " +
               name + ")\r\n";
    };
    const auto nodes = [&](int first, int last) {  // from 0, without the last
        if (binary) {
            Bytes body;
            for (int k = first; k < last; ++k) {
                body.put(x[std::size_t(k)]);
                body.put(y[std::size_t(k)]);
            }
            return binary_section(3010, head({1, first + 1, last, 1, 2}), body.text);
        }
        out += "(10 " + head({1, first + 1, last, 1, 2}) + line + "(" + line;
        for (int k = first; k < last; ++k) {
            out += print("%.16e", x[std::size_t(k)]) + " " + print("%.16e", y[std::size_t(k)]);
            if (!tight || k + 1 < last) out += "\r\n";
        }
        out += "))\r\n";
    };
    if (tight) nodes(100, 168);
    nodes(0, tight ? 100 : 168);
    if (!tight) out += "(12 (2 1 " + hexadecimal(n) + " 1 0)(3 3 3))\r\n";
    const auto cell = [&](int i, int j) {
        return j < 0 || j >= outwards ? 0 : j * around + (i + around) % around + 1;
    };
    int face = 0;
    // A face goes from a to b; the cell on its right is the first. `mixed`: the number of points
    // before each face.
    using Face = std::function<void(int, int, int, int)>;  // a, b, right cell, left cell
    const auto faces = [&](int zone, int type, bool mixed,
                           const std::function<void(const Face&)>& each) {
        std::string body;
        int count = 0;
        Bytes numbers;
        each([&](int a, int b, int right, int left) {
            if (mixed) numbers.put(std::int32_t{2});
            for (const int value : {a + 1, b + 1, right, left}) numbers.put(std::int32_t{value});
            if (count > 0 || !tight) body += "\r\n";
            body += mixed ? "2 " : "";
            body += hexadecimal(a + 1) + " " + hexadecimal(b + 1) + " " + hexadecimal(right) + " " +
                    hexadecimal(left);
            ++count;
        });
        const std::string zone_head = head({zone, face + 1, face + count, type, mixed ? 0 : 2});
        if (binary) binary_section(2013, zone_head, numbers.text);
        else out += "(13 " + zone_head + "(" + body + line + "))\r\n";
        face += count;
    };
    faces(3, 2, false, [&](const auto& face_of) {  // between cells
        for (int j = 1; j < outwards; ++j) {
            for (int i = 0; i < around; ++i)
                face_of(point(i + 1, j), point(i, j), cell(i, j), cell(i, j - 1));
        }
        for (int j = 0; j < outwards; ++j) {
            for (int i = 0; i < around; ++i)
                face_of(point(i, j), point(i, j + 1), cell(i, j), cell(i - 1, j));
        }
    });
    faces(16, 3, true, [&](const auto& face_of) {
        for (int i = 0; i < around; ++i) face_of(point(i + 1, 0), point(i, 0), cell(i, 0), 0);
    });
    faces(4, 9, false, [&](const auto& face_of) {
        for (int i = 0; i < around; ++i)
            face_of(point(i, outwards), point(i + 1, outwards), cell(i, outwards - 1), 0);
    });
    if (tight) return out;
    return out +
           "(45 (2 fluid air)())\r\n(45 (3 interior int_air)())\r\n(39 (16 wall body 1)())\r\n"
           "(45 (4 pressure-far-field far)(\r\n(gauge-pressure . 0) (text . \")\")))\r\n(64 "
           "(anything ()))\r\n";
}

inline Kinds fluent_kinds() {
    return {
        {"fluent.msh", [] { return fluent(false); }},
        {"fluent-binary.msh", [] { return fluent(false, true); }},
        {"fluent-tight.msh", [] { return fluent(true); }},
    };
}

}  // namespace ring
