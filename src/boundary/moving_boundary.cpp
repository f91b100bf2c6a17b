#include "boundary/moving_boundary.hpp"

#include "base/hash.hpp"
#include "base/sort.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

// Returns the extent of the control polygon, whose bounding box contains the curve.
Real extent_of(Curve const& curve) noexcept {
    Box box;
    for (Index k = 0; k < curve.n_indices; ++k) box.include(curve.point(k));
    return box.extent();
}

// Returns the diagonal of the box around the curve.
Real diagonal_of(Curve const& curve) noexcept {
    constexpr Index pieces = 8;  // of a span of the knots
    Box box;
    box.include(curve_point(curve, curve.end()));
    for (Index k = curve.degree; k < curve.n_indices; ++k) {
        Real const begin = curve.knots[k], length = curve.knots[k + 1] - begin;
        for (Index piece = 0; piece < pieces && length > 0; ++piece)
            box.include(curve_point(curve, begin + piece * (length / pieces)));
    }
    return length(box.size());
}

class DistanceCheck {
public:
    DistanceCheck(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  Real max_distance, Wall const& wall) noexcept
        : points_(points),
          conditions_(conditions),
          curves_(curves),
          max_distance_(max_distance),
          wall_(wall) {
        Box box;
        for (Index slot = 0; slot < wall.count; ++slot) {
            if (wall.curve[slot] < curves.count()) box.include(points[wall.point[slot]]);
        }
        wall_extent_ = box.extent();
    }

    Status run(Fault& fault) noexcept {
        for (Index slot = 0; slot < wall_.count; ++slot) {
            if (wall_.curve[slot] < curves_.count()) HARMORPH_TRY(look_at(slot, fault));
        }
        bool const is_refused = farthest_ != none && (outside_ || largest_ >= max_distance_);
        if (farthest_ != none && (is_refused || beyond_ == none)) return refuse_far(fault);
        if (beyond_ == none) return Status::ok;
        return fault.refuse(
            Status::far_from_curve,
            "point # is ~ beyond the end of its curve, where all points move alike; "
            "check whether a curve is missing",
            point_item(wall_.point[beyond_]), {}, beyond_distance_);
    }

private:
    Status look_at(Index slot, Fault& fault) noexcept {
        Index const number = wall_.curve[slot];
        Curve const& curve = curves_[number];
        Vec2 const point = points_[wall_.point[slot]];
        Real const distance = length(curve_point(curve, wall_.u[slot]) - point);
        if (distance == 0) return Status::ok;
        // The slots of a curve are consecutive, so the extent is computed once.
        if (measured_ != number) {
            measured_ = number;
            curve_extent_ = extent_of(curve);
            diagonal_ = diagonal_of(curve);
        }
        Real const extent = min(curve_extent_, wall_extent_);
        outside_ = outside_ || !(extent > smallest_height) || distance > extent;
        Real const relative = diagonal_ > smallest_height ? distance / diagonal_ : infinity;
        if (relative > largest_ || (farthest_ == none && relative == largest_)) {
            largest_ = relative;
            largest_distance_ = distance;
            farthest_ = slot;
        }
        if (!(distance > share_of_face * face_at(slot))) return Status::ok;
        bool const at_end = wall_.u[slot] == curve.begin() || wall_.u[slot] == curve.end();
        if (at_end && !is_periodic(curve) && distance > beyond_distance_) {
            beyond_ = slot;
            beyond_distance_ = distance;
        }
        for (Index other = 0; other < curves_.count(); ++other) {
            if (named_together(number, other)) continue;
            if (!(project(curves_[other], point).distance < much_nearer * distance)) continue;
            return fault.refuse(Status::bad_condition,
                                "point # is ~ away from its curve, but lies on curve @, which its "
                                "condition does not name",
                                point_item(wall_.point[slot]), curve_item(other), distance);
        }
        return Status::ok;
    }

    // Returns the length of the shorter face at the point. Neighbours along the wall have
    // neighbouring slots.
    Real face_at(Index slot) const noexcept {
        Real shortest = infinity;
        for (Index next = slot - 1; next <= slot + 1; next += 2) {
            if (next < 0 || next >= wall_.count || wall_.curve[next] >= curves_.count()) continue;
            shortest =
                min(shortest, length(points_[wall_.point[next]] - points_[wall_.point[slot]]));
        }
        return shortest;
    }

