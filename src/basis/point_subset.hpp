// A basis of some of the points: one process of a flow solver needs it for its part of the mesh.
// The basis has no cells. Rows of values travel between processes in packed form.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

struct PointList {
    static constexpr Index max_count = Mesh::max_points;

    Index index_base = 0;
    Span<const Index> point;

    Index count() const noexcept { return point.count(); }
    Index operator[](Index k) const noexcept { return point[k] - index_base; }
    // Returns the fingerprint of the points of the list in their order; the points of `from` may
    // themselves come from a list. The list of all points of `from` in their order has the
    // fingerprint of `from`.
    std::uint64_t fingerprint(Basis const& from) const noexcept;
    static Status check_length(Index n, Fault& fault) noexcept;
    // Checks that all points of the list are in the mesh.
    Status check(Index n_points, Fault& fault) const noexcept;
};

struct Extract {
    // A point of the whole basis that is on the wall, or joined to a point of the wall.
    struct WallPoint {
        Index point, slot;
    };

    Span<WallPoint> wall;  // [wall and joined points of the whole] Sorted by point.
    // [wall points of the whole] The position in the list of the first point that belongs to the
    // slot.
    Span<Index> position;
    Span<Index> slot;  // [wall points of the whole] The number of the slot in the extract.
    Basis basis;

    static void count(Arena& arena, Basis const& whole, Index n_points) noexcept;
    // Finds the points of the list that are on the wall, then lays out the exact sizes. If the
    // arena overflows, the result must not be used.
    void lay_out(Arena& arena, Basis const& whole, PointList const& list) noexcept;
    // Copies all but the values. The result has all functions, even if `whole` stores only some of
    // them.
    void init(Basis const& whole, PointList const& list) const noexcept;
    // Copies the values of a complete basis, and seals the extract.
    void copy_rows(Basis const& whole, PointList const& list) const noexcept;

private:
    void take_work(Arena& arena, Basis const& whole) noexcept;
    void find_wall_points(Basis const& whole, PointList const& list) const noexcept;
    Index slot_of(Index point) const noexcept;
    // Calls body(k, slot of the whole) for entries of the list that equal a wall point earlier in
    // the list, or are joined to one.
    template <class Body>
    void for_each_joined(PointList const& list, Body const& body) const noexcept;
};

// Parcels of rows. A process that has solved some of the functions sends them to a process that has
// some of the points.

// A parcel is an array of doubles: the label, then the points' rows in the order of the list, each
// plane by plane.
struct ParcelLabel {
    static constexpr std::uint64_t mark = 0x6c65637261706d68;  // The bytes are "hmparcel".

    std::uint64_t magic;
    MeshFingerprint topology;  // The fingerprints of the basis.
    std::uint64_t coordinates, conditions, list;
    // A fingerprint of the curves and of the energy that the functions minimise.
    std::uint64_t functions;
    Real largest;
    Index points, first, n, numbers;
};
inline constexpr Offset label_words = sizeof(ParcelLabel) / sizeof(Real);

inline Offset parcel_words(Basis const& share, Index n_points) noexcept {
    return label_words + Offset{n_points} * share.row_length();
}
void pack_parcel(Basis const& share, PointList const& list, Real* parcel) noexcept;

// Adds the next functions to an extract, which is solved once the last functions are added.
Status unpack_parcel(Basis const& rows, const Real* parcel, Offset words, Fault& fault) noexcept;

}  // namespace harmorph
