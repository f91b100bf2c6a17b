// Points with three coordinates of a mesh with two dimensions.
#pragma once

#include "formats/number_reader.hpp"
#include "basics/numbers.hpp"

#include <cmath>

namespace cli {

// The plane z = constant of the first point: points elsewhere are refused.
class OnePlane {
public:
    void check(double z, const NumberReader& last_read) {
        if (!is_known_) z_ = z;
        is_known_ = true;
        if (std::fabs(z - z_) <= 1e-9 * (1 + std::fabs(z_))) return;
        last_read.fail("expected points in one plane z = " + brief(z_) + ", found " + brief(z) +
                       ": the mesh has three dimensions");
    }

private:
    bool is_known_ = false;
    double z_ = 0;
};

}  // namespace cli
