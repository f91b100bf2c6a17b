// Changes the camber line and the thickness of a section. The thickness stays normal to the changed
// camber line.
// tests/bspline/test_movements.cpp covers this file.
#pragma once

#include "bspline/movements.hpp"
#include "bspline/variable_map.hpp"

namespace harmorph {

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

}  // namespace harmorph
