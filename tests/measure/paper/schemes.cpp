// The schemes that the paper's text may mean, as matrices, on its own meshes and on squares: why
// the averages of nodal gradients diverge or crawl, and what the other readings do. Written apart
// from the library, with Eigen.
//   schemes OUT_DIRECTORY NAME=MESH.su2 ...
// prints a table for each mesh, and leaves the eigenvalues of the last one as
// OUT_DIRECTORY/spectrum.svg.
#include "read_su2.h"

#include <eigen3/Eigen/Eigenvalues>
#include <eigen3/Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using Vector = Eigen::Vector2d;
using Sparse = Eigen::SparseMatrix<double>;
using Row = std::map<int, double>;  // coefficients of the values of points

struct Edge {
    int begin, end;
    Vector normal{0, 0};  // of the dual face between the two volumes, from begin to end
    std::vector<int> cells;
};
struct Mesh {
    std::vector<Vector> at;
    std::vector<std::vector<int>> cells;  // counter-clockwise
    std::vector<bool> known;              // points of the boundary
    std::vector<Edge> edges;

    int points() const { return static_cast<int>(at.size()); }

    double area(int cell) const {
        double sum = 0;
        for_each_side(cell, [&](int a, int b) {
            sum += 0.5 * (at[a].x() * at[b].y() - at[a].y() * at[b].x());
        });
        return sum;
    }
    template <class Visit>
    void for_each_side(int cell, Visit visit) const {
        std::vector<int> const& corners = cells[cell];
        for (std::size_t k = 0; k < corners.size(); ++k)
            visit(corners[k], corners[(k + 1) % corners.size()]);
    }

    // The median dual: lines from the middle of each edge to the barycentres of its cells.
    void make_edges() {
        std::map<std::pair<int, int>, int> number;
        for (int cell = 0; cell < static_cast<int>(cells.size()); ++cell) {
            if (area(cell) < 0) std::reverse(cells[cell].begin(), cells[cell].end());
            Vector centre(0, 0);
            for (int const corner : cells[cell])
                centre += at[corner] / static_cast<double>(cells[cell].size());
            for_each_side(cell, [&](int a, int b) {
                auto const [found, is_new] =
                    number.try_emplace(std::minmax(a, b), static_cast<int>(edges.size()));
                if (is_new) edges.push_back({std::min(a, b), std::max(a, b), {0, 0}, {}});
                Edge& edge = edges[found->second];
                Vector const line = centre - 0.5 * (at[a] + at[b]);
                edge.normal += (a < b ? 1.0 : -1.0) * Vector(line.y(), -line.x());
                edge.cells.push_back(cell);
            });
        }
    }
};

// The integral of the gradient over a cell by Green-Gauss, the trapezoidal rule on its sides: two
// rows, for x and y.
void add_gradient(Mesh const& mesh, int cell, Row& x, Row& y) {
    mesh.for_each_side(cell, [&](int a, int b) {
        Vector const side = mesh.at[b] - mesh.at[a], outward(side.y(), -side.x());
        for (int const end : {a, b}) {
            x[end] += 0.5 * outward.x();
            y[end] += 0.5 * outward.y();
        }
    });
}

enum class Scheme { plain, corrected, edge_dual, compact };
constexpr Scheme schemes[] = {Scheme::plain, Scheme::corrected, Scheme::edge_dual, Scheme::compact};
char const* name(Scheme scheme) {
    switch (scheme) {
        case Scheme::plain: return "plain averages of nodal gradients";
        case Scheme::corrected: return "averages, corrected along the edge";
        case Scheme::edge_dual: return "gradients over edge-dual volumes";
        default: return "compact";
    }
}

struct Gradients {  // over volumes: those of all cells round a point, or on both sides of an edge
    std::vector<Row> x, y;
    std::vector<double> area;

    explicit Gradients(std::size_t n) : x(n), y(n), area(n) {}
    void add(Mesh const& mesh, int cell, std::size_t to) {
        add_gradient(mesh, cell, x[to], y[to]);
        area[to] += mesh.area(cell);
    }
    void add_flux(std::size_t cell, Vector const& through, Row& flux) const {
        for (auto const& [point, by] : x[cell]) flux[point] += through.x() * by / area[cell];
        for (auto const& [point, by] : y[cell]) flux[point] += through.y() * by / area[cell];
    }
};

