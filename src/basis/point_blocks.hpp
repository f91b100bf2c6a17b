// The layout of the values of a basis in memory: blocks of 16 points. A block stores number after
// number, and for each number the values of the 16 points:
//
//   number k of point p:  value[((p / 16) * numbers + k) * 16 + p % 16]
//
// A product with movements reads one stream, loads whole registers, and adds up each point's
// products in the order of the numbers, in a lane of its own, for any width of the registers. All
// kernels therefore give the same bits. Places after the last point fill the last block; their
// values are 0.
#pragma once

#include "base/executor.hpp"
#include "base/span.hpp"
#include "base/types.hpp"

namespace harmorph {

inline constexpr Index block_points = 16;

// Returns the number of blocks that n_points fill; the last block may be incomplete.
constexpr Index blocks_of(Index n_points) noexcept {
    return (n_points + (block_points - 1)) / block_points;
}
constexpr Offset whole_blocks(Index n_points) noexcept {
    return Offset{blocks_of(n_points)} * block_points;
}

// The numbers of one point: row[k] is number k.
template <class Number>
class RowInBlock {
public:
    RowInBlock(Number* values, Index numbers, Index point) noexcept
        : first_(values + Offset{point / block_points} * numbers * block_points +
                 point % block_points) {}
    Number& operator[](Offset k) const noexcept { return first_[k * block_points]; }

private:
    Number* first_;
};

// Copies n numbers, to[k] = from[k]; either may be a row in a block, or a pointer.
template <class To, class From>
void copy_row(To to, From from, Index n) noexcept {
    for (Index k = 0; k < n; ++k) to[k] = from[k];
}

// Converts rows of n_points points, each with its numbers side by side, into blocks in the same
// memory. A block takes the memory of the rows of its points; `work` holds the rows that are being
// moved.
struct RowsToBlocks {
    static constexpr Index max_tasks = 8;
    static constexpr Offset work_numbers(Offset numbers) noexcept {
        return max_tasks * block_points * numbers;
    }

    Real* values;     // [whole_blocks(n_points) x numbers]
    Index n_points;   // Numbers after the last point are overwritten with 0.
    Index numbers;    // The numbers of a point.
    Span<Real> work;  // [work_numbers(numbers)] or fewer: at least block_points * numbers.

    void run(Executor const& executor) const noexcept;
    // Converts blocks into rows again. The memory after the last row is then undefined.
    void undo(Executor const& executor) const noexcept;

private:
    template <class Move>
    void for_each_block(Executor const& executor, Move const& move) const noexcept;
};

}  // namespace harmorph
