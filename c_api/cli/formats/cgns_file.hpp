// Zones and coordinates of a CGNS file, read and written by libcgns. This source is compiled by
// `make CGNS=1` only.
#pragma once

#ifdef HARMORPH_CGNS
#include "basics/failure.hpp"
#include "mesh/mesh_file.hpp"

#include <array>
#include <cgnslib.h>
#include <string>
#include <vector>

namespace cli {

constexpr int cgns_base = 1;

// Calls of libcgns that must succeed. The destructor closes the file.
class Cgns {
public:
    Cgns(const std::string& name, int mode, const std::string& path);
    ~Cgns() {
        if (is_open_) cg_close(file);
    }
    Cgns(const Cgns&) = delete;

    void close();
    // what: for the message, such as "zone 'a', CoordinateX".
    void operator()(int status, const std::string& what = "") const {
        if (status != CG_OK) fail((what.empty() ? "" : what + ": ") + cg_get_error());
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw Failure(exit_file, path_ + ": " + message);
    }

    int file = 0;

private:
    std::string path_;
    bool is_open_ = false;
};

struct CgnsZone {
    std::string name;
    bool is_structured = false;
    // Points along i, j, k. n[0] of an unstructured zone is the number of all points.
    std::array<std::int64_t, 3> n = {1, 1, 1};
    std::size_t first = 0;  // the number of points in the preceding zones
    std::size_t points() const { return static_cast<std::size_t>(n[0] * n[1] * n[2]); }
    // Returns "zone 'a', point 12" or "zone 'a', point (4, 1, 1)", as the file numbers points. k is
    // counted from 0.
    std::string point(std::size_t k) const;
};

struct CgnsArray {
    std::string name;
    DataType_t type;
};

std::string in_zone(const CgnsZone& zone);
// Refuses zones that have together more points than 2^31 - 1, or than a file of this size, in
// bytes, can hold.
std::vector<CgnsZone> read_zones(const Cgns& cgns, std::size_t file_size, int& cell_dimension);
// Returns the arrays CoordinateX, CoordinateY and, if there is one, CoordinateZ.
std::vector<CgnsArray> read_arrays(const Cgns& cgns, int zone, const std::string& where);
void whole_range(const CgnsZone& zone, cgsize_t* low, cgsize_t* high);

// Writes the file with other coordinates, for FileCoordinates::store: libcgns writes the arrays of
// a copy.
void store_cgns(std::ostream& out, const Mesh& mesh, const std::string& numbers);

}  // namespace cli
#endif
