// CGNS files (https://cgns.github.io/CGNS_docs_current/sids), of both kinds that libcgns writes (HDF5 and ADF): the first base,
// all its zones, structured and unstructured, of two dimensions or one cell thick. Made with `make CGNS=1`; without, such a
// file is known and refused.
//
// libcgns reads and writes; mesh.file keeps the coordinates alone, all x, then all y, then all z, as the machine has them.
// A morphed file is a copy of the file in which the coordinate arrays are written anew. Markers are boundary conditions.
// Zones meet where their points have equal coordinates, as cuts do; connectivities are not read.
#include "formats/format.hpp"

#ifdef HARMORPH_CGNS
#include "failure.hpp"
#include "formats/bytes.hpp"
#include "numbers.hpp"
#include "one_cell_thick.hpp"

#include <cgnslib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <ostream>
#include <set>

#include <unistd.h>
#endif

namespace cli {

namespace {

bool probe(const TextFile& file) {
    const std::string_view text = file.text();
    return text.substr(0, 8) == std::string_view("\x89HDF\r\n\x1a\n", 8) ||
           text.substr(0, 64).find("ADF Database") != std::string_view::npos;
}

#ifdef HARMORPH_CGNS

constexpr int base = 1;

// Calls of libcgns that must succeed; every file that is opened is closed.
class Cgns {
public:
    Cgns(const std::string& name, int mode, const std::string& path) : path_(path) {
        cg_configure(CG_CONFIG_ERROR, nullptr); // nothing is printed
        (*this)(cg_open(name.c_str(), mode, &file));
        is_open_ = true;
    }
    ~Cgns() {
        if (is_open_) cg_close(file);
    }
    Cgns(const Cgns&) = delete;

    void close() {
        is_open_ = false;
        (*this)(cg_close(file));
    }
    void operator()(int status) const {
        if (status != CG_OK) fail(cg_get_error());
    }
    [[noreturn]] void fail(const std::string& message) const { throw Failure(exit_file, path_ + ": " + message); }

    int file = 0;

private:
    std::string path_;
    bool is_open_ = false;
};

struct Zone {
    std::string name;
    bool is_structured = false;
    std::array<std::int64_t, 3> n = {1, 1, 1}; // points along i, j, k; of unstructured zones all in the first
    std::size_t first = 0;                     // its first point of all
    std::size_t points() const { return static_cast<std::size_t>(n[0] * n[1] * n[2]); }
};

struct CoordinateArray {
    std::string name;
    DataType_t type;
};

std::string in_zone(const Zone& zone) { return "zone " + cli::quoted(zone.name); }

std::vector<Zone> read_zones(const Cgns& cgns, int& cell_dimension) {
    char name[33] = "";
    int n_bases = 0, n_zones = 0, dimension = 0;
    cgns(cg_nbases(cgns.file, &n_bases));
    if (n_bases < 1) cgns.fail("the file has no base");
    cgns(cg_base_read(cgns.file, base, name, &cell_dimension, &dimension));
    if (cell_dimension != 2 && cell_dimension != 3) {
        cgns.fail("expected a base with cells of 2 or 3 dimensions, found " + std::to_string(cell_dimension));
    }
    cgns(cg_nzones(cgns.file, base, &n_zones));
    if (n_zones < 1) cgns.fail("the base " + cli::quoted(name) + " has no zone");
    std::vector<Zone> zones;
    std::size_t first = 0;
    for (int z = 1; z <= n_zones; ++z) {
        Zone zone;
        ZoneType_t type;
        cgsize_t size[9] = {};
        cgns(cg_zone_read(cgns.file, base, z, name, size));
        cgns(cg_zone_type(cgns.file, base, z, &type));
        zone.name = name;
        zone.is_structured = type == Structured;
        zone.first = first;
        if (!zone.is_structured && type != Unstructured) cgns.fail(in_zone(zone) + " is neither structured nor unstructured");
        for (int d = 0; d < (zone.is_structured ? cell_dimension : 1); ++d) zone.n[static_cast<std::size_t>(d)] = size[d];
        for (const std::int64_t n : zone.n) {
            if (n < 1 || n > INT32_MAX) cgns.fail(in_zone(zone) + " has a size that is none: " + std::to_string(n));
        }
        first += zone.points();
        if (first > INT32_MAX) cgns.fail("more than 2147483647 points");
        zones.push_back(zone);
    }
    return zones;
}

// The arrays of CoordinateX, Y and, if there is one, Z.
std::vector<CoordinateArray> read_arrays(const Cgns& cgns, int zone, const std::string& where) {
    std::vector<CoordinateArray> arrays;
    int n = 0;
    cgns(cg_ncoords(cgns.file, base, zone, &n));
    for (const char* wanted : {"CoordinateX", "CoordinateY", "CoordinateZ"}) {
        for (int c = 1; c <= n; ++c) {
            char name[33] = "";
            DataType_t type;
            cgns(cg_coord_info(cgns.file, base, zone, c, &type, name));
            if (std::string(name) == wanted) arrays.push_back({name, type});
        }
    }
    if (arrays.size() < 2) cgns.fail(where + " has no CoordinateX and CoordinateY");
    return arrays;
}

void whole_range(const Zone& zone, cgsize_t* low, cgsize_t* high) {
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] = 1;
        high[d] = static_cast<cgsize_t>(zone.n[d]);
    }
}

