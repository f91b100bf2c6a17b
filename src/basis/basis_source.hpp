// The data that a basis keeps of the problem for which its functions are solved.
// tests/basis/test_basis.cpp covers this file.
#pragma once

#include "basis/basis.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Views of arrays that belong to an analysis.
struct BasisSource {
    Topology const& topology;
    MeshFingerprint mesh_fingerprint;
    std::uint64_t conditions_fingerprint;
    Method const& method;
    Demands const& demands;
    Span<const Curve> curves;
    Span<const Curve> along;  // The curves along which points slip.
    Span<const Condition> conditions;
    Boundary const& boundary;
    Wall const& wall;
    Span<const Index> slot;  // [n_points] The number of a point in the list of the wall, or none.
    const Pieces* pieces = nullptr;  // The pieces of polygons.

    // Returns the counts of a basis with all functions.
    BasisCounts counts() const noexcept;
    // Calls body(point, slot) for points that are not in the wall's list but joined to a point of
    // the list: they are on the other side of a cut.
    template <class Body>
    void for_each_joined(Body const& body) const noexcept {
        Span<const Index> const representative = topology.representative;
        for (Index point = 0; point < representative.count(); ++point) {
            if (representative[point] == point || slot[point] != none) continue;
            Index const on_wall = slot[representative[point]];
            if (on_wall != none) body(point, on_wall);
        }
    }
};

// Makes an unsolved basis in a block that has been laid out for these counts: the counts of the
// source, or of a share of the functions.
void init_basis(Basis const& basis, BasisCounts const& counts, BasisSource const& source,
                Executor const& executor = {}) noexcept;

}  // namespace harmorph
