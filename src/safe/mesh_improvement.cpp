#include "safe/mesh_improvement.hpp"

#include "base/vec2.hpp"
#include "morph/quality.hpp"

namespace harmorph {
namespace {

Status check_points(Plan const& plan, Points points, const char* inverted_cell,
                    Fault& fault) noexcept {
    HARMORPH_TRY(check_range(points, plan.mesh().n_points, fault));
    OrientedMesh const& cells = plan.cells();
    Index const inverted =
        plan.mesh().find_cell(0, plan.mesh().n_checked(), [&](Index i, Cell const&) {
            CellShape const shape = shape_of(cells, i, points);
            return is_inverted(shape) || is_inverted_exactly(shape);
        });
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, inverted_cell, cell_item(plan.mesh().number(inverted)));
}

}  // namespace

void MeshImprovement::lay_out(Arena& arena, Plan const& plan) noexcept {
    mobility.lay_out(arena, plan);
    first_layer.lay_out(arena, plan.mesh(), static_cast<Size>(plan.walls().count));
    improvement.lay_out(arena, plan.region_counts());
    arena.take(start, plan.mesh().n_points);
}

Status MeshImprovement::check(Plan const& plan, Points reference, Points from,
                              Fault& fault) noexcept {
    HARMORPH_TRY(check_points(plan, reference, "cell # of the reference mesh is inverted", fault));
    return check_points(plan, from, "cell # is inverted: only a valid mesh can be improved", fault);
}

void MeshImprovement::run(Plan& plan, ImproveOptions const& options, Points reference, Points from,
                          MutablePoints to, ImproveReport& report) noexcept {
    FaceDistance const& walls = plan.walls_at(reference);
    mobility.find(plan, from);
    first_layer.find(plan.mesh(), reference, mobility.representative, walls.chosen());
    improvement.executor = plan.executor();
    improvement.tangle = mobility.tangle(plan, reference);
    improvement.slipping = mobility.slipping;
    improvement.targets.find(plan.cells(), walls, reference, from, plan.executor());
    auto const smallest = [&](Points points) {
        return measure_quality(plan.cells(), points, reference, plan.executor()).min_quality;
    };
    MutablePoints const result{&start.data()->x, &start.data()->y, 2};
    auto const stay = [&] {
        for (Index k = 0; k < start.count(); ++k) start[k] = from[k];
    };
    constexpr Real rounding = 1e-9;  // the difference of one quality that is found in two ways
    Real const given = smallest(from);
    ImproveOptions kept = options;
    kept.lowest = given;
    carry_first_layer(reference, from);
    hold_first_layer(plan, reference);
    bool const is_in_vain = smallest_held(plan, reference) < (1 - rounding) * given;
    if (!is_in_vain) improvement.run(kept, result, result, report);
    if (is_in_vain ||
        smallest(result) < given) {  // the gain of the first layer is not worth that loss
        mobility.find(plan, from);
        stay();
        hold_first_layer(plan, reference);
        improvement.run(kept, result, result, report);
        if (smallest(result) < given)
            stay();  // the quality that targets use differs from the reported quality
    }
    for (Index k = 0; k < start.count(); ++k) to.set(k, start[k]);
}

// Returns the smallest quality of all cells without a movable point.
Real MeshImprovement::smallest_held(Plan const& plan, Points reference) const noexcept {
    OrientedMesh const& cells = plan.cells();
    Mesh const& mesh = cells.mesh;
    auto const can_move = [&](Index i) {
        Cell const cell = mesh.cell(i);
        bool any = false;
        for (Index k = 0; k < cell.n; ++k)
            any = any || mobility.held[mobility.representative[cell.point[k]]] == 0;
        return any;
    };
    Real smallest = infinity;
    for (Index number = 0; number < mesh.n_given_cells(); ++number) {
        bool any = false;
        for (Index const i : mesh.pieces_of(number)) any = any || can_move(i);
        if (any) continue;
        Real const before = measure_cell(cells, number, reference).area;
        smallest = min(smallest, measure_cell(cells, number, as_points(start)).quality(before));
    }
    return smallest;
}

void MeshImprovement::carry_first_layer(Points reference, Points from) noexcept {
    constexpr Real rounding =
        1e-10;  // in parts of the height; a top that is nearer to its place stays
    WallPoints const& wall = first_layer.wall;
    improvement.region.link(improvement.tangle);
    for (Index k = 0; k < start.count(); ++k) start[k] = from[k];
    for (Index slot = 0; slot < wall.count; ++slot) {
        Index const top = first_layer.above[slot], foot = wall.point[slot];
        if (top == none || mobility.held[top] != 0) continue;
        Vec2 const edge =
            turned(reference[top] - reference[foot], wall.turn(slot, reference, from));
        Vec2 way = from[foot] + edge - start[top];
        if (improvement.tangle.slips(top)) way = dot(mobility.line[top], way) * mobility.line[top];
        if (!(square(way) > rounding * rounding * square(edge))) continue;
        Vec2 const here = start[top];
        for (Real part = 1; part > 0.1; part *= 0.5) {
            if (try_top(top, mobility.slipping.placed(top, here + part * way), from)) break;
        }
    }
    for (Index k = 0; k < start.count(); ++k) start[k] = position(k, from);
}

// Moves a top unless the movement inverts one of the cells of the top.
bool MeshImprovement::try_top(Index top, Vec2 at, Points from) noexcept {
    Vec2 const here = start[top];
    start[top] = at;
    for (Index const i : improvement.region.cells_of(top)) {
        Cell const cell = improvement.tangle.cell(i);
        Vec2 corner[4];
        for (Index k = 0; k < cell.n; ++k) corner[k] = position(cell.point[k], from);
        CellShape shape(Cell{cell.n, {0, 1, 2, 3}}, {&corner->x, &corner->y, 2}, false);
        if (i >= improvement.tangle.mesh.n_cells)
            turn_guard(shape, turn_of(improvement.tangle.mesh, i));
        if (!is_inverted(shape) && !is_inverted_exactly(shape)) continue;
        start[top] = here;
        return false;
    }
    return true;
}

// Returns the position of a point; points of a cut or of a pair move as their representative does,
// or turned against it.
Vec2 MeshImprovement::position(Index point, Points from) const noexcept {
    Index const own = mobility.representative[point];
    Tangle const& tangle = improvement.tangle;
    if (own == point) return start[own];
    return from[point] +
           tangle.turned_alike(point, tangle.turned_to_unknown(own, start[own] - from[own]));
}

void MeshImprovement::hold_first_layer(Plan const& plan, Points reference) noexcept {
    constexpr std::uint8_t top = 2, poor = 4;
    Span<std::uint8_t> const held = mobility.held;
    for (Index const above : first_layer.above.first(first_layer.wall.count)) {
        if (above != none) held[above] |= top;
    }
    for (Index i = 0; i < plan.mesh().n_checked(); ++i) {
        Cell const cell = plan.cells().cell(i);
        CellShape const before = shape_of(plan.cells(), i, reference);
        CellShape const now = shape_of(plan.cells(), i, as_points(start));
        Real const quality = improvement.targets.quality(i, before);
        if (improvement.targets.quality(i, now) >= Targets::part_of_own * quality) continue;
        for (Index k = 0; k < cell.n; ++k) held[mobility.representative[cell.point[k]]] |= poor;
    }
    for (std::uint8_t& flags : held)
        flags = (flags & 1) != 0 || ((flags & top) != 0 && (flags & poor) == 0) ? 1 : 0;
}

}  // namespace harmorph