// The file with other coordinates: a copy, in which libcgns writes the arrays anew.
void store(std::ostream& out, const Mesh& mesh, const std::string& numbers) {
    const std::string path = mesh.file.path();
    std::string copy = (std::filesystem::temp_directory_path() / "harmorph-XXXXXX").string();
    const int descriptor = ::mkstemp(copy.data());
    if (descriptor < 0) throw Failure(exit_file, copy + ": cannot be written");
    ::close(descriptor);
    struct Removed {
        const std::string& name;
        ~Removed() { std::remove(name.c_str()); }
    } const removed{copy};
    std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
    {
        Cgns cgns(copy, CG_MODE_MODIFY, path);
        int cell_dimension = 0;
        const std::vector<Zone> zones = read_zones(cgns, cell_dimension);
        const std::size_t n_points = zones.back().first + zones.back().points();
        const bool single = mesh.in_file.kind == NumberKind::real32;
        for (std::size_t z = 0; z < zones.size(); ++z) {
            cgsize_t low[3], high[3];
            whole_range(zones[z], low, high);
            const int number = static_cast<int>(z) + 1;
            std::size_t d = 0;
            for (const CoordinateArray& array : read_arrays(cgns, number, in_zone(zones[z]))) {
                std::vector<double> values;
                std::vector<float> singles;
                for (std::size_t k = 0; k < zones[z].points(); ++k) {
                    const std::size_t at = d * n_points + zones[z].first + k;
                    const char* const bytes = numbers.data() + at * (single ? 4 : 8);
                    values.push_back(single ? static_cast<double>(load<float>(bytes, false)) : load<double>(bytes, false));
                    singles.push_back(static_cast<float>(values.back()));
                }
                ++d;
                int c = 0;
                const void* const data = array.type == RealSingle ? static_cast<const void*>(singles.data()) : values.data();
                cgns(cg_coord_partial_write(cgns.file, base, number, array.type, array.name.c_str(), low, high, data, &c));
            }
        }
        cgns.close();
    }
    std::ifstream changed(copy, std::ios::binary);
    out << changed.rdbuf();
}

class CgnsReader {
public:
    explicit CgnsReader(Mesh& mesh) : mesh_(mesh), cgns_(mesh.file.path(), CG_MODE_READ, mesh.file.path()) {}

