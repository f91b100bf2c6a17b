#include "mesh/locate.hpp"

namespace harmorph {
namespace {

// Points closer to a side than this fraction of the side's length are inside the cell.
constexpr Real rounding = 1e-12;

// Returns the squared distance from a convex cell, which is 0 inside the cell. The nearest side is
// among those that have the point on their outer side.
Real squared_distance(CellShape const& shape, Vec2 point) noexcept {
    Real nearest = infinity;
    bool inside = true;
    for (Index k = 0; k < shape.n; ++k) {
        Vec2 const side = shape.at[k + 1 == shape.n ? 0 : k + 1] - shape.at[k],
                   to_point = point - shape.at[k];
        if (!(cross(side, to_point) < -rounding * square(side))) continue;
        inside = false;
        Real const t = clamp(dot(to_point, side) / square(side), 0.0, 1.0);
        nearest = min(nearest, square(to_point - t * side));
    }
    return inside ? 0 : nearest;
}

Real longest_side(CellShape const& shape) noexcept {
    Real longest = 0;
    for (Index k = 0; k < shape.n; ++k) {
        longest = max(longest, square(shape.at[k + 1 == shape.n ? 0 : k + 1] - shape.at[k]));
    }
    return sqrt(longest);
}

// Adds share times the barycentric coordinates in the triangle of the corners a, b, c to the
// weights of these corners.
void add_barycentric(CellShape const& shape, Vec2 point, Index a, Index b, Index c, Real share,
                     Real* weight) noexcept {
    Vec2 const ab = shape.at[b] - shape.at[a], ac = shape.at[c] - shape.at[a],
               ap = point - shape.at[a];
    Real const twice_area = cross(ab, ac);
    // The area of a valid triangle is not 0, but its rounded product may be.
    if (twice_area == 0) return void(weight[a] += share);
    Real const at_b = cross(ap, ac) / twice_area, at_c = cross(ab, ap) / twice_area;
    weight[a] += share * (1 - at_b - at_c);
    weight[b] += share * at_b;
    weight[c] += share * at_c;
}

bool is_right_of(Vec2 from, Vec2 to, Vec2 point) noexcept {
    return cross(to - from, point - from) < 0;
}

}  // namespace

void weigh_corners(CellShape const& shape, Vec2 point, Real* weight) noexcept {
    if (shape.n == 3) return add_barycentric(shape, point, 0, 1, 2, 1, weight);
    bool const beside_1 = is_right_of(shape.at[0], shape.at[2], point);
    bool const beside_2 = is_right_of(shape.at[1], shape.at[3], point);
    add_barycentric(shape, point, 0, beside_1 ? 1 : 2, beside_1 ? 2 : 3, 0.5, weight);
    add_barycentric(shape, point, 1, beside_2 ? 2 : 3, beside_2 ? 3 : 0, 0.5, weight);
}

void Locator::build(OrientedMesh const& mesh) noexcept {
    cells = mesh;
    tree.set_count(mesh.mesh.n_cells);
    tree.build([&](Index cell) {
        CellShape const corners = shape(cell);
        Box box;
        for (Index k = 0; k < corners.n; ++k) box.include(corners.at[k]);
        return box;
    });
}

Location Locator::locate(Vec2 point, Index hint) const noexcept {
    auto const squared = [&](Index cell) { return squared_distance(shape(cell), point); };
    Nearest start;
    if (hint != none) start = {hint, squared(hint)};
    Nearest const found = tree.nearest(point, start, squared);
    Location out;
    out.cell = found.item;
    out.distance = sqrt(found.squared);
    if (out.cell == none) return out;
    CellShape const corners = shape(out.cell);
    Cell const cell = cells.cell(out.cell);
    out.longest_side = longest_side(corners);
    out.weights.n = cell.n;
    for (Index k = 0; k < cell.n; ++k) out.weights.point[k] = cell.point[k];
    weigh_corners(corners, point, out.weights.weight);
    return out;
}

}  // namespace harmorph