// Rows of all points: minus the sums of the fluxes into their volumes.
std::vector<Row> compact_rows(Mesh const& mesh) {
    std::vector<Row> rows(mesh.at.size());
    auto const triangle = [&](int a, int b, int c, double share) {  // cotangents of the angles
        int const corner[3] = {a, b, c};
        for (int k = 0; k < 3; ++k) {
            int const i = corner[k], j = corner[(k + 1) % 3], opposite = corner[(k + 2) % 3];
            Vector const u = mesh.at[i] - mesh.at[opposite], v = mesh.at[j] - mesh.at[opposite];
            double const weight = share * 0.5 * u.dot(v) / (u.x() * v.y() - u.y() * v.x());
            rows[i][i] += weight, rows[j][j] += weight, rows[i][j] -= weight, rows[j][i] -= weight;
        }
    };
    for (std::vector<int> const& cell : mesh.cells) {
        if (cell.size() == 3) triangle(cell[0], cell[1], cell[2], 1);
        if (cell.size() == 4) {  // the mean of both ways to split
            for (int k = 0; k < 4; ++k)
                triangle(cell[k], cell[(k + 1) % 4], cell[(k + 2) % 4], 0.5);
        }
    }
    return rows;
}

std::vector<Row> rows_of(Mesh const& mesh, Scheme scheme) {
    if (scheme == Scheme::compact) return compact_rows(mesh);
    bool const on_edges = scheme == Scheme::edge_dual;
    Gradients gradients(on_edges ? mesh.edges.size() : mesh.at.size());
    if (on_edges) {
        for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
            for (int const cell : mesh.edges[e].cells) gradients.add(mesh, cell, e);
        }
    } else {
        for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
            for (int const corner : mesh.cells[cell])
                gradients.add(mesh, cell, static_cast<std::size_t>(corner));
        }
    }
    std::vector<Row> rows(mesh.at.size());
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
        Edge const& edge = mesh.edges[e];
        Vector const along = mesh.at[edge.end] - mesh.at[edge.begin];
        double const direct =
            scheme == Scheme::corrected ? edge.normal.dot(along) / along.squaredNorm() : 0;
        Vector const rest = edge.normal - direct * along;
        Row flux;  // from end to begin
        if (on_edges) {
            gradients.add_flux(e, rest, flux);
        } else {
            gradients.add_flux(static_cast<std::size_t>(edge.begin), 0.5 * rest, flux);
            gradients.add_flux(static_cast<std::size_t>(edge.end), 0.5 * rest, flux);
        }
        flux[edge.end] += direct;
        flux[edge.begin] -= direct;
        for (auto const& [point, by] : flux) {
            rows[edge.begin][point] -= by;
            rows[edge.end][point] += by;
        }
    }
    return rows;
}

// The matrix of the unknowns, each row divided by the compact scheme's diagonal: what steps with
// local time steps see.
Sparse matrix_of(Mesh const& mesh, Scheme scheme) {
    std::vector<Row> const rows = rows_of(mesh, scheme), compact = compact_rows(mesh);
    std::vector<int> unknown(mesh.at.size(), -1);
    int n = 0;
    for (int k = 0; k < mesh.points(); ++k)
        if (!mesh.known[k]) unknown[k] = n++;
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < mesh.points(); ++k) {
        if (unknown[k] < 0) continue;
        for (auto const& [point, by] : rows[k]) {
            if (unknown[point] >= 0)
                entries.emplace_back(unknown[k], unknown[point], by / compact[k].at(k));
        }
    }
    Sparse out(n, n);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