    void read() {
        zones_ = read_zones(cgns_, cell_dimension_);
        read_points();
        if (cell_dimension_ == 2) {
            add_plane();
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
        find_plane_points();
        find_open_edges();
        for (std::size_t z = 0; z < zones_.size(); ++z) add_conditions(z);
        mesh_.face_offset.resize(mesh_.face_markers.size());
    }

private:
    using Edge = std::pair<std::int32_t, std::int32_t>;

    static Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

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
            for (const CoordinateArray& array : read_arrays(cgns_, number, in_zone(zones_[z]))) {
                double* const to = space_.x[d++].data() + zones_[z].first;
                cgns_(cg_coord_read(cgns_.file, base, number, array.name.c_str(), RealDouble, low, high, to));
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
                if (!(value - value == 0)) cgns_.fail("point " + std::to_string(k + 1) + " has a coordinate that is not finite");
                std::memcpy(&numbers[(d * n + k) * bytes], all_single ? static_cast<const void*>(&single) : &value, bytes);
            }
        }
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t k = 0; k < n; ++k) space_.offset[d].push_back((d * n + k) * bytes);
        }
        mesh_.file = TextFile(mesh_.file.path(), std::move(numbers));
        mesh_.in_file.kind = all_single ? NumberKind::real32 : NumberKind::real64;
        mesh_.in_file.store = store;
        mesh_.in_file.swapped = false;
        bytes_ = bytes;
    }

    // Cells of two dimensions: all points, in the plane x, y or z = constant.
    void add_plane() { take_flat(mesh_, space_, {}); }

    void add_cell(const std::vector<std::int32_t>& points) {
        const std::size_t offset = space_.offset[0][static_cast<std::size_t>(points[0])];
        if (solid_) {
            solid_->add_cell(points.data(), points.size(), offset);
        } else {
            mesh_.add_cell(points, offset);
        }
    }

    void add_structured(const Zone& zone) {
        const auto at = [&zone](std::int64_t i, std::int64_t j, std::int64_t k) {
            return static_cast<std::int32_t>(static_cast<std::int64_t>(zone.first) + i + zone.n[0] * (j + zone.n[1] * k));
        };
        const bool solid = cell_dimension_ == 3;
        for (std::int64_t k = 0; k + 1 < zone.n[2] || (!solid && k == 0); ++k) {
            for (std::int64_t j = 0; j + 1 < zone.n[1]; ++j) {
                for (std::int64_t i = 0; i + 1 < zone.n[0]; ++i) {
                    std::vector<std::int32_t> cell = {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)};
                    for (std::size_t c = 0; solid && c < 4; ++c) {
                        cell.push_back(cell[c] + static_cast<std::int32_t>(zone.n[0] * zone.n[1]));
                    }
                    add_cell(cell);
                }
            }
        }
    }

    std::int32_t point(const Zone& zone, std::int64_t number) const {
        if (number < 1 || number > zone.n[0]) {
            cgns_.fail(in_zone(zone) + " has an element with point " + std::to_string(number) + ", but " +
                       plural(zone.n[0], "point"));
        }
        return static_cast<std::int32_t>(zone.first) + static_cast<std::int32_t>(number) - 1;
    }

    void add_sections(std::size_t z) {
        const int number = static_cast<int>(z) + 1;
        int n_sections = 0;
        cgns_(cg_nsections(cgns_.file, base, number, &n_sections));
        for (int s = 1; s <= n_sections; ++s) {
            char name[33] = "";
            ElementType_t type;
            cgsize_t begin = 0, end = 0, size = 0;
            int n_boundary = 0, has_parents = 0;
            cgns_(cg_section_read(cgns_.file, base, number, s, name, &type, &begin, &end, &n_boundary, &has_parents));
            if (type == NODE) continue;
            cgns_(cg_ElementDataSize(cgns_.file, base, number, s, &size));
            std::vector<cgsize_t> data(static_cast<std::size_t>(size)), start(static_cast<std::size_t>(end - begin) + 2);
            const bool has_start = type == MIXED || type == NGON_n || type == NFACE_n;
            if (has_start) {
                cgns_(cg_poly_elements_read(cgns_.file, base, number, s, data.data(), start.data(), nullptr));
            } else {
                cgns_(cg_elements_read(cgns_.file, base, number, s, data.data(), nullptr));
            }
            int n_points = 0;
            if (!has_start) cgns_(cg_npe(type, &n_points));
            std::size_t at = 0;
            for (cgsize_t element = begin; element <= end; ++element) {
                const auto e = static_cast<std::size_t>(element - begin);
                ElementType_t its = type;
                std::size_t count = static_cast<std::size_t>(n_points);
                if (has_start) {
                    at = static_cast<std::size_t>(start[e]);
                    count = static_cast<std::size_t>(start[e + 1] - start[e]);
                }
                if (type == MIXED && count > 0) {
                    its = static_cast<ElementType_t>(data[at++]);
                    --count;
                }
                if (at + count > data.size()) cgns_.fail("section " + cli::quoted(name) + " ends inside an element");
                std::vector<std::int32_t> points;
                for (std::size_t k = 0; k < count; ++k) points.push_back(point(zones_[z], data[at + k]));
                at += count;
                add_element(z, element, its, points, name);
            }
        }
    }

    void add_element(std::size_t z, cgsize_t number, ElementType_t type, const std::vector<std::int32_t>& points,
                     const char* section) {
        const bool plane = cell_dimension_ == 2;
        const bool is_cell = plane ? type == TRI_3 || type == QUAD_4 || type == NGON_n : type == PENTA_6 || type == HEXA_8;
        const bool is_side = plane ? type == BAR_2 : type == TRI_3 || type == QUAD_4;
        if (is_cell) {
            add_cell(points);
        } else if (is_side) {
            sides_[{z, number}] = points;
        } else {
            cgns_.fail("section " + cli::quoted(section) + " has elements of type " + cg_ElementTypeName(type) + ": " +
                       (plane ? "TRI_3, QUAD_4, NGON_n and BAR_2 are read" : "PENTA_6, HEXA_8, TRI_3 and QUAD_4 are read"));
        }
    }

    // The point of the plane that each point of the file is or follows.
    void find_plane_points() {
        plane_point_.assign(space_.x[0].size(), -1);
        for (const CoordinateSlot& slot : mesh_.in_file.slots) {
            plane_point_[slot.offset / bytes_ % space_.x[0].size()] = slot.point;
        }
    }

    void find_open_edges() {
        std::map<Edge, int> cells;
        for (std::size_t cell = 0; cell + 1 < mesh_.cell_start.size(); ++cell) {
            const std::int32_t begin = mesh_.cell_start[cell], end = mesh_.cell_start[cell + 1];
            for (std::int32_t i = begin; i < end; ++i) {
                const std::int32_t a = mesh_.cell_points[static_cast<std::size_t>(i)];
                const std::int32_t b = mesh_.cell_points[static_cast<std::size_t>(i + 1 < end ? i + 1 : begin)];
                ++cells[edge_of(a, b)];
            }
        }
        for (const auto& edge : cells) {
            if (edge.second == 1) open_.insert(edge.first);
        }
    }

    void add_conditions(std::size_t z) {
        const int number = static_cast<int>(z) + 1;
        int n_conditions = 0;
        cgns_(cg_nbocos(cgns_.file, base, number, &n_conditions));
        for (int c = 1; c <= n_conditions; ++c) {
            char name[33] = "";
            BCType_t type;
            PointSetType_t set;
            GridLocation_t location = Vertex;
            cgsize_t n = 0, list_size = 0;
            DataType_t list_type;
            int normal_index[3], n_data = 0;
            cgns_(cg_boco_info(cgns_.file, base, number, c, name, &type, &set, &n, normal_index, &list_size, &list_type, &n_data));
            cgns_(cg_boco_gridlocation_read(cgns_.file, base, number, c, &location));
            const std::size_t dimensions = zones_[z].is_structured ? static_cast<std::size_t>(cell_dimension_) : 1;
            std::vector<cgsize_t> items(static_cast<std::size_t>(n) * dimensions);
            std::vector<double> normals(static_cast<std::size_t>(std::max<cgsize_t>(list_size, 1)));
            cgns_(cg_boco_read(cgns_.file, base, number, c, items.data(), list_size > 0 ? normals.data() : nullptr));
            if (set == ElementRange || set == ElementList) location = cell_dimension_ == 2 ? EdgeCenter : FaceCenter;
            const bool is_range = set == PointRange || set == ElementRange;
            if (zones_[z].is_structured) {
                mark_points(name, structured_points(zones_[z], items, dimensions, is_range, location));
            } else if (location == Vertex) {
                std::set<std::int32_t> points;
                for_each(items, is_range, [&](cgsize_t item) { points.insert(plane_point(point(zones_[z], item))); });
                mark_points(name, points);
            } else {
                for_each(items, is_range, [&](cgsize_t item) { mark_element(name, z, item); });
            }
        }
    }

    template <class Visit> static void for_each(const std::vector<cgsize_t>& items, bool is_range, Visit visit) {
        if (!is_range) {
            for (const cgsize_t item : items) visit(item);
        } else if (items.size() == 2) {
            for (cgsize_t item = items[0]; item <= items[1]; ++item) visit(item);
        }
    }

    std::int32_t plane_point(std::int32_t point) const { return plane_point_[static_cast<std::size_t>(point)]; }

    // Of faces, indices are those of their first corner: the points one further along the side belong to it, too.
    std::set<std::int32_t> structured_points(const Zone& zone, const std::vector<cgsize_t>& items, std::size_t dimensions,
                                             bool is_range, GridLocation_t location) const {
        std::set<std::int32_t> points;
        const auto add = [&](const std::array<std::int64_t, 3>& index) {
            for (std::size_t d = 0; d < 3; ++d) {
                if (index[d] < 1 || index[d] > zone.n[d]) cgns_.fail(in_zone(zone) + " has a boundary condition outside of it");
            }
            points.insert(plane_point(static_cast<std::int32_t>(
                static_cast<std::int64_t>(zone.first) + index[0] - 1 + zone.n[0] * (index[1] - 1 + zone.n[1] * (index[2] - 1)))));
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

    void mark(const std::string& name, Edge edge) {
        const auto found = open_.find(edge);
        if (found == open_.end()) return;
        mesh_.add_face(edge.first, edge.second, mesh_.add_marker(name), 0);
        open_.erase(found);
    }

    // Boundary edges with both ends among the points; a condition on a whole plane marks none: it has inner points.
    void mark_points(const std::string& name, const std::set<std::int32_t>& points) {
        if (cell_dimension_ == 3 && points.size() == static_cast<std::size_t>(mesh_.points())) return;
        std::vector<Edge> edges;
        for (const Edge& edge : open_) {
            if (points.count(edge.first) > 0 && points.count(edge.second) > 0) edges.push_back(edge);
        }
        std::set<std::int32_t> ends;
        for (const Edge& edge : edges) ends.insert({edge.first, edge.second});
        if (ends.size() != points.size()) return;
        for (const Edge& edge : edges) mark(name, edge);
    }

    void mark_element(const std::string& name, std::size_t z, cgsize_t number) {
        const auto found = sides_.find({z, number});
        if (found == sides_.end()) {
            cgns_.fail("the boundary condition " + cli::quoted(name) + " names element " + std::to_string(number) +
                       ", which is no face of the boundary");
        }
        std::set<std::int32_t> ends;
        for (const std::int32_t its : found->second) ends.insert(plane_point(its));
        if (ends.size() == 2) mark(name, edge_of(*ends.begin(), *ends.rbegin()));
    }

    Mesh& mesh_;
    Cgns cgns_;
    std::vector<Zone> zones_;
    int cell_dimension_ = 0;
    std::size_t bytes_ = 8; // of a number in mesh.file
    SpacePoints space_;
    std::unique_ptr<OneCellThick> solid_;
    std::map<std::pair<std::size_t, cgsize_t>, std::vector<std::int32_t>> sides_; // elements of the boundary
    std::vector<std::int32_t> plane_point_;
    std::set<Edge> open_; // boundary edges without a marker
};

void read(Mesh& mesh, const ReadOptions&) { CgnsReader(mesh).read(); }

#else

void read(Mesh& mesh, const ReadOptions&) {
    mesh.file.fail(0, "this is an HDF5 or ADF file: CGNS files are read by programs made with `make CGNS=1`, where libcgns "
                      "is installed");
}

#endif

} // namespace

const Format cgns_format = {"cgns", ".cgns", "CGNS, 2D or one cell thick (programs made with CGNS=1)", probe, read, nullptr};

} // namespace cli
