// Finds nodes of a Gmsh file by their numbers, which are mostly 1 .. n, but need not be.
#pragma once

#include "mesh/mesh_file.hpp"

#include <algorithm>
#include <unordered_map>

namespace cli {

class GmshNodes {
public:
    // numbers, offsets: the numbers of the nodes in the order of the file, and their places.
    GmshNodes(const TextFile& file, const std::vector<std::int64_t>& numbers,
              const std::vector<std::size_t>& offsets)
        : file_(file) {
        std::int64_t largest = 0;
        for (const std::int64_t number : numbers) largest = std::max(largest, number);
        is_dense_ = largest <= static_cast<std::int64_t>(8 * numbers.size() + 1000);
        if (is_dense_) dense_.assign(static_cast<std::size_t>(largest) + 1, -1);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::int64_t number = numbers[i];
            if (number < 0)
                file.fail(offsets[i], "a node has the number " + std::to_string(number));
            std::int32_t& node = is_dense_ ? dense_[static_cast<std::size_t>(number)]
                                           : sparse_.emplace(number, -1).first->second;
            if (node != -1)
                file.fail(offsets[i], "two nodes have the number " + std::to_string(number));
            node = static_cast<std::int32_t>(i);
        }
    }

    // offset: the place of the element that names the node.
    std::int32_t find(std::int64_t number, std::size_t offset) const {
        std::int32_t node = -1;
        if (is_dense_) {
            if (number >= 0 && number < static_cast<std::int64_t>(dense_.size()))
                node = dense_[static_cast<std::size_t>(number)];
        } else {
            const auto found = sparse_.find(number);
            if (found != sparse_.end()) node = found->second;
        }
        if (node < 0)
            file_.fail(offset,
                       "an element has node " + std::to_string(number) + ", which does not exist");
        return node;
    }

private:
    const TextFile& file_;
    bool is_dense_ = false;
    std::vector<std::int32_t> dense_;  // -1: none
    std::unordered_map<std::int64_t, std::int32_t> sparse_;
};

}  // namespace cli
