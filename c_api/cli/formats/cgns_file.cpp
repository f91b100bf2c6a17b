#include "formats/cgns_file.hpp"

#ifdef HARMORPH_CGNS
#include "basics/numbers.hpp"
#include "files/paths.hpp"
#include "formats/bytes.hpp"
#include "formats/deflate.hpp"

#include <cgns_io.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace cli {

Cgns::Cgns(const std::string& name, int mode, const std::string& path) : path_(path) {
    cg_configure(CG_CONFIG_ERROR, nullptr);  // libcgns prints nothing
    (*this)(cg_open(name.c_str(), mode, &file));
    is_open_ = true;
}

void Cgns::close() {
    is_open_ = false;
    (*this)(cg_close(file));
}

std::string CgnsZone::point(std::size_t k) const {
    const auto number = static_cast<std::int64_t>(k);
    if (!is_structured) return in_zone(*this) + ", point " + std::to_string(number + 1);
    return in_zone(*this) + ", point (" + std::to_string(number % n[0] + 1) + ", " +
           std::to_string(number / n[0] % n[1] + 1) + ", " +
           std::to_string(number / n[0] / n[1] + 1) + ")";
}

std::string in_zone(const CgnsZone& zone) { return "zone " + in_quotes(zone.name); }

namespace {

// Returns the number of points of a zone. HDF5 files may be compressed by zlib; a point has two
// coordinates of four bytes at least.
std::size_t check_points(const Cgns& cgns, const CgnsZone& zone, std::size_t file_size) {
    std::int64_t points = 1;
    for (const std::int64_t n : zone.n) {
        if (n < 1)
            cgns.fail(in_zone(zone) + " has " + std::to_string(n) + " points in a direction");
        if (n > INT32_MAX / points) cgns.fail(in_zone(zone) + " has more than 2147483647 points");
        points *= n;
    }
    const auto n_points = static_cast<std::size_t>(points);
    if (n_points > file_size * max_zlib_ratio / 8) {
        cgns.fail(in_zone(zone) + " has " + plural(points, "point") +
                  ", which is more than a file of this size can hold");
    }
    return n_points;
}

}  // namespace

std::vector<CgnsZone> read_zones(const Cgns& cgns, std::size_t file_size, int& cell_dimension) {
    char name[33] = "";
    int n_bases = 0, n_zones = 0, dimension = 0;
    cgns(cg_nbases(cgns.file, &n_bases));
    if (n_bases < 1) cgns.fail("the file has no base");
    cgns(cg_base_read(cgns.file, cgns_base, name, &cell_dimension, &dimension));
    if (cell_dimension != 2 && cell_dimension != 3) {
        cgns.fail("the cells of the base must have 2 or 3 dimensions, not " +
                  std::to_string(cell_dimension));
    }
    cgns(cg_nzones(cgns.file, cgns_base, &n_zones));
    if (n_zones < 1) cgns.fail("the base " + in_quotes(name) + " has no zone");
    std::vector<CgnsZone> zones;
    std::size_t first = 0;
    for (int z = 1; z <= n_zones; ++z) {
        CgnsZone zone;
        ZoneType_t type;
        cgsize_t size[9] = {};
        cgns(cg_zone_read(cgns.file, cgns_base, z, name, size), "zone " + std::to_string(z));
        cgns(cg_zone_type(cgns.file, cgns_base, z, &type), "zone " + std::to_string(z));
        zone.name = name;
        zone.is_structured = type == Structured;
        zone.first = first;
        if (!zone.is_structured && type != Unstructured)
            cgns.fail(in_zone(zone) + " is neither structured nor unstructured");
        for (int d = 0; d < (zone.is_structured ? cell_dimension : 1); ++d)
            zone.n[static_cast<std::size_t>(d)] = size[d];
        first += check_points(cgns, zone, file_size);
        if (first > INT32_MAX) cgns.fail("the zones have together more than 2147483647 points");
        zones.push_back(zone);
    }
    return zones;
}

