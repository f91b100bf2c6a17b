// The direct engine: multifrontal Cholesky on the assembly tree, and solves of all right-hand sides as one block.
// Source of the method: I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302.
#pragma once

#include "harmorph/dense.hpp"
#include "harmorph/matrix.hpp"
#include "harmorph/progress.hpp"

namespace harmorph {

// Rows of numbers somewhere, one for each position: the functions' values at the unknowns' points.
struct Rows {
    Real* data = nullptr;
    const Index* row_of = nullptr;  // [n] row of each position, or null: its number
    Offset row_length = 0;          // numbers from one row to the next
    Index width = 0;                // right-hand sides

    Real* operator[](Index position) const noexcept {
        return data + (row_of != nullptr ? row_of[position] : position) * row_length;
    }
};

struct Multifrontal {
    AssemblyTree tree;
    Span<Offset> border_start;  // [nodes + 1]
    Span<Index> border;
    Span<Offset> panel_start;   // [nodes + 1] in `factor`
    Span<Real> factor;
    Span<Real> stack;           // update matrices of one path down the tree
    Span<Index> target;         // [largest border] where a border goes in the parent's front
    Span<Index> run_end;        // [largest border] first border behind the run of neighbouring targets
    Span<Real> packing;         // [dense::packing_entries]
    Kernel kernel = Kernel::baseline;
    Span<Real> rows;            // [largest front x padded width] right-hand sides of one front

    void lay_out(Arena& arena, Index nodes, FrontSizes const& sizes, Index width) noexcept;
    // Apart, because nobody needs it but factorise().
    void lay_out_stack(Arena& arena, FrontSizes const& sizes) noexcept { arena.take(stack, sizes.stack_entries); }
    void place_panels() noexcept;

    // On Status::not_positive, fault.item is a position.
    Status factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept;
    // In place: right-hand sides become solutions.
    Status solve(Rows const& values, Progress const& progress, Fault& fault) noexcept;

    dense::Panel panel(Index node) const noexcept;
    Span<const Index> border_of(Index node) const noexcept {
        return border.from(border_start[node], border_start[node + 1] - border_start[node]);
    }
};

}  // namespace harmorph
