// The arrays of one call: those that the call writes must have no number in common with any other.
// A call adds the arrays that it reads, and checks each array that it writes against all others.
#pragma once

#include "base/types.hpp"
#include "base/vec2.hpp"

namespace harmorph {

class Apart {
public:
    // A NULL array has no numbers.
    void add(const char* name, const double* array, Offset n, Offset stride = 1) noexcept;
    void add(const char* name, Points points, Index n) noexcept {
        add(name, points.x, n, points.stride);
        add(name, points.y, n, points.stride);
    }
    // Adds an array that the call writes. The call is refused if the array has a number in common
    // with one that was added before.
    Status check(const char* name, const double* array, Offset n, Fault& fault,
                 Offset stride = 1) noexcept;
    Status check(const char* name, MutablePoints points, Index n, Fault& fault) noexcept {
        HARMORPH_TRY(check(name, points.x, n, fault, points.stride));
        return check(name, points.y, n, fault, points.stride);
    }
    // For calls that read and write point by point: `to` may be the arrays of `from`, which may be
    // NULL, but not these arrays from another point on; x and y of `to` must be apart.
    static Status check_in_place(const char* from_name, Points from, const char* to_name,
                                 MutablePoints to, Index n, Fault& fault) noexcept;

private:
    static constexpr Index max_arrays = 16;
    struct Array {
        const char* name;
        std::uintptr_t begin;  // the address of the first number
        std::uintptr_t end;    // the address behind the last number
        std::uintptr_t step;   // [bytes] from one number to the next
    };
    static bool have_common(Array const& a, Array const& b) noexcept;

    Array arrays_[max_arrays];
    Index count_ = 0;
};

}  // namespace harmorph
