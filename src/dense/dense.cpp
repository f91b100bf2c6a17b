#include "harmorph/dense/dense.hpp"
#include "harmorph/base/flush_denormals.hpp"

#include "harmorph/base/kernel_call.hpp"

namespace harmorph::dense {

// One set of kernels for each kind of processor; see dense_kernel.hpp. A strip of pivots is first .. end-1. `columns`: the
// panel's own or its border's, of which from .. to-1 are wanted.
#define HARMORPH_DECLARE(kernel)                                                                                           \
    namespace kernel {                                                                                                     \
    /* The strip's rows, minus what earlier strips contribute. */                                                          \
    template <class Number, Index planes>                                                                                  \
    void take_off_earlier(Slabs<Number> const& own, Slabs<Number> const& columns, Index first, Index end, Index from,      \
                          Index to) noexcept;                                                                              \
    /* Of the strip's rows from .. to-1: what is behind its own columns, summed; see TailSums. */                          \
    template <class Number, Index planes>                                                                                  \
    void sum_tails(Panel<Number> const& panel, Index first, Index end, Index from, Index to,                               \
                   TailSums<Number>& tails) noexcept;                                                                      \
    /* Factors the strip's own columns; sums: of the front's rows, of which the strip's become U^-H of them. */            \
    template <class Number, Index planes>                                                                                  \
    Index factor_diagonal(Panel<Number> const& panel, Index first, Index end, Number* sums, TailSums<Number>& tails,       \
                          Number floor, Number& least_left) noexcept;                                                      \
    /* And then any others, taken off the sums of the rows that they will be: column_sums. */                              \
    template <class Number, Index planes>                                                                                  \
    void finish_columns(Panel<Number> const& panel, Slabs<Number> const& columns, Index first, Index end, Index from,      \
                        Index to, Number* sums, Number* column_sums) noexcept;                                             \
    /* The band of the update matrix that begins at row `first`; sums: the border's. */                                    \
    template <class Number, Index planes>                                                                                  \
    void update_band(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index first,                          \
                     const Number* sums) noexcept;                                                                         \
    /* Right-hand sides y: a strip's own pivots, and what they contribute to rows from .. to-1 of `rest`, which belong */  \
    /* to `columns`. */                                                                                                    \
    template <class Number, Index planes>                                                                                  \
    void solve_strip_forward(Slabs<Number> const& own, Index first, Index end, Number* y, Index row) noexcept;             \
    template <class Number, Index planes>                                                                                  \
    void take_off_forward(Slabs<Number> const& columns, Index first, Index end, Number* y, Number* rest, Index row,        \
                          Index from, Index to) noexcept;                                                                  \
    /* And what pivots from .. to-1 receive from the columns' rows of `rest`, from `begin` on. */                          \
    template <class Number, Index planes>                                                                                  \
    void take_off_backward(Slabs<Number> const& columns, Index begin, Number* y, Number* rest, Index row, Index from,      \
                           Index to) noexcept;                                                                             \
    template <class Number, Index planes>                                                                                  \
    void solve_strip_backward(Slabs<Number> const& own, Index first, Index end, Number* y, Index row) noexcept;            \
    /* See the header. */                                                                                                  \
    template <class Number>                                                                                                \
    void extend_add(UpdateMatrix<Number> const& from, const Index* targets, Panel<Number> const& panel,                    \
                    UpdateMatrix<Number> const& update) noexcept;                                                          \
    template <class Number>                                                                                                \
    void add_rows(Index n, const Number* from, const Index* targets, Number* y, Index length) noexcept;                    \
    /* positions null: begin, begin + 1, ... */                                                                            \
    template <class Number, class Value>                                                                                   \
    void gather(RowsOf<Value> const& from, const Index* positions, Index begin, Index n, Number* y, Index row,             \
                Index planes) noexcept;                                                                                    \
    template <class Number, class Value>                                                                                   \
    void scatter(const Number* y, Index row, Index planes, RowsOf<Value> const& to, Index begin, Index n) noexcept;        \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

namespace {

constexpr Offset worth_threads = Offset{1} << 22;  // multiplications
constexpr Index most_tile_rows = 8;                // of all kernels: a range of rows is cut into the same tiles as the whole

// A kernel's call, without what is too small to count.
#define HARMORPH_CALL_FLUSHED(kernel, ...) \
    Flush<Number> const flush;             \
    static_cast<void>(flush);              \
    HARMORPH_CALL(kernel, __VA_ARGS__)

// A panel, and the kernels for its numbers.
template <class Number, Index planes>
struct Front {
    Kernel kernel;
    Panel<Number> const& panel;
    Slabs<Number> own = panel.own(), border = panel.of_border();

    Index end_of(Index first) const noexcept { return smaller(panel.pivots, first + strip); }
    // Multiplications of real numbers in `n` of the panel's.
    Offset cost(Offset n) const noexcept { return Offset{planes} * planes * n; }
    Number* border_rows(Number* y, Index row) const noexcept { return y + Offset{planes} * row * panel.pivots; }

