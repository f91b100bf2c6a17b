// The rotation of a periodic mesh, such as one passage of an annulus, maps one boundary of each
// rotation pair to the other boundary. tests/boundary/test_rotation.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

struct Rotation {
    bool any = false;
    Vec2 centre;
    Vec2 turn{1, 0};  // cosine and sine of the angle, the complex number e^(i angle)

    // Returns turn^times, which is exactly 1 for times = 0.
    Vec2 power(Index times) const noexcept {
        Vec2 out{1, 0};
        for (Index k = 0; k < absolute_of(times); ++k) out = k == 0 ? turn : product(out, turn);
        return times < 0 ? conjugate(out) : out;
    }
    Vec2 image(Vec2 point, Index times) const noexcept {
        return centre + product(power(times), point - centre);
    }

    // Several pairs of markers may have this rotation. Returns 1 if another pair has the same
    // centre and turn, -1 if it has the opposite turn, and 0 otherwise.
    Index times_of(Vec2 other_centre, Vec2 other_turn) const noexcept {
        // Files with few digits have coordinates of this precision.
        constexpr Real same_within = 1e-5;
        if (other_centre.x != centre.x || other_centre.y != centre.y) return 0;
        if (length(other_turn - turn) <= same_within) return 1;
        return length(other_turn - conjugate(turn)) <= same_within ? -1 : 0;
    }

private:
    static constexpr Index absolute_of(Index times) noexcept { return times < 0 ? -times : times; }
};

}  // namespace harmorph
