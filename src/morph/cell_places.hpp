// The corners of several cells, with their sides and areas, in the registers of one instruction
// set: coordinates are gathered from lists of cells, or side by side in the rows of a structured
// mesh. cell_batch.cpp compiles this file for each set. tests/morph/test_cell_batch.cpp covers this
// file.

namespace harmorph::cell_measures::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index eight = 8;  // All kernels measure cells in groups of eight.
// So many lanes are gathered at a time; 8 are no faster.
constexpr Index few = lanes < 4 ? lanes : 4;
using Few [[gnu::vector_size(8 * few)]] = Real;
constexpr unsigned all = (1u << lanes) - 1;  // one bit for each lane

// harmorph::min() and max() in each lane: the result is a if one of the two is NaN.
HARMORPH_INLINE Vector lanes_min(Vector a, Vector b) noexcept { return Registers::min(b, a); }
HARMORPH_INLINE Vector lanes_max(Vector a, Vector b) noexcept { return Registers::max(b, a); }

struct Vectors {
    Vector x, y;
};
HARMORPH_INLINE Vectors operator+(Vectors a, Vectors b) noexcept { return {a.x + b.x, a.y + b.y}; }
HARMORPH_INLINE Vectors operator-(Vectors a, Vectors b) noexcept { return {a.x - b.x, a.y - b.y}; }
HARMORPH_INLINE Vector cross(Vectors a, Vectors b) noexcept { return a.x * b.y - a.y * b.x; }
HARMORPH_INLINE Vector square(Vectors a) noexcept { return a.x * a.x + a.y * a.y; }

// The counterpart of CellShape and CellCorners of `n` corners, for as many cells as a register has
// lanes; a triangle has one area.
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

template <Index n>
struct Corners {
    static constexpr Index n_areas = n == 3 ? 1 : 4;
    Vectors side[n];
    Vector twice_area[n_areas];

    // before() and after() are the sides that meet at a corner.
    static constexpr Index before(Index k) noexcept { return n == 3 ? 0 : (k + 3) & 3; }
    static constexpr Index after(Index k) noexcept { return n == 3 ? 1 : k; }

    HARMORPH_INLINE explicit Corners(Shapes<n> const& shapes) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) side[k] = shapes.at[k + 1 == n ? 0 : k + 1] - shapes.at[k];
#pragma GCC unroll 4
        for (Index k = 0; k < n_areas; ++k) twice_area[k] = cross(side[before(k)], side[after(k)]);
    }
    HARMORPH_INLINE Vector smallest() const noexcept {
        if (n == 3) return twice_area[0];
        Vector const* const a = twice_area;
        Vector const sum = (a[0] + a[n_areas / 4]) + (a[n_areas / 2] + a[n_areas - 1]);
        Vector const smallest_area =
            lanes_min(lanes_min(a[0], a[n_areas / 4]), lanes_min(a[n_areas / 2], a[n_areas - 1]));
        Vector const zero = sum - sum;
        return zero == 0 ? smallest_area : zero;
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[n_areas / 2]);
    }
};

// The coordinates of points: `max_count` numbers for each of `n` corners of the cells of a list.
template <Index n>
struct Gathered {
    Real x[n][CellBatches::max_count], y[n][CellBatches::max_count];
};

// The coordinates of the cells of a list, and their displacements or the coordinates with which
// they are compared, `other`. The coordinates of all cells are gathered before any computation, so
// that the loads, one for each number, run at the speed of the cache. Cells in a row of a
// structured mesh need not be gathered, as the coordinates of each corner are side by side.
template <Index n>
class Places {
public:
    // Fills the last registers up with the last cell.
    Places(CellList const& cells, Points points, Points other) noexcept
        : cells_(cells), points_(points), other_(other) {
        bool const unit = points.stride == 1 && (!other.given() || other.stride == 1);
        if (n == 4 && unit) find_rows();
        if (!other.given()) gather<false>(points, other);
        else if (!unit) gather<true>(points, other);
        else
            // No index is multiplied by a stride.
            gather<true>({points.x, points.y, 1}, {other.x, other.y, 1});
    }
    // Both return the corners of the cells that begin with cell i.
    HARMORPH_INLINE Shapes<n> shapes(Index i) const noexcept { return shapes(points_, at_, i); }
    HARMORPH_INLINE Shapes<n> others(Index i) const noexcept {
        return shapes(other_, other_at_, i);
    }

private:
    CellList const& cells_;
    Points points_, other_;
    std::uint64_t rows_ = 0;  // The bits of the cells at which a register of cells in a row begins.
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

    // Finds the registers in which every point is the next one after that of the preceding cell.
    // Words are two points of a cell.
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

    template <bool has_other>
    HARMORPH_INLINE void gather(Points points, Points other) noexcept {
        // This is a copy, as the compiler does not know that no coordinate is written over the
        // list.
        CellList const cells = cells_;
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
                    Offset const number = from_zero(*point, cells.index_base),
                                 from = number * points.stride;
                    x[lane] = points.x[from];
                    y[lane] = points.y[from];
                    if (!has_other) continue;
                    Offset const other_from = number * other.stride;
                    other_x[lane] = other.x[other_from];
                    other_y[lane] = other.y[other_from];
                }
                std::memcpy(at_.x[k] + i, &x, sizeof x);
                std::memcpy(at_.y[k] + i, &y, sizeof y);
                if (!has_other) continue;
                std::memcpy(other_at_.x[k] + i, &other_x, sizeof x);
                std::memcpy(other_at_.y[k] + i, &other_y, sizeof y);
            }
            for (; i % eight != 0 || i < cells.n; ++i) {
                Offset const number = from_zero(corner[n * min(i, cells.n - 1)], cells.index_base);
                at_.x[k][i] = points.x[number * points.stride];
                at_.y[k][i] = points.y[number * points.stride];
                if (!has_other) continue;
                other_at_.x[k][i] = other.x[number * other.stride];
                other_at_.y[k][i] = other.y[number * other.stride];
            }
        }
    }
};

}  // namespace
}  // namespace harmorph::cell_measures::HARMORPH_SET
