#include "harmorph/dissection.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

constexpr Index leaf_size = 20;       // parts up to this size are eliminated densely
constexpr Index smallest_child = 4;   // smaller parts join the separator; with it, nodes <= n / 2
constexpr Index most_samples = 63;
constexpr Index separator_samples = 48;
enum Side : std::uint8_t { left = 0, right = 1, separator = 2, elsewhere = 3 };

// Cuts at `level` in all directions at once: left is what lies before it.
struct Cuts {
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

struct Cut {
    Index direction = none;  // none: halve the list as it stands
    float level = 0;
    Side separated = left;   // the side that gives the separator
};

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

// A part of the order, cut: its left part, its right one from `middle` on, its separator from `pivots` on.
struct Division {
    Index middle = 0, pivots = 0;
};

// Parts that do not overlap may be ordered at the same time: each keeps to its own places of the working arrays, and
// separators that are done with stand between their unknowns.
class Dissector {
public:
    Dissector(Graph const& graph, DissectionWork const& work, Span<Index> order) noexcept
        : graph_(graph), work_(work), order_(order) {}

    // Orders the part begin .. end-1 and returns its root in the tree, or none if it is empty.
    Index dissect(Index begin, Index end, AssemblyTree& tree) const noexcept {
        if (begin == end) return none;
        if (end - begin <= leaf_size) return add_node(begin, end, none, none, tree);
        Division const its = divide(begin, end);
        Index const first = dissect(begin, its.middle, tree);
        Index const second = dissect(its.middle, its.pivots, tree);
        return add_node(its.pivots, end, first, second, tree);
    }

    Division divide(Index begin, Index end) const noexcept {
        Index middle = 0, pivots = 0;
        Cut const cut = best_cut(begin, end);
        separate(cut, begin, end);
        partition(begin, end, middle, pivots);
        if (middle - begin < smallest_child) absorb(begin, middle, pivots);
        if (pivots - middle < smallest_child) pivots = middle;
        for (Index k = pivots; k < end; ++k) work_.side[order_[k]] = elsewhere;  // neither part will see them again
        sort_along(cut, order_.from(pivots, end - pivots));
        return {middle, pivots};
    }

    static Index add_node(Index begin, Index end, Index first, Index second, AssemblyTree& tree) noexcept {
        Index const number = tree.count++;
        AssemblyTree::Node node;
        node.begin = begin;
        node.end = end;
        node.child = first != none ? first : second;
        if (first != none && second != none) tree.nodes[first].sibling = second;
        Index const children[] = {first, second};
        for (Index const child : children) {
            if (child != none) tree.nodes[child].parent = number;
        }
        tree.nodes[number] = node;
        return number;
    }

private:
    // Moves a tiny left part behind the right one, into the separator.
    void absorb(Index begin, Index& middle, Index& pivots) const noexcept {
        Index const n = middle - begin;
        for (Index k = begin; k < middle; ++k) work_.moved[k] = order_[k];
        for (Index k = middle; k < pivots; ++k) order_[k - n] = order_[k];
        for (Index k = 0; k < n; ++k) order_[pivots - n + k] = work_.moved[begin + k];
        pivots -= n;
        middle = begin;
    }

    Cut best_cut(Index begin, Index end) const noexcept {
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
            Real const larger_part = static_cast<Real>(larger(left_size, right_size)) / static_cast<Real>(n);
            Real const cost = static_cast<Real>(smaller(left_border, right_border)) * (0.5 + larger_part);
            if (cost >= least) continue;
            least = cost;
            best = {direction, cuts.level[direction], left_border <= right_border ? left : right};
        }
        return best;
    }

