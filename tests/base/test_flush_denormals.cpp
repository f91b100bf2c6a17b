// Numbers below the normal range are flushed while they are asked to be, and no longer.
#include <doctest/doctest.h>

#include "base/flush_denormals.hpp"

#include <limits>

namespace {

template <class Number>
Number product(Number a, Number b) {
    Number volatile x = a, y = b;  // at run time
    Number volatile out = x * y;
    return out;
}

}  // namespace

TEST_CASE("tiny products are flushed in single precision alone; normal products do not change") {
    float const least = std::numeric_limits<float>::min();
    float const third = product(1.0f / 3, 3e-30f);
    {
        harmorph::Flush<float> const flush;
        static_cast<void>(flush);
#if defined(__x86_64__) && defined(__GNUC__)
        CHECK(product(least, 0.5f) == 0);
#endif
        CHECK(product(least, 1.0f) == least);
        CHECK(product(1.0f / 3, 3e-30f) == third);
    }
    CHECK(product(least, 0.5f) == least / 2);
    harmorph::Flush<double> const none;
    static_cast<void>(none);
    CHECK(product(least, 0.5f) == least / 2);
}
