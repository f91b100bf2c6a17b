// A mesh as it was read from a file of any format. The mesh keeps the text of the file, because a
// morphed mesh is written as the same file with other numbers.
#pragma once

#include "files/text_file.hpp"

#include <harmorph.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cli {

// The places of the coordinates in a mesh file. With them the file is written again with other
// coordinates and without any other change. Readers of all formats leave such a record, so that no
// format needs a writer for morphed meshes.

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

struct Format;

// A marker, or the piece of the marker that is nearest to a point.
struct MarkerPiece {
    std::int32_t marker = 0;
    bool is_piece = false;
    double x = 0, y = 0;
};

struct Mesh {
    TextFile file;
    const Format* format = nullptr;  // of the file; NULL: the mesh comes from no file
    std::vector<double> x, y;
    std::vector<std::int32_t> cell_start = {0}, cell_points;  // compressed rows, counted from 0
    bool has_polygons = false;  // cells of more than four corners, or with hanging nodes
    std::vector<std::int32_t> face_points, face_markers;
    std::vector<std::string> markers;  // the names; the number of a marker is its place here
    // The markers that a name selects besides a marker of this name: faces in the groups "a" and
    // "b" of a file have the marker "a+b", which both "a" and "b" select.
    std::map<std::string, std::vector<std::string>> groups;
    // Pairs of markers that slide along each other according to the file.
    std::vector<std::pair<std::string, std::string>> interfaces;
    std::vector<std::size_t> point_offset, cell_offset,
        face_offset;                   // places in file.text(); may be empty
    std::vector<std::string> remarks;  // for the user, such as names of ignored sections
    std::string likely_fault;  // the probable reason if the library refuses the mesh; may be
                               // empty
    FileCoordinates in_file;
    std::int32_t threads = 1;  // that read and write the file; the bytes do not depend on them

    explicit Mesh(const std::string& path) : file(path) {}
    Mesh() : file("", "") {}  // a mesh that comes from no file

    std::int32_t points() const { return static_cast<std::int32_t>(x.size()); }
    std::int32_t cells() const { return static_cast<std::int32_t>(cell_start.size()) - 1; }
    std::int32_t faces() const { return static_cast<std::int32_t>(face_markers.size()); }
    std::int32_t faces(std::int32_t marker) const;

    hm_points coordinates() const { return {x.data(), y.data(), 1}; }
    hm_mesh view() const;

    // Returns the numbers of the markers in a list "A,B". An entry is a marker, a name of `groups`,
    // a pattern with * and ?, a whole loop of the boundary, "loop:1", or a name in quotes
    // (quoted_name.hpp), which stands for itself. Refuses a name that the file does not have as
    // wrong usage. A list that is the name of one marker needs no quotes.
    std::vector<std::int32_t> find_markers(const std::string& list) const;
    // Does the same, except that an entry may be "A@X:Y": the piece of a marker that is nearest to
    // a point.
    std::vector<MarkerPiece> find_pieces(const std::string& list) const;
    bool has_markers(const std::string& list) const;  // find_pieces() does not refuse the list
    // Splits "A[,B]=VALUE" at the first `=` before which a list of markers stands. The value is
    // empty if the whole text is such a list, or has no `=`.
    std::pair<std::string, std::string> split_binding(const std::string& binding) const;
    // Returns the marker of the condition as an entry of a list, as which it is read back.
    std::string name_of(const hm_condition& condition) const;

    // Functions for readers. add_marker() returns the marker of this name, which may be new;
    // remark() keeps a text once. Offsets are places in the file.
    std::int32_t add_marker(std::string_view tag);
    void remark(const std::string& text);
    void remark_ignored(const std::string& contents);                      // of the file
    void add_point(double point_x, double point_y, std::size_t x_offset);  // of files in pairs
    template <class Points>
    void add_cell(const Points& points, std::size_t offset) {
        cell_points.insert(cell_points.end(), std::begin(points), std::end(points));
        cell_start.push_back(static_cast<std::int32_t>(cell_points.size()));
        cell_offset.push_back(offset);
    }
    // Refuses cells of more than four corners as wrong usage. `who`: the format or command that
    // does not take them.
    void refuse_polygons(const std::string& who) const;
    // Sets has_polygons for formats with polygons. Cells of four corners that are not convex count
    // as polygons.
    void find_polygons();
    void add_face(std::int32_t a, std::int32_t b, std::int32_t marker, std::size_t offset);

private:
    std::unordered_map<std::string, std::int32_t> marker_numbers_;  // of `markers`
};

// Throws a Failure for an error of the library about the mesh: with the line of the file, if the
// error is about an item that the file has, and with the names of markers.
[[noreturn]] void refuse(const hm_error& error, const Mesh& mesh);

// Markers have names in files, and numbers in the library.

// Gives markers their numbers in the order of their names, so that the numbers do not depend on
// the order in the file.
void number_by_name(Mesh& mesh);

std::string listed(const std::vector<std::string>& names);  // "'a', 'b'", or "no markers"

}  // namespace cli