    void take_off_earlier(Slabs<Number> const& columns, Index first, Index from, Index to) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_earlier<Number, planes>(own, columns, first, end_of(first), from, to))
    }
    void sum_tails(Index first, Index from, Index to, TailSums<Number>& tails) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, sum_tails<Number, planes>(panel, first, end_of(first), from, to, tails))
    }
    Index factor_diagonal(Index first, Number* sums, TailSums<Number>& tails, Number floor, Number& least_left) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, factor_diagonal<Number, planes>(panel, first, end_of(first), sums, tails, floor, least_left))
    }
    void finish_columns(Slabs<Number> const& columns, Index first, Index from, Index to, Number* sums,
                        Number* column_sums) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel,
                              finish_columns<Number, planes>(panel, columns, first, end_of(first), from, to, sums, column_sums))
    }
    void update_band(UpdateMatrix<Number> const& update, Index first, const Number* sums) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, update_band<Number, planes>(panel, update, first, sums))
    }
    void solve_strip_forward(Index first, Number* y, Index row) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, solve_strip_forward<Number, planes>(own, first, end_of(first), y, row))
    }
    void take_off_forward(Slabs<Number> const& columns, Index first, Number* y, Number* rest, Index row, Index from,
                          Index to) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_forward<Number, planes>(columns, first, end_of(first), y, rest, row, from, to))
    }
    void take_off_backward(Slabs<Number> const& columns, Index begin, Number* y, Number* rest, Index row, Index from,
                           Index to) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_backward<Number, planes>(columns, begin, y, rest, row, from, to))
    }
    void solve_strip_backward(Index first, Number* y, Index row) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, solve_strip_backward<Number, planes>(own, first, end_of(first), y, row))
    }

    // The pivots' sums take what stands in the diagonal's place.
    void add_diagonal(Index first, Number* sums) const noexcept {
        for (Index k = first; k < end_of(first); ++k) {
            for (Index p = 0; p < planes; ++p) sums[p * panel.sums_plane() + k] += own.at(k, k)[p * slab];
        }
    }
};

// body(front) for the panel's number of planes.
template <class Number, class Body>
auto with_front(Kernel kernel, Panel<Number> const& panel, Body const& body) noexcept {
    if (panel.planes == 2) return body(Front<Number, 2>{kernel, panel});
    return body(Front<Number, 1>{kernel, panel});
}

constexpr Index pieces(Index n, Index size) noexcept { return (n + size - 1) / size; }

// body(i) for i in 0 .. n-1, on the caller's threads if that is worth it.
template <class Body>
void spread(Executor const& executor, Offset multiplications, Index n, Body const& body) noexcept {
    bool const alone = executor.is_serial() || multiplications < worth_threads;
    Index const used = alone ? smaller(n, Index{1}) : smaller(executor.n_threads, n);
    executor.for_each(used, [&](Index thread) {
        for (Index i = thread; i < n; i += used) body(i);
    });
}

// body(from, to) for ranges of whole tiles that together are begin .. end-1.
template <class Body>
void spread_rows(Executor const& executor, Index begin, Index end, Offset multiplications_per_row, Body const& body) noexcept {
    Index const tiles = pieces(end - begin, most_tile_rows);
    bool const alone = executor.is_serial() || multiplications_per_row * (end - begin) < worth_threads;
    Index const ranges = alone ? smaller(tiles, Index{1}) : smaller(executor.n_threads, tiles);
    auto const bound = [&](Index i) { return smaller(end, begin + i * tiles / ranges * most_tile_rows); };
    executor.for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1)); });
}

// body(columns, from, to, sums) for chunks of the columns behind a strip's own, those of the border last.
template <class Front, class Number, class Body>
void spread_columns(Executor const& executor, Front const& front, Index end, Offset multiplications_per_column, Number* sums,
                    Body const& body) noexcept {
    Index const own = pieces(front.panel.pivots - end, chunk), border = pieces(front.panel.border, chunk);
    spread(executor, multiplications_per_column * (front.panel.front() - end), own + border, [&](Index i) {
        bool const is_own = i < own;
        Slabs<Number> const& columns = is_own ? front.own : front.border;
        Index const from = is_own ? end + i * chunk : (i - own) * chunk;
        body(columns, from, smaller(columns.columns, from + chunk), is_own ? sums : sums + front.panel.border_sums());
    });
}

}  // namespace

