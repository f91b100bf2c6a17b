// `make paper`: free-form deformation of a mesh against harmonic functions, for the same movement
// of the wall. A box of Bernstein polynomials round the body moves all mesh points inside; its
// outermost nodes stay, so that the mesh is continuous at the box. Its other nodes are the
// least-squares fit to the displacements of the wall points, with a penalty on their own movement:
// of several penalties the best that leaves the mesh valid, if one does.
//   ffd FOLDER MESH LAPLACE-BASIS CONFORMAL-BASIS        prints a table and captions as
//   tests/figures.sh reads them
#include "mesh/basis_file.hpp"
#include "commands/commands.hpp"
#include "basics/failure.hpp"
#include "commands/morph.hpp"
#include "basics/numbers.hpp"
#include "basics/output_file.hpp"
#include "pictures/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace ffd {
namespace {

using cli::Morph;

std::vector<double> bernstein(int degree, double t) {
    std::vector<double> value(static_cast<std::size_t>(degree) + 1);
    value[0] = 1;
    for (int d = 1; d <= degree; ++d) {
        for (int k = d; k > 0; --k) {
            auto const at = static_cast<std::size_t>(k);
            value[at] = (1 - t) * value[at] + t * value[at - 1];
        }
        value[0] *= 1 - t;
    }
    return value;
}

// Solves the symmetric positive definite system of a few hundred unknowns in place, for two
// right-hand sides.
void solve(std::vector<double>& matrix, std::vector<double>& x, std::vector<double>& y) {
    std::size_t const n = x.size();
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = k + 1; i < n; ++i) {
            double const factor = matrix[i * n + k] / matrix[k * n + k];
            for (std::size_t j = k; j < n; ++j) matrix[i * n + j] -= factor * matrix[k * n + j];
            x[i] -= factor * x[k];
            y[i] -= factor * y[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) {
            x[k] -= matrix[k * n + j] * x[j];
            y[k] -= matrix[k * n + j] * y[j];
        }
        x[k] /= matrix[k * n + k];
        y[k] /= matrix[k * n + k];
    }
}

class Lattice {
public:
    // The wall's box with `margin` of its longer side more on each side.
    Lattice(int degree, const cli::Mesh& mesh, const std::vector<std::size_t>& wall, double margin)
        : degree_(degree) {
        low_[0] = low_[1] = 1e300, high_[0] = high_[1] = -1e300;
        for (std::size_t const point : wall) {
            double const at[2] = {mesh.x[point], mesh.y[point]};
            for (int d = 0; d < 2; ++d)
                low_[d] = std::min(low_[d], at[d]), high_[d] = std::max(high_[d], at[d]);
        }
        double const by = margin * std::max(high_[0] - low_[0], high_[1] - low_[1]);
        for (int d = 0; d < 2; ++d) low_[d] -= by, high_[d] += by;
    }
    std::size_t unknowns() const { return static_cast<std::size_t>((degree_ - 1) * (degree_ - 1)); }
    // Returns the Bernstein functions of the inner nodes; all are 0 outside the box.
    std::vector<double> weights(double x, double y) const {
        double const t = (x - low_[0]) / (high_[0] - low_[0]),
                     s = (y - low_[1]) / (high_[1] - low_[1]);
        std::vector<double> out(unknowns());
        if (t < 0 || t > 1 || s < 0 || s > 1) return out;
        std::vector<double> const a = bernstein(degree_, t), b = bernstein(degree_, s);
        std::size_t k = 0;
        for (int j = 1; j < degree_; ++j)
            for (int i = 1; i < degree_; ++i)
                out[k++] = a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
        return out;
    }
    // The displacement of all points that fits that of the wall; penalty: of the nodes' movement,
    // in parts of the equations.
    void fit(const cli::Mesh& mesh, const std::vector<std::size_t>& wall, double penalty,
             cli::Field& displacement) const {
        std::size_t const n = unknowns();
        std::vector<double> matrix(n * n), x(n), y(n);
        for (std::size_t const point : wall) {
            std::vector<double> const w = weights(mesh.x[point], mesh.y[point]);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += w[i] * w[j];
                x[i] += w[i] * displacement.x[point];
                y[i] += w[i] * displacement.y[point];
            }
        }
        double trace = 0;
        for (std::size_t i = 0; i < n; ++i) trace += matrix[i * n + i];
        for (std::size_t i = 0; i < n; ++i)
            matrix[i * n + i] += penalty * trace / static_cast<double>(n);
        solve(matrix, x, y);
        for (std::size_t point = 0; point < mesh.x.size(); ++point) {
            std::vector<double> const w = weights(mesh.x[point], mesh.y[point]);
            displacement.x[point] = displacement.y[point] = 0;
            for (std::size_t i = 0; i < n; ++i) {
                displacement.x[point] += w[i] * x[i];
                displacement.y[point] += w[i] * y[i];
            }
        }
    }

