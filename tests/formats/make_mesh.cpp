// Writes one and the same ring of quads in many kinds of files, independently of the program: what the program makes of
// a file and other coordinates must be, byte for byte, what is written here with those coordinates.
//
//   make_mesh KIND FILE [COORDINATES]   COORDINATES: an SU2 file of the ring, from where x and y are taken
//   make_mesh list                      all kinds
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr int around = 24, outwards = 6; // cells
std::vector<double> x, y;                // point (i, j) is number j * around + i

int point(int i, int j) { return j * around + i % around; }

void make_coordinates() {
    const double pi = std::acos(-1.0);
    for (int j = 0; j <= outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            const double r = std::pow(4.0, double(j) / outwards), angle = 2 * pi * (i + .25) / around;
            x.push_back(r * std::cos(angle));
            y.push_back(r * std::sin(angle));
        }
    }
}

void read_coordinates(const char* path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line) && line.compare(0, 6, "NPOIN=") != 0) {}
    for (int k = 0; k < around * (outwards + 1) && std::getline(file, line); ++k) {
        std::istringstream words(line);
        double a = 0, b = 0;
        words >> a >> b;
        x.push_back(a);
        y.push_back(b);
    }
    if (x.size() != std::size_t(around * (outwards + 1))) std::exit(2);
    if (std::string(path).find("two-") == std::string::npos) return;
    // Points of a mesh of two blocks: those of the first, then those that the second has besides.
    const std::vector<double> from_x = x, from_y = y;
    const int half = around / 2;
    for (int j = 0; j <= outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            const int second = (outwards + 1) * (half + 1) + j * (half - 1) + i - half - 1;
            const int from = i <= half ? j * (half + 1) + i : second;
            x[std::size_t(point(i, j))] = from_x[std::size_t(from)];
            y[std::size_t(point(i, j))] = from_y[std::size_t(from)];
        }
    }
}

std::string print(const char* format, double value) {
    if (std::string(format) == "Fortran") { // D17.9: 0.123456789D+01
        int exponent = 0;
        double mantissa = value;
        for (; std::fabs(mantissa) >= 1; ++exponent) mantissa /= 10;
        for (; mantissa != 0 && std::fabs(mantissa) < .1; --exponent) mantissa *= 10;
        char text[64];
        std::snprintf(text, sizeof text, "%.9fD%+03d", mantissa, exponent);
        return text;
    }
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// ---- SU2 ----

std::string su2_cells(const char* blank) {
    std::ostringstream out;
    out << "NELEM= " << around * outwards << "\n";
    for (int j = 0, n = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i, ++n) {
            out << 9 << blank << point(i, j) << blank << point(i + 1, j) << blank << point(i + 1, j + 1) << blank
                << point(i, j + 1) << blank << n << "\n";
        }
    }
    return out.str();
}
std::string su2_points(const char* format, const char* blank, const char* behind, const char* counts) {
    std::ostringstream out;
    out << "NPOIN= " << counts << "\n";
    for (std::size_t k = 0; k < x.size(); ++k)
        out << print(format, x[k]) << blank << print(format, y[k]) << behind << "\n";
    return out.str();
}
std::string su2_marker(const char* tag, int j) {
    std::ostringstream out;
    out << "MARKER_TAG= " << tag << "\nMARKER_ELEMS= " << around << "\n";
    for (int i = 0; i < around; ++i) out << "3 " << point(i, j) << " " << point(i + 1, j) << "\n";
    return out.str();
}
std::string su2_zone(const char* format = "%.17g") {
    return "NDIME= 2\n" + su2_cells(" ") + su2_points(format, " ", "", "168") + "NMARK= 2\n" + su2_marker("body", 0) +
           su2_marker("far", outwards);
}
std::string su2_odd() {
    std::string text = "% a comment = here\nNDIME=2\n" + su2_points("%.13E", "\t ", " 0 17 % z", "168 150") +
                       "\nNMARK = 4\n" + su2_marker("body", 0) + su2_marker("inside line", 2) +
                       su2_marker("17", outwards) +
                       "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_TO= 1\n1 0 0\n1 5 0\n"
                       "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nRECEIVE_FROM= 1\n1 0 0\n" +
                       su2_cells("\t") + "FFD_NBOX= 1\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n";
    std::string returns;
    for (const char c : text) returns += c == '\n' ? "\r\n" : std::string(1, c);
    return returns;
}
std::string su2_zones() {
    const std::string other =
        "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1.0 0\n0 1\nNMARK= 1\nMARKER_TAG= b\nMARKER_ELEMS= 3\n"
        "3 0 1\n3 1 2\n3 2 0\n";
    return "NZONE= 3\nIZONE= 1\n" + other + "IZONE= 2\n" + su2_zone() + "IZONE= 3\n" + other;
}

