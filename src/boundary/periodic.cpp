#include "harmorph/boundary/periodic.hpp"

namespace harmorph {
namespace {

constexpr Real parallel_below = 1e-6;      // sine of the angle between two slip lines
constexpr Real translated_within = 1e-6;  // of the boundary's extent: what files with few digits keep

class Pair {
public:
    Pair(Topology& topology, Boundary const& boundary, Span<Index> chain, Span<PointKind> kinds,
         Span<Vec2> tangent) noexcept
        : mesh_(topology.mesh), boundary_(boundary), chain_(chain), tied_(topology.representative), kinds_(kinds), tangent_(tangent) {}

    Status run(Condition const& condition, Translations& translations, Fault& fault) noexcept {
        Index const n = collect(condition.marker, 0);
        Index const n_partner = n > 0 ? collect(condition.partner, n) : 0;
        if (n == 0 || n_partner == 0) {
            return fault.refuse(Status::bad_condition, "periodic marker # is not one open piece of the boundary",
                                Counts::from_zero, n == 0 ? condition.marker : condition.partner);
        }
        if (n != n_partner) {
            return fault.refuse(Status::bad_condition,
                                "the periodic markers # and @ do not have the same number of points",
                                Counts::from_zero, condition.marker, condition.partner);
        }
        // Both run with the mesh on their left, and so in opposite directions.
        auto const image_of = [&](Index k) { return chain_[2 * n - 1 - k]; };
        Vec2 shift, low = position(chain_[0]), high = low;
        for (Index k = 0; k < n; ++k) {
            Vec2 const at = position(chain_[k]);
            low = {smaller(low.x, at.x), smaller(low.y, at.y)};
            high = {larger(high.x, at.x), larger(high.y, at.y)};
            shift = shift + (1.0 / n) * (position(image_of(k)) - at);
        }
        Real worst = 0;
        Index worst_at = 0;
        for (Index k = 0; k < n; ++k) {
            Real const misfit = length(position(image_of(k)) - position(chain_[k]) - shift);
            if (misfit > worst) {
                worst = misfit;
                worst_at = k;
            }
        }
        if (!(worst <= translated_within * (length(high - low) + length(shift)))) {
            return fault.refuse(Status::bad_condition, "points # and @ of a periodic pair are no translates: off by ~",
                                Counts::mesh, chain_[worst_at], image_of(worst_at), worst);
        }
        if (!translations.add(chain_[0], image_of(0), mesh_.points)) {
            return fault.refuse(Status::bad_condition, "periodic marker #: there are already @ other translations",
                                Counts::from_zero, condition.marker, Translations::most);
        }
        for (Index k = 0; k < n; ++k) HARMORPH_TRY(tie(image_of(k), chain_[k], fault));
        return Status::ok;
    }

private:
    Vec2 position(Index point) const noexcept { return mesh_.points[point]; }

    // The marker's points in order from place `begin` of the chain on; 0 unless they are one open piece.
    Index collect(Index marker, Index begin) noexcept {
        Index n = 0;
        bool closed = false;
        auto const visit = [&](Index, Index point) { chain_[begin + n++] = point; };
        Index const pieces = boundary_.for_each_piece([&](Index face) { return boundary_.marker[face] == marker; },
                                                      visit,
                                                      [&](Index, bool is_loop) { closed = closed || is_loop; });
        return pieces == 1 && !closed ? n : 0;
    }

    Index root(Index point) const noexcept {
        while (tied_[point] != point) point = tied_[point];
        return point;
    }

    // Of two pairs that meet in a corner, one point may have images in both.
    Status tie(Index image, Index point, Fault& fault) noexcept {
        Index const a = root(point), b = root(image);
        if (a == b) return Status::ok;
        PointKind const kind = kinds_[a] < kinds_[b] ? kinds_[a] : kinds_[b];
        if (kind == PointKind::on_wall) {
            return fault.refuse(Status::bad_condition, "point # is on a periodic boundary and on a wall that moves",
                                Counts::mesh, kinds_[a] == kind ? a : b);
        }
        Index const low = smaller(a, b), high = larger(a, b);
        if (kind == PointKind::slip) {
            bool const both = kinds_[a] == kinds_[b];
            bool const crossing = both && absolute(cross(tangent_[a], tangent_[b])) > parallel_below;
            tangent_[low] = tangent_[kinds_[a] == kind ? a : b];
            kinds_[low] = crossing ? PointKind::fixed : kind;
        } else {
            kinds_[low] = kind;
        }
        tied_[high] = low;
        kinds_[high] = PointKind::unused;
        return Status::ok;
    }

    Mesh const& mesh_;
    Boundary const& boundary_;
    Span<Index> chain_, tied_;
    Span<PointKind> kinds_;
    Span<Vec2> tangent_;
};

}  // namespace

Status tie_periodic(Topology& topology, Boundary const& boundary, Span<const Condition> conditions, Span<Index> chain,
                    Span<PointKind> kinds, Span<Vec2> tangent, Translations& translations, Fault& fault) noexcept {
    Span<Index> const representative = topology.representative;
    translations = Translations{};
    Pair pair(topology, boundary, chain, kinds, tangent);
    for (Condition const& condition : conditions) {
        if (condition.kind == ConditionKind::periodic) HARMORPH_TRY(pair.run(condition, translations, fault));
    }
    for (Index k = 0; k < representative.count(); ++k) {
        while (representative[k] != representative[representative[k]]) representative[k] = representative[representative[k]];
    }
    return Status::ok;
}

}  // namespace harmorph
