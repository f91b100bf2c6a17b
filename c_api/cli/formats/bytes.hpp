// Reads and writes numbers at a place of a file, in text or binary.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace cli {

// Returns the number in 1, 2, 4 or 8 bytes; swapped: the other byte order. The caller has checked
// that the bytes exist.
template <class Number>
Number load(const char* bytes, bool swapped) {
    char copy[sizeof(Number)];
    for (std::size_t i = 0; i < sizeof copy; ++i)
        copy[i] = bytes[swapped ? sizeof copy - 1 - i : i];
    Number value;
    std::memcpy(&value, copy, sizeof value);
    return value;
}

inline bool little_endian_machine() {
    const std::uint16_t one = 1;
    unsigned char first;
    std::memcpy(&first, &one, 1);
    return first == 1;
}

// Returns the coordinate that begins at this place of the file.
double read_number(const Mesh& mesh, std::size_t offset);
std::size_t number_length(const Mesh& mesh, std::size_t offset);
// Returns the place of the coordinate that follows a number which ends before `end`.
std::size_t next_number(const Mesh& mesh, std::size_t end);
void store_real(char* bytes, double value, const FileCoordinates& as);

// Converts bytes to text of 64 characters (RFC 4648) and back, as XML files need.

// Decodes the text from `at` on, and appends n bytes or up to two more to `to`. `at` becomes the
// place after the last group of four characters that was decoded. Blanks are skipped, and several
// texts, each with its padding (=), may follow each other. Returns false if another character is
// found, or the text ends before n bytes.
bool decode_base64(std::string_view text, std::size_t& at, std::size_t n, std::string& to);

std::string encode_base64(std::string_view bytes);

}  // namespace cli
