#include "dense/dense.hpp"

namespace harmorph::dense {

// The dense kernels of one instruction set as function tables. A strip consists of the pivots first
// .. end-1. `columns` are the panel's own or those of the border; the kernel works on from .. to-1
// of them.

// Kernels for factorisation and substitution of a panel of real numbers (one plane) or complex
// numbers (two planes).
template <Index planes>
struct FrontKernels {
    // Subtracts the products of earlier strips from the rows of the strip.
    void (*subtract_earlier)(Slabs const& own, Slabs const& columns, Index first, Index end,
                             Index from, Index to) noexcept;
    // Sums rows from .. to-1 of the strip over the columns after those of the strip; see TailSums.
    void (*sum_tails)(Panel const& panel, Index first, Index end, Index from, Index to,
                      TailSums& tails) noexcept;
    // Factors the columns of the strip. `sums` are those of all rows of the front; the sums of the
    // strip are multiplied by U^-H.
    Index (*factor_diagonal)(Panel const& panel, Index first, Index end, Real* sums,
                             TailSums& tails, Real floor, Real& min_pivot_ratio) noexcept;
    // Finishes other columns after factor_diagonal(), and subtracts their part from column_sums,
    // the sums of the rows with the same numbers.
    void (*finish_columns)(Panel const& panel, Slabs const& columns, Index first, Index end,
                           Index from, Index to, Real* sums, Real* column_sums) noexcept;
    // Updates the band of the update matrix that begins at row `first`. `sums` are the row sums of
    // the border.
    void (*update_band)(Panel const& panel, UpdateMatrix const& update, Index first,
                        const Real* sums) noexcept;

    // solve_strip_forward() solves for the pivots of a strip in the right-hand sides y.
    // subtract_forward() then subtracts the products of the solution from the rows from .. to-1 of
    // `rest`, which belong to `columns`.
    void (*solve_strip_forward)(Slabs const& own, Index first, Index end, Real* y,
                                Index row) noexcept;
    void (*subtract_forward)(Slabs const& columns, Index first, Index end, Real* y, Real* rest,
                             Index row, Index from, Index to) noexcept;
    // Subtracts the products of the rows of `rest` that belong to `columns`, from column `begin`
    // on, from the pivots from .. to-1. `ahead` is the distance, counted in numbers, between the
    // entry that is read and the entry that is prefetched.
    void (*subtract_backward)(Slabs const& columns, Index begin, Real* y, Real* rest, Index row,
                              Index from, Index to, Offset ahead) noexcept;
    void (*solve_strip_backward)(Slabs const& own, Index first, Index end, Real* y, Index row,
                                 Offset ahead) noexcept;
};

// Kernels that move numbers between fronts; see dense.hpp.
struct MoveKernels {
    void (*extend_add)(UpdateMatrix const& from, const Index* targets, Panel const& panel,
                       UpdateMatrix const& update) noexcept;
    void (*add_rows)(Index n, const Real* from, const Index* targets, Real* y,
                     Index length) noexcept;
    void (*copy_rows)(Index n, const Real* y, const Index* targets, Real* to,
                      Index length) noexcept;
    void (*gather)(Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
                   Index planes) noexcept;
    void (*scatter)(const Real* y, Index row, Index planes, Rows const& to, Index begin,
                    Index n) noexcept;
};

}  // namespace harmorph::dense

#define HARMORPH_KERNELS "dense/dense_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph::dense {

namespace {

MoveKernels const& move_kernels(Kernel kernel) noexcept {
    return simd::table_of<MoveKernels>(kernel);
}

// A task is divided among threads if it takes at least so many multiplications.
constexpr Offset min_parallel_work = Offset{1} << 22;
// This is the largest number of rows of a tile in any kernel. A range of rows is cut into the same
// tiles as the whole, so that the bits of the results do not depend on the number of threads.
constexpr Index max_tile_rows = 8;

// A panel with the kernels for its kind of numbers.
template <Index planes>
struct Front {
    FrontKernels<planes> const& kernels;
    Panel const& panel;
    Slabs own = panel.own(), border = panel.border_columns();

    Index end_of(Index first) const noexcept { return min(panel.pivots, first + strip); }
    // Returns how many multiplications of real numbers `n` multiplications of numbers of the panel
    // take.
    Offset cost(Offset n) const noexcept { return Offset{planes} * planes * n; }
    Real* border_rows(Real* y, Index row) const noexcept {
        return y + Offset{planes} * row * panel.pivots;
    }

