// The movements of a section that hm_move_section applies: maps of points, and changes of the
// camber. parsec.hpp has the other changes of the outline. tests/bspline/test_movements.cpp covers
// both files.
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"
#include "base/vec2.hpp"
#include "bspline/bspline.hpp"
#include "bspline/section.hpp"
#include "bspline/variables.hpp"

namespace harmorph {

// Solves matrix [n * n] times x = right [n * width] by Gaussian elimination with the largest pivot
// of each column; x replaces `right`, and the matrix is destroyed. Returns false if a pivot is 0.
inline bool solve_small(Index n, Real* matrix, Index width, Real* right) noexcept {
    auto const swap_rows = [](Real* a, Real* b, Index count) {
        for (Index k = 0; k < count; ++k) {
            Real const kept = a[k];
            a[k] = b[k];
            b[k] = kept;
        }
    };
    for (Index j = 0; j < n; ++j) {
        Index pivot = j;
        for (Index i = j + 1; i < n; ++i)
            if (abs(matrix[i * n + j]) > abs(matrix[pivot * n + j])) pivot = i;
        if (!(abs(matrix[pivot * n + j]) > 0)) return false;
        swap_rows(matrix + j * n, matrix + pivot * n, pivot == j ? 0 : n);
        swap_rows(right + j * width, right + pivot * width, pivot == j ? 0 : width);
        for (Index i = 0; i < n; ++i) {
            if (i == j) continue;
            Real const factor = matrix[i * n + j] / matrix[j * n + j];
            for (Index k = j; k < n; ++k) matrix[i * n + k] -= factor * matrix[j * n + k];
            for (Index k = 0; k < width; ++k) right[i * width + k] -= factor * right[j * width + k];
        }
    }
    for (Index i = 0; i < n; ++i)
        for (Index k = 0; k < width; ++k) right[i * width + k] /= matrix[i * n + i];
    return true;
}

inline constexpr Real per_degree = pi / 180;  // [radians]

// Returns the rotation by an angle of at most a million degrees. Multiples of 90 degrees are exact.
inline Vec2 rotation_by(Real degrees) noexcept {
    Index const right_angles = static_cast<Index>(degrees / 90 + (degrees < 0 ? -0.5 : 0.5));
    Real const a = (degrees - 90.0 * right_angles) * per_degree, s = a * a;  // |a| <= pi / 4
    Real sine = 1, cosine = 1;
    for (Index k = 10; k >= 1; --k) {
        cosine = 1 - s / ((2 * k - 1) * (2 * k)) * cosine;
        sine = 1 - s / ((2 * k) * (2 * k + 1)) * sine;
    }
    Vec2 rotation{cosine, a * sine};
    for (Index k = 0; k < ((right_angles % 4) + 4) % 4; ++k) rotation = left_of(rotation);
    return rotation;
}

// The C header has the same numbers, and explains the movements.
enum class MovementKind : std::int32_t {
    rotate = 0,
    shift = 1,
    scale = 2,
    flap = 3,
    camber_thickness = 4,
    parsec = 5,
    blade = 6,
    linear = 7  // HM_LINEAR and HM_FAMILY of the C header: a matrix
};

struct Movement {
    MovementKind kind = MovementKind::rotate;
    Index n_camber = 0, n_thickness = 0;
    Vec2 centre;  // or the hinge
    Real length = 0;
    Vec2 behind;         // flap: the unit vector from the leading to the trailing edge
    Index n_linear = 0;  // the number of values of the kind linear

    Index count() const noexcept;  // the number of values
    bool maps_points() const noexcept { return kind <= MovementKind::flap; }
    bool needs_chord() const noexcept {
        return kind >= MovementKind::flap && kind != MovementKind::linear;
    }
    // Returns the first value that is out of its range, or none. NaN is out of range.
    Index find_bad_value(const Real* values) const noexcept;
};

// A point that a map has moved.
struct MappedPoint {
    Vec2 move;         // exactly 0 if the values are 0
    Vec2 by_x, by_y;   // the derivatives of the new place by the coordinates of the old place
    Vec2 by_value[2];  // the derivatives of the new place by the values
};
MappedPoint map_point(Movement const& movement, const Real* values, Vec2 point) noexcept;

// Changes the camber line and the thickness of a section. The thickness stays normal to the changed
// camber line.

// The camber line of a section in the frame of the chord: the height s (1-s) p(s) at the station s,
// lengths in chords, with a polynomial p of degree 5 by its Bernstein coefficients.
struct CamberLine {
    static constexpr Index n = 6;
    Real coefficient[n] = {};

    // Finds the nearest line to the camber of a section, whose chord has been found.
    Status measure(Section const& section, Fault& fault) noexcept;
    // Writes the height and its first two derivatives by the station.
    void evaluate(Real station, Real (&height)[3]) const noexcept;
    // Returns the station whose normal goes through a point in the frame of the chord.
    Real station_of(Vec2 point) const noexcept;
};

// The movement of an outline by the kinds camber_thickness and blade.
class CamberChange {
public:
    // Measures the camber line of a section, whose chord has been found; both must outlive this.
    Status measure(Section const& section, Movement const& movement, Fault& fault) noexcept;
    Real start(Index j) const noexcept;
    // Returns none, or the first value that is out of its range.
    Index set(const Real* values) noexcept;
    // Returns the movement by the values of set(), and the derivatives by each value.
    OutlineMovements movements() const noexcept;

private:
    bool is_blade() const noexcept { return movement_->kind == MovementKind::blade; }
    // The changes of height and slope of the camber line and of half the thickness.
    struct Change {
        Real height = 0, slope = 0, thickness = 0;
    };
    // Returns the change at a station, and writes the derivatives by each value to by [count].
    Change change_at(Real station, Change* by) const noexcept;
    void write(Vec2 point, bool upper, Real* pairs) const noexcept;

    const Section* section_ = nullptr;
    const Movement* movement_ = nullptr;
    const Real* values_ = nullptr;
    CamberLine line_;
    Real end_slope_[2] = {};  // the slopes of the camber line at the leading and trailing edge
    // For a blade: the changes of these slopes, and the derivatives of the changes by degrees.
    Real slope_change_[2] = {}, slope_by_[2] = {};
};

// Finds the modes of a family of movements of control points: a singular value decomposition by
// one-sided Jacobi rotations (M. Hestenes, J. SIAM 6 (1958) 51), in the inner product
//
//     <a, b> = sum_i D_i a_i . b_i / sum_i D_i,   D_i = integral of N_i by the arc length.
class FamilyModes {
public:
    void lay_out(Arena& arena, Index n_control) noexcept;
    void start() noexcept;
    // Adds a curve, which must have been checked. Each curve of the set is added once.
    void add(Curve const& curve) noexcept;
    // Replaces movements [n * 2 * n_control] by the modes, and writes singular [n].
    Status run(Index n, Real* movements, Real* singular, Fault& fault) noexcept;

private:
    Real dot_of(const Real* a, const Real* b) const noexcept;
    void order(Index n, Real* movements, Real* singular) const noexcept;

    Span<Real> weight_;  // [n_control] the integral of each basis function
};

}  // namespace harmorph
