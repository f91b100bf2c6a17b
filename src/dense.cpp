#include "harmorph/dense.hpp"

#include "kernel_call.hpp"

namespace harmorph::dense {

// One set of kernels for each kind of processor; see dense_kernel.hpp. Columns are counted in the front.
#define HARMORPH_DECLARE(kernel)                                                                                         \
    namespace kernel {                                                                                                   \
    /* The rows of the strip that begins at pivot `first`, columns from .. to-1, minus what earlier strips contribute. */ \
    void take_off_earlier(Panel const& panel, Index first, Index from, Index to, Real* packing) noexcept;                \
    /* Factors the strip's own columns. */                                                                               \
    Index factor_diagonal(Panel const& panel, Index first, Real floor) noexcept;                                         \
    /* And then any others. */                                                                                           \
    void finish_columns(Panel const& panel, Index first, Index from, Index to) noexcept;                                 \
    /* The band of the update matrix that begins at row `first`. */                                                      \
    void update_band(Panel const& panel, UpdateMatrix const& update, Index first, Real* packing) noexcept;               \
    /* Right-hand sides: a strip's own pivots, and what they contribute to rows from .. to-1 or receive in them. */      \
    void solve_strip_forward(Panel const& panel, Index first, Real* y, Index row) noexcept;                              \
    void take_off_forward(Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept;           \
    void take_off_backward(Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept;          \
    void solve_strip_backward(Panel const& panel, Index first, Real* y, Index row) noexcept;                             \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

namespace {

constexpr Index chunk_columns = 192;           // a whole number of tiles, whatever the kernel
constexpr Offset worth_threads = Offset{1} << 22;  // multiplications
constexpr Index most_tile_rows = 8;            // of all kernels: a range of rows is cut into the same tiles as the whole

// body(i, packing) for i in 0 .. n-1, on the caller's threads if that is worth it.
template <class Body>
void spread(Workers const& workers, Offset multiplications, Index n, Body const& body) noexcept {
    Index const threads = workers.executor.is_serial() || multiplications < worth_threads ? 1 : workers.executor.n_threads;
    Index const used = smaller(threads, n);
    workers.executor.for_each(used, [&](Index thread) {
        for (Index i = thread; i < n; i += used) body(i, workers.packing + thread * packing_entries);
    });
}

constexpr Index pieces(Index n, Index size) noexcept { return (n + size - 1) / size; }

void take_off_earlier(Kernel kernel, Panel const& panel, Index first, Index from, Index to, Real* packing) noexcept {
    HARMORPH_CALL(kernel, take_off_earlier(panel, first, from, to, packing))
}

Index factor_diagonal(Kernel kernel, Panel const& panel, Index first, Real floor) noexcept {
    HARMORPH_CALL(kernel, factor_diagonal(panel, first, floor))
}

void finish_columns(Kernel kernel, Panel const& panel, Index first, Index from, Index to) noexcept {
    HARMORPH_CALL(kernel, finish_columns(panel, first, from, to))
}

void update_band(Kernel kernel, Panel const& panel, UpdateMatrix const& update, Index first, Real* packing) noexcept {
    HARMORPH_CALL(kernel, update_band(panel, update, first, packing))
}

void solve_strip_forward(Kernel kernel, Panel const& panel, Index first, Real* y, Index row) noexcept {
    HARMORPH_CALL(kernel, solve_strip_forward(panel, first, y, row))
}

void take_off_forward(Kernel kernel, Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept {
    HARMORPH_CALL(kernel, take_off_forward(panel, first, y, row, from, to))
}

void take_off_backward(Kernel kernel, Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept {
    HARMORPH_CALL(kernel, take_off_backward(panel, first, y, row, from, to))
}

void solve_strip_backward(Kernel kernel, Panel const& panel, Index first, Real* y, Index row) noexcept {
    HARMORPH_CALL(kernel, solve_strip_backward(panel, first, y, row))
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

}  // namespace

Index factor(Kernel kernel, Panel const& panel, Real floor, Workers const& workers) noexcept {
    for (Index first = 0; first < panel.pivots; first += strip) {
        Index const own_end = smaller(panel.pivots, first + strip);
        Index const n_chunks = pieces(panel.front - own_end, chunk_columns);
        auto const begin_of = [&](Index chunk) { return own_end + chunk * chunk_columns; };
        auto const end_of = [&](Index chunk) { return smaller(panel.front, own_end + (chunk + 1) * chunk_columns); };
        Offset const entries = Offset{own_end - first} * (panel.front - first);
        if (first > 0) {
            spread(workers, entries * first, n_chunks + 1, [&](Index i, Real* packing) {
                if (i == 0) return take_off_earlier(kernel, panel, first, first, own_end, packing);
                take_off_earlier(kernel, panel, first, begin_of(i - 1), end_of(i - 1), packing);
            });
        }
        Index const bad = factor_diagonal(kernel, panel, first, floor);
        if (bad != none) return bad;
        spread(workers, entries * strip / 2, n_chunks,
               [&](Index i, Real*) { finish_columns(kernel, panel, first, begin_of(i), end_of(i)); });
    }
    return none;
}

void update_border(Kernel kernel, Panel const& panel, UpdateMatrix const& update, Workers const& workers) noexcept {
    spread(workers, UpdateMatrix::entries(update.n) * panel.pivots, pieces(update.n, strip),
           [&](Index band, Real* packing) { update_band(kernel, panel, update, band * strip, packing); });
}

void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row, Executor const& executor) noexcept {
    for (Index first = 0; first < panel.pivots; first += strip) {
        Index const own_end = smaller(panel.pivots, first + strip);
        solve_strip_forward(kernel, panel, first, y, row);
        spread_rows(executor, own_end, panel.front, Offset{own_end - first} * row,
                    [&](Index from, Index to) { take_off_forward(kernel, panel, first, y, row, from, to); });
    }
}

void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row, Executor const& executor) noexcept {
    for (Index first = (panel.pivots - 1) / strip * strip; first >= 0; first -= strip) {
        Index const own_end = smaller(panel.pivots, first + strip);
        spread_rows(executor, first, own_end, Offset{panel.front - own_end} * row,
                    [&](Index from, Index to) { take_off_backward(kernel, panel, first, y, row, from, to); });
        solve_strip_backward(kernel, panel, first, y, row);
    }
}

}  // namespace harmorph::dense
