// Numbers at a place of a file, in text or binary.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstring>

namespace cli {

// The bytes of a number of 1, 2, 4 or 8 bytes; swapped: in the other byte order. The caller has
// checked that they are there.
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

// The file's coordinate that begins at the offset.
double read_number(const Mesh& mesh, std::size_t offset);
std::size_t number_length(const Mesh& mesh, std::size_t offset);
void store_real(char* bytes, double value, const FileCoordinates& as);

}  // namespace cli