// ---- Binary numbers ----

struct Bytes {
    bool swapped = false;
    std::string text = {};
    template <class Number> void put(Number value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (std::size_t i = 0; i < sizeof value; ++i) text += bytes[swapped ? sizeof value - 1 - i : i];
    }
};

// ---- Gmsh: nodes are numbered 10, 12, 14, ... to show that any numbers will do ----

int tag(int i, int j) { return 10 + 2 * point(i, j); }
const char gmsh_names[] = "$PhysicalNames\n3\n1 1 \"body\"\n1 2 \"far\"\n2 3 \"fluid, all of it\"\n$EndPhysicalNames\n";

std::string gmsh_2(bool binary, bool swapped) {
    Bytes out{swapped};
    out.text = binary ? "$MeshFormat\n2.2 1 8\n" : "$MeshFormat\n2.2 0 8\n";
    if (binary) out.put(std::int32_t{1});
    out.text += binary ? "\n$EndMeshFormat\n" : "$EndMeshFormat\n";
    out.text += gmsh_names;
    out.text += "$Nodes\n168\n";
    for (int k = 0; k < int(x.size()); ++k) {
        if (binary) {
            out.put(std::int32_t{10 + 2 * k});
            for (const double value : {x[k], y[k], 0.}) out.put(value);
        } else {
            out.text += std::to_string(10 + 2 * k) + " " + print("%.16g", x[k]) + " " + print("%.16g", y[k]) + " 0\n";
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
        for (int i = 0; i < around; ++i) element(3, 3, {tag(i, j), tag(i + 1, j), tag(i + 1, j + 1), tag(i, j + 1)});
    }
    out.text += binary ? "\n$EndElements\n" : "$EndElements\n";
    return out.text + "$NodeData\n1\n\"anything\"\n1\n0\n$EndNodeData\n";
}

std::string gmsh_4(bool binary, bool swapped) {
    Bytes out{swapped};
    out.text = binary ? "$MeshFormat\n4.1 1 8\n" : "$MeshFormat\n4.1 0 8\n";
    if (binary) out.put(std::int32_t{1});
    out.text += binary ? "\n$EndMeshFormat\n" : "$EndMeshFormat\n";
    out.text += gmsh_names;
    const auto size = [&](std::uint64_t value) {
        binary ? out.put(value) : void(out.text += std::to_string(value) + " ");
    };
    const auto whole = [&](std::int32_t value) {
        binary ? out.put(value) : void(out.text += std::to_string(value) + " ");
    };
    const auto real = [&](double value) { binary ? out.put(value) : void(out.text += print("%.16g", value) + " "); };
    const auto line = [&] { if (!binary) out.text.back() = '\n'; };
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
    for (int block = 0; block < 2; ++block) { // the first has parameters, which stay
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
    for (const int n : {3, around * (outwards + 2), 1, around * (outwards + 2)}) size(std::uint64_t(n));
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
            for (const int value : {++number, tag(i, j), tag(i + 1, j), tag(i + 1, j + 1), tag(i, j + 1)}) {
                size(std::uint64_t(value));
            }
            line();
        }
    }
    end("$EndElements\n");
    return out.text;
}

// Quads of eight nodes; the middle of an edge is off the straight edge by (.01, .02) times its length and its normal.
std::string gmsh_quadratic() {
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
            elements << ++n_elements << " 8 2 " << marker + 1 << " 1 " << a + 1 << " " << b + 1 << " " << middle(a, b)
                     << "\n";
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
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + std::string(gmsh_names) + "$Nodes\n" + std::to_string(n_nodes) +
           "\n" + nodes.str() + "$EndNodes\n$Elements\n" + std::to_string(n_elements) + "\n" + elements.str() +
           "$EndElements\n";
}

// ---- PLOT3D ----

struct Plot3d {
    bool has_count, iblank, text;
    int record, real;    // bytes
    bool swapped;
    char across;         // '-': two dimensions; 'j', 'k': the index across, planes y = constant and z = constant
    int blocks;          // 1 or 2
};

