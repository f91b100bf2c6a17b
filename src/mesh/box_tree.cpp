#include "mesh/box_tree.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index leaf_items = 4;

Real along(BoxTree::Entry const& entry, bool vertical) noexcept {
    return vertical ? entry.centre.y : entry.centre.x;
}

void exchange(BoxTree::Entry& a, BoxTree::Entry& b) noexcept {
    BoxTree::Entry const old_a = a;
    a = b;
    b = old_a;
}

// Reorders the entries by Hoare's selection, so that no entry before entry k is greater and no
// entry after it is smaller. After 64 pivots the entries are sorted instead, because bad pivots
// would make the selection quadratic.
void select(Span<BoxTree::Entry> entries, Index k, bool vertical) noexcept {
    Index low = 0, high = entries.count() - 1;
    for (Index pivots = 0; low < high; ++pivots) {
        if (pivots > 64) {
            return sort(entries.from(low, high - low + 1),
                        [&](BoxTree::Entry const& a, BoxTree::Entry const& b) {
                            return along(a, vertical) < along(b, vertical);
                        });
        }
        Real const a = along(entries[low], vertical),
                   b = along(entries[low + (high - low) / 2], vertical),
                   c = along(entries[high], vertical);
        Real const pivot = max(min(a, b), min(max(a, b), c));
        Index i = low, j = high;
        while (i <= j) {
            while (along(entries[i], vertical) < pivot) ++i;
            while (pivot < along(entries[j], vertical)) --j;
            if (i <= j) exchange(entries[i++], entries[j--]);
        }
        if (k <= j) {
            high = j;
        } else if (k >= i) {
            low = i;
        } else {
            return;
        }
    }
}

}  // namespace

void BoxTree::lay_out(Arena& arena, Index n_items) noexcept {
    set_count(n_items);
    arena.take(entry, n);
    arena.take(box, Size{2} << levels);
}

void BoxTree::set_count(Index n_items) noexcept {
    n = n_items;
    for (levels = 0; (n >> levels) > leaf_items; ++levels) {}
}

void BoxTree::halve() noexcept {
    for (Index level = 0; level < levels; ++level) {
        for (Index node = 0; node < Index{1} << level; ++node) {
            Index const first = begin(level, node), middle = begin(level + 1, 2 * node + 1);
            Span<Entry> const node_entries = entry.from(first, begin(level, node + 1) - first);
            Box centres;
            for (Entry const& e : node_entries) centres.include(e.centre);
            Vec2 const extent = centres.high - centres.low;
            select(node_entries, middle - first, extent.y > extent.x);
        }
    }
}

void BoxTree::unite() noexcept {
    for (Index node = (Index{1} << levels) - 1; node > 0; --node) {
        box[node] = box[2 * node];
        box[node].include(box[2 * node + 1]);
    }
}

}  // namespace harmorph