    // Adds the row sums that are stored in place of the diagonal to the sums of the pivots' rows.
    void add_diagonal(Index first, Real* sums) const noexcept {
        for (Index k = first; k < end_of(first); ++k) {
            for (Index p = 0; p < planes; ++p)
                sums[p * panel.sums_plane() + k] += own.at(k, k)[p * slab];
        }
    }
};

// Calls body(front) with the front for the panel's number of planes.
template <class Body>
auto with_front(Kernel kernel, Panel const& panel, Body const& body) noexcept {
    if (panel.planes == 2) return body(Front<2>{simd::table_of<FrontKernels<2>>(kernel), panel});
    return body(Front<1>{simd::table_of<FrontKernels<1>>(kernel), panel});
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
Offset prefetch_distance(Panel const& panel) noexcept {
    constexpr Offset below = 65536 / sizeof(Real);
    Offset const numbers = panel.planes * panel_entries(panel.pivots, panel.border);
    return numbers <= below ? -below : Offset{panel.planes} * 2 * max_tile_rows * slab;
}

// Calls body(columns, from, to, sums) for chunks of the columns after those of a strip. The
// columns of the border come last.
template <class Front, class Body>
void spread_columns(Executor const& executor, Front const& front, Index end,
                    Offset multiplications_per_column, Real* sums, Body const& body) noexcept {
    Index const own = divide_up(front.panel.pivots - end, chunk),
                border = divide_up(front.panel.border, chunk);
    spread(executor, multiplications_per_column * (front.panel.front() - end), own + border,
           [&](Index i) {
               bool const is_own = i < own;
               Slabs const& columns = is_own ? front.own : front.border;
               Index const from = is_own ? end + i * chunk : (i - own) * chunk;
               body(columns, from, min(columns.columns, from + chunk),
                    is_own ? sums : sums + front.panel.border_sums());
           });
}

}  // namespace

Index factor(Kernel kernel, Panel const& panel, Real floor, Workers const& workers) noexcept {
    Executor const& executor = workers.executor;
    Real* const sums = workers.sums;
    fill(Span<Real>(sums, static_cast<Size>(panel.planes * panel.sums_plane())), Real{0});
    return with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_column = front.cost(end - first);
            // The row sums are saved before products are subtracted from the diagonal.
            front.add_diagonal(first, sums);
            if (first > 0) {
                auto const subtract = [&](Slabs const& columns, Index from, Index to, Real*) {
                    front.kernels.subtract_earlier(front.own, columns, first, end, from, to);
                };
                front.kernels.subtract_earlier(front.own, front.own, first, end, first, end);
                spread_columns(executor, front, end, per_column * first, sums, subtract);
            }
            TailSums tails;
            spread_rows(executor, first, end, front.cost(panel.front() - end),
                        [&](Index from, Index to) {
                            front.kernels.sum_tails(panel, first, end, from, to, tails);
                        });
            Index const bad = front.kernels.factor_diagonal(panel, first, end, sums, tails, floor,
                                                            *workers.min_pivot_ratio);
            if (bad != none) return bad;
            auto const finish = [&](Slabs const& columns, Index from, Index to, Real* column_sums) {
                front.kernels.finish_columns(panel, columns, first, end, from, to, sums,
                                             column_sums);
            };
            spread_columns(executor, front, end, per_column * strip / 2, sums, finish);
        }
        return none;
    });
}

void update_border(Kernel kernel, Panel const& panel, UpdateMatrix const& update,
                   Workers const& workers) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        Offset const multiplications = front.cost(update_entries(update.n) * panel.pivots);
        const Real* const sums = workers.sums + panel.border_sums();
        spread(workers.executor, multiplications, divide_up(update.n, strip),
               [&](Index band) { front.kernels.update_band(panel, update, band * strip, sums); });
    });
}

void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row,
                   Executor const& executor) noexcept {
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = 0; first < panel.pivots; first += strip) {
            Index const end = front.end_of(first);
            Offset const per_row = front.cost(Offset{end - first} * row);
            front.kernels.solve_strip_forward(front.own, first, end, y, row);
            spread_rows(executor, end, panel.pivots, per_row, [&](Index from, Index to) {
                front.kernels.subtract_forward(front.own, first, end, y, y, row, from, to);
            });
            spread_rows(executor, 0, panel.border, per_row, [&](Index from, Index to) {
                front.kernels.subtract_forward(front.border, first, end, y,
                                               front.border_rows(y, row), row, from, to);
            });
        }
    });
}

void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row,
                    Executor const& executor) noexcept {
    Offset const ahead = prefetch_distance(panel);
    with_front(kernel, panel, [&](auto const& front) {
        for (Index first = (panel.pivots - 1) / strip * strip; first >= 0; first -= strip) {
            Index const end = front.end_of(first);
            spread_rows(
                executor, first, end, front.cost(Offset{panel.front() - end} * row),
                [&](Index from, Index to) {
                    front.kernels.subtract_backward(front.own, end, y, y, row, from, to, ahead);
                    front.kernels.subtract_backward(front.border, 0, y, front.border_rows(y, row),
                                                    row, from, to, ahead);
                });
            front.kernels.solve_strip_backward(front.own, first, end, y, row, ahead);
        }
    });
}

void extend_add(Kernel kernel, UpdateMatrix const& from, const Index* targets, Panel const& panel,
                UpdateMatrix const& update) noexcept {
    move_kernels(kernel).extend_add(from, targets, panel, update);
}

void add_rows(Kernel kernel, Index n, const Real* from, const Index* targets, Real* y,
              Index length) noexcept {
    move_kernels(kernel).add_rows(n, from, targets, y, length);
}

void copy_rows(Kernel kernel, Index n, const Real* y, const Index* targets, Real* to,
               Index length) noexcept {
    move_kernels(kernel).copy_rows(n, y, targets, to, length);
}

void gather(Kernel kernel, Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
            Index planes) noexcept {
    move_kernels(kernel).gather(from, begin, n, behind, y, row, planes);
}

void scatter(Kernel kernel, const Real* y, Index row, Index planes, Rows const& to, Index begin,
             Index n) noexcept {
    move_kernels(kernel).scatter(y, row, planes, to, begin, n);
}

}  // namespace harmorph::dense
