// The C interface, part 4: from a coarse mesh to a fine one.
#include "fault_text.hpp"
#include "harmorph/morph/morph.hpp"
#include "harmorph/plan/transfer.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

Status open_fine(const hm_analysis* analysis, const Analysis*& fine, Fault& fault) noexcept {
    if (analysis == nullptr) return fault.refuse(Status::bad_argument, "analysis is NULL");
    fine = reinterpret_cast<const Analysis*>(analysis);
    if (fine->has_conditions()) return Status::ok;
    return fault.refuse(Status::bad_argument, "the analysis is of the mesh alone: its problem had no conditions");
}

// The coarse functions, whole and of this mesh.
Status open_coarse(const hm_basis* basis, const hm_mesh* given, Basis& coarse, Mesh& mesh, Fault& fault) noexcept {
    if (basis == nullptr) return fault.refuse(Status::bad_argument, "the coarse basis is NULL");
    HARMORPH_TRY(view_mesh(given, mesh, fault));
    HARMORPH_TRY(check_mesh(mesh, fault));
    coarse = Basis::view(static_cast<const void*>(basis));
    HARMORPH_TRY(coarse.require_double(fault));
    Status const status = check_basis(basis, static_cast<Size>(coarse.header->bytes), &mesh, fault);
    if (status != Status::moved) return status;
    return fault.refuse(Status::bad_basis, "the coarse mesh's coordinates are not those its basis was solved on");
}

Status open_target(hm_basis* basis, Analysis const& analysis, Basis& fine, Fault& fault) noexcept {
    if (basis == nullptr) return fault.refuse(Status::bad_argument, "basis is NULL");
    fine = Basis::view(static_cast<void*>(basis));
    HARMORPH_TRY(fine.require_double(fault));
    BasisCounts const counts = analysis.basis_counts();
    bool const its_own = std::memcmp(&fine.header->counts, &counts, sizeof counts) == 0 &&
                         fine.header->topology == analysis.topology &&
                         fine.header->conditions == analysis.conditions_fingerprint();
    if (its_own) return Status::ok;
    return fault.refuse(Status::bad_basis, "basis and analysis do not belong together");
}

hm_transfer_report report_of(TransferReport const& done, Basis const& fine, Mesh const& mesh) noexcept {
    BasisMeasures const measures = measure_basis(fine, mesh.points);
    auto const numbered = [&](Index point) { return point == none ? none : point + mesh.index_base; };
    hm_transfer_report filled = {};
    filled.points = done.points;
    filled.outside = done.outside;
    filled.max_distance = done.max_distance;
    filled.max_distance_point = numbered(done.max_distance_point);
    filled.boundary_error = measures.value.error;
    filled.boundary_error_point = numbered(measures.value.point);
    filled.wall_correction = done.wall_correction;
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_transfer_size(const hm_analysis* analysis, const hm_mesh* coarse_mesh, size_t* bytes, hm_error* err) {
    Fault fault;
    const Analysis* fine = nullptr;
    Mesh mesh;
    if (bytes == nullptr) fault.refuse(Status::bad_argument, "bytes is NULL");
    if (!failed(fault.status) && !failed(open_fine(analysis, fine, fault)) && !failed(view_mesh(coarse_mesh, mesh, fault))) {
        Arena counting;
        Transfer transfer;
        transfer.lay_out(counting, *fine, mesh);
        if (!failed(counting.verify(0, fault))) *bytes = counting.bytes();
    }
    return tell(err, fault);
}

hm_status hm_transfer(hm_basis* basis, void* block, size_t bytes, const hm_analysis* analysis, const hm_basis* coarse,
                      const hm_mesh* coarse_mesh, hm_transfer_report* report, hm_error* err) {
    Fault fault;
    const Analysis* fine_analysis = nullptr;
    Basis fine, source;
    Mesh source_mesh;
    if (block == nullptr) fault.refuse(Status::bad_argument, "block is NULL");
    if (report != nullptr && !failed(fault.status)) check_report(report, fault);
    if (failed(fault.status) || failed(open_fine(analysis, fine_analysis, fault)) ||
        failed(open_coarse(coarse, coarse_mesh, source, source_mesh, fault))) {
        return tell(err, fault, {source_mesh.index_base, 0});
    }
    Mesh const& mesh = fine_analysis->problem.mesh;
    Arena arena(block, bytes);
    Transfer transfer;
    transfer.lay_out(arena, *fine_analysis, source_mesh);
    TransferReport done;
    if (!failed(open_target(basis, *fine_analysis, fine, fault)) && !failed(arena.verify(bytes, fault)) &&
        !failed(transfer.run(*fine_analysis, source_mesh, source, fine, done, fault)) && report != nullptr) {
        write_struct(report_of(done, fine, mesh), report);
    }
    return tell(err, fault, {mesh.index_base, 0});
}

}  // extern "C"