std::vector<CgnsArray> read_arrays(const Cgns& cgns, int zone, const std::string& where) {
    std::vector<CgnsArray> arrays;
    int n = 0;
    cgns(cg_ncoords(cgns.file, cgns_base, zone, &n));
    for (const char* wanted : {"CoordinateX", "CoordinateY", "CoordinateZ"}) {
        for (int c = 1; c <= n; ++c) {
            char name[33] = "";
            DataType_t type;
            cgns(cg_coord_info(cgns.file, cgns_base, zone, c, &type, name),
                 where + ", coordinate " + std::to_string(c));
            if (std::string(name) == wanted) arrays.push_back({name, type});
        }
    }
    if (arrays.size() < 2) cgns.fail(where + " has no CoordinateX and CoordinateY");
    return arrays;
}

void whole_range(const CgnsZone& zone, cgsize_t* low, cgsize_t* high) {
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] = 1;
        high[d] = static_cast<cgsize_t>(zone.n[d]);
    }
}

namespace {

// Writes the version of the given file into the copy: libcgns puts its own version into files that
// it changes.
void write_version(const std::string& file, float version, const std::string& path) {
    int number = 0;
    double root = 0, node = 0;
    const auto succeeds = [&path](int status) {
        if (status == CG_OK) return;
        char text[CGIO_MAX_ERROR_LENGTH + 1] = "";
        cgio_error_message(text);
        throw Failure(exit_file, path + ": the version in the copy: " + text);
    };
    succeeds(cgio_open_file(file.c_str(), CGIO_MODE_MODIFY, CGIO_FILE_NONE, &number));
    succeeds(cgio_get_root_id(number, &root));
    if (cgio_get_node_id(number, root, "CGNSLibraryVersion", &node) == CG_OK)
        succeeds(cgio_write_all_data(number, node, &version));
    succeeds(cgio_close_file(number));
}

}  // namespace

void store_cgns(std::ostream& out, const Mesh& mesh, const std::string& numbers) {
    const std::string path = mesh.file.path();
    if (numbers == mesh.file.text()) {
        out << TextFile(path).text();
        return;
    }
    const std::string copy = temporary_copy(path);
    struct Removed {
        const std::string& name;
        ~Removed() { std::remove(name.c_str()); }
    } const removed{copy};
    float version = 0;
    {
        const Cgns cgns(copy, CG_MODE_READ, path);
        cgns(cg_version(cgns.file, &version));
    }
    {
        Cgns cgns(copy, CG_MODE_MODIFY, path);
        int cell_dimension = 0;
        const std::vector<CgnsZone> zones =
            read_zones(cgns, mesh.file.text().size(), cell_dimension);
        const std::size_t n_points = zones.back().first + zones.back().points();
        const bool single = mesh.in_file.kind == NumberKind::real32;
        for (std::size_t z = 0; z < zones.size(); ++z) {
            cgsize_t low[3], high[3];
            whole_range(zones[z], low, high);
            const int number = static_cast<int>(z) + 1;
            std::size_t d = 0;
            for (const CgnsArray& array : read_arrays(cgns, number, in_zone(zones[z]))) {
                std::vector<double> values;
                std::vector<float> singles;
                for (std::size_t k = 0; k < zones[z].points(); ++k) {
                    const std::size_t at = d * n_points + zones[z].first + k;
                    const char* const bytes = numbers.data() + at * (single ? 4 : 8);
                    values.push_back(single ? static_cast<double>(load<float>(bytes, false))
                                            : load<double>(bytes, false));
                    singles.push_back(static_cast<float>(values.back()));
                }
                ++d;
                int c = 0;
                const void* const data = array.type == RealSingle
                                             ? static_cast<const void*>(singles.data())
                                             : values.data();
                cgns(cg_coord_partial_write(cgns.file, cgns_base, number, array.type,
                                            array.name.c_str(), low, high, data, &c));
            }
        }
        cgns.close();
    }
    write_version(copy, version, path);
    std::ifstream changed(copy, std::ios::binary);
    out << changed.rdbuf();
}

}  // namespace cli
#endif
