// The mesh has the corners of elements of second order. The other nodes move with the corners: the
// middle of an edge keeps its distance from the straight edge, relative to the length and direction
// of the edge; the middle of a cell moves by the mean of the corners. In meshes one cell thick, the
// middle of an edge across moves with the point of the plane, and the middle of a face across moves
// as the middle of the edge in the plane.
#include "formats/element_mesh.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "mesh/one_cell_thick.hpp"
#include "mesh/tidy.hpp"

#include <algorithm>

namespace cli {

namespace {

class ElementMesh {
public:
    ElementMesh(Mesh& mesh, const Elements& all) : mesh_(mesh), all_(all) {}
    void build();

private:
    using Element = Elements::Element;
    enum Kind : std::int32_t { middle = -1, unused = -2, is_corner = -3, middle_added = -4 };

    std::size_t node(const Element& element, std::size_t k) const {
        return place(all_.nodes[element.first + k]);
    }
    std::int32_t corner(const Element& element, std::size_t k) const {
        return point_of_[node(element, k)];
    }
    bool is_read(const Element& element) const { return element.shape.dimension + 1 >= dimension_; }
    void find_dimension();
    void find_points();
    void add_flat();
    void add_solid();
    template <class Add>
    void for_each_middle(const Add& add);
    void remark_middles(std::size_t n);
    template <class Add>
    void for_each_marker(const Element& element, const Add& add);

    Mesh& mesh_;
    const Elements& all_;
    int dimension_ = 0;
    SpacePoints points_;                  // corners
    std::vector<std::int32_t> point_of_;  // the point of each node, or its Kind
};

void ElementMesh::find_dimension() {
    std::int64_t lines = 0;
    for (const Element& element : all_.elements) {
        dimension_ = std::max(dimension_, element.shape.dimension);
        lines += element.shape.dimension == 1 ? 1 : 0;
    }
    if (dimension_ >= 2) return;
    const std::string found = lines > 0 ? plural(lines, "line element") + " and " : "";
    mesh_.file.fail(mesh_.file.text().size(),
                    "the file has " + found +
                        "no triangles or quadrilaterals: mesh the surface and save its cells");
}

// Makes a point of each node that is a corner of an element which is read.
void ElementMesh::find_points() {
    point_of_.assign(place(all_.points.points()), unused);
    for (const Element& element : all_.elements) {
        if (!is_read(element)) continue;
        for (std::size_t k = 0; k < static_cast<std::size_t>(element.shape.nodes); ++k) {
            std::int32_t& kind = point_of_[node(element, k)];
            kind = static_cast<int>(k) < element.shape.corners ? is_corner
                   : kind == unused                            ? middle
                                                               : kind;
        }
    }
    points_.n_in_file = all_.points.points();
    for (std::size_t i = 0; i < point_of_.size(); ++i) {
        if (point_of_[i] != is_corner) continue;
        point_of_[i] = points_.points();
        points_.number.push_back(static_cast<std::int32_t>(i));
        for (std::size_t d = 0; d < 3; ++d) {
            points_.x[d].push_back(all_.points.x[d][i]);
            points_.offset[d].push_back(all_.points.offset[d][i]);
        }
    }
}

template <class Add>
void ElementMesh::for_each_marker(const Element& element, const Add& add) {
    if (element.group < 0) return;
    for (const std::string& name : all_.groups[place(element.group)]) add(mesh_.add_marker(name));
}

void ElementMesh::build() {
    find_dimension();
    find_points();
    dimension_ == 2 ? add_flat() : add_solid();
    join_double_faces(mesh_);
    name_open_boundary(mesh_, "boundary");
    mesh_.find_polygons();
}

void ElementMesh::add_flat() {
    take_flat(mesh_, points_, {});
    std::vector<std::int32_t> cell;
    for (const Element& element : all_.elements) {
        if (!is_read(element)) continue;
        cell.clear();
        for (std::size_t k = 0; k < static_cast<std::size_t>(element.shape.corners); ++k)
            cell.push_back(corner(element, k));
        if (element.shape.dimension == 2) {
            mesh_.add_cell(cell, element.offset);
        } else {
            for_each_marker(element, [&](std::int32_t marker) {
                mesh_.add_face(cell[0], cell[1], marker, element.offset);
            });
        }
    }
    for_each_middle([&](std::size_t middle_node, const std::vector<std::int32_t>& around) {
        const std::size_t* const axes = mesh_.in_file.axes;
        Between between = {{}, static_cast<std::int32_t>(around.size()), 0, 0};
        std::copy(around.begin(), around.end(), between.corners.begin());
        between.x = all_.points.x[axes[0]][middle_node];
        between.y = all_.points.x[axes[1]][middle_node];
        const auto point = static_cast<std::int32_t>(mesh_.x.size() + mesh_.in_file.between.size());
        mesh_.in_file.between.push_back(between);
        for (const std::size_t axis : {0u, 1u}) {
            mesh_.in_file.slots.push_back(
                {all_.points.offset[axes[axis]][middle_node], point, axis == 0 ? takes_x : takes_y,
                 static_cast<std::int64_t>(3 * middle_node + axes[axis])});
        }
    });
    remark_middles(mesh_.in_file.between.size());
}

void ElementMesh::add_solid() {
    OneCellThick solid(mesh_, std::move(points_));
    std::vector<std::int32_t> corners;
    for (const Element& element : all_.elements) {
        if (!is_read(element)) continue;
        const auto n = static_cast<std::size_t>(element.shape.corners);
        corners.clear();
        for (std::size_t k = 0; k < n; ++k) corners.push_back(corner(element, k));
        if (element.shape.dimension == 3) {
            solid.add_cell(corners.data(), n, element.offset);
        } else {
            for_each_marker(element, [&](std::int32_t marker) {
                solid.add_side(corners.data(), n, marker, element.offset);
            });
        }
    }
    std::size_t n_middles = 0;
    for_each_middle([&](std::size_t middle_node, const std::vector<std::int32_t>& around) {
        SpaceMiddle added = {around, {}, {}, static_cast<std::int32_t>(middle_node)};
        for (std::size_t d = 0; d < 3; ++d) {
            added.x[d] = all_.points.x[d][middle_node];
            added.offset[d] = all_.points.offset[d][middle_node];
        }
        solid.add_middle(std::move(added));
        ++n_middles;
    });
    solid.finish();
    remark_middles(n_middles);
}

// Calls add(node, points) once for each node that is no corner of any element; `points` are the
// corners of which the node is the middle.
template <class Add>
void ElementMesh::for_each_middle(const Add& add) {
    std::vector<std::int32_t> around;
    for (const Element& element : all_.elements) {
        if (!is_read(element)) continue;
        const char* corners = element.shape.middles;
        for (int k = element.shape.corners; k < element.shape.nodes; ++k) {
            around.clear();
            for (; *corners && *corners != ' '; ++corners)
                around.push_back(corner(element, static_cast<std::size_t>(*corners - '0')));
            if (*corners) ++corners;
            const std::size_t middle_node = node(element, static_cast<std::size_t>(k));
            if (point_of_[middle_node] != middle) continue;
            add(middle_node, around);
            point_of_[middle_node] = middle_added;
        }
    }
}

void ElementMesh::remark_middles(std::size_t n) {
    if (n == 0) return;
    mesh_.remark(
        "the mesh has the corners of quadratic elements; the nodes between move with them (" +
        plural(static_cast<std::int64_t>(n), "point") + "), and are not in a converted mesh");
}

}  // namespace

void build_mesh(Mesh& mesh, const Elements& elements) { ElementMesh(mesh, elements).build(); }

}  // namespace cli
