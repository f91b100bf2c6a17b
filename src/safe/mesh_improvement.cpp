#include "safe/mesh_improvement.hpp"

#include "base/vec2.hpp"

namespace harmorph {
namespace {

Status check_points(Plan const& plan, Points points, const char* inverted_cell,
                    Fault& fault) noexcept {
    HARMORPH_TRY(check_range(points, plan.mesh().n_points, fault));
    OrientedMesh const& cells = plan.equations().cells();
    Index const inverted =
        plan.mesh().find_cell(0, plan.mesh().n_checked(), [&](Index i, Cell const&) {
            CellShape const shape = shape_of(cells, i, points);
            return is_inverted(shape) || is_inverted_exactly(shape);
        });
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, inverted_cell, cell_item(plan.mesh().number(inverted)));
}

bool is_same(Points one, Points other, Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        if (one[k].x != other[k].x || one[k].y != other[k].y) return false;
    }
    return true;
}

}  // namespace

void MeshImprovement::lay_out(Arena& arena, Plan const& plan) noexcept {
    mobility.lay_out(arena, plan);
    first_layer.lay_out(arena, plan.mesh(), static_cast<Size>(plan.equations().walls().count));
    improvement.lay_out(arena, plan);
    improvement.anchors.lay_out(arena,
                                min(plan.mesh().n_points, 2 * plan.equations().walls().count));
    arena.take(result, plan.mesh().n_points);
}

Status MeshImprovement::check(Plan const& plan, Points reference, Points from,
                              Fault& fault) noexcept {
    HARMORPH_TRY(check_points(plan, reference, "cell # of the reference mesh is inverted", fault));
    return check_points(plan, from, "cell # is inverted: only a valid mesh can be improved", fault);
}

void MeshImprovement::begin(Plan& plan, Points reference, Points from) noexcept {
    FaceDistance const& walls = plan.equations().walls_at(reference);
    mobility.find(plan, from);
    first_layer.find(plan.mesh(), reference, mobility.representative, walls.chosen());
    find_layer(reference, from);
    improvement.executor = plan.executor();
    improvement.tangle = mobility.tangle(plan, reference);
    improvement.slipping = mobility.slipping;
    improvement.measure_reference();
    given_quality = improvement.smallest_of(from);
}

void MeshImprovement::run(Plan& plan, ImproveOptions const& options, Points reference, Points from,
                          ImproveReport& report) noexcept {
    report = {};
    bool is_better = false;
    if (is_same(reference, from, result.count())) {
        report.converged = true;
    } else {
        begin(plan, reference, from);
        if (!improve_with_layer(plan, options, from, report))
            improve_without_layer(plan, options, from, report);
        is_better = is_at_least(found(), given_quality);
    }
    for (Index k = 0; k < result.count() && !is_better; ++k) result[k] = from[k];
}

// Returns whether the smallest quality is not less, except by rounding: one quality may be found in
// two ways.
bool MeshImprovement::is_at_least(Points points, Real smallest) const noexcept {
    constexpr Real rounding = 1e-9;
    return improvement.smallest_of(points) >= (1 - rounding) * smallest;
}

// Puts the first layer in its place and improves the other points. Returns false if the smallest
// quality suffers; the anchors are then those of the whole layer again.
bool MeshImprovement::improve_with_layer(Plan const& plan, ImproveOptions const& options,
                                         Points from, ImproveReport& report) noexcept {
    Index const n_anchors = improvement.anchors.count;
    bool is_in_vain = false;
    improvement.run(plan, options, given_quality, from, found(), report, [&] {
        if (n_anchors == 0) return Prepared::nothing;
        Prepared const prepared = pull_layer(options, report.solutions, from);
        is_in_vain = prepared == Prepared::end;
        return prepared;
    });
    improvement.anchors.count = n_anchors;
    return n_anchors == 0 || (!is_in_vain && is_at_least(found(), given_quality));
}

