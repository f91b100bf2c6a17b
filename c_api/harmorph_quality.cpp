// The C interface: judges validity, admissible step and quality of a mesh, and the distance of its
// wall from the moved curves.
#include "apart.hpp"
#include "basis/basis_measures.hpp"
#include "mesh_pair.hpp"
#include "morph/admissible_step.hpp"
#include "morph/crossing.hpp"

namespace harmorph {
namespace {

hm_step_report report_of(AdmissibleStep const& limit, Touch const& touch, OrientedMesh const& cells,
                         Index index_base) noexcept {
    hm_step_report filled = {};
    filled.admissible = limit.step;
    filled.cell = numbered(cells.mesh.number(limit.cell), index_base);
    filled.point = numbered(limiting_point(cells, limit), index_base);
    filled.boundary = touch.step;
    filled.boundary_points[0] = numbered(touch.point, index_base);
    for (Index k = 0; k < 2; ++k) {
        filled.boundary_points[1 + k] = numbered(touch.face[k], index_base);
    }
    return filled;
}

hm_quality_report report_of(Quality const& quality, Crossing const& crossing,
                            Mesh const& mesh) noexcept {
    hm_quality_report filled = {};
    filled.inverted = quality.inverted;
    filled.first_inverted = numbered(quality.first_inverted, mesh.index_base);
    filled.min_area = quality.min_area;
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    filled.min_quality_cell = numbered(quality.min_quality_cell, mesh.index_base);
    filled.self_crossing = crossing.found ? 1 : 0;
    for (Index k = 0; k < 2; ++k) {
        filled.crossing_points[k] = numbered(crossing.first[k], mesh.index_base);
        filled.crossing_points[2 + k] = numbered(crossing.second[k], mesh.index_base);
    }
    return filled;
}

// Computes the admissible step and the quality if they are wanted.
Assessment judge(OrientedMesh const& cells, Points start, Points displacement, Points reference,
                 bool wants_step, bool wants_quality, Real* all,
                 Executor const& executor) noexcept {
    if (!displacement.given()) return {{}, measure_quality(cells, start, reference, executor, all)};
    if (wants_quality && !reference.given())
        return assess(cells, start, displacement, executor, wants_step, all);
    Assessment found;
    if (wants_step) found.limit = admissible_step(cells, start, displacement, executor);
    if (wants_quality) {
        found.quality = displaced_quality(cells, start, displacement, reference, executor, all);
    }
    return found;
}

// Returns the array for the quality of each cell, of the size of the mesh, or null.
Status cell_array_of(const hm_quality_report* report, OrientedMesh const& cells, Points start,
                     Points displacement, Points reference, Real*& all, Fault& fault) noexcept {
    all = nullptr;
    if (report == nullptr) return Status::ok;
    hm_quality_report asked;
    if (read_struct(report, asked)) all = asked.cell_quality;
    Apart arrays;
    arrays.add("from", start, cells.mesh.n_points);
    arrays.add("displacement", displacement, cells.mesh.n_points);
    arrays.add("reference", reference, cells.mesh.n_points);
    return arrays.check("quality.cell_quality", all, cells.mesh.n_given_cells(), fault);
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_assess(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from,
                    const hm_points* displacement, const hm_points* reference,
                    const hm_executor* executor, hm_step_report* step, hm_quality_report* quality,
                    hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Mesh view;
        OrientedMesh cells;
        Points start, change, undeformed;
        HARMORPH_TRY(check_report_if(step, "step", fault));
        HARMORPH_TRY(check_report_if(quality, "quality", fault));
        if (displacement == nullptr && step != nullptr) {
            return fault.refuse_argument(
                "displacement",
                "% is NULL, but without a displacement there is no admissible step");
        }
        HARMORPH_TRY(open_pair(basis, mesh, b, view, cells, fault));
        HARMORPH_TRY(view_coordinates(from, "from", view, start, fault));
        HARMORPH_TRY(view_points_if(displacement, "displacement", change, fault));
        HARMORPH_TRY(view_points_if(reference, "reference", undeformed, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        Real* all = nullptr;
        HARMORPH_TRY(cell_array_of(quality, cells, start, change, undeformed, all, fault));
        Assessment const found = judge(cells, start, change, undeformed, step != nullptr,
                                       quality != nullptr, all, threads);
        if (step != nullptr) {
            Touch const touch = first_touch(b.faces(), start, change, found.limit.step);
            write_struct(report_of(found.limit, touch, cells, view.index_base), step);
        }
        if (quality == nullptr) return Status::ok;
        Crossing const crossing = find_crossing(b.faces(), start, change);
        hm_quality_report filled = report_of(found.quality, crossing, view);
        filled.cell_quality = all;
        write_struct(filled, quality);
        return Status::ok;
    });
}

hm_status hm_boundary_error(const hm_basis* basis, const double* move, const hm_points* from,
                            const hm_points* to, double* error, int32_t* point, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Points before, after;
        HARMORPH_TRY(require({{"error", error}}, fault));
        HARMORPH_TRY(open_basis(basis, b, fault));
        HARMORPH_TRY(check_move(b, move, fault));
        HARMORPH_TRY(view_points(from, "from", before, fault));
        HARMORPH_TRY(view_points(to, "to", after, fault));
        BoundaryError const worst = boundary_error(b, move, before, after);
        *error = worst.error;
        if (point != nullptr) *point = numbered(worst.point, b.header->index_base);
        return check_tear(b, move, before, Status::torn, fault);
    });
}

}  // extern "C"
