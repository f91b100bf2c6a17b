// Arrays as the core's arenas and BLAS libraries lay them out: from the beginning of a cache line
// on.
#pragma once

#include <new>
#include <vector>

namespace bench {

template <class T>
struct LineAligned {
    using value_type = T;
    static constexpr std::align_val_t line{64};

    LineAligned() = default;
    template <class U>
    LineAligned(LineAligned<U> const&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
    void deallocate(T* data, std::size_t) { ::operator delete(data, line); }
    template <class U>
    bool operator==(LineAligned<U> const&) const {
        return true;
    }
    template <class U>
    bool operator!=(LineAligned<U> const&) const {
        return false;
    }
};

using Numbers = std::vector<double, LineAligned<double>>;

}  // namespace bench
