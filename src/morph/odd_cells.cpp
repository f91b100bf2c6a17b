#include "morph/odd_cells.hpp"

#include "base/vec2.hpp"

namespace harmorph {
namespace {

// Sines, areas and sides below these numbers count as 0, so that no quotient overflows.
constexpr Real min_sine = 1e-100, min_area = 1e-280, min_side = 1e-140;

// A corner of a cell: three points, and the sides into and out of the corner. The first side has
// been rotated back, as guards require.
struct OddCorner {
    Index point[3];
    Vec2 rotation;
    Vec2 in, out;

    Real twice_area() const noexcept { return cross(in, out); }
    void add(Vec2 by_in, Vec2 by_out, PointGradient const& gradient) const noexcept {
        Vec2 const by_first = product(rotation, by_in);
        gradient.add(point[0], -1 * by_first);
        gradient.add(point[1], by_first - by_out);
        gradient.add(point[2], by_out);
    }
    void add_area_slope(Real scale, PointGradient const& gradient) const noexcept {
        add(scale * Vec2{out.y, -out.x}, scale * Vec2{-in.y, in.x}, gradient);
    }
};

// The angle of a corner, by which the directions of its sides differ; 0 if a side is too short.
struct OddAngle {
    Real per_in = 0, per_out = 0;  // 1 / length
    Vec2 in, out;                  // directions
    Real sine = 0;

