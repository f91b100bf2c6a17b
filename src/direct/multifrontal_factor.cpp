#include "direct/multifrontal.hpp"

namespace harmorph {
namespace {

// A pivot smaller than this part of the sum of its absolute terms is rounding: the matrix is
// singular or indefinite.
template <class Number>
constexpr Number pivot_floor = static_cast<Number>(sizeof(Number) == sizeof(double) ? 1e-15 : 5e-7);
constexpr Index nodes_between_factor_reports = 512;

template <class Number>
class Factorisation {
public:
    using Worker = Multifrontal::Worker<Number>;
    using Panel = dense::Panel<Number>;
    using UpdateMatrix = dense::UpdateMatrix<Number>;

    Factorisation(Multifrontal const& engine, Matrix const& matrix) noexcept
        : engine_(engine), matrix_(matrix) {}

    // Factors the node and its descendants. The update matrix of the node goes to `update`; those
    // of its children use the stack from `free` on. Calls told(node) after each node.
    template <class Told>
    Status run(Index node, Number* update, Number* free, Worker const& worker, Told const& told,
               Fault& fault) const noexcept {
        auto const& front = engine_.tree.nodes[node];
        Panel const panel = engine_.panel<Number>(node);
        UpdateMatrix const left{update, panel.border, panel.planes};
        if (front.child == none) begin(node, panel, left);
        for (Index child = front.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            UpdateMatrix const added{done != none ? engine_.kept_update<Number>(done) : free,
                                     engine_.border_of(child).count(), panel.planes};
            Number* const behind = free + added.planes * dense::update_entries(added.n);
            if (done == none) HARMORPH_TRY(run(child, free, behind, worker, told, fault));
            if (child == front.child)
                begin(node, panel, left);  // only now, so that the panel is still in the caches
            dense::extend_add(engine_.kernel, added, engine_.targets_of(child), panel, left);
        }
        dense::Workers<Number> const workers{worker.executor, worker.sums, worker.least_left};
        Index const bad = dense::factor(engine_.kernel, panel, pivot_floor<Number>, workers);
        if (bad != none) {
            return fault.refuse(Status::not_positive,
                                "the matrix is not positive definite at point #",
                                point_item(front.begin + bad));
        }
        dense::update_border(engine_.kernel, panel, left, workers);
        note_pivots(panel, matrix_.diagonal.from(front.begin, panel.pivots), *worker.least_pivot);
        return told(node);
    }

private:
    void clear(Number* numbers, Offset entries) const noexcept {
        fill(Span<Number>(numbers, static_cast<Size>(engine_.planes * entries)), Number{0});
    }

    void begin(Index node, Panel const& panel, UpdateMatrix const& left) const noexcept {
        clear(panel.data, dense::panel_entries(panel.pivots, panel.border));
        clear(left.data, dense::update_entries(left.n));
        assemble(node, panel);
    }

    // Entries of the matrix in the rows of the pivots; row sums instead of diagonals.
    void assemble(Index node, Panel const& panel) const noexcept {
        if (panel.planes == 2) assemble_planes<2>(node, panel);
        else assemble_planes<1>(node, panel);
    }
    // A function of its own: inlined, the pointers of this loop would be spilled to memory.
    template <Index planes>
    __attribute__((noinline)) void assemble_planes(Index node, Panel const& panel) const noexcept {
        auto const& front = engine_.tree.nodes[node];
        Span<const Index> const border = engine_.border_of(node);
        dense::Slabs<Number> const own = panel.own(), of_border = panel.of_border();
        Span<Offset> const start = matrix_.start;
        Span<Index> const column = matrix_.column;
        Span<Real> const value = matrix_.value, imaginary = matrix_.imaginary;
        Index const first = front.begin, behind = front.end;
        Offset k = start[first];
        for (Index i = first; i < behind; ++i) {
            Index const pivot = i - first;
            Number* const sum = own.at(pivot, pivot);
            sum[0] = static_cast<Number>(matrix_.row_sum[i]);
            if (planes == 2) sum[dense::slab] = static_cast<Number>(matrix_.row_sum_imaginary[i]);
            for (Offset const end = start[i + 1]; k < end; ++k) {
                Index const j = column[k];
                Number* const entry = j < behind ? own.at(pivot, j - first)
                                                 : of_border.at(pivot, index_in(border, j));
                entry[0] = static_cast<Number>(value[k]);
                if (planes == 2) entry[dense::slab] = static_cast<Number>(imaginary[k]);
            }
        }
    }

    static void note_pivots(Panel const& panel, Span<const Real> diagonal, Number& least) noexcept {
        for (Index k = 0; k < panel.pivots; ++k) {
            Number const inverse = *panel.at(k, k);  // 1 / sqrt(pivot)
            Number const part = 1 / (static_cast<Number>(diagonal[k]) * inverse * inverse);
            if (part < least) least = part;
        }
    }

    // The index of `position` in the border, by halves without branches: nobody foresees where a
    // position stands.
    static Index index_in(Span<const Index> border, Index position) noexcept {
        const Index* from = border.data();
        for (Index n = border.count(); n > 1;) {
            Index const half = n / 2;
            from += from[half] <= position ? half : 0;
            n -= half;
        }
        return static_cast<Index>(from - border.data());
    }

    Multifrontal const& engine_;
    Matrix const& matrix_;
};

}  // namespace

template <class Number>
Status Multifrontal::factorise_in(Matrix const& matrix, Progress const& progress,
                                  Fault& fault) noexcept {
    Factorisation<Number> const factorisation(*this, matrix);
    fill(numbers<Number>().least_left, Number{1});
    fill(numbers<Number>().least_pivot, Number{1});
    Fault fault_of[Executor::max_threads];
    // The one with the first position: it does not depend on the number of threads.
    auto const take_first = [](Fault const& other, Fault& first) {
        bool const is_first = !failed(first.status) || other.item.number < first.item.number;
        if (failed(other.status) && is_first) first = other;
    };
    for_each_subtree<Number>([&](Index subtree, Index number, Worker<Number> const& worker) {
        Fault its;
        factorisation.run(
            subtrees.all[subtree].root, kept_update<Number>(subtree), worker.stack, worker,
            [](Index) { return Status::ok; }, its);
        take_first(its, fault_of[number]);
    });
    for (Fault const& other : fault_of) take_first(other, fault);
    HARMORPH_TRY(fault.status);

    auto const told = [&](Index node) {
        if (subtrees.count == 0 && node % nodes_between_factor_reports != 0) return Status::ok;
        return progress.report(Phase::factor, static_cast<Real>(node + 1) / (tree.count + 1.0),
                               fault);
    };
    Worker<Number> const worker = top_worker<Number>();
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(factorisation.run(node, worker.stack, worker.stack, worker, told,
                                       fault));  // a root has no border
    }
    return Status::ok;
}

namespace {

Real least_of(Span<const double> doubles, Span<const float> singles) noexcept {
    Real least = 1;
    for (double const part : doubles) least = min(least, part);
    for (float const part : singles) least = min(least, static_cast<Real>(part));
    return least;
}

}  // namespace

Real Multifrontal::least_left() const noexcept {
    return least_of(doubles.least_left, singles.least_left);
}

Real Multifrontal::least_pivot() const noexcept {
    return least_of(doubles.least_pivot, singles.least_pivot);
}

Status Multifrontal::factorise(Matrix const& matrix, Progress const& progress,
                               Fault& fault) noexcept {
    if (precision == Precision::in_single) return factorise_in<float>(matrix, progress, fault);
    return factorise_in<double>(matrix, progress, fault);
}

}  // namespace harmorph
