// Clips convex polygons by straight lines. tests/fields/test_remap.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// A straight line through a point, along a direction. A line that separates two pieces must be made
// from the same numbers for both, so that rounding leaves no gap between them; the flag says which
// side is kept.
struct CuttingLine {
    Vec2 base, along;
    bool keeps_left = true;

    Real height(Vec2 p) const noexcept {
        Real const left = cross(along, p - base);
        return keeps_left ? left : -left;
    }
};

struct ConvexPolygon {
    // A quadrilateral has at most one corner more after each of four cuts. Rounding may add corners
    // to thin polygons; the rest of the places is for them.
    static constexpr Index max_corners = 16;

    Index n = 0;
    Vec2 at[max_corners];

    void add(Vec2 p) noexcept {
        if (n < max_corners) at[n++] = p;
    }
    // Returns the part on the side of the line that is kept.
    ConvexPolygon clipped(CuttingLine const& line) const noexcept {
        ConvexPolygon part;
        Real before = n > 0 ? line.height(at[n - 1]) : 0;
        for (Index k = 0; k < n; ++k) {
            Real const here = line.height(at[k]);
            if ((before < 0 && here > 0) || (before > 0 && here < 0)) {
                Vec2 const from = at[k == 0 ? n - 1 : k - 1];
                part.add(from + (before / (before - here)) * (at[k] - from));
            }
            if (here >= 0) part.add(at[k]);
            before = here;
        }
        return part;
    }
};

// The area of a polygon, and the integral of the position over the polygon.
struct PolygonMoments {
    Real area = 0;
    Vec2 first;

    explicit PolygonMoments(ConvexPolygon const& polygon) noexcept {
        Vec2 const origin = polygon.at[0];
        for (Index k = 2; k < polygon.n; ++k) {
            Vec2 const a = polygon.at[k - 1] - origin, b = polygon.at[k] - origin;
            Real const triangle = 0.5 * cross(a, b);
            area += triangle;
            first = first + (triangle / 3) * (a + b);
        }
        first = first + area * origin;
    }
};

}  // namespace harmorph
