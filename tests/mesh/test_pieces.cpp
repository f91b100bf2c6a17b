// Division of polygons: triangles of positive area that are together the polygon, the best there
// are; guards.
#include <fixtures/core.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/guarded.hpp>

#include "mesh/pieces.hpp"

using namespace fixtures;

namespace {

// A mesh of one polygon and no boundary, divided.
struct Divided {
    Mesh mesh;
    harmorph::Mesh pieces;

    explicit Divided(std::vector<Point> const& corners, std::int32_t index_base = 0)
        : base_(index_base) {
        for (Point const p : corners) mesh.cells.push_back(mesh.add_point(p) + index_base);
        mesh.cell_start = {index_base, mesh.n_points() + index_base};
        hm_mesh view = in_polygons(mesh.view());
        view.index_base = index_base;
        harmorph::Mesh const given = core_mesh(view);
        block_ = laid_out_part(division_, given);
        division_.run(given);
        REQUIRE(block_->guards_intact());
        pieces = division_.pieces.mesh(given);
    }
    Point corner(std::int32_t piece, std::int32_t k) const {
        return mesh.point(pieces.cell(piece).point[k]);
    }
    double twice_area_of(std::int32_t piece) const {
        return twice_area(corner(piece, 0), corner(piece, 1), corner(piece, 2));
    }
    double worst_shape() const {
        double worst = 1;
        for (std::int32_t i = 0; i < pieces.n_cells; ++i) worst = std::min(worst, shape(piece(i)));
        return worst;
    }
    std::array<Point, 3> piece(std::int32_t i) const {
        return {corner(i, 0), corner(i, 1), corner(i, 2)};
    }
    static double shape(std::array<Point, 3> const& t) {
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k) squares += std::pow(distance(t[k], t[(k + 1) % 3]), 2);
        return twice_area(t[0], t[1], t[2]) / squares;
    }

private:
    std::int32_t base_;
    harmorph::PolygonDivision division_;
    std::unique_ptr<Guarded> block_;
};

// The largest shape that the worst triangle can have, by trying all triangulations of the corners
// begin .. end.
double best_of_all(std::vector<Point> const& p, std::size_t begin, std::size_t end) {
    if (end - begin < 2) return 1;
    double best = -1;
    for (std::size_t k = begin + 1; k < end; ++k) {
        double const parts = std::min(best_of_all(p, begin, k), best_of_all(p, k, end));
        best = std::max(best, std::min(parts, Divided::shape({p[begin], p[k], p[end]})));
    }
    return best;
}

