// This header contains what all entry points of the C interface have in common: the fault of a
// call, checks of arguments, and the layout of objects in the caller's blocks.
#pragma once

#include "base/arena.hpp"
#include "fault_text.hpp"
#include "harmorph_bases.h"
#include "harmorph_design.h"
#include "private.h"
#include "harmorph_quality.h"
#include "harmorph_space.h"
#include "harmorph_study.h"

namespace harmorph {

// The fault of one call, together with the index bases of the caller's arrays. The function that
// reads an array sets the base.
struct CallFault : Fault {
    Bases bases;
};

// Runs the body of an entry point. body(fault) returns the status of the fault. No other function
// fills the caller's error.
template <class Body>
hm_status guarded(hm_error* err, Body const& body) noexcept {
    CallFault fault;
    body(fault);
    return tell(err, fault, fault.bases);
}

// An argument that must not be NULL, by its name in the header.
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

// Answers a size query: *bytes is the size of a block for everything that lay_out(arena) takes.
template <class LayOut>
Status count_bytes(size_t* bytes, Fault& fault, LayOut const& lay_out) noexcept {
    HARMORPH_TRY(require({{"bytes", bytes}}, fault));
    Arena counting;
    lay_out(counting);
    HARMORPH_TRY(counting.verify(0, fault));
    *bytes = counting.bytes();
    return Status::ok;
}

// Lays out the caller's block for an initialisation, by the same lay_out(arena).
template <class LayOut>
Status place(void* block, Size bytes, Fault& fault, LayOut const& lay_out) noexcept {
    HARMORPH_TRY(require({{"block", block}}, fault));
    Arena arena(block, bytes);
    lay_out(arena);
    return arena.verify(bytes, fault);
}

// A size query: the caller has no block yet, and asks how many bytes the call needs.
inline bool asks(const hm_memory* memory) noexcept {
    return memory != nullptr && memory->block == nullptr && memory->bytes == 0;
}

// Ends the body of a call that was a size query. The fault has no refusal, so that the call
// returns HM_OK.
constexpr Status answered = static_cast<Status>(-100);

// Lays out the block of an hm_memory, or answers a size query. A call opens what the size depends
// on, then places its arrays, and looks at all other arguments afterwards: a size query may leave
// these out.
template <class LayOut>
Status place(hm_memory* memory, Fault& fault, LayOut const& lay_out) noexcept {
    HARMORPH_TRY(require({{"memory", memory}}, fault));
    if (memory->block != nullptr) return place(memory->block, memory->bytes, fault, lay_out);
    if (asks(memory)) {
        HARMORPH_TRY(count_bytes(&memory->bytes, fault, lay_out));
        return answered;
    }
    return fault.refuse(Status::bad_argument,
                        "memory.block is NULL, but memory.bytes is ~; in a size query both are 0",
                        {}, {}, static_cast<Real>(memory->bytes));
}

// An object that lies in the block in front of its arrays. The object is made outside the block,
// and copied into the block when it is complete.
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
