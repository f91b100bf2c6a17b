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
    Lock lock;
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
        lock.run([&] { take_first(subtree_fault, fault); });
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

namespace {

constexpr Index nodes_between_solve_reports = 512;

// Right-hand sides go up the tree like update matrices, and solutions come down; a row has the
// numbers of all functions.
class Substitution {
public:
    using Worker = Multifrontal::Worker;
    using Panel = dense::Panel;

    Substitution(Multifrontal const& engine, Rows const& values) noexcept
        : engine_(engine),
          values_(values),
          width_(dense::padded(values.width)),
          row_(engine.planes * width_) {}

    // Returns the number of numbers in the right-hand sides of a front.
    Offset entries(Index node) const noexcept { return Offset{engine_.front_of(node)} * row_; }

    // Forward substitution U^H y = b in place. `front` receives the right-hand sides of the node:
    // first the rows of the pivots, then the updates for the rows of the border. Most nodes are far
    // from all known values. If all right-hand sides of a subtree are 0, nothing is computed,
    // is_zero of the node is set, and the content of `front` is undefined.
    template <class Report>
    Status forward(Index node, Real* front, Real* free, Worker const& worker,
                   Report const& report) const noexcept {
        auto const& own = engine_.tree.nodes[node];
        Panel const panel = engine_.panel(node);
        Index const behind = engine_.tree.nodes[engine_.tree.count - 1].end - own.end;
        dense::gather(engine_.kernel, values_, own.begin, panel.pivots, behind, front, width_,
                      engine_.planes);
        Span<Real> const pivots(front, static_cast<Size>(Offset{panel.pivots} * row_));
        Span<Real> const border(front + pivots.size(),
                                static_cast<Size>(Offset{panel.border} * row_));
        bool is_zero = all_zero(pivots);
        if (!is_zero) fill(border, Real{0});
        for (Index child = own.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            Real* const from = done != none ? engine_.kept_rows(done) : free;
            if (done == none)
                HARMORPH_TRY(forward(child, free, free + entries(child), worker, report));
            if (engine_.is_zero[child]) continue;
            if (is_zero) fill(border, Real{0});
            is_zero = false;
            dense::add_rows(engine_.kernel, engine_.border_of(child).count(),
                            border_rows(child, from), engine_.targets_of(child), front, row_);
        }
        engine_.is_zero[node] = is_zero;
        if (is_zero) return report(node);
        dense::solve_forward(engine_.kernel, panel, front, width_, worker.executor);
        dense::scatter(engine_.kernel, front, width_, engine_.planes, values_, own.begin,
                       panel.pivots);
        return report(node);
    }

    // Back substitution U x = y in place, for the node and its descendants except those in
    // subtrees, whose fronts are left ready for back substitution. `front` has the rows of the
    // node; those of the border are known.
    template <class Report>
    Status backward(Index node, Real* front, Real* free, Worker const& worker,
                    Report const& report) const noexcept {
        auto const& own = engine_.tree.nodes[node];
        Panel const panel = engine_.panel(node);
        if (engine_.is_zero[node]) {
            fill(Span<Real>(front, static_cast<Size>(Offset{panel.pivots} * row_)), Real{0});
        } else {
            dense::gather(engine_.kernel, values_, own.begin, panel.pivots, 0, front, width_,
                          engine_.planes);
        }
        dense::solve_backward(engine_.kernel, panel, front, width_, worker.executor);
        dense::scatter(engine_.kernel, front, width_, engine_.planes, values_, own.begin,
                       panel.pivots);
        HARMORPH_TRY(report(node));
        return backward_below(own.child, front, free, worker, report);
    }

private:
    // Children are visited from the last to the first, so that panels are read from the end of the
    // factor to the beginning.
    template <class Report>
    Status backward_below(Index child, const Real* front, Real* free, Worker const& worker,
                          Report const& report) const noexcept {
        if (child == none) return Status::ok;
        HARMORPH_TRY(
            backward_below(engine_.tree.nodes[child].sibling, front, free, worker, report));
        Index const done = engine_.subtrees.find(child);
        Real* const to = done != none ? engine_.kept_rows(done) : free;
        dense::copy_rows(engine_.kernel, engine_.border_of(child).count(), front,
                         engine_.targets_of(child), border_rows(child, to), row_);
        return done != none ? Status::ok
                            : backward(child, to, free + entries(child), worker, report);
    }

    template <class AnyNumber>
    AnyNumber* border_rows(Index node, AnyNumber* front) const noexcept {
        return front + Offset{engine_.pivots_of(node)} * row_;
    }

    static bool all_zero(Span<const Real> numbers) noexcept {
        constexpr Size at_once = 64;  // So many numbers are tested without a branch in between.
        for (Size begin = 0; begin < numbers.size(); begin += at_once) {
            bool any = false;
            for (Real const number : numbers.from(begin, min(at_once, numbers.size() - begin))) {
                any |= number != 0;
            }
            if (any) return false;
        }
        return true;
    }

    Multifrontal const& engine_;
    Rows const& values_;
    Index width_, row_;  // The numbers in a row of one plane, and of all planes.
};

}  // namespace

Status Multifrontal::solve(Rows const& values, Progress const& progress, Fault& fault) noexcept {
    Substitution const substitution(*this, values);
    Index done = 0;
    auto const report = [&](Index) {
        if (++done % nodes_between_solve_reports != 0) return Status::ok;
        return progress.report(Phase::solve, static_cast<Real>(done) / (2.0 * tree.count + 1),
                               fault);
    };
    Worker const worker = top_worker();
    for_each_subtree([&](Index subtree, Worker const& own) {
        substitution.forward(subtrees.all[subtree].root, kept_rows(subtree), own.rows, own,
                             [](Index) { return Status::ok; });
    });
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(substitution.forward(
            node, worker.rows, worker.rows + substitution.entries(node), worker, report));
    }
    for (Index node = tree.count - 1; node >= 0; --node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(substitution.backward(
            node, worker.rows, worker.rows + substitution.entries(node), worker, report));
    }
    for_each_subtree([&](Index subtree, Worker const& own) {
        substitution.backward(subtrees.all[subtree].root, kept_rows(subtree), own.rows, own,
                              [](Index) { return Status::ok; });
    });
    return Status::ok;
}

}  // namespace harmorph
