// A random problem: a mesh of quadrilaterals and triangles in any layout of the header, or of
// polygons; curves, conditions, options.
#pragma once

#include "fixtures/memory.hpp"
#include "blocks.hpp"
#include "curve_arrays.hpp"
#include "input.hpp"

#include <harmorph.h>

#include <array>
#include <memory>
#include <vector>

namespace fuzz {

struct Point {
    double x, y;
};
inline std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }
inline hm_points in(std::vector<Point> const& points) { return {&points[0].x, &points[0].y, 2}; }
inline Point turned(Point p, Point by) {
    return {p.x * by.x - p.y * by.y, p.x * by.y + p.y * by.x};
}
struct Face {
    std::int32_t from, to, marker;
};
using Cell = std::vector<std::int32_t>;  // its points, counted from 0; counter-clockwise

// The domain as a list, whatever the arrays of the mesh look like.
struct Domain {
    std::vector<Point> points;
    std::vector<Cell> cells;
    std::vector<Face> faces;
    std::vector<std::vector<std::int32_t>>
        walls;  // the points of marker 5, 6, ...: a loop each, or marker 5 is a side
    bool walls_are_loops = true;
    bool has_polygons = false;    // given as HM_CELLS_POLYGONS, and judged as those are
    std::int32_t ni = 0, nj = 0;  // if all of its cells are those of a structured mesh

    // Points of the left side (marker 4), and their images on the right one (marker 2): translated,
    // or in a passage of an annulus turned about `centre` by an angle with this cosine and sine.
    struct Image {
        std::int32_t source, at;
    };
    std::vector<Image> images;
    bool is_passage = false;
    Point centre{0, 0}, turn{1, 0};

    std::int32_t interface_sides[2] = {-1, -1};  // markers whose faces may cross each other
};
Domain make_domain(Input& input);

// The arrays of the caller, and the structs that point to them.
struct Problem {
    Domain domain;
    CurveArrays on_walls, along[2];  // along: of markers 2 and 3, if they slide along given curves
    std::vector<double> coordinates, known_u;
    std::vector<std::int32_t> cell_start, cells, quads, faces, face_markers, list_start, lists,
        list_markers, known_points, known_curves;
    std::vector<hm_condition> conditions;
    hm_mesh mesh;
    hm_problem problem;
    Options options;
    hm_executor executor;

    std::int32_t functions() const;                  // of all control points and bodies
    double size() const;                             // the largest coordinate
    void move_to(std::vector<Point> const& points);  // in the arrays of the mesh
};
enum class Cells { triangles_and_quads, polygons };
std::unique_ptr<Problem> make_problem(Input& input, Cells cells = Cells::triangles_and_quads);

// One thing about it is made wrong, or strange. Arrays are never shorter than the counts say: these
// the library trusts.
void break_something(Problem& problem, Input& input);

}  // namespace fuzz
