// The ring in Gmsh files of versions 2.2 and 4.1. Nodes are numbered 10, 12, 14, ...
// to show that numbers may have gaps.
#pragma once

#include "ring.hpp"

namespace ring {

inline int tag(int i, int j) { return 10 + 2 * point(i, j); }
const char gmsh_names[] =
    "$PhysicalNames\n3\n1 1 \"body\"\n1 2 \"far\"\n2 3 \"fluid, all of it\"\n$EndPhysicalNames\n";

inline Bytes gmsh_begin(const std::string& version, bool binary, bool swapped) {
    Bytes out{swapped};
    out.text = "$MeshFormat\n" + version + (binary ? " 1 8\n" : " 0 8\n");
    if (binary) out.put(std::int32_t{1});
    out.text += binary ? "\n$EndMeshFormat\n" : "$EndMeshFormat\n";
    out.text += gmsh_names;
    return out;
}

inline std::string gmsh_2(bool binary, bool swapped) {
    Bytes out = gmsh_begin("2.2", binary, swapped);
    out.text += "$Nodes\n168\n";
    for (int k = 0; k < int(x.size()); ++k) {
        if (binary) {
            out.put(std::int32_t{10 + 2 * k});
            for (const double value : {x[k], y[k], 0.}) out.put(value);
        } else {
            out.text += std::to_string(10 + 2 * k) + " " + print("%.16g", x[k]) + " " +
                        print("%.16g", y[k]) + " 0\n";
        }
    }
    out.text += (binary ? "\n$EndNodes\n$Elements\n" : "$EndNodes\n$Elements\n") +
                std::to_string(around * (outwards + 2)) + "\n";
    int number = 0;
    const auto element = [&](int type, int physical, const std::vector<int>& nodes) {
        const std::vector<int> head = binary ? std::vector<int>{type, 1, 2, ++number, physical, 7}
                                             : std::vector<int>{++number, type, 2, physical, 7};
        for (const int value : head)
            binary ? out.put(std::int32_t{value}) : void(out.text += std::to_string(value) + " ");
        for (const int value : nodes)
            binary ? out.put(std::int32_t{value}) : void(out.text += std::to_string(value) + " ");
        if (!binary) out.text.back() = '\n';
    };
    for (int i = 0; i < around; ++i) element(1, 1, {tag(i, 0), tag(i + 1, 0)});
    for (int i = 0; i < around; ++i) element(1, 2, {tag(i, outwards), tag(i + 1, outwards)});
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i)
            element(3, 3, {tag(i, j), tag(i + 1, j), tag(i + 1, j + 1), tag(i, j + 1)});
    }
    out.text += binary ? "\n$EndElements\n" : "$EndElements\n";
    return out.text + "$NodeData\n1\n\"anything\"\n1\n0\n$EndNodeData\n";
}

