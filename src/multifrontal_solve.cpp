#include "harmorph/multifrontal.hpp"

namespace harmorph {
namespace {

constexpr Index nodes_between_reports = 512;

using Lane = Multifrontal::Lane;

// Right-hand sides travel up the tree like update matrices, in rows as long as all functions together, and solutions down.
class Substitution {
public:
    Substitution(Multifrontal const& engine, Rows const& values) noexcept
        : engine_(engine), values_(values), row_(dense::padded(values.width)) {}

    // Solves U^T y = y. `front` receives the node's right-hand sides: pivots' rows, then what is left for the border's.
    template <class Told>
    Status forward(Index node, Real* front, Real* free, Lane const& lane, Told const& told) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        dense::Panel const panel = engine_.panel(node);
        for (Index k = 0; k < panel.pivots; ++k) gather(values_[its.begin + k], front + Offset{k} * row_);
        Real* const border = front + Offset{panel.pivots} * row_;
        fill(Span<Real>(border, static_cast<Size>(Offset{panel.border()} * row_)), 0.0);
        for (Index child = its.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            dense::Panel const below = engine_.panel(child);
            Real* const from = done != none ? engine_.kept_rows(done) : free;
            if (done == none) HARMORPH_TRY(forward(child, free, free + Offset{below.front} * row_, lane, told));
            engine_.find_targets(child, node, lane);
            add_rows(below.border(), from + Offset{below.pivots} * row_, front, lane);
        }
        dense::solve_forward(engine_.kernel, panel, front, row_, lane.executor);
        for (Index k = 0; k < panel.pivots; ++k) scatter(front + Offset{k} * row_, values_[its.begin + k]);
        return told(node);
    }

    // Solves U x = y for the node's pivots; all positions above it are known.
    void backward(Index node, Lane const& lane) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        dense::Panel const panel = engine_.panel(node);
        Real* to = lane.rows;
        for (Index k = its.begin; k < its.end; ++k, to += row_) gather(values_[k], to);
        for (Index const position : engine_.border_of(node)) {
            gather(values_[position], to);
            to += row_;
        }
        dense::solve_backward(engine_.kernel, panel, lane.rows, row_, lane.executor);
        for (Index k = 0; k < panel.pivots; ++k) scatter(lane.rows + Offset{k} * row_, values_[its.begin + k]);
    }

private:
    void gather(const Real* from, Real* to) const noexcept {
        for (Index i = 0; i < values_.width; ++i) to[i] = from[i];
        for (Index i = values_.width; i < row_; ++i) to[i] = 0;
    }
    void scatter(const Real* from, Real* to) const noexcept {
        for (Index i = 0; i < values_.width; ++i) to[i] = from[i];
    }
    void add_rows(Index n, const Real* from, Real* front, Lane const& lane) const noexcept {
        for (Index r = 0; r < n; ++r, from += row_) {
            Real* const to = front + Offset{lane.target[r]} * row_;
            for (Index i = 0; i < row_; ++i) to[i] += from[i];
        }
    }

    Multifrontal const& engine_;
    Rows const& values_;
    Index row_;
};

}  // namespace

Status Multifrontal::solve(Rows const& values, Progress const& progress, Fault& fault) noexcept {
    Substitution const substitution(*this, values);
    Index done = 0;
    auto const told = [&](Index) {
        if (++done % nodes_between_reports != 0) return Status::ok;
        return progress.report(Phase::solve, static_cast<Real>(done) / (2.0 * tree.count + 1), fault);
    };
    Lane const lane = top_lane();
    for_each_subtree([&](Subtree const& subtree, Lane const& its) {
        Real* const front = kept_rows(subtrees.find(subtree.root));
        substitution.forward(subtree.root, front, its.rows, its, [](Index) { return Status::ok; });
    });
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        Offset const entries = Offset{panel(node).front} * dense::padded(values.width);
        HARMORPH_TRY(substitution.forward(node, lane.rows, lane.rows + entries, lane, told));
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
    for_each_subtree([&](Subtree const& subtree, Lane const& its) {
        for (Index node = subtree.root; node >= subtree.first; --node) substitution.backward(node, its);
    });
    return Status::ok;
}

}  // namespace harmorph
