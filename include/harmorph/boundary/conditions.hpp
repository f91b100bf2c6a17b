// Boundary conditions: every point is on a wall (a curve or a rigid body), fixed, slipping, free, inside, or used by no
// cell.
#pragma once

#include "harmorph/mesh/boundary.hpp"

namespace harmorph {

enum class ConditionKind : std::int32_t { on_curve = 0, rigid = 1, fixed = 2, slip = 3, free = 4, periodic = 5 };

struct Condition {
    Index marker = 0;
    ConditionKind kind = ConditionKind::fixed;
    Index first_curve = 0, n_curves = 0;  // on curve: one of these
    Index body = 0;                       // rigid: number of the body
    Index partner = 0;                    // periodic: the marker that is this one, moved
    Vec2 centre;                          // rigid: what the body turns about

    bool same_curves(Condition const& other) const noexcept {
        return first_curve == other.first_curve && n_curves == other.n_curves;
    }
};

// In the order of precedence: of several conditions at a point the first one counts. Points of a periodic pair are
// inside.
enum class PointKind : std::uint8_t { on_wall, fixed, slip, free, inside, unused };
constexpr bool is_unknown(PointKind kind) noexcept {
    return kind == PointKind::slip || kind == PointKind::free || kind == PointKind::inside;
}

// What the conditions together require; known before memory is laid out.
struct Demands {
    Index bodies = 0;       // rigid ones
    bool slip = false, free = false, periodic = false;

    void add(Condition const& condition) noexcept;
};

// Kinds, curves, bodies, markers that no face has, markers named twice.
Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary,
                        Fault& fault) noexcept;

// The condition of a marker; null means fixed.
const Condition* condition_of(Span<const Condition> conditions, Index marker) noexcept;

// kinds [n_points]. Points that are joined to another one count as unused.
void classify(Edges const& edges, Boundary const& boundary, Span<const Condition> conditions,
              Span<PointKind> kinds) noexcept;

}  // namespace harmorph
