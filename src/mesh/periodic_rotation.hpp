// The rotation of a periodic mesh, one passage of an annulus: it maps one boundary of each rotation
// pair to the other.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

struct Rotation {
    bool any = false;
    Vec2 centre;
    Vec2 turn{1, 0};  // cosine and sine of the angle, as a complex number: e^(i angle)

    // turn^times, exactly 1 for 0 times.
    Vec2 power(Index times) const noexcept {
        Vec2 out{1, 0};
        for (Index k = 0; k < absolute_of(times); ++k) out = k == 0 ? turn : product(out, turn);
        return times < 0 ? conjugate(out) : out;
    }
    Vec2 image(Vec2 point, Index times) const noexcept {
        return centre + product(power(times), point - centre);
    }

    // Several pairs of markers may turn about the same centre by the same angle, or back: times is
    // 1 or -1 then, and 0 where they do not.
    Index times_of(Vec2 other_centre, Vec2 other_turn) const noexcept {
        constexpr Real same_within = 1e-5;  // the precision of coordinates in files with few digits
        if (other_centre.x != centre.x || other_centre.y != centre.y) return 0;
        if (length(other_turn - turn) <= same_within) return 1;
        return length(other_turn - conjugate(turn)) <= same_within ? -1 : 0;
    }

private:
    static constexpr Index absolute_of(Index times) noexcept { return times < 0 ? -times : times; }
};

}  // namespace harmorph
