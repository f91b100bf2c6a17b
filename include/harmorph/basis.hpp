// The basis: one relocatable block that holds the solved functions and all that is needed to use them with the mesh.
#pragma once

#include "harmorph/arena.hpp"
#include "harmorph/bspline.hpp"
#include "harmorph/conditions.hpp"
#include "harmorph/processor.hpp"
#include "harmorph/wall.hpp"

namespace harmorph {

enum class Scheme : std::int32_t { compact = 0, nodal_gradient = 1, bounded = 2 };

// How the functions were solved; the numbers are those of the C header.
struct Method {
    std::int32_t operator_kind = 0, scheme = 0, engine = 0;
    Kernel kernel = Kernel::automatic;
    Real tolerance = 1e-10;

    bool bounded() const noexcept { return scheme == static_cast<std::int32_t>(Scheme::bounded); }
};

struct BasisCounts {
    Index points = 0, cells = 0, functions = 0, curves = 0, indices = 0, knots = 0, weights = 0, wall = 0, boundary = 0,
          loops = 0, conditions = 0;
};

// The first bytes of the block. Everything else follows in the order of Basis::lay_out, which the counts determine.
struct BasisHeader {
    static constexpr std::uint32_t current_format = 1, native_order = 0x01020304;

    char magic[8];                // "harmorph"
    std::uint32_t format;
    std::uint32_t byte_order;     // native_order where it was written
    std::uint64_t bytes;          // of the whole block
    std::uint64_t checksum;       // of all that follows this field
    std::uint64_t topology;       // fingerprints of the mesh
    std::uint64_t coordinates;
    std::uint64_t conditions;     // fingerprint of what is asked on the boundary: points on curves, kinds of points
    std::int32_t solved;
    Index index_base;             // of the mesh: what points and cells count from in reports
    BasisCounts counts;
    Method method;
};

// Views into the block.
struct Basis {
    struct CurveShape {
        Index degree, n_indices, first_index, first_knot;
    };

    BasisHeader* header = nullptr;
    Span<CurveShape> shape;        // [curves]
    Span<Index> indices;           // of all curves, control points counted from 0
    Span<Real> knots;              // of all curves
    Span<Real> control;            // [2 * functions]
    Span<Real> weights;            // [functions] or empty
    Span<Condition> conditions;
    Span<Index> wall_point, wall_curve;  // [wall]
    Span<Real> wall_u;
    Span<Index> boundary_point;    // [boundary] see Boundary
    Span<Index> loop_start;        // [loops + 1]
    Span<std::uint8_t> reversed;   // [cells]
    Span<Real> value;              // [points x functions], a row for each point

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    static Size bytes(BasisCounts const& counts) noexcept;
    // Views of a block that begins at `block` and has a valid header; cheap enough for every call.
    static Basis view(void* block) noexcept;
    static const Basis view(const void* block) noexcept;

    Index n_points() const noexcept { return header->counts.points; }
    Index n_functions() const noexcept { return header->counts.functions; }
    Real* row(Index point) const noexcept { return value.data() + Offset{point} * n_functions(); }
    Curve curve(Index number) const noexcept;
    // The boundary functions at a point of the wall, evaluated from its parameter.
    CurveBasis boundary_functions(Index slot) const noexcept { return curve_basis(curve(wall_curve[slot]), wall_u[slot], 0); }

    void seal() const noexcept;  // solved, with checksum
    void unseal() const noexcept;
};

std::uint64_t topology_print(Mesh const& mesh) noexcept;
std::uint64_t coordinates_print(Points points, Index n_points) noexcept;

// Is the block a solved basis, whole, undamaged, and of this mesh (null: any)? Status::moved if only coordinates differ.
Status check_basis(const void* block, Size bytes, const Mesh* mesh, Fault& fault) noexcept;

}  // namespace harmorph
