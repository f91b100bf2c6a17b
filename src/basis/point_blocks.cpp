#include "basis/point_blocks.hpp"

#include <cstring>

namespace harmorph {
namespace {

// Each task treats at least so many blocks.
constexpr Index min_task_blocks = 128;

// Eight numbers of eight points are moved at a time, so that few cache lines are written in turn.
void to_block(const Real* rows, Index n_points, Index numbers, Real* block) noexcept {
    constexpr Index tile = 8;
    for (Index first = 0; first < numbers; first += tile) {
        Index const end = min(first + tile, numbers);
        for (Index point = 0; point < n_points; ++point) {
            const Real* const row = rows + Offset{point} * numbers;
            for (Index k = first; k < end; ++k) block[Offset{k} * block_points + point] = row[k];
        }
        for (Index point = n_points; point < block_points; ++point) {
            for (Index k = first; k < end; ++k) block[Offset{k} * block_points + point] = 0;
        }
    }
}

void to_rows(const Real* block, Index n_points, Index numbers, Real* rows) noexcept {
    for (Index point = 0; point < n_points; ++point) {
        Real* const row = rows + Offset{point} * numbers;
        for (Index k = 0; k < numbers; ++k) row[k] = block[Offset{k} * block_points + point];
    }
}

}  // namespace

// Calls move(old numbers, points, numbers of a point, new place) for each block.
template <class Move>
void RowsToBlocks::for_each_block(Executor const& executor, Move const& move) const noexcept {
    Offset const size = Offset{block_points} * numbers;
    if (size == 0) return;
    Index const room =
        static_cast<Index>(min(static_cast<Offset>(work.size()) / size, Offset{max_tasks}));
    Index const blocks = blocks_of(n_points),
                tasks = clamp(blocks / min_task_blocks, Index{1}, room);
    auto const bound = [&](Index task) {
        return static_cast<Index>(Offset{blocks} * task / tasks);
    };
    executor.for_each(tasks, [&](Index task) {
        Real* const copied = work.data() + task * size;
        for (Index number = bound(task); number < bound(task + 1); ++number) {
            Real* const block = values + number * size;
            std::memcpy(copied, block, static_cast<Size>(size) * sizeof(Real));
            move(copied, min(block_points, n_points - number * block_points), numbers, block);
        }
    });
}

void RowsToBlocks::run(Executor const& executor) const noexcept {
    for_each_block(executor, to_block);
}

void RowsToBlocks::undo(Executor const& executor) const noexcept {
    for_each_block(executor, to_rows);
}

}  // namespace harmorph
