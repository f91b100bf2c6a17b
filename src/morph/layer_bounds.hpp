// Smooth bounds of the change of heights and angles of the first layer at the walls, with
// derivatives by the points. harmorph_quality.h states the values.
// tests/morph/test_layer_bounds.cpp covers this file.
#pragma once

#include "boundary/first_layer.hpp"
#include "base/smooth_minimum.hpp"

namespace harmorph {

// An edge of the first layer, from a wall point to the point above, and the neighbours of the wall
// point along the wall, or none.
struct LayerEdge {
    Index foot, top, previous, next;
};

enum class LayerValue : std::int32_t { height, stretch, angle };

// Returns the bound of the values of all edges, and adds the derivatives of this bound to the
// gradient, if it is given. The values of `stretch` are minus the ratios of heights.
SmoothMinimum find_layer_bound(Span<const LayerEdge> edges, LayerValue which, Real sharpness,
                               Points at, Points start, MutablePoints gradient) noexcept;

}  // namespace harmorph
