// How the values of a basis lie in memory: in blocks of 16 points; inside a block the numbers in
// turn, of each number those of the 16 points.
//
//   number k of point p:  value[((p / 16) * numbers + k) * 16 + p % 16]
//
// A product with movements reads one stream, loads whole registers, and adds up each point's
// products in the order of the numbers in a lane of its own, whatever the width of the registers:
// all kernels give the same bits. Points behind the last one fill the last block; their values are
// 0.
#pragma once

#include "base/executor.hpp"
#include "base/span.hpp"
#include "base/types.hpp"

namespace harmorph {

inline constexpr Index block_points = 16;

// Blocks that n_points fill, the last one perhaps in part.
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

// to[k] = from[k] of n numbers; either may be a row in a block, or a pointer.
template <class To, class From>
void copy_row(To to, From from, Index n) noexcept {
    for (Index k = 0; k < n; ++k) to[k] = from[k];
}

// Rows of n_points points, each with its numbers side by side, become blocks in the same memory. A
// block takes the memory of the rows of its points, of which `work` holds those that are being
// moved.
struct RowsToBlocks {
    static constexpr Index most_tasks = 8;
    static constexpr Offset work_numbers(Offset numbers) noexcept {
        return most_tasks * block_points * numbers;
    }

    Real* values;     // [whole_blocks(n_points) x numbers]
    Index n_points;   // numbers behind the last point are overwritten with 0
    Index numbers;    // of a point
    Span<Real> work;  // [work_numbers(numbers)], or a part of that: at least block_points * numbers

    void run(Executor const& executor) const noexcept;
    // Blocks become rows again. What lies behind the last row is not defined.
    void undo(Executor const& executor) const noexcept;

private:
    template <class Move>
    void for_each_block(Executor const& executor, Move const& move) const noexcept;
};

}  // namespace harmorph
