// Distances from faces, against trying all of them; weights of cells, against repeated multiplication.
#include <doctest/doctest.h>

#include <fixtures/airfoil.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/kernels.hpp>
#include <fixtures/traps.hpp>

#include <harmorph/boundary/distance.hpp>

#include <limits>

using namespace fixtures;
using harmorph::FaceDistance;
using harmorph::Index;
using harmorph::Vec2;

namespace {

double const pi = std::acos(-1.0);

// Faces over points of their own, as a boundary has them: loops of points.
struct Loops {
    std::vector<double> x, y;
    std::vector<Index> point, marker, loop_start{0};

    void add(std::vector<Point> const& corners) {
        for (Point const p : corners) {
            point.push_back(static_cast<Index>(x.size()));
            marker.push_back(static_cast<Index>(loop_start.size()));
            x.push_back(p.x);
            y.push_back(p.y);
        }
        loop_start.push_back(static_cast<Index>(point.size()));
    }
    harmorph::Points points() const { return {x.data(), y.data(), 1}; }
    harmorph::Boundary boundary() {
        harmorph::Boundary out;
        out.count = static_cast<Index>(point.size());
        out.n_loops = static_cast<Index>(loop_start.size()) - 1;
        out.point = span(point);
        out.marker = span(marker);
        out.loop_start = span(loop_start);
        return out;
    }
};

// A tree in a block of exactly the size that was asked for.
class Tree : public FaceDistance {
public:
    explicit Tree(std::size_t max_faces) {
        harmorph::Arena counting;
        lay_out(counting, max_faces);
        block_.resize(counting.bytes());
        harmorph::Arena placing(block_.data(), block_.size());
        lay_out(placing, max_faces);
        REQUIRE(!placing.overflown());
    }
    explicit Tree(Loops& loops) : Tree(loops.point.size()) {
        choose(loops.boundary(), [](Index) { return true; });
        build(loops.points());
    }
    Tree(Tree const&) = delete;

private:
    std::vector<unsigned char> block_;
};

long double from_segment(Point p, Point a, Point b) {
    long double const ex = static_cast<long double>(b.x) - a.x, ey = static_cast<long double>(b.y) - a.y;
    long double const rx = static_cast<long double>(p.x) - a.x, ry = static_cast<long double>(p.y) - a.y;
    long double const square = ex * ex + ey * ey;
    long double const t = square > 0 ? std::fmin(1.0L, std::fmax(0.0L, (rx * ex + ry * ey) / square)) : 0;
    return std::hypot(rx - t * ex, ry - t * ey);
}

double by_trying_all(Loops const& loops, Point p) {
    long double least = std::numeric_limits<long double>::infinity();
    for (std::size_t loop = 0; loop + 1 < loops.loop_start.size(); ++loop) {
        Index const begin = loops.loop_start[loop], end = loops.loop_start[loop + 1];
        for (Index k = begin; k < end; ++k) {
            std::size_t const a = static_cast<std::size_t>(k);
            std::size_t const b = static_cast<std::size_t>(k + 1 == end ? begin : k + 1);
            least = std::fmin(least, from_segment(p, {loops.x[a], loops.y[a]}, {loops.x[b], loops.y[b]}));
        }
    }
    return static_cast<double>(least);
}

Vec2 vec(Point p) { return {p.x, p.y}; }

std::vector<Point> ellipse(int n, double a, double b, Point centre) {
    std::vector<Point> out;
    for (int k = 0; k < n; ++k) {
        double const angle = 2 * pi * k / n;
        out.push_back({centre.x + a * std::cos(angle), centre.y + b * std::sin(angle)});
    }
    return out;
}

std::vector<double> weights_of(Mesh const& mesh, FaceDistance const& tree, Index quarters,
                               harmorph::Executor const& executor = {}) {
    std::vector<double> k(static_cast<std::size_t>(mesh.n_cells()), -1);
    harmorph::Mesh const its = core_mesh(mesh);
    weigh_cells(tree, its, its.points, quarters, span(k), executor);
    return k;
}

Point barycentre(Mesh const& mesh, Index cell) {
    std::size_t const i = static_cast<std::size_t>(cell);
    Point sum{0, 0};
    for (Index k = mesh.cell_start[i]; k < mesh.cell_start[i + 1]; ++k) {
        Point const p = mesh.point(mesh.cells[static_cast<std::size_t>(k)]);
        sum = {sum.x + p.x, sum.y + p.y};
    }
    double const n = mesh.cell_start[i + 1] - mesh.cell_start[i];
    return {sum.x / n, sum.y / n};
}

// The faces of the mesh that are on a body, in loops.
Loops body_of(Mesh const& mesh) {
    Loops out;
    std::vector<Point> corners;
    for (std::size_t k = 0; k < mesh.face_markers.size(); ++k)
        if (mesh.face_markers[k] == body) corners.push_back(mesh.point(mesh.faces[2 * k]));
    bool const backwards = corners.size() > 1 && mesh.faces[1] == mesh.faces[mesh.faces.size() - 2];
    if (backwards) std::reverse(corners.begin(), corners.end());
    out.add(corners);
    return out;
}

}  // namespace

