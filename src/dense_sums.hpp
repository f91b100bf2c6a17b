// Sums of rows, for one kind of vector register; see dense_kernel.hpp for what is defined where this is included.
#include "dense_tiles.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

template <class Number>
HARMORPH_INLINE Number magnitude(Number x) noexcept { return x < 0 ? -x : x; }

enum class Signs { kept, dropped };

template <Signs signs, class Number>
HARMORPH_INLINE Vector<Number> term(Vector<Number> v) noexcept {
    return signs == Signs::dropped ? (v < 0 ? -v : v) : v;
}

// The sum of n numbers.
template <Signs signs = Signs::kept, class Number>
HARMORPH_INLINE Number sum_of(const Number* from, Index n) noexcept {
    Vector<Number> partial[2] = {};
    Index k = 0;
    for (; k + 2 * lanes<Number> <= n; k += 2 * lanes<Number>) {
        partial[0] += term<signs, Number>(load(from + k));
        partial[1] += term<signs, Number>(load(from + k + lanes<Number>));
    }
    if (k + lanes<Number> <= n) {
        partial[0] += term<signs, Number>(load(from + k));
        k += lanes<Number>;
    }
    if (k < n) partial[1] += term<signs, Number>(Registers<Number>::load_first(from + k, n - k));
    Number each[lanes<Number>];
    store(each, partial[0] + partial[1]);
    for (Index half = lanes<Number> / 2; half > 0; half /= 2) {
        for (Index lane = 0; lane < half; ++lane) each[lane] += each[lane + half];
    }
    return each[0];
}

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
