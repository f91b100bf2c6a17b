// The linear map that deforms a corner of a cell, and derivatives of energies of that map by the
// two sides of the corner.
#pragma once

#include "base/vec2.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// An entry of a Hessian by points. The numbers are in rows: (a, b) is the first row, (c, d) the
// second.
struct Block {
    Real a = 0, b = 0, c = 0, d = 0;

    constexpr Vec2 operator*(Vec2 v) const noexcept {
        return {a * v.x + b * v.y, c * v.x + d * v.y};
    }
    // Adds curvature * u v^T.
    constexpr void add(Real curvature, Vec2 u, Vec2 v) noexcept {
        a += curvature * u.x * v.x;
        b += curvature * u.x * v.y;
        c += curvature * u.y * v.x;
        d += curvature * u.y * v.y;
    }
};

constexpr Block operator+(Block p, Block q) noexcept {
    return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d};
}
constexpr Block operator-(Block p, Block q) noexcept {
    return {p.a - q.a, p.b - q.b, p.c - q.c, p.d - q.d};
}
constexpr Block transpose(Block p) noexcept { return {p.a, p.c, p.b, p.d}; }

// Returns the block that maps v, as a complex number, to t v + c conj(v). The block is symmetric if
// t is real.
constexpr Block complex_block(Vec2 t, Vec2 c) noexcept {
    return {t.x + c.x, c.y - t.y, c.y + t.y, t.x - c.x};
}

// For a block that is a sum of products u v^T, these functions return the block in which each u, or
// each v, is rotated, which is a multiplication by a complex number.
constexpr Block rotated_rows(Vec2 rotation, Block p) noexcept {
    Vec2 const first = product(rotation, {p.a, p.c}), second = product(rotation, {p.b, p.d});
    return {first.x, second.x, first.y, second.y};
}
constexpr Block rotated_columns(Vec2 rotation, Block p) noexcept {
    return transpose(rotated_rows(rotation, transpose(p)));
}

// The gradient and the Hessian of the energy of a corner with the points p0, p1, p2, by the sides
// p1 - p0 and p2 - p1: fewer numbers than the derivatives by the three points.
struct CornerForm {
    Vec2 by_side, by_next;
    // The Hessian, by the first and by the second side.
    Block side_side, side_next, next_next;

    // Converts derivatives by a side that is rotated into derivatives by the side itself.
    void rotate_side_back(Vec2 rotation) noexcept {
        if (rotation.x == 1) return;
        by_side = product(rotation, by_side);
        side_side = rotated_columns(rotation, rotated_rows(rotation, side_side));
        side_next = rotated_rows(rotation, side_next);
    }
};

// The gradient and the Hessian of the energy of one cell by the points of the cell, summed from
// those of the corners.

// The derivatives of the energy of a cell with n points; the Hessian is symmetric.
template <Index n>
struct CellForm {
    static constexpr Index count = n;
    Vec2 by[n];
    Block hessian[n][n];
    // The gradient of the energy is slope * by; see also NewtonSystem::border.
    Real slope = 1, curvature = 0;

    // Adds the derivatives of the corner at point `own`, the sides of which go from point `before`
    // to point `own` and from there to point `after`.
    void add(Index before, Index own, Index after, CornerForm const& corner) noexcept {
        by[before] = by[before] - corner.by_side;
        by[own] = by[own] + (corner.by_side - corner.by_next);
        by[after] = by[after] + corner.by_next;
        Block const cross = corner.side_next, rotated = transpose(cross);
        Block const side = corner.side_side, next = corner.next_next;
        hessian[before][before] = hessian[before][before] + side;
        hessian[before][own] = hessian[before][own] + (cross - side);
        hessian[before][after] = hessian[before][after] - cross;
        hessian[own][before] = hessian[own][before] + (rotated - side);
        hessian[own][own] = hessian[own][own] + (side - (cross + rotated) + next);
        hessian[own][after] = hessian[own][after] + (cross - next);
        hessian[after][before] = hessian[after][before] - rotated;
        hessian[after][own] = hessian[after][own] + (rotated - next);
        hessian[after][after] = hessian[after][after] + next;
    }
    // Converts derivatives by points into derivatives by the unknowns that move the points; see
    // Tangle::rotation.
    void rotate_back(Span<const Vec2> rotation, Cell const& cell) noexcept {
        for (Index own = 0; own < n; ++own) {
            Vec2 const back = conjugate(rotation[cell.point[own]]);
            by[own] = product(back, by[own]);
            for (Index other = 0; other < n; ++other) {
                hessian[own][other] = rotated_rows(back, hessian[own][other]);
                hessian[other][own] = rotated_columns(back, hessian[other][own]);
            }
        }
    }
};