TEST_CASE("random loops, wherever the point is: the distance of the nearest face") {
    std::mt19937 random(3);
    double worst = 0;
    for (int const n_loops : {1, 2, 9, 70, 600})
        for (int const corners : {3, 8, 17, 64, 520}) {
            if (n_loops * corners > 20000) continue;
            Loops loops;
            for (int loop = 0; loop < n_loops; ++loop) {
                std::vector<Point> its;
                Point const centre{4 * uniform(random), 4 * uniform(random)};
                for (int k = 0; k < corners; ++k)
                    its.push_back({centre.x + (uniform(random) - 0.5), centre.y + (uniform(random) - 0.5)});
                loops.add(its);
            }
            Tree const tree(loops);
            CHECK(tree.count == n_loops * corners);
            for (int trial = 0; trial < 20; ++trial) {
                double const size = trial % 4 == 0 ? 100 : 5;
                Point const p{size * (uniform(random) - 0.5) + 2, size * (uniform(random) - 0.5) + 2};
                worst = std::fmax(worst, std::fabs(tree.distance(vec(p)) - by_trying_all(loops, p)) / size);
            }
        }
    CHECK(worst < 1e-15);
}

TEST_CASE("bodies: within layers that are thin against the faces, far away, and inside") {
    std::mt19937 random(5);
    Loops loops;
    Naca4 naca;
    naca.camber = 0.03;
    loops.add(naca4(naca, 300).points);
    loops.add(ellipse(77, 0.2, 0.03, {1.3, -0.1}));
    loops.add(ellipse(5, 0.01, 0.01, {-0.1, 0.05}));
    Tree const tree(loops);
    for (int trial = 0; trial < 500; ++trial) {
        std::size_t const k = random() % loops.x.size();
        double const height = std::pow(10.0, -7 + 9 * uniform(random)), angle = 2 * pi * uniform(random);
        Point const p{loops.x[k] + height * std::cos(angle), loops.y[k] + height * std::sin(angle)};
        double const expected = by_trying_all(loops, p);
        CHECK(tree.distance(vec(p)) == doctest::Approx(expected).epsilon(1e-14 + 1e-17 / expected));
    }
}

TEST_CASE("ends and degenerate faces: beyond the ends of a face its ends count; no length is a point") {
    Loops line;
    line.add({{0, 0}, {1, 0}});   // there and back
    Tree const tree(line);
    CHECK(tree.distance({3, 0}) == 2);
    CHECK(tree.distance({-0.5, 0}) == 0.5);
    CHECK(tree.distance({4, 4}) == 5);
    CHECK(tree.distance({0.25, -2}) == 2);
    CHECK(tree.distance({0.5, 0}) == 0);

    Loops folded;   // one segment a thousand times, among it faces of no length
    std::vector<Point> points;
    for (int k = 0; k < 500; ++k) points.insert(points.end(), {{0, 0}, {0, 0}, {3, 4}, {3, 4}});
    folded.add(points);
    Tree const many(folded);
    CHECK(many.distance({7, 7}) == 5);
    CHECK(many.distance({-4, 3}) == 5);
    CHECK(many.distance({1.5, 2}) == 0);

    Loops place;
    place.add({{1, 2}, {1, 2}, {1, 2}});
    Tree const single(place);
    CHECK(single.distance({4, 6}) == 5);
    CHECK(single.unit == 0);
    CHECK(Tree(std::size_t{40}).distance({0, 0}) == harmorph::infinity);   // no face chosen
}