    // Levels at the medians of a few samples.
    void set_levels(Index begin, Index n, Cuts& cuts) const noexcept {
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
    void separate(Cut const& cut, Index begin, Index end) const noexcept {
        Side const other = cut.separated == left ? right : left;
        Index n_near = 0;
        Span<Index> const near = work_.moved.from(begin, end - begin);
        for (Index k = begin; k < end; ++k) {
            Index const u = order_[k];
            float const distance = cut.direction == none ? static_cast<float>(k - begin - (end - begin) / 2)
                                                         : work_.where.place[u].at[cut.direction] - cut.level;
            bool const is_left = distance < 0;
            work_.side[u] = is_left ? left : right;
            if (is_left != (cut.separated == left)) continue;
            near[n_near] = u;
            n_near += may_touch(cut, u, distance) ? 1 : 0;
        }
        for (Index const u : near.first(n_near)) {
            for (Index const v : graph_.of(u)) {
                if (work_.side[v] != other) continue;
                work_.side[u] = separator;
                break;
            }
        }
    }

    bool may_touch(Cut const& cut, Index u, float distance) const noexcept {
        if (cut.direction == none) return true;
        Reach const& reach = work_.where.reach[u];
        return distance < 0 ? distance + reach.ahead[cut.direction] >= 0 : distance - reach.behind[cut.direction] < 0;
    }

    // Stable, so that memory is still passed through in its own direction.
    void partition(Index begin, Index end, Index& middle, Index& pivots) const noexcept {
        Span<Index> const moved = work_.moved.from(begin, end - begin), cut_off = work_.where.queue.from(begin, end - begin);
        middle = begin;
        Index n_right = 0, n_cut_off = 0;
        for (Index k = begin; k < end; ++k) {
            Index const u = order_[k];
            switch (work_.side[u]) {
                case left: order_[middle++] = u; break;
                case right: moved[n_right++] = u; break;
                default: cut_off[n_cut_off++] = u;
            }
        }
        pivots = middle + n_right;
        copy(order_.from(middle, n_right), Span<const Index>(moved.first(n_right)));
        copy(order_.from(pivots, n_cut_off), Span<const Index>(cut_off.first(n_cut_off)));
    }

    // Along a straight cut; round the middle of a cut between layers.
    void sort_along(Cut const& cut, Span<Index> cut_off) const noexcept {
        if (cut.direction == none) return;
        if (cut.direction != layer_direction) {
            Index const perpendicular = cut.direction ^ 1;  // x and y, and the two diagonals
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

    Graph const& graph_;
    DissectionWork const& work_;
    Span<Index> order_;
};

// The top of the tree, cut level by level; then every part that is left is a task. The same tree for any number of levels.
class TreeTop {
public:
    TreeTop(Dissector const& dissector, Executor const& executor, AssemblyTree& tree) noexcept
        : dissector_(dissector), executor_(executor), tree_(tree) {}

    void dissect(Index n) noexcept {
        Index levels = 0;
        while (!executor_.is_serial() && levels < most_levels && (1 << levels) < 8 * executor_.n_threads) ++levels;
        part_[1] = {0, n};
        for (Index level = 0; level < levels; ++level) {
            executor_.for_each(1 << level, [&](Index i) { divide((1 << level) + i); });
        }
        executor_.for_each((2 << levels) - 1, [&](Index i) { plant(part_[1 + i]); });
        tree_.count = 0;
        join(1);
    }

private:
    static constexpr Index most_levels = 6;

    struct Part {
        Index begin = 0, end = 0;
        bool is_cut = false;
        Index pivots = 0;   // where it is cut, the parts 2 h and 2 h + 1 of part h before them
        Index n_nodes = 0;  // where not
        // No part of at least `smallest_child` unknowns has more nodes than half of them.
        Index first_node() const noexcept { return (begin + 1) / 2; }
    };

    void divide(Index h) noexcept {
        Part& its = part_[h];
        if (its.end - its.begin <= leaf_size) return;
        Division const division = dissector_.divide(its.begin, its.end);
        its.is_cut = true;
        its.pivots = division.pivots;
        part_[2 * h] = {its.begin, division.middle};
        part_[2 * h + 1] = {division.middle, division.pivots};
    }

    void plant(Part& its) const noexcept {
        if (its.is_cut || its.begin == its.end) return;
        AssemblyTree own;
        own.nodes = tree_.nodes.from(its.first_node(), tree_.nodes.count() - its.first_node());
        dissector_.dissect(its.begin, its.end, own);
        its.n_nodes = own.count;
    }

    // Moves nodes up to those that are there already. Returns the root.
    Index join(Index h) noexcept {
        Part const& its = part_[h];
        if (its.is_cut) {
            Index const first = join(2 * h), second = join(2 * h + 1);
            return Dissector::add_node(its.pivots, its.end, first, second, tree_);
        }
        Index const shift = tree_.count;
        for (Index k = 0; k < its.n_nodes; ++k) {
            AssemblyTree::Node node = tree_.nodes[its.first_node() + k];
            Index* const relatives[] = {&node.parent, &node.child, &node.sibling};
            for (Index* const other : relatives) *other += *other != none ? shift : 0;
            tree_.nodes[tree_.count++] = node;
        }
        return its.n_nodes > 0 ? tree_.count - 1 : none;
    }

    Dissector const& dissector_;
    Executor const& executor_;
    AssemblyTree& tree_;
    Part part_[2 << most_levels];
};

}  // namespace

void AssemblyTree::lay_out(Arena& arena, Index max_unknowns) noexcept { arena.take(nodes, max_unknowns / 2 + 1); }

void DissectionWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    where.lay_out(arena, max_unknowns);
    arena.take(moved, max_unknowns);
    arena.take(side, max_unknowns);
}

void dissect(Graph const& graph, Points points, DissectionWork const& work, Executor const& executor, Span<Index> order,
             AssemblyTree& tree) noexcept {
    work.where.find(graph, points, executor);
    for (Index u = 0; u < graph.n; ++u) order[u] = u;
    TreeTop(Dissector(graph, work, order), executor, tree).dissect(graph.n);
}

}  // namespace harmorph