    bool named_together(Index a, Index b) const noexcept {
        if (a == b) return true;
        for (Condition const& condition : conditions_) {
            auto const names = [&](Index curve) {
                return curve >= condition.first_curve &&
                       curve < condition.first_curve + condition.n_curves;
            };
            if (condition.kind == ConditionKind::on_curve && names(a) && names(b)) return true;
        }
        return false;
    }

    Status refuse_far(Fault& fault) const noexcept {
        Status status = Status::bad_condition;
        const char* text =
            "point # is ~ away from its curve, more than the extent of the curve or wall; check "
            "the marker of the condition";
        if (!outside_) {
            text =
                "point # is ~ away from its curve, which is too far for a curve of this wall; fit "
                "a curve to the wall, or accept the distance "
                "(hm_problem.max_curve_distance)";
            if (largest_ < max_distance_) {
                status = Status::far_from_curve;
                text =
                    "point # is ~ away from its curve, at least 0.001 of the diagonal of the box "
                    "around the curve; check the curve";
            }
        }
        return fault.refuse(status, text, point_item(wall_.point[farthest_]), {},
                            largest_distance_);
    }

    static constexpr Real far = 0.001;           // as a fraction of the diagonal
    static constexpr Real share_of_face = 0.25;  // points of a good fit are nearer to the curve
    static constexpr Real much_nearer = 0.0625;  // as a fraction of the distance

    Points points_;
    Span<const Condition> conditions_;
    Span<const Curve> curves_;
    Real max_distance_;
    Wall const& wall_;
    Real wall_extent_ = 0;   // the extent of all points on curves
    Index measured_ = none;  // the curve whose measures the next two are
    Real curve_extent_ = 0, diagonal_ = 0;
    bool outside_ = false;                   // a point is farther away than the extent
    Index farthest_ = none, beyond_ = none;  // slots
    Real largest_ = far, largest_distance_ = 0, beyond_distance_ = 0;
};

// Refuses a point whose distance from its curve is at least max_distance, as a fraction of the
// diagonal of the box around the curve, or larger than the extent of the curve or of the wall; and
// a point that lies on another curve, which no condition names together with its curve. Warns
// (Status::far_from_curve) of a point that is at least 0.001 of the diagonal away, or that lies
// beyond the end of its curve, where all points have the same displacement.
Status check_distances(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                       Real max_distance, Wall const& wall, Fault& fault) noexcept {
    return DistanceCheck(points, conditions, curves, max_distance, wall).run(fault);
}

class Parametriser {
public:
    Parametriser(Mesh const& mesh, Boundary const& boundary, Span<const Condition> conditions,
                 Span<const Curve> curves, WallWork const& work, Wall& wall) noexcept
        : mesh_(mesh),
          boundary_(boundary),
          conditions_(conditions),
          curves_(curves),
          work_(work),
          wall_(wall) {}

    void run(Condition const& condition) noexcept {
        collect_chains(condition);
        fill(work_.is_break.first(n_points_), std::uint8_t{0});
        for (Curve const& curve : curves_.from(condition.first_curve, condition.n_curves))
            mark_breaks(curve);
        for (Index chain = 0; chain < n_chains_; ++chain) {
            if (work_.is_loop[chain] != 0 && condition.n_curves == 1)
                check_ends(condition.first_curve);
            parametrise_chain(chain, condition);
        }
    }

    // Refuses a curve whose ends a control point may separate, of a wall that is closed.
    Status check_torn(Fault& fault) const noexcept {
        if (torn_.first == none) return Status::ok;
        return fault.refuse(Status::bad_curve,
                            "the wall is closed, but control points # and @ at the same place, at "
                            "both ends of its curve, would tear the curve: name one of them twice "
                            "in indices instead",
                            control_point_item(torn_.first), control_point_item(torn_.last));
    }

