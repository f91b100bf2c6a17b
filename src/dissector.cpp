#include "dissector.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

constexpr Index most_samples = 63;
constexpr Index separator_samples = 48;
enum Side : std::uint8_t { left = 0, right = 1, separator = 2, elsewhere = 3 };

// The element of rank n / 2 (C. A. R. Hoare, Comm. ACM 4 (1961) 321).
float median(float* items, Index n) noexcept {
    Index low = 0, high = n - 1;
    Index const wanted = n / 2;
    while (low < high) {
        float const pivot = items[low + (high - low) / 2];
        Index i = low, j = high;
        while (i <= j) {
            while (items[i] < pivot) ++i;
            while (pivot < items[j]) --j;
            if (i > j) break;
            float const item = items[i];
            items[i++] = items[j];
            items[j--] = item;
        }
        if (wanted <= j) {
            high = j;
        } else if (wanted >= i) {
            low = i;
        } else {
            break;
        }
    }
    return items[wanted];
}

}  // namespace

// What a cut makes of a part.
struct Dissector::Parts {
    Index left = 0, right = 0, separator = 0;

    // A large separator is a large front, and so is what is left to cut in a large part.
    Real cost() const noexcept {
        Real const n = static_cast<Real>(left) + right + separator;
        return separator * (0.5 + larger(left, right) / n);
    }
    // Longer than one through a round part of a mesh?
    bool is_long() const noexcept {
        return 3 * Offset{separator} * separator > 5 * (Offset{left} + right + separator);
    }
};

// Cuts at `level` in all directions at once: left is what lies before it.
struct Dissector::Cuts {
    float level[direction_lanes] = {};
    FourCounts left_size[halves] = {}, left_border[halves] = {}, right_border[halves] = {};  // borders: upper bounds

    void count(Place const& place, Reach const& reach) noexcept {
        for (Index half = 0; half < halves; ++half) {
            Four const distance = four(place.at, half) - four(level, half);
            FourCounts const is_left = distance < 0;  // -1 where true
            left_size[half] -= is_left;
            left_border[half] -= is_left & (distance + four(reach.ahead, half) >= 0);
            right_border[half] -= ~is_left & (distance - four(reach.behind, half) < 0);
        }
    }
    static Index in(const FourCounts* counts, Index direction) noexcept { return counts[direction / 4][direction % 4]; }
};

struct Dissector::Cut {
    Index direction = none;  // none: halve the list as it stands
    float level = 0;
    Side separated = left;   // the side that gives the separator
};

Index Dissector::dissect(Index begin, Index end, AssemblyTree& tree) const noexcept {
    if (begin == end) return none;
    if (end - begin <= leaf_size) return tree.add(begin, end, none, none);
    Division const its = divide(begin, end);
    Index const first = dissect(begin, its.middle, tree);
    Index const second = dissect(its.middle, its.pivots, tree);
    return tree.add(its.pivots, end, first, second);
}

Division Dissector::divide(Index begin, Index end) const noexcept {
    Cut cut = best_cut(begin, end);
    Parts const parts = separate(cut, begin, end);
    if (parts.is_long() && find_level_cut(parts.cost(), begin, end, cut)) separate(cut, begin, end);
    Division its = partition(begin, end);
    if (its.middle - begin < smallest_child) absorb(begin, its);
    if (its.pivots - its.middle < smallest_child) its.pivots = its.middle;
    for (Index k = its.pivots; k < end; ++k) work_.side[order_[k]] = elsewhere;  // neither part will see them again
    sort_along(cut, order_.from(its.pivots, end - its.pivots));
    return its;
}

// Moves a tiny left part behind the right one, into the separator.
void Dissector::absorb(Index begin, Division& division) const noexcept {
    auto& [middle, pivots] = division;
    Index const n = middle - begin;
    for (Index k = begin; k < middle; ++k) work_.moved[k] = order_[k];
    for (Index k = middle; k < pivots; ++k) order_[k - n] = order_[k];
    for (Index k = 0; k < n; ++k) order_[pivots - n + k] = work_.moved[begin + k];
    pivots -= n;
    middle = begin;
}

Dissector::Cut Dissector::best_cut(Index begin, Index end) const noexcept {
    // Of a large part every stride-th unknown tells enough: separators have about the square root of its size.
    Index const part = end - begin;
    Index stride = 1;
    while (Offset{4 * separator_samples * stride} * separator_samples * stride <= part) stride *= 2;
    Index const n = (part + stride - 1) / stride;
    Cuts cuts;
    set_levels(begin, part, cuts);
    for (Index k = begin; k < end; k += stride) cuts.count(work_.where.place[order_[k]], work_.where.reach[order_[k]]);
    Cut best;
    Real least = infinity;
    for (Index direction = 0; direction < directions; ++direction) {
        Index const left_size = Cuts::in(cuts.left_size, direction), right_size = n - left_size;
        Index const left_border = Cuts::in(cuts.left_border, direction);
        Index const right_border = Cuts::in(cuts.right_border, direction);
        if (smaller(left_size, right_size) < n / 4) continue;
        Real const cost = Parts{left_size, right_size, smaller(left_border, right_border)}.cost();
        if (cost >= least) continue;
        least = cost;
        best = {direction, cuts.level[direction], left_border <= right_border ? left : right};
    }
    return best;
}

