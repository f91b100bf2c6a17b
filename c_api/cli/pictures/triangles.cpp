#include "pictures/triangles.hpp"

#include <algorithm>

namespace cli {

namespace {

class Polygon {
public:
    Polygon(const Mesh& mesh, std::size_t cell) : mesh_(mesh) {
        const auto first = mesh.cell_points.begin();
        corners_.assign(first + mesh.cell_start[cell], first + mesh.cell_start[cell + 1]);
        double area = 0;  // twice the area
        for (std::size_t i = 1; i + 1 < corners_.size(); ++i)
            area += turn(corners_[0], corners_[i], corners_[i + 1]);
        orientation_ = area < 0 ? -1 : 1;
    }

    bool is_triangle() const { return corners_.size() == 3; }

    // Cuts off the ear that has the largest area, or the corner of the largest area if the polygon
    // has no ear, because it has collapsed or is inverted.
    Corners cut() {
        std::size_t best = 0;
        double largest = -1;
        for (const bool ears_only : {true, false}) {
            for (std::size_t i = 0; i < corners_.size(); ++i) {
                const Corners corners = around(i);
                const double area = orientation_ * turn(corners[0], corners[1], corners[2]);
                if (area > largest && (!ears_only || (area > 0 && is_empty(corners)))) {
                    largest = area;
                    best = i;
                }
            }
            if (largest > 0) break;
        }
        const Corners ear = around(best);
        corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(best));
        return ear;
    }

    Corners rest() const { return {corners_[0], corners_[1], corners_[2]}; }

private:
    Point at(std::int32_t corner) const {
        return {mesh_.x[static_cast<std::size_t>(corner)],
                mesh_.y[static_cast<std::size_t>(corner)]};
    }
    double turn(std::int32_t a, std::int32_t b, std::int32_t c) const {
        const Point p = at(a), q = at(b), r = at(c);
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    }
    Corners around(std::size_t i) const {
        const std::size_t n = corners_.size();
        return {corners_[(i + n - 1) % n], corners_[i], corners_[(i + 1) % n]};
    }
    // Returns true if no other corner of the polygon lies in the triangle or on its sides.
    bool is_empty(const Corners& ear) const {
        return std::none_of(corners_.begin(), corners_.end(), [&](std::int32_t corner) {
            if (std::find(ear.begin(), ear.end(), corner) != ear.end()) return false;
            return orientation_ * turn(ear[0], ear[1], corner) >= 0 &&
                   orientation_ * turn(ear[1], ear[2], corner) >= 0 &&
                   orientation_ * turn(ear[2], ear[0], corner) >= 0;
        });
    }

    const Mesh& mesh_;
    std::vector<std::int32_t> corners_;
    double orientation_;
};

}  // namespace

void divide_polygon(const Mesh& mesh, std::size_t cell, std::vector<Corners>& triangles) {
    Polygon polygon(mesh, cell);
    while (!polygon.is_triangle()) triangles.push_back(polygon.cut());
    triangles.push_back(polygon.rest());
}

}  // namespace cli
