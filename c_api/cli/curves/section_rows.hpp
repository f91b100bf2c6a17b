// The lines of a file with the points of sections, sorted into numbers and texts. Columns may be
// separated by blanks, commas or semicolons; decimals may have a comma. `#` and `!` begin comments.
#pragma once

#include "files/text_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct SectionPoint {
    double x = 0, y = 0;
    std::size_t offset = 0;  // of the line in the text of the file
};

// Consecutive points. Blank lines, comments, notes and lines of one number end a block.
struct SectionBlock {
    std::vector<SectionPoint> points;
    int element = 0;  // grows by 1 at each separator line "999.0 999.0" of MSES and XFOIL
};

struct SectionTable {
    std::vector<SectionBlock> blocks;     // none is empty
    std::vector<double> counts;           // two whole numbers before points of three columns, or
                                          // one number before the points
    std::vector<std::string> properties;  // what was recognised, for people
    bool is_openfast = false;             // the first point may be a reference point
};

// Fails with the line if a line between points has another number of columns or a word for a
// number, or if there are no points.
SectionTable read_section_table(const TextFile& file);

// Tells whether most of the first lines are lines of at least two numbers.
bool looks_like_section(const TextFile& file);

}  // namespace cli
