// The C interface: moves a section by the values of design variables.
#include "bspline/movements.hpp"
#include "bspline/parsec.hpp"
#include "bspline/section_measures.hpp"
#include "limits.hpp"
#include "section_view.hpp"

namespace harmorph {
namespace {

constexpr Index max_movements = 64;

constexpr Limit<hm_movement> movement_limits[] = {
    {&hm_movement::kind, HM_ROTATE, HM_FAMILY,
     "the kind of movement # is @, but it must be one of HM_ROTATE to HM_FAMILY"},
    {&hm_movement::reserved, 0, 0, "reserved of movement # must be 0, not @"},
};

// Refuses the fields of linear movements in others, and the other way round.
Status check_linear(hm_movement const& m, Index number, Fault& fault) noexcept {
    bool const is_family = m.kind == HM_FAMILY;
    if ((m.kind == HM_LINEAR) != (m.variables != nullptr)) {
        return fault.refuse(Status::bad_argument,
                            m.variables == nullptr ? "variables of movement # is NULL"
                                                   : "variables of movement # must be NULL unless "
                                                     "the kind is HM_LINEAR",
                            entry_item(number));
    }
    if (!is_family && (m.n_members != 0 || m.members != nullptr || m.singular != nullptr)) {
        return fault.refuse(Status::bad_argument,
                            "members, n_members and singular of movement # must be 0 unless the "
                            "kind is HM_FAMILY",
                            entry_item(number));
    }
    if (is_family && (m.members == nullptr || m.n_members < 1 || m.n_members > 1024)) {
        return fault.refuse(Status::bad_argument,
                            "members of movement # is NULL, or n_members is not between 1 and 1024",
                            entry_item(number));
    }
    return Status::ok;
}

// Reads a movement, and refuses fields that belong to another kind.
Status view_movement(const hm_movement* array, Index number, Movement& out, Fault& fault) noexcept {
    hm_movement m;
    Item const item = entry_item(number);
    HARMORPH_TRY(open_element(array, number, m, item, "movement", "hm_movement", fault));
    HARMORPH_TRY(check_limits(m, movement_limits, fault, item));
    out = {};
    out.kind = m.kind > HM_BLADE ? MovementKind::linear : static_cast<MovementKind>(m.kind);
    HARMORPH_TRY(check_linear(m, number, fault));
    out.n_camber = m.n_camber;
    out.n_thickness = m.n_thickness;
    out.centre = {m.x, m.y};
    out.length = m.length;
    bool const counts = out.kind == MovementKind::camber_thickness;
    bool const is_counted = m.n_camber >= 0 && m.n_camber <= Variables::max_count &&
                            m.n_thickness >= 0 && m.n_thickness <= Variables::max_count &&
                            m.n_camber + m.n_thickness > 0;
    if (counts ? !is_counted : m.n_camber != 0 || m.n_thickness != 0) {
        return fault.refuse(Status::bad_argument,
                            counts ? "n_camber and n_thickness of movement # must be between 0 and "
                                     "64, and their sum at least 1"
                                   : "n_camber and n_thickness of movement # must be 0 unless the "
                                     "kind is HM_CAMBER_THICKNESS",
                            item);
    }
    bool const has_place = out.kind == MovementKind::rotate || out.kind == MovementKind::scale ||
                           out.kind == MovementKind::flap || out.kind == MovementKind::blade;
    if (!is_coordinate(out.centre) || (!has_place && !(m.x == 0 && m.y == 0))) {
        return fault.refuse(Status::bad_argument,
                            "x and y of movement # must be finite and at most 1e100, and 0 if the "
                            "kind of the movement has no centre",
                            item);
    }
    bool const is_flap = out.kind == MovementKind::flap;
    if (is_flap ? !is_between(0, m.length, largest_coordinate) : m.length != 0) {
        return fault.refuse(Status::bad_argument,
                            is_flap ? "the length of movement # must be 0 or above, not ~"
                                    : "the length of movement # must be 0 unless the kind is "
                                      "HM_FLAP",
                            item, {}, m.length);
    }
    return Status::ok;
}

// The arguments that a size query and hm_move_section have in common.
struct MovementTask {
    CurvesView view;
    Section section;
    Variables variables;      // of HM_LINEAR
    hm_movement family = {};  // of HM_FAMILY; otherwise without members
    Movement movement[max_movements];
    Index n_movements = 0, n_values = 0;

