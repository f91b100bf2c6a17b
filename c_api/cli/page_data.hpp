// What the page of `harmorph explore` knows of mesh and basis.
#pragma once

#include "basis_file.hpp"
#include "page_selection.hpp"

#include <iosfwd>
#include <string>

namespace cli {

// One JSON object; page/decode.js says what is in it. moves: the text of a file of movements to begin with, or empty.
void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis, const PageSelection& selection,
                     const std::string& moves);

} // namespace cli
