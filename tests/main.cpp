// All C++ tests. The processor traps floating-point exceptions, as in debug builds of flow solvers:
// a call that succeeds may raise none but inexact and underflow. HARMORPH_TRAPS=0 in the
// environment turns the traps off.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fixtures/traps.hpp"

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const char* const wanted = std::getenv("HARMORPH_TRAPS");
    bool const off = wanted != nullptr && std::strcmp(wanted, "0") == 0;
    if (!off && !traps::enable())
        std::puts("skipped: floating-point exceptions, which cannot be trapped here");
    return context.run();
}
