#include "boundary/periodic.hpp"

#include "base/vec2.hpp"

namespace harmorph {
namespace {

constexpr Real parallel_below = 1e-6;  // the sine of the angle between two slip lines
// The largest misfit as a fraction of the boundary's extent; files with few digits have this
// precision.
constexpr Real mapped_within = 1e-6;
constexpr Real smallest_rotation = 1e-6;  // the smallest angle of a rotation, in radians

// Maps the points of one side to the points of the other side.
struct SideMap {
    Vec2 centre, rotation{1, 0}, shift;
    Vec2 image(Vec2 at) const noexcept { return centre + product(rotation, at - centre) + shift; }
};

class Pair {
public:
    Pair(Topology& topology, Boundary const& boundary, Span<Index> chain, Span<PointKind> kinds,
         Span<Vec2> tangent, Periodicity& periodicity) noexcept
        : mesh_(topology.mesh),
          boundary_(boundary),
          chain_(chain),
          tied_(topology.representative),
          kinds_(kinds),
          tangent_(tangent),
          periodicity_(periodicity) {}

    Status run(Condition const& condition, Fault& fault) noexcept {
        n_ = collect(condition.marker, 0);
        Index const n_partner = n_ > 0 ? collect(condition.partner, n_) : 0;
        if (n_ == 0 || n_partner == 0) {
            return fault.refuse(
                Status::bad_condition,
                "the faces of periodic marker # must form one connected line that is "
                "not closed",
                marker_item(n_ == 0 ? condition.marker : condition.partner));
        }
        if (n_ != n_partner) {
            return fault.refuse(
                Status::bad_condition,
                "the periodic markers # and @ do not have the same number of points",
                marker_item(condition.marker), marker_item(condition.partner));
        }
        Index times = 0;
        if (condition.kind == ConditionKind::rotation) {
            HARMORPH_TRY(take_rotation(condition, times, fault));
        } else {
            HARMORPH_TRY(take_translation(condition, fault));
        }
        for (Index k = 0; k < n_; ++k) HARMORPH_TRY(tie(image_of(k), chain_[k], times, fault));
        return Status::ok;
    }

    // Replaces representatives by their own representatives, after all pairs are tied.
    void complete() const noexcept {
        for (Index k = 0; k < tied_.count(); ++k) {
            while (tied_[k] != tied_[tied_[k]]) {
                if (!periodicity_.times.empty())
                    periodicity_.times[k] += periodicity_.times[tied_[k]];
                tied_[k] = tied_[tied_[k]];
            }
        }
    }
    // Changes the rotations of unknowns so that points of this marker are not rotated. The strong
    // couplings of thin cells along a side then are between points with equal rotations.
    void keep_unrotated(Index marker) noexcept {
        Span<Index> const times = periodicity_.times;
        Index const n = collect(marker, 0);
        for (Index const point : chain_.first(n)) {
            if (tied_[point] != point && times[tied_[point]] == 0)
                times[tied_[point]] = -times[point];
        }
    }
    void rotate_tied() const noexcept {
        Span<Index> const times = periodicity_.times;
        for (Index k = 0; k < times.count(); ++k) {
            if (tied_[k] != k) times[k] += times[tied_[k]];
        }
    }

private:
    Vec2 position(Index point) const noexcept { return mesh_.points[point]; }
    // Both sides have the mesh on their left, and therefore run in opposite directions.
    Index image_of(Index k) const noexcept { return chain_[2 * n_ - 1 - k]; }

    Status take_translation(Condition const& condition, Fault& fault) noexcept {
        SideMap map;
        for (Index k = 0; k < n_; ++k) {
            map.shift = map.shift + (1.0 / n_) * (position(image_of(k)) - position(chain_[k]));
        }
        HARMORPH_TRY(check_images(map,
                                  "points # and @ of a periodic pair do not match: the translated "
                                  "point is ~ away from its "
                                  "partner",
                                  fault));
        if (periodicity_.translations.add(chain_[0], image_of(0), mesh_.points)) return Status::ok;
        return fault.refuse(
            Status::bad_condition,
            "periodic marker # needs another translation, but periodic pairs can have "
            "at most @ different translations",
            marker_item(condition.marker), plain(Translations::max_count));
    }

    // Finds the angle of the rotation by least squares.
    Status take_rotation(Condition const& condition, Index& times, Fault& fault) noexcept {
        SideMap map;
        map.centre = condition.centre;
        Real radius = 0;
        for (Index k = 0; k < n_; ++k)
            radius = max(radius, length(position(chain_[k]) - map.centre));
        // Without this scale, products of tiny coordinates would underflow.
        Real const scale = radius > 0 ? 1 / radius : 0;
        auto const from_centre = [&](Index point) {
            return scale * (position(point) - map.centre);
        };
        Vec2 sum;
        for (Index k = 0; k < n_; ++k)
            sum = sum + product(conjugate(from_centre(chain_[k])), from_centre(image_of(k)));
        map.rotation = direction(sum);
        HARMORPH_TRY(check_images(
            map,
            "points # and @ of a rotation pair do not match: the rotated point is ~ away from its "
            "partner",
            fault));
        if (length(map.rotation - Vec2{1, 0}) < smallest_rotation) {
            return fault.refuse(Status::bad_condition,
                                "the sides of the rotation pair of marker # are not rotated; use "
                                "HM_PERIODIC_PAIR for a translation",
                                marker_item(condition.marker));
        }
        Rotation& rotation = periodicity_.rotation;
        if (!rotation.any) rotation = {true, map.centre, map.rotation};
        times = rotation.times_of(map.centre, map.rotation);
        if (times != 0) return Status::ok;
        return fault.refuse(
            Status::bad_condition,
            "the rotation pair of marker # has another centre or angle than another "
            "rotation pair",
            marker_item(condition.marker));
    }