// A triangle of three points. The second point is the corner of the cell that the triangle
// represents.
struct Triangle {
    Vec2 at[3];

    constexpr Real twice_area() const noexcept { return cross(at[1] - at[0], at[2] - at[1]); }
};

// The sizes of a map J with p and q as in CornerMap: energies of corners are functions of these.
struct MapSizes {
    Real determinant;  // p - q
    Real s;            // p + q = |J|^2 / 2
    Real twice_area;   // of the reference triangle
};

// The derivatives of an energy by p = |z|^2 and q = |w|^2.
struct DensityDerivatives {
    Real by_p, by_q, by_pp, by_qq, by_pq;
    Real unit;  // the curvature that the lower bound of curvatures is measured in
};

// The Hessian of an energy by z and w in its own axes: rotating z, rotating w, and the two changes
// of |z| and |w| along (cos a, sin a) and (-sin a, cos a).
struct Curvatures {
    Real value[4];
    Real cosine = 1, sine = 0;  // of 2 a
};

constexpr Vec2 times_i(Vec2 a) noexcept { return {-a.y, a.x}; }
constexpr Vec2 direction_or_x(Vec2 a, Real size) noexcept {
    return size > 0 ? 1 / size * a : Vec2{1, 0};
}

// The linear map J from the reference triangle to another one, in complex numbers: J dX = z dX + w
// conj(dX), so that |J|^2 = 2 p + 2 q and det J = p - q with p = |z|^2 and q = |w|^2. An energy
// that does not change when either triangle rotates is a function of p and q.
class CornerMap {
public:
    explicit CornerMap(Triangle const& reference) noexcept;

    Real twice_area() const noexcept { return twice_area_; }  // of the reference triangle
    Real determinant(Triangle const& now) const noexcept { return now.twice_area() / twice_area_; }
    Vec2 z(Triangle const& now) const noexcept {
        return product(first_, now.at[1] - now.at[0]) + product(second_, now.at[2] - now.at[1]);
    }
    Vec2 w(Triangle const& now) const noexcept {
        return product(conjugate(first_), now.at[1] - now.at[0]) +
               product(conjugate(second_), now.at[2] - now.at[1]);
    }
    MapSizes sizes(Triangle const& now) const noexcept {
        return {determinant(now), square(z(now)) + square(w(now)), twice_area_};
    }
    // Finds the Hessian of the energy by z and w, with curvatures raised to `min_curvature` units.
    Curvatures curvatures(Triangle const& now, DensityDerivatives const& by,
                          Real min_curvature) const noexcept;
    // Adds the derivatives by the sides now.at[1] - now.at[0] and now.at[2] - now.at[1] to `form`,
    // with curvatures raised to `min_curvature` units.
    void differentiate(Triangle const& now, DensityDerivatives const& by, Real min_curvature,
                       CornerForm& form) const noexcept;

private:
    Vec2 first_, second_;  // z = first_ * (at[1] - at[0]) + second_ * (at[2] - at[1]); w the same
                           // with their conjugates
    Real twice_area_;
};

inline CornerMap::CornerMap(Triangle const& reference) noexcept
    : twice_area_(reference.twice_area()) {
    Vec2 const side = reference.at[1] - reference.at[0], next = reference.at[2] - reference.at[1];
    Real const half = 0.5 / twice_area_;
    first_ = half * times_i(conjugate(next));
    second_ = -half * times_i(conjugate(side));
}

