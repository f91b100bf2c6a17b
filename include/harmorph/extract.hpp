// A basis of some of the points: what one process of a flow solver needs for its part of the mesh. It has no cells.
#pragma once

#include "harmorph/basis.hpp"

namespace harmorph {

struct PointList {
    Index index_base = 0;
    Span<const Index> point;

    Index count() const noexcept { return point.count(); }
    Index operator[](Index k) const noexcept { return point[k] - index_base; }
    // Are all of them points of the mesh?
    Status check(Index n_points, Fault& fault) const noexcept;
};

struct Extract {
    // A point of the wall, and where in the list it stands first.
    struct WallPlace {
        Index point, slot, position;
    };

    Span<WallPlace> wall;  // [wall points of the whole]
    Basis basis;

    static void count(Arena& arena, Basis const& whole, Index n_points) noexcept;
    // Finds the list's points of the wall, then lays out exactly. On overflow of the arena nothing is to be used.
    void lay_out(Arena& arena, Basis const& whole, PointList const& list) noexcept;
    // Everything but the values. The result holds all functions, also where `whole` has only a share of them.
    void init(Basis const& whole) const noexcept;
    // Of a whole basis, values and all; seals it.
    void copy_rows(Basis const& whole, PointList const& list) const noexcept;

private:
    Index find_wall_points(Basis const& whole, PointList const& list) const noexcept;
};

}  // namespace harmorph
