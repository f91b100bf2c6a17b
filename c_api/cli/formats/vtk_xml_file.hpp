// The tags of a VTK XML file of an unstructured or structured grid: the pieces, the arrays of the
// pieces, and how the file stores numbers.
#pragma once

#include "formats/vtk_data.hpp"
#include "formats/xml.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cli {

struct VtkPiece {
    std::size_t tag = 0;                     // place of the tag in the file
    std::int64_t n_points = 0, n_cells = 0;  // of unstructured grids
    std::int64_t size[3] = {0, 0, 0};        // of structured grids: points along i, j, k
    VtkArray points, connectivity, offsets, types;
    std::vector<std::pair<std::string, VtkArray>> point_data;  // by names
};

struct VtkXmlFile {
    VtkEncoding encoding;
    bool is_structured = false;
    std::vector<VtkPiece> pieces;
    std::vector<VtkArray> appended;  // all appended arrays, also those that are not read
};

// Finds the arrays of all pieces. Refuses other kinds of files, and tags that VTK does not write.
VtkXmlFile read_vtk_xml_tags(const TextFile& file);

// Reads the tag <VTKFile>. Refuses a byte order or a type of headers that VTK does not have. Does
// not check the type of the grid.
VtkEncoding vtk_encoding(const TextFile& file, const XmlTag& tag);

// Finds where the data begin after the tag <AppendedData>.
void find_appended(const TextFile& file, const XmlTag& tag, VtkEncoding& encoding);

// Returns the attribute "offset" of an appended array. Refuses what is no place in the file.
std::size_t appended_offset(const TextFile& file, const XmlTag& tag);

}  // namespace cli
