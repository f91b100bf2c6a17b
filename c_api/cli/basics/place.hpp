// Where something stands in a vector.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cli {

// The C header counts points and cells in 32 bits, vectors in the machine's size.
constexpr std::size_t place(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace cli
