// What no mesh can do better: where a wall folds, the cells at the fold share its angle, and a cell with a small angle
// is poor; where a face of the wall becomes longer, a triangle on the face is large or flat. So the wall at the target
// alone bounds the smallest size-skew quality that a mesh with these cells can have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace deform {

// The smallest angle that a cell of n corners with the skew quality q can have. A triangle with sides a, b about the
// angle t has the quality sqrt(3) a b sin t / (a^2 + b^2 - a b cos t), at most sqrt(3) sin t / (2 - cos t); a
// quadrilateral, 4 / sum of 1 / sin of its angles, has at most 4 / (3 + 1 / sin t).
inline double least_angle(int n, double q) {
    if (q >= 1) return n == 3 ? std::acos(.5) : std::acos(0.);
    if (n != 3) return std::asin(1 / (4 / q - 3));
    // sqrt(3) sin t + q cos t = 2 q
    double const size = std::sqrt(3 + q * q);
    return std::asin(2 * q / size) - std::atan2(q, std::sqrt(3.));
}

// The largest quality that all cells of n_triangles and n_quads can have whose corners together fill an angle.
inline double best_quality(double angle, int n_triangles, int n_quads) {
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
        double const q = .5 * (low + high);
        (n_triangles * least_angle(3, q) + n_quads * least_angle(4, q) <= angle ? low : high) = q;
    }
    return high;
}

// The largest size-skew quality of a triangle with a side of this length, relative to a cell of this area. With the
// height h and the third corner over the middle of the side, the skew quality is 2 sqrt(3) l h / (3/2 l^2 + 2 h^2), the
// largest of this height, and the size the root of the ratio of the areas; their product has its largest value where
// the areas are equal, or at h = l/2 of larger triangles, or at h = 3/2 l of smaller ones.
inline double best_on_side(double length, double area) {
    double best = 0;
    for (double const h : {2 * area / length, .5 * length, 1.5 * length}) {
        double const ratio = .5 * length * h / area;
        double const skew = 2 * std::sqrt(3.) * length * h / (1.5 * length * length + 2 * h * h);
        best = std::max(best, skew * std::sqrt(std::min(ratio, 1 / ratio)));
    }
    return best;
}

// The bound of all points of a wall between two faces of the wall, and of all triangles on its faces. Rows of cells; faces: pairs of points with markers;
// x, y at the start; wall_x, wall_y at the target, looked at on the wall only.
struct WallBound {
    double quality = 1;     // [-]
    double angle = 0;       // [degrees] of the wall where this is so; 0: because of the length of a face
    std::size_t point = 0;  // where this is so

    WallBound(const std::vector<int>& cell_start, const std::vector<int>& cell_points, const std::vector<int>& faces,
              const std::vector<int>& markers, int wall, const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& wall_x, const std::vector<double>& wall_y) {
        constexpr int none = -1;
        struct Corner {
            int triangles = 0, quads = 0, previous = none, next = none;  // along the wall, the mesh on the left
            bool is_on_wall = false;
        };
        std::vector<Corner> corners(x.size());
        for (std::size_t end = 0; end < faces.size(); ++end) {
            if (markers[end / 2] == wall) corners[at(faces[end])].is_on_wall = true;
        }
        std::set<std::pair<int, int>> sides;          // of cells, counter-clockwise
        std::map<std::pair<int, int>, double> on_side;  // areas of triangles
        for (std::size_t i = 0; i + 1 < cell_start.size(); ++i) {
            int const begin = cell_start[i], n = cell_start[i + 1] - begin;
            auto const corner = [&](int k) { return cell_points[at(begin + k % n)]; };
            double area = 0;
            for (int k = 0; k < n; ++k) {
                std::size_t const a = at(corner(k)), b = at(corner(k + 1)), o = at(corner(0));
                area += (x[a] - x[o]) * (y[b] - y[o]) - (x[b] - x[o]) * (y[a] - y[o]);
                ++(n == 3 ? corners[a].triangles : corners[a].quads);
            }
            for (int k = 0; k < n; ++k) {
                int const a = corner(k), b = corner(k + 1);
                if (!corners[at(a)].is_on_wall || !corners[at(b)].is_on_wall) continue;
                sides.insert({area > 0 ? a : b, area > 0 ? b : a});
                if (n == 3) on_side[{std::min(a, b), std::max(a, b)}] = .5 * std::fabs(area);
            }
        }
        for (std::size_t face = 0; face < markers.size(); ++face) {
            if (markers[face] != wall) continue;
            bool const is_forwards = sides.count({faces[2 * face], faces[2 * face + 1]}) > 0;
            int const begin = faces[2 * face + (is_forwards ? 0 : 1)], end = faces[2 * face + (is_forwards ? 1 : 0)];
            auto const triangle = on_side.find({std::min(begin, end), std::max(begin, end)});
            if (triangle != on_side.end()) {
                std::size_t const a = at(begin), b = at(end);
                double const length = std::hypot(wall_x[b] - wall_x[a], wall_y[b] - wall_y[a]);
                double const best = best_on_side(length, triangle->second);
                if (best < quality) {
                    quality = best;
                    point = a;
                }
            }
            corners[at(begin)].next = end;
            corners[at(end)].previous = begin;
        }
        double const whole = 4 * std::acos(0.);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            Corner const& its = corners[k];
            if (its.previous == none || its.next == none) continue;
            std::size_t const a = at(its.next), b = at(its.previous);
            double const ux = wall_x[a] - wall_x[k], uy = wall_y[a] - wall_y[k];
            double const vx = wall_x[b] - wall_x[k], vy = wall_y[b] - wall_y[k];
            double const turn = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy), open = turn < 0 ? turn + whole : turn;
            double const best = best_quality(open, its.triangles, its.quads);
            if (best >= quality) continue;
            quality = best;
            angle = open * 360 / whole;
            point = k;
        }
    }

private:
    static std::size_t at(int k) { return static_cast<std::size_t>(k); }
};

}  // namespace deform
