#include "morph/weighted_sum.hpp"

namespace harmorph {
namespace {

// A task treats at least so many blocks of points.
constexpr Index min_blocks_to_add = 256;
constexpr Index width = block_points;

void add_real(const Real* from, Real* to, Real weight) noexcept {
    for (Index p = 0; p < width; ++p) to[p] += weight * from[p];
}

// Adds two numbers that act on x and y of a movement together, for all points of a block.
void add_pair(const Real* from, Real* to, Offset plane, Vec2 weight) noexcept {
    for (Index p = 0; p < width; ++p) {
        Vec2 const added = product({from[p], from[plane + p]}, weight);
        to[p] += added.x;
        to[plane + p] += added.y;
    }
}

}  // namespace

void add_weighted(Basis const& sum, Basis const& basis, Span<const Vec2> weight,
                  Executor const& executor) noexcept {
    Index const n = basis.n_functions();
    Offset const plane = Offset{n} * width, block = Offset{basis.row_length()} * width;
    auto const add = [&](const Real* from, Real* to, Vec2 w) {
        switch (basis.kind()) {
            case ValueKind::real: return add_real(from, to, w.x);
            case ValueKind::complex: return add_pair(from, to, plane, w);
            case ValueKind::matrix:
                // The sum xx + xy of a rotated movement is (xx - i xy) w, with the other sign of i.
                add_pair(from, to, plane, {w.x, -w.y});
                return add_pair(from + 2 * plane, to + 2 * plane, plane, {w.x, -w.y});
        }
    };
    executor.for_ranges(
        blocks_of(basis.n_points()), min_blocks_to_add, [&](Index begin, Index end) {
            for (Index number = begin; number < end; ++number) {
                const Real* const from = basis.value.data() + number * block;
                Real* const to = sum.value.data() + number * block;
                for (Index i = 0; i < n; ++i)
                    add(from + Offset{i} * width, to + Offset{i} * width, weight[i]);
            }
        });
}

}  // namespace harmorph
