#include "dense/dense.hpp"

#include "base/flush_denormals.hpp"
#include "dense/dense_table.hpp"

namespace harmorph::dense {
namespace {

// A task is divided among threads if it takes at least so many multiplications.
constexpr Offset min_parallel_work = Offset{1} << 22;
// This is the largest number of rows of a tile in any kernel. A range of rows is cut into the same
// tiles as the whole, so that the bits of the results do not depend on the number of threads.
constexpr Index max_tile_rows = 8;

// Calls a kernel while denormal numbers are flushed to 0.
template <class Number, class Result, class... Parameters, class... Arguments>
Result call_flushed(Result (*kernel)(Parameters...) noexcept, Arguments&&... arguments) noexcept {
    Flush<Number> const flush;
    static_cast<void>(flush);
    return kernel(arguments...);
}

// A panel with the kernels for its kind of numbers.
template <class Number, Index planes>
struct Front {
    FrontKernels<Number, planes> const& kernels;
    Panel<Number> const& panel;
    Slabs<Number> own = panel.own(), border = panel.border_columns();

    Index end_of(Index first) const noexcept { return min(panel.pivots, first + strip); }
    // Returns how many multiplications of real numbers `n` multiplications of numbers of the panel
    // take.
    Offset cost(Offset n) const noexcept { return Offset{planes} * planes * n; }
    Number* border_rows(Number* y, Index row) const noexcept {
        return y + Offset{planes} * row * panel.pivots;
    }

    // Adds the row sums that are stored in place of the diagonal to the sums of the pivots' rows.
    void add_diagonal(Index first, Number* sums) const noexcept {
        for (Index k = first; k < end_of(first); ++k) {
            for (Index p = 0; p < planes; ++p)
                sums[p * panel.sums_plane() + k] += own.at(k, k)[p * slab];
        }
    }
};

// Calls body(front) with the front for the panel's number of planes.
template <class Number, class Body>
auto with_front(Kernel kernel, Panel<Number> const& panel, Body const& body) noexcept {
    if (panel.planes == 2) return body(Front<Number, 2>{front_kernels<Number, 2>(kernel), panel});
    return body(Front<Number, 1>{front_kernels<Number, 1>(kernel), panel});
}

constexpr Index divide_up(Index n, Index size) noexcept { return (n + size - 1) / size; }

// Calls body(i) for i in 0 .. n-1, on the caller's threads if the work is large enough for that.
template <class Body>
void spread(Executor const& executor, Offset multiplications, Index n, Body const& body) noexcept {
    bool const alone = executor.is_serial() || multiplications < min_parallel_work;
    Index const used = alone ? min(n, Index{1}) : min(executor.n_threads, n);
    executor.for_each(used, [&](Index thread) {
        for (Index i = thread; i < n; i += used) body(i);
    });
}

// Calls body(from, to) for ranges of whole tiles that together cover begin .. end-1.
template <class Body>
void spread_rows(Executor const& executor, Index begin, Index end, Offset multiplications_per_row,
                 Body const& body) noexcept {
    Index const tiles = divide_up(end - begin, max_tile_rows);
    bool const alone =
        executor.is_serial() || multiplications_per_row * (end - begin) < min_parallel_work;
    Index const ranges = alone ? min(tiles, Index{1}) : min(executor.n_threads, tiles);
    auto const bound = [&](Index i) {
        return min(end, begin + i * tiles / ranges * max_tile_rows);
    };
    executor.for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1)); });
}

// Returns how far after the entry that is being read back substitution prefetches, counted in
// numbers. Panels follow each other downwards in memory, which the hardware does not predict. In a
// small panel the prefetched entries are those that are read some panels later; in a large panel
// they lie two tiles further down in the same slab.
template <class Number>
Offset prefetch_distance(Panel<Number> const& panel) noexcept {
    constexpr Offset below = 65536 / sizeof(Number);
    Offset const numbers = panel.planes * panel_entries(panel.pivots, panel.border);
    return numbers <= below ? -below : Offset{panel.planes} * 2 * max_tile_rows * slab;
}

