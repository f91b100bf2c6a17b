#include "formats/cgns_conditions.hpp"

#ifdef HARMORPH_CGNS
#include "basics/numbers.hpp"
#include "mesh/tidy.hpp"

#include <algorithm>

namespace cli {

namespace {

std::pair<std::int32_t, std::int32_t> edge_of(std::int32_t a, std::int32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

template <class Visit>
void for_each(const std::vector<cgsize_t>& items, bool is_range, Visit visit) {
    if (!is_range) {
        for (const cgsize_t item : items) visit(item);
    } else if (items.size() == 2) {
        for (cgsize_t item = items[0]; item <= items[1]; ++item) visit(item);
    }
}

}  // namespace

void CgnsConditions::read() {
    find_open_edges();
    for (std::size_t z = 0; z < zones_.size(); ++z) add_conditions(z);
    mesh_.face_offset.resize(mesh_.face_markers.size());
    name_open_boundary(mesh_, "boundary");
}

std::int32_t CgnsConditions::point(const CgnsZone& zone, const char* condition,
                                   cgsize_t number) const {
    if (number < 1 || number > zone.n[0]) {
        cgns_.fail(in_zone(zone) + ": the boundary condition " + in_quotes(condition) +
                   " has point " + std::to_string(number) + ", but there are " +
                   plural(zone.n[0], "point"));
    }
    return static_cast<std::int32_t>(zone.first) + static_cast<std::int32_t>(number) - 1;
}

void CgnsConditions::find_open_edges() {
    std::map<Edge, int> cells;
    for (std::size_t cell = 0; cell + 1 < mesh_.cell_start.size(); ++cell) {
        const std::int32_t begin = mesh_.cell_start[cell], end = mesh_.cell_start[cell + 1];
        for (std::int32_t i = begin; i < end; ++i) {
            const std::int32_t a = mesh_.cell_points[static_cast<std::size_t>(i)];
            const std::int32_t b =
                mesh_.cell_points[static_cast<std::size_t>(i + 1 < end ? i + 1 : begin)];
            ++cells[edge_of(a, b)];
        }
    }
    for (const auto& edge : cells) {
        if (edge.second == 1) open_.insert(edge.first);
    }
}

void CgnsConditions::add_conditions(std::size_t z) {
    const int number = static_cast<int>(z) + 1;
    int n_conditions = 0;
    cgns_(cg_nbocos(cgns_.file, cgns_base, number, &n_conditions), in_zone(zones_[z]));
    for (int c = 1; c <= n_conditions; ++c) {
        char name[33] = "";
        BCType_t type;
        PointSetType_t set;
        GridLocation_t location = Vertex;
        cgsize_t n = 0, list_size = 0;
        DataType_t list_type;
        int normal_index[3], n_data = 0;
        const int status = cg_boco_info(cgns_.file, cgns_base, number, c, name, &type, &set, &n,
                                        normal_index, &list_size, &list_type, &n_data);
        cgns_(status, in_zone(zones_[z]) + ", boundary condition " + std::to_string(c));
        cgns_(cg_boco_gridlocation_read(cgns_.file, cgns_base, number, c, &location));
        if (n < 0 || static_cast<std::size_t>(n) > mesh_.file.text().size()) {
            cgns_.fail(in_zone(zones_[z]) + ": the boundary condition " + in_quotes(name) +
                       " has " + std::to_string(n) +
                       " points or elements, which the file cannot hold");
        }
        const std::size_t dimensions =
            zones_[z].is_structured ? static_cast<std::size_t>(cell_dimension_) : 1;
        std::vector<cgsize_t> items(static_cast<std::size_t>(n) * dimensions);
        std::vector<double> normals(static_cast<std::size_t>(std::max<cgsize_t>(list_size, 1)));
        cgns_(cg_boco_read(cgns_.file, cgns_base, number, c, items.data(),
                           list_size > 0 ? normals.data() : nullptr),
              in_zone(zones_[z]) + ", boundary condition " + in_quotes(name));
        if (set == ElementRange || set == ElementList)
            location = cell_dimension_ == 2 ? EdgeCenter : FaceCenter;
        const bool is_range = set == PointRange || set == ElementRange;
        if (zones_[z].is_structured) {
            std::size_t in_file = 0;
            const Points points =
                structured_points(zones_[z], items, dimensions, is_range, location, in_file);
            mark_points(name, points, in_file);
        } else if (location == Vertex) {
            Points points;
            std::size_t in_file = 0;
            for_each(items, is_range, [&](cgsize_t item) {
                points.insert(plane_point(point(zones_[z], name, item)));
                ++in_file;
            });
            mark_points(name, points, in_file);
        } else {
            for_each(items, is_range, [&](cgsize_t item) { mark_element(name, z, item); });
        }
    }
}

// Returns the points of a condition on a structured zone. A face has the indices of its first
// corner; the next points along the side also belong to the face.
CgnsConditions::Points CgnsConditions::structured_points(const CgnsZone& zone,
                                                         const std::vector<cgsize_t>& items,
                                                         std::size_t dimensions, bool is_range,
                                                         GridLocation_t location,
                                                         std::size_t& in_file) const {
    std::set<std::int32_t> points;
    const auto add = [&](const std::array<std::int64_t, 3>& index) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (index[d] < 1 || index[d] > zone.n[d]) {
                cgns_.fail(in_zone(zone) + ": a boundary condition has a point with the index " +
                           std::to_string(index[d]) + " of " + std::to_string(zone.n[d]));
            }
        }
        const std::int64_t line = index[1] - 1 + zone.n[1] * (index[2] - 1);
        const std::int64_t point =
            static_cast<std::int64_t>(zone.first) + index[0] - 1 + zone.n[0] * line;
        points.insert(plane_point(static_cast<std::int32_t>(point)));
        ++in_file;
    };
    std::array<std::int64_t, 3> low = {1, 1, 1}, high = {1, 1, 1};
    if (!is_range) {
        for (std::size_t k = 0; k + dimensions <= items.size(); k += dimensions) {
            for (std::size_t d = 0; d < dimensions; ++d) low[d] = items[k + d];
            add(low);
        }
        return points;
    }
    for (std::size_t d = 0; d < dimensions; ++d) {
        low[d] = std::min(items[d], items[d + dimensions]);
        high[d] = std::max(items[d], items[d + dimensions]);
        if (location != Vertex && low[d] != high[d]) ++high[d];
    }
    std::array<std::int64_t, 3> index = low;
    for (index[2] = low[2]; index[2] <= high[2]; ++index[2]) {
        for (index[1] = low[1]; index[1] <= high[1]; ++index[1]) {
            for (index[0] = low[0]; index[0] <= high[0]; ++index[0]) add(index);
        }
    }
    return points;
}

