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

struct Analysis {
    Problem problem;           // of polygons, problem.mesh is the mesh of their pieces
    PolygonDivision division;  // polygons only
    Span<Curve> curves;        // set by the caller before run()
    Span<Curve>
        slip_along;  // those that the sliding boundaries have given; set by the caller before run()
    Span<Condition>
        conditions;     // set by the caller before run(); none: the analysis stops after the mesh
    Topology topology;  // of problem.mesh
    Index inverted = none;  // the first inverted cell
    Real least_height = 0;  // no corner of a cell is lower; guards of polygons apart
    Boundary boundary;
    Triangulation triangulation;  // bounded scheme only
    MeshFingerprint mesh_fingerprint;
    std::uint64_t conditions_fingerprint = 0;
    Span<PointKind> kinds;   // [n_points] without conditions: what is used by cells and what is not
    Span<Vec2> tangent;      // [n_points] where there are slip lines
    SlipCurves slip_curves;  // those of them that are curved
    SlipFollowers slip_followers;
    Periodicity periodicity;
    Wall wall;
    Graph graph;
    Span<Index> order;  // [n] unknown at each position
    AssemblyTree tree;
    BorderWork border;
    Span<Offset> border_start;  // [nodes + 1]
    FrontSizes fronts;
    Subtrees subtrees;
    Matrix::Sizes matrix;

    // Working arrays.
    OrientationWork orientation_work;
    WallWork wall_work;
    DissectionWork dissection_work;
    LayerWork layer_work;

    // Sizes from the counts alone.
    void lay_out(Arena& arena, Problem const& asked, Index n_curves, Index n_conditions) noexcept;
    Status run(Problem const& asked, Fault& fault) noexcept;

    bool has_conditions() const noexcept { return !conditions.empty(); }
    // Whose edges, and diagonals of quads, join the points that share an equation.
    Topology const& stencil() const noexcept {
        return problem.method.bounded() ? triangulation : topology;
    }
    BasisSource basis_source() const noexcept;
    BasisCounts basis_counts() const noexcept { return basis_source().counts(); }
    bool is_wall_face(Index face) const noexcept;  // one that moves as it is told
    Index count_wall_faces() const noexcept;
    Index count_used_points() const noexcept;

private:
    MatrixKind matrix_kind() const noexcept;
    Status analyse_mesh(Fault& fault) noexcept;
    Status analyse_unknowns(Fault& fault) noexcept;
    void find_wall(Fault& fault) noexcept;
    Status check_heights(Fault& fault) const noexcept;
    Status check_offsets(Fault& fault) const noexcept;
    Status check_parts(Fault& fault) noexcept;
    Status analyse_order(Fault& fault) noexcept;
};

}  // namespace harmorph
