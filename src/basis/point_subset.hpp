// A basis of some of the points: what one process of a flow solver needs for its part of the mesh.
// It has no cells.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

struct PointList {
    static constexpr Index most = Mesh::max_points;

    Index index_base = 0;
    Span<const Index> point;

    Index count() const noexcept { return point.count(); }
    Index operator[](Index k) const noexcept { return point[k] - index_base; }
    // The points of the list in their order, where the points of `from` themselves may be those of
    // a list. The list of all points of `from` in their order has the fingerprint of `from`.
    std::uint64_t fingerprint(Basis const& from) const noexcept;
    static Status check_length(Index n, Fault& fault) noexcept;
    // Are all of them points of the mesh?
    Status check(Index n_points, Fault& fault) const noexcept;
};

struct Extract {
    // A point of the whole that is on the wall, or joined to it.
    struct WallPoint {
        Index point, slot;
    };

    Span<WallPoint> wall;  // [wall and joined points of the whole] by point
    Span<Index>
        position;  // [wall points of the whole] where in the list a point of the slot stands first
    Span<Index> slot;  // [wall points of the whole] the slot's number in the extract
    Basis basis;

    static void count(Arena& arena, Basis const& whole, Index n_points) noexcept;
    // Finds the list's points of the wall, then lays out exactly. On overflow of the arena nothing
    // is to be used.
    void lay_out(Arena& arena, Basis const& whole, PointList const& list) noexcept;
    // Everything but the values. The result has all functions, also where `whole` stores only some
    // of them.
    void init(Basis const& whole, PointList const& list) const noexcept;
    // Of a whole basis, values and all; seals it.
    void copy_rows(Basis const& whole, PointList const& list) const noexcept;

private:
    void take_work(Arena& arena, Basis const& whole) noexcept;
    void find_wall_points(Basis const& whole, PointList const& list) const noexcept;
    Index slot_of(Index point) const noexcept;
    // body(k, slot of the whole) for entries of the list that are joined to a wall point, or equal
    // to one, earlier in the list.
    template <class Body>
    void for_each_joined(PointList const& list, Body const& body) const noexcept;
};

}  // namespace harmorph
