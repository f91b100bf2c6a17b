// The numbers that the points of a mesh have in its file. A mesh that is one cell thick is that of
// one plane, whose points are numbered anew, while tables of other programs, and the tables that
// this program writes, have the numbers of the file.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

class PointNumbers {
public:
    explicit PointNumbers(const Mesh& mesh);

    std::int64_t count() const { return count_; }  // of points in the file
    // Returns the point of the mesh that follows a point of the file, or -1 if there is none.
    std::int32_t point(std::int64_t number) const;
    // Returns the smallest number of a point in the file.
    std::int64_t number(std::int32_t point) const;
    // Says why a point of the file has no point of the mesh.
    std::string why_no_point(std::int64_t number) const;
    // Returns how many points of the file follow a point of the mesh.
    std::int32_t points_in_file(std::int32_t point) const;
    // Tells whether the points of the mesh are the first ones of the file, in the same order.
    bool are_those_of_mesh() const { return number_.empty(); }

private:
    std::int64_t count_;
    std::vector<std::int32_t> point_;      // empty: the same numbers
    std::vector<std::int64_t> number_;     // empty: the same numbers
    std::vector<std::int32_t> followers_;  // empty: one for each point
};

}  // namespace cli