TEST_CASE("only the chosen faces count, and moved coordinates count when the tree is built again") {
    Loops loops;
    loops.add(ellipse(100, 1, 1, {0, 0}));
    loops.add(ellipse(37, 1, 1, {10, 0}));
    harmorph::Boundary const boundary = loops.boundary();
    Tree tree(loops.point.size());
    tree.choose(boundary, [&](Index face) { return boundary.marker[face] == 2; });
    tree.build(loops.points());
    CHECK(tree.count == 37);
    double const gap = 10 - std::cos(pi / 37);   // a side is in front
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap));
    for (double& x : loops.x) x += 2;
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap));
    tree.build(loops.points());
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap + 2));
    tree.choose(boundary, [](Index face) { return face == 117; });   // alone: the rest of its group is empty
    tree.build(loops.points());
    long double const alone =
        from_segment({20, 1}, {loops.x[117], loops.y[117]}, {loops.x[118], loops.y[118]});
    CHECK(tree.distance({20, 1}) == doctest::Approx(static_cast<double>(alone)));
}

TEST_CASE("feet: the nearest place, whichever group is tried first, also where two faces are equally near") {
    Loops loops;
    std::vector<Point> stairs;   // corners at whole numbers, so that distances from both faces there are the same to the bit
    for (int k = 0; k < 40; ++k) stairs.insert(stairs.end(), {{1.0 * k, 1.0 * k}, {k + 1.0, 1.0 * k}});
    loops.add(stairs);
    Tree const tree(loops);
    for (int k = 1; k < 39; ++k)
        for (Point const p : {Point{k + 1.25, k - 0.5}, Point{k + 0.375, k - 0.25}, Point{k - 3.0, k + 4.0}}) {
            harmorph::Index group = 0;
            FaceDistance::Foot const expected = tree.foot(vec(p), group);
            Vec2 const at = tree.at(expected, loops.points());
            CHECK(std::hypot(at.x - p.x, at.y - p.y) == doctest::Approx(by_trying_all(loops, p)).epsilon(1e-14));
            for (harmorph::Index guess = 0; guess < tree.groups.count(); ++guess) {
                group = guess;
                FaceDistance::Foot const seen = tree.foot(vec(p), group);
                CHECK(seen.face == expected.face);
                CHECK(seen.t == expected.t);
            }
        }
    harmorph::Index group = 0;
    CHECK(Tree(std::size_t{0}).foot({0, 0}, group).face == harmorph::none);
}

TEST_CASE("scaled by powers of two: the same to the last bit, up to sizes whose squares are no numbers") {
    Loops loops;
    Naca4 naca;
    loops.add(naca4(naca, 60).points);
    Mesh const mesh = o_mesh(naca4(naca, 60), stretched(1e-5, 20, 40));
    Tree const tree(loops);
    std::vector<double> const expected = weights_of(mesh, tree, 6);
    for (int const exponent : {-900, -130, -1, 3, 130, 900}) {
        Loops large = loops;
        Mesh large_mesh = mesh;
        for (std::vector<double>* numbers : {&large.x, &large.y, &large_mesh.x, &large_mesh.y})
            for (double& number : *numbers) number = std::ldexp(number, exponent);
        Tree const its(large);
        CHECK(its.distance({std::ldexp(0.3, exponent), std::ldexp(0.4, exponent)}) ==
              std::ldexp(tree.distance({0.3, 0.4}), exponent));
        CHECK(weights_of(large_mesh, its, 6) == expected);
    }
}

