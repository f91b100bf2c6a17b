// The C interface: transfers functions from a coarse mesh to a fine one.
#include "handles.hpp"
#include "basis/basis_measures.hpp"
#include "plan/transfer.hpp"

namespace harmorph {
namespace {

// Opens the coarse basis, which must have all functions and must have been solved on this mesh.
Status open_coarse(const hm_basis* handle, const hm_mesh* given, Basis& coarse, Mesh& mesh,
                   CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"coarse", handle}}, fault));
    HARMORPH_TRY(view_mesh(given, mesh, fault));
    HARMORPH_TRY(check_mesh(mesh, fault));
    HARMORPH_TRY(open_complete(handle, coarse, fault));
    HARMORPH_TRY(coarse.require_double(fault));
    HARMORPH_TRY(coarse.require_control_points(fault));
    Status const status =
        check_basis(handle, static_cast<Size>(coarse.header->bytes), &mesh, fault);
    if (status != Status::moved) return status;
    return fault.refuse(
        Status::bad_basis,
        "the coordinates of the coarse mesh are not those on which the coarse basis was solved");
}

Status open_target(const hm_basis* handle, Analysis const& analysis, Basis& fine,
                   CallFault& fault) noexcept {
    HARMORPH_TRY(open_basis(handle, fine, fault));
    HARMORPH_TRY(fine.require_double(fault));
    HARMORPH_TRY(fine.require_control_points(fault));
    BasisCounts const counts = analysis.basis_counts();
    bool const belongs = std::memcmp(&fine.header->counts, &counts, sizeof counts) == 0 &&
                         fine.header->topology == analysis.mesh_fingerprint() &&
                         fine.header->conditions == analysis.conditions_fingerprint() &&
                         fine.header->method.agrees_with(analysis.problem().method);
    if (belongs) return Status::ok;
    return fault.refuse(Status::bad_basis, "the basis was not made from this analysis");
}

hm_transfer_report report_of(TransferReport const& done, Basis const& fine,
                             Mesh const& mesh) noexcept {
    BasisMeasures const measures = measure_basis(fine, mesh.points);
    hm_transfer_report filled = {};
    filled.points = done.points;
    filled.outside = done.outside;
    filled.max_distance = done.max_distance;
    filled.max_distance_point = numbered(done.max_distance_point, mesh.index_base);
    filled.boundary_error = measures.value.error;
    filled.boundary_error_point = numbered(measures.value.point, mesh.index_base);
    filled.wall_correction = done.wall_correction;
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_transfer(hm_basis* basis, hm_memory* memory, const hm_analysis* analysis,
                      const hm_basis* coarse, const hm_mesh* coarse_mesh,
                      hm_transfer_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* fine_analysis = nullptr;
        Basis fine, source;
        Mesh source_mesh;
        Transfer transfer;
        HARMORPH_TRY(open_complete(analysis, fine_analysis, fault));
        HARMORPH_TRY(view_mesh(coarse_mesh, source_mesh, fault));
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) {
            transfer.lay_out(arena, *fine_analysis, source_mesh);
        }));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        if (basis != nullptr && basis == coarse) {
            return fault.refuse(Status::bad_argument,
                                "basis and coarse must be two different bases");
        }
        HARMORPH_TRY(open_coarse(coarse, coarse_mesh, source, source_mesh, fault));
        HARMORPH_TRY(open_target(basis, *fine_analysis, fine,
                                 fault));  // errors name points of the fine mesh from here on
        TransferReport done;
        HARMORPH_TRY(transfer.run(*fine_analysis, source_mesh, source, fine, done, fault));
        if (report != nullptr)
            write_struct(report_of(done, fine, fine_analysis->problem().mesh), report);
        return fault.status;
    });
}

}  // extern "C"