private:
    int degree_;
    double low_[2], high_[2];
};

// One row of the table: a morph, and how its displacements differ from the wanted movement of the
// wall.
struct Row {
    double off = 0, reach = 0, far = 0;
};

Row measure(const cli::Mesh& mesh, const std::vector<std::size_t>& wall, const cli::Field& wanted,
            const cli::Field& found) {
    Row out;
    double largest = 0;
    for (std::size_t const point : wall)
        largest = std::max(largest, std::hypot(wanted.x[point], wanted.y[point]));
    for (std::size_t const point : wall) {
        out.off = std::max(out.off, std::hypot(found.x[point] - wanted.x[point],
                                               found.y[point] - wanted.y[point]) /
                                        largest);
    }
    // Wall points that the wanted movement leaves where they are, or nearly: how far they go all
    // the same.
    for (std::size_t const point : wall) {
        if (std::hypot(wanted.x[point], wanted.y[point]) > 1e-3 * largest) continue;
        out.far = std::max(out.far, std::hypot(found.x[point], found.y[point]) / largest);
    }
    std::size_t moving = 0;
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        moving += std::hypot(found.x[point], found.y[point]) > 0.01 * largest ? 1 : 0;
    }
    out.reach = static_cast<double>(moving) / static_cast<double>(mesh.x.size());
    return out;
}

// The FFD in the place of a morph's displacement; judged as morphs are.
void replace(Morph& morph, const cli::Mesh& mesh, const cli::Basis& basis,
             const cli::Field& displacement, const cli::Threads& threads) {
    morph.displacement = displacement;
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        morph.moved.x[point] = mesh.x[point] + displacement.x[point];
        morph.moved.y[point] = mesh.y[point] + displacement.y[point];
    }
    morph.step = cli::admissible_step(basis, mesh, displacement, threads);
    const hm_mesh view = mesh.view();
    const hm_points at = morph.moved.read(), before = mesh.coordinates();
    cli::call(mesh, hm_assess, basis.get(), &view, &at, nullptr, &before, threads.executor(),
              nullptr, &morph.quality);
}

void print(const char* method, const Row& row, const Morph& morph) {
    std::printf("%-24s  %10.1e  %11.1e  %11.3g  %9d  %11.3g  %12.3g  %8.0f %%\n", method, row.off,
                row.far, morph.step.admissible, morph.quality.inverted, morph.quality.min_quality,
                morph.quality.mean_quality, 100 * row.reach);
}

// Pictures of equal size, one beside the other.
std::string side_by_side(const std::vector<std::string>& pictures) {
    std::string inside;
    double width = 0, height = 0;
    for (const std::string& picture : pictures) {
        const std::size_t begin = picture.find("<svg ");
        const auto number = [&](const char* key) {
            return std::stod(picture.substr(picture.find(key, begin) + std::string(key).size()));
        };
        inside += "<svg x=\"" + cli::brief(width) + "\" " + picture.substr(begin + 5);
        width += number("width=\"");
        height = std::max(height, number("height=\""));
    }
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + cli::brief(width) +
           "\" height=\"" + cli::brief(height) + "\">\n" + inside + "</svg>\n";
}

