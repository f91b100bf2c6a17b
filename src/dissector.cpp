#include "dissector.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

constexpr Index few_samples = 27, most_samples = 81;  // powers of 3
constexpr Index separator_samples = 48;

Four least_of(Four a, Four b) noexcept { return a < b ? a : b; }
Four most_of(Four a, Four b) noexcept { return a < b ? b : a; }
Four middle_of(Four a, Four b, Four c) noexcept { return most_of(least_of(a, b), least_of(most_of(a, b), c)); }

}  // namespace

// What a cut makes of a part.
struct Dissector::Parts {
    Index left = 0, right = 0, separator = 0;

    static Parts of(Division const& its, Index begin, Index end) noexcept {
        return {its.middle - begin, its.pivots - its.middle, end - its.pivots};
    }
    // A large separator is a large front, and so is what is left to cut in a large part.
    Real cost() const noexcept {
        Real const n = static_cast<Real>(left) + right + separator;
        return separator * (0.5 + larger(left, right) / n);
    }
    // Longer than one through a round part of a mesh?
    bool is_long() const noexcept {
        return 4 * Offset{separator} * separator > 5 * (Offset{left} + right + separator);
    }
};

// Cuts at `level` in all directions at once: left is what lies before it.
struct Dissector::Cuts {
    float level[direction_lanes] = {};
    FourCounts left[halves] = {}, near[halves] = {};  // near: what may have a neighbour across

    void count(Place const& place) noexcept {
        for (Index half = 0; half < halves; ++half) {
            Four const distance = four(place.at, half) - four(level, half), reach = four(place.reach, half);
            left[half] -= distance < 0;  // -1 where true
            near[half] -= (distance <= reach) & (-distance <= reach);
        }
    }
    static Index in(const FourCounts* counts, Index direction) noexcept { return counts[direction / 4][direction % 4]; }
};

struct Dissector::Cut {
    Index direction = none;  // none: halve the list as it stands
    float level = 0;
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
    Cut cut = best_cut(begin, end, directions);
    Division its = partition(cut, begin, end);
    Parts const parts = Parts::of(its, begin, end);
    bool const is_whole = end - begin == graph_.n;  // its steps across are levels already
    if (!is_whole && parts.is_long() && find_level_cut(parts.cost(), begin, end, cut)) its = partition(cut, begin, end);
    if (its.middle - begin < smallest_child) absorb(begin, its);
    if (its.pivots - its.middle < smallest_child) its.pivots = its.middle;
    // Neither part will see them.
    for (Index k = its.pivots; k < end; ++k) work_.cover.side[order_[k]] = Side::elsewhere;
    sort_along(cut, its.pivots, end);
    return its;
}