// Rotating z or w changes neither p nor q, and scaling couples the two.
inline Curvatures CornerMap::curvatures(Triangle const& now, DensityDerivatives const& by,
                                        Real min_curvature) const noexcept {
    Real const p = square(z(now)), q = square(w(now));
    Real const a = 2 * by.by_p + 4 * p * by.by_pp, b = 4 * sqrt(p) * sqrt(q) * by.by_pq,
               c = 2 * by.by_q + 4 * q * by.by_qq;
    Real const mean = 0.5 * (a + c), whole = 0.5 * (a - c);
    // Derivatives of cells that have nearly collapsed are so large that their squares would
    // overflow.
    bool const is_large = max(abs(whole), abs(b)) > 0x1p500;
    Real const unit = is_large ? 0x1p512 : 1, per_unit = is_large ? 0x1p-512 : 1;
    Real const half = per_unit * whole, part = per_unit * b,
               radius = sqrt(half * half + part * part);
    Curvatures out{{2 * by.by_p, 2 * by.by_q, mean + unit * radius, mean - unit * radius}};
    for (Real& value : out.value) value = max(value, min_curvature * by.unit);
    if (radius > 0) {
        Real const per_radius = 1 / radius;
        out.cosine = per_radius * half;
        out.sine = per_radius * part;
    }
    return out;
}

// With the changes s and n of the two sides, and with f = first_ and g = second_, z changes by f s
// + g n, and w by conj(f) s + conj(g) n. The Hessian by z maps v to a v + b conj(v), as do its
// other parts (see complex_block()); a product with such a map from both sides is one again.
inline void CornerMap::differentiate(Triangle const& now, DensityDerivatives const& by,
                                     Real min_curvature, CornerForm& form) const noexcept {
    Vec2 const f = first_, g = second_, conj_f = conjugate(f), conj_g = conjugate(g);
    Vec2 const z_now = z(now), w_now = w(now);
    Vec2 const by_z = 2 * by.by_p * z_now, by_w = 2 * by.by_q * w_now;
    form.by_side = form.by_side + product(conj_f, by_z) + product(f, by_w);
    form.by_next = form.by_next + product(conj_g, by_z) + product(g, by_w);

    Curvatures const hessian = curvatures(now, by, min_curvature);
    Real const mean = 0.5 * (hessian.value[2] + hessian.value[3]),
               difference = 0.5 * (hessian.value[2] - hessian.value[3]);
    Real const scaling_z = mean + difference * hessian.cosine,
               scaling_w = mean - difference * hessian.cosine,
               coupling = 0.5 * difference * hessian.sine;
    Vec2 const along_z = direction_or_x(z_now, length(z_now)),
               along_w = direction_or_x(w_now, length(w_now));
    Real const a_z = 0.5 * (scaling_z + hessian.value[0]),
               a_w = 0.5 * (scaling_w + hessian.value[1]);
    Vec2 const b_z = 0.5 * (scaling_z - hessian.value[0]) * product(along_z, along_z);
    Vec2 const b_w = 0.5 * (scaling_w - hessian.value[1]) * product(along_w, along_w);
    Vec2 const a_zw = coupling * product(along_z, conjugate(along_w));
    Vec2 const b_zw = coupling * product(along_z, along_w);

    Vec2 const ff = product(f, f), gg = product(g, g), fg = product(f, g),
               f_to_g = product(conj_f, g);
    Real const f2 = square(f), g2 = square(g), a = a_z + a_w;
    auto const twice_real = [&](Vec2 square_of_conj) { return 2 * dot(a_zw, square_of_conj); };
    form.side_side = form.side_side +
                     complex_block({a * f2 + twice_real(ff), 0},
                                   product(b_z, conjugate(ff)) + product(b_w, ff) + 2 * f2 * b_zw);
    form.next_next = form.next_next +
                     complex_block({a * g2 + twice_real(gg), 0},
                                   product(b_z, conjugate(gg)) + product(b_w, gg) + 2 * g2 * b_zw);
    Vec2 const rotated = a_z * f_to_g + a_w * conjugate(f_to_g);
    form.side_next = form.side_next + complex_block({rotated.x + twice_real(fg), rotated.y},
                                                    product(b_z, conjugate(fg)) + product(b_w, fg) +
                                                        2 * f_to_g.x * b_zw);
}

}  // namespace harmorph
