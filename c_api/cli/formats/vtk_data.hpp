// Arrays of VTK's XML files in the ways in which these files hold binary data: raw or in base64,
// behind each other or each in its place, and compressed block by block or not.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace cli {

struct VtkEncoding {
    bool swapped = false;      // numbers are not in this machine's byte order
    int header_bytes = 4;      // of each number before an array
    std::string compressor;    // empty: none
    std::size_t appended = 0;  // where appended arrays begin in the file; 0: there are none
    bool is_raw = false;       // appended arrays are raw, and not in base64
};

struct VtkArray {
    bool is_there = false, is_appended = false, is_binary = false;  // neither of both: text
    std::string type, components;
    std::size_t tag = 0;             // where the tag begins in the file
    std::size_t begin = 0, end = 0;  // in the file: of the text in its place; of an appended array,
                                     // begin is its offset
    std::size_t offset_at = 0, offset_length = 0;  // in the file: the value of the attribute offset

    bool is_encoded(const VtkEncoding& as) const {
        return is_binary || (is_appended && (!as.is_raw || !as.compressor.empty()));
    }
};

// Where an array that is_encoded was found, and where its bytes stand behind the text of the file.
struct VtkDecoded {
    std::size_t begin = 0, end = 0;  // in the file
    std::size_t bytes = 0, bytes_end = 0;
    std::size_t block = 0;        // bytes of a compressed block but the last
    bool has_own_header = false;  // in base64: the header is a text of its own
    bool is_raw = false, is_appended = false;
};

// Appends the bytes of an array to `text`, which begins with the whole file.
VtkDecoded decode_vtk(const TextFile& file, const VtkEncoding& as, const VtkArray& array,
                      const std::string& name, std::string& text);

// The array with other bytes, as it stands in the file.
std::string encode_vtk(const VtkEncoding& as, const VtkDecoded& array, std::string_view bytes);

// The file with other coordinates, for FileCoordinates::store: `text` is the file and, behind it,
// the decoded arrays. Of arrays with other bytes the text is replaced; offsets of the arrays behind
// them grow or shrink with it.
struct VtkStore {
    VtkEncoding encoding;
    std::size_t file_size = 0;
    std::vector<VtkDecoded> points;
    std::vector<VtkArray> appended;  // all that the file has

    void operator()(std::ostream& out, const Mesh& mesh, const std::string& text) const;
};

}  // namespace cli
