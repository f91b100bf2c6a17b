// The numbers of a block of functions at one row, with the registers of one instruction set;
// cycle_kernel.hpp includes this file for each set. tests/multigrid/test_cycle.cpp covers this
// file.

namespace harmorph::cycles::HARMORPH_SET {
namespace {

// n numbers that stand side by side, in as few registers as the set allows.
template <class Number, Index n>
struct Lanes {
    static constexpr Index most = simd::HARMORPH_SET::Registers<Number>::lanes;
    static constexpr Index lanes = n < most ? n : most, parts = n / lanes;
    using Register = simd::HARMORPH_SET::Register<Number, lanes>;

    typename Register::Vector part[parts];

    static HARMORPH_INLINE Lanes zero() noexcept {
        Lanes out;
        for (Index p = 0; p < parts; ++p) out.part[p] = typename Register::Vector{};
        return out;
    }
    static HARMORPH_INLINE Lanes load(const Number* from) noexcept {
        Lanes out;
        for (Index p = 0; p < parts; ++p) out.part[p] = Register::load(from + p * lanes);
        return out;
    }
    // Loads the first `count` numbers, and 0 for the others.
    static HARMORPH_INLINE Lanes load_first(const Number* from, Index count) noexcept {
        if (count >= n) return load(from);
        Number numbers[n] = {};
        for (Index k = 0; k < count; ++k) numbers[k] = from[k];
        return load(numbers);
    }
    HARMORPH_INLINE void store(Number* to) const noexcept {
        for (Index p = 0; p < parts; ++p) Register::store(to + p * lanes, part[p]);
    }
    // Adds the numbers to sums in double precision.
    HARMORPH_INLINE void add_to(Real* sums) const noexcept {
        Number numbers[n];
        store(numbers);
        for (Index k = 0; k < n; ++k) sums[k] += static_cast<Real>(numbers[k]);
    }
    HARMORPH_INLINE Lanes& operator+=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] += other.part[p];
        return *this;
    }
    HARMORPH_INLINE Lanes& operator-=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] -= other.part[p];
        return *this;
    }
    friend HARMORPH_INLINE Lanes operator-(Lanes a, Lanes const& b) noexcept { return a -= b; }
    friend HARMORPH_INLINE Lanes operator*(Lanes a, Lanes const& b) noexcept {
        for (Index p = 0; p < parts; ++p) a.part[p] *= b.part[p];
        return a;
    }
    friend HARMORPH_INLINE Lanes operator*(Number factor, Lanes a) noexcept {
        for (Index p = 0; p < parts; ++p) a.part[p] *= factor;
        return a;
    }
};

// A number of each function, with a real and, if planes is 2, an imaginary part.
template <class Number, Index n, Index planes>
struct Values {
    using Part = Lanes<Number, n>;
    Part re, im;

    // plane: the distance from the real to the imaginary parts.
    static HARMORPH_INLINE Values load(const Number* from, Offset plane) noexcept {
        Values out;
        out.re = Part::load(from);
        if constexpr (planes == 2) out.im = Part::load(from + plane);
        return out;
    }
    static HARMORPH_INLINE Values load_first(const Number* from, Offset plane,
                                             Index count) noexcept {
        Values out;
        out.re = Part::load_first(from, count);
        if constexpr (planes == 2) out.im = Part::load_first(from + plane, count);
        return out;
    }
    HARMORPH_INLINE void store(Number* to, Offset plane) const noexcept {
        re.store(to);
        if constexpr (planes == 2) im.store(to + plane);
    }
    HARMORPH_INLINE Values& operator+=(Values const& other) noexcept {
        re += other.re;
        if constexpr (planes == 2) im += other.im;
        return *this;
    }
    HARMORPH_INLINE Values& operator-=(Values const& other) noexcept {
        re -= other.re;
        if constexpr (planes == 2) im -= other.im;
        return *this;
    }
    // Returns the product with x + i y.
    HARMORPH_INLINE Values times(Number x, Number y) const noexcept {
        Values out;
        out.re = x * re;
        if constexpr (planes == 2) {
            out.re -= y * im;
            out.im = x * im;
            out.im += y * re;
        }
        return out;
    }
    // Returns the real part of the product of the conjugate and `other`.
    HARMORPH_INLINE Part dot(Values const& other) const noexcept {
        Part out = re * other.re;
        if constexpr (planes == 2) out += im * other.im;
        return out;
    }
};

}  // namespace
}  // namespace harmorph::cycles::HARMORPH_SET