// Calls body(columns, from, to, sums) for chunks of the columns after those of a strip. The
// columns of the border come last.
template <class Front, class Number, class Body>
void spread_columns(Executor const& executor, Front const& front, Index end,
                    Offset multiplications_per_column, Number* sums, Body const& body) noexcept {
    Index const own = divide_up(front.panel.pivots - end, chunk),
                border = divide_up(front.panel.border, chunk);
    spread(executor, multiplications_per_column * (front.panel.front() - end), own + border,
           [&](Index i) {
               bool const is_own = i < own;
               Slabs<Number> const& columns = is_own ? front.own : front.border;
               Index const from = is_own ? end + i * chunk : (i - own) * chunk;
               body(columns, from, min(columns.columns, from + chunk),
                    is_own ? sums : sums + front.panel.border_sums());
           });
}

}  // namespace

template <class Number>
Index factor(Kernel kernel, Panel<Number> const& panel, Number floor,
             Workers<Number> const& workers) noexcept {
    Executor const& executor = workers.executor;
    Number* const sums = workers.sums;
    fill(Span<Number>(sums, static_cast<Size>(panel.planes * panel.sums_plane())), Number{0});
    return with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_column = front.cost(end - first);
            // The row sums are saved before products are subtracted from the diagonal.
            front.add_diagonal(first, sums);
            if (first > 0) {
                auto const subtract = [&](Slabs<Number> const& columns, Index from, Index to,
                                          Number*) {
                    call_flushed<Number>(front.kernels.subtract_earlier, front.own, columns, first,
                                         end, from, to);
                };
                call_flushed<Number>(front.kernels.subtract_earlier, front.own, front.own, first,
                                     end, first, end);
                spread_columns(executor, front, end, per_column * first, sums, subtract);
            }
            TailSums<Number> tails;
            spread_rows(executor, first, end, front.cost(panel.front() - end),
                        [&](Index from, Index to) {
                            call_flushed<Number>(front.kernels.sum_tails, panel, first, end, from,
                                                 to, tails);
                        });
            Index const bad = call_flushed<Number>(front.kernels.factor_diagonal, panel, first, end,
                                                   sums, tails, floor, *workers.min_pivot_ratio);
            if (bad != none) return bad;
            auto const finish = [&](Slabs<Number> const& columns, Index from, Index to,
                                    Number* column_sums) {
                call_flushed<Number>(front.kernels.finish_columns, panel, columns, first, end, from,
                                     to, sums, column_sums);
            };
            spread_columns(executor, front, end, per_column * strip / 2, sums, finish);
        }
        return none;
    });
}

template <class Number>
void update_border(Kernel kernel, Panel<Number> const& panel, UpdateMatrix<Number> const& update,
                   Workers<Number> const& workers) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        Offset const multiplications = front.cost(update_entries(update.n) * panel.pivots);
        const Number* const sums = workers.sums + panel.border_sums();
        spread(workers.executor, multiplications, divide_up(update.n, strip), [&](Index band) {
            call_flushed<Number>(front.kernels.update_band, panel, update, band * strip, sums);
        });
    });
}

template <class Number>
void solve_forward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row,
                   Executor const& executor) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_row = front.cost(Offset{end - first} * row);
            call_flushed<Number>(front.kernels.solve_strip_forward, front.own, first, end, y, row);
            spread_rows(executor, end, panel.pivots, per_row, [&](Index from, Index to) {
                call_flushed<Number>(front.kernels.subtract_forward, front.own, first, end, y, y,
                                     row, from, to);
            });
            spread_rows(executor, 0, panel.border, per_row, [&](Index from, Index to) {
                call_flushed<Number>(front.kernels.subtract_forward, front.border, first, end, y,
                                     front.border_rows(y, row), row, from, to);
            });
        }
    });
}

