// A mesh as it was read from a file of any format. The mesh keeps the text of the file, because a
// morphed mesh is written as the same file with other numbers.
#pragma once

#include "files/text_file.hpp"
#include "mesh/coordinates.hpp"

#include <harmorph.h>

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cli {

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

}  // namespace cli
