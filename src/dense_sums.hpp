// Sums of rows, for one kind of vector register; see dense_kernel.hpp for what is defined where this is included.
#include "dense_tiles.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

template <class Number>
HARMORPH_INLINE Number magnitude(Number x) noexcept { return x < 0 ? -x : x; }

// The sum of a register's numbers.
template <class Number>
HARMORPH_INLINE Number total(Vector<Number> v) noexcept {
    typedef Number Quarter __attribute__((vector_size(16), aligned(sizeof(Number)), may_alias));
    constexpr Index in_quarter = static_cast<Index>(sizeof(Quarter) / sizeof(Number));
    Number each[lanes<Number>];
    store(each, v);
    Quarter sum = *reinterpret_cast<const Quarter*>(each);
    for (Index k = in_quarter; k < lanes<Number>; k += in_quarter) sum += *reinterpret_cast<const Quarter*>(each + k);
    if constexpr (in_quarter == 4) return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    return sum[0] + sum[1];
}

// The sum of a row's n numbers, and of their real parts without signs.
template <Index planes, class Number>
struct RowSum {
    Number sum[planes], size;

    RowSum(Block<Number> row, Index n) noexcept {
        Vector<Number> partial[planes] = {}, sizes = {};
        for (Index k = 0; k < n; k += lanes<Number>) {
            Index const wanted = smaller(lanes<Number>, n - k);
            Vector<Number> const real = Registers<Number>::load_first(row.data + k, wanted);
            partial[0] += real;
            sizes += real < 0 ? -real : real;
            if constexpr (planes == 2) partial[1] += Registers<Number>::load_first(row.data + row.plane + k, wanted);
        }
        for (Index p = 0; p < planes; ++p) sum[p] = total<Number>(partial[p]);
        size = total<Number>(sizes);
    }
};

// sums [columns] -= U^H y of n <= block rows of U.
template <Index planes, class Number>
void subtract_sums(Block<Number> u, Index n, Index columns, const Number* y, Number* sums, Offset plane) noexcept {
    for (Index c = 0; c < columns; c += lanes<Number>) {
        Index const wanted = smaller(lanes<Number>, columns - c);
        Vector<Number> sum[planes];
        for (Index p = 0; p < planes; ++p) sum[p] = Registers<Number>::load_first(sums + p * plane + c, wanted);
        for (Index r = 0; r < n; ++r) {
            const Number* const row = u.data + r * u.length + c;
            Vector<Number> const real = load(row);
            sum[0] -= y[r] * real;
            if constexpr (planes == 2) {
                Vector<Number> const imaginary = load(row + u.plane);
                sum[0] -= y[plane + r] * imaginary;
                sum[1] -= y[plane + r] * real - y[r] * imaginary;
            }
        }
        for (Index p = 0; p < planes; ++p) Registers<Number>::store_first(sums + p * plane + c, sum[p], wanted);
    }
}

// Forward elimination of row sums: those of a diagonal block, whose inverse stands in its place, and of `behind` rows.
template <Index planes, class Number>
void eliminate_sums(Block<Number> inverse, Index n, Index behind, Number* sums, Offset plane) noexcept {
    for (Index r = n - 1; r >= 0; --r) {
        Number sum[planes] = {};
        for (Index k = 0; k <= r; ++k) {
            Number const real = inverse.data[r * inverse.length + k];
            sum[0] += real * sums[k];
            if constexpr (planes == 2) {
                Number const imaginary = inverse.data[r * inverse.length + inverse.plane + k];
                sum[0] -= imaginary * sums[plane + k];
                sum[1] += real * sums[plane + k] + imaginary * sums[k];
            }
        }
        for (Index p = 0; p < planes; ++p) sums[p * plane + r] = sum[p];
    }
    subtract_sums<planes>(inverse.at(0, n), n, behind, sums, sums + n, plane);
}

}  // namespace
}  // namespace harmorph::dense::HARMORPH_KERNEL
