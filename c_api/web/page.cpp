#include "web/page.h"

#include "bspline/variables.hpp"
#include "cli/basics/sine_cosine.hpp"
#include "fields/walls.hpp"
#include "mesh_pair.hpp"
#include "morph/quality.hpp"

using namespace harmorph;

namespace harmorph {
namespace {

// Calls put(cell, quality) for the cells after the displacement, compared with those before.
template <class Put>
void for_each_quality(OrientedMesh const& cells, Points start, Points change, Put const& put) {
    CellPlaces const places{start, change, {}};
    auto const measure = [&](Index number) {
        auto const displaced = [&](Index piece) {
            CellShape shape = shape_of(cells, piece, start);
            if (!change.given()) return shape;
            CellShape const by = shape_of(cells, piece, change);
            for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + by.at[k];
            return shape;
        };
        put(number, CellMeasure(cells.mesh, number, displaced)
                        .quality(measure_cell(cells, number, start).area));
    };
    if (cells.mesh.has_pieces()) {
        for (Index i = 0; i < cells.mesh.n_given_cells(); ++i) measure(i);
        return;
    }
    CellKernels const& kernels = cell_kernels(Kernel::automatic, cells.mesh.n_cells);
    for_each_batch(cells, 0, cells.mesh.n_cells, [&](CellBatches const& batches) {
        ListQuality triangles, quads;
        kernels.triangles(batches.triangles, places, {}, &triangles);
        kernels.quads(batches.quads, places, {}, &quads);
        batches.for_each([&](Index number, bool is_triangle, Index i) {
            Real const value = (is_triangle ? triangles : quads).quality[i];
            if (value == ListQuality::not_in_range) measure(number);
            else put(number, value);
        });
    });
}

}  // namespace
}  // namespace harmorph

extern "C" {

hm_status hm_web_areas(const hm_basis* basis, const hm_mesh* mesh, double* area, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Mesh view;
        OrientedMesh cells;
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        for (Index i = 0; i < cells.mesh.n_given_cells(); ++i)
            area[i] = measure_cell(cells, i, view.points).area;
        return Status::ok;
    });
}

hm_status hm_web_cells(const hm_basis* basis, const hm_mesh* mesh, const hm_points* displacement,
                       double* quality, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Mesh view;
        OrientedMesh cells;
        Points change;
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        HARMORPH_TRY(view_points_if(displacement, "displacement", change, fault));
        for_each_quality(cells, view.points, change,
                         [&](Index cell, Real value) { quality[cell] = value > 0 ? value : 0; });
        return Status::ok;
    });
}

hm_status hm_web_pieces(const hm_basis* basis, const hm_mesh* mesh, int32_t* start, int32_t* points,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Mesh view;
        OrientedMesh cells;
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        Index n = 0;
        for (Index i = 0; i < cells.mesh.n_given_cells(); ++i) {
            start[i] = n;
            for (Index const piece : cells.mesh.pieces_of(i)) {
                Cell const cell = cells.cell(piece);
                Index* const to = points == nullptr ? nullptr : points + 4 * n;
                ++n;
                if (to == nullptr) continue;
                for (Index k = 0; k < 4; ++k) to[k] = cell.point[k < cell.n ? k : cell.n - 1];
            }
        }
        start[cells.mesh.n_given_cells()] = n;
        return Status::ok;
    });
}

hm_status hm_web_layer(const hm_walls* walls, const hm_points* before, const hm_points* at,
                       double* angle, double* height, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Points from, to;
        HARMORPH_TRY(view_points(before, "before", from, fault));
        HARMORPH_TRY(view_points(at, "at", to, fault));
        FirstLayer const& layer = reinterpret_cast<const Walls*>(walls)->layer;
        for (Index slot = 0; slot < layer.wall.count; ++slot) {
            bool const has_edge = layer.above[slot] != none;
            LayerChange const change = has_edge ? change_of(layer, slot, from, to) : LayerChange{};
            angle[slot] = change.angle;
            height[slot] = change.ratio;
        }
        return Status::ok;
    });
}

hm_status hm_web_comb(const hm_curves* curves, int32_t curve, int32_t n, const double* u,
                      double chord, double* points, double* teeth, hm_error* err) {
    for (Index k = 0; k < n; ++k) {
        double at[6];
        hm_status const status = hm_curve_point(curves, curve, u[k], 2, at, err);
        if (status < 0) return status;
        Vec2 const point{at[0], at[1]}, along{at[2], at[3]}, bend{at[4], at[5]};
        Real const speed = length(along), turn = cross(along, bend);
        Vec2 tooth = point;
        if (speed > 0) {
            Real const size = 0.02 * chord * sqrt(chord * abs(turn) / speed) / speed;
            tooth = tooth + (turn < 0 ? -size : size) / speed * Vec2{along.y, -along.x};
        }
        points[2 * k] = point.x;
        points[2 * k + 1] = point.y;
        teeth[2 * k] = tooth.x;
        teeth[2 * k + 1] = tooth.y;
    }
    return HM_OK;
}

void hm_web_sine(double angle, double* sine, double* cosine) {
    cli::SineCosine const result = cli::sine_cosine(angle);
    *sine = result.sine;
    *cosine = result.cosine;
}

void hm_web_naca(double peak, double station, double* camber, double* slope,
                 double* half_thickness) {
    Real const side = station < peak ? peak : 1 - peak;
    *camber = naca_camber(peak, station);
    *slope = 2 * (peak - station) / (side * side);
    *half_thickness = naca_half_thickness(station);
}

}  // extern "C"
