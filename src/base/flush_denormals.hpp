// Operations with denormal numbers (below 1e-38 in single precision) take about a hundred times as
// long as others, and functions have many denormal values far from the wall. Taking them as zero
// does not change the sums to which they are added.
#pragma once

namespace harmorph {

// While a Flush exists, the thread that made it computes with 0 in place of denormal numbers. The
// processor does so on x86-64 only, and not in double precision, where numbers are denormal below
// 1e-308 and functions have hardly any.
template <class Number>
class Flush {};

#if defined(__x86_64__) && defined(__GNUC__)
template <>
class Flush<float> {
public:
    Flush() noexcept : before_(__builtin_ia32_stmxcsr()) {
        __builtin_ia32_ldmxcsr(before_ | to_zero | from_zero);
    }
    ~Flush() noexcept { __builtin_ia32_ldmxcsr(before_); }
    Flush(Flush const&) = delete;

private:
    // Bits of the control register MXCSR that replace denormal results and denormal operands by 0.
    static constexpr unsigned to_zero = 1u << 15, from_zero = 1u << 6;

    unsigned before_;
};
#endif

}  // namespace harmorph
