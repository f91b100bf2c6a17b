#include "harmorph/morph/weighted_sum.hpp"

namespace harmorph {
namespace {

constexpr Index least_range = 4096;  // points that are worth a thread

// Two planes of values that act on x and y of a movement together; turn: +1 where the second one multiplies i.
void add_pair(const Real* from, Real* to, Index plane, Span<const Vec2> weight, Real turn) noexcept {
    for (Index i = 0; i < weight.count(); ++i) {
        Vec2 const w{weight[i].x, turn * weight[i].y};
        Vec2 const added = product({from[i], from[plane + i]}, w);
        to[i] += added.x;
        to[plane + i] += added.y;
    }
}

}  // namespace

void add_weighted(Basis const& sum, Basis const& basis, Span<const Vec2> weight, Executor const& executor) noexcept {
    Index const n = basis.n_functions();
    executor.for_ranges(basis.n_points(), least_range, [&](Index begin, Index end) {
        for (Index point = begin; point < end; ++point) {
            const Real* const from = basis.row(point);
            Real* const to = sum.row(point);
            switch (basis.kind()) {
                case ValueKind::real:
                    for (Index i = 0; i < n; ++i) to[i] += weight[i].x * from[i];
                    break;
                case ValueKind::complex: add_pair(from, to, n, weight, 1); break;
                case ValueKind::matrix:  // xx + xy of a turned movement: (xx - i xy) w, with the other sign of i
                    add_pair(from, to, n, weight, -1);
                    add_pair(from + 2 * n, to + 2 * n, n, weight, -1);
                    break;
            }
        }
    });
}

}  // namespace harmorph
