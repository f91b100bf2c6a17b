#include "mesh/boundary_loops.hpp"

#include "basics/place.hpp"

#include <algorithm>
#include <numeric>

namespace cli {

BoundaryLoops::BoundaryLoops(const std::vector<std::int32_t>& ends, std::int32_t n_points) {
    // The points of one loop have one root, which is the smallest of them.
    std::vector<std::int32_t> parent(place(n_points));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](std::int32_t point) {
        while (parent[place(point)] != point) {
            std::int32_t& up = parent[place(point)];
            point = up = parent[place(up)];
        }
        return point;
    };
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        const std::int32_t a = root(ends[i]), b = root(ends[i + 1]);
        parent[place(std::max(a, b))] = std::min(a, b);
    }
    std::vector<std::int32_t> number(place(n_points), -1);
    for (const std::int32_t point : ends) number[place(root(point))] = 0;
    for (std::int32_t& loop : number) {
        if (loop == 0) loop = count++;
    }
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
        of_edge.push_back(number[place(root(ends[i]))]);
}

}  // namespace cli
