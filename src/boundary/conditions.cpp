#include "boundary/conditions.hpp"

namespace harmorph {

namespace {

Real square_of_distance(Vec2 p, Vec2 begin, Vec2 end) noexcept {
    Vec2 const side = end - begin;
    Real const along = square(side) > 0 ? clamp(dot(p - begin, side) / square(side), 0.0, 1.0) : 0;
    return square(p - (begin + along * side));
}

// Calls visit(face) for the faces of the condition's marker in the piece nearest to condition.near.
template <class Visit>
void for_piece(Condition const& condition, Points points, Boundary const& boundary,
               Visit const& visit) noexcept {
    Index nearest = none, nearest_loop = none;
    Real smallest = infinity;
    for (Index loop = 0; loop < boundary.n_loops; ++loop) {
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            if (boundary.marker[face] != condition.marker) continue;
            Real const distance =
                square_of_distance(condition.near, points[boundary.point[face]],
                                   points[boundary.point[boundary.after(face, loop)]]);
            if (distance >= smallest && nearest != none) continue;
            smallest = distance;
            nearest = face;
            nearest_loop = loop;
        }
    }
    if (nearest == none) return;
    Index const begin = boundary.loop_start[nearest_loop],
                n = boundary.loop_start[nearest_loop + 1] - begin;
    auto const is_on = [&](Index k) { return boundary.marker[begin + k % n] == condition.marker; };
    Index first = nearest - begin;
    for (Index k = 1; k < n && is_on(first + n - 1); ++k) first = (first + n - 1) % n;
    for (Index k = 0; k < n && is_on(first + k); ++k) visit(begin + (first + k) % n);
}

Status check_marker(Span<const Condition> conditions, Index i, Boundary const& boundary,
                    Fault& fault) noexcept {
    Index const marker = conditions[i].marker;
    for (Condition const& earlier : conditions.first(i)) {
        if (earlier.is_interface()) continue;
        bool const is_pair = conditions[i].is_pair() || earlier.is_pair();
        if (earlier.marker == marker &&
            (earlier.piece == conditions[i].piece ? earlier.piece == 0 : is_pair)) {
            return fault.refuse(Status::bad_condition, "marker # has two conditions",
                                marker_item(marker));
        }
    }
    if (!boundary.has_marker(marker)) {
        return fault.refuse(Status::bad_condition, "no boundary face has marker # of condition @",
                            marker_item(marker), condition_item(i));
    }
    for (Index face = 0; face < boundary.count; ++face) {
        if (boundary.condition[face] == i) return Status::ok;
    }
    return fault.refuse(Status::bad_condition,
                        "all faces of marker # that condition @ chooses have another condition",
                        marker_item(marker), condition_item(i));
}

Status check_centre(Span<const Condition> conditions, Index i, Fault& fault) noexcept {
    Condition const& condition = conditions[i];
    if (!is_finite(condition.centre.x) || !is_finite(condition.centre.y)) {
        return fault.refuse(Status::bad_condition, "the centre in condition # is not finite",
                            condition_item(i));
    }
    if (!is_in_range(condition.centre)) {
        return fault.refuse(Status::bad_condition,
                            "the centre in condition # has a coordinate beyond 1e100",
                            condition_item(i));
    }
    return Status::ok;
}

// Refuses an interface of one marker, of markers without faces, or of a marker of another
// interface.
Status check_interface(Span<const Condition> conditions, Index i, Boundary const& boundary,
                       Fault& fault) noexcept {
    Condition const& condition = conditions[i];
    if (condition.partner == condition.marker) {
        return fault.refuse(Status::bad_condition,
                            "marker # is named for both sides of an interface",
                            marker_item(condition.marker));
    }
    Index const both[2] = {condition.marker, condition.partner};
    for (Index const marker : both) {
        if (!boundary.has_marker(marker)) {
            return fault.refuse(Status::bad_condition,
                                "marker # of condition @ is on no boundary face",
                                marker_item(marker), condition_item(i));
        }
        for (Condition const& earlier : conditions.first(i)) {
            if (!earlier.is_interface() || (earlier.marker != marker && earlier.partner != marker))
                continue;
            return fault.refuse(Status::bad_condition, "marker # is in two interfaces",
                                marker_item(marker));
        }
    }
    return Status::ok;
}

// Bodies must be numbered from 0 without gaps, in any order. All markers of a body must have the
// same centre.
Status check_body(Span<const Condition> conditions, Index i, Fault& fault) noexcept {
    HARMORPH_TRY(check_centre(conditions, i, fault));
    Condition const& condition = conditions[i];
    Index previous = condition.body == 0 ? 0 : none;
    for (Condition const& other : conditions) {
        if (other.kind != ConditionKind::rigid) continue;
        if (other.body == condition.body - 1) previous = other.body;
        if (other.body == condition.body &&
            (other.centre.x != condition.centre.x || other.centre.y != condition.centre.y)) {
            return fault.refuse(Status::bad_condition,
                                "markers # and @ belong to one rigid body, but have different "
                                "centres",
                                marker_item(condition.marker), marker_item(other.marker));
        }
    }
    if (condition.body >= 0 && previous != none) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "condition # names rigid body @, but rigid bodies must be numbered without "
                        "gaps",
                        condition_item(i), body_item(condition.body));
}

