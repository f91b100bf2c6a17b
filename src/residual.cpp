#include "harmorph/residual.hpp"

#include "kernel_call.hpp"

namespace harmorph {

#define HARMORPH_DECLARE(kernel)                                                                              \
    namespace kernel {                                                                                        \
    void add_inner_flows(Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value, Index width,\
                         Real* squares) noexcept;                                                             \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

namespace {

// value += what flows between unknowns; squares: of the rows then.
void add_inner_flows(Kernel kernel, Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value,
                     Index width, Real* squares) noexcept {
    HARMORPH_CALL(kernel, add_inner_flows(matrix, lines, first, n, value, width, squares))
}

// Real arithmetic for one plane of numbers, complex for two: the second plane follows `plane` numbers after the first.
template <Index planes>
struct Columns {
    Index n, width;  // of them; room for as many
    Offset plane;

    // row -= (re + i im) x
    void subtract(Real re, Real im, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n; ++k) {
            row[k] -= re * x[k];
            if constexpr (planes == 2) {
                row[k] += im * x[plane + k];
                row[width + k] -= re * x[plane + k] + im * x[k];
            }
        }
    }
    // What flows from x to own along a coupling: row -= (re + i im) (x - own)
    void take_flow(Real re, Real im, const Real* own, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n; ++k) {
            Real const rise = x[k] - own[k];
            row[k] -= re * rise;
            if constexpr (planes == 2) {
                Real const turned = x[plane + k] - own[plane + k];
                row[k] += im * turned;
                row[width + k] -= re * turned + im * rise;
            }
        }
    }

    void add_squares(const Real* row, Real* sums) const noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n; ++k) sums[k] += row[p * width + k] * row[p * width + k];
        }
    }
    // And the row is 0 again.
    void take_squares(Real* row, Real* sums) const noexcept {
        add_squares(row, sums);
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n; ++k) row[p * width + k] = 0;
        }
    }
};

template <Index planes>
class Balances {
public:
    Balances(Matrix const& matrix, Lines const& lines, Index first, Index n, Index width, Span<Real> value,
             Kernel kernel) noexcept
        : matrix_(matrix), lines_(lines), first_(first), columns_{n, width, lines.columns(matrix)}, value_(value),
          kernel_(kernel) {}

    Residual::Norms run() const noexcept {
        Residual::Norms norms;
        fill(value_, 0.0);
        take_right_hand_sides(norms.right_hand_side);
        if (matrix_.kind == MatrixKind::two_lines) {
            add_turned_flows(norms.rest);
        } else {
            add_flows(norms.rest);
        }
        return norms;
    }

private:
    Real* row_of(Index position) const noexcept {
        return value_.data() + Offset{position} * planes * columns_.width;
    }
    const Real* at(Index position) const noexcept { return lines_.at(position) + first_; }
    Real imaginary(Span<Real> of, Offset entry) const noexcept { return planes == 2 ? of[entry] : 0; }

    // visit(coupling, unknown, known values)
    template <class Visit>
    void for_each_coupling(Visit visit) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = lines_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1]; ++c) {
                visit(c, matrix_.coupling_row[c], known);
            }
        }
    }

    // Their squares; the rows are 0 again.
    void take_right_hand_sides(Real* squares) const noexcept {
        for_each_coupling([&](Index c, Index i, const Real* known) {
            columns_.subtract(matrix_.coupling_value[c], imaginary(matrix_.coupling_imaginary, c), known, row_of(i));
        });
        for (Index const i : matrix_.coupling_row) columns_.take_squares(row_of(i), squares);
    }

    void add_flows(Real* squares) const noexcept {
        for_each_coupling([&](Index c, Index i, const Real* known) {
            Real const turned = imaginary(matrix_.coupling_imaginary, c);
            columns_.take_flow(matrix_.coupling_value[c], turned, at(i), known, row_of(i));
        });
        for (Index h = 0; h < matrix_.held_row.count(); ++h) {
            Index const i = matrix_.held_row[h];
            columns_.subtract(-matrix_.held_value[h], -imaginary(matrix_.held_imaginary, h), at(i), row_of(i));
        }
        add_inner_flows(kernel_, matrix_, lines_, first_, columns_.n, value_.data(), columns_.width, squares);
    }

    // One of a point's two lines.
    struct Place {
        Index point, line;
    };
    Place place_of(Index position) const noexcept { return {lines_.of[position] / 2, lines_.of[position] % 2}; }
    bool slips(Index point) const noexcept { return matrix_.place[2 * point + 1] == none; }
    const Real* line(Index point, Index its) const noexcept { return lines_.line(2 * point + its) + first_; }

    // Points that slip have a line of their own direction. What flows is found from displacements in the plane, and only then
    // turned: so both ends see the same, to rounding of the flow.
    void add_turned_flows(Real* squares) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = lines_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1]; ++c) {
                Index const i = matrix_.coupling_row[c], point = place_of(i).point;
                Real const share = slips(point) ? component(matrix_.frame[point], wall % 2) : 1;
                const Real* const own = line(point, slips(point) ? 0 : wall % 2);
                Real* const row = row_of(i);
                for (Index k = 0; k < columns_.n; ++k) row[k] -= matrix_.coupling_value[c] * (known[k] - share * own[k]);
            }
        }
        for (Index h = 0; h < matrix_.held_row.count(); ++h) {
            add_held(matrix_.held_row[h], matrix_.held_value[h], matrix_.held_imaginary[h]);
        }
        for (Index i = 0; i < matrix_.n; ++i) {
            for (Offset e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) add_entry(i, matrix_.column[e], matrix_.value[e]);
        }
        for (Index i = 0; i < matrix_.n; ++i) columns_.add_squares(row_of(i), squares);  // any entry may change any row
    }
    static Real component(Vec2 of, Index number) noexcept { return number == 0 ? of.x : of.y; }

    // i: the position of a point's first line.
    void add_held(Index i, Real re, Real im) const noexcept {
        Index const point = place_of(i).point;
        const Real* const x = line(point, 0);
        columns_.subtract(-re, 0, x, row_of(i));
        if (slips(point)) return;
        const Real* const y = line(point, 1);
        Real* const second = row_of(matrix_.place[2 * point + 1]);
        columns_.subtract(im, 0, y, row_of(i));
        columns_.subtract(-re, 0, y, second);
        columns_.subtract(-im, 0, x, second);
    }

    void add_entry(Index i, Index j, Real entry) const noexcept {
        Place const a = place_of(i), b = place_of(j);
        if (slips(a.point) != slips(b.point)) return slips(a.point) ? add_slipping(i, j, entry) : add_slipping(j, i, entry);
        if (slips(a.point) && matrix_.turns(a.point, b.point)) {  // what they hold of each other is in held_value
            columns_.subtract(entry, 0, at(j), row_of(i));
            columns_.subtract(entry, 0, at(i), row_of(j));
            return;
        }
        columns_.take_flow(entry, 0, line(a.point, b.line), at(j), row_of(i));
        columns_.take_flow(entry, 0, line(b.point, a.line), at(i), row_of(j));
    }

    // Between a point that slips and one that does not, by one of its lines: its conductance and circulation, turned as the
    // first one is, are that and the other line's entry.
    void add_slipping(Index slipping, Index free, Real entry) const noexcept {
        Place const its = place_of(free);
        Vec2 const along = matrix_.frame[place_of(slipping).point];
        const Real* const slid = at(slipping);
        const Real* const x = line(its.point, 0);
        const Real* const y = line(its.point, 1);
        Real* const own = row_of(slipping);
        Real* const same = row_of(free);
        Real* const other = row_of(matrix_.place[2 * its.point + 1 - its.line]);
        Real const across = its.line == 0 ? entry : -entry;
        for (Index k = 0; k < columns_.n; ++k) {
            Vec2 const rise{along.x * slid[k] - x[k], along.y * slid[k] - y[k]};
            own[k] += entry * component(rise, its.line);
            same[k] -= entry * dot(along, rise);
            other[k] -= across * cross(along, rise);
        }
    }

    Matrix const& matrix_;
    Lines const& lines_;
    Index first_;
    Columns<planes> columns_;
    Span<Real> value_;
    Kernel kernel_;
};

}  // namespace

