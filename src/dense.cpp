#include "harmorph/dense.hpp"
#include "harmorph/flush.hpp"

#include "kernel_call.hpp"

namespace harmorph::dense {

// One set of kernels for each kind of processor; see dense_kernel.hpp. Columns are counted in the front.
#define HARMORPH_DECLARE(kernel)                                                                                          \
    namespace kernel {                                                                                                    \
    /* The rows of the strip that begins at pivot `first`, columns from .. to-1, minus what earlier strips contribute. */ \
    template <class Number, Index planes>                                                                                 \
    void take_off_earlier(Panel<Number> const& panel, Index first, Index from, Index to, Number* packing) noexcept;       \
    /* Of the strip's rows from .. to-1: what is behind its own columns, summed; see TailSums. */                          \
    template <class Number, Index planes>                                                                                 \
    void sum_tails(Panel<Number> const& panel, Index first, Index from, Index to, TailSums<Number>& tails) noexcept;       \
    /* Factors the strip's own columns; sums: of the front's rows, of which the strip's become U^-H of them. */           \
    template <class Number, Index planes>                                                                                 \
    Index factor_diagonal(Panel<Number> const& panel, Index first, Number* sums, TailSums<Number>& tails, Number floor,   \
                          Number& least_left) noexcept;                                                                   \
    /* And then any others, taken off their rows' sums. */                                                                \
    template <class Number, Index planes>                                                                                 \
    void finish_columns(Panel<Number> const& panel, Index first, Index from, Index to, Number* sums) noexcept;            \
    /* The band of the update matrix that begins at row `first`. */                                                       \
    template <class Number, Index planes>                                                                                 \
    void update_band(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index first, const Number* sums,     \
                     Number* packing) noexcept;                                                                           \
    /* Right-hand sides: a strip's own pivots, and what they contribute to rows from .. to-1 or receive in them. */       \
    template <class Number, Index planes>                                                                                 \
    void solve_strip_forward(Panel<Number> const& panel, Index first, Number* y, Index row) noexcept;                     \
    template <class Number, Index planes>                                                                                 \
    void take_off_forward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from, Index to) noexcept;  \
    template <class Number, Index planes>                                                                                 \
    void take_off_backward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from, Index to) noexcept; \
    template <class Number, Index planes>                                                                                 \
    void solve_strip_backward(Panel<Number> const& panel, Index first, Number* y, Index row) noexcept;                    \
    /* See the header. */                                                                                                 \
    template <class Number>                                                                                               \
    void extend_add(UpdateMatrix<Number> const& from, Targets const& targets, Panel<Number> const& panel,                 \
                    UpdateMatrix<Number> const& update) noexcept;                                                         \
    template <class Number>                                                                                               \
    void add_rows(Index n, const Number* from, Targets const& targets, Number* y, Index length) noexcept;                 \
    /* positions null: begin, begin + 1, ... */                                                                           \
    template <class Number, class Value>                                                                                  \
    void gather(RowsOf<Value> const& from, const Index* positions, Index begin, Index n, Number* y, Index row,            \
                Index planes) noexcept;                                                                                   \
    template <class Number, class Value>                                                                                  \
    void scatter(const Number* y, Index row, Index planes, RowsOf<Value> const& to, Index begin, Index n) noexcept;       \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

namespace {

constexpr Index chunk_columns = 192;               // a whole number of tiles, whatever the kernel
constexpr Offset worth_threads = Offset{1} << 22;  // multiplications
constexpr Index most_tile_rows = 8;                // of all kernels: a range of rows is cut into the same tiles as the whole

// A kernel's call, without what is too small to count.
#define HARMORPH_CALL_FLUSHED(kernel, ...) \
    Flush<Number> const flush;             \
    static_cast<void>(flush);              \
    HARMORPH_CALL(kernel, __VA_ARGS__)

// The kernels for real or for complex numbers.
template <class Number, Index planes>
struct Chosen {
    Kernel kernel;

