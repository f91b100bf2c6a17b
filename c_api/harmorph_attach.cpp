// The C interface: attaches a basis to a block that was saved. This call has a file of its own, so
// that a solver that reads a saved basis links this call, the morph and the adjoint, and little
// else.
#include "handles.hpp"

using namespace harmorph;

extern "C" {

hm_status hm_basis_attach(const hm_basis** basis, const void* block, size_t bytes,
                          const hm_mesh* mesh, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        HARMORPH_TRY(require({{"basis", basis}, {"block", block}}, fault));
        if (reinterpret_cast<std::uintptr_t>(block) % 8 != 0) {
            return fault.refuse(Status::bad_argument,
                                "the address of the block must be a multiple of 8 bytes");
        }
        Mesh view;
        if (mesh != nullptr) {
            HARMORPH_TRY(view_mesh(mesh, view, fault));
            HARMORPH_TRY(check_mesh(view, fault));
        }
        HARMORPH_TRY(check_basis(block, bytes, mesh != nullptr ? &view : nullptr, fault));
        *basis = static_cast<const hm_basis*>(block);
        return fault.status;
    });
}
}
