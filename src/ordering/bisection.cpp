#include "ordering/bisection.hpp"

#include "base/scalar.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index few_samples = 27, max_samples = 81;  // Both are powers of 3.

Four lanes_min(Four a, Four b) noexcept { return a < b ? a : b; }
Four lanes_max(Four a, Four b) noexcept { return a < b ? b : a; }
Four lanes_median(Four a, Four b, Four c) noexcept {
    return lanes_max(lanes_min(a, b), lanes_min(lanes_max(a, b), c));
}

// Estimates the multiplications for a region of n unknowns with a border of b, if separators of s =
// n^1/2 pivots halve the region again and again, and each half has half the border and the
// separator:
//   C(n, b) = s (s^2 / 3 + s b + b^2) + 2 C(n / 2, b / 2 + s)
// is solved by C = s (u s^2 + v s b + w b^2), and comparing coefficients, with r = 2^1/2, gives
//   w = 1 + r w / 4,   v = 1 + v / 2 + r w,   u = 1 / 3 + u / r + v + r w:
//   w = 1.547, v = 6.375, u = 30.37.
constexpr Real weight_of_unknowns = 30, weight_of_both = 6.4, weight_of_border = 1.55;

Real cost_to_cut(Real n, Real b) noexcept {
    Real const s = sqrt(n);
    return s * (weight_of_unknowns * n + weight_of_both * s * b + weight_of_border * b * b);
}

// Returns the stride of samples of large regions. Separators have about as many unknowns as the
// square root of those of the region, and a sample with this stride contains about twice
// separator_samples unknowns of a separator.
Index stride_of(Index region, Real separator_samples) noexcept {
    return max(Index{1}, static_cast<Index>(sqrt(region) / (2 * separator_samples)));
}

// Returns a pseudo-random number below `end` (the final mixing of A. Appleby's MurmurHash3).
Index pseudo_random(Index from, Index end) noexcept {
    std::uint32_t bits = static_cast<std::uint32_t>(from);
    bits = (bits ^ bits >> 16) * 0x85ebca6bu;
    bits = (bits ^ bits >> 13) * 0xc2b2ae35u;
    return static_cast<Index>((bits ^ bits >> 16) % static_cast<std::uint32_t>(end));
}

}  // namespace

// The cost of large regions is twice the number of multiplications. Small regions have small fronts
// for any cut; their cost is the length of the separator, increased for uneven cuts.
Real CutSizes::cost() const noexcept {
    Real const n = size(), s = separator, b = Real{1} * left_border + right_border;
    if (n < large) return s * (0.5 + max(left, right) / n);
    return s * (s * s / 3 + s * b + b * b) + cost_to_cut(left, left_border + s) +
           cost_to_cut(right, right_border + s);
}

// Counts for cuts at `level` in all directions at once. `left` counts the unknowns with a
// coordinate below the level.
struct CutSearch::Counts {
    Four level[halves];
    Index n = 0, border = 0;
    // `near` counts the unknowns that may have a neighbour on the other side.
    FourCounts left[halves] = {}, near[halves] = {};
    FourCounts near_left[halves] = {}, left_border[halves] = {};

    template <bool is_large>
    void add(CutPosition const& position) noexcept {
        FourCounts const in_border =
            FourCounts{} + (is_large ? static_cast<Index>(position.at[border_lane]) : 0);
        for (Index half = 0; half < halves; ++half) {
            Four const distance = four(position.at, half) - level[half],
                       reach = four(position.reach, half);
            FourCounts const is_left = distance < 0,
                             is_near = (distance <= reach) & (-distance <= reach);
            left[half] -= is_left;  // Comparisons of vectors return -1 for true.
            near[half] -= is_near;
            if (is_large) {
                near_left[half] -= is_near & is_left;
                left_border[half] += is_left & in_border;
            }
        }
        if (is_large) border += in_border[0];
        ++n;
    }
    // Returns the sizes for the whole region if some or all of its unknowns are counted.
    template <bool is_large>
    CutSizes sizes(Index direction, Index region) const noexcept {
        auto const counted = [&](const FourCounts* counts) {
            return counts[direction / 4][direction % 4];
        };
        // The near unknowns of either side are a cover, so the smallest cover is not larger than
        // the smaller of both.
        Index const cover =
            is_large ? min(counted(near_left), counted(near) - counted(near_left)) : counted(near);
        Real const times = static_cast<Real>(region) / n;
        auto const scaled = [&](Index count) { return static_cast<Index>(times * count); };
        return {scaled(counted(left)), scaled(n - counted(left)), scaled(cover),
                scaled(counted(left_border)), scaled(border - counted(left_border))};
    }
};

