// The places of the coordinates in a mesh file. With them the file is written again with other
// coordinates and without any other change. Readers of all formats leave such a record, so that no
// format needs a writer for morphed meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Mesh;

enum class NumberKind { text, real32, real64 };

// One number of the file that is a coordinate of a point of the mesh, or moves with a point.
struct CoordinateSlot {
    std::size_t offset;  // place of the first byte in the file
    std::int32_t point;  // a point of the mesh; from the number of points on, one of `between`
    std::int32_t rule;   // takes_x, takes_y: that coordinate; otherwise an index of `directions`
    std::int64_t number = -1;  // 3 k + d: coordinate d of point k of a file with three coordinates
};
enum CoordinateRule : std::int32_t { takes_x = -1, takes_y = -2 };

// A number of the file changes by dx along[0] + dy along[1] if its point moves by dx, dy.
struct Direction {
    double along[2];
};

// A point of the file that is no point of the mesh, but lies between points: the middle of an edge
// (two corners), whose distance from the straight edge turns and grows with the edge, or the middle
// of a cell (three or four corners), which moves by the mean of the corners.
struct Between {
    std::array<std::int32_t, 4> corners;
    std::int32_t n_corners;
    double x, y;
};

struct FileCoordinates {
    NumberKind kind = NumberKind::text;
    bool is_computed = false;  // the coordinates of the mesh are not numbers of the file, as in an
                               // inclined plane or a wedge
    bool is_packed = false;    // the file is compressed by gzip
    bool is_joined = false;    // mesh.file is one .vtu of several files that the given file names
    bool swapped = false;      // binary numbers are not in this machine's byte order
    std::size_t axes[2] = {0,
                           1};  // which coordinates of a file of one plane are x and y of the mesh
    std::int64_t n_points = 0;  // of a file with three coordinates, which slots then number
    // The x of point k is at Mesh::point_offset[k], and y is the next number. Such a file has no
    // slots, because slots would need more memory than the rest of the mesh.
    bool in_pairs = false;
    std::vector<CoordinateSlot> slots;
    std::vector<Direction> directions;
    std::vector<Between> between;
    // For files with encoded numbers, and files that a library writes: mesh.file then has the
    // decoded numbers, and this function writes the whole file with other numbers, which are as
    // long as mesh.file. If the function is empty, mesh.file is the file.
    using Store =
        std::function<void(std::ostream& out, const Mesh& mesh, const std::string& numbers)>;
    Store store;
};

}  // namespace cli
