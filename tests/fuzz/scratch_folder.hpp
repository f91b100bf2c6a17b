// A folder for the files of cases, a small mesh with five markers, and damage to texts, for
// commands and readers.
#pragma once

#include "failure.hpp"
#include "input.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdlib.h>
#include <string>
#include <vector>

namespace fuzz {

// A folder of this process, which goes with it.
class ScratchFolder {
public:
    ScratchFolder() {
        for (const char* const parent : {"/dev/shm", "/tmp"}) {
            path_ = std::string(parent) + "/harmorph-fuzz-XXXXXX";
            if (mkdtemp(path_.data()) != nullptr) return;
        }
        expect(false, "no scratch folder");
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(ScratchFolder const&) = delete;
    std::string file(const char* name) const { return path_ + '/' + name; }
    std::string write(const char* name, std::string const& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }
    // Returns the names of what is in the folder, or in a folder there.
    std::vector<std::string> names(const char* in = "") const {
        std::vector<std::string> found;
        for (auto const& entry : std::filesystem::directory_iterator(file(in)))
            found.push_back(entry.path().filename().string());
        return found;
    }

private:
    std::string path_;
};

inline std::string text_of(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The curve of the block of box().
inline constexpr char block_curve[] =
    "degree 1\nclosed tied\npoints 4\n2 2\n4 2\n4 4\n2 4\nknots 7\n0 0 2 4 6 8 8\n";

// 6 x 6 cells round a block of 2 x 2, each side and the block with a marker.
inline std::string box() {
    constexpr int n = 6;
    std::ostringstream cells, points, faces;
    int number[n + 1][n + 1], n_points = 0, n_cells = 0;
    auto const is_in_block = [](int i, int j) { return 2 <= i && i < 4 && 2 <= j && j < 4; };
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            if (i == 3 && j == 3) continue;
            number[i][j] = n_points++;
            points << i << ' ' << j << '\n';
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            if (is_in_block(i, j)) continue;
            cells << "9 " << number[i][j] << ' ' << number[i + 1][j] << ' ' << number[i + 1][j + 1]
                  << ' ' << number[i][j + 1] << '\n';
            ++n_cells;
        }
    }
    auto const side = [&](const char* name, int first, int last, auto const& point) {
        faces << "MARKER_TAG= " << name << "\nMARKER_ELEMS= " << last - first << '\n';
        for (int k = first; k < last; ++k) faces << "3 " << point(k) << ' ' << point(k + 1) << '\n';
    };
    side("low", 0, n, [&](int k) { return number[k][0]; });
    side("high", 0, n, [&](int k) { return number[k][n]; });
    side("in", 0, n, [&](int k) { return number[0][k]; });
    side("out", 0, n, [&](int k) { return number[n][k]; });
    int const around[9][2] = {{2, 2}, {3, 2}, {4, 2}, {4, 3}, {4, 4},
                              {3, 4}, {2, 4}, {2, 3}, {2, 2}};
    side("block", 0, 8, [&](int k) { return number[around[k][0]][around[k][1]]; });
    std::ostringstream all;
    all << "NDIME= 2\nNELEM= " << n_cells << '\n'
        << cells.str() << "NPOIN= " << n_points << '\n'
        << points.str() << "NMARK= 5\n"
        << faces.str();
    return all.str();
}

// Pieces of a text go or come twice, or the text gets words that a table rarely has, or other
// bytes.
inline void damage_text(std::string& text, Input& input) {
    for (std::int32_t k = input.from(0, 3); k > 0 && !text.empty(); --k) {
        std::size_t const at = input.below(std::uint32_t(text.size())), length = input.below(40);
        switch (input.below(4)) {
            case 0: text.erase(at, length); break;
            case 1: text.insert(at, text.substr(at, length)); break;
            case 2:
                text.insert(at,
                            input.any_of({"nan",        "inf",        "-",          "+",   "1e999",
                                          "1e-400",     "0x1p3",      "D2",         " 7 ", "1,5",
                                          "2147483648", "2147483649", "4294967297", ",",   ",,",
                                          "\"",         ".",          "#",          "\n",  "\r",
                                          "\r\n",       " ",          "\t",         "\v",  "\f"}));
                break;
            default: text[at] = static_cast<char>(input.below(256));
        }
    }
}

}  // namespace fuzz
