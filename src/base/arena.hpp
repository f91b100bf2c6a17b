// An arena cuts one block of the caller's memory into arrays. The same lay_out() runs on a counting
// arena for a size query and on a placing arena for the initialisation, so that the two cannot
// disagree.
//
//   block:  |slack|array|pad|array|pad| ... |
//
// The slack reaches up to the first multiple of `alignment`. The size query counts the largest
// possible slack, so that a block of the stated size suffices wherever it begins.
#pragma once

#include "base/span.hpp"

namespace harmorph {

class Arena {
public:
    // Bytes are counted with 64 bits, so that a machine with addresses of 32 bits can say how many
    // bytes a problem would need that it cannot hold.
    using Count64 = std::uint64_t;

    static constexpr Size alignment = 64;  // a cache line, and the widest vector register

    // An arena without a block only counts.
    Arena() noexcept = default;
    Arena(void* block, Size bytes) noexcept {
        capacity_ = bytes < alignment - 1 ? 0 : bytes - (alignment - 1);
        Size const misplaced = reinterpret_cast<std::uintptr_t>(block) % alignment;
        base_ = static_cast<unsigned char*>(block) + (alignment - misplaced) % alignment;
    }

    // Makes an arena whose offsets begin at the beginning of the block, however the block is
    // aligned. Equal counts therefore give equal layouts.
    static Arena at_origin(void* block, Size bytes) noexcept {
        Arena arena;
        arena.base_ = static_cast<unsigned char*>(block);
        arena.capacity_ = bytes;
        return arena;
    }

    bool placing() const noexcept { return base_ != nullptr; }

    // Takes an array of n elements from the block; a counting arena gives an empty array. If the
    // array does not fit, overflown() says so afterwards.
    template <class T, class Count>
    void take(Span<T>& out, Count n) noexcept {
        static_assert(__is_trivially_copyable(T), "nobody will run destructors");
        static_assert(alignof(T) <= alignment);
        Count64 const count = static_cast<Count64>(n);
        out = {};
        if (used_ >= most || count > (most - used_) / sizeof(T)) {
            used_ = most;
            return;
        }
        Count64 const start = used_;
        used_ += round_up(count * sizeof(T));
        if (base_ != nullptr && used_ <= capacity_)
            out = {reinterpret_cast<T*>(base_ + start), static_cast<Size>(count)};
    }

    // Arrays that are taken between mark() and release() share their memory with arrays that are
    // taken after release(). Marks are released in the reverse order.
    Count64 mark() const noexcept { return used_; }
    void release(Count64 mark) noexcept {
        if (used_ > peak_) peak_ = used_;
        used_ = mark;
    }

    // used() and bytes() are exact if the arena is not overflown.
    Size used() const noexcept { return static_cast<Size>(needed()); }
    // Returns the number of bytes that suffice for a block wherever it begins.
    Size bytes() const noexcept { return used() + alignment - 1; }
    bool overflown() const noexcept {
        return needed() > (placing() ? Count64{capacity_} : limit - alignment);
    }

    Status verify(Size given, Fault& fault) const noexcept {
        if (!overflown()) return Status::ok;
        if (!placing()) {
            return fault.refuse(Status::bad_argument,
                                "the problem needs a block of ~ bytes, which is too large for this "
                                "machine's addresses",
                                {}, {}, static_cast<Real>(needed()));
        }
        Real const missing = static_cast<Real>(needed() + alignment - 1 - given);
        return fault.refuse(Status::block_too_small,
                            "the block is too small: ~ more bytes are needed", {}, {}, missing);
    }

private:
    static constexpr Count64 limit = SIZE_MAX / 2, most = UINT64_MAX / 2;

    static constexpr Count64 round_up(Count64 bytes) noexcept {
        return (bytes + alignment - 1) / alignment * alignment;
    }
    Count64 needed() const noexcept { return used_ > peak_ ? used_ : peak_; }

    unsigned char* base_ = nullptr;
    Size capacity_ = 0;
    Count64 used_ = 0;
    Count64 peak_ = 0;
};

}  // namespace harmorph