    Status open(const hm_curves* curves, const hm_section* given_section, Index n,
                const hm_movement* given, CallFault& fault) noexcept {
        HARMORPH_TRY(require({{"movements", given}}, fault));
        if (n < 1 || n > max_movements) {
            return fault.refuse(Status::bad_argument, "n_movements must be between 1 and 64, not #",
                                plain(n));
        }
        HARMORPH_TRY(view_movement(given, 0, movement[0], fault));
        hm_movement m;
        read_struct(given, m);
        bool const needs_section = n > 1 || m.kind != HM_FAMILY;
        HARMORPH_TRY(needs_section ? open_section(curves, given_section, view, section, fault)
                                   : view_curves(curves, view, fault));
        bool needs_chord = false;
        for (n_movements = 0; n_movements < n; ++n_movements) {
            Movement& own = movement[n_movements];
            if (n_movements > 0) HARMORPH_TRY(view_movement(given, n_movements, own, fault));
            if (n_movements > 0 && !own.maps_points()) {
                return fault.refuse(Status::bad_argument,
                                    "movement # changes the outline and must come first",
                                    entry_item(n_movements));
            }
            if (own.kind == MovementKind::linear) HARMORPH_TRY(open_linear(m, own, fault));
            needs_chord =
                needs_chord || own.needs_chord() || (has_variables() && variables.needs_chord());
            n_values += own.count();
        }
        return needs_chord ? find_chord(fault) : Status::ok;
    }
    bool changes_outline() const noexcept {
        return !movement[0].maps_points() && family.members == nullptr;
    }
    bool is_linear() const noexcept { return movement[0].kind == MovementKind::linear; }
    bool has_variables() const noexcept { return is_linear() && family.members == nullptr; }
    // The lattice points of free-form deformation have two values.
    bool has_pairs() const noexcept {
        return has_variables() && variables.kind == VariableKind::ffd;
    }
    Index n_variables() const noexcept {
        return is_linear() ? movement[0].count() / (has_pairs() ? 2 : 1) : 0;
    }
    // Tells whether a movement maps the control points otherwise than by an affine map, so that the
    // curve does not move as the map of its points.
    bool bends() const noexcept {
        for (Index k = 0; k < n_movements; ++k) {
            if (movement[k].kind == MovementKind::flap) return true;
        }
        return false;
    }

private:
    Status open_linear(hm_movement const& m, Movement& own, Fault& fault) noexcept {
        if (m.kind == HM_FAMILY) {
            family = m;
            own.n_linear = m.n_members;
            return Status::ok;
        }
        HARMORPH_TRY(open_variables(m.variables, view, variables, fault));
        own.n_linear = variables.count() * (variables.kind == VariableKind::ffd ? 2 : 1);
        return Status::ok;
    }
    Status find_chord(CallFault& fault) noexcept {
        AreaMoments moments;
        HARMORPH_TRY(area_moments(section, moments, fault));  // finds the orientation
        HARMORPH_TRY(section.find_chord(true, fault));
        Real const chord = length(section.chord());
        for (Index k = 0; k < n_movements; ++k) {
            movement[k].behind = (1 / chord) * section.chord();
            if (movement[k].length == 0) movement[k].length = 0.1 * chord;
        }
        return Status::ok;
    }
};

struct MovementWork {
    VariableMap map;  // of a change of the outline
    FamilyModes modes;
    Span<Real> member;            // [n_members * 2 * n_control] then the modes
    Span<Real> singular;          // [n_members]
    Span<Vec2> place;             // [n_control] where the control points are
    Span<Vec2> unmapped;          // [n_control] where they were before the maps; if the task bends
    Span<Vec2> move;              // [n_control]
    Span<Vec2> derivative;        // [values * n_control]
    Span<Real> start;             // [values]
    Span<Real> zero;              // [values] for a caller who gives none
    Span<unsigned char> is_used;  // [n_control] whether a curve of the section uses the point
    Real error[2] = {};

