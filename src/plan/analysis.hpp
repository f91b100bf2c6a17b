// The analysis: all that depends on the mesh's structure and not on the size of numbers, that is
// checks, boundary, unknowns and ordering. tests/boundary/test_conditions.cpp and
// tests/c_api/test_bad_input.cpp cover this file.
#pragma once

#include "base/executor.hpp"
#include "basis/basis_source.hpp"
#include "boundary/fluxes.hpp"
#include "boundary/moving_boundary.hpp"
#include "boundary/periodic.hpp"
#include "boundary/slip.hpp"
#include "boundary/slip_followers.hpp"
#include "mesh/boundary.hpp"
#include "mesh/delaunay.hpp"
#include "mesh/orientation.hpp"
#include "mesh/pieces.hpp"
#include "multigrid/iteration.hpp"
#include "operators/matrix.hpp"
#include "ordering/graph.hpp"
#include "ordering/subtrees.hpp"
#include "ordering/symbolic.hpp"

namespace harmorph {

// The caller's problem, except curves and conditions, as views of the caller's arrays.
struct Problem {
    Mesh mesh;
    GivenParameters given;
    Fluxes fluxes;
    Real max_curve_distance = infinity;
    Method method;
    Iteration iteration;
    Demands demands;
    Progress progress;
    Executor executor;
};

// run() fills all members. After Status::ok, the mesh is valid and its points are classified. If
// there are conditions, every unknown depends on a known value, and sizes and order of the matrix
// are known.
class Analysis {
public:
    // Lays out by the counts alone.
    void lay_out(Arena& arena, Problem const& asked, Index n_curves, Index n_conditions) noexcept;
    // The caller sets these before run(). slip_along() has the curves that conditions give for slip
    // boundaries. Without conditions the analysis stops after the mesh.
    Span<Curve> curves() const noexcept { return curves_; }
    Span<Curve> slip_along() const noexcept { return slip_along_; }
    Span<Condition> conditions() const noexcept { return conditions_; }
    Status run(Problem const& asked, Fault& fault) noexcept;

    bool has_conditions() const noexcept { return !conditions_.empty(); }
    // If cells are polygons, problem().mesh is the mesh of their pieces.
    Problem const& problem() const noexcept { return problem_; }
    Pieces const& pieces() const noexcept { return division_.pieces; }
    // The topology of problem().mesh.
    Topology const& topology() const noexcept { return topology_; }
    Boundary const& boundary() const noexcept { return boundary_; }
    // Without conditions the kinds only distinguish points that cells use from others.
    Span<PointKind> kinds() const noexcept { return kinds_; }  // [n_points]
    MeshFingerprint const& mesh_fingerprint() const noexcept { return mesh_fingerprint_; }
    Index count_used_points() const noexcept;

    // The members below are valid only with conditions.
    std::uint64_t conditions_fingerprint() const noexcept { return conditions_fingerprint_; }
    Wall const& wall() const noexcept { return wall_; }
    Span<Index> wall_slot() const noexcept { return wall_work_.slot; }  // [n_points]
    bool is_wall_face(Index face) const noexcept;  // Tells whether the face moves as prescribed.
    Index count_wall_faces() const noexcept;
    // [n_points] This array exists if there are slip lines.
    Span<Vec2> tangent() const noexcept { return tangent_; }
    // The curved slip lines.
    SlipCurves const& slip_curves() const noexcept { return slip_curves_; }
    SlipFollowers const& slip_followers() const noexcept { return slip_followers_; }
    Periodicity const& periodicity() const noexcept { return periodicity_; }
    // Points that share an equation are joined by the edges of this topology, or by diagonals of
    // its quads.
    Topology const& stencil() const noexcept {
        return problem_.method.bounded() ? triangulation_ : topology_;
    }
    // The triangulation exists for the bounded scheme only.
    Triangulation const& triangulation() const noexcept { return triangulation_; }
    Graph const& graph() const noexcept { return graph_; }
    Span<Index> order() const noexcept { return order_; }  // [n] The unknown at each position.
    BorderWork const& border() const noexcept { return border_; }
    Matrix::Sizes const& matrix_sizes() const noexcept { return matrix_; }
    // The members below are valid only for engines that factor.
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
    Status check_regions(Fault& fault) noexcept;
    Status analyse_order(Fault& fault) noexcept;

    Problem problem_;
    PolygonDivision division_;  // The division exists for polygons only.
    Span<Curve> curves_, slip_along_;
    Span<Condition> conditions_;
    Topology topology_;
    Index inverted_ = none;  // The first inverted cell.
    Real min_height_ = 0;    // No corner of a cell is lower than this, guards of polygons excepted.
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

    // The arrays below are working space.
    OrientationWork orientation_work_;
    WallWork wall_work_;
    DissectionWork dissection_work_;
    LayerWork layer_work_;
};

}  // namespace harmorph