void Dissector::find_across() const noexcept {
    Span<Side> const side = work_.cover.side;
    for (Index u = 0; u < graph_.n; ++u) order_[u] = u;
    Cut const cut = best_cut(0, graph_.n, straight_directions);
    Division const its = partition(cut, 0, graph_.n);
    if (cut.direction == none || its.pivots == graph_.n) return;
    Span<const Index> const separator = order_.from(its.pivots, graph_.n - its.pivots);
    for (Index const u : separator) side[u] = Side::separator;
    work_.where.find_across(
        graph_, separator[0], [&](Index u) { return side[u] == Side::separator; },
        [&](Index u) { return work_.where.place[u].at[cut.direction] >= cut.level; });
    for (Index const u : separator) side[u] = Side::inside;
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

Dissector::Cut Dissector::best_cut(Index begin, Index end, Index n_directions) const noexcept {
    // Of a large part every stride-th unknown tells enough: separators have about the square root of its size.
    Index const part = end - begin;
    Index stride = 1;
    while (Offset{4 * separator_samples * stride} * separator_samples * stride <= part) stride *= 2;
    Index const n = (part + stride - 1) / stride;
    Cuts cuts;
    set_levels(begin, part, cuts);
    for (Index k = begin; k < end; k += stride) cuts.count(work_.where.place[order_[k]]);
    Cut best;
    Real least = infinity;
    for (Index direction = 0; direction < n_directions; ++direction) {
        Index const its_left = Cuts::in(cuts.left, direction), its_right = n - its_left;
        if (smaller(its_left, its_right) < n / 4) continue;
        Real const cost = Parts{its_left, its_right, Cuts::in(cuts.near, direction)}.cost();
        if (cost >= least) continue;
        least = cost;
        best = {direction, cuts.level[direction]};
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
        cut = {level_direction, level(first) + 0.5f};
        found = true;
    }
    return found;
}

// Levels close to the medians: medians of three medians of three, and so on (P. J. Rousseeuw, G. W. Bassett, J. Am. Stat.
// Assoc. 85 (1990) 97), of samples.
void Dissector::set_levels(Index begin, Index n, Cuts& cuts) const noexcept {
    Index count = n < 1024 ? few_samples : most_samples;
    Four sample[most_samples][halves];
    for (Index k = 0; k < count; ++k) {
        Place const& place = work_.where.place[order_[begin + static_cast<Index>(Offset{k} * n / count)]];
        for (Index half = 0; half < halves; ++half) sample[k][half] = four(place.at, half);
    }
    while (count > 1) {
        count /= 3;
        for (Index k = 0; k < count; ++k) {
            for (Index half = 0; half < halves; ++half) {
                sample[k][half] = middle_of(sample[k][half], sample[k + count][half], sample[k + 2 * count][half]);
            }
        }
    }
    for (Index half = 0; half < halves; ++half) set_four(cuts.level, half, sample[0][half]);
    cuts.level[layer_direction] -= 0.5f;  // between two
    cuts.level[across_direction] -= 0.5f;
}

// Sorts the part: what is left of the cut to its beginning, what is right to `moved`, and what is near the cut to `queue`,
// with its side set. Returns how many are near.
Index Dissector::set_sides(Cut const& cut, Index begin, Index end, Index& n_left, Index& n_right) const noexcept {
    Span<Index> const part = order_.from(begin, end - begin), moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.where.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    n_left = n_right = 0;
    if (cut.direction == none) {
        for (Index k = 0; k < part.count(); ++k) {
            near[k] = part[k];
            side[part[k]] = 2 * k < part.count() ? Side::left : Side::right;
        }
        return part.count();
    }
    Span<const Place> const place = work_.where.place;
    Index n_near = 0;
    for (Index const u : part) {
        float const distance = place[u].at[cut.direction] - cut.level, reach = place[u].reach[cut.direction];
        Index const is_near = (distance <= reach) & (-distance <= reach), is_left = distance < 0;
        part[n_left] = u;
        moved[n_right] = u;
        near[n_near] = u;
        n_near += is_near;
        n_left += is_left & ~is_near;
        n_right += ~is_left & ~is_near & 1;
    }
    for (Index const u : near.first(n_near)) side[u] = place[u].at[cut.direction] < cut.level ? Side::left : Side::right;
    return n_near;
}

// Stable but for what is near the cut, so that memory is still passed through in its own direction.
Division Dissector::partition(Cut const& cut, Index begin, Index end) const noexcept {
    Span<Index> const part = order_.from(begin, end - begin), moved = work_.moved.from(begin, end - begin);
    Span<Index> const near = work_.where.queue.from(begin, end - begin);
    Span<Side> const side = work_.cover.side;
    Index n_left, n_right, n_separator = 0;
    Index const n_near = set_sides(cut, begin, end, n_left, n_right);
    // The places of what is left of the cut and near it are free.
    work_.cover.find(graph_, near.first(n_near), part.from(n_left, n_near));
    for (Index k = 0; k < n_near; ++k) {
        Index const u = near[k];
        Side const its = side[u];
        side[u] = Side::inside;
        if (its == Side::left) part[n_left++] = u;
        if (its == Side::right) moved[n_right++] = u;
        if (its == Side::separator) near[n_separator++] = u;
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
    Span<const Place> const place = work_.where.place;
    if (cut.direction != layer_direction) {
        // x and y, the two diagonals; steps and levels are passed by layers
        Index const perpendicular = cut.direction < straight_directions ? cut.direction ^ 1 : layer_direction;
        for (Index k = 0; k < keyed.count(); ++k) keyed[k] = {place[cut_off[k]].at[perpendicular], cut_off[k]};
    } else {
        float x = 0, y = 0;
        float const weight = 1.0f / static_cast<float>(cut_off.size() + 1);
        for (Index const u : cut_off) {
            x += weight * place[u].at[0];
            y += weight * place[u].at[1];
        }
        auto const angle = [&](Index u) {  // round the unit square instead of the circle: -2 .. 2
            float const dx = place[u].at[0] - x, dy = place[u].at[1] - y;
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
