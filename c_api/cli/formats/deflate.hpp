// Reads and writes data compressed by zlib, and files compressed by gzip. Programs made without
// zlib refuse them.
#pragma once

#include "files/text_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace cli {

constexpr std::size_t max_zlib_ratio = 1032;  // of sizes, uncompressed to compressed

// Returns a clause that says that the program has no zlib, or nothing if it has.
std::string lack_of_zlib();

// Appends `size` bytes from these data. Returns false if the data are damaged, or hold another
// number of bytes.
bool inflate_block(std::string_view data, std::size_t size, std::string& to);
std::string deflate_block(std::string_view bytes);

bool is_gzip(std::string_view data);
// Reads the file at this path, which may be compressed by gzip.
TextFile read_unpacked(const std::string& path);
TextFile unpacked(const TextFile& file);  // for a file that is_gzip
std::string gzip(std::string_view bytes);

}  // namespace cli
