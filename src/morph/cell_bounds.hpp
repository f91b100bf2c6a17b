// Smooth lower bounds of the smallest quality and of the smallest relative corner area of all
// cells, with derivatives by the points. harmorph_quality.h states the values.
// tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

#include "base/executor.hpp"
#include "mesh/topology.hpp"
#include "base/smooth_minimum.hpp"

namespace harmorph {

// A bound that is computed if its sharpness is not 0. The gradient, if its points are given, must
// be 0 before; it receives the derivatives of the bound.
struct CellBound {
    Real sharpness = 0;
    MutablePoints gradient;
    SmoothMinimum found;
};

struct CellBoundPair {
    CellBound quality, area;
    bool kept = false;  // the quality is divided by the skew quality of the start
};

// Computes both bounds at the coordinates `at`, which must be finite; no cell may be inverted at
// `start`. The bits do not depend on the executor.
void find_cell_bounds(OrientedMesh const& cells, Points at, Points start, Executor const& executor,
                      CellBoundPair& bounds) noexcept;

}  // namespace harmorph
