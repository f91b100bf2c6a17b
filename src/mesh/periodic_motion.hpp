// The rotation of a periodic mesh, such as one passage of an annulus, maps one boundary of each
// rotation pair to the other boundary. tests/boundary/test_rotation.cpp covers this file.
#pragma once

#include "base/vec2.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// The translations of a periodic mesh map one boundary of each periodic pair to the other boundary.

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

struct Rotation {
    bool any = false;
    Vec2 centre;
    Vec2 factor{1, 0};  // cosine and sine of the angle, the complex number e^(i angle)

    // Returns factor^times, which is exactly 1 for times = 0.
    Vec2 power(Index times) const noexcept {
        Vec2 out{1, 0};
        for (Index k = 0; k < absolute_of(times); ++k) out = k == 0 ? factor : product(out, factor);
        return times < 0 ? conjugate(out) : out;
    }
    Vec2 image(Vec2 point, Index times) const noexcept {
        return centre + product(power(times), point - centre);
    }

    // Several pairs of markers may have this rotation. Returns 1 if another pair has the same
    // centre and rotation, -1 if it has the opposite rotation, and 0 otherwise.
    Index times_of(Vec2 other_centre, Vec2 other_rotation) const noexcept {
        // Files with few digits have coordinates of this precision.
        constexpr Real same_within = 1e-5;
        if (other_centre.x != centre.x || other_centre.y != centre.y) return 0;
        if (length(other_rotation - factor) <= same_within) return 1;
        return length(other_rotation - conjugate(factor)) <= same_within ? -1 : 0;
    }

private:
    static constexpr Index absolute_of(Index times) noexcept { return times < 0 ? -times : times; }
};

}  // namespace harmorph
