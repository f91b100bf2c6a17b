#include "direct/multifrontal.hpp"

namespace harmorph {
namespace {

// A pivot smaller than this fraction of the sum of its absolute terms is rounding: the matrix is
// singular or indefinite.
constexpr Real pivot_floor = 1e-15;
constexpr Index nodes_between_factor_reports = 512;

class Factorisation {
public:
    using Worker = Multifrontal::Worker;
    using Panel = dense::Panel;
    using UpdateMatrix = dense::UpdateMatrix;

    Factorisation(Multifrontal const& engine, Matrix const& matrix) noexcept
        : engine_(engine), matrix_(matrix) {}

    // Factors the node and its descendants. The update matrix of the node goes to `update`; those
    // of its children use the stack that begins at `free`. Calls report(node) after each node.
    template <class Report>
    Status run(Index node, Real* update, Real* free, Worker const& worker, Report const& report,
               Fault& fault) const noexcept {
        auto const& front = engine_.tree.nodes[node];
        Panel const panel = engine_.panel(node);
        UpdateMatrix const left{update, panel.border, panel.planes};
        if (front.child == none) begin(node, panel, left);
        for (Index child = front.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            UpdateMatrix const added{done != none ? engine_.kept_update(done) : free,
                                     engine_.border_of(child).count(), panel.planes};
            Real* const behind = free + added.planes * dense::update_entries(added.n);
            if (done == none) HARMORPH_TRY(run(child, free, behind, worker, report, fault));
            // The panel is cleared after the first child, so that it is still in the caches when
            // used.
            if (child == front.child) begin(node, panel, left);
            dense::extend_add(engine_.kernel, added, engine_.targets_of(child), panel, left);
        }
        dense::Workers const workers{worker.executor, worker.sums, worker.min_pivot_ratio};
        Index const bad = dense::factor(engine_.kernel, panel, pivot_floor, workers);
        if (bad != none) {
            return fault.refuse(Status::not_positive,
                                "the matrix of the equations is not positive definite at point #",
                                point_item(front.begin + bad));
        }
        dense::update_border(engine_.kernel, panel, left, workers);
        note_pivots(panel, matrix_.diagonal.from(front.begin, panel.pivots),
                    *worker.min_pivot_to_diagonal);
        return report(node);
    }

private:
    void clear(Real* numbers, Offset entries) const noexcept {
        fill(Span<Real>(numbers, static_cast<Size>(engine_.planes * entries)), Real{0});
    }

    void begin(Index node, Panel const& panel, UpdateMatrix const& left) const noexcept {
        clear(panel.data, dense::panel_entries(panel.pivots, panel.border));
        clear(left.data, dense::update_entries(left.n));
        assemble(node, panel);
    }

    // Copies the entries of the matrix in the rows of the pivots, with row sums instead of
    // diagonals.
    void assemble(Index node, Panel const& panel) const noexcept {
        if (panel.planes == 2) assemble_planes<2>(node, panel);
        else assemble_planes<1>(node, panel);
    }
    // This is a function of its own, because the compiler would spill the pointers of this loop to
    // memory if the function were inlined.
    template <Index planes>
    __attribute__((noinline)) void assemble_planes(Index node, Panel const& panel) const noexcept {
        auto const& front = engine_.tree.nodes[node];
        Span<const Index> const border = engine_.border_of(node);
        dense::Slabs const own = panel.own(), border_columns = panel.border_columns();
        Span<Offset> const start = matrix_.start;
        Span<Index> const column = matrix_.column;
        Span<Real> const value = matrix_.value, imaginary = matrix_.imaginary;
        Index const first = front.begin, behind = front.end;
        Offset k = start[first];
        for (Index i = first; i < behind; ++i) {
            Index const pivot = i - first;
            Real* const sum = own.at(pivot, pivot);
            sum[0] = matrix_.row_sum[i];
            if (planes == 2) sum[dense::slab] = matrix_.row_sum_imaginary[i];
            for (Offset const end = start[i + 1]; k < end; ++k) {
                Index const j = column[k];
                Real* const entry = j < behind ? own.at(pivot, j - first)
                                               : border_columns.at(pivot, index_in(border, j));
                entry[0] = value[k];
                if (planes == 2) entry[dense::slab] = imaginary[k];
            }
        }
    }

    static void note_pivots(Panel const& panel, Span<const Real> diagonal,
                            Real& min_ratio) noexcept {
        for (Index k = 0; k < panel.pivots; ++k) {
            Real const inverse = *panel.at(k, k);  // The number is 1 / sqrt(pivot).
            Real const ratio = 1 / (diagonal[k] * inverse * inverse);
            if (ratio < min_ratio) min_ratio = ratio;
        }
    }

    // Returns the index of `position` in the border by bisection without branches, which could not
    // be predicted.
    static Index index_in(Span<const Index> border, Index position) noexcept {
        const Index* from = border.data();
        for (Index n = border.count(); n > 1;) {
            Index const step = n / 2;
            from += from[step] <= position ? step : 0;
            n -= step;
        }
        return static_cast<Index>(from - border.data());
    }

    Multifrontal const& engine_;
    Matrix const& matrix_;
};

}  // namespace

Status Multifrontal::factorise(Matrix const& matrix, Progress const& progress,
                               Fault& fault) noexcept {
    Factorisation const factorisation(*this, matrix);
    fill(numbers.min_pivot_ratio, Real{1});
    fill(numbers.min_pivot_to_diagonal, Real{1});
    Turns turns;
    // The fault with the first position is kept, so that the result does not depend on the number
    // of threads.
    auto const take_first = [](Fault const& other, Fault& first) {
        bool const is_first = !failed(first.status) || other.item.number < first.item.number;
        if (failed(other.status) && is_first) first = other;
    };
    for_each_subtree([&](Index subtree, Worker const& worker) {
        Fault subtree_fault;
        factorisation.run(
            subtrees.all[subtree].root, kept_update(subtree), worker.stack, worker,
            [](Index) { return Status::ok; }, subtree_fault);
        turns.take([&] { take_first(subtree_fault, fault); });
    });
    HARMORPH_TRY(fault.status);

    auto const report = [&](Index node) {
        if (subtrees.count == 0 && node % nodes_between_factor_reports != 0) return Status::ok;
        return progress.report(Phase::factor, static_cast<Real>(node + 1) / (tree.count + 1.0),
                               fault);
    };
    Worker const worker = top_worker();
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        // A root has no border.
        HARMORPH_TRY(factorisation.run(node, worker.stack, worker.stack, worker, report, fault));
    }
    return Status::ok;
}

namespace {

Real smallest_of(Span<const Real> ratios) noexcept {
    Real smallest = 1;
    for (Real const ratio : ratios) smallest = min(smallest, ratio);
    return smallest;
}

}  // namespace

Real Multifrontal::min_pivot_ratio() const noexcept { return smallest_of(numbers.min_pivot_ratio); }

Real Multifrontal::min_pivot_to_diagonal() const noexcept {
    return smallest_of(numbers.min_pivot_to_diagonal);
}

}  // namespace harmorph
