// A mesh to deform and where its boundary goes, for methods that know nothing of B-splines.
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

namespace compare {

struct Cells {
    std::vector<std::int32_t> start, point;  // compressed rows, counted from 0

    std::int32_t count() const { return static_cast<std::int32_t>(start.size()) - 1; }
    std::int32_t size(std::int32_t cell) const { return start[cell + 1] - start[cell]; }
    std::int32_t at(std::int32_t cell, std::int32_t corner) const {
        return point[start[cell] + corner % size(cell)];
    }
};

using Point = std::complex<double>;

// Twice the signed area.
inline double twice_area(Point a, Point b, Point c) { return (std::conj(b - a) * (c - a)).imag(); }

// Returns the boundary points at a fraction t of the movement, from 0 to 1; outer points stay.
struct Motion {
    Cells cells;                            // counter-clockwise
    std::vector<Point> start;               // all points
    std::vector<std::int32_t> wall, outer;  // boundary points
    std::vector<std::int32_t>
        next;  // [points] the next wall point, mesh on the left of the face there; or -1
    std::function<std::vector<Point>(double)> wall_at;  // positions of wall points

    bool is_valid(const std::vector<Point>& at) const {
        for (std::int32_t cell = 0; cell < cells.count(); ++cell)
            for (std::int32_t k = 0; k < cells.size(cell); ++k) {
                const std::int32_t n = cells.size(cell);
                if (!(twice_area(at[cells.at(cell, k + n - 1)], at[cells.at(cell, k)],
                                 at[cells.at(cell, k + 1)]) > 0))
                    return false;
            }
        return true;
    }
};

}  // namespace compare
