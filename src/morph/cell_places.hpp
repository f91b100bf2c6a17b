// Where the corners of several cells are, with the registers of one instruction set: gathered from
// lists of cells, or side by side in the rows of a structured mesh. Compiled for each set by
// cell_batch.cpp.

namespace harmorph::cell_looks::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index eight = 8;                    // cells are looked at in eights in all kernels
constexpr Index few = lanes < 4 ? lanes : 4;  // lanes that are gathered at a time; 8 are no faster
using Few [[gnu::vector_size(8 * few)]] = Real;
constexpr unsigned all = (1u << lanes) - 1;  // bits

// harmorph::smaller() and larger() in each lane: a where one of the two is NaN.
HARMORPH_INLINE Vector least_of(Vector a, Vector b) noexcept { return Registers::min(b, a); }
HARMORPH_INLINE Vector most_of(Vector a, Vector b) noexcept { return Registers::max(b, a); }

struct Vectors {
    Vector x, y;
};
HARMORPH_INLINE Vectors operator+(Vectors a, Vectors b) noexcept { return {a.x + b.x, a.y + b.y}; }
HARMORPH_INLINE Vectors operator-(Vectors a, Vectors b) noexcept { return {a.x - b.x, a.y - b.y}; }
HARMORPH_INLINE Vector cross(Vectors a, Vectors b) noexcept { return a.x * b.y - a.y * b.x; }
HARMORPH_INLINE Vector square(Vectors a) noexcept { return a.x * a.x + a.y * a.y; }

// As CellShape and CellCorners of `n` corners, of as many cells as a register has lanes; a triangle
// has one area.
template <Index n>
struct Shapes {
    Vectors at[n];

    HARMORPH_INLINE void move_by(Shapes const& change) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) at[k] = at[k] + change.at[k];
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? cross(at[1] - at[0], at[2] - at[0])
                             : cross(at[2] - at[0], at[n - 1] - at[1]));
    }
};

// Coordinates of points, `most` numbers for each of `n` corners of the cells of a list.
template <Index n>
struct Gathered {
    Real x[n][CellBatches::most], y[n][CellBatches::most];
};

// The coordinates of the cells of a list, and of what they are displaced by or compared with,
// `other`. They are gathered for all cells before anything is computed: so the loads, one for each
// number, run at the speed of the cache. Cells in a row of a structured mesh need not be gathered,
// as the coordinates of each corner stand side by side.
template <Index n>
class Places {
public:
    // The last registers are filled up with the last cell.
    Places(CellList const& cells, Points points, Points other) noexcept
        : cells_(cells), points_(points), other_(other) {
        bool const unit = points.stride == 1 && (!other.given() || other.stride == 1);
        if (n == 4 && unit) find_rows();
        if (!other.given()) gather<false>(points, other);
        else if (!unit) gather<true>(points, other);
        else
            gather<true>({points.x, points.y, 1},
                         {other.x, other.y, 1});  // no multiplications by strides
    }
    // Of the cells from cell i on.
    HARMORPH_INLINE Shapes<n> shapes(Index i) const noexcept { return shapes(points_, at_, i); }
    HARMORPH_INLINE Shapes<n> others(Index i) const noexcept {
        return shapes(other_, other_at_, i);
    }

private:
    CellList const& cells_;
    Points points_, other_;
    std::uint64_t rows_ = 0;  // bits of the cells at which a register of cells in a row begins
    Gathered<n> at_, other_at_;

    HARMORPH_INLINE Index which(Index k) const noexcept { return cells_.reversed ? n - 1 - k : k; }
    HARMORPH_INLINE Shapes<n> shapes(Points points, Gathered<n> const& gathered,
                                     Index i) const noexcept {
        Shapes<n> shapes = {};
        bool const is_row = n == 4 && (rows_ >> i & 1) != 0;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            Index const first =
                is_row ? from_zero(cells_.point[n * i + which(k)], cells_.index_base) : 0;
            const Real* const x = is_row ? points.x + first : gathered.x[k] + i;
            const Real* const y = is_row ? points.y + first : gathered.y[k] + i;
            shapes.at[k] = {Registers::load(x), Registers::load(y)};
        }
        return shapes;
    }

    // Is every point the one behind that of the cell before? Words are two points of a cell.
    HARMORPH_INLINE void find_rows() noexcept {
        for (Index i = 0; i + lanes <= cells_.n; i += lanes) {
            const Index* const points = cells_.point + n * i;
            Words const differs = off_step(points) | off_step(points + 2 * (lanes - 2));
            Vector const zero = {};
            bool const is_row = Registers::less(zero, differs != 0 ? zero + 1 : zero) == 0;
            rows_ |= std::uint64_t{is_row} << i;
        }
    }
    static HARMORPH_INLINE Words off_step(const Index* points) noexcept {
        return (words_at(points + 4) - words_at(points)) ^ 0x0000000100000001;
    }
    static HARMORPH_INLINE Words words_at(const Index* points) noexcept {
        Words words;
        std::memcpy(&words, points, sizeof words);
        return words;
    }

    template <bool both>
    HARMORPH_INLINE void gather(Points points, Points other) noexcept {
        CellList const cells = cells_;  // copies, as the compiler does not know that no coordinate
                                        // is written over them
        std::uint64_t const rows = rows_;
#pragma GCC unroll 1
        for (Index k = 0; k < n; ++k) {
            const Index* const corner = cells.point + which(k);
            Index i = 0;
#pragma GCC unroll 1
            for (; i + few <= cells.n; i += few) {
                if (n == 4 && (rows >> (i & -lanes) & 1) != 0) continue;
                const Index* point = corner + n * i;
                Few x = {}, y = {}, other_x = {}, other_y = {};
#pragma GCC unroll 4
                for (Index lane = 0; lane < few; ++lane, point += n) {
                    Offset const its = from_zero(*point, cells.index_base),
                                 from = its * points.stride;
                    x[lane] = points.x[from];
                    y[lane] = points.y[from];
                    if (!both) continue;
                    Offset const other_from = its * other.stride;
                    other_x[lane] = other.x[other_from];
                    other_y[lane] = other.y[other_from];
                }
                std::memcpy(at_.x[k] + i, &x, sizeof x);
                std::memcpy(at_.y[k] + i, &y, sizeof y);
                if (!both) continue;
                std::memcpy(other_at_.x[k] + i, &other_x, sizeof x);
                std::memcpy(other_at_.y[k] + i, &other_y, sizeof y);
            }
            for (; i % eight != 0 || i < cells.n; ++i) {
                Offset const its = from_zero(corner[n * min(i, cells.n - 1)], cells.index_base);
                at_.x[k][i] = points.x[its * points.stride];
                at_.y[k][i] = points.y[its * points.stride];
                if (!both) continue;
                other_at_.x[k][i] = other.x[its * other.stride];
                other_at_.y[k][i] = other.y[its * other.stride];
            }
        }
    }
};

}  // namespace
}  // namespace harmorph::cell_looks::HARMORPH_SET
