#include "harmorph/multifrontal.hpp"

namespace harmorph {

void Multifrontal::lay_out(Arena& arena, Index nodes, FrontSizes const& sizes, Subtrees const& its_subtrees,
                           Index width) noexcept {
    subtrees = its_subtrees;
    largest_border = sizes.largest_border;
    padded_width = dense::padded(width);
    Offset const lanes = subtrees.lanes;
    arena.take(tree.nodes, nodes);
    arena.take(subtrees.all, subtrees.count);
    arena.take(border_start, Offset{nodes} + 1);
    arena.take(border, sizes.border_entries);
    arena.take(panel_start, Offset{nodes} + 1);
    arena.take(factor, sizes.factor_entries + (Offset{subtrees.count} + 1) * dense::overread);
    arena.take(target, lanes * largest_border);
    arena.take(run_end, lanes * largest_border);
    arena.take(packing, lanes * dense::packing_entries);
    Offset const stacks = lanes > 1 ? lanes + 1 : 1;
    arena.take(rows, (stacks * subtrees.stack_rows + subtrees.kept_rows) * padded_width + dense::overread);
}

void Multifrontal::lay_out_stack(Arena& arena) noexcept {
    Offset const lanes = subtrees.lanes > 1 ? subtrees.lanes : 0;
    arena.take(stack, subtrees.top_stack_entries + subtrees.kept_entries + lanes * subtrees.stack_entries);
}

void Multifrontal::place_panels() noexcept {
    Offset next = 0;
    for (Index node = 0; node < tree.count; ++node) {
        panel_start[node] = next;
        Index const pivots = tree.nodes[node].pivots();
        next += dense::Panel::entries(pivots, pivots + border_of(node).count());
        if (subtrees.find(node) != none) next += dense::overread;  // what comes next is another lane's
    }
    panel_start[tree.count] = next;
}

dense::Panel Multifrontal::panel(Index node) const noexcept {
    Index const pivots = tree.nodes[node].pivots();
    return {factor.data() + panel_start[node], pivots, pivots + border_of(node).count()};
}

Multifrontal::Lane Multifrontal::top_lane() const noexcept {
    return {executor, stack.data(), rows.data(), packing.data(), target.data(), run_end.data()};
}

Multifrontal::Lane Multifrontal::lane(Index number) const noexcept {
    Offset const n = number;
    return {Executor{},
            stack.data() + subtrees.top_stack_entries + subtrees.kept_entries + n * subtrees.stack_entries,
            rows.data() + ((n + 1) * subtrees.stack_rows + subtrees.kept_rows) * padded_width,
            packing.data() + n * dense::packing_entries,
            target.data() + n * largest_border,
            run_end.data() + n * largest_border};
}

void Multifrontal::find_targets(Index child, Index parent, Lane const& lane) const noexcept {
    auto const& its = tree.nodes[parent];
    Span<const Index> const from = border_of(child), to = border_of(parent);
    Index at = 0;
    for (Index r = 0; r < from.count(); ++r) {
        if (from[r] < its.end) {
            lane.target[r] = from[r] - its.begin;
            continue;
        }
        while (to[at] != from[r]) ++at;  // both increase
        lane.target[r] = its.pivots() + at;
    }
    for (Index r = from.count() - 1; r >= 0; --r) {
        bool const goes_on = r + 1 < from.count() && lane.target[r + 1] == lane.target[r] + 1 &&
                             lane.target[r + 1] != its.pivots();  // pivots and border lie in two blocks
        lane.run_end[r] = goes_on ? lane.run_end[r + 1] : r + 1;
    }
}

}  // namespace harmorph
