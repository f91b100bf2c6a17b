#include "work/to_airfoil.hpp"

#include "basics/elementary.hpp"
#include "basics/geometry.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

double extent_of(const Box& box) { return length_of(box.width(), box.height()); }

// Returns the extent of the points in parts of that of the control points of the curve.
double relative_size_of(const Section& section, const hm_curves& curves, const hm_curve& curve) {
    Box points, control;
    for (std::size_t k = 0; k < section.x.size(); ++k)
        points.include(Point{section.x[k], section.y[k]});
    for (std::int32_t k = 0; k < curve.n_indices; ++k) {
        const std::int32_t i = curve.indices == nullptr ? k : curve.indices[k] - curves.index_base;
        const double* const at = curves.control + 2 * i;
        control.include(Point{at[0], at[1]});
    }
    return extent_of(points) / extent_of(control);
}

}  // namespace

ToAirfoil fit_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                         const std::string& path, bool on_chord) {
    const auto n = static_cast<std::int32_t>(section.x.size());
    const hm_points points = {section.x.data(), section.y.data(), 1};
    ToAirfoil result;
    result.moves.resize(2 * static_cast<std::size_t>(basis.functions()));
    auto report = sized<hm_refit_report>();
    Block work;
    with_memory(work, [&](hm_memory* memory) {
        return call(path, hm_refit, &basis.curves(), curve, &points, n,
                    std::int32_t{section.is_loop}, std::int32_t{on_chord}, result.moves.data(),
                    &report, memory);
    });
    result.closed_width = report.closed_width;
    result.points = n;
    result.max_error = report.max_error;
    result.rms_error = report.rms_error;
    result.worst_point = report.max_error_point + 1 - basis.curves().index_base;
    result.chord = report.chord;
    result.relative_size = relative_size_of(section, basis.curves(), basis.curves().curve[curve]);
    for (std::size_t k = 0; k < section.x.size(); ++k) {
        const double x = section.x[k], y = section.y[k];
        result.x.push_back(report.rotation_x * x - report.rotation_y * y + report.shift_x);
        result.y.push_back(report.rotation_y * x + report.rotation_x * y + report.shift_y);
    }
    return result;
}

ToAirfoil moves_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                           const std::string& path, bool on_chord) {
    const ToAirfoil result = fit_to_airfoil(basis, curve, section, path, on_chord);
    if (result.closed_width > 0) {
        warn(path + ": the blunt base, " + brief(result.closed_width) +
             " wide, becomes one point, because the airfoil of the mesh has a sharp trailing edge: "
             "the thickness is reduced linearly from the leading to the trailing edge");
    }
    return result;
}

namespace {

double distance_from_polygon(const ToAirfoil& airfoil, double x, double y) {
    const std::size_t n = airfoil.x.size();
    double nearest = HUGE_VAL;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t next = (k + 1) % n;
        const double ax = airfoil.x[k], ay = airfoil.y[k], dx = airfoil.x[next] - ax,
                     dy = airfoil.y[next] - ay, squared = dx * dx + dy * dy;
        const double along = squared > 0 ? ((x - ax) * dx + (y - ay) * dy) / squared : 0;
        const double share = std::min(1.0, std::max(0.0, along));
        nearest = std::min(nearest, length_of(ax + share * dx - x, ay + share * dy - y));
    }
    return nearest;
}

// Tells whether all points of the condition lie on the curve and its base. The points of one piece
// of a marker, or of a marker with several bodies, are not known here.
bool is_wall_of(const Basis& basis, const hm_condition& condition, std::int32_t curve) {
    if (condition.kind != HM_ON_CURVE || condition.piece != 0) return false;
    if (condition.first_curve != curve || condition.n_curves > 2) return false;
    return condition.n_curves == 1 || basis.curves().curve[curve + 1].n_indices == 2;
}

}  // namespace

void measure_wall(ToAirfoil& airfoil, const Basis& basis, std::int32_t curve, const Mesh& mesh,
                  const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<bool> is_measured(x.size());
    for (const hm_condition& condition : basis.conditions()) {
        if (!is_wall_of(basis, condition, curve)) continue;
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            if (mesh.face_markers[face] != condition.marker) continue;
            for (const std::size_t end : {2 * face, 2 * face + 1}) {
                const auto point = static_cast<std::size_t>(mesh.face_points[end]);
                if (is_measured[point]) continue;
                is_measured[point] = true;
                airfoil.wall_error = std::max(airfoil.wall_error,
                                              distance_from_polygon(airfoil, x[point], y[point]));
            }
        }
    }
}

}  // namespace cli