    // Adds the points of the condition that are on no wall yet, in order along the boundary.
    void add(Condition const& condition, Index number) noexcept {
        auto const visit = [&](Index, Index point) { put(point, number, 0); };
        boundary_.for_each_chain(
            [&](Index face) { return condition_of(conditions_, boundary_, face) == &condition; },
            visit, [](Index, bool) {});
    }

private:
    void check_ends(Index curve) noexcept {
        TornEnds const found = torn_ends(curves_[curve]);
        if (torn_.first == none) torn_ = found;
    }

    bool belongs(Index face, Condition const& condition) const noexcept {
        const Condition* const found = condition_of(conditions_, boundary_, face);
        return found != nullptr && found->kind == ConditionKind::on_curve &&
               found->same_curves(condition);
    }

    void collect_chains(Condition const& condition) noexcept {
        n_chains_ = n_points_ = 0;
        auto const visit = [&](Index chain, Index point) {
            if (chain == n_chains_) work_.chain_start[n_chains_++] = n_points_;
            work_.chain_point[n_points_++] = point;
        };
        auto const close = [&](Index chain, bool is_loop) {
            work_.is_loop[chain] = is_loop ? 1 : 0;
        };
        boundary_.for_each_chain([&](Index face) { return belongs(face, condition); }, visit,
                                 close);
        work_.chain_start[n_chains_] = n_points_;
    }

    void mark_breaks(Curve const& curve) const noexcept {
        if (is_periodic(curve)) return;
        Real const ends[] = {curve.begin(), curve.end()};
        for (Real const u : ends) {
            Vec2 const end = curve_point(curve, u);
            Index nearest = 0;
            Real smallest = infinity;
            for (Index k = 0; k < n_points_; ++k) {
                Real const distance = square(mesh_.points[work_.chain_point[k]] - end);
                if (distance < smallest) {
                    smallest = distance;
                    nearest = k;
                }
            }
            work_.is_break[nearest] = 1;
        }
    }

    void parametrise_chain(Index chain, Condition const& condition) noexcept {
        Index const begin = work_.chain_start[chain], n = work_.chain_start[chain + 1] - begin;
        bool const is_loop = work_.is_loop[chain] != 0;
        Index first = 0;  // a break, if the chain is a loop with breaks
        if (is_loop) {
            while (first < n && work_.is_break[begin + first] == 0) ++first;
            if (first == n) return parametrise_segment(begin, n, 0, n, true, condition);
        }
        Index const last = is_loop ? n : n - 1;
        for (Index from = 0; from < last;) {
            Index to = from + 1;
            while (to < last && work_.is_break[begin + (first + to) % n] == 0) ++to;
            parametrise_segment(begin, n, first + from, to - from + 1, false, condition);
            from = to;
        }
    }

    // Finds the parameters of the n_segment points from position `first` of the chain on; a segment
    // of a loop may pass the end of the chain.
    void parametrise_segment(Index begin, Index n_chain, Index first, Index n_segment, bool is_loop,
                             Condition const& condition) noexcept {
        auto const point_at = [&](Index k) {
            return work_.chain_point[begin + (first + k) % n_chain];
        };
        Span<Vec2> const position = work_.position.first(n_segment);
        for (Index k = 0; k < n_segment; ++k) position[k] = mesh_.points[point_at(k)];
        Span<Real> const u = work_.u.first(n_segment), best_u = work_.best_u.first(n_segment);
        Real smallest = infinity;
        Index best = condition.first_curve;
        for (Index curve = condition.first_curve;
             curve < condition.first_curve + condition.n_curves; ++curve) {
            Real const misfit =
                project_chain(curves_[curve], position, is_loop, work_.projection, u);
            if (misfit < smallest) {
                smallest = misfit;
                best = curve;
                copy(best_u, Span<const Real>(u));
            }
        }
        for (Index k = 0; k < n_segment; ++k) put(point_at(k), best, best_u[k]);
        if (!is_loop && n_segment > n_chain)
            note_both_ends(point_at(0), best, best_u[n_segment - 1]);
    }