Real Residual::Norms::relative(Index k) const noexcept {
    return square_root(rest[k]) / (right_hand_side[k] > 0 ? square_root(right_hand_side[k]) : 1);
}

Residual::Norms Residual::compute(Matrix const& matrix, Lines const& lines, Index first, Index n) const noexcept {
    return matrix.is_complex() ? Balances<2>(matrix, lines, first, n, width, value, kernel).run()
                               : Balances<1>(matrix, lines, first, n, width, value, kernel).run();
}

Real Residual::beside_entries(Matrix const& matrix, Lines const& lines, Index column) const noexcept {
    compute(matrix, lines, column, 1);
    Index const planes = matrix.is_complex() ? 2 : 1;
    auto const row_of = [&](Index i) { return value.data() + Offset{i} * planes * width; };
    auto const entries_of = [&](Index i) -> Real& { return row_of(i)[1]; };  // beside the column's own number
    auto const size = [&](Span<Real> re, Span<Real> im, Offset e) {
        return absolute(re[e]) + (planes == 2 ? absolute(im[e]) : 0);
    };
    for (Index i = 0; i < matrix.n; ++i) {
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            Real const its = size(matrix.value, matrix.imaginary, e);
            entries_of(i) += its;
            entries_of(matrix.column[e]) += its;
        }
    }
    for (Index c = 0; c < matrix.coupling_row.count(); ++c) {
        entries_of(matrix.coupling_row[c]) += size(matrix.coupling_value, matrix.coupling_imaginary, c);
    }
    for (Index h = 0; h < matrix.held_row.count(); ++h) {
        entries_of(matrix.held_row[h]) += size(matrix.held_value, matrix.held_imaginary, h);
    }
    Real largest = 0, worst = 0;
    Offset const plane = lines.columns(matrix);
    auto const look = [&](const Real* its) {
        for (Index p = 0; p < planes; ++p) largest = larger(largest, absolute(its[p * plane + column]));
    };
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) look(lines.wall(wall));
    for (Index i = 0; i < matrix.n; ++i) look(lines.at(i));
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real const left = absolute(row_of(i)[p * width]);
            if (left == 0) continue;
            Real const share = left / (entries_of(i) * largest);
            if (!(share < infinity)) return infinity;
            worst = larger(worst, share);
        }
    }
    return worst;
}

Residual::Changes Residual::add_to(Matrix const& matrix, Lines const& lines, Index first, Index n,
                                   Choice const& chosen) const noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Offset const plane = lines.columns(matrix);
    Real change[widest] = {}, size[widest] = {};
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real* const to = lines.at(i) + p * plane + first;
            const Real* const from = value.data() + (Offset{i} * planes + p) * width;
            for (Index k = 0; k < n; ++k) {
                to[k] = chosen.column[k] ? to[k] + from[k] : to[k];
                change[k] = larger(change[k], absolute(from[k]));
                size[k] = larger(size[k], absolute(to[k]));
            }
        }
    }
    Changes out;
    for (Index k = 0; k < n; ++k) out.column[k] = size[k] > 0 ? change[k] / size[k] : 0;
    return out;
}

}  // namespace harmorph
