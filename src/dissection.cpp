#include "harmorph/dissection.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

constexpr Index leaf_size = 32;       // parts up to this size are eliminated densely
constexpr Index smallest_child = 4;   // smaller parts join the separator; with it, nodes <= n / 2
constexpr Index n_samples = 127;
enum Side : std::uint8_t { left = 0, right = 1, separator = 2, elsewhere = 3 };

struct Cut {
    Real nx = 1, ny = 0;  // left: nx x + ny y < level
    Real level = 0;
    Index left_size = 0, left_border = 0, right_border = 0;

    bool balanced(Index n) const noexcept { return left_size >= n / 4 && n - left_size >= n / 4; }
    Index separator_size() const noexcept { return smaller(left_border, right_border); }
    // Separators are paid by their cube, an uneven cut by the larger part.
    Real cost(Index n) const noexcept {
        Real const larger_part = static_cast<Real>(larger(left_size, n - left_size)) / static_cast<Real>(n);
        return static_cast<Real>(separator_size()) * (0.5 + larger_part);
    }
};

class Dissector {
public:
    Dissector(Graph const& graph, DissectionWork const& work, Span<Index> order, AssemblyTree& tree) noexcept
        : graph_(graph), work_(work), order_(order), tree_(tree) {}

    // Orders the part begin .. end-1 and returns its root in the tree, or none if it is empty.
    Index dissect(Index begin, Index end) noexcept {
        if (begin == end) return none;
        if (end - begin <= leaf_size) return add_node(begin, end, none, none);
        Index middle = 0, pivots = 0;  // order: left part, right part from `middle`, separator from `pivots`
        cut(begin, end, middle, pivots);
        if (middle - begin < smallest_child) absorb(begin, middle, pivots);
        if (pivots - middle < smallest_child) pivots = middle;
        for (Index k = pivots; k < end; ++k) work_.side[order_[k]] = elsewhere;  // neither part will see them again
        Index const first = dissect(begin, middle);
        Index const second = dissect(middle, pivots);
        return add_node(pivots, end, first, second);
    }

private:
    Index add_node(Index begin, Index end, Index first, Index second) noexcept {
        Index const number = tree_.count++;
        AssemblyTree::Node node;
        node.begin = begin;
        node.end = end;
        node.child = first != none ? first : second;
        if (first != none && second != none) tree_.nodes[first].sibling = second;
        Index const children[] = {first, second};
        for (Index const child : children) {
            if (child != none) tree_.nodes[child].parent = number;
        }
        tree_.nodes[number] = node;
        return number;
    }

    // Moves a tiny left part behind the right one, into the separator.
    void absorb(Index begin, Index& middle, Index& pivots) noexcept {
        Index const n = middle - begin;
        for (Index k = 0; k < n; ++k) work_.moved[k] = order_[begin + k];
        for (Index k = middle; k < pivots; ++k) order_[k - n] = order_[k];
        for (Index k = 0; k < n; ++k) order_[pivots - n + k] = work_.moved[k];
        pivots -= n;
        middle = begin;
    }

    void cut(Index begin, Index end, Index& middle, Index& pivots) noexcept {
        Real const diagonal = 0.70710678118654752;
        Real const normals[][2] = {{1, 0}, {0, 1}, {diagonal, diagonal}, {diagonal, -diagonal}};
        Cut best;
        Real least = infinity;
        for (auto const& normal : normals) {
            Cut candidate;
            candidate.nx = normal[0];
            candidate.ny = normal[1];
            measure(candidate, begin, end);
            Real const cost = candidate.cost(end - begin);
            if (candidate.balanced(end - begin) && cost < least) {
                least = cost;
                best = candidate;
            }
        }
        if (least < infinity) {
            assign_sides(best, begin, end);
        } else {  // many equal coordinates in every direction: halve the list as it stands
            for (Index k = begin; k < end; ++k) work_.side[order_[k]] = k - begin < (end - begin) / 2 ? left : right;
        }
        separate(begin, end, least < infinity && best.left_border > best.right_border ? right : left);
        partition(begin, end, middle, pivots);
    }

