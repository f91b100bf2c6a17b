// The C interface: coarse levels of control volumes, for multigrid flow solvers.
#include "handles.hpp"
#include "fields/coarse_levels.hpp"
#include "harmorph_fields.h"

namespace harmorph {
namespace {

Status open_levels(const hm_levels* handle, const CoarseLevels*& levels,
                   CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"levels", handle}}, fault));
    levels = reinterpret_cast<const CoarseLevels*>(handle);
    fault.bases.mesh = levels->analysis->problem().mesh.index_base;
    return Status::ok;
}

Status open_level(const hm_levels* handle, Index level, const CoarseLevels*& levels,
                  CallFault& fault) noexcept {
    HARMORPH_TRY(open_levels(handle, levels, fault));
    if (level >= 0 && level < levels->count()) return Status::ok;
    return fault.refuse(Status::bad_argument, "there is no level #; the mesh has @ levels",
                        entry_item(level), plain(levels->count()));
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_levels_size(const hm_analysis* analysis, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(open_analysis(analysis, opened, fault));
        InBlock<CoarseLevels> made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, *opened); });
    });
}

hm_status hm_levels_init(hm_levels** levels, void* block, size_t bytes, const hm_analysis* analysis,
                         const hm_points* at, int32_t agglomeration, int32_t max_levels,
                         hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(require({{"levels", levels}}, fault));
        HARMORPH_TRY(open_analysis(analysis, opened, fault));
        if (agglomeration < 0 || agglomeration > static_cast<Index>(Merging::directional) ||
            max_levels < 0 || max_levels > Agglomeration::max_levels) {
            return fault.refuse(Status::bad_argument,
                                "agglomeration is # and max_levels is @; agglomeration must be 0 "
                                "to 2, and max_levels 0 to 20",
                                plain(agglomeration), plain(max_levels));
        }
        Points points = opened->problem().mesh.points;
        HARMORPH_TRY(view_points_if(at, "at", points, fault));
        HARMORPH_TRY(check_range(points, opened->problem().mesh.n_points, fault));
        InBlock<CoarseLevels> made;
        HARMORPH_TRY(
            place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, *opened); }));
        made.object.build(*opened, points, {static_cast<Merging>(agglomeration), max_levels});
        made.give(levels);
        return Status::ok;
    });
}

hm_status hm_level_cells(const hm_levels* levels, int32_t level, int32_t* cells, int32_t* n_cells,
                         int32_t* n_levels, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const CoarseLevels* opened = nullptr;
        HARMORPH_TRY(open_level(levels, level, opened, fault));
        Size const n = static_cast<Size>(opened->volume.size());
        if (cells != nullptr) opened->cells(level, {cells, n});
        if (n_cells != nullptr) *n_cells = opened->n_volumes(level);
        if (n_levels != nullptr) *n_levels = opened->count();
        return Status::ok;
    });
}

hm_status hm_level_areas(const hm_levels* levels, int32_t level, const hm_points* from,
                         const hm_points* to, double* areas, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const CoarseLevels* opened = nullptr;
        Points start, target;
        HARMORPH_TRY(open_level(levels, level, opened, fault));
        HARMORPH_TRY(require({{"areas", areas}}, fault));
        HARMORPH_TRY(view_points_if(from, "from", start, fault));
        HARMORPH_TRY(view_points(to, "to", target, fault));
        Index const n = opened->volume.count();
        if (start.given()) HARMORPH_TRY(check_range(start, n, fault));
        HARMORPH_TRY(check_range(target, n, fault));
        opened->areas(level, start, target, {areas, static_cast<Size>(opened->n_volumes(level))});
        return Status::ok;
    });
}

}  // extern "C"
