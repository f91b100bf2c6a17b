// Supports tables with one row for each value of an enumeration, and sets of such values.
// tests/base/test_scalar.cpp covers this file.
#pragma once

#include "base/types.hpp"

namespace harmorph {

template <class... Values>
constexpr unsigned set_of(Values... values) noexcept {
    return ((1u << static_cast<unsigned>(values)) | ... | 0u);
}
template <class Value>
constexpr bool contains(unsigned set, Value value) noexcept {
    return (set >> static_cast<unsigned>(value) & 1u) != 0;
}
// Returns whether the table has a row with this number.
template <class Row, Size n>
constexpr bool has_row(Row const (&)[n], std::int32_t number) noexcept {
    return number >= 0 && static_cast<Size>(number) < n;
}

}  // namespace harmorph