    Status check_images(SideMap const& map, const char* sentence, Fault& fault) const noexcept {
        Box box;
        Real worst = 0, distance = 0;
        Index worst_at = 0;
        for (Index k = 0; k < n_; ++k) {
            Vec2 const at = position(chain_[k]), image = position(image_of(k));
            box.include(at);
            distance = max(distance, length(image - at));
            Real const misfit = length(image - map.image(at));
            if (misfit > worst) {
                worst = misfit;
                worst_at = k;
            }
        }
        if (worst <= mapped_within * (length(box.size()) + distance)) return Status::ok;
        return fault.refuse(Status::bad_condition, sentence, point_item(chain_[worst_at]),
                            point_item(image_of(worst_at)), worst);
    }

    // Writes the points of the marker in order to chain_, from position `begin` on, and returns
    // their number; returns 0 unless the faces of the marker form one open chain.
    Index collect(Index marker, Index begin) noexcept {
        Index n = 0;
        bool closed = false;
        auto const visit = [&](Index, Index point) { chain_[begin + n++] = point; };
        auto const is_face = [&](Index face) { return boundary_.marker[face] == marker; };
        auto const end_chain = [&](Index, bool is_loop) { closed = closed || is_loop; };
        Index const chains = boundary_.for_each_chain(is_face, visit, end_chain);
        return chains == 1 && !closed ? n : 0;
    }

    // The root is the point that stands for a point; `times` is the number of rotations from the
    // root to the point.
    struct Root {
        Index point, times;
    };
    Root root(Index point) const noexcept {
        Root out{point, 0};
        while (tied_[out.point] != out.point) {
            if (!periodicity_.times.empty()) out.times += periodicity_.times[out.point];
            out.point = tied_[out.point];
        }
        return out;
    }

    // Ties the image to the point; `times` is the number of rotations from the point to the image.
    // If two pairs meet in a corner, one point may have images in both pairs.
    Status tie(Index image, Index point, Index times, Fault& fault) noexcept {
        Root const a = root(point), b = root(image);
        times += a.times - b.times;  // from a to b
        bool const is_same = a.point == b.point;
        if (is_same && times == 0) return Status::ok;
        PointKind const kind =
            kinds_[a.point] < kinds_[b.point] ? kinds_[a.point] : kinds_[b.point];
        if (kind == PointKind::on_wall) {
            return fault.refuse(Status::bad_condition,
                                "point # is on a periodic boundary and on a moving wall",
                                point_item(kinds_[a.point] == kind ? a.point : b.point));
        }
        // The point is the centre: only the displacement 0 is not changed by the rotation.
        if (is_same) {
            kinds_[a.point] = PointKind::fixed;
            return Status::ok;
        }
        Index const low = min(a.point, b.point), high = max(a.point, b.point);
        if (kind == PointKind::slip) {
            bool const both = kinds_[a.point] == kinds_[b.point];
            bool const crossing =
                both && abs(cross(tangent_[a.point], tangent_[b.point])) > parallel_below;
            tangent_[low] = tangent_[kinds_[a.point] == kind ? a.point : b.point];
            kinds_[low] = crossing ? PointKind::fixed : kind;
        } else {
            kinds_[low] = kind;
        }
        tied_[high] = low;
        kinds_[high] = PointKind::unused;
        if (!periodicity_.times.empty())
            periodicity_.times[high] = high == b.point ? times : -times;
        return Status::ok;
    }

    Mesh const& mesh_;
    Boundary const& boundary_;
    Span<Index> chain_, tied_;
    Span<PointKind> kinds_;
    Span<Vec2> tangent_;
    Periodicity& periodicity_;
    Index n_ = 0;  // the number of points of each side
};

}  // namespace

Status tie_periodic(Topology& topology, Boundary const& boundary, Span<const Condition> conditions,
                    Span<Index> chain, Span<PointKind> kinds, Span<Vec2> tangent,
                    Periodicity& periodicity, Fault& fault) noexcept {
    periodicity.translations = Translations{};
    periodicity.rotation = Rotation{};
    fill(periodicity.times, Index{0});
    Pair pair(topology, boundary, chain, kinds, tangent, periodicity);
    for (Condition const& condition : conditions) {
        if (condition.is_pair()) HARMORPH_TRY(pair.run(condition, fault));
    }
    pair.complete();
    for (Condition const& condition : conditions) {
        if (condition.kind == ConditionKind::rotation) pair.keep_unrotated(condition.marker);
    }
    pair.rotate_tied();
    return Status::ok;
}

}  // namespace harmorph
