// Opens the handles of private.h. An hm_private_part and an hm_private_equations point to the
// objects at the beginning of their blocks.
#pragma once

#include "handles.hpp"
#include "parts/part_equations.hpp"

namespace harmorph {

template <class Object, class Handle>
Status open(Handle* handle, const char* name, Object*& object, Fault& fault) noexcept {
    if (handle == nullptr) return fault.refuse_argument(name, "% is NULL");
    object = reinterpret_cast<Object*>(handle);
    return Status::ok;
}

inline Status open_part(const hm_private_part* handle, const Part*& part,
                        CallFault& fault) noexcept {
    HARMORPH_TRY(open(handle, "part", part, fault));
    fault.bases.mesh = part->own().index_base;
    return Status::ok;
}

}  // namespace harmorph
