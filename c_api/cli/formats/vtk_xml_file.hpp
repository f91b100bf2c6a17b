// The tags of a VTK XML file of an unstructured or structured grid: the pieces, the arrays of the
// pieces, and how the file stores numbers.
#pragma once

#include "formats/xml.hpp"
#include "mesh/mesh_file.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace cli {

// Arrays of VTK XML files with binary data: raw or in base64, in the section AppendedData or each
// in its tag, and compressed block by block or not.

struct VtkEncoding {
    bool swapped = false;    // numbers are not in this machine's byte order
    int header_bytes = 4;    // bytes of each number before an array
    std::string compressor;  // empty: none
    std::size_t appended =
        0;                // the place in the file where appended arrays begin; 0: no such arrays
    bool is_raw = false;  // appended arrays are raw, and not in base64
};

struct VtkArray {
    bool is_there = false, is_appended = false, is_binary = false;  // otherwise text
    std::string type, components;
    std::size_t tag = 0;             // the place of the tag in the file
    std::size_t begin = 0, end = 0;  // the place of the text in the file; for an appended array,
                                     // begin is the offset
    std::size_t offset_at = 0, offset_length = 0;  // the place of the attribute offset in the file

    int number_bytes() const;  // of a number of this type; 8 for types that are not read

    bool is_encoded(const VtkEncoding& as) const {
        return is_binary || (is_appended && (!as.is_raw || !as.compressor.empty()));
    }
};

// The place of an array that is_encoded, and the place of its decoded bytes, which are appended to
// the text of the file.
struct VtkDecoded {
    std::size_t begin = 0, end = 0;  // in the file
    std::size_t bytes = 0, bytes_end = 0;
    std::size_t block = 0;        // bytes of each compressed block except for the last one
    bool has_own_header = false;  // base64: the header was encoded apart from the data
    bool is_raw = false, is_appended = false;
};

// Appends the bytes of an array to `text`, which begins with the whole file. Refuses, before it
// unpacks anything, an array of more than max_bytes.
VtkDecoded decode_vtk(const TextFile& file, const VtkEncoding& as, const VtkArray& array,
                      const std::string& name, std::size_t max_bytes, std::string& text);

// Returns the array with other bytes, encoded as in the file.
std::string encode_vtk(const VtkEncoding& as, const VtkDecoded& array, std::string_view bytes);

// Writes the file with other coordinates, for FileCoordinates::store: `text` is the file and,
// after the file, the decoded arrays. The text of arrays whose bytes have changed is replaced, and
// the offsets of later arrays are changed by the differences in length.
struct VtkStore {
    VtkEncoding encoding;
    std::size_t file_size = 0;
    std::vector<VtkDecoded> points;
    std::vector<VtkArray> appended;  // all appended arrays of the file

    void operator()(std::ostream& out, const Mesh& mesh, const std::string& text) const;
};

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

// Tells whether the content looks like a VTK XML file.
bool is_vtk_xml(const TextFile& file);

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
