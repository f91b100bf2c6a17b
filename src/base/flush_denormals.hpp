// Denormal numbers (below 1e-38 in single precision) cost processors about a hundred times the work
// of others, and functions have many of them far from the wall. To the sums that they are added to
// they do not matter.
#pragma once

namespace harmorph {

// While a Flush exists, arithmetic of the thread that made it takes denormal numbers as 0; on
// x86-64 only. In double precision (denormal below 1e-308) functions have hardly any.
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
    static constexpr unsigned to_zero = 1u << 15, from_zero = 1u << 6;  // results; operands

    unsigned before_;
};
#endif

}  // namespace harmorph
