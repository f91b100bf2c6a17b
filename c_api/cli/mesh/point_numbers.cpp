#include "mesh/point_numbers.hpp"

#include "basics/geometry.hpp"

namespace cli {

PointNumbers::PointNumbers(const Mesh& mesh) : count_(mesh.points()) {
    const auto n = static_cast<std::size_t>(mesh.in_file.n_points);
    if (n <= mesh.x.size()) return;
    count_ = mesh.in_file.n_points;
    point_.assign(n, -1);
    number_.assign(mesh.x.size(), -1);
    followers_.assign(mesh.x.size(), 0);
    for (const CoordinateSlot& slot : mesh.in_file.slots) {
        if (slot.number < 0 || slot.point >= mesh.points()) continue;
        const std::int64_t number = slot.number / 3;
        std::int32_t& followed = point_[static_cast<std::size_t>(number)];
        if (followed < 0) ++followers_[place(slot.point)];
        followed = slot.point;
        std::int64_t& smallest = number_[place(slot.point)];
        if (smallest < 0 || number < smallest) smallest = number;
    }
    bool same = true;
    for (std::size_t point = 0; point < number_.size(); ++point)
        same = same && number_[point] == static_cast<std::int64_t>(point);
    if (same) number_.clear();
}

std::int32_t PointNumbers::point(std::int64_t number) const {
    if (number < 0 || number >= count_) return -1;
    return point_.empty() ? static_cast<std::int32_t>(number)
                          : point_[static_cast<std::size_t>(number)];
}

std::string PointNumbers::why_no_point(std::int64_t number) const {
    const std::string name = "point " + std::to_string(number);
    if (number >= 0 && number < count_) return name + " of the mesh file is no corner of a cell";
    return "the mesh file has points 0 to " + std::to_string(count_ - 1) + ", and no " + name;
}

std::int32_t PointNumbers::points_in_file(std::int32_t point) const {
    return followers_.empty() ? 1 : followers_[place(point)];
}

std::int64_t PointNumbers::number(std::int32_t point) const {
    return number_.empty() ? point : number_[place(point)];
}

}  // namespace cli
