// A mesh as it was read from an SU2 file. It keeps the file's text: a morphed mesh is the same text with other numbers.
#pragma once

#include "harmorph.h"
#include "text_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct Mesh {
    TextFile file;
    std::vector<double> x, y;
    std::vector<std::int32_t> cell_start = {0}, cell_points; // compressed rows, counted from 0 as in the file
    std::vector<std::int32_t> face_points, face_markers;
    std::vector<std::string> markers;                        // their tags; a marker's number is its place here
    std::vector<std::size_t> point_offset, cell_offset, face_offset; // where each line stands in file.text()
    std::vector<std::string> remarks;                        // what was passed over, for the user

    explicit Mesh(const std::string& path) : file(path) {}

    std::int32_t points() const { return static_cast<std::int32_t>(x.size()); }
    std::int32_t cells() const { return static_cast<std::int32_t>(cell_start.size()) - 1; }
    std::int32_t faces() const { return static_cast<std::int32_t>(face_markers.size()); }
    std::int32_t faces(std::int32_t marker) const;

    hm_points coordinates() const { return {x.data(), y.data(), 1}; } // for the library, of these arrays
    hm_mesh view() const;

    // The numbers of the markers in a list "A,B"; a tag the file does not have is wrong usage. A tag may hold commas.
    std::vector<std::int32_t> find_markers(const std::string& list) const;
};

} // namespace cli
