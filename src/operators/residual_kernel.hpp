// Balances of rows with the registers of one instruction set; residual.cpp compiles this file
// for each set. The arithmetic of a column is the same in all instruction sets, and so are the bits
// of the result. tests/operators/test_residual.cpp covers this file.

namespace harmorph::residuals::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

constexpr Index lanes = Registers::lanes;
// The kernel treats this number of columns at a time.
constexpr Index block = 8;
constexpr Index vectors = block / lanes;
constexpr Index max_neighbours = 32;
// Values are not in the order of rows in memory, so they are prefetched so many rows ahead.
constexpr Index rows_ahead = 4;
static_assert(Residual::max_width % block == 0, "numbers of a row are kept in whole blocks");

// Loads the first n numbers of `from`, n <= block, and fills the rest with 0.
HARMORPH_INLINE void load(const Real* from, Index n, Vector (&to)[vectors]) noexcept {
#pragma GCC unroll 4
    for (Index v = 0; v < vectors; ++v, from += lanes, n -= lanes) {
        to[v] = n >= lanes ? Registers::load(from) : Registers::load_part(from, n > 0 ? n : 0);
    }
}

template <Index planes>
class Balances {
public:
    Balances(Residual const& work, Matrix const& matrix, DofValues const& dofs, Index first,
             Index n, BalancedRows& task) noexcept
        : matrix_(matrix),
          dofs_(dofs),
          latest_(work.latest),
          next_(work.next),
          passed_(work.passed),
          first_(first),
          n_(n),
          limit_(task.limit),
          plane_(dofs.columns(matrix)),
          task_(task) {}

    void run(Residual const& work, bool stores, Residual::Norms& norms) noexcept {
        PositionRange const rows = task_.rows;
        fixed_end_ = fixed_before(rows.begin);
        for (Index i = rows.begin; i < rows.end; ++i) {
            fetch(i + rows_ahead);
            own_ = at(i);
            source_ = dofs_.source_at(i);
            if (source_ != nullptr) source_ += first_;
            take_earlier(i, norms);
            for (Offset e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) {
                add({at(matrix_.column[e]), matrix_.value[e], imaginary(matrix_.imaginary, e)},
                    norms);
            }
            enter(i, matrix_.start[i]);
            fixed_ = fixed_end_;
            while (fixed_end_ < matrix_.fixed_row.count() && matrix_.fixed_row[fixed_end_] == i)
                ++fixed_end_;
            sum_flows(true, norms);
            if (stores) store_row(i, work.width, work.value);
        }
    }

private:
    struct Neighbour {
        const Real* at;
        Real re, im;
    };
    using Row = Real[planes][Residual::max_width];

    const Real* at(Index position) const noexcept { return dofs_.at(position) + first_; }
    static Real imaginary(Span<Real> numbers, Offset entry) noexcept {
        return planes == 2 ? numbers[entry] : 0;
    }

    void store_row(Index row, Index width, Span<Real> values) const noexcept {
        Real* to = values.data() + Offset{row} * planes * width;
        for (Index p = 0; p < planes; ++p, to += width) {
            for (Index k = 0; k < n_; ++k) to[k] = rest_[p][k];
        }
    }

