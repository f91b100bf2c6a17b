// The basis: one relocatable block that holds the solved functions and everything that is needed to
// use them with the mesh.
#pragma once

#include "base/arena.hpp"
#include "basis/options.hpp"
#include "basis/point_blocks.hpp"
#include "boundary/moving_boundary.hpp"
#include "bspline/bspline.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesh/pieces.hpp"

namespace harmorph {

// Keeps the curves along which boundary points slip in the block of a basis.

// The curves follow each other in the order of the analysis. Curves that follow each other and have
// common control points share the copies of these.
struct KeptCurves {
    struct Counts {
        Index curves = 0, indices = 0, knots = 0, control = 0, weights = 0;
        Index reserved = 0;  // The counts are written and compared as bytes.
    };
    struct Shape {
        Index degree, n_indices, first_index, first_knot;
        Index first_control, n_control, rational, reserved;
    };
    Span<Shape> shape;    // [curves]
    Span<Index> indices;  // Control points count from first_control.
    Span<Real> knots;
    Span<Real> control;  // [2 * control]
    Span<Real> weights;  // [control], or empty if no curve is rational

    static Counts count(Span<const Curve> curves) noexcept;
    void lay_out(Arena& arena, Counts const& counts) noexcept;
    void copy_from(Span<const Curve> curves) const noexcept;
    void copy_from(KeptCurves const& other) const noexcept;
    Curve curve(Index number) const noexcept;
    // Tells whether the curves first .. first + count - 1 exist and have common control points.
    bool is_set(Index first, Index count) const noexcept;
    // Tells whether the data agree with the counts and all curves are well-formed.
    bool fit() const noexcept;

private:
    // Calls visit(number, first_control, is_new) for each curve; is_new tells whether its control
    // points differ from the ones of the curve before. Returns the number of control points.
    template <class Visit>
    static Index for_each(Span<const Curve> curves, Visit const& visit) noexcept;
};

struct BasisCounts {
    Index points = 0, cells = 0, control = 0, bodies = 0, curves = 0, indices = 0, knots = 0,
          weights = 0, wall = 0, joined = 0, boundary = 0, loops = 0, conditions = 0;
    // The number of boundary faces, if there are sliding interfaces; otherwise 0.
    Index sides = 0;
    // Pieces and guards of polygons; both are 0 if all cells are triangles and quads.
    Index pieces = 0, guards = 0;
    // The number of functions of design variables, and of numbers in an entry of their matrix; 0
    // means that there are none.
    Index combined = 0, combination = 0;
    Index shared = 0;          // See SharedPoint.
    Index modes = 0;           // Functions with values from a table; they follow all others.
    KeptCurves::Counts along;  // The curves along which points slip.
    // The functions whose values are stored here: all functions, or the share of one process.
    Index first_stored = 0, stored = 0;
    ValueKind kind = ValueKind::real;
    // The precision of the values; see derived_basis.hpp.
    Precision storage = Precision::in_double;

    // Returns the number of functions of control points, or of design variables.
    Index shapes() const noexcept { return combination == 0 ? control : combined; }
    // Returns the number of all functions: shapes, two for each rigid body (translation and
    // rotation), and modes.
    Index functions() const noexcept { return shapes() + 2 * bodies + modes; }
    bool complete() const noexcept { return stored == functions(); }
    // Tells whether combined functions or modes are among the functions. The values on the wall are
    // then known from the stored values alone.
    bool derived() const noexcept { return combination != 0 || modes != 0; }
    // Returns the counts of the same basis with the n functions that begin with `first`.
    BasisCounts share(Index first, Index n) const noexcept {
        BasisCounts counts = *this;
        counts.first_stored = first;
        counts.stored = n;
        return counts;
    }
};

// The functions that are not 0 at a point of the wall, and their values as complex numbers: always
// the functions of control points, even if functions are combined.
struct BoundaryFunctions {
    Index order = 0;
    Index function[max_order] = {};
    Vec2 value[max_order];
};

// Fingerprints of cells and markers of a mesh. Coordinates do not enter them.
struct MeshFingerprint {
    std::uint64_t cells = 0;  // The points of each cell, in order.
    // Which points are on which marker, in any order and layout of the
    // faces.
    std::uint64_t markers = 0;
    std::uint64_t sample = 0;  // The points of a few cells; see sample_of().
};

constexpr bool operator==(MeshFingerprint const& a, MeshFingerprint const& b) noexcept {
    return a.cells == b.cells && a.markers == b.markers;
}

// The first bytes of the block. All the rest follows in the order of Basis::lay_out, which the
// counts determine.
struct BasisHeader {
    static constexpr std::uint32_t current_format = 13, native_order = 0x01020304;
    static constexpr char expected_magic[8] = {'h', 'a', 'r', 'm', 'o', 'r', 'p', 'h'};

