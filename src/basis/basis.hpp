// The basis: one relocatable block that holds the solved functions and all that is needed to use
// them with the mesh.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"
#include "basis/options.hpp"
#include "basis/point_blocks.hpp"
#include "boundary/moving_boundary.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesh/pieces.hpp"

namespace harmorph {

struct BasisCounts {
    Index points = 0, cells = 0, control = 0, bodies = 0, curves = 0, indices = 0, knots = 0,
          weights = 0, wall = 0, joined = 0, boundary = 0, loops = 0, conditions = 0;
    Index sides = 0;  // the faces of the boundary, if there are sliding interfaces; else 0
    Index pieces = 0, guards = 0;  // of polygons; 0: cells are triangles and quads
    // Functions of design variables, and numbers of an entry of their matrix; 0: none
    Index combined = 0, combination = 0;
    Index modes = 0;  // functions with values from a table, behind all others
    Index first_stored = 0,
          stored = 0;  // functions whose values are here: all of them, or those of one process
    ValueKind kind = ValueKind::real;
    Precision storage = Precision::in_double;  // of the values; see single_precision.hpp

    // One of each control point, or of each design variable.
    Index shapes() const noexcept { return combination == 0 ? control : combined; }
    // These, two of each rigid body: its translation, and its turn; and modes.
    Index functions() const noexcept { return shapes() + 2 * bodies + modes; }
    bool complete() const noexcept { return stored == functions(); }
    // Combined functions or modes are among them: the values on the wall are known from these
    // values alone.
    bool derived() const noexcept { return combination != 0 || modes != 0; }
    // The same basis, with n functions from the first one on.
    BasisCounts share(Index first, Index n) const noexcept {
        BasisCounts part = *this;
        part.first_stored = first;
        part.stored = n;
        return part;
    }
};

// The functions that are not 0 at a point of the wall, and their values as complex numbers; of
// control points, also where functions are combined.
struct BoundaryFunctions {
    Index order = 0;
    Index function[max_order] = {};
    Vec2 value[max_order];
};

// Fingerprints of cells and markers of a mesh; coordinates do not enter.
struct MeshFingerprint {
    std::uint64_t cells = 0;  // the points of each cell, in order
    std::uint64_t markers =
        0;  // which points are on which marker, however the faces are ordered and laid out
    std::uint64_t sample = 0;  // the points of a few cells: see sample_of
};

constexpr bool operator==(MeshFingerprint const& a, MeshFingerprint const& b) noexcept {
    return a.cells == b.cells && a.markers == b.markers;
}

// The first bytes of the block. Everything else follows in the order of Basis::lay_out, which the
// counts determine.
struct BasisHeader {
    static constexpr std::uint32_t current_format = 11, native_order = 0x01020304;
    static constexpr char expected_magic[8] = {'h', 'a', 'r', 'm', 'o', 'r', 'p', 'h'};

    char magic[8];
    std::uint32_t format;
    std::uint32_t byte_order;  // native_order where it was written
    std::uint64_t bytes;       // of the whole block
    std::uint64_t checksum;    // of all that follows this field
    MeshFingerprint topology;
    std::uint64_t coordinates;
    std::uint64_t conditions;  // fingerprint of what is asked on the boundary: kinds of points,
                               // places on curves, curves that are given for sliding
    std::uint64_t
        list;  // fingerprint of the list of an extract, see PointList; 0: all points of the mesh
    std::int32_t solved;
    Index index_base;  // of the mesh: what points and cells count from in reports
    BasisCounts counts;
    Method method;
    Real largest;  // no value is larger in magnitude: what the adjoint's sums are scaled by
    Index filled;  // functions whose values are there, from the first one on; see packed_rows.hpp
};

// Views into the block.
struct Basis {
    struct CurveShape {
        Index degree, n_indices, first_index, first_knot;
    };

