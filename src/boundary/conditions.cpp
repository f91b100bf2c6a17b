#include "harmorph/boundary/conditions.hpp"

namespace harmorph {

namespace {

bool has_faces(Boundary const& boundary, Index marker) noexcept {
    for (Index face = 0; face < boundary.count; ++face) {
        if (boundary.marker[face] == marker) return true;
    }
    return false;
}

Status check_marker(Span<const Condition> conditions, Index i, Boundary const& boundary, Fault& fault) noexcept {
    Index const marker = conditions[i].marker;
    for (Condition const& earlier : conditions.first(i)) {
        if (earlier.marker == marker) {
            return fault.refuse(Status::bad_condition, "marker # has two conditions", Counts::from_zero, marker);
        }
    }
    if (has_faces(boundary, marker)) return Status::ok;
    return fault.refuse(Status::bad_condition, "marker # of condition @ (from 0) is on no boundary face",
                        Counts::from_zero,
                        marker, i);
}

// Bodies are numbered from 0 without gaps, in any order; all markers of a body turn about one centre.
Status check_body(Span<const Condition> conditions, Index i, Fault& fault) noexcept {
    Condition const& condition = conditions[i];
    if (!is_finite(condition.centre.x) || !is_finite(condition.centre.y)) {
        return fault.refuse(Status::bad_condition, "the centre in condition # (from 0) is not finite",
                            Counts::from_zero, i);
    }
    if (!is_in_range(condition.centre)) {
        return fault.refuse(Status::bad_condition, "the centre in condition # (from 0) has a coordinate beyond 1e100",
                            Counts::from_zero, i);
    }
    Index previous = condition.body == 0 ? 0 : none;
    for (Condition const& other : conditions) {
        if (other.kind != ConditionKind::rigid) continue;
        if (other.body == condition.body - 1) previous = other.body;
        if (other.body == condition.body &&
            (other.centre.x != condition.centre.x || other.centre.y != condition.centre.y)) {
            return fault.refuse(Status::bad_condition, "markers # and @ are one rigid body, but turn about two centres",
                                Counts::from_zero, condition.marker, other.marker);
        }
    }
    if (condition.body >= 0 && previous != none) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "condition # (from 0) names rigid body @ (from 0), but not all before it are there",
                        Counts::from_zero, i, condition.body);
}

Status check_partner(Span<const Condition> conditions, Index i, Boundary const& boundary, Fault& fault) noexcept {
    Condition const& condition = conditions[i];
    if (condition.partner == condition.marker) {
        return fault.refuse(Status::bad_condition, "marker # is its own periodic partner", Counts::from_zero,
                            condition.marker);
    }
    if (condition_of(conditions, condition.partner) != nullptr) {
        return fault.refuse(Status::bad_condition, "marker #, the periodic partner of @, has a condition of its own",
                            Counts::from_zero, condition.partner, condition.marker);
    }
    if (has_faces(boundary, condition.partner)) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "marker @ is to be the periodic partner of #, but no boundary face has it",
                        Counts::from_zero, condition.marker, condition.partner);
}

}  // namespace

void Demands::add(Condition const& condition) noexcept {
    if (condition.kind == ConditionKind::rigid) bodies = larger(bodies, condition.body + 1);
    slip = slip || condition.kind == ConditionKind::slip;
    free = free || condition.kind == ConditionKind::free;
    periodic = periodic || condition.kind == ConditionKind::periodic;
    given = given || condition.kind == ConditionKind::given;
}

Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary,
                        Fault& fault) noexcept {
    bool any_wall = false;
    for (Index i = 0; i < conditions.count(); ++i) {
        Condition const& condition = conditions[i];
        HARMORPH_TRY(check_marker(conditions, i, boundary, fault));
        if (condition.kind == ConditionKind::rigid) HARMORPH_TRY(check_body(conditions, i, fault));
        if (condition.kind == ConditionKind::periodic) HARMORPH_TRY(check_partner(conditions, i, boundary, fault));
        any_wall = any_wall || condition.is_wall();
        if (condition.kind != ConditionKind::on_curve) continue;
        Offset const end = Offset{condition.first_curve} + condition.n_curves;
        if (condition.first_curve < 0 || condition.n_curves < 1 || end > n_curves) {
            return fault.refuse(Status::bad_condition,
                                "condition # (from 0) names curves that do not exist; there are @",
                                Counts::from_zero, i, n_curves);
        }
    }
    if (any_wall) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "no condition puts a marker on a curve, makes it a rigid body or gives its displacements: nothing moves");
}

const Condition* condition_of(Span<const Condition> conditions, Index marker) noexcept {
    for (Condition const& condition : conditions) {
        if (condition.marker == marker) return &condition;
    }
    return nullptr;
}

void classify(Edges const& edges, Boundary const& boundary, Span<const Condition> conditions,
              Span<PointKind> kinds) noexcept {
    fill(kinds, PointKind::unused);
    edges.for_each([&](Index, Index low, Index high) { kinds[low] = kinds[high] = PointKind::inside; });
    auto const strengthen = [&](Index point, PointKind kind) {
        if (kind < kinds[point]) kinds[point] = kind;
    };
    auto const kind_of = [&](Index marker) {
        const Condition* const condition = condition_of(conditions, marker);
        for (Condition const& other : conditions) {
            if (other.kind == ConditionKind::periodic && other.partner == marker) return PointKind::inside;
        }
        switch (condition == nullptr ? ConditionKind::fixed : condition->kind) {
            case ConditionKind::on_curve:
            case ConditionKind::rigid:
            case ConditionKind::given: return PointKind::on_wall;
            case ConditionKind::slip: return PointKind::slip;
            case ConditionKind::free: return PointKind::free;
            case ConditionKind::periodic: return PointKind::inside;
            default: return PointKind::fixed;
        }
    };
    for (Index loop = 0; loop < boundary.n_loops; ++loop) {
        PointKind kind = PointKind::fixed;
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            bool const new_marker = face == boundary.loop_start[loop] || boundary.marker[face] != boundary.marker[face - 1];
            if (new_marker) kind = kind_of(boundary.marker[face]);
            strengthen(boundary.point[face], kind);
            strengthen(boundary.point[boundary.after(face, loop)], kind);
        }
    }
}

}  // namespace harmorph
