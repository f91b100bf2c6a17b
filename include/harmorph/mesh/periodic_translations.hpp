// Translations under which a mesh with periodic pairs goes on: what is near one side is near the other's neighbour.
#pragma once

#include "harmorph/mesh/mesh.hpp"

namespace harmorph {

// Each is known by a point and its image, so that it is there at any coordinates.
struct Translations {
    static constexpr Index most = 3;  // of a plane's lattice; more are sums of these
    static constexpr Index most_shifts = 2 * most + 2 * most * (most - 1);

    Index n = 0;
    Index point[most] = {}, image[most] = {};

    Vec2 of(Index k, Points points) const noexcept { return points[image[k]] - points[point[k]]; }

    // Several pairs of markers may have the same one. False: too many.
    bool add(Index its_point, Index its_image, Points points) noexcept {
        constexpr Real same_within = 1e-5;  // of its length: what files with few digits keep
        Vec2 const shift = points[its_image] - points[its_point];
        for (Index k = 0; k < n; ++k) {
            Vec2 const known = of(k, points);
            if (smaller(length(shift - known), length(shift + known)) <= same_within * length(known)) return true;
        }
        if (n == most) return false;
        point[n] = its_point;
        image[n++] = its_image;
        return true;
    }

    // To all neighbours: each translation and its opposite, and sums of two. Returns how many.
    Index shifts(Points points, Vec2* out) const noexcept {
        Index count = 0;
        auto const put = [&](Vec2 shift) {
            out[count++] = shift;
            out[count++] = -1.0 * shift;
        };
        for (Index k = 0; k < n; ++k) {
            put(of(k, points));
            for (Index other = 0; other < k; ++other) {
                put(of(k, points) + of(other, points));
                put(of(k, points) - of(other, points));
            }
        }
        return count;
    }
};

}  // namespace harmorph
