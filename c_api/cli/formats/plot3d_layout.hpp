// How a PLOT3D file is laid out. Nothing in it says so: a layout is right if the file is exactly as
// long as it asks for.
#pragma once

#include "basics/text_file.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cli {

struct Plot3dBlock {
    std::array<std::int64_t, 3> n;  // points in i, j, k; k is 1 in files of two dimensions
    std::size_t data;               // binary: where its x begin
    std::int64_t points() const { return n[0] * n[1] * n[2]; }
};

struct Plot3dLayout {
    int dimensions = 0;      // 2 or 3
    bool has_count = false;  // begins with the number of blocks
    bool has_iblank = false;
    bool is_text = false;
    bool swapped = false;
    int record_bytes =
        0;  // of the length before and after each record: 0 (stream), 4, 8 (Fortran, unformatted)
    int real_bytes = 8;
    std::size_t data = 0;  // text: where the first x is
    std::vector<Plot3dBlock> blocks;
};

// False: none fits. Then `reason` says what the likeliest lacks, if there is a likely one.
bool find_plot3d_layout(const TextFile& file, Plot3dLayout& layout, std::string& reason);

}  // namespace cli