// Returns how much a mode alternates from point to point: the mean of (u_P - u_Q)^2 over the edges,
// relative to that of 2 (u_P^2 + u_Q^2); 1 for a checkerboard, 0 for a constant.
double alternation(Mesh const& mesh, Eigen::VectorXcd const& mode) {
    std::vector<std::complex<double>> u(mesh.at.size());
    int n = 0;
    for (int k = 0; k < mesh.points(); ++k)
        if (!mesh.known[k]) u[k] = mode[n++];
    double differences = 0, squares = 0;
    for (Edge const& edge : mesh.edges) {
        differences += std::norm(u[edge.begin] - u[edge.end]);
        squares += 2 * (std::norm(u[edge.begin]) + std::norm(u[edge.end]));
    }
    return differences / squares;
}

// One step of the paper's Runge-Kutta scheme multiplies a mode by this; z: minus the eigenvalue
// times the step.
double growth(std::complex<double> z) {
    std::complex<double> value = 1;
    for (double const coefficient : {0.11, 0.2766, 0.5, 1.0}) value = 1.0 + coefficient * z * value;
    return std::abs(value);
}

struct Mode {
    std::complex<double> value;
    double alternation;
};

std::vector<Mode> study(Mesh const& mesh, Scheme scheme) {
    Eigen::EigenSolver<Eigen::MatrixXd> const solver{Eigen::MatrixXd(matrix_of(mesh, scheme))};
    Eigen::MatrixXcd const vectors = solver.eigenvectors();
    std::vector<Mode> modes;
    for (Eigen::Index k = 0; k < vectors.cols(); ++k)
        modes.push_back({solver.eigenvalues()[k], alternation(mesh, vectors.col(k))});
    auto const is_less = [](Mode const& p, Mode const& q) {
        return p.value.real() < q.value.real();
    };
    std::sort(modes.begin(), modes.end(), is_less);
    double largest = 0, slowest = 0;
    long wrong = 0;
    for (Mode const& mode : modes) {
        largest = std::max(largest, std::abs(mode.value));
        wrong += mode.value.real() <= 0;
    }
    for (Mode const& mode : modes) slowest = std::max(slowest, growth(-4.3 / largest * mode.value));
    std::printf("%-36s  %18.2e  %9ld  %18.3f  %25.2f  ", name(scheme), modes[0].value.real(), wrong,
                largest, modes[0].alternation);
    if (slowest < 1) std::printf("%22.0f\n", std::ceil(std::log(1e-10) / std::log(slowest)));
    else std::printf("%22s\n", "diverges");
    return modes;
}

void print_head(std::string const& title) {
    std::printf("\ntable %s\n%-36s  %18s  %9s  %18s  %25s  %22s\n", title.c_str(), "scheme",
                "least eigenvalue", "0 or less", "largest eigenvalue", "alternation of least mode",
                "Runge-Kutta steps");
}

Mesh square(int n) {
    Mesh mesh;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            mesh.at.emplace_back(i, j);
            mesh.known.push_back(i == 0 || j == 0 || i == n || j == n);
            if (i < n && j < n)
                mesh.cells.push_back({j * (n + 1) + i, j * (n + 1) + i + 1,
                                      (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i});
        }
    }
    mesh.make_edges();
    return mesh;
}

Mesh read(char const* file) {
    su2_mesh from;
    char message[256];
    if (read_su2(file, &from, message) != 0) {
        std::fprintf(stderr, "%s: %s\n", file, message);
        std::exit(3);
    }
    Mesh mesh;
    mesh.known.resize(static_cast<std::size_t>(from.n_points));
    for (int k = 0; k < from.n_points; ++k) mesh.at.emplace_back(from.x[k], from.y[k]);
    for (int k = 0; k < from.n_cells; ++k)
        mesh.cells.emplace_back(from.cell_points + from.cell_start[k],
                                from.cell_points + from.cell_start[k + 1]);
    for (int k = 0; k < 2 * from.n_faces; ++k)
        mesh.known[static_cast<std::size_t>(from.face_points[k])] = true;
    free_su2(&from);
    mesh.make_edges();
    return mesh;
}