std::string plot3d(const Plot3d& as) {
    Bytes out{as.swapped};
    const auto whole = [&](int value) {
        if (as.text) out.text += " " + std::to_string(value); else out.put(std::int32_t{value});
    };
    int in_line = 0;
    const auto real = [&](double value) {
        if (as.text) out.text += print(" %.15E", value) + (++in_line % 4 == 0 ? "\n" : "");
        else if (as.real == 8) out.put(value);
        else out.put(static_cast<float>(value));
    };
    const auto record = [&](int bytes, const std::function<void()>& content) {
        const auto length = [&] {
            if (as.record == 4) out.put(std::int32_t{bytes});
            if (as.record == 8) out.put(std::int64_t{bytes});
        };
        length();
        content();
        length();
        if (as.text) out.text += "\n";
    };
    const int ni = around / as.blocks + 1, nj = outwards + 1, dimensions = as.across == '-' ? 2 : 3;
    const int layers = as.across == '-' ? 1 : 2;
    const int middle = as.across == 'j' ? 2 : nj, last = as.across == 'j' ? nj : layers;
    if (as.has_count) record(4, [&] { whole(as.blocks); });
    record(4 * dimensions * as.blocks, [&] {
        for (int block = 0; block < as.blocks; ++block) {
            whole(ni);
            whole(middle);
            if (dimensions == 3) whole(last);
        }
    });
    const int points = ni * nj * layers;
    for (int block = 0; block < as.blocks; ++block) {
        const auto each = [&](const std::function<void(int, int)>& visit) { // point, layer
            for (int k = 0; k < last; ++k) {
                for (int j = 0; j < middle; ++j) {
                    for (int i = 0; i < ni; ++i) {
                        visit(point(i + block * (ni - 1), as.across == 'j' ? k : j), as.across == 'j' ? j : k);
                    }
                }
            }
        };
        record(points * (dimensions * as.real + (as.iblank ? 4 : 0)), [&] {
            each([&](int p, int) { real(x[std::size_t(p)]); });
            if (as.across == 'j') each([&](int, int layer) { real(-.5 * layer); });
            each([&](int p, int) { real(y[std::size_t(p)]); });
            if (as.across == 'k') each([&](int, int layer) { real(-.5 * layer); });
            if (as.iblank) each([&](int, int) { whole(1); });
        });
    }
    return out.text;
}

// ---- UGRID: planes y = 0 and y = 1; point p of the ring is 2 p + 2 in the first and 2 p + 1 in the second ----

