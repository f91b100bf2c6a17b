// Writes a ring of quads, one cell thick, as an OpenFOAM case, independently of the program.
//
//   make_foam FOLDER STORAGE PLANE [COORDINATES]
//     STORAGE      text, binary-32, binary-64, binary-single: how numbers are stored; 32 and 64:
//     bits of labels PLANE        z, y: between coordinate planes; inclined; wedge: about the x
//     axis; polygons: z, with the cells of
//                  the innermost ring joined in pairs, which have six corners, and hanging nodes;
//                  interface: z, a rotor and a stator that meet on one circle with different points
//     COORDINATES  an SU2 file of the ring in the plane's coordinates, from where x and y are taken
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Vector = std::array<double, 3>;

constexpr int around = 24, outwards = 6, slides_at = 3;
int layer = 0;             // points of one plane
std::vector<double> x, y;  // point (i, j) is number j * around + i
std::string storage, plane;

int point(int i, int j) { return j * around + i % around; }
// The row of points below row j of cells: the circle of an interface has two rows.
bool slides() { return plane == "interface"; }
int below(int j) { return slides() && j >= slides_at ? j + 1 : j; }

// Cells that are joined have one number.
bool is_joined(int j) { return plane == "polygons" && j == 0; }
int cell_of(int i, int j) {
    const int missing = plane == "polygons" ? around / 2 : 0;
    return is_joined(j) ? i % around / 2 : j * around + i % around - missing;
}
int n_cells() { return cell_of(around - 1, outwards - 1) + 1; }

void make_coordinates() {
    const double pi = std::acos(-1.0);
    for (int row = 0; row <= outwards + (slides() ? 1 : 0); ++row) {
        const bool is_stator = slides() && row > slides_at;
        const int j = is_stator ? row - 1 : row;
        for (int i = 0; i < around; ++i) {
            const double r = std::pow(4.0, double(j) / outwards),
                         angle = 2 * pi * (i + (is_stator ? .6 : .25)) / around;
            x.push_back(r * std::cos(angle));
            y.push_back(r * std::sin(angle) + (plane == "wedge" ? 6 : 0));
        }
    }
}

void read_coordinates(const char* path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line) && line.compare(0, 6, "NPOIN=") != 0) {}
    for (int k = 0; k < layer && std::getline(file, line); ++k) {
        std::istringstream words(line);
        double a = 0, b = 0;
        words >> a >> b;
        x.push_back(a);
        y.push_back(b);
    }
    if (x.size() != std::size_t(layer)) std::exit(2);
}

Vector place(int k) {
    const double a = x[std::size_t(k % layer)], b = y[std::size_t(k % layer)], up = k / layer;
    if (plane == "z" || plane == "polygons" || slides()) return {a, b, .5 * up};
    if (plane == "y") return {a, -.5 * up, b};
    if (plane == "inclined") {  // turned about the y axis, which the library takes as its x
        const double c = std::cos(.5), s = std::sin(.5);
        return {-c * b + s * up, a, s * b + c * up};
    }
    const double turn = (up - .5) * 5 * std::acos(-1.0) / 180;
    return {a, b * std::cos(turn), b * std::sin(turn)};
}

