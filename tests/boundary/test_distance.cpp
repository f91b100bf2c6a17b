// Distances from faces and the nearest places on them, against trying all faces.
#include <fixtures/airfoil.hpp>
#include <fixtures/face_loops.hpp>

using namespace fixtures;
using harmorph::FaceDistance;
using harmorph::Index;
using harmorph::Vec2;

TEST_CASE("the distance is that of the nearest face for random loops and points anywhere") {
    std::mt19937 random(3);
    double worst = 0;
    for (int const n_loops : {1, 2, 9, 70, 600})
        for (int const corners : {3, 8, 17, 64, 520}) {
            if (n_loops * corners > 20000) continue;
            FaceLoops loops;
            for (int loop = 0; loop < n_loops; ++loop) {
                std::vector<Point> loop_points;
                Point const centre{4 * uniform(random), 4 * uniform(random)};
                for (int k = 0; k < corners; ++k)
                    loop_points.push_back(
                        {centre.x + (uniform(random) - 0.5), centre.y + (uniform(random) - 0.5)});
                loops.add(loop_points);
            }
            FaceTree const tree(loops);
            CHECK(tree.count == n_loops * corners);
            for (int trial = 0; trial < 20; ++trial) {
                double const size = trial % 4 == 0 ? 100 : 5;
                Point const p{size * (uniform(random) - 0.5) + 2,
                              size * (uniform(random) - 0.5) + 2};
                worst = std::fmax(
                    worst, std::fabs(tree.distance(vec(p)) - by_trying_all(loops, p)) / size);
            }
        }
    CHECK(worst < 1e-15);
}

TEST_CASE("distances from bodies are right in thin layers, far away and inside") {
    std::mt19937 random(5);
    FaceLoops loops;
    Naca4 naca;
    naca.camber = 0.03;
    loops.add(naca4(naca, 300).points);
    loops.add(ellipse_points(77, 0.2, 0.03, {1.3, -0.1}));
    loops.add(ellipse_points(5, 0.01, 0.01, {-0.1, 0.05}));
    FaceTree const tree(loops);
    for (int trial = 0; trial < 500; ++trial) {
        std::size_t const k = random() % loops.x.size();
        double const height = std::pow(10.0, -7 + 9 * uniform(random)),
                     angle = 2 * pi * uniform(random);
        Point const p{loops.x[k] + height * std::cos(angle), loops.y[k] + height * std::sin(angle)};
        double const expected = by_trying_all(loops, p);
        CHECK(tree.distance(vec(p)) == doctest::Approx(expected).epsilon(1e-14 + 1e-17 / expected));
    }
}

TEST_CASE("beyond a face the distance is that of the end; a face may have no length") {
    FaceLoops line;
    line.add({{0, 0}, {1, 0}});  // there and back
    FaceTree const tree(line);
    CHECK(tree.distance({3, 0}) == 2);
    CHECK(tree.distance({-0.5, 0}) == 0.5);
    CHECK(tree.distance({4, 4}) == 5);
    CHECK(tree.distance({0.25, -2}) == 2);
    CHECK(tree.distance({0.5, 0}) == 0);

    FaceLoops folded;  // one segment a thousand times, among it faces of no length
    std::vector<Point> points;
    for (int k = 0; k < 500; ++k) points.insert(points.end(), {{0, 0}, {0, 0}, {3, 4}, {3, 4}});
    folded.add(points);
    FaceTree const many(folded);
    CHECK(many.distance({7, 7}) == 5);
    CHECK(many.distance({-4, 3}) == 5);
    CHECK(many.distance({1.5, 2}) == 0);

    FaceLoops place;
    place.add({{1, 2}, {1, 2}, {1, 2}});
    FaceTree const single(place);
    CHECK(single.distance({4, 6}) == 5);
    CHECK(single.unit == 0);
    CHECK(FaceTree(std::size_t{40}).distance({0, 0}) == harmorph::infinity);  // no face chosen
}

