#include "harmorph/multifrontal.hpp"

namespace harmorph {
namespace {

// A pivot this small beside its value before its own block's turn is rounding: the matrix is singular, or worse.
constexpr Real pivot_floor = 1e-15;
constexpr Index nodes_between_reports = 512;

using Lane = Multifrontal::Lane;

class Factorisation {
public:
    Factorisation(Multifrontal const& engine, Matrix const& matrix) noexcept : engine_(engine), matrix_(matrix) {}

    // The node's update matrix is made at `update`; `free` is where its children's may be. told(node) after each node.
    template <class Told>
    Status run(Index node, Real* update, Real* free, Lane const& lane, Told const& told, Fault& fault) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        dense::Panel const panel = engine_.panel(node);
        dense::UpdateMatrix const left{update, panel.border()};
        fill(Span<Real>(panel.data, static_cast<Size>(dense::Panel::entries(panel.pivots, panel.front))), 0.0);
        fill(Span<Real>(update, static_cast<Size>(dense::UpdateMatrix::entries(left.n))), 0.0);
        assemble(node, panel);
        for (Index child = its.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            dense::UpdateMatrix const added{done != none ? engine_.kept_update(done) : free, engine_.border_of(child).count()};
            Offset const entries = dense::UpdateMatrix::entries(added.n);
            if (done == none) HARMORPH_TRY(run(child, free, free + entries, lane, told, fault));
            engine_.find_targets(child, node, lane);
            extend_add(added, panel, left, lane);
        }
        dense::Workers const workers{lane.executor, lane.packing};
        Index const bad = dense::factor(engine_.kernel, panel, pivot_floor, workers);
        if (bad != none) {
            return fault.refuse(Status::not_positive, "the matrix is not positive definite at point #", Counts::mesh,
                                its.begin + bad);
        }
        dense::update_border(engine_.kernel, panel, left, workers);
        return told(node);
    }

private:
    // The matrix's own entries in the pivots' rows.
    void assemble(Index node, dense::Panel const& panel) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        Span<const Index> const border = engine_.border_of(node);
        for (Index i = its.begin; i < its.end; ++i) {
            Real* const row = panel.row(i - its.begin);
            row[i - its.begin] = matrix_.diagonal[i];
            for (Offset k = matrix_.start[i]; k < matrix_.start[i + 1]; ++k) {
                Index const j = matrix_.column[k];
                row[j < its.end ? j - its.begin : panel.pivots + place_in(border, j)] += matrix_.value[k];
            }
        }
    }

    static Index place_in(Span<const Index> border, Index position) noexcept {
        Index low = 0, high = border.count();
        while (high - low > 1) {
            Index const middle = low + (high - low) / 2;
            (border[middle] <= position ? low : high) = middle;
        }
        return low;
    }

    // A child's update matrix into its parent's pivot rows and update matrix.
    static void extend_add(dense::UpdateMatrix const& from, dense::Panel const& panel, dense::UpdateMatrix const& update,
                           Lane const& lane) noexcept {
        for (Index r = 0; r < from.n; ++r) {
            Index const target = lane.target[r];
            bool const is_pivot = target < panel.pivots;
            Real* const to = is_pivot ? panel.row(target) : update.row(target - panel.pivots);
            const Real* const row = from.row(r);
            Index const shift = is_pivot ? 0 : panel.pivots;
            for (Index c = r; c < from.n; c = lane.run_end[c]) {
                Real* const run = to + (lane.target[c] - shift);
                const Real* const source = row + c;
                Index const length = lane.run_end[c] - c;
                for (Index i = 0; i < length; ++i) run[i] += source[i];
            }
        }
    }

    Multifrontal const& engine_;
    Matrix const& matrix_;
};

}  // namespace

Status Multifrontal::factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept {
    Factorisation const factorisation(*this, matrix);
    Fault fault_of[Executor::most_threads];
    for_each_subtree([&](Subtree const& subtree, Lane const& lane) {
        Fault& its = fault_of[subtree.lane];
        if (failed(its.status)) return;
        Real* const update = kept_update(subtrees.find(subtree.root));
        factorisation.run(subtree.root, update, lane.stack, lane, [](Index) { return Status::ok; }, its);
    });
    for (Fault const& its : fault_of) {  // the first position, whoever met it
        if (failed(its.status) && (!failed(fault.status) || its.item < fault.item)) fault = its;
    }
    HARMORPH_TRY(fault.status);

    auto const told = [&](Index node) {
        if (subtrees.count == 0 && node % nodes_between_reports != 0) return Status::ok;
        return progress.report(Phase::factor, static_cast<Real>(node + 1) / (tree.count + 1.0), fault);
    };
    Lane const lane = top_lane();
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(factorisation.run(node, lane.stack, lane.stack, lane, told, fault));  // a root has no border
    }
    return Status::ok;
}

}  // namespace harmorph
