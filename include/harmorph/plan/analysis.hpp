// Everything that depends on the mesh's structure and not on the size of numbers: checks, boundary, unknowns, ordering.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "harmorph/mesh/boundary.hpp"
#include "harmorph/mesh/delaunay.hpp"
#include "harmorph/base/executor.hpp"
#include "harmorph/ordering/symbolic.hpp"
#include "harmorph/multigrid/iteration.hpp"
#include "harmorph/ordering/advancing_front.hpp"
#include "harmorph/operators/matrix.hpp"
#include "harmorph/mesh/orientation.hpp"
#include "harmorph/boundary/periodic.hpp"
#include "harmorph/base/progress.hpp"
#include "harmorph/boundary/slip.hpp"
#include "harmorph/ordering/subtrees.hpp"
#include "harmorph/boundary/moving_boundary.hpp"

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
    Problem problem;
    Span<Curve> curves;           // set by the caller before run()
    Span<Condition> conditions;   // set by the caller before run(); none: the analysis stops after the mesh
    Span<Index> representative;   // [n_points] joined points: the smallest of them
    Span<std::uint8_t> reversed;  // [n_cells]
    Index inverted = none;        // the first inverted cell
    Edges edges;
    Boundary boundary;
    Triangulation triangulation;  // bounded scheme only
    Topology topology;            // fingerprint of the mesh
    Span<PointKind> kinds;        // [n_points] without conditions: what is used by cells and what is not
    Span<Vec2> tangent;           // [n_points] where there are slip lines
    Translations translations;    // of periodic pairs
    Wall wall;
    Graph graph;
    Span<Index> order;            // [n] unknown at each position
    AssemblyTree tree;
    BorderWork border;
    Span<Offset> border_start;    // [nodes + 1]
    FrontSizes fronts;
    Subtrees subtrees;
    Matrix::Sizes matrix;

    // Working arrays.
    OrientationWork orientation_work;
    WallWork wall_work;
    DissectionWork dissection_work;
    LayerWork layer_work;

    // Sizes from the counts alone.
    void lay_out(Arena& arena, Problem const& its_problem, Index n_curves, Index n_conditions) noexcept;
    Status run(Problem const& its_problem, Fault& fault) noexcept;

    bool is_direct() const noexcept { return problem.method.engine == Engine::direct; }
    bool has_conditions() const noexcept { return !conditions.empty(); }
    // Whose edges, and diagonals of quads, join the points that share an equation.
    Mesh const& stencil_mesh() const noexcept { return problem.method.bounded() ? triangulation.mesh : problem.mesh; }
    Edges const& stencil_edges() const noexcept { return problem.method.bounded() ? triangulation.edges : edges; }
    BasisCounts basis_counts() const noexcept;
    // body(point, slot) for points that are not in the wall's list but at the place of one that is: beyond a cut.
    template <class Body>
    void for_each_joined(Body const& body) const noexcept {
        for (Index point = 0; point < problem.mesh.n_points; ++point) {
            if (representative[point] == point || wall_work.slot[point] != none) continue;
            Index const slot = wall_work.slot[representative[point]];
            if (slot != none) body(point, slot);
        }
    }
    bool is_wall_face(Index face) const noexcept;  // on a curve or a rigid body
    Index count_wall_faces() const noexcept;
    Index count_used_points() const noexcept;
    std::uint64_t conditions_fingerprint() const noexcept;

private:
    MatrixKind matrix_kind() const noexcept;
    Status analyse_mesh(Fault& fault) noexcept;
    Status analyse_unknowns(Fault& fault) noexcept;
    Status check_parts(Fault& fault) noexcept;
    Status analyse_order(Fault& fault) noexcept;
};

}  // namespace harmorph
