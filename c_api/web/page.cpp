// Calls of the module in pages of the program (c_api/cli/page), for pictures: the values of each
// cell and of each wall point, of which the C headers tell extremes and means.
#include <harmorph_fields.h>

#include "fields/walls.hpp"
#include "mesh_pair.hpp"
#include "morph/quality.hpp"

using namespace harmorph;

extern "C" {

// Measures each cell at the coordinates `at`. area [n_cells], or NULL, receives the areas;
// quality [n_cells], or NULL, the qualities of hm_assess with cells of the areas `reference`.
HM_API hm_status hm_web_cells(const hm_basis* basis, const hm_mesh* mesh, const hm_points* at,
                              const double* reference, double* area, double* quality,
                              hm_error* err);
hm_status hm_web_cells(const hm_basis* basis, const hm_mesh* mesh, const hm_points* at,
                       const double* reference, double* area, double* quality, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Mesh view;
        OrientedMesh cells;
        Points places;
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        HARMORPH_TRY(view_coordinates(at, "at", view, places, fault));
        for (Index i = 0; i < cells.mesh.n_given_cells(); ++i) {
            CellMeasure const measure = measure_cell(cells, i, places);
            if (area != nullptr) area[i] = measure.area;
            if (quality != nullptr) quality[i] = measure.quality(reference[i]);
        }
        return Status::ok;
    });
}

// The triangles and quadrilaterals of which cells consist, for pictures: start [n_cells + 1], and
// four points for each piece, counted from 0; a triangle repeats its last point. points NULL: not
// wanted.
HM_API hm_status hm_web_pieces(const hm_basis* basis, const hm_mesh* mesh, int32_t* start,
                               int32_t* points, hm_error* err);
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

// The points of walls, in the order of hm_walls_info: the points before and behind each of them
// along the wall, the mesh on the left; -1 at an end. links [2*n_wall_points].
HM_API void hm_web_links(const hm_walls* walls, int32_t* links);
void hm_web_links(const hm_walls* walls, int32_t* links) {
    WallPoints const& wall = reinterpret_cast<const Walls*>(walls)->layer.wall;
    for (Index slot = 0; slot < wall.count; ++slot) {
        links[2 * slot] = wall.previous[slot];
        links[2 * slot + 1] = wall.next[slot];
    }
}

// How the first layer has changed: angle [n_wall_points] in degrees, and height [n_wall_points],
// after over before; 0 and 1 without an edge. hm_safe_report has the extremes of both.
HM_API hm_status hm_web_layer(const hm_walls* walls, const hm_points* before, const hm_points* at,
                              double* angle, double* height, hm_error* err);
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

}  // extern "C"
