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
    if (from.size() != 0) std::memcpy(to.data(), from.data(), from.size() * sizeof(T));
}

}  // namespace harmorph
