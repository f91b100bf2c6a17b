#include "harmorph/safe/mesh_improvement.hpp"

#include "harmorph/morph/quality.hpp"

namespace harmorph {

void MeshImprovement::lay_out(Arena& arena, Plan const& plan) noexcept {
    mobility.lay_out(arena, plan);
    first_layer.lay_out(arena, plan.mesh, static_cast<Size>(plan.equations.wall.count));
    improvement.lay_out(arena, plan.region_counts);
}

Status MeshImprovement::check(Plan const& plan, Points points, const char* inverted_cell, Fault& fault) const noexcept {
    Span<std::uint8_t> const reversed = plan.equations.cells.reversed;
    for (Index k = 0; k < plan.mesh.n_points; ++k) {
        if (is_in_range(points[k])) continue;
        return fault.refuse(Status::bad_mesh, "point # has a coordinate that is not finite, or larger than 1e100",
                            Counts::mesh, k);
    }
    Index const inverted = plan.mesh.find_cell([&](Index i, Cell const& cell) {
        CellShape const shape(cell, points, reversed[i] != 0);
        return is_inverted(shape) || is_inverted_exactly(shape);
    });
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, inverted_cell, Counts::mesh, inverted);
}

Status MeshImprovement::run(Plan& plan, ImproveOptions const& options, Points reference, Points from, MutablePoints to,
                            ImproveReport& report, Fault& fault) noexcept {
    FaceDistance& walls = plan.equations.wall;
    HARMORPH_TRY(check(plan, reference, "cell # of the reference mesh is inverted", fault));
    HARMORPH_TRY(check(plan, from, "cell # is inverted: only a valid mesh can be improved", fault));
    walls.build(reference);
    mobility.find(plan);
    improvement.executor = plan.executor;
    improvement.targets.find(plan.equations.cells, walls, reference, from, plan.executor);
    hold_first_layer(plan, reference, from);
    improvement.tangle = mobility.tangle(plan, reference);
    improvement.run(options, from, to, report);
    return Status::ok;
}

void MeshImprovement::hold_first_layer(Plan const& plan, Points reference, Points points) noexcept {
    constexpr std::uint8_t top = 2, poor = 4;
    Span<std::uint8_t> const held = mobility.held;
    first_layer.find(plan.mesh, reference, mobility.representative, plan.equations.wall);
    for (Index const above : first_layer.above.first(first_layer.wall.count)) {
        if (above != none) held[above] |= top;
    }
    for (Index i = 0; i < plan.mesh.n_cells; ++i) {
        Cell const cell = plan.equations.cells.cell(i);
        CellShape const before(cell, reference, false), now(cell, points, false);
        Real const quality = skew_quality(before.n, CellCorners(before));
        if (improvement.targets.quality(i, now) >= Targets::part_of_own * quality) continue;
        for (Index k = 0; k < cell.n; ++k) held[mobility.representative[cell.point[k]]] |= poor;
    }
    for (std::uint8_t& flags : held) flags = (flags & 1) != 0 || ((flags & top) != 0 && (flags & poor) == 0) ? 1 : 0;
}

}  // namespace harmorph
