// Crossings of the boundary, against testing all pairs of faces.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/solved.hpp>

#include "morph/crossing.hpp"

using namespace fixtures;
using harmorph::Crossing;

namespace {

// Closed polygons over points in one array.
struct Polygons {
    std::vector<double> x, y;
    std::vector<std::int32_t> point, loop_start{0};

    void add(std::vector<Point> const& corners) {
        for (Point const p : corners) {
            point.push_back(std::int32_t(x.size()));
            x.push_back(p.x);
            y.push_back(p.y);
        }
        loop_start.push_back(std::int32_t(point.size()));
    }
    Crossing find() const {
        return harmorph::find_crossing({span(point), span(loop_start)}, {x.data(), y.data(), 1});
    }

    Point at(std::int32_t k) const { return {x[std::size_t(k)], y[std::size_t(k)]}; }
    bool crosses(const harmorph::Index* first, const harmorph::Index* second) const {
        Point const a = at(first[0]), b = at(first[1]), c = at(second[0]), d = at(second[1]);
        auto const sides = [](double s, double t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
        return sides(twice_area(a, b, c), twice_area(a, b, d)) &&
               sides(twice_area(c, d, a), twice_area(c, d, b));
    }
    bool any_crossing() const {
        std::vector<std::array<harmorph::Index, 2>> faces;
        for (std::size_t loop = 0; loop + 1 < loop_start.size(); ++loop)
            for (std::int32_t k = loop_start[loop]; k < loop_start[loop + 1]; ++k)
                faces.push_back(
                    {point[std::size_t(k)],
                     point[std::size_t(k + 1 == loop_start[loop + 1] ? loop_start[loop] : k + 1)]});
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (crosses(faces[i].data(), faces[j].data())) return true;
        return false;
    }
    bool has_face(const harmorph::Index* face) const {
        for (std::size_t loop = 0; loop + 1 < loop_start.size(); ++loop)
            for (std::int32_t k = loop_start[loop]; k < loop_start[loop + 1]; ++k) {
                std::int32_t const next = k + 1 == loop_start[loop + 1] ? loop_start[loop] : k + 1;
                if (point[std::size_t(k)] == face[0] && point[std::size_t(next)] == face[1])
                    return true;
            }
        return false;
    }
};

// A part of a circle, closed by a chord.
std::vector<Point> circle(int n, double r, Point centre, double wobble = 0, unsigned seed = 1,
                          double part = 1) {
    std::mt19937 random(seed);
    std::vector<Point> out;
    for (int k = 0; k < n; ++k) {
        double const angle = 2 * pi * part * k / n,
                     radius = r * (1 + wobble * (2 * uniform(random) - 1));
        out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return out;
}

// Checks loops that are turned and scaled by whole numbers, so that coordinates stay exact, and
// that begin at any point of the first loop.
void check_turned(std::vector<std::vector<Point>> const& loops, bool cross) {
    for (Complex const by : {Complex(1, 0), Complex(0, 1), Complex(3, 4), Complex(-1, 2)})
        for (std::size_t start = 0; start < loops[0].size(); ++start) {
            Polygons polygons;
            for (std::vector<Point> const& loop : loops) {
                std::vector<Point> turned;
                for (std::size_t k = 0; k < loop.size(); ++k) {
                    Point const p = loop[(k + start) % loop.size()];
                    Complex const z = Complex(p.x, p.y) * by;
                    turned.push_back({z.real(), z.imag()});
                }
                polygons.add(turned);
            }
            Crossing const found = polygons.find();
            CHECK(found.found == cross);
            if (found.found) {
                CHECK(polygons.has_face(found.first));
                CHECK(polygons.has_face(found.second));
            }
        }
}

}  // namespace

TEST_CASE("random polygons cross if and only if a pair of faces crosses, which is named") {
    int crossed = 0, clear = 0;
    std::mt19937 random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        Polygons polygons;
        int const loops = 1 + int(random() % 4);
        for (int loop = 0; loop < loops; ++loop) {
            int const n = 3 + int(random() % 40);
            double const wobble = trial % 2 == 0 ? 0.3 : 0, part = random() % 2 == 0 ? 1 : 0.5;
            Point const centre{4 * uniform(random), 4 * uniform(random)};
            std::vector<Point> corners =
                circle(n, 0.5, centre, wobble, static_cast<unsigned>(trial), part);
            if (random() % 8 == 0) {  // one point far out of place, or nearly
                Point& moved = corners[random() % corners.size()];
                moved.x += 0.7 * (2 * uniform(random) - 1);
                moved.y += 0.7 * (2 * uniform(random) - 1);
            }
            polygons.add(corners);
        }
        Crossing const found = polygons.find();
        bool const expected = polygons.any_crossing();
        CHECK(found.found == expected);
        if (found.found) {
            CHECK(polygons.crosses(found.first, found.second));
            CHECK(polygons.has_face(found.first));
            CHECK(polygons.has_face(found.second));
        } else {
            CHECK(found.first[0] == -1);
            CHECK(found.second[1] == -1);
        }
        ++(expected ? crossed : clear);
    }
    CHECK(crossed > 300);
    CHECK(clear > 300);
}

TEST_CASE("touching is not crossing") {
    Polygons corner;  // corner on side, corner on corner
    corner.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    corner.add({{1, 0.5}, {2, 0}, {2, 1}});
    corner.add({{0, 0}, {-1, 0}, {-1, -1}});
    corner.add({{0.5, 1}, {0.75, 2}, {0.25, 2}});
    CHECK(!corner.find().found);
    Polygons twice;  // a bow-tie boundary passes its point twice
    twice.x = {0, 1, 0, -1, -1};
    twice.y = {0, 1, 1, 0, -1};
    twice.point = {0, 1, 2, 0, 3, 4};
    twice.loop_start = {0, 6};
    CHECK(!twice.find().found);
}

TEST_CASE("faces that lie on each other cross in any order and orientation") {
    struct {
        std::vector<Point> first, second;
        bool cross;
    } const all[] = {
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
         {{1, 4}, {3, 4}, {2, 6}},
         true},  // a side on a part of a side
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
         {{3, 4}, {5, 4}, {5, 6}, {3, 6}},
         true},  // sides on parts of each other
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 0}, {3, 0}, {3, 2}, {1, 2}}, true},  // from inside
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
         {{2, 2}, {2, 4}, {3, 4}, {3, 6}, {1, 6}, {1, 2}},
         true},  // and through it
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
         {{4, 4}, {8, 4}, {8, 8}},
         false},  // on one line, end to end
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{5, 4}, {8, 4}, {8, 8}}, false},  // on one line, apart
        {{{0, 0}, {4, 0}, {2, 0}, {2, 4}},
         {{9, 9}, {10, 9}, {9, 10}},
         true},  // folded back by half
        {{{0, 0}, {2, 0}, {4, 0}, {1, 0}, {0, 4}},
         {{9, 9}, {10, 9}, {9, 10}},
         true},  // by one and a half
        {{{0, 0}, {1, 0}, {3, 0}, {1, 0}},
         {{9, 9}, {10, 9}, {9, 10}},
         false}};  // a plate without thickness
    for (auto const& pair : all) check_turned({pair.first, pair.second}, pair.cross);
}

