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
        static_assert(alignof(T) <= alignment, "");
        Size const count = static_cast<Size>(n);
        out = {};
        if (used_ >= limit || count > (limit - used_) / sizeof(T)) {
            used_ = limit;
            return;
        }
        Size const start = used_;
        used_ += round_up(count * sizeof(T));
        if (base_ != nullptr && used_ <= capacity_)
            out = {reinterpret_cast<T*>(base_ + start), count};
    }

    // Arrays that are taken between mark() and release() share their memory with arrays that are
    // taken after release(). Marks are released in the reverse order.
    Size mark() const noexcept { return used_; }
    void release(Size mark) noexcept {
        if (used_ > peak_) peak_ = used_;
        used_ = mark;
    }

    Size used() const noexcept { return used_ > peak_ ? used_ : peak_; }
    // Returns the number of bytes that suffice for a block wherever it begins.
    Size bytes() const noexcept { return used() + alignment - 1; }
    bool overflown() const noexcept { return used() > (placing() ? capacity_ : limit - alignment); }

    Status verify(Size given, Fault& fault) const noexcept {
        if (!overflown()) return Status::ok;
        if (!placing()) {
            return fault.refuse(Status::bad_argument,
                                "the problem is too large for this machine's addresses");
        }
        Real const missing = static_cast<Real>(bytes() - given);
        return fault.refuse(Status::block_too_small,
                            "the block is too small: ~ more bytes are needed", {}, {}, missing);
    }

private:
    static constexpr Size limit = SIZE_MAX / 2;

    static constexpr Size round_up(Size bytes) noexcept {
        return (bytes + alignment - 1) / alignment * alignment;
    }

    unsigned char* base_ = nullptr;
    Size capacity_ = 0;
    Size used_ = 0;
    Size peak_ = 0;
};

}  // namespace harmorph