    static Real across(Cut const& cut, DissectionWork::Place const& place) noexcept {
        return cut.nx * place.x + cut.ny * place.y;
    }

    // Median of samples, and the sizes of both parts and both one-sided separators (bounded by reach, not exact).
    void measure(Cut& cut, Index begin, Index end) const noexcept {
        Real sample[n_samples];
        Index const n = end - begin, count = smaller(n, n_samples);
        for (Index k = 0; k < count; ++k) {
            Index const at = begin + static_cast<Index>(Offset{k} * n / count);
            sample[k] = across(cut, work_.place[order_[at]]);
        }
        sort(Span<Real>(sample, static_cast<Size>(count)), [](Real a, Real b) { return a < b; });
        cut.level = sample[count / 2];
        Real const abs_nx = absolute(cut.nx), abs_ny = absolute(cut.ny);
        for (Index k = begin; k < end; ++k) {
            auto const& place = work_.place[order_[k]];
            Real const distance = across(cut, place) - cut.level;
            Real const reach = abs_nx * static_cast<Real>(place.reach_x) + abs_ny * static_cast<Real>(place.reach_y);
            cut.left_size += distance < 0 ? 1 : 0;
            cut.left_border += distance < 0 && distance >= -reach ? 1 : 0;
            cut.right_border += distance >= 0 && distance <= reach ? 1 : 0;
        }
    }

    void assign_sides(Cut const& cut, Index begin, Index end) const noexcept {
        for (Index k = begin; k < end; ++k) {
            Index const u = order_[k];
            work_.side[u] = across(cut, work_.place[u]) < cut.level ? left : right;
        }
    }

    // The unknowns of one side that have a neighbour on the other become the separator.
    void separate(Index begin, Index end, Side from) const noexcept {
        Side const other = from == left ? right : left;
        for (Index k = begin; k < end; ++k) {
            Index const u = order_[k];
            if (work_.side[u] != from) continue;
            for (Index const v : graph_.of(u)) {
                if (work_.side[v] == other) {
                    work_.side[u] = separator;
                    break;
                }
            }
        }
    }

    // Stable, so that memory is still passed through in its own direction.
    void partition(Index begin, Index end, Index& middle, Index& pivots) const noexcept {
        Index n_left = 0, n_right = 0;
        for (Index k = begin; k < end; ++k) {
            n_left += work_.side[order_[k]] == left ? 1 : 0;
            n_right += work_.side[order_[k]] == right ? 1 : 0;
        }
        middle = begin + n_left;
        pivots = middle + n_right;
        Index place[] = {begin, middle, pivots};
        for (Index k = begin; k < end; ++k) work_.moved[k] = order_[k];
        for (Index k = begin; k < end; ++k) {
            Index const u = work_.moved[k];
            order_[place[work_.side[u]]++] = u;
        }
    }

    Graph const& graph_;
    DissectionWork const& work_;
    Span<Index> order_;
    AssemblyTree& tree_;
};

void find_places(Graph const& graph, Points points, Span<DissectionWork::Place> places) noexcept {
    for (Index u = 0; u < graph.n; ++u) {
        Vec2 const p = points[graph.point[u]];
        Real reach_x = 0, reach_y = 0;
        for (Index const v : graph.of(u)) {
            Vec2 const q = points[graph.point[v]];
            reach_x = larger(reach_x, absolute(q.x - p.x));
            reach_y = larger(reach_y, absolute(q.y - p.y));
        }
        places[u] = {p.x, p.y, static_cast<float>(reach_x), static_cast<float>(reach_y)};
    }
}

}  // namespace

void AssemblyTree::lay_out(Arena& arena, Index max_unknowns) noexcept { arena.take(nodes, max_unknowns / 2 + 1); }

void DissectionWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(place, max_unknowns);
    arena.take(moved, max_unknowns);
    arena.take(side, max_unknowns);
}

void dissect(Graph const& graph, Points points, DissectionWork const& work, Span<Index> order, AssemblyTree& tree) noexcept {
    find_places(graph, points, work.place);
    for (Index u = 0; u < graph.n; ++u) order[u] = u;
    tree.count = 0;
    Dissector(graph, work, order, tree).dissect(0, graph.n);
}

}  // namespace harmorph
