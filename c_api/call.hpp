// What all entry points of the C interface have in common.
#pragma once

#include "base/arena.hpp"
#include "fault_text.hpp"
#include "harmorph_design.h"
#include "harmorph_parts.h"
#include "harmorph_space.h"
#include "harmorph_study.h"

namespace harmorph {

// The fault of one call, and what the caller's arrays count from, which whoever reads the arrays
// writes here.
struct CallFault : Fault {
    Bases bases;
};

// An entry point: body(fault) returns the fault's status. The caller's error is filled here, and
// only here.
template <class Body>
hm_status guarded(hm_error* err, Body const& body) noexcept {
    CallFault fault;
    body(fault);
    return tell(err, fault, fault.bases);
}

// Arguments that must not be NULL, by the names they have in the header.
struct Argument {
    const char* name;
    const void* pointer;
};
template <Size n>
Status require(const Argument (&arguments)[n], Fault& fault) noexcept {
    for (Argument const& argument : arguments) {
        if (argument.pointer == nullptr) return fault.refuse_argument(argument.name, "% is NULL");
    }
    return Status::ok;
}

// A size query: *bytes of a block for what lay_out(arena) takes.
template <class LayOut>
Status count_bytes(size_t* bytes, Fault& fault, LayOut const& lay_out) noexcept {
    HARMORPH_TRY(require({{"bytes", bytes}}, fault));
    Arena counting;
    lay_out(counting);
    HARMORPH_TRY(counting.verify(0, fault));
    *bytes = counting.bytes();
    return Status::ok;
}

// An initialisation: the same lay_out(arena) in the caller's block.
template <class LayOut>
Status place(void* block, Size bytes, Fault& fault, LayOut const& lay_out) noexcept {
    HARMORPH_TRY(require({{"block", block}}, fault));
    Arena arena(block, bytes);
    lay_out(arena);
    return arena.verify(bytes, fault);
}

// An object that stands in the block in front of its arrays: made beside the block, copied into it
// when it is complete.
template <class Object>
struct InBlock {
    Span<Object> in_block;
    Object object;

    template <class... From>
    void lay_out(Arena& arena, From const&... from) noexcept {
        arena.take(in_block, 1);
        object.lay_out(arena, from...);
    }
    template <class Handle>
    void give(Handle** handle) const noexcept {
        in_block[0] = object;
        *handle = reinterpret_cast<Handle*>(in_block.data());
    }
};

}  // namespace harmorph
