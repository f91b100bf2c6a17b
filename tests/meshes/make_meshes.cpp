// Writes the meshes of the demo, of the tests and of the paper's cases: `make meshes` runs this
// program. The bodies of the paper's cases are the curves of the files beside this one: the paper
// gives no coordinates, so these shapes are drawn after its description.
#include <fixtures/airfoil_meshes.hpp>
#include <fixtures/hybrid.hpp>
#include <fixtures/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace fixtures;

struct ClosedCurve {
    int degree = 0;
    std::vector<Point> control;

    // Reads a .curve file with uniform knots.
    explicit ClosedCurve(std::string const& path) {
        std::ifstream file(path);
        std::string word;
        std::size_t n = 0;
        while (file >> word && word != "points")
            if (word == "degree") file >> degree;
        file >> n;
        for (Point p{}; control.size() < n && file >> p.x >> p.y;) control.push_back(p);
    }

    // u = 0 .. number of control points, once round.
    Point at(double u) const {
        int const n = int(control.size()), span = int(u);
        std::vector<Point> line;  // de Boor's algorithm with the knots 0, 1, 2, ...
        for (int k = 0; k <= degree; ++k) line.push_back(control[std::size_t((span + k) % n)]);
        for (int level = 1; level <= degree; ++level)
            for (int k = degree; k >= level; --k) {
                double const t = (u - span + degree - k) / (degree - level + 1);
                Point const a = line[std::size_t(k - 1)];
                Point& b = line[std::size_t(k)];
                b = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
            }
        return line[std::size_t(degree)];
    }

    // n points at nearly equal distances along the curve, clockwise: a hole.
    std::vector<Point> hole(int n) const {
        double const end = double(control.size());
        constexpr int fine = 20000;
        std::vector<double> length{0};
        Point last = at(0);
        for (int k = 1; k <= fine; ++k) {
            Point const here = at(k == fine ? 0 : k * end / fine);
            length.push_back(length.back() + distance(last, here));
            last = here;
        }
        std::vector<Point> out;
        double area = 0;
        for (int k = 0, j = 0; k < n; ++k) {
            while (length[std::size_t(j)] < k * length.back() / n) ++j;
            out.push_back(at(j * end / fine));
        }
        for (std::size_t k = 0; k < out.size(); ++k)
            area += twice_area({0, 0}, out[k], out[(k + 1) % out.size()]);
        if (area > 0) std::reverse(out.begin(), out.end());
        return out;
    }
};

using Names = std::map<std::int32_t, std::string>;

// Writes coordinates with 17 significant digits, so that reading gives the same bits. Returns false
// if the file cannot be written.
bool write_su2(Mesh const& mesh, std::string const& path, Names const& names) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) return false;
    std::fprintf(file, "NDIME= 2\nNELEM= %d\n", int(mesh.n_cells()));
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        std::size_t const begin = std::size_t(mesh.cell_start[cell]);
        std::size_t const end = std::size_t(mesh.cell_start[cell + 1]);
        std::fprintf(file, end - begin == 3 ? "5" : "9");  // the VTK types
        for (std::size_t k = begin; k < end; ++k) std::fprintf(file, " %d", int(mesh.cells[k]));
        std::fprintf(file, "\n");
    }
    std::fprintf(file, "NPOIN= %d\n", int(mesh.n_points()));
    for (std::size_t k = 0; k < mesh.x.size(); ++k)
        std::fprintf(file, "%.17g %.17g\n", mesh.x[k], mesh.y[k]);
    std::map<std::int32_t, std::vector<std::size_t>> faces_of;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face)
        faces_of[mesh.face_markers[face]].push_back(face);
    std::fprintf(file, "NMARK= %d\n", int(faces_of.size()));
    for (auto const& entry : faces_of) {
        std::fprintf(file, "MARKER_TAG= %s\nMARKER_ELEMS= %zu\n", names.at(entry.first).c_str(),
                     entry.second.size());
        for (std::size_t const face : entry.second) {
            int const from = int(mesh.faces[2 * face]), to = int(mesh.faces[2 * face + 1]);
            std::fprintf(file, "3 %d %d\n", from, to);
        }
    }
    return std::fclose(file) == 0;
}

class Writer {
public:
    explicit Writer(std::string const& folder) : folder_(folder) {}
    void write(std::string const& name, Mesh const& mesh, Names const& names) {
        std::string const path = folder_ + "/" + name + ".su2";
        bool const is_sound = check(mesh).sound(), is_written = write_su2(mesh, path, names);
        if (!is_written) std::perror(path.c_str());
        if (!is_sound) std::fprintf(stderr, "%s is not a sound mesh\n", path.c_str());
        if (!is_written || !is_sound) ++failures;
    }
    int failures = 0;

private:
    std::string folder_;
};

