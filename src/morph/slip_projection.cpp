#include "morph/slip_projection.hpp"

namespace harmorph {
namespace {

void copy_points(Index n, Points from, MutablePoints to) noexcept {
    for (Index k = 0; k < n && from.x != to.x; ++k) to.set(k, from[k]);
}

}  // namespace

void SlipProjection::project(Points from, MutablePoints to) const noexcept {
    copy_points(n_points, from, to);
    followers.for_each(curves, [&](Index k, Index slot, Real share) {
        Vec2 const at = to[curves.point[slot]], back = curves.nearest(slot, at).at - at;
        if (back.x != 0 || back.y != 0) to.set(k, to[k] + share * back);
    });
    curves.for_each(
        [&](Index slot, Index point) { to.set(point, curves.nearest(slot, to[point]).at); });
}

void SlipProjection::differentiate(Points from, Points velocity, MutablePoints to) const noexcept {
    copy_points(n_points, velocity, to);
    auto const along_curve = [&](Index slot, Index point) {
        SlipCurves::Place const place = curves.nearest(slot, from[point]);
        return (place.stretch * dot(place.tangent, to[point])) * place.tangent;
    };
    followers.for_each(curves, [&](Index k, Index slot, Real share) {
        Index const point = curves.point[slot];
        to.set(k, to[k] + share * (along_curve(slot, point) - to[point]));
    });
    curves.for_each([&](Index slot, Index point) { to.set(point, along_curve(slot, point)); });
}

// With J the derivative of the nearest place, followers are moved by their shares of J - 1 times
// the points that slip.
void SlipProjection::transpose(Points from, Points derivative, MutablePoints to) const noexcept {
    copy_points(n_points, derivative, to);
    auto const add_followers = [&](Real sign) {
        followers.for_each(curves, [&](Index k, Index slot, Real share) {
            Index const point = curves.point[slot];
            to.set(point, to[point] + (sign * share) * to[k]);
        });
    };
    add_followers(1);
    curves.for_each([&](Index slot, Index point) {
        SlipCurves::Place const place = curves.nearest(slot, from[point]);
        to.set(point, (place.stretch * dot(place.tangent, to[point])) * place.tangent);
    });
    add_followers(-1);
}

}  // namespace harmorph