    void take_off_earlier(Panel<Number> const& panel, Index first, Index from, Index to, Number* packing) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_earlier<Number, planes>(panel, first, from, to, packing))
    }
    void sum_tails(Panel<Number> const& panel, Index first, Index from, Index to, TailSums<Number>& tails) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, sum_tails<Number, planes>(panel, first, from, to, tails))
    }
    Index factor_diagonal(Panel<Number> const& panel, Index first, Number* sums, TailSums<Number>& tails, Number floor,
                          Number& least_left) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, factor_diagonal<Number, planes>(panel, first, sums, tails, floor, least_left))
    }
    void finish_columns(Panel<Number> const& panel, Index first, Index from, Index to, Number* sums) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, finish_columns<Number, planes>(panel, first, from, to, sums))
    }
    void update_band(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index first, const Number* sums,
                     Number* packing) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, update_band<Number, planes>(panel, update, first, sums, packing))
    }
    void solve_strip_forward(Panel<Number> const& panel, Index first, Number* y, Index row) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, solve_strip_forward<Number, planes>(panel, first, y, row))
    }
    void take_off_forward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from, Index to) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_forward<Number, planes>(panel, first, y, row, from, to))
    }
    void take_off_backward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from,
                           Index to) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, take_off_backward<Number, planes>(panel, first, y, row, from, to))
    }
    void solve_strip_backward(Panel<Number> const& panel, Index first, Number* y, Index row) const noexcept {
        HARMORPH_CALL_FLUSHED(kernel, solve_strip_backward<Number, planes>(panel, first, y, row))
    }
};

// body(kernels) for the panel's number of planes.
template <class Number, class Body>
auto with_kernels(Kernel kernel, Panel<Number> const& panel, Body const& body) noexcept {
    if (panel.planes == 2) return body(Chosen<Number, 2>{kernel});
    return body(Chosen<Number, 1>{kernel});
}

constexpr Index pieces(Index n, Index size) noexcept { return (n + size - 1) / size; }

// Multiplications of real numbers in one of the panel's.
template <class Number>
Offset cost(Panel<Number> const& panel) noexcept { return Offset{panel.planes} * panel.planes; }

// body(i, packing) for i in 0 .. n-1, on the caller's threads if that is worth it.
template <class Number, class Body>
void spread(Workers<Number> const& workers, Index planes, Offset multiplications, Index n, Body const& body) noexcept {
    Index const threads = workers.executor.is_serial() || multiplications < worth_threads ? 1 : workers.executor.n_threads;
    Index const used = smaller(threads, n);
    workers.executor.for_each(used, [&](Index thread) {
        for (Index i = thread; i < n; i += used) body(i, workers.packing + thread * planes * packing_entries);
    });
}

// body(from, to) for ranges of whole tiles that together are rows begin .. end-1.
template <class Body>
void spread_rows(Executor const& executor, Index begin, Index end, Offset multiplications_per_row, Body const& body) noexcept {
    Index const tiles = pieces(end - begin, most_tile_rows);
    bool const alone = executor.is_serial() || multiplications_per_row * (end - begin) < worth_threads;
    Index const ranges = alone ? 1 : smaller(executor.n_threads, tiles);
    auto const bound = [&](Index i) { return smaller(end, begin + i * tiles / ranges * most_tile_rows); };
    executor.for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1)); });
}

template <class Number>
Index own_end(Panel<Number> const& panel, Index first) noexcept { return smaller(panel.pivots, first + strip); }

template <class Number>
void add_diagonal(Panel<Number> const& panel, Index first, Index end, Number* sums) noexcept {
    Offset const plane = panel.plane(first);
    const Number* its = panel.row(first) + first;
    for (Index k = first; k < end; ++k, its += panel.planes * plane + 1) {
        sums[k] += its[0];
        if (panel.planes == 2) sums[panel.front + k] += its[plane];
    }
}

}  // namespace