TEST_CASE("only the chosen faces count, with the coordinates at the time when the tree is built") {
    FaceLoops loops;
    loops.add(ellipse_points(100, 1, 1, {0, 0}));
    loops.add(ellipse_points(37, 1, 1, {10, 0}));
    harmorph::Boundary const boundary = loops.boundary();
    FaceTree tree(loops.point.size());
    tree.choose(boundary, [&](Index face) { return boundary.marker[face] == 2; });
    tree.build(loops.points());
    CHECK(tree.count == 37);
    double const gap = 10 - std::cos(pi / 37);  // a side is in front
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap));
    for (double& x : loops.x) x += 2;
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap));
    tree.build(loops.points());
    CHECK(tree.distance({0, 0}) == doctest::Approx(gap + 2));
    tree.choose(boundary,
                [](Index face) { return face == 117; });  // alone: the rest of its group is empty
    tree.build(loops.points());
    long double const alone =
        from_segment({20, 1}, {loops.x[117], loops.y[117]}, {loops.x[118], loops.y[118]});
    CHECK(tree.distance({20, 1}) == doctest::Approx(double(alone)));
}

TEST_CASE("the foot is the nearest place for any order of groups, also for equal distances") {
    FaceLoops loops;
    // Corners at whole numbers, so that distances from both faces there are the same to the bit.
    std::vector<Point> stairs;
    for (int k = 0; k < 40; ++k)
        stairs.insert(stairs.end(), {{1.0 * k, 1.0 * k}, {k + 1.0, 1.0 * k}});
    loops.add(stairs);
    FaceTree const tree(loops);
    for (int k = 1; k < 39; ++k)
        for (Point const p :
             {Point{k + 1.25, k - 0.5}, Point{k + 0.375, k - 0.25}, Point{k - 3.0, k + 4.0}}) {
            harmorph::Index group = 0;
            FaceDistance::Foot const expected = tree.foot(vec(p), group);
            Vec2 const at = tree.at(expected, loops.points());
            CHECK(std::hypot(at.x - p.x, at.y - p.y) ==
                  doctest::Approx(by_trying_all(loops, p)).epsilon(1e-14));
            for (harmorph::Index guess = 0; guess < tree.groups.count(); ++guess) {
                group = guess;
                FaceDistance::Foot const seen = tree.foot(vec(p), group);
                CHECK(seen.face == expected.face);
                CHECK(seen.t == expected.t);
            }
        }
    harmorph::Index group = 0;
    CHECK(FaceTree(std::size_t{0}).foot({0, 0}, group).face == harmorph::none);
}

TEST_CASE("the box round all faces excludes no point within the reach and all at twice the reach") {
    std::mt19937 random(23);
    for (double const unit : {1e-9, 1.0, 3e7}) {
        CAPTURE(unit);
        FaceLoops loops;
        loops.add(ellipse_points(40, 1.3 * unit, 0.2 * unit, {5 * unit, -3 * unit}));
        loops.add(ellipse_points(9, 0.1 * unit, 0.1 * unit, {7 * unit, -3 * unit}));
        FaceTree const tree(loops);
        int left_out = 0;
        for (int trial = 0; trial < 1000; ++trial) {
            Point const p{unit * (12 * uniform(random) - 1), unit * (8 * uniform(random) - 7)};
            double const distance = by_trying_all(loops, p);
            CHECK(tree.may_reach(vec(p), distance));
            if (!tree.may_reach(vec(p), 0.5 * distance)) ++left_out;
        }
        CHECK(left_out > 300);
        CHECK(tree.may_reach({5 * unit, -3 * unit}, 0));
        CHECK_FALSE(tree.may_reach({9 * unit, -3 * unit}, unit));
    }
}

TEST_CASE("faces that are far too small for the distance of a point are found, too") {
    for (double const size : {1e-90, 1e-30, 0.0}) {
        FaceLoops loops;
        loops.add(ellipse_points(37, size, size, {0, 0}));
        FaceTree const tree(loops);
        for (double const away : {1e40, 1e90, 1e100}) {
            CHECK(tree.distance({-away, 0}) == doctest::Approx(away).epsilon(1e-14));
            Index group = 0;
            FaceDistance::Foot const foot = tree.foot({-away, away}, group);
            CHECK(foot.face >= 0);
            CHECK(foot.face < 37);
        }
    }
}