TEST_CASE("walls that came together cross, but the two sides of one wall do not") {
    // The mesh is on the left: bodies run clockwise, what is round the mesh runs counter-clockwise.
    struct {
        const char* name;
        std::vector<std::vector<Point>> loops;
        bool cross;
    } const all[] = {
        {"two bodies, by one side",
         {{{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {{4, 0}, {4, 4}, {8, 4}, {8, 0}}},
         true},
        {"by three faces, round a corner",
         {{{0, 0}, {0, 4}, {2, 4}, {4, 4}, {4, 0}},
          {{4, 0}, {4, 4}, {2, 4}, {0, 4}, {0, 6}, {8, 6}, {8, 0}}},
         true},
        {"one fills the gap of the other",
         {{{0, 0}, {0, 4}, {2, 4}, {2, 2}, {4, 2}, {4, 4}, {6, 4}, {6, 0}},
          {{2, 4}, {4, 4}, {4, 2}, {2, 2}}},
         true},
        {"a body on the channel's wall",
         {{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {6, 6}, {0, 6}}, {{2, 0}, {2, 2}, {4, 2}, {4, 0}}},
         true},
        {"a slot that closed from the outside",
         {{{0, 0}, {0, 6}, {2, 6}, {2, 4}, {1, 2}, {3, 2}, {2, 4}, {2, 6}, {4, 6}, {4, 0}}},
         true},
        {"two meshes with a wall between",
         {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{4, 0}, {8, 0}, {8, 4}, {4, 4}}},
         false},
        {"one mesh inside a closed wall, one outside",
         {{{0, 0}, {4, 0}, {2, 4}}, {{0, 0}, {2, 4}, {4, 0}}},
         false},
        {"a plate", {{{0, 0}, {1, 0}, {3, 0}, {4, 1}, {3, 0}, {1, 0}}}, false},
        {"a body with a thin tail",
         {{{0, 0}, {-1, -2}, {-2, 0}, {-1, 2}, {0, 0}, {3, 0}, {5, 1}, {3, 0}}},
         false},
        {"a fin on the channel's wall",
         {{{0, 0}, {3, 0}, {3, 2}, {3, 4}, {3, 2}, {3, 0}, {6, 0}, {6, 6}, {0, 6}}},
         false},
        {"a plate from one wall of the channel to the body inside",
         {{{0, 0},
           {6, 0},
           {6, 9},
           {3, 9},
           {3, 7},
           {3, 6},
           {5, 4},
           {1, 4},
           {3, 6},
           {3, 7},
           {3, 9},
           {0, 9}}},
         false},
        {"a plate through the channel",
         {{{0, 0}, {6, 0}, {6, 3}, {2, 3}, {0, 3}}, {{0, 3}, {2, 3}, {6, 3}, {6, 6}, {0, 6}}},
         false}};
    for (auto const& one : all) {
        INFO(std::string(one.name));
        check_turned(one.loops, one.cross);
    }
}

TEST_CASE("a point beside a line by the last bit is beside it") {
    for (double const off : {0.0, 1.0, -1.0}) {
        Polygons polygons;  // the line y = x / 3 from 0 to 9, and a face that lies on it, but for
                            // one end
        polygons.add({{0, 0}, {9, 3}, {9, 9}});
        double const y = std::nextafter(2.0, 2 + off);
        polygons.add({{3, 1}, {6, y}, {6, -5}, {3, -5}});
        CHECK(polygons.find().found ==
              (off == 0 || off > 0));  // on it, through it, or touching it from outside
    }
}

TEST_CASE("a boundary that passes exactly through points has crossed, wherever its loops begin") {
    for (int const steps : {1, 2, 3, 4}) {  // of the square's sides: the bar passes through points
                                            // of it, or through faces
        for (double const turn :
             {0.0, 0.5}) {  // a rotation by a power of i keeps coordinates exact
            std::vector<Point> square, bar = {{1, 1}, {6, 1}, {6, 3}, {1, 3}};
            Point const corners[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
            for (int side = 0; side < 4; ++side)
                for (int k = 0; k < steps; ++k) {
                    Point const a = corners[side], b = corners[(side + 1) % 4];
                    square.push_back(
                        {a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps});
                }
            for (std::vector<Point>* polygon : {&square, &bar})
                for (Point& p : *polygon)
                    if (turn > 0) p = {-p.y, p.x};
            for (std::size_t first = 0; first < 4; ++first) {
                std::rotate(bar.begin(), bar.begin() + 1, bar.end());
                Polygons polygons;
                polygons.add(square);
                polygons.add(bar);
                CHECK(polygons.find().found);
            }
        }
    }
    Polygons corners;  // a diamond whose corner is the other's corner, and goes on inside it
    corners.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    corners.add({{2, 2}, {3, 1}, {1, 1}});
    CHECK(corners.find().found);
    Polygons beside;  // the same corner, passed by outside
    beside.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    beside.add({{2, 2}, {4, 1}, {4, 4}});
    CHECK(!beside.find().found);
}

TEST_CASE("a figure of eight, and a body that enters another") {
    Polygons eight;
    eight.add({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
    CHECK(eight.find().found);
    Polygons bodies;
    bodies.add(circle(200, 1, {0, 0}));
    bodies.add(circle(150, 1, {2.001, 0}));
    CHECK(!bodies.find().found);
    bodies.add(circle(100, 0.3, {0.2, 0.1}));  // inside the first: crosses nothing
    CHECK(!bodies.find().found);
    bodies.add(circle(100, 0.3, {0.8, 0.1}));
    CHECK(bodies.find().found);
}

TEST_CASE("boundaries of valid meshes do not cross, but a wall pushed through another one does") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = airfoil_case(40, 12, kind);
        Solved const solved(setup);
        hm_mesh const mesh = setup.mesh.view();
        hm_quality_report report = quality_of(solved.basis, mesh, setup.mesh);
        CHECK(report.self_crossing == 0);
        for (std::int32_t const point : report.crossing_points) CHECK(point == -1);
        Mesh crossed = setup.mesh;
        for (std::size_t k = 10; k < 20; ++k) crossed.y[k] -= 0.2;  // on the upper side
        report = quality_of(solved.basis, mesh, crossed);
        CHECK(report.self_crossing == 1);
        for (std::int32_t const point : report.crossing_points) {
            CHECK(point >= 0);
            CHECK(point < 80);
        }
    }
}

TEST_CASE("the only pair of bodies that overlaps is found among many bodies") {
    for (bool const overlap : {false, true}) {
        Polygons polygons;
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 20; ++j)
                polygons.add(
                    circle(12, 0.3, {1.0 * i - (overlap && i == 19 && j == 7 ? 0.5 : 0), 1.0 * j}));
        CHECK(polygons.find().found == overlap);
    }
}

TEST_CASE(
    "points in one place cross nothing, and a loop that is folded onto a line lies on itself") {
    Polygons collapsed, folded;
    collapsed.add(std::vector<Point>(3000, Point{0.5, -0.25}));
    CHECK(!collapsed.find().found);
    std::vector<Point> line;
    for (int k = 0; k < 3000; ++k) line.push_back({std::cos(2 * pi * k / 3000), 0.125});
    folded.add(line);
    CHECK(folded.find().found);  // faces lie on each other
    CHECK(!harmorph::find_crossing({span(folded.point), span(folded.loop_start)},
                                   {folded.x.data(), folded.y.data(), 1}, {},
                                   harmorph::Overlaps::ignored)
               .found);
}
