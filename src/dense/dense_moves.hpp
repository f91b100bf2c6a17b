// Moves of numbers between fronts, and between fronts and the caller's rows, with the registers of
// one instruction set. dense_table.cpp compiles this file for each set. tests/dense/test_dense.cpp
// covers this file.
#include "dense/dense_kernel.hpp"

namespace harmorph::dense::HARMORPH_SET {
namespace {

// The columns of a child front that are added to one vector of the parent front. They are
// neighbours in the child, where they lie in one vector or in two.
struct Source {
    Real* first;
    Real* second;
    Registers::Picks picks;

    // Takes the columns from <= j < to, whose targets are in the vector that begins at column
    // `begin`.
    Source(Slabs const& child, Index from, Index to, const Index* target, Index begin) noexcept {
        Index const column = from / lanes * lanes;
        Index picked[lanes];
        for (Index lane = 0; lane < lanes; ++lane) picked[lane] = none;
        for (Index j = from; j < to; ++j) picked[target[j] - begin] = j - column;
        first = child.at(0, column);
        second = to > column + lanes ? child.at(0, column + lanes) : first;
        picks = Registers::picks_of(picked);
    }
};

// Adds the rows from <= i < to of the child to the rows target[i] of the vector at `into`. Lanes of
// the vector without a source keep their numbers.
template <Index planes>
HARMORPH_INLINE void add_column(Source const& from, const Index* target, Range rows,
                                Real* into) noexcept {
    for (Index i = rows.begin; i < rows.end; ++i) {
        Offset const at = i * step<planes>;
        Real* const to = into + target[i] * step<planes>;
        for (Index p = 0; p < planes; ++p) {
            Offset const plane = p * slab;
            Vector const added = Registers::pick(load(from.first + at + plane),
                                                 load(from.second + at + plane), from.picks);
            store(to + plane, load(to + plane) + added);
        }
    }
}

// Adds whole vectors: entries below the diagonal change, too, but they are never used.
template <Index planes>
void add_front(Slabs const& from, const Index* target, Panel const& panel,
               Slabs const& update) noexcept {
    Slabs const own = panel.own(), border = panel.border_columns();
    Index j = 0;
    while (j < from.columns && target[j] < panel.pivots) {
        Index const begin = target[j] / lanes * lanes;
        Index const end = min(begin + lanes, panel.pivots);
        Index to = j + 1;
        while (to < from.columns && target[to] < end) ++to;
        add_column<planes>(Source(from, j, to, target, begin), target, {0, to}, own.at(0, begin));
        j = to;
    }
    Index const pivots = j;
    while (j < from.columns) {
        Index const begin = (target[j] - panel.pivots) / lanes * lanes;
        Index to = j + 1;
        while (to < from.columns && target[to] < panel.pivots + begin + lanes) ++to;
        Source const columns(from, j, to, target, panel.pivots + begin);
        add_column<planes>(columns, target, {0, pivots}, border.at(0, begin));
        add_column<planes>(columns, target, {pivots, to},
                           update.at(0, begin) - panel.pivots * step<planes>);
        j = to;
    }
}

// Copies the n numbers at `from` to `to`: as many at a time as a register has, and the rest by half
// as many at a time, repeatedly.
template <Index at_once = lanes>
HARMORPH_INLINE void copy_run(const Real* from, Index n, Real* to) noexcept {
    typedef Real Reals
        __attribute__((vector_size(at_once * sizeof(Real)), aligned(sizeof(Real)), may_alias));
    Index i = 0;
    for (; i + at_once <= n; i += at_once)
        *reinterpret_cast<Reals*>(to + i) = *reinterpret_cast<const Reals*>(from + i);
    if constexpr (at_once > 1) copy_run<at_once / 2>(from + i, n - i, to + i);
}

// Clears the last `slab` numbers, which may be padding. Their number is a constant, because
// compilers call memset for a variable one.
HARMORPH_INLINE void clear_last(Real* end) noexcept {
    for (Index i = 1; i <= slab; ++i) end[-i] = 0;
}

HARMORPH_INLINE Real* row_at(Real* data, const Index* row_of, Offset length,
                             Index position) noexcept {
    return data + (row_of != nullptr ? row_of[position] : position) * length;
}

// Rows of values are read in an irregular order, so the row that follows at this distance is
// prefetched.
constexpr Index rows_ahead = 16;

HARMORPH_INLINE void prefetch_row(const Real* row, Offset numbers) noexcept {
    constexpr Offset line = 64 / sizeof(Real);
    for (Offset i = 0; i < numbers; i += line) __builtin_prefetch(row + i);
}

void extend_add(UpdateMatrix const& from, const Index* targets, Panel const& panel,
                UpdateMatrix const& update) noexcept {
    if (from.planes == 2) add_front<2>(from.all(), targets, panel, update.all());
    else add_front<1>(from.all(), targets, panel, update.all());
}

void add_rows(Index n, const Real* from, const Index* targets, Real* y, Index length) noexcept {
    for (Index r = 0; r < n; ++r, from += length) {
        Real* const to = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes) store(to + c, load(to + c) + load(from + c));
    }
}

void copy_rows(Index n, const Real* y, const Index* targets, Real* to, Index length) noexcept {
    for (Index r = 0; r < n; ++r, to += length) {
        const Real* const from = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes) store(to + c, load(from + c));
    }
}

void gather(harmorph::Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
            Index planes) noexcept {
    auto const values = [&](Index k) {
        return row_at(from.data, from.row_of, from.row_length, begin + k);
    };
    Offset const numbers = (planes - 1) * from.plane + from.width;
    for (Index k = 0; k < n; ++k) {
        if (k + rows_ahead < n + behind) prefetch_row(values(k + rows_ahead), numbers);
        const Real* value = values(k);
        for (Index plane = 0; plane < planes; ++plane, value += from.plane, y += row) {
            if (from.width < row) clear_last(y + row);
            copy_run(value, from.width, y);
        }
    }
}

void scatter(const Real* y, Index row, Index planes, harmorph::Rows const& to, Index begin,
             Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        Real* value = row_at(to.data, to.row_of, to.row_length, begin + k);
        for (Index plane = 0; plane < planes; ++plane, value += to.plane, y += row)
            copy_run(y, to.width, value);
    }
}

constexpr MoveKernels move_kernels{extend_add, add_rows, copy_rows, gather, scatter};

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const dense::MoveKernels* table<dense::MoveKernels, Kernel::HARMORPH_SET> =
    &dense::HARMORPH_SET::move_kernels;
}  // namespace harmorph::simd
