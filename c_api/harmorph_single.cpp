// The C interface: stores functions in single precision.
#include "basis/derived_basis.hpp"
#include "handles.hpp"

namespace harmorph {
namespace {

Status open_double(const hm_basis* handle, Basis& basis, CallFault& fault) noexcept {
    HARMORPH_TRY(open_complete(handle, basis, fault));
    return basis.require_double(fault);
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_single_init(hm_basis** single, hm_memory* memory, const hm_basis* basis,
                         hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from, made;
        HARMORPH_TRY(open_double(basis, from, fault));
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { made.lay_out(arena, single_counts(from)); }));
        HARMORPH_TRY(require({{"single", single}}, fault));
        HARMORPH_TRY(store_single(from, made, fault));
        *single = reinterpret_cast<hm_basis*>(made.header);
        return Status::ok;
    });
}

}  // extern "C"
