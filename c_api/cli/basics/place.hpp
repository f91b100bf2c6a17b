// Conversion of the C header's numbers to positions in vectors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cli {

// The C header counts points and cells in 32 bits; vectors count in std::size_t.
constexpr std::size_t place(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace cli
