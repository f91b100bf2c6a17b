// Everything that depends on the mesh's structure and not on the size of numbers: checks, boundary,
// unknowns, ordering.
#pragma once

#include "basis/basis_source.hpp"
#include "mesh/boundary.hpp"
#include "mesh/delaunay.hpp"
#include "mesh/pieces.hpp"
#include "base/executor.hpp"
#include "ordering/symbolic.hpp"
#include "multigrid/iteration.hpp"
#include "ordering/advancing_front.hpp"
#include "operators/matrix.hpp"
#include "mesh/orientation.hpp"
#include "boundary/periodic.hpp"
#include "base/progress.hpp"
#include "boundary/slip.hpp"
#include "boundary/slip_followers.hpp"
#include "ordering/subtrees.hpp"
#include "boundary/moving_boundary.hpp"

namespace harmorph {

// What the caller wants, beside curves and conditions, as views of the caller's arrays.
struct Problem {
    Mesh mesh;
    GivenParameters given;
    Method method;
    Iteration iteration;
    Demands demands;
    Progress progress;
    Executor executor;
};

// run() fills everything in. Where it has returned Status::ok, the mesh is valid and its points are
// classified; where there are conditions, too, every unknown depends on a known value, and sizes
// and order of the matrix are known.
class Analysis {
public:
    // Sizes from the counts alone.
    void lay_out(Arena& arena, Problem const& asked, Index n_curves, Index n_conditions) noexcept;
    // The caller sets these before run(). slip_along: the curves that sliding boundaries have
    // given. No conditions: the analysis stops after the mesh.
    Span<Curve> curves() const noexcept { return curves_; }
    Span<Curve> slip_along() const noexcept { return slip_along_; }
    Span<Condition> conditions() const noexcept { return conditions_; }
    Status run(Problem const& asked, Fault& fault) noexcept;

    bool has_conditions() const noexcept { return !conditions_.empty(); }
    // If cells are polygons, problem().mesh is the mesh of their pieces.
    Problem const& problem() const noexcept { return problem_; }
    Pieces const& pieces() const noexcept { return division_.pieces; }
    Topology const& topology() const noexcept { return topology_; }  // of problem().mesh
    Boundary const& boundary() const noexcept { return boundary_; }
    // Without conditions the kinds tell points that cells use from others.
    Span<PointKind> kinds() const noexcept { return kinds_; }  // [n_points]
    MeshFingerprint const& mesh_fingerprint() const noexcept { return mesh_fingerprint_; }
    Index count_used_points() const noexcept;

    // Only with conditions.
    std::uint64_t conditions_fingerprint() const noexcept { return conditions_fingerprint_; }
    Wall const& wall() const noexcept { return wall_; }
    Span<Index> wall_slot() const noexcept { return wall_work_.slot; }  // [n_points]
    bool is_wall_face(Index face) const noexcept;  // does the face move as prescribed?
    Index count_wall_faces() const noexcept;
    Span<Vec2> tangent() const noexcept {
        return tangent_;
    }  // [n_points] where there are slip lines
    SlipCurves const& slip_curves() const noexcept { return slip_curves_; }  // the curved ones
    SlipFollowers const& slip_followers() const noexcept { return slip_followers_; }
    Periodicity const& periodicity() const noexcept { return periodicity_; }
    // Points that share an equation are joined by its edges, and by diagonals of its quads.
    Topology const& stencil() const noexcept {
        return problem_.method.bounded() ? triangulation_ : topology_;
    }
    Triangulation const& triangulation() const noexcept {
        return triangulation_;
    }  // bounded scheme
    Graph const& graph() const noexcept { return graph_; }
    Span<Index> order() const noexcept { return order_; }  // [n] unknown at each position
    BorderWork const& border() const noexcept { return border_; }
    Matrix::Sizes const& matrix_sizes() const noexcept { return matrix_; }
    // Only of engines that factor.
    AssemblyTree const& tree() const noexcept { return tree_; }
    Span<Offset> border_start() const noexcept { return border_start_; }  // [nodes + 1]
    FrontSizes const& fronts() const noexcept { return fronts_; }
    Subtrees const& subtrees() const noexcept { return subtrees_; }

    BasisSource basis_source() const noexcept;
    BasisCounts basis_counts() const noexcept { return basis_source().counts(); }

private:
    Status analyse_mesh(Fault& fault) noexcept;
    Status analyse_unknowns(Fault& fault) noexcept;
    void find_wall(Fault& fault) noexcept;
    Status check_heights(Fault& fault) const noexcept;
    Status check_offsets(Fault& fault) const noexcept;
    Status check_parts(Fault& fault) noexcept;
    Status analyse_order(Fault& fault) noexcept;

    Problem problem_;
    PolygonDivision division_;  // polygons only
    Span<Curve> curves_, slip_along_;
    Span<Condition> conditions_;
    Topology topology_;
    Index inverted_ = none;  // the first inverted cell
    Real least_height_ = 0;  // no corner of a cell is lower; guards of polygons apart
    Boundary boundary_;
    Triangulation triangulation_;
    MeshFingerprint mesh_fingerprint_;
    std::uint64_t conditions_fingerprint_ = 0;
    Span<PointKind> kinds_;
    Span<Vec2> tangent_;
    SlipCurves slip_curves_;
    SlipFollowers slip_followers_;
    Periodicity periodicity_;
    Wall wall_;
    Graph graph_;
    Span<Index> order_;
    AssemblyTree tree_;
    BorderWork border_;
    Span<Offset> border_start_;
    FrontSizes fronts_;
    Subtrees subtrees_;
    Matrix::Sizes matrix_;

    // Working arrays.
    OrientationWork orientation_work_;
    WallWork wall_work_;
    DissectionWork dissection_work_;
    LayerWork layer_work_;
};

}  // namespace harmorph