template <class Number>
Index factor(Kernel kernel, Panel<Number> const& panel, Number floor, Workers<Number> const& workers) noexcept {
    Number* const sums = workers.sums;
    fill(Span<Number>(sums, static_cast<Size>(panel.planes) * static_cast<Size>(panel.front)), Number{0});
    return with_kernels(kernel, panel, [&](auto const& kernels) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = own_end(panel, first);
            Index const n_chunks = pieces(panel.front - end, chunk_columns);
            auto const begin_of = [&](Index chunk) { return end + chunk * chunk_columns; };
            auto const end_of = [&](Index chunk) { return smaller(panel.front, end + (chunk + 1) * chunk_columns); };
            Offset const multiplications = cost(panel) * (end - first) * (panel.front - first);
            add_diagonal(panel, first, end, sums);  // before anything is taken off it
            if (first > 0) {
                spread(workers, panel.planes, multiplications * first, n_chunks + 1, [&](Index i, Number* packing) {
                    if (i == 0) return kernels.take_off_earlier(panel, first, first, end, packing);
                    kernels.take_off_earlier(panel, first, begin_of(i - 1), end_of(i - 1), packing);
                });
            }
            TailSums<Number> tails;
            spread_rows(workers.executor, 0, end - first, cost(panel) * (panel.front - end),
                        [&](Index from, Index to) { kernels.sum_tails(panel, first, from, to, tails); });
            Index const bad = kernels.factor_diagonal(panel, first, sums, tails, floor, *workers.least_left);
            if (bad != none) return bad;
            spread(workers, panel.planes, multiplications * strip / 2, n_chunks, [&](Index i, Number*) {
                kernels.finish_columns(panel, first, begin_of(i), end_of(i), sums);
            });
        }
        return none;
    });
}

template <class Number>
void update_border(Kernel kernel, Panel<Number> const& panel, UpdateMatrix<Number> const& update,
                   Workers<Number> const& workers) noexcept {
    with_kernels(kernel, panel, [&](auto const& kernels) {
        spread(workers, panel.planes, cost(panel) * update_entries(update.n) * panel.pivots, pieces(update.n, strip),
               [&](Index band, Number* packing) {
                   kernels.update_band(panel, update, band * strip, workers.sums + panel.pivots, packing);
               });
    });
}

template <class Number>
void solve_forward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept {
    with_kernels(kernel, panel, [&](auto const& kernels) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = own_end(panel, first);
            kernels.solve_strip_forward(panel, first, y, row);
            spread_rows(executor, end, panel.front, cost(panel) * (end - first) * row,
                        [&](Index from, Index to) { kernels.take_off_forward(panel, first, y, row, from, to); });
        }
    });
}

template <class Number>
void solve_backward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept {
    with_kernels(kernel, panel, [&](auto const& kernels) {
        for (Index first = (panel.pivots - 1) / strip * strip; first >= 0; first -= strip) {
            Index const end = own_end(panel, first);
            spread_rows(executor, first, end, cost(panel) * (panel.front - end) * row,
                        [&](Index from, Index to) { kernels.take_off_backward(panel, first, y, row, from, to); });
            kernels.solve_strip_backward(panel, first, y, row);
        }
    });
}

template <class Number>
void extend_add(Kernel kernel, UpdateMatrix<Number> const& from, Targets const& targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept {
    HARMORPH_CALL_FLUSHED(kernel, extend_add<Number>(from, targets, panel, update))
}

template <class Number>
void add_rows(Kernel kernel, Index n, const Number* from, Targets const& targets, Number* y, Index length) noexcept {
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
    template void extend_add(Kernel, UpdateMatrix<Number> const&, Targets const&, Panel<Number> const&,                  \
                             UpdateMatrix<Number> const&) noexcept;                                                      \
    template void add_rows(Kernel, Index, const Number*, Targets const&, Number*, Index) noexcept;

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