Cut CutSearch::best(Index begin, Index end, Index n_directions) const noexcept {
    bool const is_large = end - begin >= CutSizes::large;
    return is_large ? best_of<true>(begin, end, n_directions)
                    : best_of<false>(begin, end, n_directions);
}

template <bool is_large>
Cut CutSearch::best_of(Index begin, Index end, Index n_directions) const noexcept {
    float medians[direction_lanes];
    set_medians(begin, end - begin, medians);
    Counts counts;
    for (Index half = 0; half < halves; ++half) counts.level[half] = four(medians, half);
    Index const stride = stride_of(end - begin, is_large ? 96 : 48);
    if (stride == 1) {
        for (Index k = begin; k < end; ++k) counts.add<is_large>(coordinates_.position[order_[k]]);
    }
    for (Index k = begin; k < end && stride > 1; k += stride) {
        if (k + prefetch_ahead * stride < end) {
            __builtin_prefetch(&coordinates_.position[order_[k + prefetch_ahead * stride]]);
        }
        counts.add<is_large>(coordinates_.position[order_[k]]);
        // The stride varies, because the rows of a mesh may be as long as any number of steps.
        if (counts.n % 32 == 0) k += pseudo_random(k, stride);
    }
    Cut best;
    Real min_cost = infinity;
    for (Index direction = 0; direction < n_directions; ++direction) {
        CutSizes const sizes = counts.sizes<is_large>(direction, end - begin);
        if (min(sizes.left, sizes.right) < (end - begin) / 4) continue;
        Real const cost = sizes.cost();
        if (cost >= min_cost) continue;
        min_cost = cost;
        best = {direction, medians[direction]};
    }
    return best;
}

Index CutSearch::border(Index begin, Index end, Index size) const noexcept {
    Index n = 0;
    for (Index k = begin; k < end && size >= CutSizes::large; ++k) {
        n += static_cast<Index>(coordinates_.position[order_[k]].at[border_lane]);
    }
    return n;
}

bool CutSearch::find_level_cut(Real max_cost, Index begin, Index end, Cut& cut) const noexcept {
    Index const n = end - begin, whole_border = border(begin, end, n);
    Span<Index> const by_level = coordinates_.queue.from(begin, n);
    coordinates_.find_levels(graph_, order_.from(begin, n), by_level);
    auto const at = [&](Index k, Index lane) {
        return coordinates_.position[by_level[k]].at[lane];
    };
    bool found = false;
    for (Index first = 0, behind = 0, passed = 0; first < n - n / 4; first = behind) {
        Index const before = passed;
        for (; behind < n && at(behind, level_direction) == at(first, level_direction); ++behind) {
            passed += static_cast<Index>(at(behind, border_lane));
        }
        if (first < n / 4 || n - behind < n / 4) continue;
        Real const cost =
            CutSizes{first, n - behind, behind - first, before, whole_border - passed}.cost();
        if (cost >= max_cost) continue;
        max_cost = cost;
        cut = {level_direction, at(first, level_direction) + 0.5f};
        found = true;
    }
    return found;
}

// The levels are close to the medians: they are medians of three medians of three, and so on (P. J.
// Rousseeuw, G. W. Bassett, J. Am. Stat. Assoc. 85 (1990) 97), of samples.
void CutSearch::set_medians(Index begin, Index n, float* level) const noexcept {
    Index count = n < 1024 ? few_samples : max_samples;
    Four sample[max_samples][halves];
    for (Index k = 0; k < count; ++k) {
        CutPosition const& position =
            coordinates_.position[order_[begin + static_cast<Index>(Offset{k} * n / count)]];
        for (Index half = 0; half < halves; ++half) sample[k][half] = four(position.at, half);
    }
    while (count > 1) {
        count /= 3;
        for (Index k = 0; k < count; ++k) {
            for (Index half = 0; half < halves; ++half) {
                sample[k][half] = lanes_median(sample[k][half], sample[k + count][half],
                                               sample[k + 2 * count][half]);
            }
        }
    }
    for (Index half = 0; half < halves; ++half) set_four(level, half, sample[0][half]);
    level[layer_direction] -= 0.5f;  // These levels lie between two whole numbers.
    level[across_direction] -= 0.5f;
}

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
