#include "formats/cgns_read.hpp"

#include "formats/cgns_file.hpp"
#include "mesh/tidy.hpp"

#include <map>
#include <set>

#ifdef HARMORPH_CGNS
#include "basics/numbers.hpp"
#include "formats/deflate.hpp"
#include "mesh/one_cell_thick.hpp"

#include <algorithm>
#include <cstring>
#include <memory>

namespace cli {

namespace {

// Boundary conditions of a CGNS file become markers of the mesh of the plane. This source is
// compiled by `make CGNS=1` only.

// The points of elements of the boundary, by zone and number.
using CgnsSides = std::map<std::pair<std::size_t, cgsize_t>, std::vector<std::int32_t>>;

class CgnsConditions {
public:
    // plane_point: for each point of the file, the point of the mesh with whose coordinates it
    // moves.
    CgnsConditions(Mesh& mesh, const Cgns& cgns, const std::vector<CgnsZone>& zones,
                   int cell_dimension, std::vector<std::int32_t> plane_point,
                   const CgnsSides& sides)
        : mesh_(mesh),
          cgns_(cgns),
          zones_(zones),
          cell_dimension_(cell_dimension),
          plane_point_(std::move(plane_point)),
          sides_(sides) {}

    void read();  // adds faces and markers to the mesh, which has its cells

private:
    using Edge = std::pair<std::int32_t, std::int32_t>;
    using Points = std::set<std::int32_t>;  // points of the mesh

    void find_open_edges();
    void add_conditions(std::size_t z);
    Points structured_points(const CgnsZone& zone, const std::vector<cgsize_t>& items,
                             std::size_t dimensions, bool is_range, GridLocation_t location,
                             std::size_t& in_file) const;
    std::int32_t point(const CgnsZone& zone, const char* condition, cgsize_t number) const;
    std::int32_t plane_point(std::int32_t point) const {
        return plane_point_[static_cast<std::size_t>(point)];
    }
    void mark(const std::string& name, Edge edge);
    void mark_points(const std::string& name, const Points& points,
                     std::size_t in_file);  // in_file: number of points of the condition
    void mark_element(const std::string& name, std::size_t z, cgsize_t number);

    Mesh& mesh_;
    const Cgns& cgns_;
    const std::vector<CgnsZone>& zones_;
    int cell_dimension_;
    std::vector<std::int32_t> plane_point_;
    const CgnsSides& sides_;
    std::set<Edge> open_;  // boundary edges without a marker
};

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

class CgnsReader {
public:
    explicit CgnsReader(Mesh& mesh)
        : mesh_(mesh), cgns_(mesh.file.path(), CG_MODE_READ, mesh.file.path()) {}

    void read() {
        file_size_ = mesh_.file.text().size();
        zones_ = read_zones(cgns_, file_size_, cell_dimension_);
        read_points();
        if (cell_dimension_ == 2) {
            take_flat(mesh_, space_, {});
        } else {
            solid_ = std::make_unique<OneCellThick>(mesh_, space_);
        }
        for (std::size_t z = 0; z < zones_.size(); ++z) {
            if (zones_[z].is_structured) {
                add_structured(zones_[z]);
            } else {
                add_sections(z);
            }
        }
        if (solid_) {
            solid_->finish();
            solid_.reset();
        }
        mesh_.find_polygons();
        CgnsConditions(mesh_, cgns_, zones_, cell_dimension_, find_plane_points(), sides_).read();
    }

private:
    // Names a coordinate by its number in the order all x, all y, all z of n points: "zone 'a',
    // point 12, CoordinateX".
    static std::string place(const std::vector<CgnsZone>& zones, std::size_t n,
                             std::size_t number) {
        std::size_t z = zones.size() - 1;
        while (zones[z].first > number % n) --z;
        return zones[z].point(number % n - zones[z].first) + ", Coordinate" + "XYZ"[number / n % 3];
    }

