// A problem in words, for who looks into a case that failed.
#pragma once

#include "problem.hpp"

#include <string>

namespace fuzz {

std::string describe(Problem const& problem);

// Runs the check of a problem, and puts the problem into words where the check fails.
template <class Run>
auto told(Problem const& problem, Run const& run) {
    try {
        return run();
    } catch (Failure const& failure) {
        throw Failure(failure.what() + std::string("\n") + describe(problem));
    }
}

}  // namespace fuzz