inline std::string gmsh_4(bool binary, bool swapped) {
    Bytes out = gmsh_begin("4.1", binary, swapped);
    const auto size = [&](std::uint64_t value) {
        binary ? out.put(value) : void(out.text += std::to_string(value) + " ");
    };
    const auto whole = [&](std::int32_t value) {
        binary ? out.put(value) : void(out.text += std::to_string(value) + " ");
    };
    const auto real = [&](double value) {
        binary ? out.put(value) : void(out.text += print("%.16g", value) + " ");
    };
    const auto line = [&] {
        if (!binary) out.text.back() = '\n';
    };
    const auto end = [&](const char* text) { out.text += std::string(binary ? "\n" : "") + text; };
    out.text += "$Entities\n";
    for (const int n : {0, 2, 1, 0}) size(std::uint64_t(n));
    line();
    for (int curve = 4; curve <= 5; ++curve) {
        whole(curve);
        for (int k = 0; k < 6; ++k) real(k < 3 ? -4 : 4);
        size(1);
        whole(curve == 4 ? 1 : 2);
        size(0);
        line();
    }
    whole(6);
    for (int k = 0; k < 6; ++k) real(k < 3 ? -4 : 4);
    size(1);
    whole(3);
    size(2);
    whole(4);
    whole(-5);
    line();
    end("$EndEntities\n$Nodes\n");
    for (const int n : {2, 168, 10, 10 + 2 * 167}) size(std::uint64_t(n));
    line();
    for (int block = 0; block < 2; ++block) {  // the first has parameters, which stay
        const int first = block == 0 ? 0 : around, last = block == 0 ? around : int(x.size());
        whole(block == 0 ? 1 : 2);
        whole(block == 0 ? 4 : 6);
        whole(block == 0 ? 1 : 0);
        size(std::uint64_t(last - first));
        line();
        for (int k = first; k < last; ++k) {
            size(std::uint64_t(10 + 2 * k));
            line();
        }
        for (int k = first; k < last; ++k) {
            real(x[k]);
            real(y[k]);
            real(0);
            if (block == 0) real(.125 * k);
            line();
        }
    }
    end("$EndNodes\n$Elements\n");
    for (const int n : {3, around * (outwards + 2), 1, around * (outwards + 2)})
        size(std::uint64_t(n));
    line();
    int number = 0;
    for (int curve = 0; curve < 2; ++curve) {
        for (const int value : {1, 4 + curve, 1}) whole(value);
        size(around);
        line();
        for (int i = 0; i < around; ++i) {
            const int j = curve == 0 ? 0 : outwards;
            for (const int value : {++number, tag(i, j), tag(i + 1, j)}) size(std::uint64_t(value));
            line();
        }
    }
    for (const int value : {2, 6, 3}) whole(value);
    size(around * outwards);
    line();
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            for (const int value :
                 {++number, tag(i, j), tag(i + 1, j), tag(i + 1, j + 1), tag(i, j + 1)}) {
                size(std::uint64_t(value));
            }
            line();
        }
    }
    end("$EndElements\n");
    return out.text;
}

// Quads of eight nodes; the middle of an edge is off the straight edge by (.01, .02) times its
// length and its normal.
inline std::string gmsh_quadratic() {
    std::ostringstream nodes, elements;
    std::map<std::pair<int, int>, int> middles;
    int n_nodes = 0, n_elements = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        nodes << ++n_nodes << " " << print("%.16g", x[k]) << " " << print("%.16g", y[k]) << " 0\n";
    }
    const auto middle = [&](int a, int b) {
        const auto found = middles.find({std::min(a, b), std::max(a, b)});
        if (found != middles.end()) return found->second;
        const std::size_t p = std::size_t(std::min(a, b)), q = std::size_t(std::max(a, b));
        const double dx = x[q] - x[p], dy = y[q] - y[p];
        nodes << ++n_nodes << " " << print("%.16g", (x[p] + x[q]) / 2 + .01 * dx - .02 * dy) << " "
              << print("%.16g", (y[p] + y[q]) / 2 + .01 * dy + .02 * dx) << " 0\n";
        return middles[{std::min(a, b), std::max(a, b)}] = n_nodes;
    };
    for (int marker = 0; marker < 2; ++marker) {
        for (int i = 0; i < around; ++i) {
            const int a = point(i, marker * outwards), b = point(i + 1, marker * outwards);
            elements << ++n_elements << " 8 2 " << marker + 1 << " 1 " << a + 1 << " " << b + 1
                     << " " << middle(a, b) << "\n";
        }
    }
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            const int c[] = {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
            elements << ++n_elements << " 16 2 3 1";
            for (const int corner : c) elements << " " << corner + 1;
            for (int k = 0; k < 4; ++k) elements << " " << middle(c[k], c[(k + 1) % 4]);
            elements << "\n";
        }
    }
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + std::string(gmsh_names) + "$Nodes\n" +
           std::to_string(n_nodes) + "\n" + nodes.str() + "$EndNodes\n$Elements\n" +
           std::to_string(n_elements) + "\n" + elements.str() + "$EndElements\n";
}

