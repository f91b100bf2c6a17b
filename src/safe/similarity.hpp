// Finds the similarity z -> c + d + r (z - c) that fits movements of points best.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

struct Similarity {
    // A body that collapses or turns inside out has a smaller ratio than this; the path of such a
    // body goes straight.
    static constexpr Real min_ratio = 0.05;

    Vec2 centre, shift, ratio{1, 0};  // c, d, r
    Index members = 0;
};

// The function for_each(visit) calls visit(point, movement) for each member. Least squares give c =
// mean of the points p, d = mean of the movements w, and r - 1 = sum conj(p - c) (w - d) / sum |p -
// c|^2. If |r| is too small, r is set to 1.
template <class ForEach>
Similarity fit_similarity(ForEach const& for_each) noexcept {
    Similarity fit;
    for_each([&](Vec2, Vec2) { ++fit.members; });
    if (fit.members == 0) return fit;
    Real const share = 1 / static_cast<Real>(fit.members);
    for_each([&](Vec2 point, Vec2 movement) {
        fit.centre = fit.centre + share * point;
        fit.shift = fit.shift + share * movement;
    });
    Vec2 turned;
    Real squares = 0;
    for_each([&](Vec2 point, Vec2 movement) {
        turned = turned + product(conjugate(point - fit.centre), movement - fit.shift);
        squares += square(point - fit.centre);
    });
    Vec2 const ratio = squares > 0 ? Vec2{1, 0} + (1 / squares) * turned : Vec2{};
    if (length(ratio) > Similarity::min_ratio) fit.ratio = ratio;
    return fit;
}

}  // namespace harmorph
