#include "ordering/bisection.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

// Cuts between levels are tried if the separator of the straight cut is longer, by this factor,
// than a separator through a square. The search for levels passes through the region several times,
// so it must be worth that time. Measured:
// - on 72 meshes of up to 65000 unknowns (bent wakes, C- and O-meshes, hybrid and unstructured
//   ones), with 1.00 instead of 1.12: 0 to 3.5 % fewer multiplications in the factor, and 1.3 to
//   1.9 times as many unknowns searched. With 1.2: 5 % more multiplications in wakes; with 1.5: 31
//   % more; without levels: 67 % more. The multiplications of O-meshes change by 1.3 % at most.
// - on 32 meshes of 140000 to 450000 unknowns, with 1.00 to 1.08 instead of 1.15: 2 % fewer
//   multiplications in wakes, and within 0.3 % elsewhere. With 1.2: 1.6 % more in unstructured
//   meshes; without levels: 11 % more in C-meshes.
constexpr Real long_separator = 1.12, long_large_separator = 1.15;

}  // namespace

Index Dissector::dissect(Index begin, Index end, AssemblyTree& tree) const noexcept {
    if (begin == end) return none;
    if (end - begin <= leaf_size) return tree.add(begin, end, none, none);
    DividedRange const division = divide(begin, end);
    Index const first = dissect(begin, division.middle, tree);
    Index const second = dissect(division.middle, division.pivots, tree);
    return tree.add(division.pivots, end, first, second);
}

DividedRange Dissector::divide(Index begin, Index end) const noexcept {
    Index const n = end - begin;
    Cut cut = search_.best(begin, end, directions);
    DividedRange division = partition(cut, begin, end);
    CutSizes sizes{division.middle - begin, division.pivots - division.middle,
                   end - division.pivots};
    // Cuts between levels are not tried on the whole graph, because a separator of one level in a
    // wake runs along thin cells. If such a separator came last in the order, the pivots in it
    // would be small against their diagonals, and solutions would have to be refined.
    if (n < graph_.n &&
        sizes.is_longer(n < CutSizes::large ? long_separator : long_large_separator)) {
        sizes.left_border = search_.border(begin, division.middle, n);
        sizes.right_border = search_.border(division.middle, division.pivots, n);
        if (search_.find_level_cut(sizes.cost(), begin, end, cut))
            division = partition(cut, begin, end);
    }
    if (division.middle - begin < smallest_child) absorb(begin, division);
    if (division.pivots - division.middle < smallest_child) division.pivots = division.middle;
    close_off(division.pivots, end, n >= CutSizes::large);
    sort_along(cut, division.pivots, end);
    return division;
}

// Takes the separator out of the graph for both sides. Large regions mark the unknowns next to the
// separator.
void Dissector::close_off(Index begin, Index end, bool marks_border) const noexcept {
    Span<Side> const side = work_.cover.side;
    for (Index k = begin; k < end; ++k) side[order_[k]] = Side::elsewhere;
    for (Index k = begin; k < end && marks_border; ++k) {
        for (Index const v : graph_.neighbours(order_[k])) {
            if (side[v] == Side::inside) work_.coordinates.position[v].at[border_lane] = 1;
        }
    }
}

void Dissector::find_across() const noexcept {
    Span<Side> const side = work_.cover.side;
    for (Index u = 0; u < graph_.n; ++u) order_[u] = u;
    Cut const cut = search_.best(0, graph_.n, straight_directions);
    DividedRange const division = partition(cut, 0, graph_.n);
    if (cut.direction == none || division.pivots == graph_.n) return;
    Span<const Index> const separator = order_.from(division.pivots, graph_.n - division.pivots);
    for (Index const u : separator) side[u] = Side::separator;
    work_.coordinates.find_across(
        graph_, separator[0], [&](Index u) { return side[u] == Side::separator; },
        [&](Index u) { return work_.coordinates.position[u].at[cut.direction] >= cut.level; });
    for (Index const u : separator) side[u] = Side::inside;
}

// Moves a tiny left side after the right side, into the separator.
void Dissector::absorb(Index begin, DividedRange& division) const noexcept {
    auto& [middle, pivots] = division;
    Index const n = middle - begin;
    for (Index k = begin; k < middle; ++k) work_.moved[k] = order_[k];
    for (Index k = middle; k < pivots; ++k) order_[k - n] = order_[k];
    for (Index k = 0; k < n; ++k) order_[pivots - n + k] = work_.moved[begin + k];
    pivots -= n;
    middle = begin;
}

