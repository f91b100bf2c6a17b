// A mesh as it was read from a file of any format. It keeps the file: a morphed mesh is the same
// file with other numbers.
#pragma once

#include "formats/coordinates.hpp"
#include "harmorph.h"
#include "basics/text_file.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cli {

// A marker, or the piece of it that is nearest to a point.
struct MarkerPiece {
    std::int32_t marker = 0;
    bool is_piece = false;
    double x = 0, y = 0;
};

struct Mesh {
    TextFile file;
    std::vector<double> x, y;
    std::vector<std::int32_t> cell_start = {0}, cell_points;  // compressed rows, counted from 0
    bool has_polygons = false;  // cells of more than four corners, or with hanging nodes
    std::vector<std::int32_t> face_points, face_markers;
    std::vector<std::string> markers;  // their tags; a marker's number is its place here
    // Names that belong to no marker alone: faces in the groups "a" and "b" of a file have the
    // marker "a+b", which is the only one of each of both names, or one of several.
    std::map<std::string, std::vector<std::string>> groups;
    // Pairs of tags: the file says that these markers slide along each other.
    std::vector<std::pair<std::string, std::string>> interfaces;
    std::vector<std::size_t> point_offset, cell_offset,
        face_offset;                   // where each stands in file.text(); may be empty
    std::vector<std::string> remarks;  // what was passed over, for the user
    std::string likely_fault;  // what in the file is probably the reason if the mesh is refused;
                               // empty: nothing
    FileCoordinates in_file;

    explicit Mesh(const std::string& path) : file(path) {}

    std::int32_t points() const { return static_cast<std::int32_t>(x.size()); }
    std::int32_t cells() const { return static_cast<std::int32_t>(cell_start.size()) - 1; }
    std::int32_t faces() const { return static_cast<std::int32_t>(face_markers.size()); }
    std::int32_t faces(std::int32_t marker) const;

    hm_points coordinates() const {
        return {x.data(), y.data(), 1};
    }  // for the library, of these arrays
    hm_mesh view() const;

    // The numbers of the markers in a list "A,B". An entry is a marker, a name of `groups`, a
    // pattern with * and ?, or a whole loop of the boundary, "loop:1"; what the file does not have
    // is wrong usage. A tag may hold commas.
    std::vector<std::int32_t> find_markers(const std::string& list) const;
    // The same where an entry may be "A@X:Y", a piece of a marker: the one nearest to a point.
    std::vector<MarkerPiece> find_pieces(const std::string& list) const;

    // For readers. A marker of this tag, new or there already; a remark, once; what stands in the
    // file at these offsets.
    std::int32_t add_marker(std::string_view tag);
    void remark(const std::string& text);
    void add_point(double its_x, double its_y, std::size_t x_offset, std::size_t y_offset);
    template <class Points>
    void add_cell(const Points& points, std::size_t offset) {
        cell_points.insert(cell_points.end(), std::begin(points), std::end(points));
        cell_start.push_back(static_cast<std::int32_t>(cell_points.size()));
        cell_offset.push_back(offset);
    }
    // Wrong usage if there are cells of more than four corners; who: what takes none.
    void refuse_polygons(const std::string& who) const;
    void find_polygons();  // cells of four corners, too, if a corner is not convex: for formats
                           // that have polygons
    void add_face(std::int32_t a, std::int32_t b, std::int32_t marker, std::size_t offset);

private:
    std::unordered_map<std::string, std::int32_t> marker_numbers_;  // of `markers`, for add_marker
};

}  // namespace cli
