// VTK's parallel XML files of unstructured grids (.pvtu), which name a file (.vtu) for each piece.
#pragma once

#include "files/text_file.hpp"

#include <string>
#include <vector>

namespace cli {

// Tells whether the file begins as a parallel file does.
bool is_parallel_vtk(const TextFile& file);

// Returns one file of all pieces, as a file .vtu has them: the pieces are copied byte by byte, and
// the offsets of appended arrays are increased by the length of preceding data. Messages name the
// file of the piece and the place in it. Refuses pieces that store numbers in different ways,
// pieces with ghost cells, and a file that is named twice.
TextFile joined_pieces(const TextFile& parallel);

// Returns the paths of the files of the pieces, or nothing if the file cannot be read.
std::vector<std::string> piece_files(const std::string& parallel);

}  // namespace cli
