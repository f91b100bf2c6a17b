#include "formats/cgns_read.hpp"

#ifdef HARMORPH_CGNS
#include "basics/numbers.hpp"
#include "formats/cgns_conditions.hpp"
#include "formats/deflate.hpp"
#include "mesh/one_cell_thick.hpp"

#include <algorithm>
#include <cstring>
#include <memory>

namespace cli {

namespace {

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
