// Repeat counts of list-directed output of Fortran, such as 3*1.0 for 1.0 1.0 1.0.
#pragma once

#include "files/text_file.hpp"

namespace cli {

// Returns false if the file has no repeat count. Otherwise `expanded` is the text with every number
// written out, in the same line. Refuses counts that no grid has: along one direction of a block,
// one coordinate at least changes from point to point, so a file has no more than four numbers
// (three coordinates and iblank) for each that is written.
bool expand_repeats(const TextFile& file, std::string& expanded);

}  // namespace cli
