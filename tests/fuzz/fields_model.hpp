// The calls of harmorph_fields.h for one random mesh, and their slow references.
#pragma once

#include <harmorph_fields.h>
#include "cells_of_mesh.hpp"
#include "reference.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>

namespace fuzz {

using Quad = __float128;

class FieldsModel {
public:
    FieldsModel(Problem& problem, Input& input);
    Outcome run();

private:
    using Numbers = std::vector<double>;

    void areas();  // check_swept_areas.cpp
    // check_walls.cpp
    void walls();
    void distances(hm_walls const* walls, std::vector<Face> const& faces,
                   std::vector<Point> const& mesh);
    void distance_derivatives(hm_walls const* walls, std::vector<Face> const& faces,
                              std::vector<Point> const& mesh, std::vector<Point> const& places);

    // check_interpolation.cpp
    void interpolation();
    void interpolated(hm_interpolation const* interpolation, std::vector<Point> const& places,
                      Numbers const& distance);
    void transpose(hm_interpolation const* interpolation, std::size_t n);
    // The value of a field at a place in the mesh, or false: outside.
    bool value_in_mesh(Point place, Numbers const& field, Wide& value, Wide& rounding) const;
    // `beside`: how far, in parts of a triangle, the place may lie outside of the triangle.
    bool value_in_cells(Point place, Numbers const& field, Wide beside, Wide& value,
                        Wide& rounding) const;

    // A side of a cell is shorter than a millionth of the mesh: rounding decides which cell has a
    // place.
    bool has_short_sides() const {
        for (Cell const& cell : problem_.domain.cells)
            for (std::size_t k = 0; k < cell.size(); ++k) {
                Point const a = points_[at(cell[k])], b = points_[at(cell[(k + 1) % cell.size()])];
                double const side = std::hypot(b.x - a.x, b.y - a.y);
                if (side > 0 && side < 1e-6 * std::max(extent_, size_)) return true;
            }
        return false;
    }

    void done(hm_status status, const char* what) const { expect_done(status, error_, what); }
    // The points of the mesh, each moved by at most a tenth of the extent, or by very little.
    std::vector<Point> displaced();
    // Places inside, at points, on faces and far outside; a wild one may not be a place at all.
    std::vector<Point> places();
    // The header takes coordinates up to 1e100.
    static bool has_bad(std::vector<Point> const& places) {
        for (Point const& p : places)
            if (!(std::abs(p.x) <= 1e100 && std::abs(p.y) <= 1e100)) return true;
        return false;
    }

    Problem& problem_;
    Input& input_;
    Judged judged_;
    hm_analysis* analysis_ = nullptr;
    std::vector<Point> points_;
    double size_ = 0, extent_ = 0;  // the largest coordinate, the width or height of the mesh
    hm_error error_{};
    Blocks blocks_;
};

}  // namespace fuzz