// Chord 1, a sharp trailing edge, the far field 20 chords away.
Mesh naca0012() {
    // With these numbers the triangles just outside the layers are as high as the last quads.
    HybridOptions options;
    options.layers = 15;
    options.layer_growth = 1.22;
    options.ring_growth = 1.15;
    return hybrid_mesh(naca4({}, 66), options);
}

// The block of 0.2 x 0.04 in the unit square; its four sides have one marker.
Mesh block() {
    Mesh mesh = square(25, Cells::quads, 5, 1);
    for (std::int32_t& marker : mesh.face_markers) marker = marker == body ? body : far_field;
    return mesh;
}

// The paper's first case: two smooth closed bodies in a rectangle.
Mesh two_bodies(ClosedCurve const& left, ClosedCurve const& right) {
    Mesh mesh;
    std::vector<Ring> rings{add_rectangle(mesh, {0, 0}, {4, 2.4}, 25, 15, {1, 1, 1, 1})};
    rings.push_back(add_ring(mesh, left.hole(82), 2));
    rings.push_back(add_ring(mesh, right.hole(79), 3));
    triangulate(mesh, rings, 0.12);
    return mesh;
}

// The paper's second case: the section of a wind turbine's diffuser, flow from the left, axis below
// (outside the picture). Quads in layers round the airfoil, triangles elsewhere.
Mesh diffuser_airfoil(ClosedCurve const& airfoil) {
    Mesh mesh;
    std::vector<Point> points = airfoil.hole(84);
    std::vector<Ring> rings{add_rectangle(mesh, {-2.5, -2.2}, {4, 2.8}, 15, 12, {1, 1, 1, 1})};
    Ring below = add_ring(mesh, points, 2);
    double height = 0.006;
    for (int layer = 0; layer < 4; ++layer, height *= 1.3) {
        Ring above;
        std::size_t const n = below.size();
        for (std::size_t k = 0; k < n; ++k) {
            Point const a = points[(k + n - 1) % n], b = points[(k + 1) % n], p = points[k];
            double const share = height / distance(a, b);
            above.push_back(mesh.add_point({p.x - share * (b.y - a.y), p.y + share * (b.x - a.x)}));
        }
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t const next = (k + 1) % n;
            mesh.add_cell({below[k], below[next], above[next], above[k]});
            points[k] = mesh.point(above[k]);
        }
        below = above;
    }
    rings.push_back(below);
    triangulate(mesh, rings, 0.16);
    return mesh;
}

// The paper's first figure: an axisymmetric diffuser in the half plane above its axis.
Mesh axisymmetric_diffuser(ClosedCurve const& diffuser) {
    Mesh mesh;
    std::vector<Ring> rings{add_rectangle(mesh, {-1.8, 0}, {3.2, 2.6}, 42, 12, {1, 2, 2, 2})};
    rings.push_back(add_ring(mesh, diffuser.hole(88), 3));
    triangulate(mesh, rings, 0.14);
    return mesh;
}

// Harmonic coordinates: the inside of a polygon.
Mesh cage(ClosedCurve const& polygon) {
    Mesh mesh;
    std::vector<Point> points;
    std::size_t const n = polygon.control.size();
    for (std::size_t k = 0; k < n; ++k) {
        Point const a = polygon.control[k], b = polygon.control[(k + 1) % n];
        int const parts = int(std::ceil(distance(a, b) / 0.09));
        for (int j = 0; j < parts; ++j) {
            double const t = double(j) / parts;
            points.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    triangulate(mesh, {add_ring(mesh, points, 1)}, 0);
    return mesh;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_meshes FOLDER, which has the .curve files\n");
        return 2;
    }
    std::string const folder = argv[1];
    auto const curve = [&](char const* name) {
        return ClosedCurve(folder + "/" + name + ".curve");
    };
    Writer out(folder);
    out.write("block", block(), {{body, "block"}, {far_field, "outer"}});
    out.write("two_bodies", two_bodies(curve("two_bodies_left"), curve("two_bodies_right")),
              {{1, "rectangle"}, {2, "left"}, {3, "right"}});
    out.write("diffuser_airfoil", diffuser_airfoil(curve("diffuser_airfoil")),
              {{1, "far"}, {2, "airfoil"}});
    out.write("axisymmetric_diffuser", axisymmetric_diffuser(curve("axisymmetric_diffuser")),
              {{1, "axis"}, {2, "far"}, {3, "diffuser"}});
    out.write("cage", cage(curve("cage")), {{1, "cage"}});
    out.write("cascade", cascade_mesh(),
              {{1, "blade"}, {2, "lower"}, {3, "outlet"}, {4, "upper"}, {5, "inlet"}});
    out.write("three_element", three_element_mesh(),
              {{1, "slat"}, {2, "main"}, {3, "flap"}, {4, "far"}});
    // The build waits for this file, so it comes last.
    out.write("naca0012", naca0012(), {{body, "airfoil"}, {far_field, "farfield"}});
    return out.failures == 0 ? 0 : 1;
}