    void lay_out(Arena& arena, MovementTask const& task) noexcept {
        Offset const n = task.view.set.n_control;
        if (task.changes_outline()) {
            map.lay_out(arena, task.view.set.n_control,
                        task.is_linear() ? task.n_variables() : 1 + task.movement[0].count());
        }
        if (task.family.members != nullptr) {
            modes.lay_out(arena, task.view.set.n_control);
            arena.take(member, 2 * n * task.family.n_members);
            arena.take(singular, task.family.n_members);
        }
        arena.take(place, n);
        arena.take(unmapped, task.bends() ? n : 0);
        arena.take(move, n);
        arena.take(derivative, n * task.n_values);
        arena.take(start, task.n_values);
        arena.take(zero, task.n_values);
        arena.take(is_used, n);
    }
    Status run(MovementTask const& task, const Real* given, CallFault& fault) noexcept {
        begin(task);
        const Real* const values = given != nullptr ? given : zero.data();
        Index first = 0;
        for (Index k = 0; k < task.n_movements; ++k) {
            Movement const& movement = task.movement[k];
            Index const bad = movement.find_bad_value(values + first);
            if (bad != none) return refuse_value(first + bad, values, fault);
            if (movement.kind == MovementKind::linear)
                HARMORPH_TRY(add_linear(task, values, fault));
            else if (!movement.maps_points())
                HARMORPH_TRY(change_outline(task.section, movement, values, fault));
            if (k == 0 && !unmapped.empty()) copy(unmapped, Span<const Vec2>(place));
            if (movement.maps_points()) map_points(movement, values + first, first);
            first += movement.count();
        }
        for (Index i = 0; i < move.count(); ++i) {
            if (is_coordinate(move[i])) continue;
            return fault.refuse(Status::bad_argument,
                                "the values move control point # beyond 1e100",
                                control_point_item(i));
        }
        if (!unmapped.empty()) add_error_of_maps(task, values);
        return Status::ok;
    }

