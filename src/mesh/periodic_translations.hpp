// The translations of a periodic mesh: they map one boundary of each periodic pair to the other.
#pragma once

#include "mesh/mesh.hpp"

namespace harmorph {

// Each translation is stored as a point and the image of this point, so that it follows the
// coordinates of the mesh.
struct Translations {
    // A lattice of the plane has two generators, a third may be their sum or difference
    static constexpr Index most = 3;
    static constexpr Index most_shifts = 2 * most + 2 * most * (most - 1);

    Index n = 0;
    Index point[most] = {}, image[most] = {};

    Vec2 of(Index k, Points points) const noexcept { return points[image[k]] - points[point[k]]; }

    // Several pairs of markers may have the same one. False: too many.
    bool add(Index new_point, Index new_image, Points points) noexcept {
        constexpr Real same_within =
            1e-5;  // of the length: the precision of coordinates in files with few digits
        Vec2 const shift = points[new_image] - points[new_point];
        for (Index k = 0; k < n; ++k) {
            Vec2 const known = of(k, points);
            if (min(length(shift - known), length(shift + known)) <= same_within * length(known))
                return true;
        }
        if (n == most) return false;
        point[n] = new_point;
        image[n++] = new_image;
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