Vector minus(Vector a, Vector b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(Vector a, Vector b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector middle(const std::vector<int>& points) {
    Vector sum = {0, 0, 0};
    for (const int k : points) {
        for (std::size_t d = 0; d < 3; ++d) sum[d] += place(k)[d] / double(points.size());
    }
    return sum;
}

std::vector<int> cell_points(int cell) {
    int i = 0, j = 0;
    while (cell_of(around - 1, j) < cell) ++j;
    while (cell_of(i, j) < cell) ++i;
    const int width = is_joined(j) ? 2 : 1;
    std::vector<int> out;
    for (const int up : {0, layer}) {
        for (int k = 0; k <= width; ++k) out.push_back(point(i + k, below(j)) + up);
        for (int k = width; k >= 0; --k) out.push_back(point(i + k, below(j) + 1) + up);
    }
    return out;
}

struct Face {
    std::vector<int> points;
    int owner, neighbour;
};

// The normal points out of the owner.
Face face(std::vector<int> points, int owner, int neighbour = -1) {
    Vector normal = {0, 0, 0};  // of all corners: one of them may be reflex
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        const Vector a = minus(place(points[k]), place(points[0])),
                     b = minus(place(points[k + 1]), place(points[0]));
        for (std::size_t d = 0; d < 3; ++d)
            normal[d] += a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
    }
    if (dot(normal, minus(middle(points), middle(cell_points(owner)))) < 0) {
        std::reverse(points.begin() + 1, points.end());
    }
    return {points, owner, neighbour};
}
std::vector<int> across(int a, int b) { return {a, b, b + layer, a + layer}; }

struct Out {
    std::ofstream file;

    Out(const std::string& folder, const std::string& name, const std::string& type)
        : file(folder + "/" + name, std::ios::binary) {
        const bool text = storage == "text";
        const std::string label = storage == "binary-64" ? "64" : "32",
                          scalar = storage == "binary-single" ? "32" : "64";
        file << "/*---- a test ----*\\\n\\*----*/\nFoamFile\n{\n    version     2.0;\n    format   "
                "   "
             << (text ? "ascii" : "binary") << ";\n    arch        \"LSB;label=" << label
             << ";scalar=" << scalar << "\";\n    class       " << type << ";\n    object      "
             << name << ";\n}\n// * * * //\n\n";
    }
    template <class Number>
    void raw(Number value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        file.write(bytes, sizeof value);
    }
    void labels(const std::vector<int>& values) {
        file << values.size() << "\n(" << (storage == "text" ? "\n" : "");
        for (const int value : values) {
            if (storage == "text") file << value << "\n";
            else if (storage == "binary-64") raw(std::int64_t{value});
            else raw(std::int32_t{value});
        }
        file << ")\n";
    }
};

void write(const std::string& folder) {
    std::filesystem::create_directories(folder + "/constant/polyMesh");
    const std::string mesh = folder + "/constant/polyMesh";
    std::vector<Face> faces;
    const auto add_inner = [&faces](int a, int b, int cell, int other) {
        if (cell != other)
            faces.push_back(face(across(a, b), std::min(cell, other), std::max(cell, other)));
    };
    for (int j = 0; j < outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            add_inner(point(i + 1, below(j)), point(i + 1, below(j) + 1), cell_of(i, j),
                      cell_of(i + 1, j));
            if (j + 1 < outwards && !(slides() && j + 1 == slides_at))
                add_inner(point(i, j + 1), point(i + 1, j + 1), cell_of(i, j), cell_of(i, j + 1));
        }
    }
    std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
    });
    const std::size_t n_inner = faces.size();
    for (int i = 0; i < around; ++i)
        faces.push_back(face(across(point(i, 0), point(i + 1, 0)), cell_of(i, 0)));
    const int last = below(outwards - 1) + 1;
    for (int i = 0; i < around; ++i)
        faces.push_back(face(across(point(i, last), point(i + 1, last)), cell_of(i, outwards - 1)));
    for (int side = 0; side < (slides() ? 2 : 0); ++side) {
        const int row = slides_at + side;
        for (int i = 0; i < around; ++i)
            faces.push_back(face(across(point(i, row), point(i + 1, row)), cell_of(i, row - 1)));
    }
    for (const int up : {0, 1}) {
        for (int cell = 0; cell < n_cells(); ++cell) {
            const std::vector<int> all = cell_points(cell);
            const auto half = static_cast<std::ptrdiff_t>(all.size() / 2);
            faces.push_back(face({all.begin() + up * half, all.begin() + (up + 1) * half}, cell));
        }
    }
    Out points(mesh, "points", "vectorField");
    points.file << 2 * layer << "\n(" << (storage == "text" ? "\n" : "");
    for (int k = 0; k < 2 * layer; ++k) {
        const Vector p = place(k);
        char text[128];
        std::snprintf(text, sizeof text, "(%.17g %.17g %.17g)\n", p[0], p[1], p[2]);
        if (storage == "text") points.file << text;
        for (const double value : p) {
            if (storage == "binary-single") points.raw(static_cast<float>(value));
            else if (storage != "text") points.raw(value);
        }
    }
    points.file << ")\n\n// * * * //\n";
    std::vector<int> owners, neighbours, start = {0}, corners;
    for (const Face& face : faces) {
        owners.push_back(face.owner);
        if (face.neighbour >= 0) neighbours.push_back(face.neighbour);
        corners.insert(corners.end(), face.points.begin(), face.points.end());
        start.push_back(int(corners.size()));
    }
    Out(mesh, "owner", "labelList").labels(owners);
    Out(mesh, "neighbour", "labelList").labels(neighbours);
    Out list(mesh, "faces", storage == "text" ? "faceList" : "faceCompactList");
    if (storage == "text") {
        list.file << faces.size() << "\n(\n";
        for (const Face& face : faces) {
            list.file << face.points.size() << "(";
            for (const int k : face.points)
                list.file << k << (k == face.points.back() ? ")\n" : " ");
        }
        list.file << ")\n";
    } else {
        list.labels(start);
        list.labels(corners);
    }
    Out boundary(mesh, "boundary", "polyBoundaryMesh");
    std::size_t first = n_inner;
    const auto patch = [&](const char* name, const char* type, int n,
                           const char* neighbour = nullptr) {
        boundary.file << "    " << name << "\n    {\n        type            " << type
                      << ";\n        inGroups        1(" << type << ");\n        nFaces          "
                      << n << ";\n        startFace       " << first << ";\n";
        if (neighbour != nullptr)
            boundary.file
                << "        matchTolerance  0.0001;\n        transform       noOrdering;\n"
                << "        neighbourPatch  " << neighbour << ";\n";
        boundary.file << "    }\n";
        first += std::size_t(n);
    };
    boundary.file << (plane == "wedge" ? 5 : slides() ? 6 : 4) << "\n(\n";
    patch("body", "wall", around);
    patch("far", "patch", around);
    if (slides()) {
        patch("AMI1", "cyclicAMI", around, "AMI2");
        patch("AMI2", "cyclicAMI", around, "AMI1");
    }
    if (plane == "wedge") {
        patch("front", "wedge", n_cells());
        patch("back", "wedge", n_cells());
        patch("axis", "empty", 0);
    } else {
        patch("frontAndBack", "empty", 2 * n_cells());
        patch("defaultFaces", "empty", 0);
    }
    boundary.file << ")\n";
    std::filesystem::create_directories(folder + "/system");
    const auto dictionary = [&folder](const std::string& name, const std::string& entries) {
        std::ofstream(folder + "/system/" + name)
            << "FoamFile { version 2.0; format ascii; class dictionary; object " << name << "; }\n"
            << entries;
    };
    dictionary(
        "controlDict",
        "application simpleFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1;\n"
        "deltaT 1; writeControl timeStep; writeInterval 1;\n");
    dictionary(
        "fvSchemes",
        "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {}\n"
        "snGradSchemes {}\n");
    dictionary("fvSolution", "");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) return 2;
    storage = argv[2];
    plane = argv[3];
    layer = around * (outwards + (slides() ? 2 : 1));
    if (argc > 4) read_coordinates(argv[4]);
    else make_coordinates();
    write(argv[1]);
    return 0;
}
