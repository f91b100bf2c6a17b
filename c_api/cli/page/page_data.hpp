// What the pages of `harmorph explore` and `harmorph morph --report` know of mesh and basis.
#pragma once

#include "commands/morph.hpp"
#include "page/page_selection.hpp"

#include <iosfwd>
#include <string>

namespace cli {

// One JSON object; page/decode.js says what is in it. moves: the text of a file of movements to
// begin with, or empty.
void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                     const PageSelection& selection, const std::string& moves);
// The same without functions, but with where everything went and what the program says of it; see
// page/report.js.
void write_report_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                       const PageSelection& selection, const Morph& morph, bool safe);

}  // namespace cli
