#include "ordering/cut_search.hpp"

#include "base/scalar.hpp"

namespace harmorph {
namespace {

constexpr Index few_samples = 27, most_samples = 81;  // powers of 3

Four least_of(Four a, Four b) noexcept { return a < b ? a : b; }
Four most_of(Four a, Four b) noexcept { return a < b ? b : a; }
Four middle_of(Four a, Four b, Four c) noexcept {
    return most_of(least_of(a, b), least_of(most_of(a, b), c));
}

// Multiplications that a part of n unknowns with a border of b leads to, where separators of s =
// n^1/2 pivots halve it again and again, and each half has half the border and the separator:
//   C(n, b) = s (s^2 / 3 + s b + b^2) + 2 C(n / 2, b / 2 + s)
// is solved by C = s (u s^2 + v s b + w b^2), and comparing coefficients, with r = 2^1/2, gives
//   w = 1 + r w / 4,   v = 1 + v / 2 + r w,   u = 1 / 3 + u / r + v + r w:   w = 1.547, v = 6.375,
//   u = 30.37.
constexpr Real of_unknowns = 30, of_both = 6.4, of_border = 1.55;

Real cost_to_cut(Real n, Real b) noexcept {
    Real const s = sqrt(n);
    return s * (of_unknowns * n + of_both * s * b + of_border * b * b);
}

// The stride of samples of large parts: separators have about the square root of the number of
// unknowns, and a sample with this stride contains twice separator_samples of these.
Index stride_of(Index part, Real separator_samples) noexcept {
    return max(Index{1}, static_cast<Index>(sqrt(part) / (2 * separator_samples)));
}

// A pseudo-random number below `end` (the final mixing of A. Appleby's MurmurHash3).
Index scattered(Index from, Index end) noexcept {
    std::uint32_t bits = static_cast<std::uint32_t>(from);
    bits = (bits ^ bits >> 16) * 0x85ebca6bu;
    bits = (bits ^ bits >> 13) * 0xc2b2ae35u;
    return static_cast<Index>((bits ^ bits >> 16) % static_cast<std::uint32_t>(end));
}

}  // namespace

// Large parts: twice the multiplications. Small parts have small fronts whatever the cut: the
// length of the separator, more for uneven cuts.
Real Parts::cost() const noexcept {
    Real const n = size(), s = separator, b = Real{1} * left_border + right_border;
    if (n < large) return s * (0.5 + max(left, right) / n);
    return s * (s * s / 3 + s * b + b * b) + cost_to_cut(left, left_border + s) +
           cost_to_cut(right, right_border + s);
}

// Counts for cuts at `level` in all directions at once; left: unknowns with a coordinate below the
// level.
struct CutSearch::Counts {
    Four level[halves];
    Index n = 0, border = 0;
    FourCounts left[halves] = {}, near[halves] = {};  // near: what may have a neighbour across
    FourCounts near_left[halves] = {}, left_border[halves] = {};

