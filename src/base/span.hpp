// Defines a view of contiguous elements, and functions that copy and fill views.
#pragma once

#include <cstring>

#include "base/types.hpp"

namespace harmorph {

// Loops run over the numbers first .. after - 1 of an IndexRange.
struct IndexRange {
    Index first = 0, after = 0;

    struct Iterator {
        Index at;
        constexpr Index operator*() const noexcept { return at; }
        constexpr Iterator& operator++() noexcept { return ++at, *this; }
        constexpr bool operator!=(Iterator other) const noexcept { return at != other.at; }
    };
    constexpr Iterator begin() const noexcept { return {first}; }
    constexpr Iterator end() const noexcept { return {after}; }
    constexpr Index count() const noexcept { return after - first; }
};

template <class T>
class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T* data, Size size) noexcept : data_(data), size_(size) {}
    constexpr operator Span<const T>() const noexcept { return {data_, size_}; }

    template <class I>
    constexpr T& operator[](I i) const noexcept {
        return data_[i];
    }
    constexpr T* data() const noexcept { return data_; }
    constexpr Size size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr Index count() const noexcept { return static_cast<Index>(size_); }
    constexpr T* begin() const noexcept { return data_; }
    constexpr T* end() const noexcept { return data_ + size_; }
    template <class I>
    constexpr Span first(I n) const noexcept {
        return {data_, static_cast<Size>(n)};
    }
    template <class I, class J>
    constexpr Span from(I start, J n) const noexcept {
        return {data_ + start, static_cast<Size>(n)};
    }

private:
    T* data_ = nullptr;
    Size size_ = 0;
};

template <class T>
void fill(Span<T> to, T value) noexcept {
    for (T& element : to) element = value;
}

template <class T>
bool contains(Span<const T> list, T const& value) noexcept {
    for (T const& element : list) {
        if (element == value) return true;
    }
    return false;
}

template <class T>
void copy(Span<T> to, Span<const T> from) noexcept {
    static_assert(__is_trivially_copyable(T), "copied as bytes");
    if (!from.empty()) std::memcpy(to.data(), from.data(), from.size() * sizeof(T));
}

// A view of rows of numbers in an array of the caller or the core, with one row for each position:
// for example the values of all functions at the unknowns' points.
template <class Number>
struct RowsOf {
    Number* data = nullptr;
    // [n] The row of each position; null means that row and position have the same number.
    const Index* row_of = nullptr;
    Offset row_length = 0;  // the distance from one row to the next, in numbers
    Index width = 0;        // the number of right-hand sides
    // The distance from the real parts of a row to the imaginary parts, for complex values.
    Offset plane = 0;

    Number* operator[](Index position) const noexcept {
        return data + (row_of != nullptr ? row_of[position] : position) * row_length;
    }
};
using Rows = RowsOf<Real>;

}  // namespace harmorph
