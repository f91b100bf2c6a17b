// Rows of points become blocks of sixteen points in place.
#include <doctest/doctest.h>

#include "basis/point_blocks.hpp"

#include <vector>

using harmorph::Index;
using harmorph::Offset;

namespace {

double number_of(Index point, Index k) { return 1 + 1000.0 * point + k; }

// Rows side by side; what follows the last one is to be overwritten.
std::vector<double> rows(Index n_points, Index numbers) {
    std::vector<double> out(std::size_t(harmorph::whole_blocks(n_points) * numbers), -1);
    for (Index point = 0; point < n_points; ++point)
        for (Index k = 0; k < numbers; ++k)
            out[std::size_t(Offset{point} * numbers + k)] = number_of(point, k);
    return out;
}

}  // namespace

TEST_CASE("each number is found where the row says, and points behind the last one are 0") {
    for (Index const n_points : {0, 1, 15, 16, 17, 100, 16 * 1024 + 5})
        for (Index const numbers : {1, 2, 7, 8, 9, 40}) {
            if (n_points > 1000 && numbers > 9) continue;
            std::vector<double> values = rows(n_points, numbers);
            std::vector<double> work(std::size_t(harmorph::RowsToBlocks::work_numbers(numbers)));
            harmorph::RowsToBlocks{values.data(), n_points, numbers, {work.data(), work.size()}}
                .run({});
            Index wrong = 0;
            for (Index point = 0; point < harmorph::whole_blocks(n_points); ++point) {
                harmorph::RowInBlock<double> const row(values.data(), numbers, point);
                for (Index k = 0; k < numbers; ++k)
                    wrong += row[k] != (point < n_points ? number_of(point, k) : 0);
            }
            INFO(n_points << " points, " << numbers << " numbers");
            CHECK(wrong == 0);
        }
}