std::string ugrid(bool text, bool swapped, int real_bytes, bool split) {
    Bytes out{swapped};
    const auto whole = [&](int value) {
        text ? void(out.text += std::to_string(value) + " ") : out.put(std::int32_t{value});
    };
    const auto real = [&](double value) {
        if (text) out.text += print("%.16e ", value);
        else if (real_bytes == 8) out.put(value);
        else out.put(static_cast<float>(value));
    };
    const auto line = [&] { if (text) out.text.back() = '\n'; };
    const auto item = [&](const std::vector<int>& points) {
        for (const int value : points) whole(value);
        line();
    };
    const auto low = [](int i, int j) { return 2 * point(i, j) + 2; };
    const auto high = [](int i, int j) { return 2 * point(i, j) + 1; };
    const int n = around * outwards;
    item({2 * int(x.size()), split ? 4 * n : 0, 2 * around + (split ? 0 : 2 * n), 0, 0, split ? 2 * n : 0,
          split ? 0 : n});
    for (std::size_t p = 0; p < x.size(); ++p) {
        for (const double layer : {1., 0.}) {
            real(x[p]);
            real(layer);
            real(y[p]);
            line();
        }
    }
    const auto each_cell = [&](const std::function<void(int, int)>& visit) {
        for (int j = 0; j < outwards; ++j) {
            for (int i = 0; i < around; ++i) visit(i, j);
        }
    };
    using Place = std::function<int(int, int)>;
    if (split) {
        for (const Place& at : {Place(low), Place(high)}) {
            each_cell([&](int i, int j) {
                item({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                item({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            });
        }
    }
    for (const int j : {0, outwards}) {
        for (int i = 0; i < around; ++i) item({low(i, j), high(i, j), high(i + 1, j), low(i + 1, j)});
    }
    if (!split) {
        for (const Place& at : {Place(low), Place(high)}) {
            each_cell([&](int i, int j) { item({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}); });
        }
    }
    const auto tags = [&](int count, int tag) { for (int k = 0; k < count; ++k) { whole(tag); line(); } };
    if (split) tags(2 * n, 3);
    if (split) tags(2 * n, 4);
    tags(around, 1);
    tags(around, 2);
    if (!split) tags(n, 3);
    if (!split) tags(n, 4);
    each_cell([&](int i, int j) {
        if (split) {
            item({low(i, j), low(i + 1, j), low(i + 1, j + 1), high(i, j), high(i + 1, j), high(i + 1, j + 1)});
            item({high(i, j), high(i + 1, j + 1), high(i, j + 1), low(i, j), low(i + 1, j + 1), low(i, j + 1)});
        } else if (i % 3 == 0) { // a side of the plane at the bottom, in front, at the left
            item({low(i, j), low(i + 1, j), low(i + 1, j + 1), low(i, j + 1), high(i, j), high(i + 1, j),
                  high(i + 1, j + 1), high(i, j + 1)});
        } else if (i % 3 == 1) {
            item({high(i, j), high(i + 1, j), low(i + 1, j), low(i, j), high(i, j + 1), high(i + 1, j + 1),
                  low(i + 1, j + 1), low(i, j + 1)});
        } else {
            item({low(i, j), high(i, j), high(i + 1, j), low(i + 1, j), low(i, j + 1), high(i, j + 1),
                  high(i + 1, j + 1), low(i + 1, j + 1)});
        }
    });
    return out.text;
}

// ---- VTK: its binary numbers are big-endian ----

std::string vtk(bool text, const char* real_type, bool new_cells) {
    Bytes out{true};
    out.text = std::string("# vtk DataFile Version ") + (new_cells ? "5.1" : "3.0") + "\n\n" +
               (text ? "ASCII" : "BINARY") + "\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n";
    const auto whole = [&](int value, bool eight) {
        if (text) out.text += std::to_string(value) + " ";
        else if (eight) out.put(std::int64_t{value});
        else out.put(std::int32_t{value});
    };
    const auto real = [&](double value) {
        if (text) out.text += print("%.10g ", value);
        else if (std::string(real_type) == "double") out.put(value);
        else out.put(static_cast<float>(value));
    };
    real(.25);
    out.text += "\nPOINTS 168 " + std::string(real_type) + "\n";
    for (std::size_t p = 0; p < x.size(); ++p) {
        for (const double value : {x[p], y[p], 0.}) real(value);
        if (p % 3 == 2 && text) out.text += "\n";
    }
    const int n = around * outwards, lines = new_cells ? 0 : 1; // a line among the cells is passed over
    if (new_cells) out.text += "\nMETADATA\nINFORMATION 0\n";
    out.text += "\nCELLS " + std::to_string(n + 1) + " " + std::to_string((new_cells ? 4 : 5) * n + 3 * lines) + "\n";
    if (new_cells) {
        out.text += "OFFSETS vtktypeint64\n";
        for (int cell = 0; cell <= n; ++cell) whole(4 * cell, true);
        out.text += "\nCONNECTIVITY vtktypeint64\n";
    } else {
        for (const int value : {2, 0, 1}) whole(value, false);
    }
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            if (!new_cells) whole(4, false);
            for (const int p : {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)})
                whole(p, new_cells);
        }
    }
    out.text += "\nCELL_TYPES " + std::to_string(n + lines) + "\n";
    if (lines == 1) whole(3, false);
    for (int cell = 0; cell < n; ++cell) whole(9, false);
    return out.text + "\nCELL_DATA 1\nanything\n";
}

// ---- VTK XML ----

// header_bytes: of the length before each array, 0: all is text.
std::string vtu(int header_bytes, bool swapped, bool is_single) {
    std::string arrays;
    Bytes appended{swapped};
    std::size_t after_mark = 0;
    const auto array = [&](const char* type, const char* attributes, int count, int bytes,
                           const std::function<void(int, Bytes&)>& put, const std::function<std::string(int)>& text) {
        arrays += std::string("<DataArray type=\"") + type + "\" " + attributes;
        if (header_bytes == 0) {
            arrays += " format=\"ascii\">";
            for (int k = 0; k < count; ++k) arrays += (k > 0 ? " " : "") + text(k);
            arrays += "</DataArray>\n";
            return;
        }
        arrays += " format='appended'  offset=\"" + std::to_string(after_mark) + "\"/>\n";
        const int length = count * bytes;
        header_bytes == 8 ? appended.put(std::uint64_t(length)) : appended.put(std::uint32_t(length));
        for (int k = 0; k < count; ++k) put(k, appended);
        after_mark = appended.text.size();
    };
    const auto wholes = [&](const char* type, const char* attributes, int count, int bytes,
                            const std::function<int(int)>& value) {
        array(type, attributes, count, bytes, [&](int k, Bytes& out) {
            if (bytes == 8) out.put(std::int64_t{value(k)});
            else if (bytes == 4) out.put(std::int32_t{value(k)});
            else out.put(std::uint8_t(value(k)));
        }, [&](int k) { return std::to_string(value(k)); });
    };
    const auto coordinate = [](int k) {
        const auto p = std::size_t(k / 3);
        return k % 3 == 0 ? x[p] : k % 3 == 1 ? y[p] : 0;
    };
    const int n = around * outwards, size = header_bytes == 8 ? 8 : 4;
    const char* const type = size == 8 ? "Int64" : "Int32";
    arrays += "<PointData>\n"; // an array of the same name elsewhere
    wholes("UInt8", "Name=\"types\"", 168, 1, [](int) { return 60; }); // the character <
    arrays += "</PointData>\n<Points>\n";
    array(is_single ? "Float32" : "Float64", "Name=\"xyz\" NumberOfComponents=\"3\"", 3 * 168, is_single ? 4 : 8,
          [&](int k, Bytes& out) { is_single ? out.put(float(coordinate(k))) : out.put(coordinate(k)); },
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
    text += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"168\" NumberOfCells=\"" + std::to_string(n) + "\">\n";
    text += arrays + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (header_bytes > 0) text += "<AppendedData encoding=\"raw\">\n _" + appended.text + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
}

// ---- Fluent: faces with the cells beside them, numbers in hexadecimal, ends of lines CR LF ----

std::string hexadecimal(int value) {
    char text[16];
    std::snprintf(text, sizeof text, "%x", static_cast<unsigned>(value));
    return text;
}

// Tight: no blanks and ends of lines but those that separate numbers; the nodes in two sections, the second first; no
// names of zones.
std::string fluent(bool tight) {
    const std::string line = tight ? "" : "\r\n", n_faces = hexadecimal(around * (2 * outwards + 1));
    const int n = around * outwards;
    const auto head = [](std::initializer_list<int> values) {
        std::string text = "(";
        for (const int value : values) text += (text.size() > 1 ? " " : "") + hexadecimal(value);
        return text + ")";
    };
    std::string out = "(0 \"a comment (with one bracket\")\r\n(2 2)\r\n";
    if (!tight) {
        out += "(10 (0 1 a8 0 2))\r\n(12 (0 1 " + hexadecimal(n) + " 0))\r\n(13 (0 1 " + n_faces + " 0))\r\n";
    }
    const auto nodes = [&](int first, int last) { // from 0, without the last
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
    const auto cell = [&](int i, int j) { return j < 0 || j >= outwards ? 0 : j * around + (i + around) % around + 1; };
    int face = 0;
    // A face goes from a to b; the cell on its right is the first. `mixed`: the number of points before each face.
    using Face = std::function<void(int, int, int, int)>; // a, b, right cell, left cell
    const auto faces = [&](int zone, int type, bool mixed, const std::function<void(const Face&)>& each) {
        std::string body;
        int count = 0;
        each([&](int a, int b, int right, int left) {
            if (count > 0 || !tight) body += "\r\n";
            body += mixed ? "2 " : "";
            body += hexadecimal(a + 1) + " " + hexadecimal(b + 1) + " " + hexadecimal(right) + " " + hexadecimal(left);
            ++count;
        });
        out += "(13 " + head({zone, face + 1, face + count, type, mixed ? 0 : 2}) + "(" + body + line + "))\r\n";
        face += count;
    };
    faces(3, 2, false, [&](const auto& face_of) { // between cells
        for (int j = 1; j < outwards; ++j) {
            for (int i = 0; i < around; ++i) face_of(point(i + 1, j), point(i, j), cell(i, j), cell(i, j - 1));
        }
        for (int j = 0; j < outwards; ++j) {
            for (int i = 0; i < around; ++i) face_of(point(i, j), point(i, j + 1), cell(i, j), cell(i - 1, j));
        }
    });
    faces(16, 3, true, [&](const auto& face_of) {
        for (int i = 0; i < around; ++i) face_of(point(i + 1, 0), point(i, 0), cell(i, 0), 0);
    });
    faces(4, 9, false, [&](const auto& face_of) {
        for (int i = 0; i < around; ++i) face_of(point(i, outwards), point(i + 1, outwards), cell(i, outwards - 1), 0);
    });
    if (tight) return out;
    return out + "(45 (2 fluid air)())\r\n(45 (3 interior int_air)())\r\n(39 (16 wall body 1)())\r\n"
                 "(45 (4 pressure-far-field far)(\r\n(gauge-pressure . 0) (text . \")\")))\r\n(64 (anything ()))\r\n";
}

const std::map<std::string, std::function<std::string()>>& kinds() {
    static const std::map<std::string, std::function<std::string()>> all = {
        {"plain.su2", [] { return su2_zone(); }},
        {"fixed.su2", [] { return su2_zone("%.8f"); }},
        {"leading-zero.su2", [] { return su2_zone("Fortran"); }},
        {"odd.su2", su2_odd},
        {"zones.su2", su2_zones},
        {"text-2.msh", [] { return gmsh_2(false, false); }},
        {"binary-2.msh", [] { return gmsh_2(true, false); }},
        {"swapped-2.msh", [] { return gmsh_2(true, true); }},
        {"text-4.msh", [] { return gmsh_4(false, false); }},
        {"binary-4.msh", [] { return gmsh_4(true, false); }},
        {"swapped-4.msh", [] { return gmsh_4(true, true); }},
        {"quadratic.msh", gmsh_quadratic},
        {"text.p3d", [] { return plot3d({false, false, true, 0, 8, false, '-', 1}); }},
        {"two-text-iblank.p3d", [] { return plot3d({true, true, true, 0, 8, false, '-', 2}); }},
        {"text-k.p3d", [] { return plot3d({true, false, true, 0, 8, false, 'k', 1}); }},
        {"stream.p3d", [] { return plot3d({true, false, false, 0, 8, false, '-', 1}); }},
        {"stream-single.p3d", [] { return plot3d({false, true, false, 0, 4, true, 'j', 1}); }},
        {"two-stream-swapped.p3d", [] { return plot3d({true, true, false, 0, 8, true, 'k', 2}); }},
        {"two-fortran.p3d", [] { return plot3d({true, false, false, 4, 8, false, 'j', 2}); }},
        {"fortran-swapped.p3d", [] { return plot3d({false, true, false, 4, 8, true, '-', 1}); }},
        {"fortran-8.p3d", [] { return plot3d({true, true, false, 8, 8, false, 'k', 1}); }},
        {"two-fortran-8-single.p3d", [] { return plot3d({true, false, false, 8, 4, true, '-', 2}); }},
        {"text.vtk", [] { return vtk(true, "float", false); }},
        {"text-5.vtk", [] { return vtk(true, "double", true); }},
        {"binary.vtk", [] { return vtk(false, "double", true); }},
        {"binary-single.vtk", [] { return vtk(false, "float", false); }},
        {"text.vtu", [] { return vtu(0, false, false); }},
        {"appended-32.vtu", [] { return vtu(4, false, false); }},
        {"appended-64.vtu", [] { return vtu(8, false, false); }},
        {"appended-single.vtu", [] { return vtu(4, false, true); }},
        {"appended-swapped.vtu", [] { return vtu(8, true, false); }},
        {"fluent.msh", [] { return fluent(false); }},
        {"fluent-tight.msh", [] { return fluent(true); }},
        {"text.ugrid", [] { return ugrid(true, false, 8, false); }},
        {"prisms.lb8.ugrid", [] { return ugrid(false, false, 8, true); }},
        {"hexahedra.b8.ugrid", [] { return ugrid(false, true, 8, false); }},
        {"single.lb4.ugrid", [] { return ugrid(false, false, 4, false); }},
    };
    return all;
}

} // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "list") {
        for (const auto& kind : kinds()) std::cout << kind.first << "\n";
        return 0;
    }
    if (argc < 3 || kinds().count(argv[1]) == 0) return 2;
    if (argc > 3) read_coordinates(argv[3]); else make_coordinates();
    std::ofstream(argv[2], std::ios::binary) << kinds().at(argv[1])();
    return 0;
}