// Decides before each step what becomes of the anchors. Prepared::end: the layer is not worth the
// loss of quality.
Prepared MeshImprovement::pull_layer(ImproveOptions const& options, Index solutions,
                                     Points from) noexcept {
    // Parts of the smallest quality before: what must be left if tops are put in their places at
    // once, while anchors pull them, and when they have been put there.
    constexpr Real at_once = 0.9, meanwhile = 0.8, afterwards = 0.7;
    Real const smallest = improvement.smallest();
    if (improvement.anchors.count == 0) {
        bool const is_last_chance = solutions == options.max_solutions * 3 / 5;
        return is_last_chance && smallest < given_quality ? Prepared::end : Prepared::nothing;
    }
    bool const is_first = solutions == 0, is_late = 3 * solutions >= options.max_solutions;
    if (smallest < meanwhile * given_quality) return Prepared::end;
    if (!is_first && !is_late && farthest_top() > near_place && !improvement.is_slow())
        return Prepared::mesh;
    place_first_layer(is_first ? at_once * given_quality : 0, from);
    bool const is_poor =
        improvement.anchors.count == 0 && improvement.smallest() < afterwards * given_quality;
    return is_poor ? Prepared::end : Prepared::mesh;
}

// Begins again, with those tops held where they are in `from` whose cells are not poor there.
void MeshImprovement::improve_without_layer(Plan const& plan, ImproveOptions const& options,
                                            Points from, ImproveReport& report) noexcept {
    Index const spent = report.solutions;
    for (Index k = 0; k < result.count(); ++k) improvement.now[k] = from[k];
    hold_first_layer(false);
    drop_poor_tops();
    hold_first_layer(true);
    improvement.anchors.count = 0;
    ImproveOptions rest = options;
    rest.max_solutions -= spent;
    rest.spent += spent;
    improvement.run(plan, rest, given_quality, from, found(), report,
                    [] { return Prepared::nothing; });
    report.solutions += spent;
}

// Returns whether the mesh has a layer at a wall point with an edge into the mesh.
bool MeshImprovement::has_layer(Index slot, Points reference) const noexcept {
    WallPoints const& wall = first_layer.wall;
    Vec2 const foot = reference[wall.point[slot]];
    Vec2 along;
    Real lengths = 0;
    Index faces = 0;
    auto const add = [&](Index neighbour, Real sign) {
        if (neighbour == none) return;
        Vec2 const face = sign * (reference[neighbour] - foot);
        along = along + 1 / length(face) * face;
        lengths += length(face);
        ++faces;
    };
    add(wall.previous[slot], -1);
    add(wall.next[slot], 1);
    Vec2 const edge = reference[first_layer.above[slot]] - foot;
    return lengths * length(along) > layer_anisotropy * faces * abs(cross(along, edge));
}

// Makes anchors of the tops where the mesh has a layer.
void MeshImprovement::find_layer(Points reference, Points from) noexcept {
    // A top that is nearer to its place than this part of the height stays.
    constexpr Real rounding = 1e-10;
    WallPoints const& wall = first_layer.wall;
    Anchors& anchors = improvement.anchors;
    anchors.count = 0;
    anchors.weight = 1;
    for (Index slot = 0; slot < wall.count; ++slot) {
        Index const top = first_layer.above[slot], foot = wall.point[slot];
        if (top == none || mobility.held[top] != 0 || !has_layer(slot, reference)) continue;
        Vec2 const edge =
            rotated(reference[top] - reference[foot], wall.rotation(slot, reference, from));
        Vec2 way = from[foot] + edge - from[top];
        if (!mobility.line.empty() && square(mobility.line[top]) > 0)
            way = dot(mobility.line[top], way) * mobility.line[top];
        if (!(square(way) > rounding * rounding * square(edge))) way = {};
        anchors.add(top, mobility.slipping.placed(top, from[top] + way), 1 / square(edge));
    }
}

// Returns the largest distance of a top from its place, in parts of its height.
Real MeshImprovement::farthest_top() const noexcept {
    Anchors const& anchors = improvement.anchors;
    Real largest = 0;
    for (Index k = 0; k < anchors.count; ++k)
        largest = max(largest, anchors.scale[k] *
                                   square(improvement.now[anchors.point[k]] - anchors.place[k]));
    return sqrt(largest);
}

