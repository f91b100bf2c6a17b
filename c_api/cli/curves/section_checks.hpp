// Checks of the outline of a section: stray points, jumps, crossings, leading edges, orientation.
#pragma once

#include "curves/section_rows.hpp"

#include <string>
#include <vector>

namespace cli {

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
