// Moves of numbers between fronts, and between fronts and the caller's rows, for one kind of vector register: see
// dense_kernel.hpp, whose vectors these are.
#include "dense_kernel.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

// to [n] += from; whole vectors are read.
template <class Number>
HARMORPH_INLINE void add_run(Number* to, const Number* from, Index n) noexcept {
    Index i = 0;
    for (; i + lanes<Number> <= n; i += lanes<Number>) store(to + i, load(to + i) + load(from + i));
    if (i < n) Registers<Number>::store_first(to + i, load(to + i) + load(from + i), n - i);
}

// A row of an upper triangle, from column `begin` on.
template <class Number>
HARMORPH_INLINE void add_row(Number* to, const Number* from, Index begin, Index end, Targets const& targets) noexcept {
    for (Index c = begin; c < end; c = targets.ends[c]) add_run(to + targets.at[c], from + c, targets.ends[c] - c);
}

// to [n] = from, converted, as many at a time as doubles fill a register.
template <class From, class To>
HARMORPH_INLINE void convert_run(const From* from, Index n, To* to) noexcept {
    typedef From Froms __attribute__((vector_size(lanes<double> * sizeof(From)), aligned(sizeof(From)), may_alias));
    typedef To Tos __attribute__((vector_size(lanes<double> * sizeof(To)), aligned(sizeof(To)), may_alias));
    Index i = 0;
    for (; i + lanes<double> <= n; i += lanes<double>) {
        *reinterpret_cast<Tos*>(to + i) = __builtin_convertvector(*reinterpret_cast<const Froms*>(from + i), Tos);
    }
    for (; i < n; ++i) to[i] = static_cast<To>(from[i]);
}

// The numbers that may be padding. A constant number of them: else the compiler calls memset, for every row.
template <class Number>
HARMORPH_INLINE void clear_last(Number* end) noexcept {
    for (Index i = 1; i <= row_multiple; ++i) end[-i] = 0;
}

template <class Value>
HARMORPH_INLINE Value* row_at(Value* data, const Index* row_of, Offset length, Index position) noexcept {
    return data + (row_of != nullptr ? row_of[position] : position) * length;
}

constexpr Index rows_ahead = 4;  // rows of values lie anywhere: those are on their way while one is copied

template <class Value>
HARMORPH_INLINE void prefetch_row(const Value* row, Offset numbers) noexcept {
    constexpr Offset line = 64 / sizeof(Value);
    for (Offset i = 0; i < numbers; i += line) __builtin_prefetch(row + i);
}

}  // namespace

template <class Number>
void extend_add(UpdateMatrix<Number> const& from, Targets const& targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept {
    Index const planes = from.planes;
    for (Index r = 0; r < from.n; ++r) {
        Index const band = r / strip * strip;
        Offset const plane = padded(from.n - band);
        const Number* const row = from.data + planes * (band_start(from.n, band) + (r - band) * plane) - band;
        // The target's row, such that to[column] is the entry in a column of the front.
        Index const target = targets.at[r];
        bool const is_pivot = target < panel.pivots;
        Index const number = is_pivot ? target : target - panel.pivots, first = number / strip * strip;
        Offset const its_plane = is_pivot ? panel.front - first : padded(update.n - first);
        Offset const start = is_pivot ? strip_start(panel.front, first) : band_start(update.n, first);
        Number* const to = (is_pivot ? panel.data : update.data - panel.pivots) +
                           planes * (start + (number - first) * its_plane) - first;
        add_row(to, row, r, from.n, targets);
        if (planes == 2) add_row(to + its_plane, row + plane, r, from.n, targets);
    }
}

template <class Number>
void add_rows(Index n, const Number* from, Targets const& targets, Number* y, Index length) noexcept {
    for (Index r = 0; r < n; ++r) add_run(y + Offset{targets.at[r]} * length, from + Offset{r} * length, length);
}

template <class Number, class Value>
void gather(harmorph::RowsOf<Value> const& from, const Index* positions, Index begin, Index n, Number* y, Index row,
            Index planes) noexcept {
    auto const position = [&](Index k) { return positions != nullptr ? positions[k] : begin + k; };
    auto const values = [&](Index k) { return row_at(from.data, from.row_of, from.row_length, position(k)); };
    Offset const numbers = (planes - 1) * from.plane + from.width;
    for (Index k = 0; k < n; ++k) {
        if (k + rows_ahead < n) prefetch_row(values(k + rows_ahead), numbers);
        const Value* its = values(k);
        for (Index plane = 0; plane < planes; ++plane, its += from.plane, y += row) {
            if (from.width < row) clear_last(y + row);
            convert_run(its, from.width, y);
        }
    }
}

template <class Number, class Value>
void scatter(const Number* y, Index row, Index planes, harmorph::RowsOf<Value> const& to, Index begin, Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        Value* its = row_at(to.data, to.row_of, to.row_length, begin + k);
        for (Index plane = 0; plane < planes; ++plane, its += to.plane, y += row) convert_run(y, to.width, its);
    }
}

#define HARMORPH_MAKE_MOVES(Number)                                                                                       \
    template void extend_add<Number>(UpdateMatrix<Number> const&, Targets const&, Panel<Number> const&,                    \
                                     UpdateMatrix<Number> const&) noexcept;                                                \
    template void add_rows<Number>(Index, const Number*, Targets const&, Number*, Index) noexcept;
#define HARMORPH_MAKE_COPIES(Number, Value)                                                                               \
    template void gather<Number>(harmorph::RowsOf<Value> const&, const Index*, Index, Index, Number*, Index,               \
                                 Index) noexcept;                                                                         \
    template void scatter<Number>(const Number*, Index, Index, harmorph::RowsOf<Value> const&, Index, Index) noexcept;
HARMORPH_MAKE_MOVES(double)
HARMORPH_MAKE_MOVES(float)
HARMORPH_MAKE_COPIES(double, double)
HARMORPH_MAKE_COPIES(float, double)
HARMORPH_MAKE_COPIES(float, float)

}  // namespace harmorph::dense::HARMORPH_KERNEL
