// The direct engine: multifrontal Cholesky on the assembly tree, and solves of all right-hand sides
// as one block. Source of the method: I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302.
// tests/direct/test_multifrontal.cpp covers this file,
// too.
#pragma once

#include "base/executor.hpp"
#include "basis/options.hpp"
#include "dense/dense.hpp"
#include "operators/matrix.hpp"
#include "ordering/subtrees.hpp"

namespace harmorph {

// The numbers of a factorisation. The tree is visited one path at a time: the update matrix of a
// node exists before its children are factored, so that the update matrix of a child is added
// (extend-add) and released at once.
//
//   stack: nodes above the subtrees | update matrices of the subtrees' roots | worker 0 | worker 1
//   ...
//
// `rows` has the same layout, with right-hand sides of fronts instead of update matrices. A worker
// is a task that takes one subtree after the other.
struct FrontalNumbers {
    Span<Real> factor;
    Span<Real> stack;
    Span<Real> rows;
    Span<Real> sums;  // [workers x planes x largest number of row sums of a front]
    Span<Real> min_pivot_ratio,
        min_pivot_to_diagonal;  // [workers] See the functions of these names below.
};

struct Multifrontal {
    AssemblyTree tree;
    Subtrees subtrees;
    Span<Offset> border_start;  // [nodes + 1]
    Span<Index> border;
    Span<Offset> panel_start;  // [nodes + 1] Positions in `factor`.
    Span<bool> is_zero;  // [nodes] All current right-hand sides are 0 in the subtree of the node.
    // [as border] The positions of a border in the parent's front, increasing.
    Span<Index> target;
    FrontalNumbers numbers;
    Index planes = 1;  // 1 means real, 2 means complex.
    Offset max_sums = 0;
    Index padded_width = 0;
    Kernel kernel = Kernel::baseline;
    Executor executor;

    void lay_out(Arena& arena, Index nodes, FrontSizes const& sizes,
                 Subtrees const& chosen_subtrees, Index width, bool complex = false) noexcept;
    // The stack is laid out apart, because only factorise() needs it.
    void lay_out_stack(Arena& arena) noexcept;
    // Fills panel_start and target. The tree, border_start and border must have been filled.
    void complete() noexcept;

    // On Status::not_positive, fault.item is a position of the elimination.
    Status factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept;
    // Returns the minimum over all pivots of |sum of the terms| / sum of |terms|, which is 1 if
    // nothing cancelled.
    Real min_pivot_ratio() const noexcept;
    // Returns the minimum over all pivots of pivot / diagonal of the matrix.
    Real min_pivot_to_diagonal() const noexcept;
    // Replaces right-hand sides by solutions in place.
    Status solve(Rows const& values, Progress const& progress, Fault& fault) noexcept;

    // The members below serve factorise() and solve(). Worker has the working arrays of one worker.
    struct Worker {
        Executor executor;  // The threads work inside fronts.
        Real* stack;
        Real* rows;
        Real* sums;
        Real* min_pivot_ratio;
        Real* min_pivot_to_diagonal;
    };
    // Returns the worker for the nodes above the subtrees: all threads work inside one front.
    Worker top_worker() const noexcept {
        FrontalNumbers const& all = numbers;
        return {executor,        all.stack.data(),           all.rows.data(),
                all.sums.data(), all.min_pivot_ratio.data(), all.min_pivot_to_diagonal.data()};
    }
    Worker worker(Index number) const noexcept {
        FrontalNumbers const& all = numbers;
        Offset const n = number, before = subtrees.top_stack_entries + subtrees.kept_entries;
        return {
            Executor{},
            all.stack.data() + planes * (before + n * subtrees.stack_entries),
            all.rows.data() + ((n + 1) * subtrees.stack_rows + subtrees.kept_rows) * row_length(),
            all.sums.data() + n * planes * max_sums,
            all.min_pivot_ratio.data() + n,
            all.min_pivot_to_diagonal.data() + n};
    }
    // Calls body(number of the subtree, worker) for all subtrees. Subtrees with
    // the most work come first, and each goes to the worker that is free next.
    template <class Body>
    void for_each_subtree(Body const& body) const noexcept {
        NextItem next;
        executor.for_each(subtrees.count > 0 ? sharing(subtrees.workers) : 0, [&](Index number) {
            Worker const own = worker(number);
            for (Index k = next.take(); k < subtrees.count; k = next.take())
                body(subtrees.all[k].by_work, own);
        });
    }

    dense::Panel panel(Index node) const noexcept {
        return {numbers.factor.data() + panel_start[node], pivots_of(node), border_of(node).count(),
                planes};
    }
    Real* kept_update(Index subtree) const noexcept {
        return numbers.stack.data() +
               planes * (subtrees.top_stack_entries + subtrees.all[subtree].kept);
    }
    Real* kept_rows(Index subtree) const noexcept {
        return numbers.rows.data() +
               (subtrees.stack_rows + subtrees.all[subtree].kept_rows) * row_length();
    }
    // Returns the number of numbers in a row of right-hand sides, including padding.
    Offset row_length() const noexcept { return Offset{planes} * padded_width; }
    Index pivots_of(Index node) const noexcept { return tree.nodes[node].pivots(); }
    Index front_of(Index node) const noexcept { return pivots_of(node) + border_of(node).count(); }
    Span<const Index> border_of(Index node) const noexcept {
        return border.from(border_start[node], border_start[node + 1] - border_start[node]);
    }
    const Index* targets_of(Index node) const noexcept {
        return target.data() + border_start[node];
    }

private:
    void find_targets(Index child, Index parent) noexcept;
};

}  // namespace harmorph