    explicit OddAngle(OddCorner const& corner) noexcept {
        Real const long_in = length(corner.in), long_out = length(corner.out);
        if (!(long_in > min_side) || !(long_out > min_side)) return;
        per_in = 1 / long_in;
        per_out = 1 / long_out;
        in = per_in * corner.in;
        out = per_out * corner.out;
        sine = cross(in, out);
    }
    Real cosine() const noexcept { return dot(in, out); }
    // Adds the derivative of the angle, multiplied by `scale`.
    void add_slope(OddCorner const& corner, Real scale,
                   PointGradient const& gradient) const noexcept {
        corner.add(-scale * per_in * left_of(in), scale * per_out * left_of(out), gradient);
    }
};

OddCorner corner_of(Cell const& cell, CellShape const& shape, Index k, Vec2 rotation) noexcept {
    Index const n = cell.n, before = k == 0 ? n - 1 : k - 1, behind = k + 1 == n ? 0 : k + 1;
    return {{cell.point[before], cell.point[k], cell.point[behind]},
            rotation,
            shape.at[k] - shape.at[before],
            shape.at[behind] - shape.at[k]};
}

}  // namespace

bool OddCell::is_triangle() const noexcept {
    IndexRange const pieces = cells_.mesh.pieces_of(number_);
    return pieces.count() == 1 && cells_.cell(pieces.first).n == 3;
}

// Calls visit(corner, whether it counts in the quality) for the corners of a quadrilateral, or for
// the guards of a polygon.
template <class Visit>
void OddCell::for_each_corner(Points points, Visit const& visit) const noexcept {
    IndexRange const pieces = cells_.mesh.pieces_of(number_);
    if (pieces.count() == 1) {
        Cell const cell = cells_.cell(pieces.first);
        CellShape const shape(cell, points, false);
        for (Index k = 0; k < cell.n; ++k) visit(corner_of(cell, shape, k, {1, 0}), true);
        return;
    }
    for (Index const guard : cells_.mesh.guards_of(number_)) {
        bool const is_convex =
            cells_.mesh.guard_kind[guard - cells_.mesh.n_cells] == CornerKind::convex;
        visit(corner_of(cells_.cell(guard), shape_of(cells_, guard, points), 1,
                        rotation_of(cells_.mesh, guard)),
              is_convex);
    }
}

// Calls visit(corner) for one corner of each triangle of the cell, or for two opposite corners of a
// quadrilateral: the area of the cell is half the sum of twice_area() of these corners.
template <class Visit>
void OddCell::for_each_piece(Points points, Visit const& visit) const noexcept {
    for (Index const piece : cells_.mesh.pieces_of(number_)) {
        Cell const cell = cells_.cell(piece);
        CellShape const shape(cell, points, false);
        visit(corner_of(cell, shape, 1, {1, 0}));
        if (cell.n == 4) visit(corner_of(cell, shape, 3, {1, 0}));
    }
}

Real OddCell::area(Points points) const noexcept {
    Real twice = 0;
    for_each_piece(points, [&](OddCorner const& corner) { twice += corner.twice_area(); });
    return 0.5 * twice;
}

void OddCell::add_area_slopes(Real scale, PointGradient const& gradient) const noexcept {
    for_each_piece(at_,
                   [&](OddCorner const& corner) { corner.add_area_slope(0.5 * scale, gradient); });
}

OddCell::Skew OddCell::skew(Points points) const noexcept {
    Skew skew;
    if (is_triangle()) {
        Cell const cell = cells_.cell(cells_.mesh.pieces_of(number_).first);
        CellCorners const corners(CellShape(cell, points, false));
        for (Index k = 0; k < 3; ++k) skew.sum += square(corners.side[k]);
        skew.factor = 2 * 1.7320508075688772 * corners.twice_area[0];
        skew.is_inverted = !(corners.twice_area[0] > min_area);
        if (skew.sum > min_area) skew.value = skew.factor / skew.sum;
        return skew;
    }
    Index m = 0;
    Real negative = 0;
    for_each_corner(points, [&](OddCorner const& corner, bool counts) {
        Real const sine = OddAngle(corner).sine;
        if (!(sine > min_sine)) {
            skew.is_inverted = true;
            negative += min(sine, 0.0);
        } else if (counts) {
            skew.sum += 1 / sine;
            ++m;
        }
    });
    bool const is_quad = cells_.mesh.pieces_of(number_).count() == 1;
    for_each_piece(points, [&](OddCorner const& corner) {
        if (!is_quad && !(corner.twice_area() > min_area)) skew.is_inverted = true;
    });
    if (skew.is_inverted) {
        skew.value = 4 * negative;
    } else if (m < 3) {
        skew.value = 1;
        skew.factor = skew.sum = 0;
    } else {
        skew.factor = is_quad ? 4 : m / sine_of_pi(2.0 / m);
        skew.value = skew.factor / skew.sum;
    }
    return skew;
}

void OddCell::add_skew_slopes(Skew const& skew, Real scale,
                              PointGradient const& gradient) const noexcept {
    if (is_triangle()) {
        if (!(skew.sum > min_area)) return;
        Cell const cell = cells_.cell(cells_.mesh.pieces_of(number_).first);
        CellShape const shape(cell, at_, false);
        corner_of(cell, shape, 1, {1, 0})
            .add_area_slope(scale * (2 * 1.7320508075688772) / skew.sum, gradient);
        Real const by_squares = -2 * scale * skew.value / skew.sum;
        for (Index k = 0; k < 3; ++k) {
            Vec2 const by_side = by_squares * (shape.at[k + 1] - shape.at[k]);
            gradient.add(cell.point[k], -1 * by_side);
            gradient.add(cell.point[k == 2 ? 0 : k + 1], by_side);
        }
        return;
    }
    // f = factor / sum of 1 / sin t changes by f^2 / factor * cos t / sin^2 t dt.
    for_each_corner(at_, [&](OddCorner const& corner, bool counts) {
        OddAngle const angle(corner);
        if (skew.is_inverted) {
            if (angle.sine < 0) angle.add_slope(corner, 4 * scale * angle.cosine(), gradient);
        } else if (counts && skew.sum > 0) {
            Real const part = skew.value / angle.sine;
            angle.add_slope(corner, scale * part * part / skew.factor * angle.cosine(), gradient);
        }
    });
}

void OddCell::add_quality(bool kept, SmoothMinimum& minimum,
                          PointGradient const& gradient) const noexcept {
    Skew const now = skew(at_);
    Real const per_start = kept ? 1 / skew(start_).value : 1;
    if (now.is_inverted) {
        Real const weight = minimum.add(now.value * per_start, number_);
        if (gradient.wanted()) add_skew_slopes(now, weight * per_start, gradient);
        return;
    }
    // s(t) = s(1/t), so that the larger area divides the smaller one.
    Real const a = area(at_), b = area(start_), t = a < b ? a / b : b / a;
    Real const size = sqrt(2 * t / (1 + t * t));
    Real const by_area = 0.5 * size * (1 - t) * (1 + t) / (1 + t * t) * (a < b ? 1 : -1) / a;
    Real const weight = minimum.add(now.value * size * per_start, number_);
    if (!gradient.wanted()) return;
    add_skew_slopes(now, weight * size * per_start, gradient);
    add_area_slopes(weight * now.value * per_start * by_area, gradient);
}

void OddCell::add_areas(SmoothMinimum& minimum, PointGradient const& gradient) const noexcept {
    auto const add = [&](Index i, Index k) {
        Cell const cell = cells_.cell(i);
        OddCorner const corner =
            corner_of(cell, shape_of(cells_, i, at_), k, rotation_of(cells_.mesh, i));
        CellShape const start = shape_of(cells_, i, start_);
        Real const before = corner_of(cell, start, k, {1, 0}).twice_area();
        Real const weight = minimum.add(corner.twice_area() / before, number_);
        if (gradient.wanted()) corner.add_area_slope(weight / before, gradient);
    };
    for (Index const piece : cells_.mesh.pieces_of(number_)) {
        bool const is_quad = cells_.cell(piece).n == 4;
        for (Index k = is_quad ? 0 : 1; k < (is_quad ? 4 : 2); ++k) add(piece, k);
    }
    for (Index const guard : cells_.mesh.guards_of(number_)) add(guard, 1);
}

}  // namespace harmorph
