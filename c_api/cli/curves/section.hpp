// Sections as points: read from airfoil files, sampled from curves, and written as airfoil files.
#pragma once

#include "curves/curves.hpp"
#include "files/text_file.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// The section of a body as points in order. One reader serves all commands and the Python package:
//
//     one run     lines x y from the trailing edge round the section (Selig), in either direction
//     two sides   both from the leading edge, with a line of both numbers of points (Lednicer) or
//                 without, or both from the trailing edge; a blank line may lie between
//     elements    outlines separated by "999.0 999.0" (MSES, XFOIL), a blank line or a zone
//
// Before the points, titles, headers of Tecplot and of tables, a count, the domain of MSES and the
// reference point of OpenFAST may stand; notes may stand among the points. Columns may be separated
// by blanks, commas or semicolons, be numbered, and contain a constant z.

struct Section {
    std::vector<double> x, y;  // the first point of a loop is not repeated
    bool is_loop = true;
    std::string layout;                 // of a file: what the reader recognised, for people
    std::vector<std::string> warnings;  // of a file: sentences that begin with the path
};

// Points within 1e-12 of the extent of the point before are left out. Outlines that jump or cross
// themselves are refused; errors name the line. read_section() returns the element K (from 1), or
// with 0 the only one. Several threads may call these functions; nothing prints.
std::vector<Section> read_sections(const std::string& path);
Section read_section(const std::string& path, std::int32_t element = 0);
bool is_section_file(const TextFile& file);  // by the content

// Returns points on the first curve, ten for each span between knots. Other curves, such as a
// straight base, are not sampled.
Section sampled(const Curves& curves);

// Writes the format of Selig: the points of the first curve, counter-clockwise from an end of the
// curve, or from the largest x of a periodic curve.
void write_selig(std::ostream& out, const Curves& curves);

}  // namespace cli
