// The check sum of ZIP files (CRC-32 of ISO 3309).
#pragma once

#include <cstddef>
#include <cstdint>

namespace cli {

// Returns the check sum of earlier bytes (0 if there are none) continued by these bytes.
std::uint32_t crc32_of(std::uint32_t earlier, const void* data, std::size_t size);

// Returns the check sum of two pieces of data, one after the other. size: bytes of the second one.
std::uint32_t crc32_joined(std::uint32_t first, std::uint32_t second, std::uint64_t size);

}  // namespace cli
