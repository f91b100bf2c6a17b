// Where a mesh file keeps its coordinates. With that the file can be written again with other
// coordinates, and every byte besides them stays: readers of all formats leave such a record, so
// that no format has a writer of its own for this.
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

// One number of the file. It is a coordinate of a point of the mesh, or moves with one.
struct CoordinateSlot {
    std::size_t offset;  // of its first byte
    std::int32_t point;  // of the mesh; from the number of points on: one of `between`
    std::int32_t
        rule;  // takes_x, takes_y: the number is that coordinate; else a place in `directions`
};
enum CoordinateRule : std::int32_t { takes_x = -1, takes_y = -2 };

// How a number of the file grows with the movement of its point: by dx along[0] + dy along[1].
struct Direction {
    double along[2];
};

// A point of the file that is none of the mesh, but lies between some: the middle of an edge (two
// corners), whose distance from the straight edge turns and grows with the edge, or of a cell
// (three or four), which moves by their mean.
struct Between {
    std::array<std::int32_t, 4> corners;
    std::int32_t n_corners;
    double x, y;
};

struct FileCoordinates {
    NumberKind kind = NumberKind::text;
    bool is_computed = false;  // the mesh's coordinates are none of the file's numbers: an inclined
                               // plane, or a wedge
    bool is_packed = false;    // the file is compressed by gzip
    bool is_joined = false;    // mesh.file is one .vtu of several files that the given file names
    bool swapped = false;      // binary numbers are not in this machine's byte order
    std::size_t axes[2] = {
        0, 1};  // of a file of one plane: which of its coordinates are x and y of the mesh
    std::vector<CoordinateSlot> slots;
    std::vector<Direction> directions;
    std::vector<Between> between;
    // Of files that hold their numbers encoded, or that a library writes: mesh.file has the numbers
    // decoded, and this writes the whole file with other ones, `numbers`, which are as long as
    // mesh.file. Empty: mesh.file is the file.
    using Store =
        std::function<void(std::ostream& out, const Mesh& mesh, const std::string& numbers)>;
    Store store;
};

}  // namespace cli
