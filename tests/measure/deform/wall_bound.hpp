// Bounds that no mesh can exceed. Where a wall folds, the cells at the fold share its angle, and a
// cell with a small angle is poor, as one with an angle near 180 degrees is at a spike; where a
// face of the wall becomes longer, a cell on the face is large or flat; and in a gap no triangle
// can be higher than the gap is wide. So the wall at the target alone bounds the smallest size-skew
// quality that a mesh with these cells can have.
#pragma once

#include "cell_bound.hpp"

#include <cstddef>
#include <map>

namespace deform {

// Rows of cells; faces: pairs of points with markers; x, y at the start; wall_x, wall_y at the
// target, looked at on the wall only. Every corner at the wall must be convex, as corners of valid
// cells are.
struct WallBound {
    double quality = 1;     // [-]
    double angle = 0;       // [degrees] of the wall where this is so; 0: because of the length of a
                            // face, or of a gap
    std::size_t point = 0;  // where this is so

    WallBound(const std::vector<int>& cell_start, const std::vector<int>& cell_points,
              const std::vector<int>& faces, const std::vector<int>& markers, int wall,
              const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& wall_x, const std::vector<double>& wall_y)
        : at_x(wall_x), at_y(wall_y), corners(x.size()) {
        for (std::size_t end = 0; end < faces.size(); ++end) {
            if (markers[end / 2] == wall) corners[at(faces[end])].is_on_wall = true;
        }
        find_cells(cell_start, cell_points, x, y);
        for (std::size_t face = 0; face < markers.size(); ++face) {
            if (markers[face] != wall) continue;
            bool const is_forwards = cells.count({faces[2 * face], faces[2 * face + 1]}) > 0;
            int const begin = faces[2 * face + (is_forwards ? 0 : 1)],
                      end = faces[2 * face + (is_forwards ? 1 : 0)];
            corners[at(begin)].next = end;
            corners[at(end)].previous = begin;
            note(bound_on_face(begin, end), 0, at(begin));
        }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            if (corners[k].previous == none || corners[k].next == none) continue;
            double const open = open_angle(k);
            note(std::min(best_quality(open, corners[k].triangles, corners[k].quads),
                          bound_of_widest(k, open)),
                 open * 180 / pi, k);
        }
    }

private:
    static constexpr int none = -1;

    struct Corner {
        int triangles = 0, quads = 0, previous = none,
            next = none;  // along the wall, the mesh on the left
        bool is_on_wall = false;
    };
    struct Cell {
        int n;
        double area;  // at the start
    };

    const std::vector<double>&at_x, &at_y;
    std::vector<Corner> corners;
    std::map<std::pair<int, int>, Cell>
        cells;  // by their sides between points of the wall, counter-clockwise

    static std::size_t at(int k) { return static_cast<std::size_t>(k); }

    void note(double best, double at_angle, std::size_t at_point) {
        if (best >= quality) return;
        quality = best;
        angle = at_angle;
        point = at_point;
    }

    void find_cells(const std::vector<int>& cell_start, const std::vector<int>& cell_points,
                    const std::vector<double>& x, const std::vector<double>& y) {
        for (std::size_t i = 0; i + 1 < cell_start.size(); ++i) {
            int const begin = cell_start[i], n = cell_start[i + 1] - begin;
            auto const corner = [&](int k) { return cell_points[at(begin + k % n)]; };
            double twice_area = 0;
            for (int k = 0; k < n; ++k) {
                std::size_t const a = at(corner(k)), b = at(corner(k + 1)), o = at(corner(0));
                twice_area += (x[a] - x[o]) * (y[b] - y[o]) - (x[b] - x[o]) * (y[a] - y[o]);
                ++(n == 3 ? corners[a].triangles : corners[a].quads);
            }
            for (int k = 0; k < n; ++k) {
                int const a = corner(k), b = corner(k + 1);
                if (!corners[at(a)].is_on_wall || !corners[at(b)].is_on_wall) continue;
                cells[{twice_area > 0 ? a : b, twice_area > 0 ? b : a}] = {
                    n, .5 * std::fabs(twice_area)};
            }
        }
    }

    double length(std::size_t a, std::size_t b) const {
        return std::hypot(at_x[b] - at_x[a], at_y[b] - at_y[a]);
    }

    // Returns a bound of the quality of the triangle on a face, which contains no other point of
    // the wall.
    double bound_on_face(int begin, int end) const {
        auto const found = cells.find({begin, end});
        if (found == cells.end() || found->second.n != 3) return 1;
        std::size_t const a = at(begin), b = at(end);
        double const l = length(a, b), ex = (at_x[b] - at_x[a]) / l, ey = (at_y[b] - at_y[a]) / l;
        std::vector<std::pair<double, double>> others;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            double const dx = at_x[k] - at_x[a], dy = at_y[k] - at_y[a], along = dx * ex + dy * ey,
                         up = dy * ex - dx * ey;
            if (corners[k].is_on_wall && k != a && k != b && up > 1e-9 * l)
                others.push_back({along / up, (l - along) / up});
        }
        return best_on_side(l, found->second.area, others);
    }

    // Returns the bound of the mesh at a point of the wall.
    double open_angle(std::size_t k) const {
        std::size_t const a = at(corners[k].next), b = at(corners[k].previous);
        double const ux = at_x[a] - at_x[k], uy = at_y[a] - at_y[k], vx = at_x[b] - at_x[k],
                     vy = at_y[b] - at_y[k];
        double const turn = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
        return turn < 0 ? turn + 2 * pi : turn;
    }

    // One of the cells at a point has the mean of their angles, or more.
    double bound_of_widest(std::size_t k, double open) const {
        Corner const& corner = corners[k];
        double const mean = open / (corner.triangles + corner.quads);
        double best = 0;
        if (corner.triangles > 0) best = best_with_wide_angle(3, mean);
        if (corner.quads > 0) best = std::max(best, best_with_wide_angle(4, mean));
        if (corner.triangles > 0 || corner.quads != 2) return best;
        auto const next = cells.find({static_cast<int>(k), corner.next}),
                   previous = cells.find({corner.previous, static_cast<int>(k)});
        if (next == cells.end() || previous == cells.end()) return best;
        return std::min(
            best,
            std::max(best_quad_with_wide_angle(mean, length(k, at(corner.next)), next->second.area),
                     best_quad_with_wide_angle(mean, length(k, at(corner.previous)),
                                               previous->second.area)));
    }
};

}  // namespace deform