template <class Number>
void solve_backward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row,
                    Executor const& executor) noexcept {
    Offset const ahead = prefetch_distance(panel);
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = (panel.pivots - 1) / strip * strip; first >= 0; first -= strip) {
            Index const end = front.end_of(first);
            spread_rows(executor, first, end, front.cost(Offset{panel.front() - end} * row),
                        [&](Index from, Index to) {
                            call_flushed<Number>(front.kernels.subtract_backward, front.own, end, y,
                                                 y, row, from, to, ahead);
                            call_flushed<Number>(front.kernels.subtract_backward, front.border, 0,
                                                 y, front.border_rows(y, row), row, from, to,
                                                 ahead);
                        });
            call_flushed<Number>(front.kernels.solve_strip_backward, front.own, first, end, y, row,
                                 ahead);
        }
    });
}

template <class Number>
void extend_add(Kernel kernel, UpdateMatrix<Number> const& from, const Index* targets,
                Panel<Number> const& panel, UpdateMatrix<Number> const& update) noexcept {
    call_flushed<Number>(move_kernels<Number>(kernel).extend_add, from, targets, panel, update);
}

template <class Number>
void add_rows(Kernel kernel, Index n, const Number* from, const Index* targets, Number* y,
              Index length) noexcept {
    call_flushed<Number>(move_kernels<Number>(kernel).add_rows, n, from, targets, y, length);
}

template <class Number>
void copy_rows(Kernel kernel, Index n, const Number* y, const Index* targets, Number* to,
               Index length) noexcept {
    move_kernels<Number>(kernel).copy_rows(n, y, targets, to, length);
}

template <class Number, class Value>
void gather(Kernel kernel, RowsOf<Value> const& from, Index begin, Index n, Index behind, Number* y,
            Index row, Index planes) noexcept {
    call_flushed<Number>(copy_kernels<Number, Value>(kernel).gather, from, begin, n, behind, y, row,
                         planes);
}

template <class Number, class Value>
void scatter(Kernel kernel, const Number* y, Index row, Index planes, RowsOf<Value> const& to,
             Index begin, Index n) noexcept {
    call_flushed<Number>(copy_kernels<Number, Value>(kernel).scatter, y, row, planes, to, begin, n);
}

#define HARMORPH_MAKE(Number)                                                                     \
    template Index factor(Kernel, Panel<Number> const&, Number, Workers<Number> const&) noexcept; \
    template void update_border(Kernel, Panel<Number> const&, UpdateMatrix<Number> const&,        \
                                Workers<Number> const&) noexcept;                                 \
    template void solve_forward(Kernel, Panel<Number> const&, Number*, Index,                     \
                                Executor const&) noexcept;                                        \
    template void solve_backward(Kernel, Panel<Number> const&, Number*, Index,                    \
                                 Executor const&) noexcept;                                       \
    template void extend_add(Kernel, UpdateMatrix<Number> const&, const Index*,                   \
                             Panel<Number> const&, UpdateMatrix<Number> const&) noexcept;         \
    template void add_rows(Kernel, Index, const Number*, const Index*, Number*, Index) noexcept;  \
    template void copy_rows(Kernel, Index, const Number*, const Index*, Number*, Index) noexcept;
#define HARMORPH_MAKE_MOVES(Number, Value)                                                  \
    template void gather(Kernel, RowsOf<Value> const&, Index, Index, Index, Number*, Index, \
                         Index) noexcept;                                                   \
    template void scatter(Kernel, const Number*, Index, Index, RowsOf<Value> const&, Index, \
                          Index) noexcept;
HARMORPH_MAKE(double)
HARMORPH_MAKE(float)
HARMORPH_MAKE_MOVES(double, double)
HARMORPH_MAKE_MOVES(float, double)
HARMORPH_MAKE_MOVES(float, float)

}  // namespace harmorph::dense