// Sorts the region: unknowns left of the cut go to the beginning of the region, unknowns right of
// the cut to `moved`, and unknowns near the cut to `queue`, with `side` set. Returns how many
// unknowns are near the cut.
Index Dissector::set_sides(Cut const& cut, Index begin, Index end, Index& n_left,
                           Index& n_right) const noexcept {
    Span<Index> const region = order_.from(begin, end - begin),
                      moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.coordinates.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    n_left = n_right = 0;
    if (cut.direction == none) {
        for (Index k = 0; k < region.count(); ++k) {
            near[k] = region[k];
            side[region[k]] = 2 * k < region.count() ? Side::left : Side::right;
        }
        return region.count();
    }
    Span<const CutPosition> const position = work_.coordinates.position;
    Index const direction = cut.direction;
    float const level = cut.level;
    // `left` stays in a register. The stores below might change the caller's n_left, as far as the
    // compiler knows.
    Index n_near = 0, left = 0;
    for (Index k = 0; k < region.count(); ++k) {
        if (k + prefetch_ahead < region.count())
            __builtin_prefetch(&position[region[k + prefetch_ahead]]);
        Index const u = region[k];
        float const distance = position[u].at[direction] - level,
                    reach = position[u].reach[direction];
        Index const is_near = max(distance, -distance) <= reach, is_left = distance < 0;
        moved[k - left - n_near] = u;
        region[left] = u;
        near[n_near] = u;
        n_near += is_near;
        left += is_left & ~is_near;
    }
    for (Index const u : near.first(n_near))
        side[u] = position[u].at[direction] < level ? Side::left : Side::right;
    n_left = left;
    n_right = region.count() - left - n_near;
    return n_near;
}

// Divides the region into both sides and the separator. The order is stable except near the cut, so
// that unknowns stay in the order in which they lie in memory.
DividedRange Dissector::partition(Cut const& cut, Index begin, Index end) const noexcept {
    Span<Index> const region = order_.from(begin, end - begin),
                      moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.coordinates.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    Index n_left, n_right, n_separator = 0;
    Index const n_near = set_sides(cut, begin, end, n_left, n_right);
    // The n_near entries of `region` from n_left on are not in use yet: they serve as the queue.
    work_.cover.find(graph_, near.first(n_near), region.from(n_left, n_near));
    for (Index k = 0; k < n_near; ++k) {
        Index const u = near[k];
        Side const side_of_u = side[u];
        side[u] = Side::inside;
        if (side_of_u == Side::left) region[n_left++] = u;
        if (side_of_u == Side::right) moved[n_right++] = u;
        if (side_of_u == Side::separator) near[n_separator++] = u;
    }
    copy(region.from(n_left, n_right), Span<const Index>(moved.first(n_right)));
    copy(region.from(n_left + n_right, n_separator), Span<const Index>(near.first(n_separator)));
    return {begin + n_left, begin + n_left + n_right};
}

// Sorts a separator along a straight cut, or by the angle round the centre of a cut between layers.
void Dissector::sort_along(Cut const& cut, Index begin, Index end) const noexcept {
    if (cut.direction == none) return;
    Span<Index> const cut_off = order_.from(begin, end - begin);
    Span<DissectionWork::Keyed> const keyed = work_.keyed.from(begin, end - begin);
    Span<const CutPosition> const position = work_.coordinates.position;
    if (cut.direction != layer_direction) {
        // Unknowns are sorted by x along a cut in y and by y along a cut in x, likewise along the
        // two diagonals, and by layers along cuts across layers and between levels.
        Index const perpendicular =
            cut.direction < straight_directions ? cut.direction ^ 1 : layer_direction;
        for (Index k = 0; k < keyed.count(); ++k)
            keyed[k] = {position[cut_off[k]].at[perpendicular], cut_off[k]};
    } else {
        float x = 0, y = 0;
        float const weight = 1.0f / static_cast<float>(cut_off.size() + 1);
        for (Index const u : cut_off) {
            x += weight * position[u].at[0];
            y += weight * position[u].at[1];
        }
        // The angle is measured along the square |x| + |y| = 1 instead of the circle; the range is
        // -2 .. 2.
        auto const angle = [&](Index u) {
            float const dx = position[u].at[0] - x, dy = position[u].at[1] - y;
            float const size = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
            if (size == 0) return 0.0f;
            return dx >= 0 ? dy / size : dy >= 0 ? 2 - dy / size : -2 - dy / size;
        };
        for (Index k = 0; k < keyed.count(); ++k) keyed[k] = {angle(cut_off[k]), cut_off[k]};
    }
    sort(keyed, [](DissectionWork::Keyed const& a, DissectionWork::Keyed const& b) {
        return a.key != b.key ? a.key < b.key : a.unknown < b.unknown;
    });
    for (Index k = 0; k < keyed.count(); ++k) cut_off[k] = keyed[k].unknown;
}

}  // namespace harmorph
