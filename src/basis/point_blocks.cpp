#include "harmorph/basis/point_blocks.hpp"

#include <cstring>

namespace harmorph {
namespace {

constexpr Index least_blocks = 512;  // that are worth a thread

// Eight numbers of eight points at a time: the lines of the cache that are written stay few.
void to_block(const Real* rows, Index n_points, Index numbers, Real* block) noexcept {
    constexpr Index tile = 8;
    for (Index first = 0; first < numbers; first += tile) {
        Index const end = smaller(first + tile, numbers);
        for (Index point = 0; point < n_points; ++point) {
            const Real* const row = rows + Offset{point} * numbers;
            for (Index k = first; k < end; ++k) block[Offset{k} * block_points + point] = row[k];
        }
        for (Index point = n_points; point < block_points; ++point) {
            for (Index k = first; k < end; ++k) block[Offset{k} * block_points + point] = 0;
        }
    }
}

}  // namespace

void RowsToBlocks::run(Executor const& executor) const noexcept {
    Index const blocks = blocks_of(n_points), tasks = clamp(blocks / least_blocks, Index{1}, most_tasks);
    Offset const size = Offset{block_points} * numbers;
    auto const bound = [&](Index task) { return static_cast<Index>(Offset{blocks} * task / tasks); };
    executor.for_each(tasks, [&](Index task) {
        Real* const rows = work + task * size;
        for (Index number = bound(task); number < bound(task + 1); ++number) {
            Real* const block = values + number * size;
            std::memcpy(rows, block, static_cast<Size>(size) * sizeof(Real));
            to_block(rows, smaller(block_points, n_points - number * block_points), numbers, block);
        }
    });
}

}  // namespace harmorph
