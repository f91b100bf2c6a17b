// Cells of points, and weights that reproduce linear fields.
#include <fixtures/o_mesh.hpp>
#include <fixtures/core.hpp>
#include <fixtures/traps.hpp>
#include <fixtures/guarded.hpp>
#include "mesh/locate.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Location;
using harmorph::Vec2;

namespace {

// A locator on a mesh, cells oriented by the library.
class Finder {
public:
    explicit Finder(Mesh const& mesh) : mesh_(mesh), analysed_(mesh_.view()) {
        block_ = laid_out_part(locator_, mesh_.n_cells());
        locator_.build(analysed_->topology());
        REQUIRE(block_->guards_intact());
    }
    Location locate(Vec2 point, Index hint = harmorph::none) const {
        return locator_.locate(point, hint);
    }

private:
    Mesh mesh_;
    Analysed analysed_;
    std::unique_ptr<Guarded> block_;
    harmorph::Locator locator_;
};

template <class Field>
double interpolated(Location const& found, Field field) {
    double sum = 0;
    for (Index k = 0; k < found.weights.n; ++k)
        sum += found.weights.weight[k] * field(found.weights.point[k]);
    return sum;
}

// Interpolates a linear field at the point.
double linear_error(Mesh const& mesh, Location const& found, Vec2 p) {
    auto const field = [](double x, double y) { return 3 + 2 * x - 5 * y; };
    return std::fabs(
        interpolated(found, [&](Index k) { return field(mesh.point(k).x, mesh.point(k).y); }) -
        field(p.x, p.y));
}

bool is_corner(Location const& found, Index point) {
    for (Index k = 0; k < found.weights.n; ++k)
        if (found.weights.point[k] == point) return true;
    return false;
}

std::vector<Mesh> some_meshes() {
    std::vector<Mesh> out;
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        out.push_back(annulus(6, 24, 0.5, 2, kind));
        out.push_back(square(9, kind, 3, 3));
        perturb(out.back(), 0.3, 7);
    }
    out.push_back(hybrid_mesh(naca4({}, 20)));
    out.push_back(o_mesh(naca4({}, 20), stretched(1e-4, 5, 24)));
    for (std::size_t k = 0, n = out.size(); k < n; ++k) {
        Mesh other = out[k];
        shuffle_cells(other, 3);
        reverse_some(other, 4);
        rotate_starts(other, 5);
        renumber_points(other, 6);
        out.push_back(other);
    }
    return out;
}

}  // namespace

TEST_CASE("weights are 1 at points of the mesh, and middles of cells are found in their cells") {
    for (Mesh const& mesh : some_meshes()) {
        Finder const finder(mesh);
        for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
            std::vector<std::int32_t> const corners(mesh.cells.begin() + mesh.cell_start[cell],
                                                    mesh.cells.begin() + mesh.cell_start[cell + 1]);
            Vec2 middle;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                Point const a = mesh.point(corners[k]),
                            b = mesh.point(corners[(k + 1) % corners.size()]);
                middle = middle + (1.0 / double(corners.size())) * Vec2{a.x, a.y};
                Location const corner = finder.locate({a.x, a.y});
                CHECK(corner.distance == 0);
                CHECK(interpolated(corner, [&](Index p) { return p == corners[k] ? 1.0 : 0.0; }) ==
                      1);
                CHECK(interpolated(corner, [&](Index p) { return p == corners[k] ? 0.0 : 1.0; }) ==
                      0);
                Location const side = finder.locate({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)});
                CHECK(side.distance == 0);
                CHECK(is_corner(side, corners[k]));
                CHECK(is_corner(side, corners[(k + 1) % corners.size()]));
                CHECK(interpolated(side, [&](Index p) { return p == corners[k] ? 1.0 : 0.0; }) ==
                      doctest::Approx(0.5));
            }
            Location const inside = finder.locate(middle);
            CHECK(inside.cell == Index(cell));
            CHECK(inside.distance == 0);
        }
    }
}

