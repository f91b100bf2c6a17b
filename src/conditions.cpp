#include "harmorph/conditions.hpp"

namespace harmorph {

Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary, Fault& fault) noexcept {
    bool any_curve = false;
    for (Index i = 0; i < conditions.count(); ++i) {
        Condition const& condition = conditions[i];
        for (Index earlier = 0; earlier < i; ++earlier) {
            if (conditions[earlier].marker == condition.marker) {
                return fault.refuse(Status::bad_condition, "marker # has two conditions", Counts::from_zero, condition.marker);
            }
        }
        bool found = false;
        for (Index face = 0; face < boundary.count && !found; ++face) found = boundary.marker[face] == condition.marker;
        if (!found) {
            return fault.refuse(Status::bad_condition, "condition @ names marker #, which no boundary face has",
                                Counts::from_zero, condition.marker, i);
        }
        if (condition.kind != ConditionKind::on_curve) continue;
        any_curve = true;
        Offset const end = Offset{condition.first_curve} + condition.n_curves;
        if (condition.first_curve < 0 || condition.n_curves < 1 || end > n_curves) {
            return fault.refuse(Status::bad_condition, "condition # names curves that do not exist; there are @",
                                Counts::from_zero, i, n_curves);
        }
    }
    if (!any_curve) return fault.refuse(Status::bad_condition, "no condition puts a marker on a curve: there is nothing to solve");
    return Status::ok;
}

const Condition* condition_of(Span<const Condition> conditions, Index marker) noexcept {
    for (Condition const& condition : conditions) {
        if (condition.marker == marker) return &condition;
    }
    return nullptr;
}

void classify(Mesh const& mesh, Boundary const& boundary, Span<const Index> representative,
              Span<const Condition> conditions, Span<PointKind> kinds) noexcept {
    fill(kinds, PointKind::unused);
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        for (Index k = 0; k < cell.n; ++k) kinds[representative[cell.point[k]]] = PointKind::inside;
    }
    auto const strengthen = [&](Index point, PointKind kind) {
        if (kind < kinds[point]) kinds[point] = kind;
    };
    for (Index loop = 0; loop < boundary.n_loops; ++loop) {
        PointKind kind = PointKind::fixed;
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            bool const new_marker = face == boundary.loop_start[loop] || boundary.marker[face] != boundary.marker[face - 1];
            if (new_marker) {
                const Condition* const condition = condition_of(conditions, boundary.marker[face]);
                kind = condition == nullptr ? PointKind::fixed : static_cast<PointKind>(condition->kind);
            }
            strengthen(boundary.point[face], kind);
            strengthen(boundary.point[boundary.after(face, loop)], kind);
        }
    }
}

}  // namespace harmorph
