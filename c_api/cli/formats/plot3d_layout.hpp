// The layout of a PLOT3D file. The file does not name its layout: a layout is right if the file has
// exactly the length that the layout needs.
#pragma once

#include "files/text_file.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cli {

struct Plot3dBlock {
    std::array<std::int64_t, 3> n;  // points in i, j, k; k is 1 in files of two dimensions
    std::size_t data;               // binary: the place of the first x in the file
    std::int64_t points() const { return n[0] * n[1] * n[2]; }
};

struct Plot3dLayout {
    int dimensions = 0;      // 2 or 3
    bool has_count = false;  // the file begins with the number of blocks
    bool has_iblank = false;
    bool is_text = false;
    bool swapped = false;
    int record_bytes =
        0;  // bytes of the length before and after each record: 4 or 8 (Fortran), 0 (no records)
    int real_bytes = 8;
    std::size_t data = 0;  // text: the place of the first x in the file
    std::vector<Plot3dBlock> blocks;
};

// Returns false if no layout fits. `reason` then says why the likeliest layout does not fit, if one
// is likely.
bool find_plot3d_layout(const TextFile& file, Plot3dLayout& layout, std::string& reason);

}  // namespace cli
