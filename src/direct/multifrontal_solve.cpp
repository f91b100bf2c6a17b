#include "harmorph/direct/multifrontal.hpp"

namespace harmorph {
namespace {

constexpr Index nodes_between_reports = 512;
constexpr Offset most_prefetched = 8192;  // entries; larger ones are read in longer runs

// Right-hand sides travel up the tree like update matrices, in rows as long as all functions together, and solutions down.
template <class Number, class Value>
class Substitution {
public:
    using Lane = Multifrontal::Lane<Number>;
    using Panel = dense::Panel<Number>;

    Substitution(Multifrontal const& engine, RowsOf<Value> const& values) noexcept
        : engine_(engine), values_(values), width_(dense::padded(values.width)), row_(engine.planes * width_) {}

    // Numbers in the right-hand sides of a front.
    Offset entries(Index node) const noexcept { return Offset{engine_.front_of(node)} * row_; }

    // Solves U^H y = y. `front` receives the node's right-hand sides: pivots' rows, then what is left for the border's. Most
    // nodes are far from all known values: where a subtree's right-hand sides are 0, so is all that comes of them, and
    // `front` holds nothing.
    template <class Told>
    Status forward(Index node, Number* front, Number* free, Lane const& lane, Told const& told, bool& is_zero) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        Panel const panel = engine_.panel<Number>(node);
        dense::gather(engine_.kernel, values_, its.begin, panel.pivots, front, width_, engine_.planes);
        Span<Number> const pivots(front, static_cast<Size>(Offset{panel.pivots} * row_));
        Span<Number> const border(front + pivots.size(), static_cast<Size>(Offset{panel.border} * row_));
        is_zero = all_zero(pivots);
        if (!is_zero) fill(border, Number{0});
        for (Index child = its.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            Number* const from = done != none ? engine_.kept_rows<Number>(done) : free;
            bool adds_nothing = done != none && engine_.subtrees.all[done].adds_nothing;
            if (done == none) HARMORPH_TRY(forward(child, free, free + entries(child), lane, told, adds_nothing));
            if (adds_nothing) continue;
            if (is_zero) fill(border, Number{0});
            is_zero = false;
            engine_.find_targets(child, node, lane.targets);
            dense::add_rows(engine_.kernel, engine_.border_of(child).count(), from + Offset{engine_.pivots_of(child)} * row_,
                            lane.targets, front, row_);
        }
        if (is_zero) return told(node);
        prefetch_panel(node + 1);
        dense::solve_forward(engine_.kernel, panel, front, width_, lane.executor);
        dense::scatter(engine_.kernel, front, width_, engine_.planes, values_, its.begin, panel.pivots);
        return told(node);
    }

    // Solves U x = y for the node's pivots; all positions above it are known.
    void backward(Index node, Lane const& lane) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        Panel const panel = engine_.panel<Number>(node);
        Number* const border = lane.rows + Offset{panel.pivots} * row_;
        dense::gather(engine_.kernel, values_, its.begin, panel.pivots, lane.rows, width_, engine_.planes);
        dense::gather(engine_.kernel, values_, engine_.border_of(node), border, width_, engine_.planes);
        prefetch_panel(node - 1);
        dense::solve_backward(engine_.kernel, panel, lane.rows, width_, lane.executor);
        dense::scatter(engine_.kernel, lane.rows, width_, engine_.planes, values_, its.begin, panel.pivots);
    }

private:
    static bool all_zero(Span<const Number> numbers) noexcept {
        constexpr Size at_once = 64;  // looked at without a branch; a row is a multiple of 8, so the rest is short
        for (Size begin = 0; begin < numbers.size(); begin += at_once) {
            bool any = false;
            for (Number const number : numbers.from(begin, smaller(at_once, numbers.size() - begin))) any |= number != 0;
            if (any) return false;
        }
        return true;
    }

    // Fronts are too small for the processor to guess what comes next.
    void prefetch_panel(Index node) const noexcept {
        if (node < 0 || node >= engine_.tree.count) return;
        const Number* const begin = engine_.panel<Number>(node).data;
        Offset const entries = smaller(engine_.panel_start[node + 1] - engine_.panel_start[node], most_prefetched);
        constexpr Offset line = 64 / sizeof(Number);
        for (Offset k = 0; k < entries; k += line) __builtin_prefetch(begin + k, 0, 2);
    }

    Multifrontal const& engine_;
    RowsOf<Value> const& values_;
    Index width_, row_;  // of one plane; of all
};

}  // namespace

template <class Number, class Value>
Status Multifrontal::solve_in(RowsOf<Value> const& values, Progress const& progress, Fault& fault) noexcept {
    Substitution<Number, Value> const substitution(*this, values);
    Index done = 0;
    auto const told = [&](Index) {
        if (++done % nodes_between_reports != 0) return Status::ok;
        return progress.report(Phase::solve, static_cast<Real>(done) / (2.0 * tree.count + 1), fault);
    };
    Lane<Number> const lane = top_lane<Number>();
    for_each_subtree<Number>([&](Subtree const& subtree, Lane<Number> const& its) {
        Index const number = subtrees.find(subtree.root);
        substitution.forward(subtree.root, kept_rows<Number>(number), its.rows, its, [](Index) { return Status::ok; },
                             subtrees.all[number].adds_nothing);
    });
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        bool is_zero;
        HARMORPH_TRY(substitution.forward(node, lane.rows, lane.rows + substitution.entries(node), lane, told, is_zero));
    }
    Index next_subtree = subtrees.count - 1;
    for (Index node = tree.count - 1; node >= 0; --node) {
        if (next_subtree >= 0 && node == subtrees.all[next_subtree].root) {
            node = subtrees.all[next_subtree--].first;  // all of it comes later
            continue;
        }
        substitution.backward(node, lane);
        HARMORPH_TRY(told(node));
    }
    for_each_subtree<Number>([&](Subtree const& subtree, Lane<Number> const& its) {
        for (Index node = subtree.root; node >= subtree.first; --node) substitution.backward(node, its);
    });
    return Status::ok;
}

Status Multifrontal::solve(Rows const& values, Progress const& progress, Fault& fault) noexcept {
    if (precision == Precision::in_single) return solve_in<float>(values, progress, fault);
    return solve_in<double>(values, progress, fault);
}

Status Multifrontal::solve(RowsOf<float> const& values, Progress const& progress, Fault& fault) noexcept {
    return solve_in<float>(values, progress, fault);
}

}  // namespace harmorph
