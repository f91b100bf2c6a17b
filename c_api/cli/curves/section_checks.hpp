// Checks of the outline of a section: stray points, jumps, crossings, leading edges, orientation.
#pragma once

#include "files/text_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// The lines of a file with the points of sections, sorted into numbers and texts. Columns may be
// separated by blanks, commas or semicolons; decimals may have a comma. `

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

// Lengths are in the unit of the points. An outline is a loop, whose first point is not repeated.
struct SectionFindings {
    std::string refusal;  // empty, or why the outline cannot be used, with both places
    std::size_t at = 0;   // the point at which the outline is refused
    std::vector<std::string> warnings;
};

using SectionOutline = std::vector<SectionPoint>;

// The largest distance between two points, nearly.
double extent_of(const SectionOutline& outline);
double area_of(const SectionOutline& outline);  // positive: counter-clockwise

// Returns the first point that is far from both neighbours, compared with the steps beside them,
// or the number of points: such a point is a typing error, a reference point or a title.
std::size_t stray_point(const SectionOutline& outline);

// An outline is refused if a point is stray, if a segment longer than half the chord is longer than
// ten times both neighbours (but for a base across the chord), if it crosses itself by more than
// rounding, or if it has no area. Warnings: other long segments, crossings by rounding, and more
// than one leading edge.
SectionFindings check_section(const TextFile& file, const SectionOutline& outline);

}  // namespace cli