template <class Number>
Index factor(Kernel kernel, Panel<Number> const& panel, Number floor, Workers<Number> const& workers) noexcept {
    Executor const& executor = workers.executor;
    Number* const sums = workers.sums;
    fill(Span<Number>(sums, static_cast<Size>(panel.planes * panel.sums_plane())), Number{0});
    return with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_column = front.cost(end - first);
            front.add_diagonal(first, sums);  // before anything is taken off it
            if (first > 0) {
                front.take_off_earlier(front.own, first, first, end);
                spread_columns(executor, front, end, per_column * first, sums,
                               [&](Slabs<Number> const& columns, Index from, Index to, Number*) {
                                   front.take_off_earlier(columns, first, from, to);
                               });
            }
            TailSums<Number> tails;
            spread_rows(executor, first, end, front.cost(panel.front() - end),
                        [&](Index from, Index to) { front.sum_tails(first, from, to, tails); });
            Index const bad = front.factor_diagonal(first, sums, tails, floor, *workers.least_left);
            if (bad != none) return bad;
            spread_columns(executor, front, end, per_column * strip / 2, sums,
                           [&](Slabs<Number> const& columns, Index from, Index to, Number* column_sums) {
                               front.finish_columns(columns, first, from, to, sums, column_sums);
                           });
        }
        return none;
    });
}

template <class Number>
void update_border(Kernel kernel, Panel<Number> const& panel, UpdateMatrix<Number> const& update,
                   Workers<Number> const& workers) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        Offset const multiplications = front.cost(update_entries(update.n) * panel.pivots);
        spread(workers.executor, multiplications, pieces(update.n, strip),
               [&](Index band) { front.update_band(update, band * strip, workers.sums + panel.border_sums()); });
    });
}

template <class Number>
void solve_forward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_row = front.cost(Offset{end - first} * row);
            front.solve_strip_forward(first, y, row);
            spread_rows(executor, end, panel.pivots, per_row,
                        [&](Index from, Index to) { front.take_off_forward(front.own, first, y, y, row, from, to); });
            spread_rows(executor, 0, panel.border, per_row, [&](Index from, Index to) {
                front.take_off_forward(front.border, first, y, front.border_rows(y, row), row, from, to);
            });
        }
    });
}

template <class Number>
void solve_backward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = (panel.pivots - 1) / strip * strip; first >= 0; first -= strip) {
            Index const end = front.end_of(first);
            spread_rows(executor, first, end, front.cost(Offset{panel.front() - end} * row), [&](Index from, Index to) {
                front.take_off_backward(front.own, end, y, y, row, from, to);
                front.take_off_backward(front.border, 0, y, front.border_rows(y, row), row, from, to);
            });
            front.solve_strip_backward(first, y, row);
        }
    });
}

template <class Number>
void extend_add(Kernel kernel, UpdateMatrix<Number> const& from, const Index* targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, extend_add<Number>(from, targets, panel, update))
}

template <class Number>
void add_rows(Kernel kernel, Index n, const Number* from, const Index* targets, Number* y, Index length) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, add_rows<Number>(n, from, targets, y, length))
}

template <class Number, class Value>
void gather(Kernel kernel, RowsOf<Value> const& from, Index begin, Index n, Number* y, Index row, Index planes) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, gather(from, nullptr, begin, n, y, row, planes))
}

template <class Number, class Value>
void gather(Kernel kernel, RowsOf<Value> const& from, Span<const Index> positions, Number* y, Index row,
            Index planes) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, gather(from, positions.data(), 0, positions.count(), y, row, planes))
}

template <class Number, class Value>
void scatter(Kernel kernel, const Number* y, Index row, Index planes, RowsOf<Value> const& to, Index begin,
             Index n) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, scatter(y, row, planes, to, begin, n))
}

#define HARMORPH_MAKE(Number)                                                                                            \
    template Index factor(Kernel, Panel<Number> const&, Number, Workers<Number> const&) noexcept;                        \
    template void update_border(Kernel, Panel<Number> const&, UpdateMatrix<Number> const&, Workers<Number> const&) noexcept; \
    template void solve_forward(Kernel, Panel<Number> const&, Number*, Index, Executor const&) noexcept;                 \
    template void solve_backward(Kernel, Panel<Number> const&, Number*, Index, Executor const&) noexcept;                \
    template void extend_add(Kernel, UpdateMatrix<Number> const&, const Index*, Panel<Number> const&,                    \
                             UpdateMatrix<Number> const&) noexcept;                                                      \
    template void add_rows(Kernel, Index, const Number*, const Index*, Number*, Index) noexcept;
#define HARMORPH_MAKE_MOVES(Number, Value)                                                                               \
    template void gather(Kernel, RowsOf<Value> const&, Index, Index, Number*, Index, Index) noexcept;                    \
    template void gather(Kernel, RowsOf<Value> const&, Span<const Index>, Number*, Index, Index) noexcept;               \
    template void scatter(Kernel, const Number*, Index, Index, RowsOf<Value> const&, Index, Index) noexcept;
HARMORPH_MAKE(double)
HARMORPH_MAKE(float)
HARMORPH_MAKE_MOVES(double, double)
HARMORPH_MAKE_MOVES(float, double)
HARMORPH_MAKE_MOVES(float, float)

}  // namespace harmorph::dense
