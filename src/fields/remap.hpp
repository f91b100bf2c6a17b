// Transfers means over control volumes from one mesh to another, so that integrals over the common
// area stay.
#pragma once

#include "base/executor.hpp"
#include "fields/corner_pieces.hpp"

namespace harmorph {

enum class RemapOrder { constant = 1, linear = 2 };

// The pieces of the control volumes are convex (fields/corner_pieces). For each volume of the mesh
// `to`, a tree of boxes finds the cells of the mesh `from` beside it, and each pair of pieces is
// clipped. As each volume of `to` adds up its own pairs in the order of the tree, the sums do not
// depend on threads.
struct Remap {
    struct Report {
        Index uncovered = 0, partial = 0;
        Real area = 0;

        void merge(Report const& other) noexcept {
            uncovered += other.uncovered;
            partial += other.partial;
            area += other.area;
        }
    };
    struct Fields {
        Index count = 0;
        const Real* from = nullptr;  // [count * points of from]
        Real* to = nullptr;          // [count * points of to]
    };
    // A volume counts as covered in part where more than this share of it is missing.
    static constexpr Real missing_share = 1e-9;

    void lay_out(Arena& arena, Mesh const& from, Mesh const& to, Index n_fields,
                 RemapOrder order) noexcept;
    // The meshes must have no inverted cell at these points.
    Report run(OrientedMesh const& from, Points from_at, OrientedMesh const& to, Points to_at,
               Fields const& fields, Span<Real> covered, Executor const& executor) noexcept;

private:
    // The matrix of the least squares of a volume, and the centroid, at which a linear field has
    // the mean value.
    struct Reconstruction {
        Real area = 0, xx = 0, xy = 0, yy = 0;
        Vec2 centroid;  // relative to the point

        void add_neighbour(Vec2 weighted, Vec2 apart) noexcept {
            xx += weighted.x * apart.x;
            xy += weighted.x * apart.y;
            yy += weighted.y * apart.y;
        }
    };

    void build_tree(OrientedMesh const& from, Points at) noexcept;
    void list_corners(OrientedMesh const& to) noexcept;
    void find_gradients(OrientedMesh const& from, Points at, Fields const& fields) noexcept;

    BoxTree tree_;
    Span<Index> start_;            // [points of to + 1]
    Span<Index> corner_;           // [4 * cells of to] 4 * cell + corner, point by point
    Span<Reconstruction> volume_;  // [points of from], second order alone
    Span<Vec2> gradient_;          // [fields * points of from], second order alone
};

}  // namespace harmorph
