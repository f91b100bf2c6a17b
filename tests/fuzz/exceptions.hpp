// That no floating-point exception was raised since the last call of clear(), but inexact and
// underflow.
#pragma once

#include "failure.hpp"

#include <cfenv>

#ifdef __clang__  // what a test computes stays on its side of clear(); see src/base/types.hpp
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wignored-pragmas"
#pragma float_control(except, on)
#pragma clang diagnostic pop
#endif

namespace fuzz {

struct Exceptions {
    static void clear() { std::feclearexcept(FE_ALL_EXCEPT); }
    static void expect_none(std::string const& call) {
        expect(std::fetestexcept(FE_INVALID) == 0, call + ": an invalid operation");
        expect(std::fetestexcept(FE_DIVBYZERO) == 0, call + ": a division by zero");
        expect(std::fetestexcept(FE_OVERFLOW) == 0, call + ": an overflow");
    }
};

}  // namespace fuzz