// The symbol on squares: what the scheme makes of the wave (-1)^i, and of (-1)^(i + j), in the
// middle of a square.
void print_symbols() {
    Mesh const mesh = square(8);
    int const middle = 4 * 9 + 4;
    std::printf(
        "table Squares: what becomes of waves that alternate from point to point\n%-36s  %12s  "
        "%12s\n",
        "scheme", "(-1)^i", "(-1)^(i+j)");
    for (Scheme const scheme : schemes) {
        double stripes = 0, checkerboard = 0;
        std::vector<Row> const rows = rows_of(mesh, scheme);
        for (auto const& [point, by] : rows[middle]) {
            int const i = point % 9, j = point / 9;
            stripes += by * (i % 2 == 0 ? 1 : -1);
            checkerboard += by * ((i + j) % 2 == 0 ? 1 : -1);
        }
        std::printf("%-36s  %12.3f  %12.3f\n", name(scheme), stripes, checkerboard);
    }
}

// Each mode as a point: its eigenvalue and how much it alternates. Eigenvalues of the wrong sign
// are at the left edge.
void draw(std::vector<std::vector<Mode>> const& panels, std::string const& what,
          std::string const& file) {
    std::ofstream out(file);
    double const width = 380, height = 230, left = 55, top = 30, across = 300, up = 150,
                 least = 1e-4, largest = 2;
    auto const x = [&](double value) {
        return across * std::log(std::max(value, least) / least) / std::log(largest / least);
    };
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << 2 * width << ' '
        << 2 * height + 40
        << "\" font-family=\"sans-serif\" font-size=\"12\">\n<title>Eigenvalues of the schemes on "
        << what
        << ", and how much their modes alternate</title>\n<rect width=\"100%\" height=\"100%\" "
           "fill=\"white\"/>\n";
    for (std::size_t k = 0; k < panels.size(); ++k) {
        out << "<g transform=\"translate(" << width * static_cast<double>(k % 2) + left << ' '
            << height * static_cast<double>(k / 2) + top << ")\"><text y=\"-10\">"
            << name(schemes[k]) << "</text>\n<path fill=\"none\" stroke=\"#999\" d=\"M0 0V" << up
            << 'H' << across << "\"/>\n";
        for (double const tick : {1e-3, 1e-2, 1e-1, 1.0}) {
            out << "<text fill=\"#555\" text-anchor=\"middle\" x=\"" << x(tick) << "\" y=\""
                << up + 16 << "\">" << tick << "</text>\n";
        }
        for (double const tick : {0.0, 0.5, 1.0}) {
            out << "<text fill=\"#555\" text-anchor=\"end\" x=\"-8\" y=\"" << up * (1 - tick) + 4
                << "\">" << tick << "</text>\n";
        }
        for (Mode const& mode : panels[k]) {
            bool const wrong = mode.value.real() <= 0;
            out << "<circle r=\"" << (wrong ? 4 : 1.6) << "\" fill=\""
                << (wrong ? "#d55e00" : "#0072b2") << "\" cx=\"" << x(mode.value.real())
                << "\" cy=\"" << up * (1 - mode.alternation) << "\"/>\n";
        }
        out << "</g>\n";
    }
    out << "<text x=\"" << left << "\" y=\"" << 2 * height + 10
        << "\">Across: the eigenvalue (real part), rows divided by the compact scheme's diagonal; "
           "large orange points: "
           "0 or less.</text>\n"
        << "<text x=\"" << left << "\" y=\"" << 2 * height + 28
        << "\">Up: how much the mode alternates from point to point; 0: constant, 1: "
           "checkerboard.</text>\n</svg>\n";
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::fprintf(stderr, "usage: schemes OUT_DIRECTORY NAME=MESH.su2 ...\n");
        return 2;
    }
    print_symbols();
    print_head("A square of 24 x 24 cells");
    for (Scheme const scheme : schemes) study(square(24), scheme);
    for (int k = 2; k < count; ++k) {
        std::string const argument = arguments[k], title = argument.substr(0, argument.find('='));
        Mesh const mesh = read(argument.c_str() + title.size() + 1);
        print_head(title);
        std::vector<std::vector<Mode>> panels;
        for (Scheme const scheme : schemes) panels.push_back(study(mesh, scheme));
        draw(panels, title, std::string(arguments[1]) + "/spectrum.svg");
    }
}
