#include "ordering/bisection.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

// Levels are tried where the straight cut's separator is longer, by this factor, than one through a
// square. The search for them passes through the part several times, so that it has to be worth it.
// Measured:
// - on 72 meshes of up to 65000 unknowns (bent wakes, C- and O-meshes, hybrid and unstructured
// ones), with 1.00 instead
//   of 1.12: 0 to 3.5 % fewer multiplications in the factor, and 1.3 to 1.9 times as many unknowns
//   searched. With 1.2: 5 % more multiplications in wakes; with 1.5: 31 %; without levels: 67 %.
//   O-meshes change by 1.3 % at most.
// - on 32 of 140000 to 450000, with 1.00 to 1.08 instead of 1.15: 2 % fewer in wakes, within .3 %
// elsewhere. With 1.2:
//   1.6 % more in unstructured ones; without levels: 11 % more in C-meshes.
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
    Parts parts{division.middle - begin, division.pivots - division.middle, end - division.pivots};
    // Not of the whole graph: a separator of one level in a wake runs along thin cells. As the last
    // separator, the pivots there are small against their diagonals, and solutions would have to be
    // refined.
    if (n < graph_.n && parts.is_longer(n < Parts::large ? long_separator : long_large_separator)) {
        parts.left_border = search_.border(begin, division.middle, n);
        parts.right_border = search_.border(division.middle, division.pivots, n);
        if (search_.find_level_cut(parts.cost(), begin, end, cut))
            division = partition(cut, begin, end);
    }
    if (division.middle - begin < smallest_child) absorb(begin, division);
    if (division.pivots - division.middle < smallest_child) division.pivots = division.middle;
    close_off(division.pivots, end, n >= Parts::large);
    sort_along(cut, division.pivots, end);
    return division;
}

// Takes the separator out of the graph for both parts. Large parts mark the unknowns next to the
// separator.
void Dissector::close_off(Index begin, Index end, bool marks_border) const noexcept {
    Span<Side> const side = work_.cover.side;
    for (Index k = begin; k < end; ++k) side[order_[k]] = Side::elsewhere;
    for (Index k = begin; k < end && marks_border; ++k) {
        for (Index const v : graph_.of(order_[k])) {
            if (side[v] == Side::inside) work_.coordinates.of[v].at[border_lane] = 1;
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
        [&](Index u) { return work_.coordinates.of[u].at[cut.direction] >= cut.level; });
    for (Index const u : separator) side[u] = Side::inside;
}

// Moves a tiny left part behind the right one, into the separator.
void Dissector::absorb(Index begin, DividedRange& division) const noexcept {
    auto& [middle, pivots] = division;
    Index const n = middle - begin;
    for (Index k = begin; k < middle; ++k) work_.moved[k] = order_[k];
    for (Index k = middle; k < pivots; ++k) order_[k - n] = order_[k];
    for (Index k = 0; k < n; ++k) order_[pivots - n + k] = work_.moved[begin + k];
    pivots -= n;
    middle = begin;
}

// Sorts the part: unknowns left of the cut go to the beginning of the part, unknowns right of the
// cut to `moved`, and those near the cut to `queue`, with `side` set. Returns how many are near.
Index Dissector::set_sides(Cut const& cut, Index begin, Index end, Index& n_left,
                           Index& n_right) const noexcept {
    Span<Index> const part = order_.from(begin, end - begin),
                      moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.coordinates.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    n_left = n_right = 0;
    if (cut.direction == none) {
        for (Index k = 0; k < part.count(); ++k) {
            near[k] = part[k];
            side[part[k]] = 2 * k < part.count() ? Side::left : Side::right;
        }
        return part.count();
    }
    Span<const CutPosition> const position = work_.coordinates.of;
    Index const direction = cut.direction;
    float const level = cut.level;
    Index n_near = 0,
          left = 0;  // in a register: what is written below could change the caller's count
    for (Index k = 0; k < part.count(); ++k) {
        if (k + prefetch_ahead < part.count())
            __builtin_prefetch(&position[part[k + prefetch_ahead]]);
        Index const u = part[k];
        float const distance = position[u].at[direction] - level,
                    reach = position[u].reach[direction];
        Index const is_near = max(distance, -distance) <= reach, is_left = distance < 0;
        moved[k - left - n_near] = u;
        part[left] = u;
        near[n_near] = u;
        n_near += is_near;
        left += is_left & ~is_near;
    }
    for (Index const u : near.first(n_near))
        side[u] = position[u].at[direction] < level ? Side::left : Side::right;
    n_left = left;
    n_right = part.count() - left - n_near;
    return n_near;
}

// Stable except near the cut, so that unknowns stay in the order in which they lie in memory.
DividedRange Dissector::partition(Cut const& cut, Index begin, Index end) const noexcept {
    Span<Index> const part = order_.from(begin, end - begin),
                      moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.coordinates.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    Index n_left, n_right, n_separator = 0;
    Index const n_near = set_sides(cut, begin, end, n_left, n_right);
    // The n_near entries of `part` behind n_left are not in use yet: they serve as the queue.
    work_.cover.find(graph_, near.first(n_near), part.from(n_left, n_near));
    for (Index k = 0; k < n_near; ++k) {
        Index const u = near[k];
        Side const side_of_u = side[u];
        side[u] = Side::inside;
        if (side_of_u == Side::left) part[n_left++] = u;
        if (side_of_u == Side::right) moved[n_right++] = u;
        if (side_of_u == Side::separator) near[n_separator++] = u;
    }
    copy(part.from(n_left, n_right), Span<const Index>(moved.first(n_right)));
    copy(part.from(n_left + n_right, n_separator), Span<const Index>(near.first(n_separator)));
    return {begin + n_left, begin + n_left + n_right};
}

// Along a straight cut; round the middle of a cut between layers.
void Dissector::sort_along(Cut const& cut, Index begin, Index end) const noexcept {
    if (cut.direction == none) return;
    Span<Index> const cut_off = order_.from(begin, end - begin);
    Span<DissectionWork::Keyed> const keyed = work_.keyed.from(begin, end - begin);
    Span<const CutPosition> const position = work_.coordinates.of;
    if (cut.direction != layer_direction) {
        // x along a cut in y and the reverse; the same for the two diagonals; layers along steps
        // and levels
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
        auto const angle = [&](Index u) {  // measured along the square |x| + |y| = 1 instead of the
                                           // circle: -2 .. 2
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
