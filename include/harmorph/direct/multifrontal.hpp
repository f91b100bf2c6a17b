// The direct engine: multifrontal Cholesky on the assembly tree, and solves of all right-hand sides as one block.
// Source of the method: I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302.
#pragma once

#include "harmorph/dense/dense.hpp"
#include "harmorph/operators/matrix.hpp"
#include "harmorph/basis/options.hpp"
#include "harmorph/base/progress.hpp"
#include "harmorph/ordering/subtrees.hpp"

namespace harmorph {

// The numbers of a factorisation, one path down the tree at a time: a node's update matrix is made before its children run,
// so that each of them is added and forgotten at once.
//
//   stack:  |above the subtrees ... |kept: update matrices of the subtrees' roots|lane 0 ...|lane 1 ...|
//   rows:   the same with the right-hand sides of fronts instead of update matrices
template <class Number>
struct FrontalNumbers {
    Span<Number> factor;
    Span<Number> stack;
    Span<Number> rows;
    Span<Number> sums;     // [lanes x planes x most row sums of a front]
    Span<Number> least_left, least_pivot;  // [lanes] see below
};

struct Multifrontal {
    AssemblyTree tree;
    Subtrees subtrees;
    Span<Offset> border_start;  // [nodes + 1]
    Span<Index> border;
    Span<Offset> panel_start;   // [nodes + 1] in `factor`
    Span<Index> target;         // [lanes x largest border] where a border goes in the parent's front
    FrontalNumbers<double> doubles;  // these ...
    FrontalNumbers<float> singles;   // ... or those
    Precision precision = Precision::in_double;
    Index planes = 1;           // 1: real; 2: complex
    Index largest_border = 0;
    Offset most_sums = 0;
    Index padded_width = 0;
    Kernel kernel = Kernel::baseline;
    Executor executor;

    void lay_out(Arena& arena, Index nodes, FrontSizes const& sizes, Subtrees const& its_subtrees, Index width,
                 bool complex = false, Precision its_precision = Precision::in_double) noexcept;
    // Apart, because nobody needs it but factorise().
    void lay_out_stack(Arena& arena) noexcept;
    void place_panels() noexcept;

    // On Status::not_positive, fault.item is a position.
    Status factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept;
    // The least part that was left of what a pivot is summed of: 1 where nothing cancelled.
    Real least_left() const noexcept;
    // The least part that was left of a diagonal when its turn came.
    Real least_pivot() const noexcept;
    // In place: right-hand sides become solutions.
    Status solve(Rows const& values, Progress const& progress, Fault& fault) noexcept;
    // The same of a factor in single precision.
    Status solve(RowsOf<float> const& values, Progress const& progress, Fault& fault) noexcept;

    // What follows serves those two.
    template <class Number>
    struct Lane {
        Executor executor;  // inside fronts
        Number* stack;
        Number* rows;
        Number* sums;
        Number* least_left;
        Number* least_pivot;
        Index* targets;
    };
    template <class Number>
    Lane<Number> top_lane() const noexcept {  // above the subtrees, with all threads inside fronts
        FrontalNumbers<Number> const& its = numbers<Number>();
        return {executor, its.stack.data(), its.rows.data(), its.sums.data(), its.least_left.data(), its.least_pivot.data(),
                target.data()};
    }
    template <class Number>
    Lane<Number> lane(Index number) const noexcept {
        FrontalNumbers<Number> const& its = numbers<Number>();
        Offset const n = number, kept = subtrees.top_stack_entries + subtrees.kept_entries;
        return {Executor{},
                its.stack.data() + planes * (kept + n * subtrees.stack_entries),
                its.rows.data() + ((n + 1) * subtrees.stack_rows + subtrees.kept_rows) * row_length(),
                its.sums.data() + n * planes * most_sums,
                its.least_left.data() + n,
                its.least_pivot.data() + n,
                target.data() + n * largest_border};
    }
    // body(subtree, lane) for all subtrees, each lane's one after the other.
    template <class Number, class Body>
    void for_each_subtree(Body const& body) const noexcept {
        executor.for_each(subtrees.count > 0 ? subtrees.lanes : 0, [&](Index number) {
            Lane<Number> const its = lane<Number>(number);
            for (Subtree const& subtree : subtrees.all.first(subtrees.count)) {
                if (subtree.lane == number) body(subtree, its);
            }
        });
    }

    template <class Number>
    FrontalNumbers<Number> const& numbers() const noexcept;
    template <class Number>
    dense::Panel<Number> panel(Index node) const noexcept {
        return {numbers<Number>().factor.data() + panel_start[node], pivots_of(node), border_of(node).count(), planes};
    }
    template <class Number>
    Number* kept_update(Index subtree) const noexcept {
        return numbers<Number>().stack.data() + planes * (subtrees.top_stack_entries + subtrees.all[subtree].kept);
    }
    template <class Number>
    Number* kept_rows(Index subtree) const noexcept {
        return numbers<Number>().rows.data() + (subtrees.stack_rows + subtrees.all[subtree].kept_rows) * row_length();
    }
    // Room for a right-hand sides' row.
    Offset row_length() const noexcept { return Offset{planes} * padded_width; }
    Index pivots_of(Index node) const noexcept { return tree.nodes[node].pivots(); }
    Index front_of(Index node) const noexcept { return pivots_of(node) + border_of(node).count(); }
    Span<const Index> border_of(Index node) const noexcept {
        return border.from(border_start[node], border_start[node + 1] - border_start[node]);
    }
    // Where a child's border goes in its parent's front: increasing.
    void find_targets(Index child, Index parent, Index* targets) const noexcept;

private:
    template <class Number>
    void lay_out_numbers(Arena& arena, Offset factor_entries, FrontalNumbers<Number>& its) const noexcept;
    template <class Number>
    Status factorise_in(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept;
    template <class Number, class Value>
    Status solve_in(RowsOf<Value> const& values, Progress const& progress, Fault& fault) noexcept;
};

template <>
inline FrontalNumbers<double> const& Multifrontal::numbers<double>() const noexcept { return doubles; }
template <>
inline FrontalNumbers<float> const& Multifrontal::numbers<float>() const noexcept { return singles; }

}  // namespace harmorph