    // The point is at both ends of a curve round a body. `last` is its parameter at the end of the
    // segment, which is that at the beginning where both ends of the curve are at one place.
    void note_both_ends(Index point, Index number, Real last) const noexcept {
        Curve const& curve = curves_[number];
        Index const slot = work_.slot[point];
        Real const u = wall_.u[slot];
        bool const is_end = u == curve.begin() || u == curve.end();
        if (wall_.curve[slot] != number || (last == u && !is_end)) return;
        Real const other = last != u ? last : u == curve.begin() ? curve.end() : curve.begin();
        wall_.shared[wall_.n_shared++] = {slot, {none, none}, {number, other, {}}};
    }

    // A point of two segments or two conditions keeps the first parameter; those on other curves
    // are noted.
    void put(Index point, Index curve, Real u) noexcept {
        Index const slot = work_.slot[point];
        if (slot != none) {
            if (wall_.curve[slot] != curve)
                wall_.shared[wall_.n_shared++] = {slot, {none, none}, {curve, u, {}}};
            return;
        }
        work_.slot[point] = wall_.count;
        wall_.point[wall_.count] = point;
        wall_.curve[wall_.count] = curve;
        wall_.u[wall_.count++] = u;
    }

    Mesh const& mesh_;
    Boundary const& boundary_;
    Span<const Condition> conditions_;
    Span<const Curve> curves_;
    WallWork const& work_;
    Wall& wall_;
    Index n_chains_ = 0, n_points_ = 0;  // of the current condition
    TornEnds torn_;                      // of the first closed wall whose curve may tear
};

Status apply_given(GivenParameters const& given, Span<const Curve> curves,
                   Span<const Index> representative, WallWork const& work, Wall& wall,
                   Fault& fault) noexcept {
    for (Index i = 0; i < given.point.count(); ++i) {
        Index const point = from_zero(given.point[i], given.index_base);
        if (point < 0 || point >= representative.count()) {
            return fault.refuse(Status::bad_condition,
                                "a parameter is given for point #, which does not exist",
                                point_item(point));
        }
        Index const slot = work.slot[representative[point]];
        if (slot == none) {
            return fault.refuse(Status::bad_condition,
                                "a parameter is given for point #, whose marker is not on a curve",
                                point_item(point));
        }
        Index const curve = given.curve[i];
        if (wall.curve[slot] >= curves.count()) {
            return fault.refuse(Status::bad_condition,
                                "a parameter is given for point #, which is not on a curve",
                                point_item(point));
        }
        if (curve < 0 || curve >= curves.count()) {
            return fault.refuse(Status::bad_condition,
                                "known parameter # names curve @, which does not exist",
                                entry_item(i), curve_item(curve));
        }
        if (!is_finite(given.u[i]) || given.u[i] < curves[curve].begin() ||
            given.u[i] > curves[curve].end()) {
            return fault.refuse(Status::bad_condition,
                                "the parameter ~ given for point # is outside the range of its "
                                "curve",
                                point_item(point), {}, given.u[i]);
        }
        // The place on the curve that is given takes the place of the one that was found.
        for (SharedPoint& other : wall.shared.first(wall.n_shared)) {
            if (other.slot == slot && other.place.curve == curve && wall.curve[slot] != curve)
                other.place = {wall.curve[slot], wall.u[slot], {}};
        }
        wall.curve[slot] = curve;
        wall.u[slot] = given.u[i];
    }
    return Status::ok;
}

// Tells whether any movement moves both places alike.
bool move_alike(Span<const Curve> curves, WallPlace const& a, WallPlace const& b) noexcept {
    constexpr Real rounding = 1e-8;
    bool const on_curves = a.curve < curves.count() && b.curve < curves.count();
    if (!on_curves) return a.curve == b.curve;
    CurveBasis const of_a = curve_basis(curves[a.curve], a.u, 0),
                     of_b = curve_basis(curves[b.curve], b.u, 0);
    // A control point may be repeated, so its values are added up.
    auto const sum = [](CurveBasis const& functions, Index control) {
        Real total = 0;
        for (Index k = 0; k < functions.order; ++k)
            total += functions.control[k] == control ? functions.value[0][k] : 0;
        return total;
    };
    auto const differ = [&](CurveBasis const& functions) {
        for (Index k = 0; k < functions.order; ++k) {
            Index const control = functions.control[k];
            if (abs(sum(of_a, control) - sum(of_b, control)) > rounding) return true;
        }
        return false;
    };
    if (differ(of_a) || differ(of_b)) return false;
    return length(a.offset - b.offset) == 0;
}

