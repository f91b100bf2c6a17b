// The C interface, part 5: functions in single precision.
#include "fault_text.hpp"
#include "harmorph/basis/single_precision.hpp"
#include "open_basis.hpp"

namespace harmorph {
namespace {

Status open_double(const hm_basis* basis, Basis& out, Fault& fault) noexcept {
    HARMORPH_TRY(open_complete(basis, out, fault));
    return out.require_double(fault);
}

Status store(Basis const& from, void* block, Size bytes, hm_basis** out, Fault& fault) noexcept {
    Arena arena(block, bytes);
    Basis made;
    made.lay_out(arena, single_counts(from));
    HARMORPH_TRY(arena.verify(bytes, fault));
    HARMORPH_TRY(store_single(from, made, fault));
    *out = reinterpret_cast<hm_basis*>(made.header);
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_single_size(const hm_basis* basis, size_t* bytes, hm_error* err) {
    Fault fault;
    Basis from;
    if (bytes == nullptr) fault.refuse(Status::bad_argument, "bytes is NULL");
    if (!failed(fault.status) && !failed(open_double(basis, from, fault))) {
        Arena counting;
        Basis made;
        made.lay_out(counting, single_counts(from));
        if (!failed(counting.verify(0, fault))) *bytes = counting.bytes();
    }
    return tell(err, fault);
}

hm_status hm_single_init(hm_basis** single, void* block, size_t bytes, const hm_basis* basis, hm_error* err) {
    Fault fault;
    Basis from;
    if (single == nullptr || block == nullptr) fault.refuse(Status::bad_argument, "single or block is NULL");
    if (!failed(fault.status) && !failed(open_double(basis, from, fault))) store(from, block, bytes, single, fault);
    return tell(err, fault);
}

}  // extern "C"
