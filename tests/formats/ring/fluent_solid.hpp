// The ring in Fluent files of three dimensions, between the planes z = 0 and z = 1: point p of the
// ring is p in the first plane and p + 168 in the second.
#pragma once

#include "fluent.hpp"

namespace ring {

enum class FluentNumbers { text, real32, real64 };

// Cells of polygons are two neighbouring cells of the ring, which have 6 corners in each plane.
inline std::string fluent_solid(FluentNumbers kind, bool polygons = false) {
    const int n = int(x.size()), wide = polygons ? 2 : 1, n_cells = around * outwards / wide;
    std::string out = "(2 3)\n";
    int face = 0;
    const auto section = [&](int number, std::vector<int> head, const Bytes& body) {
        const bool is_text = kind == FluentNumbers::text;
        const bool is_double = number == 10 && kind == FluentNumbers::real64;
        const std::string name = std::to_string(number + (is_text ? 0 : is_double ? 3000 : 2000));
        out += "(" + name;
        for (std::size_t k = 0; k < head.size(); ++k)
            out += (k ? " " : " (") + hexadecimal(head[k]);
        out += ")(" + body.text + ")";
        if (!is_text) out += "\nEnd of Binary Section   " + name;
        out += ")\n";
    };
    const auto real = [&](Bytes& body, double value) {
        if (kind == FluentNumbers::real32) body.put(static_cast<float>(value));
        else if (kind == FluentNumbers::real64) body.put(value);
        else body.text += "\n" + print("%.16e", value);
    };
    const auto whole = [&](Bytes& body, int value) {
        if (kind == FluentNumbers::text) body.text += " " + hexadecimal(value);
        else body.put(std::int32_t{value});
    };
    Bytes nodes;
    for (const double z : {0., 1.}) {
        for (std::size_t p = 0; p < x.size(); ++p) {
            for (const double value : {x[p], y[p], z}) real(nodes, value);
        }
    }
    section(10, {1, 1, 2 * n, 1, 3}, nodes);
    out += "(12 (2 1 " + hexadecimal(n_cells) + " 1 0)(0))\n";
    const auto cell = [&](int i, int j) {
        const int k = (i + around) % around / wide;
        return j < 0 || j >= outwards ? 0 : j * (around / wide) + k + 1;
    };
    using Face = std::function<void(const std::vector<int>&, int, int)>;  // points, two cells
    // The number of nodes stands before each face where the faces have the type 0 or 5.
    const auto faces = [&](int zone, int type, int face_type,
                           const std::function<void(const Face&)>& each) {
        Bytes body;
        const int first = face + 1;
        each([&](const std::vector<int>& points, int right, int left) {
            if (right == left) return;  // inside a cell of two
            if (face_type != 4) whole(body, int(points.size()));
            for (const int point : points) whole(body, point + 1);
            whole(body, right);
            whole(body, left);
            ++face;
        });
        section(13, {zone, first, face, type, face_type}, body);
    };
    const auto side = [&](int a, int b) { return std::vector<int>{a, b, b + n, a + n}; };
    faces(3, 2, polygons ? 5 : 4, [&](const Face& add) {
        for (int j = 0; j < outwards; ++j) {
            for (int i = 0; i < around; ++i) {
                if (j > 0) add(side(point(i, j), point(i + 1, j)), cell(i, j), cell(i, j - 1));
                add(side(point(i, j), point(i, j + 1)), cell(i - 1, j), cell(i, j));
            }
        }
    });
    for (const int zone : {20, 21}) {  // the planes
        faces(zone, 7, polygons ? 5 : 4, [&](const Face& add) {
            const int layer = zone == 20 ? 0 : n;
            for (int j = 0; j < outwards; ++j) {
                for (int i = 0; i < around; i += wide) {
                    std::vector<int> points;
                    for (int k = 0; k <= wide; ++k) points.push_back(layer + point(i + k, j));
                    for (int k = wide; k >= 0; --k) points.push_back(layer + point(i + k, j + 1));
                    add(points, cell(i, j), 0);
                }
            }
        });
    }
    faces(16, 3, 0, [&](const Face& add) {
        for (int i = 0; i < around; ++i) add(side(point(i, 0), point(i + 1, 0)), cell(i, 0), 0);
    });
    faces(4, 9, 4, [&](const Face& add) {
        for (int i = 0; i < around; ++i) {
            add(side(point(i, outwards), point(i + 1, outwards)), cell(i, outwards - 1), 0);
        }
    });
    return out +
           "(45 (16 wall body)())\n(45 (4 pressure-far-field far)())\n"
           "(45 (20 symmetry front)())\n(45 (21 symmetry back)())\n";
}

inline Kinds fluent_solid_kinds() {
    return {
        {"fluent-solid.msh", [] { return fluent_solid(FluentNumbers::text); }},
        {"fluent-solid-single.msh", [] { return fluent_solid(FluentNumbers::real32); }},
        {"fluent-solid-binary.msh", [] { return fluent_solid(FluentNumbers::real64); }},
    };
}

}  // namespace ring
