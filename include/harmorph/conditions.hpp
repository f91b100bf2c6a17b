// What is asked of the boundary: every point is on a curve, fixed, free, inside, or used by no cell.
#pragma once

#include "harmorph/boundary.hpp"

namespace harmorph {

enum class ConditionKind : std::int32_t { on_curve = 0, fixed = 1, free = 2 };

struct Condition {
    Index marker = 0;
    ConditionKind kind = ConditionKind::fixed;
    Index first_curve = 0, n_curves = 0;  // on curve: one of these

    bool same_curves(Condition const& other) const noexcept {
        return first_curve == other.first_curve && n_curves == other.n_curves;
    }
};

// In the order of precedence: of several conditions at a point the first holds.
enum class PointKind : std::uint8_t { on_curve, fixed, free, inside, unused };
constexpr bool is_unknown(PointKind kind) noexcept { return kind == PointKind::free || kind == PointKind::inside; }

// Kinds, curves, markers that no face has, markers named twice.
Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary, Fault& fault) noexcept;

// The condition of a marker; null means fixed.
const Condition* condition_of(Span<const Condition> conditions, Index marker) noexcept;

// kinds [n_points]. Points that are joined to another one count as unused.
void classify(Mesh const& mesh, Boundary const& boundary, Span<const Index> representative,
              Span<const Condition> conditions, Span<PointKind> kinds) noexcept;

}  // namespace harmorph
