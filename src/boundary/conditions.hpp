// Defines boundary conditions. Every point is on a wall (a curve, a rigid body, or given
// displacements), fixed, slipping, free, inside, or used by no cell.
#pragma once

#include "base/types.hpp"
#include "mesh/boundary.hpp"

namespace harmorph {

// The C header has the same numbers; condition_traits has a row for each.
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

// The kinds are in the order of precedence: if several conditions meet at a point, the first kind
// counts. Points of a periodic pair are inside. Among walls, curves precede rigid bodies, and these
// precede given displacements.
enum class PointKind : std::uint8_t { on_wall, fixed, slip, free, inside, unused };
constexpr bool is_unknown(PointKind kind) noexcept {
    return kind == PointKind::slip || kind == PointKind::free || kind == PointKind::inside;
}

// Fields of a condition that only some kinds have; they are 0 in all other kinds.
enum class ConditionField : unsigned { curves, along, body, centre, partner, piece };

// The table has one row for each kind: the kind of its points, and the fields that it has.
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
    // The curves on which the points lie (on_curve), or along which they slip (slip). For slip,
    // the numbers count the curves for slip, and n_curves may be 0.
    Index first_curve = 0, n_curves = 0;
    Index body = 0;     // rigid: the number of the body
    Index partner = 0;  // pairs: the marker onto which this marker is moved or rotated
    Vec2 centre;        // rigid, rotation: the centre of the rotation
    // If piece is 1, the condition holds only on the piece of the marker nearest to `near`.
    Index piece = 0, reserved = 0;
    Vec2 near;

    // Returns whether the table has a row for the kind; a damaged file may contain another number.
    bool is_known() const noexcept {
        return has_row(condition_traits, static_cast<std::int32_t>(kind));
    }
    ConditionTraits const& traits() const noexcept {
        return condition_traits[static_cast<std::int32_t>(kind)];
    }
    bool has(ConditionField field) const noexcept { return contains(traits().fields, field); }
    // Returns whether the points of the marker have prescribed movements.
    bool is_wall() const noexcept { return traits().points == PointKind::on_wall; }
    // Returns whether the marker is one side of a periodic pair.
    bool is_pair() const noexcept { return has(ConditionField::partner) && !is_interface(); }
    // Returns whether the condition says which markers may slide along each other, and not how
    // their points move.
    bool is_interface() const noexcept { return kind == ConditionKind::interface; }
    bool same_curves(Condition const& other) const noexcept {
        return first_curve == other.first_curve && n_curves == other.n_curves;
    }
};

// Collects what all conditions together require; this is known before memory is laid out.
struct Demands {
    Index bodies = 0;        // the number of rigid bodies
    Offset slip_curves = 0;  // the number of curves for slip
    bool slip = false, free = false, given = false;
    bool translation = false, rotation = false;  // the kinds of periodic pairs
    bool interfaces = false;

    bool periodic() const noexcept { return translation || rotation; }

    // Returns whether a function can be solved for.
    bool any_wall(Index n_curves) const noexcept { return n_curves > 0 || bodies > 0 || given; }

    void add(Condition const& condition) noexcept;
};

// Writes the condition of each face to boundary.condition. A piece of a marker is a chain of its
// faces along a loop.
void assign_conditions(Points points, Span<const Condition> conditions,
                       Boundary& boundary) noexcept;

// Writes the side of a sliding interface on which each face lies (see BoundaryFaces) to `side`,
// which has boundary.count entries, or is empty if there are no interfaces.
void find_interface_sides(Boundary const& boundary, Span<const Condition> conditions,
                          Span<Index> side) noexcept;

// Refuses wrong curves and bodies, markers without faces, and markers or pieces that are named
// twice. Conditions must have been assigned.
Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary,
                        Fault& fault) noexcept;

// Returns the condition of a face; null means fixed.
inline const Condition* condition_of(Span<const Condition> conditions, Boundary const& boundary,
                                     Index face) noexcept {
    return boundary.condition[face] == none ? nullptr : &conditions[boundary.condition[face]];
}

// Computes kinds [n_points]. A point that is joined to another point counts as unused.
void classify(Edges const& edges, Boundary const& boundary, Span<const Condition> conditions,
              Span<PointKind> kinds) noexcept;

}  // namespace harmorph
