#include "formats/nmf.hpp"

#include "basics/numbers.hpp"
#include "files/text_file.hpp"

#include <algorithm>

namespace cli {

namespace {

// The two directions along a side, in the order of the file.
struct FaceSide {
    int direction, first, second;
};
constexpr FaceSide face_sides[] = {
    {2, 0, 1}, {0, 1, 2}, {1, 2, 0}};  // faces 1 and 2: k; 3 and 4: i; 5 and 6: j

}  // namespace

std::vector<NmfPatch> read_nmf(const std::string& path,
                               const std::vector<std::array<std::int64_t, 3>>& sizes) {
    const TextFile file(path);
    LineReader lines(file, '#');
    const auto number = [&lines](std::size_t at, std::int64_t low, std::int64_t high,
                                 const char* what) {
        std::int64_t value = 0;
        const auto& words = lines.words();
        const std::string wanted =
            std::string(what) + " between " + std::to_string(low) + " and " + std::to_string(high);
        if (at >= words.size()) lines.expected(wanted);
        if (!parse(words[at], value) || value < low || value > high)
            lines.expected(wanted, words[at]);
        return value;
    };
    const auto n_blocks = static_cast<std::int64_t>(sizes.size());
    if (!lines.next()) lines.expected("the number of blocks");
    number(0, n_blocks, n_blocks, "the number of blocks");
    for (const auto& size : sizes) {
        if (!lines.next()) lines.expected("a block and its sizes");
        for (std::size_t d = 0; d < 3; ++d)
            number(d + 1, size[d], size[d], "the size of the block");
    }
    std::vector<NmfPatch> patches;
    while (lines.next()) {
        NmfPatch patch = {};
        patch.name = lines.words()[0];
        patch.block = static_cast<std::size_t>(number(1, 1, n_blocks, "a block") - 1);
        const std::int64_t face = number(2, 1, 6, "a face");
        const FaceSide& side = face_sides[(face - 1) / 2];
        const auto& size = sizes[patch.block];
        patch.direction = side.direction;
        patch.at_end = face % 2 == 0;
        const auto across = static_cast<std::size_t>(side.direction);
        patch.low[across] = patch.high[across] = patch.at_end ? size[across] - 1 : 0;
        std::size_t at = 3;
        for (const int along : {side.first, side.second}) {
            const auto d = static_cast<std::size_t>(along);
            const std::int64_t a = number(at, 1, size[d], "an index") - 1,
                               b = number(at + 1, 1, size[d], "an index") - 1;
            patch.low[d] = std::min(a, b);
            patch.high[d] = std::max(a, b);
            at += 2;
        }
        std::string type = patch.name;
        std::transform(type.begin(), type.end(), type.begin(),
                       [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
        if (type != "ONE_TO_ONE" && type != "ONE-TO-ONE") patches.push_back(patch);
    }
    return patches;
}

}  // namespace cli