std::vector<Point> star(int n, double depth, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Point> out;
    for (int k = 0; k < n; ++k) {
        double const angle = 2 * pi * (k + 0.4 * uniform(random)) / n,
                     r = 1 - depth * uniform(random);
        out.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return out;
}

std::vector<Point> with_middles(std::vector<Point> const& p, int per_side) {
    std::vector<Point> out;
    for (std::size_t k = 0; k < p.size(); ++k) {
        Point const a = p[k], b = p[(k + 1) % p.size()];
        for (int i = 0; i <= per_side; ++i) {
            double const t = double(i) / (per_side + 1);
            out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return out;
}

}  // namespace

TEST_CASE("a polygon is divided into n - 2 triangles of positive area and has guards") {
    std::vector<std::vector<Point>> polygons = {
        with_middles({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 1),
        with_middles({{0, 0}, {1, 0}, {0, 1}}, 3),
        {{0, 0}, {1, 0}, {2, 0}, {1, 2}},                  // a triangle with one hanging node
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},  // an L
        {{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}},  // a U
        {{0, 0}, {2, 0.5}, {0, 1}, {0.4, 0.5}},                            // an arrow
    };
    for (unsigned seed = 1; seed <= 40; ++seed)
        polygons.push_back(star(5 + int(seed) % 11, 0.6, seed));
    polygons.push_back(star(300, 0.3, 7));
    for (std::vector<Point> polygon : polygons) {
        for (bool const clockwise : {false, true}) {
            INFO("polygon.size() = " << polygon.size() << ", clockwise = " << clockwise);
            std::size_t convex = 0;
            for (std::size_t k = 0; k < polygon.size(); ++k)
                convex += is_convex_corner(polygon, k) ? 1 : 0;
            std::vector<Point> given = polygon;
            if (clockwise) std::reverse(given.begin(), given.end());
            Divided const divided(given, clockwise ? 1 : 0);
            REQUIRE(divided.pieces.n_cells == std::int32_t(polygon.size()) - 2);
            REQUIRE(divided.pieces.n_guards == std::int32_t(polygon.size()));
            std::int32_t found_convex = 0;
            for (std::int32_t k = 0; k < divided.pieces.n_guards; ++k) {
                found_convex +=
                    divided.pieces.guard_kind[k] == harmorph::CornerKind::convex ? 1 : 0;
            }
            CHECK(found_convex == std::int32_t(convex));
            double const sense = clockwise ? -1 : 1;
            double sum = 0, smallest = 1;
            for (std::int32_t i = 0; i < divided.pieces.n_checked(); ++i) {
                CHECK(divided.pieces.number(i) == 0);
                CHECK(divided.pieces.is_piece_or_guard(i));
                if (i >= divided.pieces.n_cells) continue;
                double const twice = sense * divided.twice_area_of(i);
                smallest = std::min(smallest, twice);
                sum += 0.5 * twice;
            }
            CHECK(smallest > 0);
            CHECK(sum == doctest::Approx(shoelace(polygon)).epsilon(1e-13));
        }
    }
}

TEST_CASE("the worst triangle is the best that any triangulation has") {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        std::vector<Point> const polygon = star(5 + int(seed) % 5, 0.5, 100 + seed);
        CAPTURE(seed);
        CHECK(Divided(polygon).worst_shape() ==
              doctest::Approx(best_of_all(polygon, 0, polygon.size() - 1)).epsilon(1e-14));
    }
}

TEST_CASE("triangles and convex quadrilaterals stay whole, and crossed cells are inverted") {
    Divided const triangle({{0, 0}, {1, 0}, {0, 1}}), quad({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1);
    CHECK(triangle.pieces.n_checked() == 1);
    CHECK(triangle.pieces.cell(0).n == 3);
    CHECK(quad.pieces.n_checked() == 1);
    CHECK(quad.pieces.cell(0).n == 4);
    CHECK(!quad.pieces.is_piece_or_guard(0));
    Divided const bow({{0, 0}, {1, 1}, {1, 0}, {0, 1.2}});
    double smallest = 1, largest = -1;
    for (std::int32_t i = 0; i < bow.pieces.n_cells; ++i) {
        smallest = std::min(smallest, bow.twice_area_of(i));
        largest = std::max(largest, bow.twice_area_of(i));
    }
    CHECK(smallest < 0);
    CHECK(largest > 0);
    Divided const point({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}});  // nothing is divided by 0
    CHECK(point.pieces.n_cells == 3);
}

TEST_CASE("pieces and guards have the numbers of their cells, and some cells have none") {
    Mesh const mesh = refined(square(4), [](Point p) { return p.x < 0.3; });
    Analysed const analysed(in_polygons(mesh.view()));
    harmorph::Mesh const& pieces = analysed->topology().mesh;
    REQUIRE(pieces.has_pieces());
    CHECK(pieces.n_given_cells() == mesh.n_cells());
    std::vector<std::int32_t> found(std::size_t(mesh.n_cells()), 0);
    for (std::int32_t i = 0; i < pieces.n_checked(); ++i) {
        std::int32_t const cell = pieces.number(i);
        std::vector<std::int32_t> const corners = corners_of(mesh, cell);
        harmorph::Cell const piece = pieces.cell(i);
        for (std::int32_t k = 0; k < piece.n; ++k) {
            CHECK(std::count(corners.begin(), corners.end(), piece.point[k]) == 1);
        }
        if (i < pieces.n_cells) ++found[std::size_t(cell)];
        CHECK(pieces.is_piece_or_guard(i) == (corners.size() > 4));
    }
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        std::int32_t const n = std::int32_t(corners_of(mesh, cell).size());
        CHECK(found[std::size_t(cell)] == (n > 4 ? n - 2 : 1));
    }
}