// The cut behind the level that costs least, if that is less than `least`. Where cells are much stretched or curved,
// straight cuts run slantwise through thousands of them; steps from cell to cell do not see that.
bool Dissector::find_level_cut(Real least, Index begin, Index end, Cut& cut) const noexcept {
    Index const n = end - begin;
    Span<Index> const by_level = work_.where.queue.from(begin, n);
    work_.where.find_levels(graph_, order_.from(begin, n), by_level);
    auto const level = [&](Index k) { return work_.where.place[by_level[k]].at[level_direction]; };
    bool found = false;
    for (Index first = 0, behind = 0; first < n - n / 4; first = behind) {
        while (behind < n && level(behind) == level(first)) ++behind;
        Real const cost = Parts{first, n - behind, behind - first}.cost();
        if (first < n / 4 || n - behind < n / 4 || cost >= least) continue;
        least = cost;
        cut = {level_direction, level(first) + 0.5f, left};
        found = true;
    }
    return found;
}

// Levels at the medians of a few samples.
void Dissector::set_levels(Index begin, Index n, Cuts& cuts) const noexcept {
    Index const count = n < 128 ? most_samples / 4 : n < 1024 ? most_samples / 2 : most_samples;
    float sample[directions][most_samples];
    for (Index k = 0; k < count; ++k) {
        Place const& place = work_.where.place[order_[begin + static_cast<Index>(Offset{k} * n / count)]];
        for (Index direction = 0; direction < directions; ++direction) {
            sample[direction][k] = place.at[direction];
        }
    }
    for (Index direction = 0; direction < directions; ++direction) {
        cuts.level[direction] = median(sample[direction], count);
    }
}

// Sides; then the unknowns of the separated side that have a neighbour on the other become the separator.
Dissector::Parts Dissector::separate(Cut const& cut, Index begin, Index end) const noexcept {
    Side const other = cut.separated == left ? right : left;
    Index n_near = 0, n_left = 0, n_separator = 0;
    Span<Index> const near = work_.moved.from(begin, end - begin);
    for (Index k = begin; k < end; ++k) {
        Index const u = order_[k];
        float const distance = cut.direction == none ? static_cast<float>(k - begin - (end - begin) / 2)
                                                     : work_.where.place[u].at[cut.direction] - cut.level;
        bool const is_left = distance < 0;
        work_.side[u] = is_left ? left : right;
        n_left += is_left ? 1 : 0;
        if (is_left != (cut.separated == left)) continue;
        near[n_near] = u;
        n_near += may_touch(cut, u, distance) ? 1 : 0;
    }
    for (Index const u : near.first(n_near)) {
        for (Index const v : graph_.of(u)) {
            if (work_.side[v] != other) continue;
            work_.side[u] = separator;
            ++n_separator;
            break;
        }
    }
    Index const n_right = end - begin - n_left;
    return cut.separated == left ? Parts{n_left - n_separator, n_right, n_separator}
                                 : Parts{n_left, n_right - n_separator, n_separator};
}

bool Dissector::may_touch(Cut const& cut, Index u, float distance) const noexcept {
    if (cut.direction == none) return true;
    Reach const& reach = work_.where.reach[u];
    return distance < 0 ? distance + reach.ahead[cut.direction] >= 0 : distance - reach.behind[cut.direction] < 0;
}

// Stable, so that memory is still passed through in its own direction.
Division Dissector::partition(Index begin, Index end) const noexcept {
    Span<Index> const moved = work_.moved.from(begin, end - begin), cut_off = work_.where.queue.from(begin, end - begin);
    Index middle = begin, n_right = 0, n_cut_off = 0;
    for (Index k = begin; k < end; ++k) {
        Index const u = order_[k];
        switch (work_.side[u]) {
            case left: order_[middle++] = u; break;
            case right: moved[n_right++] = u; break;
            default: cut_off[n_cut_off++] = u;
        }
    }
    Index const pivots = middle + n_right;
    copy(order_.from(middle, n_right), Span<const Index>(moved.first(n_right)));
    copy(order_.from(pivots, n_cut_off), Span<const Index>(cut_off.first(n_cut_off)));
    return {middle, pivots};
}

// Along a straight cut; round the middle of a cut between layers.
void Dissector::sort_along(Cut const& cut, Span<Index> cut_off) const noexcept {
    if (cut.direction == none) return;
    if (cut.direction != layer_direction) {
        Index const perpendicular = cut.direction ^ 1;  // x and y, the two diagonals; levels are passed by layers
        return sort(cut_off, [&](Index a, Index b) {
            float const p = work_.where.place[a].at[perpendicular], q = work_.where.place[b].at[perpendicular];
            return p != q ? p < q : a < b;
        });
    }
    float x = 0, y = 0;
    float const weight = 1.0f / static_cast<float>(cut_off.size() + 1);
    for (Index const u : cut_off) {
        x += weight * work_.where.place[u].at[0];
        y += weight * work_.where.place[u].at[1];
    }
    auto const angle = [&](Index u) {  // round the unit square instead of the circle: -2 .. 2
        float const dx = work_.where.place[u].at[0] - x, dy = work_.where.place[u].at[1] - y;
        float const size = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
        if (size == 0) return 0.0f;
        return dx >= 0 ? dy / size : dy >= 0 ? 2 - dy / size : -2 - dy / size;
    };
    sort(cut_off, [&](Index a, Index b) {
        float const p = angle(a), q = angle(b);
        return p != q ? p < q : a < b;
    });
}

}  // namespace harmorph