// Writes version 2 as Pointwise does, with comments first and names behind the elements.
inline std::string gmsh_with_comments() {
    std::string text = gmsh_2(false, false);
    text.erase(text.find(gmsh_names), std::string(gmsh_names).size());
    text.replace(text.find("2.2 0 8"), 7, "2.0 0 8");
    return "$Comments\nwritten by a test, $ and all\n$EndComments\n" + text + gmsh_names;
}

// Hexahedra between z = 0 and z = .5, as gmshToFoam takes them.
inline std::string gmsh_thick(bool binary) {
    Bytes out = gmsh_begin("2.2", binary, false);
    out.text.erase(out.text.find(gmsh_names));
    out.text +=
        "$PhysicalNames\n4\n2 1 \"body\"\n2 2 \"far\"\n2 4 \"frontAndBack\"\n3 3 "
        "\"fluid\"\n$EndPhysicalNames\n";
    const int layer = int(x.size());
    out.text += "$Nodes\n" + std::to_string(2 * layer) + "\n";
    for (int k = 0; k < 2 * layer; ++k) {
        const double at[3] = {x[std::size_t(k % layer)], y[std::size_t(k % layer)],
                              .5 * (k / layer)};
        if (binary) {
            out.put(std::int32_t{k + 1});
            for (const double value : at) out.put(value);
        } else {
            out.text += std::to_string(k + 1) + " " + print("%.16g", at[0]) + " " +
                        print("%.16g", at[1]) + " " + print("%.16g", at[2]) + "\n";
        }
    }
    const int n_cells = around * outwards;
    out.text += (binary ? "\n$EndNodes\n$Elements\n" : "$EndNodes\n$Elements\n") +
                std::to_string(3 * n_cells + 2 * around) + "\n";
    int number = 0;
    const auto element = [&](int type, int physical, const std::vector<int>& nodes) {
        const std::vector<int> head = binary ? std::vector<int>{type, 1, 2, ++number, physical, 7}
                                             : std::vector<int>{++number, type, 2, physical, 7};
        for (const int value : head)
            binary ? out.put(std::int32_t{value}) : void(out.text += std::to_string(value) + " ");
        for (const int value : nodes)
            binary ? out.put(std::int32_t{value + 1})
                   : void(out.text += std::to_string(value + 1) + " ");
        if (!binary) out.text.back() = '\n';
    };
    for (const int j : {0, outwards}) {
        for (int i = 0; i < around; ++i) {
            const int a = point(i, j), b = point(i + 1, j);
            element(3, j == 0 ? 1 : 2, {a, b, b + layer, a + layer});
        }
    }
    for (int cell = 0; cell < n_cells; ++cell) {
        const int i = cell % around, j = cell / around;
        const int c[4] = {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
        element(3, 4, {c[0], c[3], c[2], c[1]});
        element(3, 4, {c[0] + layer, c[1] + layer, c[2] + layer, c[3] + layer});
        element(5, 3,
                {c[0], c[1], c[2], c[3], c[0] + layer, c[1] + layer, c[2] + layer, c[3] + layer});
    }
    return out.text + (binary ? "\n$EndElements\n" : "$EndElements\n");
}

inline Kinds gmsh_kinds() {
    return {
        {"comments-2.msh", gmsh_with_comments},
        {"thick-2.msh", [] { return gmsh_thick(false); }},
        {"thick-binary-2.msh", [] { return gmsh_thick(true); }},
        {"text-2.msh", [] { return gmsh_2(false, false); }},
        {"binary-2.msh", [] { return gmsh_2(true, false); }},
        {"swapped-2.msh", [] { return gmsh_2(true, true); }},
        {"text-4.msh", [] { return gmsh_4(false, false); }},
        {"binary-4.msh", [] { return gmsh_4(true, false); }},
        {"swapped-4.msh", [] { return gmsh_4(true, true); }},
        {"quadratic.msh", gmsh_quadratic},
    };
}

}  // namespace ring
