#include "boundary/fluxes.hpp"

#include "base/hash.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

// Finds boundary faces by their two points. The faces that begin at one point form a list.
class FaceFinder {
public:
    explicit FaceFinder(Boundary const& boundary) noexcept
        : boundary_(boundary), head_(boundary.head), next_(boundary.next) {
        fill(head_, none);
        for_each_face([&](Index face, Index) {
            next_[face] = head_[boundary_.point[face]];
            head_[boundary_.point[face]] = face;
        });
    }

    Index find(Index a, Index b) const noexcept {
        Index const forwards = find_from(a, b);
        return forwards != none ? forwards : find_from(b, a);
    }

private:
    template <class Visit>
    void for_each_face(Visit const& visit) const noexcept {
        for (Index loop = 0; loop < boundary_.n_loops; ++loop) {
            for (Index face = boundary_.loop_start[loop]; face < boundary_.loop_start[loop + 1];
                 ++face)
                visit(face, loop);
        }
    }
    Index find_from(Index begin, Index end) const noexcept {
        for (Index face = head_[begin]; face != none; face = next_[face]) {
            if (boundary_.point[boundary_.after(face, loop_of(face))] == end) return face;
        }
        return none;
    }
    Index loop_of(Index face) const noexcept {
        Index low = 0, high = boundary_.n_loops;
        while (high - low > 1) {
            Index const middle = low + (high - low) / 2;
            (boundary_.loop_start[middle] <= face ? low : high) = middle;
        }
        return low;
    }

    Boundary const& boundary_;
    Span<Index> head_, next_;
};

}  // namespace

Status check_fluxes(Fluxes const& fluxes, Topology const& topology, Boundary const& boundary,
                    Span<const Condition> conditions, Fault& fault) noexcept {
    if (fluxes.count() == 0) return Status::ok;
    FaceFinder const faces(boundary);
    // named[face] tells whether a flux names the face.
    Span<Index> const named = boundary.given_marker;
    fill(named, Index{0});
    for (Index k = 0; k < fluxes.count(); ++k) {
        Index const a = fluxes.end(k, 0), b = fluxes.end(k, 1), n = topology.mesh.n_points;
        bool const exist = a >= 0 && a < n && b >= 0 && b < n;
        Index const face =
            exist ? faces.find(topology.representative[a], topology.representative[b]) : none;
        const char* wrong = nullptr;
        if (face == none) {
            wrong = "a flux names the points # and @, between which there is no boundary face";
        } else if (condition_of(conditions, boundary, face) == nullptr ||
                   condition_of(conditions, boundary, face)->kind != ConditionKind::free) {
            wrong = "a flux names the points # and @, but the face between them is not free";
        } else if (named[face] != 0) {
            wrong = "two fluxes name the face between the points # and @";
        }
        if (wrong != nullptr) {
            return fault.refuse(Status::bad_condition, wrong, point_item(a), point_item(b));
        }
        named[face] = 1;
        for (Index i = 0; i < fluxes.n_control; ++i) {
            Real const value = fluxes.of(k)[i];
            if (is_coordinate({value, 0})) continue;
            return fault.refuse(Status::bad_condition,
                                "the flux of control point # through the face at point @ is not "
                                "finite or beyond 1e100",
                                control_point_item(i), point_item(a));
        }
    }
    return Status::ok;
}

std::uint64_t fingerprint_with(std::uint64_t others, Fluxes const& fluxes) noexcept {
    if (fluxes.count() == 0) return others;
    Hash hash;
    hash.add(others);
    for (Index k = 0; k < fluxes.count(); ++k) {
        hash.add(static_cast<std::uint64_t>(min(fluxes.end(k, 0), fluxes.end(k, 1))));
        hash.add(static_cast<std::uint64_t>(max(fluxes.end(k, 0), fluxes.end(k, 1))));
        for (Index i = 0; i < fluxes.n_control; ++i) hash.add(bits_of(fluxes.of(k)[i]));
    }
    return hash.value();
}

}  // namespace harmorph