TEST_CASE("moved and turned: the same distances to rounding") {
    std::mt19937 random(8);
    Loops loops;
    loops.add(joukowski(0.1, 0.05, 200).points);
    Tree const tree(loops);
    double const c = std::cos(0.7), s = std::sin(0.7);
    auto const turn = [&](Point p) { return Point{c * p.x - s * p.y + 5, s * p.x + c * p.y - 3}; };
    Loops turned = loops;
    for (std::size_t k = 0; k < loops.x.size(); ++k) {
        Point const p = turn({loops.x[k], loops.y[k]});
        turned.x[k] = p.x;
        turned.y[k] = p.y;
    }
    Tree const its(turned);
    for (int trial = 0; trial < 200; ++trial) {
        Point const p{4 * uniform(random) - 1.5, 4 * uniform(random) - 2};
        CHECK(std::fabs(its.distance(vec(turn(p))) - tree.distance(vec(p))) < 1e-14);
    }
}

TEST_CASE("weights: powers of the distance from the mean of the corners, on all cells") {
    Naca4 naca;
    naca.camber = 0.02;
    HybridOptions options;
    options.radius = 8;
    Mesh const mesh = hybrid_mesh(naca4(naca, 60), options);
    Loops loops = body_of(mesh);
    Tree const tree(loops);
    CHECK(tree.unit <= 1);
    CHECK(tree.unit > 0.49);
    std::vector<double> distance;
    for (Index cell = 0; cell < mesh.n_cells(); ++cell) distance.push_back(by_trying_all(loops, barycentre(mesh, cell)));
    for (Index quarters = 0; quarters <= 16; ++quarters) {
        std::vector<double> const k = weights_of(mesh, tree, quarters);
        double worst = 0;   // in what rounding may do
        for (std::size_t cell = 0; cell < k.size(); ++cell) {
            double const rounding = 1e-14 + quarters * 4e-16 / distance[cell];   // of either barycentre: 3 in 2^-53
            double const fourth = (k[cell] * k[cell]) * (k[cell] * k[cell]);   // times (d / unit)^quarters is 1
            double product = fourth;
            for (Index factor = 0; factor < quarters; ++factor) product *= distance[cell] / tree.unit;
            worst = std::fmax(worst, std::fabs(product - 1) / rounding);
        }
        CHECK(worst < 1);
    }
}

TEST_CASE("weights do not depend on the numbers of cells and points, on threads, or on where loops begin") {
    Naca4 naca;
    Mesh const mesh = o_mesh(naca4(naca, 150), stretched(1e-4, 20, 40), Cells::triangles);
    Loops loops = body_of(mesh);
    Tree const tree(loops);
    std::vector<double> const expected = weights_of(mesh, tree, 6);

    Backwards backwards;
    for (std::int32_t const threads : {2, 5})
        CHECK(weights_of(mesh, tree, 6, {Backwards::run, &backwards, threads}) == expected);
    CHECK(backwards.tasks > 2);

    Mesh mangled = mesh;
    renumber_points(mangled, 4);
    shuffle_cells(mangled, 9);
    std::vector<double> seen = weights_of(mangled, tree, 6), sorted = expected;
    std::sort(seen.begin(), seen.end());
    std::sort(sorted.begin(), sorted.end());
    CHECK(seen == sorted);

    for (std::size_t const shift : {std::size_t{3}, std::size_t{77}}) {
        Loops other = loops;
        std::rotate(other.point.begin(), other.point.begin() + static_cast<std::ptrdiff_t>(shift), other.point.end());
        CHECK(weights_of(mesh, Tree(other), 6) == expected);
    }
    Loops scattered;   // every face a loop of its own there and back, far from its neighbours in the list
    for (std::size_t k = 0; k < loops.x.size(); ++k) {
        std::size_t const a = 37 * k % loops.x.size(), b = (a + 1) % loops.x.size();
        scattered.add({{loops.x[a], loops.y[a]}, {loops.x[b], loops.y[b]}});
    }
    Tree seeds(scattered.point.size());
    seeds.choose(scattered.boundary(), [](Index face) { return face % 2 == 0; });
    seeds.build(scattered.points());
    CHECK(weights_of(mesh, seeds, 6) == expected);
}

