#include "morph/layer_bounds.hpp"

#include "base/angle.hpp"
#include "morph/point_gradient.hpp"

namespace harmorph {
namespace {

// A face beside the foot of an edge. The weight and the direction are those of the start.
struct LayerFace {
    Index from = none, to = none;
    Real weight = 1;
    Vec2 before;  // of length 1
    Vec2 now;     // the vector along the face

    bool given() const noexcept { return from != none && to != none; }
};

// One edge now and at the start. Vectors are complex numbers. With the directions o of the faces at
// the start and u now, the wall turns by T = S / |S|, S = sum of weight conj(o) u; the edge E,
// turned back, is e = conj(T) E. Then the ratio of heights is Re(conj(n) e) / (height at the
// start), n the normal at the start, and the cosine is Re(conj(E at the start) e) / (the lengths of
// both).
struct LayerState {
    LayerEdge edge;
    LayerFace face[2];
    Vec2 sum;            // S
    Vec2 turn;           // T
    Vec2 old_edge, now;  // E
    Vec2 normal;
    Real old_height;

    LayerState(LayerEdge const& given, Points at, Points start) noexcept : edge(given) {
        face[0].from = edge.previous;
        face[0].to = face[1].from = edge.foot;
        face[1].to = edge.next;
        Vec2 along[2];
        for (Index k = 0; k < 2; ++k) {
            if (!face[k].given()) continue;
            along[k] = start[face[k].to] - start[face[k].from];
            face[k].before = direction(along[k]);
            face[k].now = at[face[k].to] - at[face[k].from];
        }
        Vec2 tangent = face[0].given() ? face[0].before : face[1].before;
        if (face[0].given() && face[1].given()) {
            face[0].weight = length(along[1]);
            face[1].weight = length(along[0]);
            tangent = face[0].weight * face[0].before + face[1].weight * face[1].before;
        }
        for (LayerFace const& wall : face) {
            if (wall.given())
                sum = sum + wall.weight * product(conjugate(wall.before), direction(wall.now));
        }
        turn = direction(sum);
        if (turn.x == 0 && turn.y == 0) turn = {1, 0};
        old_edge = start[edge.top] - start[edge.foot];
        now = at[edge.top] - at[edge.foot];
        normal = left_of(direction(tangent));
        old_height = dot(old_edge, normal);
    }

    Real value(LayerValue which) const noexcept {
        Vec2 const turned_now = turned_back(now, turn);
        if (which == LayerValue::angle) return dot(direction(old_edge), direction(turned_now));
        Real const ratio = dot(turned_now, normal) / old_height;
        return which == LayerValue::stretch ? -ratio : ratio;
    }

    // Adds the derivatives of the value, multiplied by `scale`. `reference` is the vector of the
    // start with which the edge is compared, turned with the wall.
    void add_slopes(LayerValue which, Real scale, PointGradient const& gradient) const noexcept {
        Vec2 by_edge;
        Real by_turn = 0;
        if (which == LayerValue::angle) {
            Real const size = length(now);
            if (!(size > 0)) return;
            Vec2 const unit = direction(now), reference = turned(direction(old_edge), turn);
            // The value is the cosine of the angle between both unit vectors.
            Real const sine = cross(reference, unit);
            by_edge = -scale * sine / size * left_of(unit);
            by_turn = scale * sine;
        } else {
            Vec2 const reference = turned(normal, turn);
            Real const factor = (which == LayerValue::stretch ? -scale : scale) / old_height;
            by_edge = factor * reference;
            by_turn = factor * cross(reference, now);
        }
        gradient.add(edge.top, by_edge);
        gradient.add(edge.foot, -1 * by_edge);
        Real const size = length(sum);
        if (!(size > 0)) return;
        // The angle of T changes by Im(conj(T) dS) / |S|, and that of u by cross(u, d(now)) /
        // |now|.
        for (LayerFace const& wall : face) {
            Real const along = length(wall.now);
            if (!wall.given() || !(along > 0)) continue;
            Vec2 const unit = direction(wall.now), part = product(conjugate(wall.before), unit);
            Real const share = wall.weight * dot(turn, part) / size;
            Vec2 const by_end = by_turn * share / along * left_of(unit);
            gradient.add(wall.to, by_end);
            gradient.add(wall.from, -1 * by_end);
        }
    }
};

}  // namespace

SmoothMinimum find_layer_bound(Span<const LayerEdge> edges, LayerValue which, Real sharpness,
                               Points at, Points start, MutablePoints gradient) noexcept {
    SmoothMinimum found;
    found.sharpness = sharpness;
    for (LayerEdge const& edge : edges)
        found.note(LayerState(edge, at, start).value(which), edge.foot);
    found.shift = found.smallest;
    for (LayerEdge const& edge : edges)
        found.add(LayerState(edge, at, start).value(which), edge.foot);
    if (!gradient.given()) return found;
    PointGradient const all(gradient, 0, 2147483647);
    for (LayerEdge const& edge : edges) {
        LayerState const state(edge, at, start);
        Real const weight = found.weight(state.value(which)) / found.sum;
        if (weight > 0) state.add_slopes(which, weight, all);
    }
    return found;
}

}  // namespace harmorph