TEST_CASE("weights sum to 1, are not negative inside, and reproduce linear fields") {
    for (Mesh const& mesh : some_meshes()) {
        Finder const finder(mesh);
        std::mt19937 random(11);
        int outside = 0;
        for (int k = 0; k < 400; ++k) {
            std::size_t const cell = random() % (mesh.cell_start.size() - 1);
            Point const corner = mesh.point(mesh.cells[std::size_t(mesh.cell_start[cell])]);
            double const size = k % 2 == 0 ? 0.2 : 0.01;
            Vec2 const p{corner.x + size * (uniform(random) - 0.5),
                         corner.y + size * (uniform(random) - 0.5)};
            Location const found = finder.locate(p);
            REQUIRE(found.cell != harmorph::none);
            outside += found.distance > 0 ? 1 : 0;
            double sum = 0, least = 0, largest = 0;
            for (Index c = 0; c < found.weights.n; ++c) {
                sum += found.weights.weight[c];
                least = std::fmin(least, found.weights.weight[c]);
                largest = std::fmax(largest, std::fabs(found.weights.weight[c]));
            }
            CHECK(std::fabs(sum - 1) <= 1e-14 * largest);
            if (found.distance == 0) CHECK(least > -1e-8);
            if (found.distance <= found.longest_side)
                CHECK(linear_error(mesh, found, p) <= 1e-11 * largest);
        }
        CHECK(outside > 5);
    }
}

TEST_CASE("a point without a number is in no cell, and no data of such a point is read") {
    Finder const finder(hybrid_mesh(naca4({}, 20)));
    Untrapped const untrapped;
    Location const nowhere = finder.locate({std::nan(""), 0});
    CHECK(nowhere.cell == harmorph::none);
    CHECK(nowhere.weights.n == 0);
}

TEST_CASE("outside the mesh the distance is that from the boundary") {
    Mesh const mesh =
        square(9, Cells::hybrid, 3, 3);  // unit square; the hole is the square from 1/3 to 2/3
    Finder const finder(mesh);
    std::mt19937 random(12);
    for (int k = 0; k < 300; ++k) {
        double const x = 3 * uniform(random) - 1, y = 3 * uniform(random) - 1;
        double const dx = std::fmax(0, std::fmax(-x, x - 1)),
                     dy = std::fmax(0, std::fmax(-y, y - 1));
        double const into_hole =
            std::fmin(std::fmin(x - 1.0 / 3, 2.0 / 3 - x), std::fmin(y - 1.0 / 3, 2.0 / 3 - y));
        double const expected = into_hole > 0 ? into_hole : std::sqrt(dx * dx + dy * dy);
        CHECK(finder.locate({x, y}).distance == doctest::Approx(expected).epsilon(1e-12));
    }
}

TEST_CASE("a continuous field depends neither on the hint nor on the numbering") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh const mesh = annulus(6, 24, 0.5, 2, kind);
        Mesh other = mesh;
        shuffle_cells(other, 21);
        reverse_some(other, 22);
        rotate_starts(other, 23);
        std::vector<std::int32_t> const new_of = renumber_points(other, 24);
        Finder const finder(mesh), other_finder(other);
        std::mt19937 random(25);
        std::vector<double> field, other_field(mesh.x.size());
        for (std::size_t k = 0; k < mesh.x.size(); ++k) field.push_back(uniform(random));
        for (std::size_t k = 0; k < mesh.x.size(); ++k)
            other_field[std::size_t(new_of[k])] = field[k];
        for (int k = 0; k < 300; ++k) {
            double const r = 0.52 + 1.43 * uniform(random), angle = 7 * uniform(random);
            Vec2 const p{r * std::cos(angle), r * std::sin(angle)};
            double const value =
                interpolated(finder.locate(p), [&](Index i) { return field[std::size_t(i)]; });
            Index const hint = Index(random() % unsigned(mesh.n_cells()));
            auto const same = [&](Location const& found, std::vector<double> const& values) {
                CHECK(interpolated(found, [&](Index i) { return values[std::size_t(i)]; }) ==
                      doctest::Approx(value).epsilon(1e-12));
            };
            same(finder.locate(p, hint), field);
            same(other_finder.locate(p, hint), other_field);
        }
    }
}

TEST_CASE("on a cut the point on the side of the place is found") {
    CMesh const mesh = c_mesh(naca4({}, 16), 8, 3, stretched(1e-3, 4, 12));
    Finder const finder(mesh.mesh);
    for (std::int32_t k = 0; k + 1 < mesh.n_wake; ++k) {
        Point const a = mesh.mesh.point(k), b = mesh.mesh.point(k + 1);
        Vec2 const p{0.3 * a.x + 0.7 * b.x, 0.3 * a.y + 0.7 * b.y};
        Location const found = finder.locate(p);
        CHECK(found.distance == 0);
        CHECK(linear_error(mesh.mesh, found, p) < 1e-12);
    }
}