void MeshImprovement::hold_first_layer(bool holds) noexcept {
    Anchors const& anchors = improvement.anchors;
    for (Index const top : anchors.point.first(anchors.count)) mobility.held[top] = holds ? 1 : 0;
}

// Puts the tops in their places, as far as no cell is inverted, and holds them there. If the
// smallest quality would then be below `lowest`, nothing changes.
void MeshImprovement::place_first_layer(Real lowest, Points from) noexcept {
    Anchors& anchors = improvement.anchors;
    Span<Vec2> const now = improvement.now;
    copy(improvement.change, Span<const Vec2>(now));
    bool all = true;
    for (Index k = 0; k < anchors.count; ++k) {
        Index const top = anchors.point[k];
        Vec2 const here = now[top], way = anchors.place[k] - here;
        bool moves = way.x == 0 && way.y == 0;
        for (Real part = 1; part > 0.05 && !moves; part *= 0.5) {
            moves = try_top(top, mobility.slipping.placed(top, here + part * way), from);
            all = all && moves && part == 1;
        }
    }
    for (Index k = 0; k < now.count(); ++k) now[k] = position(k, from);
    if (lowest > 0 && (!all || improvement.smallest() < lowest)) {
        copy(now, Span<const Vec2>(improvement.change));
        return;
    }
    drop_poor_tops();
    hold_first_layer(true);
    anchors.count = 0;
    improvement.restart();
}

// Lets tops go whose cells have less than this part of their former quality: they follow behind
// the anchors that are kept.
void MeshImprovement::drop_poor_tops() noexcept {
    constexpr Real part_of_own = 0.5;
    Tangle const& tangle = improvement.tangle;
    Anchors& anchors = improvement.anchors;
    auto const is_poor = [&](Index i) {
        CellShape const before = tangle.shape(i, tangle.reference);
        CellMeasure const measure_before(before.n, CellCorners(before));
        CellShape const after = tangle.shape(i, as_points(improvement.now));
        CellMeasure const measure_after(after.n, CellCorners(after));
        return measure_after.quality(measure_before.area) < part_of_own * measure_before.quality(0);
    };
    Index kept = 0;
    for (Index k = 0; k < anchors.count; ++k) {
        bool has_poor_cell = false;
        for (Index const i : improvement.region.cells_of(anchors.point[k]))
            has_poor_cell = has_poor_cell || is_poor(i);
        if (has_poor_cell) continue;
        Index const top = anchors.point[k];
        anchors.point[k] = anchors.point[kept];
        anchors.point[kept++] = top;
    }
    anchors.count = kept;
}

// Moves a top unless the movement inverts one of the cells of the top.
bool MeshImprovement::try_top(Index top, Vec2 at, Points from) noexcept {
    Span<Vec2> const now = improvement.now;
    Vec2 const here = now[top];
    now[top] = at;
    for (Index const i : improvement.region.cells_of(top)) {
        Cell const cell = improvement.tangle.cell(i);
        Vec2 corner[4];
        for (Index k = 0; k < cell.n; ++k) corner[k] = position(cell.point[k], from);
        CellShape shape(Cell{cell.n, {0, 1, 2, 3}}, {&corner->x, &corner->y, 2}, false);
        if (i >= improvement.tangle.mesh.n_cells)
            rotate_guard(shape, rotation_of(improvement.tangle.mesh, i));
        if (!is_inverted(shape) && !is_inverted_exactly(shape)) continue;
        now[top] = here;
        return false;
    }
    return true;
}

// Returns the position of a point; points of a cut or of a pair move as their representative does,
// or rotated against it.
Vec2 MeshImprovement::position(Index point, Points from) const noexcept {
    Index const own = mobility.representative[point];
    Tangle const& tangle = improvement.tangle;
    Span<const Vec2> const now = improvement.now;
    if (own == point) return now[own];
    return from[point] +
           tangle.rotated_alike(point, tangle.rotated_to_unknown(own, now[own] - from[own]));
}

}  // namespace harmorph