    void read_points() {
        const std::size_t n = zones_.back().first + zones_.back().points();
        for (auto& values : space_.x) values.assign(n, 0.0);
        bool all_single = true;
        std::size_t dimensions = 2;
        for (std::size_t z = 0; z < zones_.size(); ++z) {
            const int number = static_cast<int>(z) + 1;
            cgsize_t low[3], high[3];
            whole_range(zones_[z], low, high);
            std::size_t d = 0;
            for (const CgnsArray& array : read_arrays(cgns_, number, in_zone(zones_[z]))) {
                double* const to = space_.x[d++].data() + zones_[z].first;
                cgns_(cg_coord_read(cgns_.file, cgns_base, number, array.name.c_str(), RealDouble,
                                    low, high, to),
                      in_zone(zones_[z]) + ", " + array.name);
                all_single = all_single && array.type == RealSingle;
            }
            dimensions = std::max(dimensions, d);
        }
        const std::size_t bytes = all_single ? 4 : 8;
        std::string numbers(dimensions * n * bytes, '\0');
        for (std::size_t d = 0; d < dimensions; ++d) {
            for (std::size_t k = 0; k < n; ++k) {
                const double value = space_.x[d][k];
                const float single = static_cast<float>(value);
                if (!(value - value == 0))
                    cgns_.fail(place(zones_, n, (d * n + k)) + " is not finite");
                const void* const from = all_single ? static_cast<const void*>(&single) : &value;
                std::memcpy(&numbers[(d * n + k) * bytes], from, bytes);
            }
        }
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t k = 0; k < n; ++k) space_.offset[d].push_back((d * n + k) * bytes);
        }
        mesh_.file = TextFile(mesh_.file.path(), std::move(numbers));
        mesh_.file.name_places([zones = zones_, n, bytes](std::size_t offset) {
            return place(zones, n, offset / bytes);
        });
        mesh_.in_file.kind = all_single ? NumberKind::real32 : NumberKind::real64;
        mesh_.in_file.store = store_cgns;
        mesh_.in_file.swapped = false;
        bytes_ = bytes;
    }

    void add_cell(const std::vector<std::int32_t>& points) {
        const std::size_t offset = space_.offset[0][static_cast<std::size_t>(points[0])];
        if (solid_) {
            solid_->add_cell(points.data(), points.size(), offset);
        } else {
            mesh_.add_cell(points, offset);
        }
    }

    void add_structured(const CgnsZone& zone) {
        const auto at = [&zone](std::int64_t i, std::int64_t j, std::int64_t k) {
            const std::int64_t line = j + zone.n[1] * k;
            return static_cast<std::int32_t>(static_cast<std::int64_t>(zone.first) + i +
                                             zone.n[0] * line);
        };
        const bool solid = cell_dimension_ == 3;
        for (std::int64_t k = 0; k + 1 < zone.n[2] || (!solid && k == 0); ++k) {
            for (std::int64_t j = 0; j + 1 < zone.n[1]; ++j) {
                for (std::int64_t i = 0; i + 1 < zone.n[0]; ++i) {
                    std::vector<std::int32_t> cell = {at(i, j, k), at(i + 1, j, k),
                                                      at(i + 1, j + 1, k), at(i, j + 1, k)};
                    for (std::size_t c = 0; solid && c < 4; ++c) {
                        cell.push_back(cell[c] + static_cast<std::int32_t>(zone.n[0] * zone.n[1]));
                    }
                    add_cell(cell);
                }
            }
        }
    }

    std::int32_t point(const CgnsZone& zone, const std::string& section, cgsize_t element,
                       std::int64_t number) const {
        if (number < 1 || number > zone.n[0]) {
            cgns_.fail(in_zone(zone) + ", section " + in_quotes(section) + ": element " +
                       std::to_string(element) + " has point " + std::to_string(number) +
                       ", but there are " + plural(zone.n[0], "point"));
        }
        return static_cast<std::int32_t>(zone.first) + static_cast<std::int32_t>(number) - 1;
    }

    // last: the number of elements minus 1; size: the number of their whole numbers.
    void check_section(const std::string& where, cgsize_t last, cgsize_t size) const {
        const bool is_in_file =
            size >= 0 && static_cast<std::size_t>(size) <= file_size_ * max_zlib_ratio / 4;
        if (last >= 0 && last < size && is_in_file) return;
        cgns_.fail(where + " announces " + std::to_string(last + 1) + " elements with " +
                   plural(size, "whole number") + ", which the file cannot hold");
    }