// Tells whether the condition moves points by the curve or body of this number, see WallPlace.
bool moves_by(Condition const& condition, Index number, Index n_curves, Index n_bodies) noexcept {
    switch (condition.kind) {
        case ConditionKind::on_curve:
            return number >= condition.first_curve &&
                   number < condition.first_curve + condition.n_curves;
        case ConditionKind::rigid: return number == n_curves + condition.body;
        case ConditionKind::given: return number == n_curves + n_bodies;
        default: return false;
    }
}

// Finds the two conditions of each shared point among those of the faces at the point.
void name_conditions(Boundary const& boundary, Span<const Condition> conditions, Index n_curves,
                     Span<const Index> slot_of_point, Wall& wall) noexcept {
    Demands all;
    for (Condition const& condition : conditions) all.add(condition);
    Span<SharedPoint> const shared = wall.shared.first(wall.n_shared);
    auto const note = [&](Index point, Index condition) {
        Index const slot = slot_of_point[point];
        Index begin = 0, end = shared.count();
        while (begin < end) {
            Index const middle = begin + (end - begin) / 2;
            if (shared[middle].slot < slot) begin = middle + 1;
            else end = middle;
        }
        for (Index i = begin; i < shared.count() && shared[i].slot == slot; ++i) {
            Index const numbers[2] = {wall.curve[slot], shared[i].place.curve};
            for (Index k = 0; k < 2; ++k) {
                Index& found = shared[i].condition[k];
                bool const moves =
                    moves_by(conditions[condition], numbers[k], n_curves, all.bodies);
                if (moves && found == none) found = condition;
            }
        }
    };
    for (Index loop = 0; loop < boundary.n_loops && !shared.empty(); ++loop) {
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            if (boundary.condition[face] == none) continue;
            note(boundary.point[face], boundary.condition[face]);
            note(boundary.point[boundary.after(face, loop)], boundary.condition[face]);
        }
    }
}

}  // namespace

void Wall::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    Size const n = 2 * Boundary::max_faces(mesh);  // each face has two ends
    arena.take(point, n);
    arena.take(curve, n);
    arena.take(u, n);
    arena.take(offset, n);
    arena.take(shared, n);
}

void WallWork::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    // Chains repeat their end points, and a loop repeats its first point.
    Size const n = 2 * Boundary::max_faces(mesh) + 1;
    arena.take(slot, mesh.n_points);
    arena.take(chain_point, n);
    arena.take(chain_start, n);
    arena.take(is_loop, n);
    arena.take(is_break, n);
    arena.take(position, n);
    arena.take(u, n);
    arena.take(best_u, n);
    projection.lay_out(arena, static_cast<Index>(n));
}

Status parametrise(Topology const& topology, Boundary const& boundary,
                   Span<const Condition> conditions, Span<const Curve> curves,
                   GivenParameters const& given, Real max_distance, WallWork const& work,
                   Wall& wall, Fault& fault) noexcept {
    wall.count = wall.n_shared = 0;
    fill(work.slot, none);
    Parametriser parametriser(topology.mesh, boundary, conditions, curves, work, wall);
    for (Index i = 0; i < conditions.count(); ++i) {
        if (conditions[i].kind != ConditionKind::on_curve) continue;
        bool is_first = true;
        for (Index earlier = 0; earlier < i; ++earlier) {
            bool const on_curve = conditions[earlier].kind == ConditionKind::on_curve;
            if (on_curve && conditions[earlier].same_curves(conditions[i])) is_first = false;
        }
        if (is_first) parametriser.run(conditions[i]);
    }
    HARMORPH_TRY(parametriser.check_torn(fault));
    Demands all;
    for (Condition const& condition : conditions) {
        all.add(condition);
        if (condition.kind == ConditionKind::rigid)
            parametriser.add(condition, curves.count() + condition.body);
    }
    for (Condition const& condition : conditions) {
        if (condition.kind == ConditionKind::given)
            parametriser.add(condition, curves.count() + all.bodies);
    }
    HARMORPH_TRY(apply_given(given, curves, topology.representative, work, wall, fault));
    return check_distances(topology.mesh.points, conditions, curves, max_distance, wall, fault);
}