Status check_partner(Span<const Condition> conditions, Index i, Boundary const& boundary,
                     Fault& fault) noexcept {
    Condition const& condition = conditions[i];
    if (condition.partner == condition.marker) {
        return fault.refuse(Status::bad_condition, "marker # is its own periodic partner",
                            marker_item(condition.marker));
    }
    for (Condition const& other : conditions) {
        if (other.marker != condition.partner || other.is_interface()) continue;
        return fault.refuse(Status::bad_condition,
                            "marker #, the periodic partner of marker @, must not have a condition "
                            "of its own",
                            marker_item(condition.partner), marker_item(condition.marker));
    }
    if (boundary.has_marker(condition.partner)) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "no boundary face has marker #, the periodic partner of marker @",
                        marker_item(condition.partner), marker_item(condition.marker));
}

}  // namespace

void Demands::add(Condition const& condition) noexcept {
    if (condition.kind == ConditionKind::rigid) bodies = max(bodies, condition.body + 1);
    slip = slip || condition.kind == ConditionKind::slip;
    if (condition.kind == ConditionKind::slip) slip_curves += condition.n_curves;
    free = free || condition.kind == ConditionKind::free;
    translation = translation || condition.kind == ConditionKind::periodic;
    rotation = rotation || condition.kind == ConditionKind::rotation;
    given = given || condition.kind == ConditionKind::given;
    interfaces = interfaces || condition.is_interface();
}

Status check_conditions(Span<const Condition> conditions, Index n_curves, Boundary const& boundary,
                        Fault& fault) noexcept {
    bool any_wall = false;
    for (Index i = 0; i < conditions.count(); ++i) {
        Condition const& condition = conditions[i];
        if (condition.is_interface()) {
            HARMORPH_TRY(check_interface(conditions, i, boundary, fault));
            continue;
        }
        HARMORPH_TRY(check_marker(conditions, i, boundary, fault));
        if (condition.has(ConditionField::body)) HARMORPH_TRY(check_body(conditions, i, fault));
        else if (condition.has(ConditionField::centre))
            HARMORPH_TRY(check_centre(conditions, i, fault));
        if (condition.is_pair()) HARMORPH_TRY(check_partner(conditions, i, boundary, fault));
        any_wall = any_wall || condition.is_wall();
        if (!condition.has(ConditionField::curves)) continue;
        Offset const end = Offset{condition.first_curve} + condition.n_curves;
        if (condition.n_curves == 0) {
            return fault.refuse(
                Status::bad_condition,
                "condition # puts a marker on curves, but its n_curves is 0; there are @ curves",
                condition_item(i), plain(n_curves));
        }
        if (condition.first_curve < 0 || condition.n_curves < 1 || end > n_curves) {
            return fault.refuse(Status::bad_condition,
                                "condition # names curves that do not exist; there are @ curves",
                                condition_item(i), plain(n_curves));
        }
    }
    if (any_wall) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "nothing moves: no condition puts a marker on a curve, makes it a rigid "
                        "body or gives its displacements");
}

// Conditions for pieces replace conditions for whole markers. If several conditions choose one
// piece, the first counts.
void assign_conditions(Points points, Span<const Condition> conditions,
                       Boundary& boundary) noexcept {
    for (Index face = 0; face < boundary.count; ++face) {
        boundary.condition[face] = none;
        for (Index i = conditions.count(); i-- > 0;) {
            if (conditions[i].piece == 0 && !conditions[i].is_interface() &&
                conditions[i].marker == boundary.marker[face])
                boundary.condition[face] = i;
        }
    }
    for (Index i = conditions.count(); i-- > 0;) {
        if (conditions[i].piece == 0) continue;
        for_piece(conditions[i], points, boundary,
                  [&](Index face) { boundary.condition[face] = i; });
    }
}

void find_interface_sides(Boundary const& boundary, Span<const Condition> conditions,
                          Span<Index> side) noexcept {
    for (Index face = 0; face < side.count(); ++face) {
        side[face] = none;
        for (Index i = 0; i < conditions.count(); ++i) {
            if (!conditions[i].is_interface()) continue;
            if (conditions[i].marker == boundary.marker[face]) side[face] = 2 * i;
            if (conditions[i].partner == boundary.marker[face]) side[face] = 2 * i + 1;
        }
    }
}

void classify(Edges const& edges, Boundary const& boundary, Span<const Condition> conditions,
              Span<PointKind> kinds) noexcept {
    fill(kinds, PointKind::unused);
    edges.for_each(
        [&](Index, Index low, Index high) { kinds[low] = kinds[high] = PointKind::inside; });
    auto const strengthen = [&](Index point, PointKind kind) {
        if (kind < kinds[point]) kinds[point] = kind;
    };
    auto const kind_of = [&](Index face) {
        const Condition* const condition = condition_of(conditions, boundary, face);
        for (Condition const& other : conditions) {
            if (other.is_pair() && other.partner == boundary.marker[face]) return PointKind::inside;
        }
        return condition == nullptr ? PointKind::fixed : condition->traits().points;
    };
    for (Index loop = 0; loop < boundary.n_loops; ++loop) {
        PointKind kind = PointKind::fixed;
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            bool const is_first = face == boundary.loop_start[loop];
            bool const is_new = is_first || boundary.marker[face] != boundary.marker[face - 1] ||
                                boundary.condition[face] != boundary.condition[face - 1];
            if (is_new) kind = kind_of(face);
            strengthen(boundary.point[face], kind);
            strengthen(boundary.point[boundary.after(face, loop)], kind);
        }
    }
}

}  // namespace harmorph
