// That no floating-point exception was raised since the last call of clear(), but inexact and underflow.
#pragma once

#include "failure.hpp"

#include <cfenv>

namespace fuzz {

struct Exceptions {
    static void clear() { std::feclearexcept(FE_ALL_EXCEPT); }
    // clang assumes that nobody looks at the flags, and divides where the source does not: then they tell nothing.
    static void expect_none([[maybe_unused]] std::string const& call) {
#ifndef __clang__
        expect(std::fetestexcept(FE_INVALID) == 0, call + ": an invalid operation");
        expect(std::fetestexcept(FE_DIVBYZERO) == 0, call + ": a division by zero");
        expect(std::fetestexcept(FE_OVERFLOW) == 0, call + ": an overflow");
#endif
    }
};

}   // namespace fuzz
