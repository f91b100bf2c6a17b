// The translations of a periodic mesh map one boundary of each periodic pair to the other boundary.
// tests/boundary/test_periodic.cpp covers this file.
#pragma once

#include "mesh/mesh.hpp"

namespace harmorph {

// Each translation is stored as a point and the image of this point, so that it follows the
// coordinates of the mesh.
struct Translations {
    // A lattice of the plane has two generators; a third translation may be their sum or
    // difference.
    static constexpr Index max_count = 3;
    static constexpr Index max_shifts = 2 * max_count + 2 * max_count * (max_count - 1);

    Index n = 0;
    Index point[max_count] = {}, image[max_count] = {};

    Vec2 shift_of(Index k, Points points) const noexcept {
        return points[image[k]] - points[point[k]];
    }

    // Adds a translation, unless an equal or opposite one is known, as several pairs of markers may
    // have the same translation. Returns false if there are too many.
    bool add(Index new_point, Index new_image, Points points) noexcept {
        // Files with few digits have coordinates of this relative precision.
        constexpr Real same_within = 1e-5;
        Vec2 const shift = points[new_image] - points[new_point];
        for (Index k = 0; k < n; ++k) {
            Vec2 const known = shift_of(k, points);
            if (min(length(shift - known), length(shift + known)) <= same_within * length(known))
                return true;
        }
        if (n == max_count) return false;
        point[n] = new_point;
        image[n++] = new_image;
        return true;
    }

    // Writes the shifts to all neighbouring periods: each translation, the sums and differences of
    // two translations, and the opposites of all these. Returns the number of shifts.
    Index shifts(Points points, Vec2* out) const noexcept {
        Index count = 0;
        auto const put = [&](Vec2 shift) {
            out[count++] = shift;
            out[count++] = -1.0 * shift;
        };
        for (Index k = 0; k < n; ++k) {
            put(shift_of(k, points));
            for (Index other = 0; other < k; ++other) {
                put(shift_of(k, points) + shift_of(other, points));
                put(shift_of(k, points) - shift_of(other, points));
            }
        }
        return count;
    }
};

}  // namespace harmorph
