// The C interface: makes a part of a mesh that no process has as a whole, and matches the edges
// where parts end.
#include "parts/shared_boundary.hpp"
#include "part_handles.hpp"
#include "limits.hpp"

namespace harmorph {
namespace {

static_assert(sizeof(hm_private_edge) == sizeof(OpenEdge) && sizeof(hm_private_edge) == 56,
              "one is read as the other");

Status view_part_mesh(const hm_private_part_mesh* given, PartMesh& part,
                      CallFault& fault) noexcept {
    hm_private_part_mesh p;
    HARMORPH_TRY(open_struct(given, p, "mesh", "hm_private_part_mesh", fault));
    HARMORPH_TRY(require({{"mesh.numbers", p.numbers}}, fault));
    HARMORPH_TRY(view_mesh(p.mesh, part.mesh, fault));
    part.number = p.numbers;
    part.ghosts = p.ghosts;
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_private_part_size(const hm_private_part_mesh* mesh, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        PartMesh view;
        HARMORPH_TRY(view_part_mesh(mesh, view, fault));
        InBlock<Part> made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, view); });
    });
}

hm_status hm_private_part_init(hm_private_part** part, void* block, size_t bytes,
                               const hm_private_part_mesh* mesh, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        PartMesh view;
        HARMORPH_TRY(require({{"part", part}}, fault));
        HARMORPH_TRY(view_part_mesh(mesh, view, fault));
        InBlock<Part> made;
        HARMORPH_TRY(place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, view); }));
        HARMORPH_TRY(made.object.init(view, fault));
        made.give(part);
        return Status::ok;
    });
}

hm_status hm_private_part_cells(const hm_private_part* part, hm_mesh* own, const int32_t** cell,
                                hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* opened = nullptr;
        HARMORPH_TRY(open_part(part, opened, fault));
        HARMORPH_TRY(require({{"cell", cell}}, fault));
        HARMORPH_TRY(check_report(own, "own", fault));
        Mesh const& mesh = opened->cells;
        hm_mesh filled = {};
        filled.index_base = mesh.index_base;
        filled.n_points = mesh.n_points;
        filled.points = {mesh.points.x, mesh.points.y, mesh.points.stride};
        filled.cell_layout =
            mesh.layout == CellLayout::polygons ? HM_CELLS_POLYGONS : HM_CELLS_QUADS;
        filled.n_cells = mesh.n_cells;
        filled.cell_start = mesh.cell_start;
        filled.cell_points = mesh.cell_points;
        write_struct(filled, own);
        *cell = opened->given_cell.empty() ? nullptr : opened->given_cell.data();
        return Status::ok;
    });
}

hm_status hm_private_part_points(const hm_private_part* part, uint8_t* role, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* opened = nullptr;
        HARMORPH_TRY(open_part(part, opened, fault));
        HARMORPH_TRY(require({{"role", role}}, fault));
        std::memcpy(role, opened->in_cell.data(), opened->in_cell.size());
        return Status::ok;
    });
}

hm_status hm_private_part_edges(const hm_private_part* part, hm_private_edge* edges,
                                int32_t capacity, int32_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* opened = nullptr;
        HARMORPH_TRY(open_part(part, opened, fault));
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (capacity > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        *n = opened->n_open;
        if (capacity < opened->n_open) {
            return fault.refuse(Status::bad_argument,
                                "edges has room for # edges, but the part has @", plain(capacity),
                                plain(opened->n_open));
        }
        opened->for_each_open([&](OpenEdge const& edge) {
            std::memcpy(static_cast<void*>(edges++), &edge, sizeof edge);
        });
        return Status::ok;
    });
}

hm_status hm_private_match_edges(hm_private_edge* edges, int64_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (*n < 0)
            return fault.refuse(Status::bad_argument,
                                "*n must be the number of edges, but it is negative");
        if (*n > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        Offset left = 0;
        HARMORPH_TRY(
            match_edges({reinterpret_cast<OpenEdge*>(edges), static_cast<Size>(*n)}, left, fault));
        *n = left;
        return Status::ok;
    });
}

}  // extern "C"
