#include "plan/transfer.hpp"

#include "base/executor.hpp"

namespace harmorph {
namespace {

constexpr Real max_outside = 0.5;  // The unit is the longest side of the nearest cell.

// The results for a range of points.
struct Tally {
    Index cell = none;  // The last cell found, in which the next point probably is.
    Index points = 0, outside = 0;
    Real max_distance = 0;
    Index max_distance_point = none;
    Index too_far = none;  // The first point that is too far outside.
    Real too_far_by = 0;

    void add(Index point, Location const& location) noexcept {
        cell = location.cell;
        if (!(location.distance > 0)) return;
        ++outside;
        if (max_distance_point == none || location.distance > max_distance) {
            max_distance = location.distance;
            max_distance_point = point;
        }
        if (too_far != none || location.distance <= max_outside * location.longest_side) return;
        too_far = point;
        too_far_by = location.distance;
    }
    // Merges the results of points that come later.
    void merge(Tally const& later) noexcept {
        points += later.points;
        outside += later.outside;
        if (later.max_distance > max_distance) {
            max_distance = later.max_distance;
            max_distance_point = later.max_distance_point;
        }
        if (too_far == none) {
            too_far = later.too_far;
            too_far_by = later.too_far_by;
        }
    }
};

template <class T>
bool same_bytes(Span<T> a, Span<T> b) noexcept {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Tells whether the body has the same centre in the coarse basis.
bool same_centre(Basis const& coarse, Condition const& rigid) noexcept {
    for (Condition const& other : coarse.conditions) {
        if (other.kind != ConditionKind::rigid || other.body != rigid.body) continue;
        return other.centre.x == rigid.centre.x && other.centre.y == rigid.centre.y;
    }
    return false;
}

class TransferRun {
public:
    TransferRun(Transfer const& transfer, Analysis const& analysis, Basis const& coarse,
                Basis const& fine) noexcept
        : transfer_(transfer),
          analysis_(analysis),
          points_(analysis.problem().mesh.points),
          coarse_(coarse),
          fine_(fine),
          row_length_(fine.row_length()) {}

    Tally set_wall() const noexcept {
        Index const n = fine_.wall_point.count();
        return reduce_cells<Tally>(n, executor(),
                                   [&](Index slot, Tally& tally) { set_slot(slot, tally); });
    }

    Tally set_points() const noexcept {
        return reduce_cells<Tally>(fine_.n_points(), executor(),
                                   [&](Index point, Tally& tally) { set_point(point, tally); });
    }

    void copy_joined_points() const noexcept {
        for (Index point = 0; point < fine_.n_points(); ++point) {
            Index const same = analysis_.topology().representative[point];
            if (same == point) continue;
            copy_row(fine_.row(point), fine_.row(same), row_length_);
            if (analysis_.problem().demands.rotation) rotate(point, same);
        }
    }

private:
    Executor const& executor() const noexcept { return analysis_.problem().executor; }
    Real* correction(Index slot) const noexcept {
        return transfer_.correction.data() + Offset{slot} * row_length_;
    }

    void set_slot(Index slot, Tally& tally) const noexcept {
        Index const point = fine_.wall_point[slot];
        Location const location = transfer_.locator.locate(points_[point], tally.cell);
        tally.add(point, location);
        transfer_.reach[slot] = location.longest_side;
        interpolate(location.weights, correction(slot));
        auto const row = fine_.row(point);
        set_boundary_functions(slot, row);
        for (Index k = 0; k < row_length_; ++k) correction(slot)[k] = row[k] - correction(slot)[k];
    }

    // Adds the boundary functions to a row of zeros.
    void set_boundary_functions(Index slot, RowInBlock<Real> row) const noexcept {
        BoundaryFunctions const functions = fine_.boundary_functions(slot);
        for (Index k = 0; k < functions.order; ++k) {
            Numbers const numbers = numbers_of(fine_.kind(), functions.value[k]);
            for (Index plane = 0; plane < numbers_of(fine_.kind()); ++plane) {
                row[plane * fine_.n_functions() + functions.function[k]] += numbers.plane[plane];
            }
        }
    }

    void set_point(Index point, Tally& tally) const noexcept {
        PointKind const kind = analysis_.kinds()[point];
        if (!is_unknown(kind)) return;
        auto const row = fine_.row(point);
        Location const location = transfer_.locator.locate(points_[point], tally.cell);
        ++tally.points;
        tally.add(point, location);
        interpolate(location.weights, row);
        move_along_with_wall(point, row);
        if (kind == PointKind::slip) keep_on_line(analysis_.tangent()[point], row);
    }

    template <class Row>
    void interpolate(CellWeights const& weights, Row row) const noexcept {
        for (Index k = 0; k < row_length_; ++k) {
            Real sum = 0;
            for (Index c = 0; c < weights.n; ++c)
                sum += weights.weight[c] * coarse_.row(weights.point[c])[k];
            row[k] = sum;
        }
    }

    void move_along_with_wall(Index point, RowInBlock<Real> row) const noexcept {
        // The search begins without a guess, as the choice between two feet at equal distance must
        // not depend on the threads.
        Index group = 0;
        FaceDistance::Foot const foot = transfer_.wall.foot(points_[point], group);
        if (foot.face == none) return;
        FaceDistance::Face const& face = transfer_.wall.faces[foot.face];
        Index const a = slot_of(face.point[0]), b = slot_of(face.point[1]);
        Real const reach = (1 - foot.t) * transfer_.reach[a] + foot.t * transfer_.reach[b];
        Real const factor = 1 - length(points_[point] - transfer_.wall.at(foot, points_)) / reach;
        if (!(factor > 0)) return;
        for (Index k = 0; k < row_length_; ++k) {
            row[k] += factor * ((1 - foot.t) * correction(a)[k] + foot.t * correction(b)[k]);
        }
    }

    Index slot_of(Index point) const noexcept {
        return analysis_.wall_slot()[analysis_.topology().representative[point]];
    }

    // Rotates the values of a point on a side of a passage that is rotated against the side of the
    // other point.
    void rotate(Index point, Index same) const noexcept {
        Periodicity const& periodicity = analysis_.periodicity();
        Vec2 const by =
            periodicity.rotation.power(periodicity.times[point] - periodicity.times[same]);
        auto const row = fine_.row(point);
        Index const half = row_length_ / 2;
        for (Index k = 0; k < half; ++k) {
            Vec2 const rotated = product(by, {row[k], row[half + k]});
            row[k] = rotated.x;
            row[half + k] = rotated.y;
        }
    }

    // Keeps the values of a slipping point on its line. A row of matrix values has the movements
    // along x in the first half, those along y in the second one.
    void keep_on_line(Vec2 tangent, RowInBlock<Real> row) const noexcept {
        Index const half = row_length_ / 2;
        for (Index k = 0; k < half; ++k) {
            Real const along = tangent.x * row[k] + tangent.y * row[half + k];
            row[k] = tangent.x * along;
            row[half + k] = tangent.y * along;
        }
    }

    Transfer const& transfer_;
    Analysis const& analysis_;
    Points points_;
    Basis const& coarse_;
    Basis const& fine_;
    Index row_length_;
};

}  // namespace

void Transfer::lay_out(Arena& arena, Analysis const& fine, Mesh const& coarse) noexcept {
    BasisCounts const counts = fine.basis_counts();
    bool const polygons = coarse.layout == CellLayout::polygons;
    locator.lay_out(arena, polygons ? coarse.max_pieces() : coarse.n_cells);
    wall.lay_out(arena, static_cast<Size>(fine.count_wall_faces()));
    arena.take(correction,
               Offset{counts.wall} * (Offset{numbers_of(counts.kind)} * counts.functions()));
    arena.take(reach, counts.wall);
}

Status Transfer::run(Analysis const& analysis, Mesh const& coarse_mesh, Basis const& coarse,
                     Basis const& fine, TransferReport& report, Fault& fault) noexcept {
    HARMORPH_TRY(check_alike(coarse, fine, fault));
    fine.unseal();
    fill(fine.value, 0.0);
    Points const points = analysis.problem().mesh.points;
    locator.build(coarse.cells(coarse_mesh));
    wall.kernel = resolved(Kernel::automatic, analysis.problem().executor.kernel);
    wall.choose(analysis.boundary(), [&](Index face) { return analysis.is_wall_face(face); });
    wall.build(points);
    TransferRun run(*this, analysis, coarse, fine);
    Tally tally = run.set_wall();
    tally.merge(run.set_points());
    if (tally.too_far != none) {
        return fault.refuse(
            Status::bad_mesh,
            "point # is ~ outside the coarse mesh; both meshes must cover the same domain",
            point_item(tally.too_far), {}, tally.too_far_by);
    }
    run.copy_joined_points();
    report = {tally.points, tally.outside, tally.max_distance, tally.max_distance_point, 0};
    for (Real const difference : correction) {
        report.wall_correction = max(report.wall_correction, abs(difference));
    }
    fine.header->coordinates = coordinates_fingerprint(points, fine.n_points());
    fine.seal();
    return Status::ok;
}

Status check_alike(Basis const& coarse, Basis const& fine, Fault& fault) noexcept {
    auto const refuse = [&](const char* why) { return fault.refuse(Status::bad_basis, why); };
    Method const &a = coarse.header->method, &b = fine.header->method;
    if (a.operator_kind != b.operator_kind || a.scheme != b.scheme ||
        a.exponent_quarters != b.exponent_quarters || a.offset_correction != b.offset_correction ||
        coarse.kind() != fine.kind()) {
        return refuse("the two bases differ in operator, scheme, weight or kind of values");
    }
    if (coarse.header->counts.control != fine.header->counts.control ||
        !same_bytes(coarse.shape, fine.shape) || !same_bytes(coarse.indices, fine.indices) ||
        !same_bytes(coarse.knots, fine.knots) || !same_bytes(coarse.control, fine.control) ||
        !same_bytes(coarse.weights, fine.weights)) {
        return refuse("the two bases were made with different curves");
    }
    bool same_bodies = coarse.header->counts.bodies == fine.header->counts.bodies;
    for (Condition const& condition : fine.conditions) {
        if (condition.kind == ConditionKind::rigid && !same_centre(coarse, condition))
            same_bodies = false;
    }
    return same_bodies
               ? Status::ok
               : refuse(
                     "the two bases have different rigid bodies, or bodies with different centres");
}

}  // namespace harmorph
