// Moves of numbers between fronts, and between fronts and the caller's rows, with the registers of
// one instruction set. dense_table.cpp compiles this file for each set. tests/dense/test_dense.cpp
// covers this file.
#include "dense/dense_kernel.hpp"

namespace harmorph::dense::HARMORPH_SET {
namespace {

// The columns of a child front that are added to one vector of the parent front. They are
// neighbours in the child, where they lie in one vector or in two.
template <class Number>
struct Source {
    Number* first;
    Number* second;
    typename Registers<Number>::Picks picks;

    // Takes the columns from <= j < to, whose targets are in the vector that begins at column
    // `begin`.
    Source(Slabs<Number> const& child, Index from, Index to, const Index* target,
           Index begin) noexcept {
        Index const column = from / lanes<Number> * lanes<Number>;
        Index picked[lanes<Number>];
        for (Index lane = 0; lane < lanes<Number>; ++lane) picked[lane] = none;
        for (Index j = from; j < to; ++j) picked[target[j] - begin] = j - column;
        first = child.at(0, column);
        second = to > column + lanes<Number> ? child.at(0, column + lanes<Number>) : first;
        picks = Registers<Number>::picks_of(picked);
    }
};

// Adds the rows from <= i < to of the child to the rows target[i] of the vector at `into`. Lanes of
// the vector without a source keep their numbers.
template <Index planes, class Number>
HARMORPH_INLINE void add_column(Source<Number> const& from, const Index* target, Range rows,
                                Number* into) noexcept {
    for (Index i = rows.begin; i < rows.end; ++i) {
        Offset const at = i * step<planes>;
        Number* const to = into + target[i] * step<planes>;
        for (Index p = 0; p < planes; ++p) {
            Offset const plane = p * slab;
            Vector<Number> const added = Registers<Number>::pick(
                load(from.first + at + plane), load(from.second + at + plane), from.picks);
            store(to + plane, load(to + plane) + added);
        }
    }
}

// Adds whole vectors: entries below the diagonal change, too, but they are never used.
template <Index planes, class Number>
void add_front(Slabs<Number> const& from, const Index* target, Panel<Number> const& panel,
               Slabs<Number> const& update) noexcept {
    Slabs<Number> const own = panel.own(), border = panel.border_columns();
    Index j = 0;
    while (j < from.columns && target[j] < panel.pivots) {
        Index const begin = target[j] / lanes<Number> * lanes<Number>;
        Index const end = min(begin + lanes<Number>, panel.pivots);
        Index to = j + 1;
        while (to < from.columns && target[to] < end) ++to;
        add_column<planes>(Source<Number>(from, j, to, target, begin), target, {0, to},
                           own.at(0, begin));
        j = to;
    }
    Index const pivots = j;
    while (j < from.columns) {
        Index const begin = (target[j] - panel.pivots) / lanes<Number> * lanes<Number>;
        Index to = j + 1;
        while (to < from.columns && target[to] < panel.pivots + begin + lanes<Number>) ++to;
        Source<Number> const columns(from, j, to, target, panel.pivots + begin);
        add_column<planes>(columns, target, {0, pivots}, border.at(0, begin));
        add_column<planes>(columns, target, {pivots, to},
                           update.at(0, begin) - panel.pivots * step<planes>);
        j = to;
    }
}

// Converts the n numbers at `from` to `to`: as many at a time as doubles fill a register, and the
// rest by half as many at a time, repeatedly.
template <Index at_once = lanes<double>, class From, class To>
HARMORPH_INLINE void convert_run(const From* from, Index n, To* to) noexcept {
    typedef From Froms
        __attribute__((vector_size(at_once * sizeof(From)), aligned(sizeof(From)), may_alias));
    typedef To Tos
        __attribute__((vector_size(at_once * sizeof(To)), aligned(sizeof(To)), may_alias));
    Index i = 0;
    for (; i + at_once <= n; i += at_once) {
        *reinterpret_cast<Tos*>(to + i) =
            __builtin_convertvector(*reinterpret_cast<const Froms*>(from + i), Tos);
    }
    if constexpr (at_once > 1) convert_run<at_once / 2>(from + i, n - i, to + i);
}

// Clears the last `slab` numbers, which may be padding. Their number is a constant, because
// compilers call memset for a variable one.
template <class Number>
HARMORPH_INLINE void clear_last(Number* end) noexcept {
    for (Index i = 1; i <= slab; ++i) end[-i] = 0;
}

template <class Value>
HARMORPH_INLINE Value* row_at(Value* data, const Index* row_of, Offset length,
                              Index position) noexcept {
    return data + (row_of != nullptr ? row_of[position] : position) * length;
}

// Rows of values are read in an irregular order, so the row that follows at this distance is
// prefetched.
constexpr Index rows_ahead = 16;

template <class Value>
HARMORPH_INLINE void prefetch_row(const Value* row, Offset numbers) noexcept {
    constexpr Offset line = 64 / sizeof(Value);
    for (Offset i = 0; i < numbers; i += line) __builtin_prefetch(row + i);
}

template <class Number>
void extend_add(UpdateMatrix<Number> const& from, const Index* targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept {
    if (from.planes == 2) add_front<2>(from.all(), targets, panel, update.all());
    else add_front<1>(from.all(), targets, panel, update.all());
}

template <class Number>
void add_rows(Index n, const Number* from, const Index* targets, Number* y, Index length) noexcept {
    for (Index r = 0; r < n; ++r, from += length) {
        Number* const to = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes<Number>)
            store(to + c, load(to + c) + load(from + c));
    }
}

template <class Number>
void copy_rows(Index n, const Number* y, const Index* targets, Number* to, Index length) noexcept {
    for (Index r = 0; r < n; ++r, to += length) {
        const Number* const from = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes<Number>) store(to + c, load(from + c));
    }
}

template <class Number, class Value>
void gather(harmorph::RowsOf<Value> const& from, Index begin, Index n, Index behind, Number* y,
            Index row, Index planes) noexcept {
    auto const values = [&](Index k) {
        return row_at(from.data, from.row_of, from.row_length, begin + k);
    };
    Offset const numbers = (planes - 1) * from.plane + from.width;
    for (Index k = 0; k < n; ++k) {
        if (k + rows_ahead < n + behind) prefetch_row(values(k + rows_ahead), numbers);
        const Value* value = values(k);
        for (Index plane = 0; plane < planes; ++plane, value += from.plane, y += row) {
            if (from.width < row) clear_last(y + row);
            convert_run(value, from.width, y);
        }
    }
}

template <class Number, class Value>
void scatter(const Number* y, Index row, Index planes, harmorph::RowsOf<Value> const& to,
             Index begin, Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        Value* value = row_at(to.data, to.row_of, to.row_length, begin + k);
        for (Index plane = 0; plane < planes; ++plane, value += to.plane, y += row)
            convert_run(y, to.width, value);
    }
}

template <class Number>
constexpr MoveKernels<Number> move_kernels{extend_add<Number>, add_rows<Number>, copy_rows<Number>};
template <class Number, class Value>
constexpr CopyKernels<Number, Value> copy_kernels{gather<Number, Value>, scatter<Number, Value>};

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET

namespace harmorph::simd {
template <class Number>
inline constexpr const dense::MoveKernels<Number>*
    table<dense::MoveKernels<Number>, Kernel::HARMORPH_SET> =
        &dense::HARMORPH_SET::move_kernels<Number>;
template <class Number, class Value>
inline constexpr const dense::CopyKernels<Number, Value>*
    table<dense::CopyKernels<Number, Value>, Kernel::HARMORPH_SET> =
        &dense::HARMORPH_SET::copy_kernels<Number, Value>;
}  // namespace harmorph::simd