Vec2 offset_from(Curve const& curve, Real u, Vec2 point) noexcept {
    if (!is_periodic(curve) && (u == curve.begin() || u == curve.end())) return {};
    Index equal = 0;
    for (Index k = 0; k < curve.n_indices + curve.degree + 1; ++k)
        equal += curve.knots[k] == u ? 1 : 0;
    if (equal >= curve.degree) return {};
    Vec2 at[2];
    curve_point(curve, u, 1, at);
    Vec2 const offset = point - at[0];
    CurveBasis const functions = curve_basis(curve, u, 1);
    Real slopes = 0;
    for (Index k = 0; k < functions.order; ++k) slopes += abs(functions.value[1][k]);
    return length(offset) * slopes < length(at[1]) ? offset : Vec2{};
}

void find_offsets(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  bool offset_correction, Wall& wall) noexcept {
    auto const offset_at = [&](WallPlace const& place, Vec2 point) {
        if (place.curve < curves.count())
            return offset_correction ? offset_from(curves[place.curve], place.u, point) : Vec2{};
        Vec2 offset;
        for (Condition const& condition : conditions) {
            bool const is_body = condition.kind == ConditionKind::rigid &&
                                 condition.body == place.curve - curves.count();
            if (is_body) offset = point - condition.centre;
        }
        return offset;
    };
    for (Index slot = 0; slot < wall.count; ++slot)
        wall.offset[slot] = offset_at(wall.place(slot), points[wall.point[slot]]);
    for (SharedPoint& shared : wall.shared.first(wall.n_shared))
        shared.place.offset = offset_at(shared.place, points[wall.point[shared.slot]]);
}

void find_shared(Boundary const& boundary, Span<const Condition> conditions,
                 Span<const Curve> curves, Span<const Index> slot_of_point, Wall& wall,
                 Fault& fault) noexcept {
    Span<SharedPoint> const all = wall.shared.first(wall.n_shared);
    sort(all, [](SharedPoint const& a, SharedPoint const& b) {
        if (a.slot != b.slot) return a.slot < b.slot;
        return a.place.curve != b.place.curve ? a.place.curve < b.place.curve
                                              : a.place.u < b.place.u;
    });
    wall.n_shared = 0;
    for (SharedPoint const& other : all) {
        bool alike = move_alike(curves, other.place, wall.place(other.slot));
        for (Index k = wall.n_shared - 1; k >= 0 && all[k].slot == other.slot; --k)
            alike = alike || move_alike(curves, other.place, all[k].place);
        if (!alike) all[wall.n_shared++] = other;
    }
    name_conditions(boundary, conditions, curves.count(), slot_of_point, wall);
    if (wall.n_shared == 0 || fault.status != Status::ok) return;
    fault.refuse(Status::torn,
                 "point # also belongs to condition @, which moves it by other functions; put both "
                 "markers on one curve, or give the curves a common control point",
                 point_item(wall.point[all[0].slot]), condition_item(all[0].condition[1]));
}

std::uint64_t fingerprint_of(Span<const PointKind> kinds, Wall const& wall) noexcept {
    Hash hash;
    for (PointKind const kind : kinds) hash.add(static_cast<std::uint64_t>(kind));
    for (Index slot = 0; slot < wall.count; ++slot) {
        hash.add(static_cast<std::uint64_t>(wall.point[slot]));
        hash.add(static_cast<std::uint64_t>(wall.curve[slot]));
        hash.add(bits_of(wall.u[slot]));
        hash.add(bits_of(wall.offset[slot].x));
        hash.add(bits_of(wall.offset[slot].y));
    }
    for (SharedPoint const& shared : wall.shared.first(wall.n_shared)) {
        hash.add(static_cast<std::uint64_t>(shared.slot));
        hash.add(static_cast<std::uint64_t>(shared.place.curve));
        hash.add(bits_of(shared.place.u));
    }
    return hash.value();
}

}  // namespace harmorph
