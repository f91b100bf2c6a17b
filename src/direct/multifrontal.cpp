#include "direct/multifrontal.hpp"

namespace harmorph {

void Multifrontal::lay_out(Arena& arena, Index nodes, FrontSizes const& sizes,
                           Subtrees const& chosen_subtrees, Index width, bool complex) noexcept {
    subtrees = chosen_subtrees;
    planes = complex ? 2 : 1;
    max_sums = sizes.max_sums;
    padded_width = dense::padded(width);
    arena.take(tree.nodes, nodes);
    arena.take(subtrees.all, subtrees.count);
    arena.take(border_start, Offset{nodes} + 1);
    arena.take(border, sizes.border_entries);
    arena.take(target, sizes.border_entries);
    arena.take(panel_start, Offset{nodes} + 1);
    arena.take(is_zero, nodes);
    Offset const workers = subtrees.workers;
    arena.take(numbers.factor, planes * sizes.factor_entries);
    arena.take(numbers.sums, workers * planes * max_sums);
    arena.take(numbers.min_pivot_ratio, workers);
    arena.take(numbers.min_pivot_to_diagonal, workers);
    Offset const stacks = workers > 1 ? workers + 1 : 1;
    arena.take(numbers.rows, (stacks * subtrees.stack_rows + subtrees.kept_rows) * row_length());
}

void Multifrontal::lay_out_stack(Arena& arena) noexcept {
    Offset const workers = subtrees.workers > 1 ? subtrees.workers : 0;
    Offset const entries =
        subtrees.top_stack_entries + subtrees.kept_entries + workers * subtrees.stack_entries;
    arena.take(numbers.stack, planes * entries);
}

void Multifrontal::complete() noexcept {
    Offset next = 0;
    for (Index node = 0; node < tree.count; ++node) {
        panel_start[node] = next;
        next += planes * dense::panel_entries(pivots_of(node), border_of(node).count());
        if (tree.nodes[node].parent != none) find_targets(node, tree.nodes[node].parent);
    }
    panel_start[tree.count] = next;
}

void Multifrontal::find_targets(Index child, Index parent) noexcept {
    auto const& into = tree.nodes[parent];
    Span<const Index> const below = border_of(child), above = border_of(parent);
    Index* const targets = target.data() + border_start[child];
    Index at = 0;
    for (Index r = 0; r < below.count(); ++r) {
        if (below[r] < into.end) {
            targets[r] = below[r] - into.begin;
            continue;
        }
        while (above[at] != below[r]) ++at;  // Both lists increase.
        targets[r] = into.pivots() + at;
    }
}

}  // namespace harmorph