    char magic[8];
    std::uint32_t format;
    std::uint32_t byte_order;  // Equal to native_order on the machine that wrote the block.
    std::uint64_t bytes;       // The size of the whole block.
    std::uint64_t checksum;    // The checksum of all that follows this field.
    MeshFingerprint topology;
    std::uint64_t coordinates;
    // A fingerprint of the conditions on the boundary: kinds of points, places on curves, and
    // curves that are given for slipping.
    std::uint64_t conditions;
    // A fingerprint of the list of an extract, see PointList; 0 means all points of the mesh.
    std::uint64_t list;
    std::int32_t solved;
    Index index_base;  // Points and cells of the mesh count from this base in reports.
    BasisCounts counts;
    Method method;
    // No value is larger in magnitude. The sums of the adjoint are scaled by this number.
    Real largest;
    Index filled;  // The first functions up to this number have values; see point_subset.hpp.
};

// Views into the block.
struct Basis {
    struct CurveShape {
        Index degree, n_indices, first_index, first_knot;
    };

    BasisHeader* header = nullptr;
    Span<CurveShape> shape;  // [curves]
    Span<Index> indices;     // The indices of all curves; control points count from 0.
    Span<Real> knots;        // The knots of all curves.
    Span<Real> control;      // [2 * control points]
    Span<Real> weights;      // [control points] or empty
    // [control points x combined x numbers] The movement of control points by variables.
    Span<Real> combination;
    Span<Condition> conditions;
    KeptCurves along;                    // Conditions with slip name these curves.
    Span<Index> wall_point, wall_curve;  // [wall]
    Span<Real> wall_u;
    Span<Vec2> wall_offset;
    Span<Vec2> wall_start;         // [wall] The places of these points when the basis was made.
    Span<Index> shared_point;      // [shared] See SharedPoint.
    Span<Index> shared_condition;  // [2 * shared]
    Span<WallPlace> shared_place;  // [shared] The place by the second condition.
    Span<Index> shared_slot;       // [shared]
    // [joined] Points that are joined to the point of a slot of the wall: they are on the other
    // side of a cut.
    Span<Index> joined_point, joined_slot;
    Span<Index> boundary_point;   // [boundary] See Boundary.
    Span<Index> loop_start;       // [loops + 1]
    Span<Index> interface_side;   // [boundary] or empty: see BoundaryFaces
    Span<std::uint8_t> reversed;  // [cells], or [pieces + guards]
    Pieces pieces;                // The pieces of polygons.
    // The values of the points, or in single storage of the slots of the wall, in blocks of
    // points (point_blocks.hpp). A point has row_length() numbers, see ValueKind.
    Span<Real> value;
    // The values of the points in single storage; they are 0 at the wall and at points joined to
    // it.
    Span<float> single;

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    static Size bytes(BasisCounts const& counts) noexcept;
    // Returns views of a block that begins at `block` and has a valid header; fast enough for
    // every call.
    static Basis view(void* block) noexcept;
    static const Basis view(const void* block) noexcept;

