// The direct engine: multifrontal Cholesky on the assembly tree, and solves of all right-hand sides as one block.
// Source of the method: I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302.
#pragma once

#include "harmorph/dense.hpp"
#include "harmorph/matrix.hpp"
#include "harmorph/progress.hpp"
#include "harmorph/rows.hpp"
#include "harmorph/subtrees.hpp"

namespace harmorph {

// Memory of a factorisation, one path down the tree at a time: a node's update matrix is made before its children run, so
// that each of them is added and forgotten at once.
//
//   stack:  |above the subtrees ... |kept: update matrices of the subtrees' roots|lane 0 ...|lane 1 ...|
//   rows:   the same with the right-hand sides of fronts instead of update matrices
struct Multifrontal {
    AssemblyTree tree;
    Subtrees subtrees;
    Span<Offset> border_start;  // [nodes + 1]
    Span<Index> border;
    Span<Offset> panel_start;   // [nodes + 1] in `factor`
    Span<Real> factor;
    Span<Real> stack;
    Span<Real> rows;
    Span<Index> target;         // [lanes x largest border] where a border goes in the parent's front
    Span<Index> run_end;        // [lanes x largest border] first border behind the run of neighbouring targets
    Span<Real> packing;         // [lanes x dense::packing_entries]
    Index largest_border = 0;
    Index padded_width = 0;
    Kernel kernel = Kernel::baseline;
    Executor executor;

    void lay_out(Arena& arena, Index nodes, FrontSizes const& sizes, Subtrees const& its_subtrees, Index width) noexcept;
    // Apart, because nobody needs it but factorise().
    void lay_out_stack(Arena& arena) noexcept;
    void place_panels() noexcept;

    // On Status::not_positive, fault.item is a position.
    Status factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept;
    // In place: right-hand sides become solutions.
    Status solve(Rows const& values, Progress const& progress, Fault& fault) noexcept;

    // What follows serves those two.
    struct Lane {
        Executor executor;  // inside fronts
        Real* stack;
        Real* rows;
        Real* packing;
        Index* target;
        Index* run_end;
    };
    Lane top_lane() const noexcept;  // above the subtrees, with all threads inside fronts
    Lane lane(Index number) const noexcept;
    // body(subtree, lane) for all subtrees, each lane's one after the other.
    template <class Body>
    void for_each_subtree(Body const& body) const noexcept {
        executor.for_each(subtrees.count > 0 ? subtrees.lanes : 0, [&](Index number) {
            Lane const its = lane(number);
            for (Subtree const& subtree : subtrees.all.first(subtrees.count)) {
                if (subtree.lane == number) body(subtree, its);
            }
        });
    }

    dense::Panel panel(Index node) const noexcept;
    Span<const Index> border_of(Index node) const noexcept {
        return border.from(border_start[node], border_start[node + 1] - border_start[node]);
    }
    // Where a child's border goes in its parent's front: lane.target, and the runs of neighbours there.
    void find_targets(Index child, Index parent, Lane const& lane) const noexcept;
    Real* kept_update(Index subtree) const noexcept {
        return stack.data() + subtrees.top_stack_entries + subtrees.all[subtree].kept;
    }
    Real* kept_rows(Index subtree) const noexcept {
        return rows.data() + (subtrees.stack_rows + subtrees.all[subtree].kept_rows) * padded_width;
    }
};

}  // namespace harmorph