TEST_CASE("kernels give the same bits, of distances, feet and weights; images of the faces count as faces do") {
    Naca4 naca;
    naca.camber = 0.02;
    Mesh const ordered = o_mesh(naca4(naca, 150), stretched(1e-4, 20, 40), Cells::hybrid);
    Mesh shuffled = ordered;   // nobody's neighbours follow it
    shuffle_cells(shuffled, 5);
    Loops loops = body_of(ordered);
    loops.add(ellipse(900, 3, 0.5, {4, 6}));   // boxes, too
    Loops twice = loops;   // what the images are of
    Vec2 const shift{0.5, -4.25};
    for (std::size_t loop = 0; loop + 1 < loops.loop_start.size(); ++loop) {
        std::vector<Point> moved;
        for (Index k = loops.loop_start[loop]; k < loops.loop_start[loop + 1]; ++k)
            moved.push_back({loops.x[std::size_t(k)] - shift.x, loops.y[std::size_t(k)] - shift.y});
        twice.add(moved);
    }
    Tree tree(loops), images(loops), copies(twice);
    images.n_images = 1;
    images.image[0] = {{1, 0}, images.inverse_unit * shift};
    std::mt19937 random(6);
    std::vector<Vec2> places;
    for (int k = 0; k < 300; ++k) places.push_back({20 * uniform(random) - 10, 20 * uniform(random) - 10});
    for (Mesh const* mesh : {&ordered, static_cast<Mesh const*>(&shuffled)})
        for (Index const quarters : {1, 6, 16}) {
            std::vector<double> const expected = weights_of(*mesh, tree, quarters),
                                      with_images = weights_of(*mesh, images, quarters);
            std::vector<double> const of_copies = weights_of(*mesh, copies, quarters);
            double const units = std::pow(copies.unit / images.unit, 0.25 * quarters);
            double worst = 0;
            std::size_t nearer = 0;
            for (std::size_t k = 0; k < expected.size(); ++k) {
                worst = std::fmax(worst, std::fabs(units * with_images[k] / of_copies[k] - 1));
                nearer += with_images[k] > expected[k];
                CHECK(with_images[k] >= expected[k]);
            }
            CHECK(worst < 1e-9);
            CHECK(nearer > 0);
            CHECK(nearer < expected.size());
            for (harmorph::Kernel const kernel : usable_kernels()) {
                tree.kernel = images.kernel = kernel;
                CHECK(weights_of(*mesh, tree, quarters) == expected);
                CHECK(weights_of(*mesh, images, quarters) == with_images);
            }
            tree.kernel = images.kernel = harmorph::Kernel::baseline;
        }
    for (Vec2 const place : places) {
        tree.kernel = harmorph::Kernel::baseline;
        Index group = 0;
        FaceDistance::Foot const foot = tree.foot(place, group);
        double const distance = tree.distance(place);
        for (harmorph::Kernel const kernel : usable_kernels()) {
            tree.kernel = kernel;
            Index guess = static_cast<Index>(random() % static_cast<unsigned>(tree.groups.count()));
            FaceDistance::Foot const seen = tree.foot(place, guess);
            CHECK(seen.face == foot.face);
            CHECK(seen.t == foot.t);
            CHECK(guess == group);
            CHECK(tree.distance(place) == distance);
        }
    }
}

TEST_CASE("weights without faces, without extent, and at a distance of 0 are finite") {
    Mesh mesh = square(6, Cells::hybrid);
    for (double const k : weights_of(mesh, Tree(std::size_t{8}), 6)) CHECK(k == 1);
    Loops place;
    place.add({{0.5, 0.5}, {0.5, 0.5}});
    for (double const k : weights_of(mesh, Tree(place), 6)) CHECK(k == 1);
    Loops through;   // the mean of the first cell's corners is on it
    Point const p = barycentre(mesh, 0);
    through.add({{p.x, p.y}, {p.x + 1, p.y}});
    double const k = weights_of(mesh, Tree(through), 16)[0];
    CHECK(k > 1e100);
    CHECK(std::isfinite(k));
    Untrapped const untrapped;
    mesh.x[0] = mesh.y[3] = std::nan("");   // no valid mesh, but no reason to go astray
    CHECK(weights_of(mesh, Tree(through), 6).size() == static_cast<std::size_t>(mesh.n_cells()));
}
