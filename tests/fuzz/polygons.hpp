// Domains of polygons, and how the header judges them: which areas have to be positive.
#pragma once

#include "problem.hpp"

namespace fuzz {

// Some cells become one with a neighbour, and some edges inside get a point in their middle:
// polygons, convex or not, with hanging nodes. From then on has_polygons.
void make_polygons(Domain& domain, Input& input);

// Three points of a cell, counter-clockwise: the area at `here` between its two sides, the first
// one turned back by an angle of this cosine and sine, has to be positive.
struct JudgedCorner {
    std::size_t cell;
    std::int32_t before, here, after;
    double cosine = 1, sine = 0;
};

struct Judged {
    std::vector<JudgedCorner> corners;                   // of each cell in turn
    std::vector<std::array<std::int32_t, 3>> triangles;  // of divided cells
    std::vector<bool> is_divided;                        // [cells]
    std::int32_t ambiguous = 0;  // cells with two divisions that are equally good: no triangles
};

// The sine of a turned corner has rounding errors: smaller sines may have either sign.
inline double rounding_of_turns(Domain const& domain) { return domain.has_polygons ? 1e-15 : 0; }

// The corners of cells are taken as they are listed, counter-clockwise. Divisions are found by
// recursion, in more digits than the library has.
Judged judge_by_header(Domain const& domain);

}  // namespace fuzz
