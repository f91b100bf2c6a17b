// Numbers below the normal range (1e-38 in single precision), as far from the wall of thin layers they come up in masses,
// cost processors a hundred times the work of others. As summands they are nothing.
#pragma once

namespace harmorph {

// As long as one of these lives, arithmetic of its thread takes them as 0, where the processor is told so here: x86-64.
// Double precision has none to speak of.
template <class Number>
class Flush {};

#if defined(__x86_64__) && defined(__GNUC__)
template <>
class Flush<float> {
public:
    Flush() noexcept : before_(__builtin_ia32_stmxcsr()) { __builtin_ia32_ldmxcsr(before_ | to_zero | from_zero); }
    ~Flush() noexcept { __builtin_ia32_ldmxcsr(before_); }
    Flush(Flush const&) = delete;

private:
    static constexpr unsigned to_zero = 1u << 15, from_zero = 1u << 6;  // results; operands

    unsigned before_;
};
#endif

}  // namespace harmorph
