// Weights of cells by their distance from faces, against repeated multiplication; scaled meshes,
// threads, kernels.
#include <fixtures/airfoil.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/face_loops.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;
using harmorph::FaceDistance;
using harmorph::Index;
using harmorph::Vec2;

TEST_CASE("scaling by powers of two changes no bit of weights, even where squares overflow") {
    FaceLoops loops;
    Naca4 naca;
    loops.add(naca4(naca, 60).points);
    Mesh const mesh = o_mesh(naca4(naca, 60), stretched(1e-5, 20, 40));
    FaceTree const tree(loops);
    std::vector<double> const expected = weights_of(mesh, tree, 6);
    for (int const exponent : {-900, -130, -1, 3, 130, 900}) {
        FaceLoops large = loops;
        Mesh large_mesh = mesh;
        for (std::vector<double>* numbers : {&large.x, &large.y, &large_mesh.x, &large_mesh.y})
            for (double& number : *numbers) number = std::ldexp(number, exponent);
        FaceTree const large_tree(large);
        CHECK(large_tree.distance({std::ldexp(0.3, exponent), std::ldexp(0.4, exponent)}) ==
              std::ldexp(tree.distance({0.3, 0.4}), exponent));
        CHECK(weights_of(large_mesh, large_tree, 6) == expected);
    }
}

TEST_CASE("weights are powers of the distance from the mean of the corners, on all cells") {
    Naca4 naca;
    naca.camber = 0.02;
    HybridOptions options;
    options.radius = 8;
    Mesh const mesh = hybrid_mesh(naca4(naca, 60), options);
    FaceLoops loops = body_loops(mesh);
    FaceTree const tree(loops);
    CHECK(tree.unit <= 1);
    CHECK(tree.unit > 0.49);
    std::vector<double> distance;
    for (Index cell = 0; cell < mesh.n_cells(); ++cell)
        distance.push_back(by_trying_all(loops, barycentre(mesh, cell)));
    for (Index exponent_quarters = 0; exponent_quarters <= 16; ++exponent_quarters) {
        std::vector<double> const k = weights_of(mesh, tree, exponent_quarters);
        double worst = 0;  // in what rounding may do
        for (std::size_t cell = 0; cell < k.size(); ++cell) {
            double const rounding = 1e-14 + exponent_quarters * 4e-16 /
                                                distance[cell];  // of either barycentre: 3 in 2^-53
            double const fourth =
                (k[cell] * k[cell]) * (k[cell] * k[cell]);  // times (d / unit)^quarters is 1
            double product = fourth;
            for (Index factor = 0; factor < exponent_quarters; ++factor)
                product *= distance[cell] / tree.unit;
            worst = std::fmax(worst, std::fabs(product - 1) / rounding);
        }
        CHECK(worst < 1);
    }
}

TEST_CASE("weights do not depend on numbering, on threads, or on where loops begin") {
    Naca4 naca;
    Mesh const mesh = o_mesh(naca4(naca, 150), stretched(1e-4, 20, 40), Cells::triangles);
    FaceLoops loops = body_loops(mesh);
    FaceTree const tree(loops);
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
        FaceLoops other = loops;
        std::rotate(other.point.begin(), other.point.begin() + static_cast<std::ptrdiff_t>(shift),
                    other.point.end());
        CHECK(weights_of(mesh, FaceTree(other), 6) == expected);
    }
    FaceLoops scattered;  // every face a loop of its own there and back, far from its neighbours in
                          // the list
    for (std::size_t k = 0; k < loops.x.size(); ++k) {
        std::size_t const a = 37 * k % loops.x.size(), b = (a + 1) % loops.x.size();
        scattered.add({{loops.x[a], loops.y[a]}, {loops.x[b], loops.y[b]}});
    }
    FaceTree seeds(scattered.point.size());
    seeds.choose(scattered.boundary(), [](Index face) { return face % 2 == 0; });
    seeds.build(scattered.points());
    CHECK(weights_of(mesh, seeds, 6) == expected);
}

TEST_CASE("all kernels give the same bits, and images of faces count as faces do") {
    Naca4 naca;
    naca.camber = 0.02;
    Mesh const ordered = o_mesh(naca4(naca, 150), stretched(1e-4, 20, 40), Cells::hybrid);
    Mesh shuffled = ordered;  // nobody's neighbours follow it
    shuffle_cells(shuffled, 5);
    FaceLoops loops = body_loops(ordered);
    loops.add(ellipse_points(900, 3, 0.5, {4, 6}));  // boxes, too
    FaceLoops twice = loops;                         // what the images are of
    Vec2 const shift{0.5, -4.25};
    for (std::size_t loop = 0; loop + 1 < loops.loop_start.size(); ++loop) {
        std::vector<Point> moved;
        for (Index k = loops.loop_start[loop]; k < loops.loop_start[loop + 1]; ++k)
            moved.push_back({loops.x[std::size_t(k)] - shift.x, loops.y[std::size_t(k)] - shift.y});
        twice.add(moved);
    }
    FaceTree tree(loops), images(loops), copies(twice);
    images.n_images = 1;
    images.image[0] = {{1, 0}, images.inverse_unit * shift};
    std::mt19937 random(6);
    std::vector<Vec2> places;
    for (int k = 0; k < 300; ++k)
        places.push_back({20 * uniform(random) - 10, 20 * uniform(random) - 10});
    for (Mesh const* mesh : {&ordered, static_cast<Mesh const*>(&shuffled)})
        for (Index const exponent_quarters : {1, 6, 16}) {
            std::vector<double> const expected = weights_of(*mesh, tree, exponent_quarters),
                                      with_images = weights_of(*mesh, images, exponent_quarters);
            std::vector<double> const of_copies = weights_of(*mesh, copies, exponent_quarters);
            double const units = std::pow(copies.unit / images.unit, 0.25 * exponent_quarters);
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
                CHECK(weights_of(*mesh, tree, exponent_quarters) == expected);
                CHECK(weights_of(*mesh, images, exponent_quarters) == with_images);
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
            Index guess = Index(random() % unsigned(tree.groups.count()));
            FaceDistance::Foot const seen = tree.foot(place, guess);
            CHECK(seen.face == foot.face);
            CHECK(seen.t == foot.t);
            CHECK(guess == group);
            CHECK(tree.distance(place) == distance);
        }
    }
}

TEST_CASE("weights without faces, without extent, and at zero distance are finite") {
    Mesh mesh = square(6, Cells::hybrid);
    for (double const k : weights_of(mesh, FaceTree(std::size_t{8}), 6)) CHECK(k == 1);
    FaceLoops place;
    place.add({{0.5, 0.5}, {0.5, 0.5}});
    for (double const k : weights_of(mesh, FaceTree(place), 6)) CHECK(k == 1);
    FaceLoops through;  // the mean of the first cell's corners is on it
    Point const p = barycentre(mesh, 0);
    through.add({{p.x, p.y}, {p.x + 1, p.y}});
    double const k = weights_of(mesh, FaceTree(through), 16)[0];
    CHECK(k > 1e100);
    CHECK(std::isfinite(k));
    Untrapped const untrapped;
    mesh.x[0] = mesh.y[3] = std::nan("");  // no valid mesh, but no reason to go astray
    CHECK(weights_of(mesh, FaceTree(through), 6).size() == std::size_t(mesh.n_cells()));
}
