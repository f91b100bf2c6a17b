// Parcels of rows that a process with some of the functions solved sends to a process with some of
// the points.
#pragma once

#include "basis/point_subset.hpp"

namespace harmorph {

// A parcel is an array of doubles: the label, then the points' rows in the order of the list, each
// plane by plane.
struct ParcelLabel {
    static constexpr std::uint64_t mark = 0x6c65637261706d68;  // "hmparcel"

    std::uint64_t magic;
    MeshFingerprint topology;  // fingerprints as in the basis
    std::uint64_t coordinates, conditions, list;
    std::uint64_t functions;  // fingerprint of the curves and of what the functions minimise
    Real largest;
    Index points, first, n, numbers;
};
inline constexpr Offset label_words = sizeof(ParcelLabel) / sizeof(Real);

inline Offset parcel_words(Basis const& share, Index n_points) noexcept {
    return label_words + Offset{n_points} * share.row_length();
}
void pack_parcel(Basis const& share, PointList const& list, Real* parcel) noexcept;

// The next functions of an extract; with the last ones it is solved.
Status unpack_parcel(Basis const& rows, const Real* parcel, Offset words, Fault& fault) noexcept;

}  // namespace harmorph