    // Returns the number of entries of Matrix::fixed_row before this row.
    Index fixed_before(Index row) const noexcept {
        Index low = 0, high = matrix_.fixed_row.count();
        while (low < high) {
            Index const middle = low + (high - low) / 2;
            if (matrix_.fixed_row[middle] < row) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }
    // Enters the row in the list of the row whose number is the column of this entry.
    void enter(Index row, Offset entry) const noexcept {
        if (entry == matrix_.start[row + 1]) return;
        Index const column = matrix_.column[entry];
        Index& list = column < limit_ ? latest_[column] : task_.left_over;
        next_[row] = list;
        list = row;
        passed_[row] = static_cast<Index>(entry - matrix_.start[row]);
    }
    // Adds the rows in the list of this row, and the couplings to the wall.
    void take_earlier(Index i, Residual::Norms& norms) noexcept {
        bool any_right = source_ != nullptr;
        if (any_right) take_source();
        for (Index listed = latest_[i]; listed != none;) {
            Index const next_listed = next_[listed];
            if (listed < matrix_.n) {
                Offset const e = matrix_.start[listed] + passed_[listed];
                add({at(listed), matrix_.value[e], -imaginary(matrix_.imaginary, e)}, norms);
                enter(listed, e + 1);
            } else {
                if (!any_right) clear(right_);
                any_right = true;
                take_known(listed - matrix_.n, norms);
            }
            listed = next_listed;
        }
        if (any_right) add_squares(right_, norms.right_hand_side);
    }

    void take_source() noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n_; ++k) right_[p][k] = source_[p * plane_ + k];
        }
    }

    void take_known(Index coupling, Residual::Norms& norms) noexcept {
        Real const re = matrix_.coupling_value[coupling],
                   im = imaginary(matrix_.coupling_imaginary, coupling);
        const Real* const known = dofs_.wall(wall_of(coupling)) + first_;
        Row numbers;
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n_; ++k) numbers[p][k] = known[p * plane_ + k];
        }
        take(numbers, re, im, right_);
        add({known, re, im}, norms);
    }

    // Returns the dof on the wall in whose column the coupling is.
    Index wall_of(Index coupling) const noexcept {
        // The search keeps start[low] <= coupling < start[high].
        Index low = 0, high = matrix_.coupling_start.count() - 1;
        while (high - low > 1) {
            Index const middle = low + (high - low) / 2;
            (matrix_.coupling_start[middle] <= coupling ? low : high) = middle;
        }
        return low;
    }

    void clear(Row& row) const noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n_; ++k) row[p][k] = 0;
        }
    }
    // Computes row -= (re + i im) x.
    void take(Row const& x, Real re, Real im, Row& row) const noexcept {
        for (Index k = 0; k < n_; ++k) {
            row[0][k] -= re * x[0][k];
            if constexpr (planes == 2) {
                row[0][k] += im * x[1][k];
                row[1][k] -= re * x[1][k] + im * x[0][k];
            }
        }
    }
    void add_squares(Row const& row, Real* sums) const noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n_; ++k) sums[k] += row[p][k] * row[p][k];
        }
    }

    void add(Neighbour const& neighbour, Residual::Norms& norms) noexcept {
        if (count_ == max_neighbours) sum_flows(false, norms);
        neighbour_[count_++] = neighbour;
    }

    // Computes row -= (re + i im) x.
    static HARMORPH_INLINE void take(Vector const (&x)[planes][vectors], Real re, Real im,
                                     Vector (&row)[planes][vectors]) noexcept {
#pragma GCC unroll 4
        for (Index v = 0; v < vectors; ++v) {
            row[0][v] -= x[0][v] * re;
            if constexpr (planes == 2) {
                row[0][v] += x[1][v] * im;
                row[1][v] -= x[1][v] * re + x[0][v] * im;
            }
        }
    }
    // Adds the squares of columns k .. k+block-1.
    static HARMORPH_INLINE void add_squares_of(Vector const (&row)[planes][vectors],
                                               Real* sums) noexcept {
#pragma GCC unroll 4
        for (Index v = 0; v < vectors; ++v, sums += lanes) {
            Vector sum = Registers::load(sums);
#pragma GCC unroll 2
            for (Index p = 0; p < planes; ++p) sum += row[p][v] * row[p][v];
            Registers::store(sums, sum);
        }
    }

    // Subtracts flows along couplings: rest -= (re + i im) (neighbour's value - own value). If
    // `ends` is true, the row is complete with these.
    void sum_flows(bool ends, Residual::Norms& norms) noexcept {
        for (Index k = 0; k < n_; k += block) {
            Vector own[planes][vectors], rest[planes][vectors] = {};
#pragma GCC unroll 2
            for (Index p = 0; p < planes; ++p) load(own_ + p * plane_ + k, n_ - k, own[p]);
            if (begun_) {
#pragma GCC unroll 2
                for (Index p = 0; p < planes; ++p) load(rest_[p] + k, block, rest[p]);
            } else if (source_ != nullptr) {
#pragma GCC unroll 2
                for (Index p = 0; p < planes; ++p) load(source_ + p * plane_ + k, n_ - k, rest[p]);
            }
            for (Index c = 0; c < count_; ++c) {
                Neighbour const& neighbour = neighbour_[c];
                Vector rise[planes][vectors];
#pragma GCC unroll 2
                for (Index p = 0; p < planes; ++p) {
                    load(neighbour.at + p * plane_ + k, n_ - k, rise[p]);
#pragma GCC unroll 4
                    for (Index v = 0; v < vectors; ++v) rise[p][v] -= own[p][v];
                }
                take(rise, neighbour.re, neighbour.im, rest);
            }
            if (ends) {
                for (Index f = fixed_; f < fixed_end_; ++f) {
                    take(own, -matrix_.fixed_value[f], -imaginary(matrix_.fixed_imaginary, f),
                         rest);
                }
                add_squares_of(rest, norms.rest + k);
            }
#pragma GCC unroll 2
            for (Index p = 0; p < planes; ++p) {
#pragma GCC unroll 4
                for (Index v = 0; v < vectors; ++v)
                    Registers::store(rest_[p] + k + v * lanes, rest[p][v]);
            }
        }
        count_ = 0;
        begun_ = !ends;
    }

    void fetch(Index i) const noexcept {
        if (i >= matrix_.n) return;
        prefetch_values(at(i));
        for (Offset e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e)
            prefetch_values(at(matrix_.column[e]));
    }
    void prefetch_values(const Real* values) const noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n_; k += 8) __builtin_prefetch(values + p * plane_ + k);
        }
    }

    Matrix const& matrix_;
    DofValues const& dofs_;
    Span<Index> latest_, next_, passed_;
    Index first_, n_, limit_;
    Offset plane_;
    BalancedRows& task_;
    // The values of the row, and the part of its right-hand side that does not come from the wall.
    const Real *own_ = nullptr, *source_ = nullptr;
    Index fixed_ = 0, fixed_end_ = 0;  // The entries of Matrix::fixed_row that belong to the row.
    bool begun_ = false;               // If this is true, rest_ contains some couplings of the row.
    Row rest_ = {}, right_ = {};
    Index count_ = 0;
    Neighbour neighbour_[max_neighbours];
};

void find_balances(Residual const& work, Matrix const& matrix, DofValues const& dofs, Index first,
                   Index n, BalancedRows& task, bool stores, Residual::Norms& norms) noexcept {
    if (matrix.is_complex()) {
        Balances<2>(work, matrix, dofs, first, n, task).run(work, stores, norms);
    } else {
        Balances<1>(work, matrix, dofs, first, n, task).run(work, stores, norms);
    }
}

constexpr ResidualKernels kernels{find_balances};

}  // namespace
}  // namespace harmorph::residuals::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const ResidualKernels* table<ResidualKernels, Kernel::HARMORPH_SET> =
    &harmorph::residuals::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
