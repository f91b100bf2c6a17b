// The data of mesh and basis for the pages of `harmorph explore` and `harmorph morph --report`.
#pragma once

#include "commands/morph.hpp"
#include "page/page_selection.hpp"

#include <iosfwd>
#include <string>

namespace cli {

// Writes one JSON object, which page/decode.js describes. moves is the text of a file of movements
// to begin with, or empty.
void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                     const PageSelection& selection, const std::string& moves);
// Writes the same object without functions, and with the displacement of each point and the
// program's findings; page/report.js describes these.
void write_report_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                       const PageSelection& selection, const Morph& morph, bool safe);

}  // namespace cli
