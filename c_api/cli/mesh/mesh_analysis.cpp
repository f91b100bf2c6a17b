#include "mesh/mesh_analysis.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"

#include <harmorph_design.h>
#include <harmorph_study.h>

#include <cmath>

namespace cli {

MeshAnalysis::MeshAnalysis(const Mesh& mesh) : mesh_(mesh), view_(mesh.view()) {
    auto problem = sized<hm_problem>();
    problem.mesh = &view_;
    with_memory(block_, [&](hm_memory* memory) {
        return call(mesh_, hm_analysis_init, &analysis_, memory, &problem, nullptr);
    });
}

hm_mesh_report MeshAnalysis::report() const {
    auto report = sized<hm_mesh_report>();
    call(mesh_, hm_analysis_report, analysis_, &report);
    return report;
}

BoundaryPiece MeshAnalysis::boundary(const std::vector<std::int32_t>& markers,
                                     const Point* near) const {
    const auto n_markers = static_cast<std::int32_t>(markers.size());
    std::vector<std::int32_t> points(mesh_.x.size());
    std::int32_t n = 0, is_loop = 0;
    const auto piece = [&](std::int32_t index, hm_error* error) {
        return hm_analysis_boundary(analysis_, n_markers, markers.data(), index, points.data(),
                                    mesh_.points(), &n, &is_loop, error);
    };
    std::int32_t chosen = 0;
    double min_distance = HUGE_VAL;
    for (std::int32_t index = 0; near != nullptr && piece(index, nullptr) == HM_OK; ++index) {
        for (std::int32_t k = 0; k < n; ++k) {
            const auto point = static_cast<std::size_t>(points[static_cast<std::size_t>(k)]);
            const double distance = length_of(mesh_.x[point] - near->x, mesh_.y[point] - near->y);
            if (distance >= min_distance) continue;
            min_distance = distance;
            chosen = index;
        }
    }
    if (near == nullptr && piece(1, nullptr) == HM_OK) {
        throw Failure(exit_usage,
                      "these markers are several separate pieces of the boundary, but a curve is "
                      "fitted to one piece: "
                      "name the markers of one body, or a piece as MARKER@X:Y");
    }
    call(mesh_, piece, chosen);
    points.resize(static_cast<std::size_t>(n));
    return {points, is_loop != 0};
}

}  // namespace cli