    // Returns the cells of a mesh with the counts of the basis: the mesh's own cells, or the pieces
    // that the basis keeps.
    OrientedMesh cells(Mesh const& mesh) const noexcept;
    BoundaryFaces faces() const noexcept { return {boundary_point, loop_start, interface_side}; }
    Index n_points() const noexcept { return header->counts.points; }
    Index n_functions() const noexcept { return header->counts.stored; }
    ValueKind kind() const noexcept { return header->counts.kind; }
    Index row_length() const noexcept { return numbers_of(kind()) * n_functions(); }
    bool in_single() const noexcept { return header->counts.storage == Precision::in_single; }
    // Returns the values of a point in double precision; in single storage, the values of a slot of
    // the wall.
    RowInBlock<Real> row(Index point) const noexcept { return {value.data(), row_length(), point}; }
    RowInBlock<float> single_row(Index point) const noexcept {
        return {single.data(), row_length(), point};
    }
    // Stores number `number` of the rows of all points in `out`.
    void column(Index number, Real* out, Offset stride = 1) const noexcept;
    // Refuses single storage, for calls that write values or compute others from them.
    Status require_double(Fault& fault) const noexcept;
    // Refuses combined functions and modes, for calls that evaluate boundary functions again.
    Status require_control_points(Fault& fault) const noexcept;
    Curve curve(Index number) const noexcept;
    WallPlace place(Index slot) const noexcept {
        return {wall_curve[slot], wall_u[slot], wall_offset[slot]};
    }
    bool is_on_curve(WallPlace const& at) const noexcept {
        return at.curve < header->counts.curves;
    }
    bool is_on_curve(Index slot) const noexcept { return is_on_curve(place(slot)); }
    // Tells whether the displacement of the point is given from call to call, so that only modes
    // move it.
    bool is_given(WallPlace const& at) const noexcept {
        return at.curve == header->counts.curves + header->counts.bodies;
    }
    bool is_given(Index slot) const noexcept { return is_given(place(slot)); }
    // Returns a complex number; valid only if functions are combined.
    Vec2 combination_at(Index control_point, Index variable) const noexcept;
    // control_move() and wall_move() return the movement of a control point and of a point of the
    // wall that follows from the movements of functions, [2 * functions] x,y pairs. If modes move
    // the point, the basis must be in double precision.
    Vec2 control_move(Index control_point, const Real* move) const noexcept;
    Vec2 wall_move(Index slot, const Real* move) const noexcept;
    // Returns the movement of a place that is not given.
    Vec2 wall_move(WallPlace const& at, const Real* move) const noexcept;
    // Returns the boundary functions at a point of the wall: evaluated from the parameter, or the
    // movements of the rigid body. There are none at a given point.
    BoundaryFunctions boundary_functions(WallPlace const& at) const noexcept;
    BoundaryFunctions boundary_functions(Index slot) const noexcept {
        return boundary_functions(place(slot));
    }
    // Returns those of the functions whose values are stored here, numbered from the first of
    // these.
    BoundaryFunctions stored_boundary_functions(Index slot) const noexcept;

    // Marks the basis as solved and sets the largest value and the checksum. The largest value is
    // at least `at_least`, which serves for a basis that is a share or extract of another.
    void seal(Real at_least = 0, Executor const& executor = {}) const noexcept;
    void unseal() const noexcept;
};

std::uint64_t checksum_of(BasisHeader const& header, Executor const& executor = {}) noexcept;
MeshFingerprint fingerprint_of(Mesh const& mesh) noexcept;
// Returns the fingerprint of 64 cells spread over the mesh, in any layout; fast enough for
// every call. A mesh with other numbers is recognised if one of these cells differs.
std::uint64_t sample_of(Mesh const& mesh) noexcept;
std::uint64_t coordinates_fingerprint(Points points, Index n_points) noexcept;

// Tells whether the block is a solved basis, complete, undamaged, and of this mesh (null: any
// mesh). Returns Status::moved if only coordinates differ. Calls with an accepted block never read
// outside it. If the block is truncated, fault.value is the number of missing bytes.
Status check_basis(const void* block, Size bytes, const Mesh* mesh, Fault& fault) noexcept;

}  // namespace harmorph