    template <bool is_large>
    void add(CutPosition const& position) noexcept {
        FourCounts const in_border =
            FourCounts{} + (is_large ? static_cast<Index>(position.at[border_lane]) : 0);
        for (Index half = 0; half < halves; ++half) {
            Four const distance = four(position.at, half) - level[half],
                       reach = four(position.reach, half);
            FourCounts const is_left = distance < 0,
                             is_near = (distance <= reach) & (-distance <= reach);
            left[half] -= is_left;  // -1 where true
            near[half] -= is_near;
            if (is_large) {
                near_left[half] -= is_near & is_left;
                left_border[half] += is_left & in_border;
            }
        }
        if (is_large) border += in_border[0];
        ++n;
    }
    // Of a part of which some unknowns are counted, or all.
    template <bool is_large>
    Parts parts(Index direction, Index part) const noexcept {
        auto const of = [&](const FourCounts* counts) {
            return counts[direction / 4][direction % 4];
        };
        // All near unknowns of one side are a cover, so the smallest cover is not larger than
        // either.
        Index const cover = is_large ? min(of(near_left), of(near) - of(near_left)) : of(near);
        Real const times = static_cast<Real>(part) / n;
        auto const all = [&](Index counted) { return static_cast<Index>(times * counted); };
        return {all(of(left)), all(n - of(left)), all(cover), all(of(left_border)),
                all(border - of(left_border))};
    }
};

Cut CutSearch::best(Index begin, Index end, Index n_directions) const noexcept {
    bool const is_large = end - begin >= Parts::large;
    return is_large ? best_of<true>(begin, end, n_directions)
                    : best_of<false>(begin, end, n_directions);
}

template <bool is_large>
Cut CutSearch::best_of(Index begin, Index end, Index n_directions) const noexcept {
    float medians[direction_lanes];
    set_medians(begin, end - begin, medians);
    Counts counts;
    for (Index half = 0; half < halves; ++half) counts.level[half] = four(medians, half);
    Index const stride = stride_of(end - begin, is_large ? 96 : 48);
    if (stride == 1) {
        for (Index k = begin; k < end; ++k) counts.add<is_large>(coordinates_.of[order_[k]]);
    }
    for (Index k = begin; k < end && stride > 1; k += stride) {
        if (k + prefetch_ahead * stride < end) {
            __builtin_prefetch(&coordinates_.of[order_[k + prefetch_ahead * stride]]);
        }
        counts.add<is_large>(coordinates_.of[order_[k]]);
        if (counts.n % 32 == 0)
            k += scattered(k, stride);  // rows of meshes may be as long as any number of steps
    }
    Cut best;
    Real least = infinity;
    for (Index direction = 0; direction < n_directions; ++direction) {
        Parts const parts = counts.parts<is_large>(direction, end - begin);
        if (min(parts.left, parts.right) < (end - begin) / 4) continue;
        Real const cost = parts.cost();
        if (cost >= least) continue;
        least = cost;
        best = {direction, medians[direction]};
    }
    return best;
}

Index CutSearch::border(Index begin, Index end, Index size) const noexcept {
    Index n = 0;
    for (Index k = begin; k < end && size >= Parts::large; ++k) {
        n += static_cast<Index>(coordinates_.of[order_[k]].at[border_lane]);
    }
    return n;
}

bool CutSearch::find_level_cut(Real least, Index begin, Index end, Cut& cut) const noexcept {
    Index const n = end - begin, whole_border = border(begin, end, n);
    Span<Index> const by_level = coordinates_.queue.from(begin, n);
    coordinates_.find_levels(graph_, order_.from(begin, n), by_level);
    auto const at = [&](Index k, Index lane) { return coordinates_.of[by_level[k]].at[lane]; };
    bool found = false;
    for (Index first = 0, behind = 0, passed = 0; first < n - n / 4; first = behind) {
        Index const before = passed;
        for (; behind < n && at(behind, level_direction) == at(first, level_direction); ++behind) {
            passed += static_cast<Index>(at(behind, border_lane));
        }
        if (first < n / 4 || n - behind < n / 4) continue;
        Real const cost =
            Parts{first, n - behind, behind - first, before, whole_border - passed}.cost();
        if (cost >= least) continue;
        least = cost;
        cut = {level_direction, at(first, level_direction) + 0.5f};
        found = true;
    }
    return found;
}

// Levels close to the medians: medians of three medians of three, and so on (P. J. Rousseeuw, G. W.
// Bassett, J. Am. Stat. Assoc. 85 (1990) 97), of samples.
void CutSearch::set_medians(Index begin, Index n, float* level) const noexcept {
    Index count = n < 1024 ? few_samples : most_samples;
    Four sample[most_samples][halves];
    for (Index k = 0; k < count; ++k) {
        CutPosition const& position =
            coordinates_.of[order_[begin + static_cast<Index>(Offset{k} * n / count)]];
        for (Index half = 0; half < halves; ++half) sample[k][half] = four(position.at, half);
    }
    while (count > 1) {
        count /= 3;
        for (Index k = 0; k < count; ++k) {
            for (Index half = 0; half < halves; ++half) {
                sample[k][half] = middle_of(sample[k][half], sample[k + count][half],
                                            sample[k + 2 * count][half]);
            }
        }
    }
    for (Index half = 0; half < halves; ++half) set_four(level, half, sample[0][half]);
    level[layer_direction] -= 0.5f;  // between two
    level[across_direction] -= 0.5f;
}

}  // namespace harmorph