    void add_sections(std::size_t z) {
        const int number = static_cast<int>(z) + 1;
        int n_sections = 0;
        cgns_(cg_nsections(cgns_.file, cgns_base, number, &n_sections));
        for (int s = 1; s <= n_sections; ++s) {
            char name[33] = "";
            ElementType_t type;
            cgsize_t begin = 0, end = 0, size = 0;
            int n_boundary = 0, has_parents = 0;
            cgns_(cg_section_read(cgns_.file, cgns_base, number, s, name, &type, &begin, &end,
                                  &n_boundary, &has_parents),
                  in_zone(zones_[z]) + ", section " + std::to_string(s));
            if (type == NODE) continue;
            const std::string where = in_zone(zones_[z]) + ", section " + in_quotes(name);
            cgns_(cg_ElementDataSize(cgns_.file, cgns_base, number, s, &size), where);
            check_section(where, end - begin, size);
            std::vector<cgsize_t> data(static_cast<std::size_t>(size)),
                start(static_cast<std::size_t>(end - begin) + 2);
            const bool has_start = type == MIXED || type == NGON_n || type == NFACE_n;
            if (has_start) {
                cgns_(cg_poly_elements_read(cgns_.file, cgns_base, number, s, data.data(),
                                            start.data(), nullptr),
                      where);
            } else {
                cgns_(cg_elements_read(cgns_.file, cgns_base, number, s, data.data(), nullptr),
                      where);
            }
            int n_points = 0;
            if (!has_start) cgns_(cg_npe(type, &n_points));
            std::size_t at = 0;
            for (cgsize_t element = begin; element <= end; ++element) {
                const auto e = static_cast<std::size_t>(element - begin);
                ElementType_t element_type = type;
                std::size_t count = static_cast<std::size_t>(n_points);
                if (has_start) {
                    if (start[e] < 0 || start[e + 1] < start[e] || start[e + 1] > size) {
                        cgns_.fail(where + ": the ElementStartOffset of element " +
                                   std::to_string(element) + " is out of range");
                    }
                    at = static_cast<std::size_t>(start[e]);
                    count = static_cast<std::size_t>(start[e + 1] - start[e]);
                }
                if (type == MIXED && count > 0) {
                    element_type = static_cast<ElementType_t>(data[at++]);
                    --count;
                }
                if (at + count > data.size()) {
                    cgns_.fail(where + " ends inside element " + std::to_string(element));
                }
                std::vector<std::int32_t> points;
                for (std::size_t k = 0; k < count; ++k) {
                    points.push_back(point(zones_[z], name, element, data[at + k]));
                }
                at += count;
                add_element(z, element, element_type, points, name);
            }
        }
    }

    void add_element(std::size_t z, cgsize_t number, ElementType_t type,
                     const std::vector<std::int32_t>& points, const char* section) {
        const bool plane = cell_dimension_ == 2;
        const bool is_cell =
            plane ? type == TRI_3 || type == QUAD_4 || type == NGON_n
                  : type == TETRA_4 || type == PYRA_5 || type == PENTA_6 || type == HEXA_8;
        const bool is_side = plane ? type == BAR_2 : type == TRI_3 || type == QUAD_4;
        if (is_cell) {
            add_cell(points);
        } else if (is_side) {
            sides_[{z, number}] = points;
        } else {
            cgns_.fail(in_zone(zones_[z]) + ", section " + in_quotes(section) + ": element " +
                       std::to_string(number) + " is of type " + cg_ElementTypeName(type) + ": " +
                       (plane ? "TRI_3, QUAD_4, NGON_n and BAR_2 are read"
                              : "TETRA_4, PYRA_5, PENTA_6, HEXA_8, TRI_3 and QUAD_4 are read"));
        }
    }

    // Returns for each point of the file the point of the mesh with whose coordinates it moves.
    std::vector<std::int32_t> find_plane_points() const {
        const std::size_t n = space_.x[0].size();
        std::vector<std::int32_t> plane_point(n, -1);
        for (const CoordinateSlot& slot : mesh_.in_file.slots)
            plane_point[slot.offset / bytes_ % n] = slot.point;
        return plane_point;
    }

    Mesh& mesh_;
    Cgns cgns_;
    std::vector<CgnsZone> zones_;
    int cell_dimension_ = 0;
    std::size_t file_size_ = 0;
    std::size_t bytes_ = 8;  // bytes of a number in mesh.file
    SpacePoints space_;
    std::unique_ptr<OneCellThick> solid_;
    CgnsSides sides_;
};

}  // namespace

void read_cgns(Mesh& mesh) { CgnsReader(mesh).read(); }

}  // namespace cli
#endif