    BasisHeader* header = nullptr;
    Span<CurveShape> shape;  // [curves]
    Span<Index> indices;     // of all curves, control points counted from 0
    Span<Real> knots;        // of all curves
    Span<Real> control;      // [2 * control points]
    Span<Real> weights;      // [control points] or empty
    Span<Real> combination;  // [control points x combined x numbers]: movement of control points by
                             // variables
    Span<Condition> conditions;
    Span<Index> wall_point, wall_curve;  // [wall]
    Span<Real> wall_u;
    Span<Vec2> wall_offset;
    Span<Vec2> wall_start;  // [wall] where these points were when the basis was made
    // [joined] points joined to that of a slot of the wall: the other side of a cut
    Span<Index> joined_point, joined_slot;
    Span<Index> boundary_point;   // [boundary] see Boundary
    Span<Index> loop_start;       // [loops + 1]
    Span<Index> interface_side;   // [boundary] or empty: see BoundaryFaces
    Span<std::uint8_t> reversed;  // [cells], or [pieces + guards]
    Pieces pieces;                // of polygons
    // In blocks of points, see point_blocks.hpp; the numbers of a point, row_length() of them, see
    // ValueKind.
    Span<Real> value;  // of the points; in single storage of the slots of the wall
    Span<float>
        single;  // in single storage, of the points; 0 at the wall and what is joined to the wall

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    static Size bytes(BasisCounts const& counts) noexcept;
    // Views of a block that begins at `block` and has a valid header; cheap enough for every call.
    static Basis view(void* block) noexcept;
    static const Basis view(const void* block) noexcept;

    // The cells of a mesh that belongs to the basis, as far as counts tell: those of the mesh, or
    // the pieces kept here.
    OrientedMesh cells(Mesh const& mesh) const noexcept;
    BoundaryFaces faces() const noexcept { return {boundary_point, loop_start, interface_side}; }
    Index n_points() const noexcept { return header->counts.points; }
    Index n_functions() const noexcept { return header->counts.stored; }
    ValueKind kind() const noexcept { return header->counts.kind; }
    Index row_length() const noexcept { return numbers_of(kind()) * n_functions(); }
    bool in_single() const noexcept { return header->counts.storage == Precision::in_single; }
    // Of values in double precision: of a point, or in single storage of a slot of the wall.
    RowInBlock<Real> row(Index point) const noexcept { return {value.data(), row_length(), point}; }
    RowInBlock<float> single_row(Index point) const noexcept {
        return {single.data(), row_length(), point};
    }
    // Number `number` of the rows of all points.
    void column(Index number, Real* out) const noexcept;
    // Refuses single storage: for calls that write values or compute others from them.
    Status require_double(Fault& fault) const noexcept;
    // Refuses combined functions and modes: for calls that evaluate boundary functions anew.
    Status require_control_points(Fault& fault) const noexcept;
    Curve curve(Index number) const noexcept;
    bool is_on_curve(Index slot) const noexcept { return wall_curve[slot] < header->counts.curves; }
    // Its displacement is given from call to call: only modes move it.
    bool is_given(Index slot) const noexcept {
        return wall_curve[slot] == header->counts.curves + header->counts.bodies;
    }
    // Complex; only where functions are combined.
    Vec2 combination_at(Index control_point, Index variable) const noexcept;
    // Of movements of functions, [2 * functions] x,y pairs: of a control point, and of a point of
    // the wall; in double precision only where modes move the point.
    Vec2 control_move(Index control_point, const Real* move) const noexcept;
    Vec2 wall_move(Index slot, const Real* move) const noexcept;
    // The boundary functions at a point of the wall: evaluated from the parameter, or the movements
    // of the rigid body. None at a given point.
    BoundaryFunctions boundary_functions(Index slot) const noexcept;
    // Those of functions whose values are here, numbered from the first of these.
    BoundaryFunctions stored_boundary_functions(Index slot) const noexcept;

    // Solved, with largest value and checksum. Of a part of a larger basis: that has values up to
    // at_least.
    void seal(Real at_least = 0, Executor const& executor = {}) const noexcept;
    void unseal() const noexcept;
};

std::uint64_t checksum_of(BasisHeader const& header, Executor const& executor = {}) noexcept;
MeshFingerprint fingerprint_of(Mesh const& mesh) noexcept;
// Of 64 cells spread over the mesh, whatever its layout: cheap enough for every call. A mesh with
// other numbers is told apart if one of these cells differs.
std::uint64_t sample_of(Mesh const& mesh) noexcept;
std::uint64_t coordinates_fingerprint(Points points, Index n_points) noexcept;

// Is the block a solved basis, whole, undamaged, and of this mesh (null: any)? Status::moved if
// only coordinates differ. Whatever is in a block that is accepted, nothing outside it is ever
// read. Of a truncated one fault.value are the bytes that are missing.
Status check_basis(const void* block, Size bytes, const Mesh* mesh, Fault& fault) noexcept;

}  // namespace harmorph
