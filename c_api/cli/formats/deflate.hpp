// Data compressed by zlib, and files compressed by gzip. Programs made without zlib refuse them.
#pragma once

#include "basics/text_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace cli {

constexpr std::size_t largest_ratio_of_zlib = 1032;  // no compressed byte stands for more bytes

// Says that the program has no zlib; empty: the program has zlib.
std::string lack_of_zlib();

// Appends `size` bytes, which these data hold. False: the data are damaged, or hold another number
// of bytes.
bool inflate_block(std::string_view data, std::size_t size, std::string& to);
std::string deflate_block(std::string_view bytes);

bool is_gzip(std::string_view data);
// The file at this path; a file compressed by gzip as the text that it holds.
TextFile read_unpacked(const std::string& path);
TextFile unpacked(const TextFile& file);  // of a file that is_gzip
std::string gzip(std::string_view bytes);

}  // namespace cli
