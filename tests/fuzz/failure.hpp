// A property that does not hold. libFuzzer ends there, with the bytes that led to it; the plain
// main counts it.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace fuzz {

struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline void expect(bool holds, std::string const& what) {
    if (!holds) throw Failure(what);
}

// A number of any size, in six digits.
inline std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

}  // namespace fuzz
