// That no floating-point exception was raised since the last call of clear(), but inexact and underflow.
#pragma once

#include "failure.hpp"

#include <cfenv>

namespace fuzz {

struct Exceptions {
    static void clear() { std::feclearexcept(FE_ALL_EXCEPT); }
    static void expect_none(std::string const& call) {
        expect(std::fetestexcept(FE_INVALID) == 0, call + ": an invalid operation");
        expect(std::fetestexcept(FE_DIVBYZERO) == 0, call + ": a division by zero");
        expect(std::fetestexcept(FE_OVERFLOW) == 0, call + ": an overflow");
    }
};

}   // namespace fuzz
