// Parcels of rows. A process that has solved some of the functions sends them to a process that has
// some of the points.
#pragma once

#include "basis/point_subset.hpp"

namespace harmorph {

// A parcel is an array of doubles: the label, then the points' rows in the order of the list, each
// plane by plane.
struct ParcelLabel {
    static constexpr std::uint64_t mark = 0x6c65637261706d68;  // The bytes are "hmparcel".

    std::uint64_t magic;
    MeshFingerprint topology;  // The fingerprints are those of the basis.
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