void CgnsConditions::mark(const std::string& name, Edge edge) {
    const auto found = open_.find(edge);
    if (found == open_.end()) return;
    mesh_.add_face(edge.first, edge.second, mesh_.add_marker(name), 0);
    open_.erase(found);
}

// Marks boundary edges with both ends among the points. A condition on a whole plane of a mesh one
// cell thick marks none, and no remark is made: the plane is no boundary of the mesh.
void CgnsConditions::mark_points(const std::string& name, const Points& points,
                                 std::size_t in_file) {
    const auto all = static_cast<std::size_t>(mesh_.points());
    if (cell_dimension_ == 3 && points.size() == all && in_file <= all) return;
    std::vector<Edge> edges;
    for (const Edge& edge : open_) {
        if (points.count(edge.first) > 0 && points.count(edge.second) > 0) edges.push_back(edge);
    }
    std::set<std::int32_t> ends;
    for (const Edge& edge : edges) ends.insert({edge.first, edge.second});
    if (ends.size() != points.size()) {
        mesh_.remark("the boundary condition " + in_quotes(name) + " has " +
                     (points.size() == all ? "all points of the mesh"
                                           : "points that are on no boundary edge without a "
                                             "condition") +
                     ", so it becomes no marker; the file keeps the condition");
        return;
    }
    for (const Edge& edge : edges) mark(name, edge);
}

void CgnsConditions::mark_element(const std::string& name, std::size_t z, cgsize_t number) {
    const auto found = sides_.find({z, number});
    if (found == sides_.end()) {
        cgns_.fail(in_zone(zones_[z]) + ": the boundary condition " + in_quotes(name) +
                   " names element " + std::to_string(number) +
                   ", which is no face of the boundary");
    }
    std::set<std::int32_t> ends;
    for (const std::int32_t corner : found->second) ends.insert(plane_point(corner));
    if (ends.size() == 2) mark(name, edge_of(*ends.begin(), *ends.rbegin()));
}

}  // namespace cli
#endif
