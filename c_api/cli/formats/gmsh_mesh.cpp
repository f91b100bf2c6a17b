// The mesh of a Gmsh file's nodes and elements.
//
// Of quadratic elements the mesh has the corners; the other nodes are written with it: the middle
// of an edge keeps its distance from the straight edge, relative to the edge's length and
// direction; the middle of a cell moves by the mean of the corners.
#include "formats/gmsh_content.hpp"

#include "formats/tidy.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <unordered_map>

namespace cli {

namespace {

class GmshMesh {
public:
    GmshMesh(Mesh& mesh, const GmshContent& content) : mesh_(mesh), content_(content) {}
    void build();

private:
    void index_nodes();
    std::size_t node_of(std::int64_t tag, std::size_t offset) const;
    std::int32_t corner(std::int64_t tag, std::size_t offset);
    void build_between();

    Mesh& mesh_;
    const GmshContent& content_;
    std::vector<std::int64_t> dense_;                        // node of a tag, -1: none
    std::unordered_map<std::int64_t, std::int64_t> sparse_;  // the same, if tags are far apart
    std::vector<std::int32_t> point_of_;                     // of a node; -1: no corner
};

// Tags are mostly 1 .. n, but need not be.
void GmshMesh::index_nodes() {
    std::int64_t largest = 0;
    for (const GmshNode& node : content_.nodes) largest = std::max(largest, node.tag);
    const bool is_dense = largest <= static_cast<std::int64_t>(8 * content_.nodes.size() + 1000);
    if (is_dense) dense_.assign(static_cast<std::size_t>(largest) + 1, -1);
    for (std::size_t i = 0; i < content_.nodes.size(); ++i) {
        const std::int64_t tag = content_.nodes[i].tag;
        const std::size_t offset = content_.nodes[i].x_offset;
        if (tag < 0) mesh_.file.fail(offset, "a node has the number " + std::to_string(tag));
        std::int64_t& place = is_dense ? dense_[static_cast<std::size_t>(tag)]
                                       : sparse_.emplace(tag, -1).first->second;
        if (place != -1)
            mesh_.file.fail(offset, "two nodes have the number " + std::to_string(tag));
        place = static_cast<std::int64_t>(i);
    }
}

std::size_t GmshMesh::node_of(std::int64_t tag, std::size_t offset) const {
    std::int64_t node = -1;
    if (!dense_.empty()) {
        if (tag >= 0 && tag < static_cast<std::int64_t>(dense_.size()))
            node = dense_[static_cast<std::size_t>(tag)];
    } else {
        const auto found = sparse_.find(tag);
        if (found != sparse_.end()) node = found->second;
    }
    if (node < 0)
        mesh_.file.fail(offset,
                        "an element has node " + std::to_string(tag) + ", which does not exist");
    return static_cast<std::size_t>(node);
}

std::int32_t GmshMesh::corner(std::int64_t tag, std::size_t offset) {
    return point_of_[node_of(tag, offset)];
}

// Points of the mesh are all nodes but those that are in the middle of edges and cells only.
void GmshMesh::build() {
    index_nodes();
    enum : std::int32_t { middle = -1, unused = -2, is_corner = -3 };
    point_of_.assign(content_.nodes.size(), unused);
    for (const GmshElement& element : content_.elements) {
        const std::int64_t* const nodes = content_.element_nodes.data() + element.first;
        for (int k = 0; k < element.type->nodes; ++k) {
            std::int32_t& kind = point_of_[node_of(nodes[k], element.offset)];
            kind = k < element.type->corners ? is_corner : kind == unused ? middle : kind;
        }
    }
    for (std::size_t i = 0; i < content_.nodes.size(); ++i) {
        if (point_of_[i] == middle) continue;
        point_of_[i] = mesh_.points();
        const GmshNode& node = content_.nodes[i];
        mesh_.add_point(node.x, node.y, node.x_offset, node.y_offset);
    }
    std::int32_t points[4] = {};
    std::vector<std::int32_t> cell;
    for (const GmshElement& element : content_.elements) {
        const auto n = static_cast<std::size_t>(element.type->corners);
        const std::int64_t* const nodes = content_.element_nodes.data() + element.first;
        for (std::size_t k = 0; k < n; ++k) points[k] = corner(nodes[k], element.offset);
        if (element.type->dimension == 1) {
            mesh_.add_face(points[0], points[1], element.marker, element.offset);
        } else {
            cell.assign(points, points + n);
            mesh_.add_cell(cell, element.offset);
        }
    }
    build_between();
    name_open_boundary(mesh_, "boundary");
}

void GmshMesh::build_between() {
    for (const GmshElement& element : content_.elements) {
        const auto corners = static_cast<std::size_t>(element.type->corners);
        const std::int64_t* const nodes = content_.element_nodes.data() + element.first;
        for (auto k = corners; k < static_cast<std::size_t>(element.type->nodes); ++k) {
            const std::size_t node = node_of(nodes[k], element.offset);
            if (point_of_[node] != -1) continue;  // a corner elsewhere, or done by a neighbour
            Between between = {{}, 2, content_.nodes[node].x, content_.nodes[node].y};
            const std::size_t edge = k - corners,
                              n_edges = element.type->dimension == 1 ? 1 : corners;
            if (edge < n_edges) {
                between.corners = {corner(nodes[edge], element.offset),
                                   corner(nodes[(edge + 1) % corners], element.offset)};
            } else {
                between.n_corners = static_cast<std::int32_t>(corners);
                for (std::size_t i = 0; i < corners; ++i)
                    between.corners[i] = corner(nodes[i], element.offset);
            }
            const auto number =
                static_cast<std::int32_t>(mesh_.x.size() + mesh_.in_file.between.size());
            mesh_.in_file.between.push_back(between);
            mesh_.in_file.slots.push_back({content_.nodes[node].x_offset, number, takes_x});
            mesh_.in_file.slots.push_back({content_.nodes[node].y_offset, number, takes_y});
            point_of_[node] = number;
        }
    }
    if (mesh_.in_file.between.empty()) return;
    mesh_.remark("quadratic elements: the mesh has their corners; points between move along (" +
                 plural(static_cast<std::int64_t>(mesh_.in_file.between.size()), "point") + ")");
}

}  // namespace

void build_gmsh_mesh(Mesh& mesh, const GmshContent& content) { GmshMesh(mesh, content).build(); }

}  // namespace cli
