// Boundary conditions: every point is on a wall (a curve, a rigid body, or given displacements),
// fixed, slipping, free, inside, or used by no cell.
#pragma once

#include "base/table.hpp"
#include "mesh/boundary.hpp"

namespace harmorph {

// The numbers are those of the C header and of the rows of condition_traits.
enum class ConditionKind : std::int32_t {
    on_curve = 0,
    rigid = 1,
    fixed = 2,
    slip = 3,
    free = 4,
    periodic = 5,
    given = 6,
    rotation = 7,
    interface = 8
};

// In the order of precedence: of several conditions at a point the first one counts. Points of a
// periodic pair are inside. Of several walls, curves come first, then rigid bodies, then given
// displacements.
enum class PointKind : std::uint8_t { on_wall, fixed, slip, free, inside, unused };
constexpr bool is_unknown(PointKind kind) noexcept {
    return kind == PointKind::slip || kind == PointKind::free || kind == PointKind::inside;
}

// Fields of a condition that are 0 in all kinds but some.
enum class ConditionField : unsigned { curves, along, body, centre, partner, piece };

// A row for each kind: what its points are, and which fields it has.
struct ConditionTraits {
    PointKind points;
    unsigned fields;
};
inline constexpr ConditionTraits condition_traits[] = {
    // on_curve
    {PointKind::on_wall, set_of(ConditionField::curves, ConditionField::piece)},
    // rigid
    {PointKind::on_wall,
     set_of(ConditionField::body, ConditionField::centre, ConditionField::piece)},
    // fixed
    {PointKind::fixed, set_of(ConditionField::piece)},
    // slip
    {PointKind::slip, set_of(ConditionField::along, ConditionField::piece)},
    // free
    {PointKind::free, set_of(ConditionField::piece)},
    // periodic
    {PointKind::inside, set_of(ConditionField::partner)},
    // given
    {PointKind::on_wall, set_of(ConditionField::piece)},
    // rotation
    {PointKind::inside, set_of(ConditionField::partner, ConditionField::centre)},
    // interface; its points are what the other conditions of the two markers make them
    {PointKind::fixed, set_of(ConditionField::partner)},
};

struct Condition {
    Index marker = 0;
    ConditionKind kind = ConditionKind::fixed;
    Index first_curve = 0,
          n_curves =
              0;     // on curve: one of these; slip: of those that are given for sliding, or none
    Index body = 0;  // rigid: number of the body
    Index partner = 0;              // of a pair: the marker that is this one, moved or turned
    Vec2 centre;                    // rigid, rotation: what the body, or the marker, turns about
    Index piece = 0, reserved = 0;  // 1: only the piece of the marker nearest to `near`
    Vec2 near;

    // Does the kind stand in the table? Not so in damaged files.
    bool is_known() const noexcept {
        return has_row(condition_traits, static_cast<std::int32_t>(kind));
    }
    ConditionTraits const& traits() const noexcept {
        return condition_traits[static_cast<std::int32_t>(kind)];
    }
    bool has(ConditionField field) const noexcept { return contains(traits().fields, field); }
    // Do the points of the marker move as prescribed?
    bool is_wall() const noexcept { return traits().points == PointKind::on_wall; }
    // Is the marker one side of a pair whose other one moves alike, or alike but turned?
    bool is_pair() const noexcept { return has(ConditionField::partner) && !is_interface(); }
    // The condition says which markers may slide along each other, not how their points move.
    bool is_interface() const noexcept { return kind == ConditionKind::interface; }
    bool same_curves(Condition const& other) const noexcept {
        return first_curve == other.first_curve && n_curves == other.n_curves;
    }
};

// What the conditions together require; known before memory is laid out.
struct Demands {
    Index bodies = 0;        // rigid ones
    Offset slip_curves = 0;  // given for sliding
    bool slip = false, free = false, given = false;
    bool translation = false, rotation = false;  // pairs
    bool interfaces = false;

    bool periodic() const noexcept { return translation || rotation; }

    // Is there anything to be solved for?
    bool any_wall(Index n_curves) const noexcept { return n_curves > 0 || bodies > 0 || given; }

    void add(Condition const& condition) noexcept;
};

// Which condition each face has, in boundary.condition. A piece is a run of faces of one marker
// along a loop.
void assign_conditions(Points points, Span<const Condition> conditions,
                       Boundary& boundary) noexcept;

// side [boundary.count], or empty: on which side of which sliding interface each face is, see
// BoundaryFaces.
void find_interface_sides(Boundary const& boundary, Span<const Condition> conditions,
                          Span<Index> side) noexcept;

// Kinds, curves, bodies, markers that no face has, markers and pieces named twice. Conditions are
// assigned.
Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary,
                        Fault& fault) noexcept;

// The condition of a face; null means fixed.
inline const Condition* condition_of(Span<const Condition> conditions, Boundary const& boundary,
                                     Index face) noexcept {
    return boundary.condition[face] == none ? nullptr : &conditions[boundary.condition[face]];
}

// kinds [n_points]. Points that are joined to another one count as unused.
void classify(Edges const& edges, Boundary const& boundary, Span<const Condition> conditions,
              Span<PointKind> kinds) noexcept;

}  // namespace harmorph