void compare(const std::string& folder, const cli::Mesh& mesh, const cli::Basis& laplace,
             const cli::Basis& conformal, const std::string& name, const std::string& what,
             const std::vector<double>& moves, const cli::Threads& threads) {
    const hm_basis_info& info = laplace.info();
    std::vector<std::size_t> wall;
    for (std::int32_t k = 0; k < info.curve_points; ++k)
        wall.push_back(static_cast<std::size_t>(info.curve_point[k]));
    std::printf(
        "table %s: largest distance of wall points from where the B-spline has them, and of those "
        "that it leaves "
        "where they are; admissible step; cells; quality; mesh points that move by more than 1 "
        "%%\n",
        what.c_str());
    std::printf("%-24s  %10s  %11s  %11s  %9s  %11s  %12s  %10s\n", "method", "wall off",
                "others off", "admissible", "inverted", "min quality", "mean quality", "moving");
    const Morph harmonic(laplace, mesh, moves, 1, threads),
        angles(conformal, mesh, moves, 1, threads);
    print("harmonic functions", measure(mesh, wall, harmonic.displacement, harmonic.displacement),
          harmonic);
    print("conformal functions", measure(mesh, wall, harmonic.displacement, angles.displacement),
          angles);
    Morph shown = harmonic;
    double best = 1e300;
    for (int const degree : {3, 5, 7, 9, 12, 16}) {
        const Lattice lattice(degree, mesh, wall, 0.5);
        Morph chosen = harmonic;
        Row row;
        for (double const penalty : {1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2}) {
            cli::Field field = harmonic.displacement;
            lattice.fit(mesh, wall, penalty, field);
            Morph morph = harmonic;
            replace(morph, mesh, laplace, field, threads);
            const bool better = morph.quality.inverted < chosen.quality.inverted;
            if (penalty > 1e-10 && !better) continue;
            chosen = morph;
            row = measure(mesh, wall, harmonic.displacement, field);
        }
        print(("FFD, " + std::to_string(lattice.unknowns()) + " free nodes").c_str(), row, chosen);
        if (row.off < best) best = row.off, shown = chosen;
    }
    std::printf("\n");
    const cli::Box window = {-0.3, -0.35, 1.45, 0.85};
    cli::OutputFiles files;
    files.add(folder + "/ffd-" + name + ".svg")
        << side_by_side({cli::morph_picture(mesh, laplace, harmonic, window),
                         cli::morph_picture(mesh, laplace, shown, window)});
    files.commit();
    std::printf(
        "figure ffd-%s.svg Free-form deformation | %s, by harmonic functions on the left, by the "
        "box of free-form "
        "deformation that fits the wall "
        "best on the right. Before in blue, after in red, with the control polygon of the moved "
        "B-spline. The wall of "
        "the box is off by %s of the movement.\n",
        name.c_str(), what.c_str(), cli::brief(best).c_str());
}

}  // namespace
}  // namespace ffd

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    try {
        const cli::Mesh mesh = cli::read_mesh(argv[2]);
        const cli::Basis laplace(argv[3], mesh), conformal(argv[4], mesh);
        const cli::Threads threads(1);
        const auto n = static_cast<std::size_t>(laplace.functions());
        std::vector<double> all(2 * n), one(2 * n);
        for (std::size_t i = 0; i < n; ++i) all[2 * i] = 0.08, all[2 * i + 1] = 0.065;
        one[2 * 3 + 1] = 0.05;
        ffd::compare(argv[1], mesh, laplace, conformal, "all",
                     "All control points move by (.08, .065)", all, threads);
        ffd::compare(argv[1], mesh, laplace, conformal, "one",
                     "Control point 4 alone moves up by .05", one, threads);
    } catch (const cli::Failure& failure) {
        std::fprintf(stderr, "ffd: %s\n", failure.what());
        return 1;
    }
    return 0;
}