    // The pair (x, y) by which one unit of linear variable j moves control point i.
    Vec2 unit_move(MovementTask const& task, Index i, Index j) const noexcept {
        const Real* const at = task.has_variables()
                                   ? map.wanted.data() + 2 * (Offset{i} * task.n_variables() + j)
                                   : member.data() + 2 * (Offset{j} * place.count() + i);
        return {at[0], at[1]};
    }

private:
    void begin(MovementTask const& task) noexcept {
        const Real* const control = task.view.set.control;
        fill(is_used, static_cast<unsigned char>(0));
        fill(derivative, Vec2{});
        fill(start, Real(0));
        fill(zero, Real(0));
        for (Index i = 0; i < place.count(); ++i) {
            place[i] = {control[2 * i], control[2 * i + 1]};
            move[i] = {};
        }
        for (Index c = 0; c < task.section.n_curves; ++c) {
            Curve const& curve = task.section.curve[c];
            for (Index k = 0; k < curve.n_indices; ++k) is_used[curve.control_point(k)] = 1;
        }
    }
    Status refuse_value(Index number, const Real* values, Fault& fault) const noexcept {
        return fault.refuse(Status::bad_argument,
                            "value # of the movements is ~, which is out of range",
                            variable_item(number), {}, values[number]);
    }
    void map_points(Movement const& movement, const Real* values, Index first) noexcept {
        Offset const n = place.count();
        for (Index i = 0; i < place.count(); ++i) {
            if (is_used[i] == 0) continue;
            MappedPoint const mapped = map_point(movement, values, place[i]);
            for (Index j = 0; j < first; ++j) {
                Vec2& by = derivative[j * n + i];
                by = by.x * mapped.by_x + by.y * mapped.by_y;
            }
            for (Index j = 0; j < movement.count(); ++j)
                derivative[(first + j) * n + i] = mapped.by_value[j];
            place[i] = place[i] + mapped.move;
            move[i] = move[i] + mapped.move;
        }
    }
    // Compares the moved curves with the maps of their points.
    void add_error_of_maps(MovementTask const& task, const Real* values) noexcept {
        constexpr Index samples = 16;  // of a span of the knots
        Real largest = 0, squares = 0, total = 0;
        for (Index c = 0; c < task.section.n_curves; ++c) {
            Curve const& curve = task.section.curve[c];
            Vec2 before;
            for (Index span = curve.degree; span < curve.n_indices; ++span) {
                Real const begin = curve.knots[span], range = curve.knots[span + 1] - begin;
                for (Index k = 0; k <= samples && range > 0; ++k) {
                    CurveBasis const basis =
                        curve_basis_in(curve, span, begin + k * (range / samples), 0);
                    Vec2 const at = sum_of(basis, unmapped), moved = sum_of(basis, place);
                    Real const difference = length(moved - mapped(task, values, at)),
                               weight = k > 0 ? length(at - before) : 0;
                    before = at;
                    largest = max(largest, difference);
                    squares += weight * difference * difference;
                    total += weight;
                }
            }
        }
        Real const rms = total > 0 ? sqrt(squares / total) : 0;
        error[0] = sqrt(error[0] * error[0] + rms * rms);
        error[1] += largest;
    }
    static Vec2 sum_of(CurveBasis const& basis, Span<const Vec2> control) noexcept {
        Vec2 sum;
        for (Index k = 0; k < basis.order; ++k)
            sum = sum + basis.value[0][k] * control[basis.control[k]];
        return sum;
    }
    // Returns where all maps of the task take a point.
    static Vec2 mapped(MovementTask const& task, const Real* values, Vec2 point) noexcept {
        Index first = 0;
        for (Index k = 0; k < task.n_movements; ++k) {
            Movement const& movement = task.movement[k];
            if (movement.maps_points())
                point = point + map_point(movement, values + first, point).move;
            first += movement.count();
        }
        return point;
    }
    Status add_linear(MovementTask const& task, const Real* values, CallFault& fault) noexcept {
        HARMORPH_TRY(task.has_variables() ? find_map(task, fault) : find_modes(task, fault));
        Index const n = task.n_variables();
        Offset const n_control = place.count();
        for (Index i = 0; i < place.count(); ++i) {
            for (Index j = 0; j < n; ++j) {
                Vec2 const by_x = unit_move(task, i, j), by_y{-by_x.y, by_x.x};
                Offset const row = task.has_pairs() ? 2 * Offset{j} : j;
                derivative[row * n_control + i] = by_x;
                move[i] = move[i] + values[row] * by_x;
                if (!task.has_pairs()) continue;
                derivative[(row + 1) * n_control + i] = by_y;
                move[i] = move[i] + values[row + 1] * by_y;
            }
            place[i] = place[i] + move[i];
        }
        for (Index j = 0; j < n && task.has_variables(); ++j) {
            const Real* const v = values + (task.has_pairs() ? 2 * j : j);
            Real const size = task.has_pairs() ? length(Vec2{v[0], v[1]}) : abs(v[0]);
            for (Index k = 0; k < 2; ++k) error[k] += size * map.error[2 * j + k];
        }
        return Status::ok;
    }
    Status find_map(MovementTask const& task, Fault& fault) noexcept {
        VariablesOfSection const wanted{task.section, task.variables};
        HARMORPH_TRY(map.run(task.section, wanted.movements(), fault));
        return map.check_independence(fault);
    }
    Status find_modes(MovementTask const& task, CallFault& fault) noexcept {
        copy(member, Span<const Real>(task.family.members, member.size()));
        modes.start();
        for (Index number = 0; number < task.view.count(); ++number) {
            Curve curve;
            HARMORPH_TRY(task.view.checked_curve(number, curve, fault));
            modes.add(curve);
        }
        return modes.run(task.family.n_members, member.data(), singular.data(), fault);
    }
    Status change_outline(Section const& section, Movement const& movement, const Real* values,
                          Fault& fault) noexcept {
        ParsecChange parsec;
        CamberChange camber;
        bool const is_parsec = movement.kind == MovementKind::parsec;
        if (is_parsec) HARMORPH_TRY(parsec.measure(section, fault));
        else HARMORPH_TRY(camber.measure(section, movement, fault));
        Index const bad = is_parsec ? parsec.set(values) : camber.set(values);
        if (bad != none) return refuse_value(bad, values, fault);
        HARMORPH_TRY(map.run(section, is_parsec ? parsec.movements() : camber.movements(), fault));
        Index const n_columns = 1 + movement.count();
        for (Index i = 0; i < place.count(); ++i) {
            const Real* const row = map.wanted.data() + Offset{i} * 2 * n_columns;
            move[i] = {row[0], row[1]};
            place[i] = place[i] + move[i];
            for (Index j = 1; j < n_columns; ++j)
                derivative[Offset{j - 1} * place.count() + i] = {row[2 * j], row[2 * j + 1]};
        }
        for (Index j = 0; j < movement.count(); ++j)
            start[j] = is_parsec ? parsec.start(j) : camber.start(j);
        for (Index k = 0; k < 2; ++k) error[k] = map.error[k];
        return Status::ok;
    }
};

void write_pairs(Span<const Vec2> from, double* to) noexcept {
    for (Index i = 0; to != nullptr && i < from.count(); ++i) {
        to[2 * i] = from[i].x;
        to[2 * i + 1] = from[i].y;
    }
}

void write_result(MovementTask const& task, MovementWork const& arrays,
                  hm_section_move const& to) noexcept {
    write_pairs(arrays.move, to.move);
    write_pairs(arrays.derivative, to.derivatives);
    for (Index j = 0; to.start != nullptr && j < task.n_values; ++j) to.start[j] = arrays.start[j];
    Offset at = 0;
    for (Index i = 0; to.matrix != nullptr && i < arrays.place.count(); ++i) {
        for (Index j = 0; j < task.n_variables(); ++j) {
            Vec2 const by = arrays.unit_move(task, i, j);
            to.matrix[at++] = by.x;
            to.matrix[at++] = by.y;
        }
    }
    bool const has_errors = to.unit_errors != nullptr && task.has_variables();
    for (Index j = 0; has_errors && j < 2 * to.n_variables; ++j)
        to.unit_errors[j] = arrays.map.error[j];
    for (Index k = 0; task.family.singular != nullptr && k < task.family.n_members; ++k)
        task.family.singular[k] = arrays.singular[k];
}

Status count_section_move(MovementTask const& task, hm_section_move& to, Fault& fault) noexcept {
    to.n_values = task.n_values;
    to.n_variables = task.n_movements == 1 ? task.n_variables() : 0;
    if (to.n_variables > 0 || to.matrix == nullptr) return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "result.matrix must be NULL unless the only movement is HM_LINEAR or "
                        "HM_FAMILY");
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_move_section(const hm_curves* curves, const hm_section* section, int32_t n_movements,
                          const hm_movement* movements, const double* values,
                          hm_section_move* result, hm_memory* memory, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        MovementTask task;
        MovementWork arrays;
        hm_section_move to = {};
        HARMORPH_TRY(task.open(curves, section, n_movements, movements, fault));
        HARMORPH_TRY(check_report_if(result, "result", fault));
        if (result != nullptr)
            HARMORPH_TRY(open_struct(result, to, "result", "hm_section_move", fault));
        HARMORPH_TRY(count_section_move(task, to, fault));
        Status const placed =
            place(memory, fault, [&](Arena& arena) { arrays.lay_out(arena, task); });
        if (placed == answered && result != nullptr) write_struct(to, result);
        HARMORPH_TRY(placed);
        HARMORPH_TRY(require({{"result", result}}, fault));
        HARMORPH_TRY(arrays.run(task, values, fault));
        for (Index k = 0; k < 2; ++k) to.error[k] = arrays.error[k];
        write_result(task, arrays, to);
        write_struct(to, result);
        return Status::ok;
    });
}

}  // extern "C"
