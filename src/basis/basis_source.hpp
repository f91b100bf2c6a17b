// What a basis keeps of the problem that its functions are solved for.
#pragma once

#include "basis/basis.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Views; an analysis has all of it.
struct BasisSource {
    Topology const& topology;
    MeshFingerprint mesh_fingerprint;
    std::uint64_t conditions_fingerprint;
    Method const& method;
    Demands const& demands;
    Span<const Curve> curves;
    Span<const Condition> conditions;
    Boundary const& boundary;
    Wall const& wall;
    Span<const Index> slot;          // [n_points] number of a point on the wall, or none
    const Pieces* pieces = nullptr;  // of polygons

    // Of a basis with all functions.
    BasisCounts counts() const noexcept;
    // body(point, slot) for points that are not in the wall's list but joined to one that is:
    // beyond a cut.
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

// Makes an unsolved basis in a block that has been laid out for these counts, the source's or a
// share of them.
void init_basis(Basis const& basis, BasisCounts const& counts, BasisSource const& source,
                Executor const& executor = {}) noexcept;

}  // namespace harmorph
