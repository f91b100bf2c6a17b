// Recognises CGNS files, in programs with and without CGNS.
#pragma once

#include "files/text_file.hpp"

namespace cli {

// Tells whether the content is that of an HDF5 or ADF file, which a CGNS file is.
bool is_cgns(const TextFile& file);

// Says that the program is not made with CGNS.
[[noreturn]] void refuse_cgns(const TextFile& file);

}  // namespace cli
