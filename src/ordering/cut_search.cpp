#include "ordering/cut_search.hpp"

#include "base/scalar.hpp"

namespace harmorph {
namespace {

constexpr Index few_samples = 27, max_samples = 81;  // Both are powers of 3.

Four lanes_min(Four a, Four b) noexcept { return a < b ? a : b; }
Four lanes_max(Four a, Four b) noexcept { return a < b ? b : a; }
Four lanes_median(Four a, Four b, Four c) noexcept {
    return lanes_max(lanes_min(a, b), lanes_min(lanes_max(a, b), c));
}

// Estimates the multiplications for a region of n unknowns with a border of b, if separators of s =
// n^1/2 pivots halve the region again and again, and each half has half the border and the
// separator:
//   C(n, b) = s (s^2 / 3 + s b + b^2) + 2 C(n / 2, b / 2 + s)
// is solved by C = s (u s^2 + v s b + w b^2), and comparing coefficients, with r = 2^1/2, gives
//   w = 1 + r w / 4,   v = 1 + v / 2 + r w,   u = 1 / 3 + u / r + v + r w:
//   w = 1.547, v = 6.375, u = 30.37.
constexpr Real weight_of_unknowns = 30, weight_of_both = 6.4, weight_of_border = 1.55;

Real cost_to_cut(Real n, Real b) noexcept {
    Real const s = sqrt(n);
    return s * (weight_of_unknowns * n + weight_of_both * s * b + weight_of_border * b * b);
}

// Returns the stride of samples of large regions. Separators have about as many unknowns as the
// square root of those of the region, and a sample with this stride contains about twice
// separator_samples unknowns of a separator.
Index stride_of(Index region, Real separator_samples) noexcept {
    return max(Index{1}, static_cast<Index>(sqrt(region) / (2 * separator_samples)));
}

// Returns a pseudo-random number below `end` (the final mixing of A. Appleby's MurmurHash3).
Index pseudo_random(Index from, Index end) noexcept {
    std::uint32_t bits = static_cast<std::uint32_t>(from);
    bits = (bits ^ bits >> 16) * 0x85ebca6bu;
    bits = (bits ^ bits >> 13) * 0xc2b2ae35u;
    return static_cast<Index>((bits ^ bits >> 16) % static_cast<std::uint32_t>(end));
}

}  // namespace

// The cost of large regions is twice the number of multiplications. Small regions have small fronts
// for any cut; their cost is the length of the separator, increased for uneven cuts.
Real CutSizes::cost() const noexcept {
    Real const n = size(), s = separator, b = Real{1} * left_border + right_border;
    if (n < large) return s * (0.5 + max(left, right) / n);
    return s * (s * s / 3 + s * b + b * b) + cost_to_cut(left, left_border + s) +
           cost_to_cut(right, right_border + s);
}

// Counts for cuts at `level` in all directions at once. `left` counts the unknowns with a
// coordinate below the level.
struct CutSearch::Counts {
    Four level[halves];
    Index n = 0, border = 0;
    // `near` counts the unknowns that may have a neighbour on the other side.
    FourCounts left[halves] = {}, near[halves] = {};
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
            left[half] -= is_left;  // Comparisons of vectors return -1 for true.
            near[half] -= is_near;
            if (is_large) {
                near_left[half] -= is_near & is_left;
                left_border[half] += is_left & in_border;
            }
        }
        if (is_large) border += in_border[0];
        ++n;
    }
    // Returns the sizes for the whole region if some or all of its unknowns are counted.
    template <bool is_large>
    CutSizes sizes(Index direction, Index region) const noexcept {
        auto const counted = [&](const FourCounts* counts) {
            return counts[direction / 4][direction % 4];
        };
        // The near unknowns of either side are a cover, so the smallest cover is not larger than
        // the smaller of both.
        Index const cover =
            is_large ? min(counted(near_left), counted(near) - counted(near_left)) : counted(near);
        Real const times = static_cast<Real>(region) / n;
        auto const scaled = [&](Index count) { return static_cast<Index>(times * count); };
        return {scaled(counted(left)), scaled(n - counted(left)), scaled(cover),
                scaled(counted(left_border)), scaled(border - counted(left_border))};
    }
};

Cut CutSearch::best(Index begin, Index end, Index n_directions) const noexcept {
    bool const is_large = end - begin >= CutSizes::large;
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
        for (Index k = begin; k < end; ++k) counts.add<is_large>(coordinates_.position[order_[k]]);
    }
    for (Index k = begin; k < end && stride > 1; k += stride) {
        if (k + prefetch_ahead * stride < end) {
            __builtin_prefetch(&coordinates_.position[order_[k + prefetch_ahead * stride]]);
        }
        counts.add<is_large>(coordinates_.position[order_[k]]);
        // The stride varies, because the rows of a mesh may be as long as any number of steps.
        if (counts.n % 32 == 0) k += pseudo_random(k, stride);
    }
    Cut best;
    Real min_cost = infinity;
    for (Index direction = 0; direction < n_directions; ++direction) {
        CutSizes const sizes = counts.sizes<is_large>(direction, end - begin);
        if (min(sizes.left, sizes.right) < (end - begin) / 4) continue;
        Real const cost = sizes.cost();
        if (cost >= min_cost) continue;
        min_cost = cost;
        best = {direction, medians[direction]};
    }
    return best;
}

Index CutSearch::border(Index begin, Index end, Index size) const noexcept {
    Index n = 0;
    for (Index k = begin; k < end && size >= CutSizes::large; ++k) {
        n += static_cast<Index>(coordinates_.position[order_[k]].at[border_lane]);
    }
    return n;
}

bool CutSearch::find_level_cut(Real max_cost, Index begin, Index end, Cut& cut) const noexcept {
    Index const n = end - begin, whole_border = border(begin, end, n);
    Span<Index> const by_level = coordinates_.queue.from(begin, n);
    coordinates_.find_levels(graph_, order_.from(begin, n), by_level);
    auto const at = [&](Index k, Index lane) {
        return coordinates_.position[by_level[k]].at[lane];
    };
    bool found = false;
    for (Index first = 0, behind = 0, passed = 0; first < n - n / 4; first = behind) {
        Index const before = passed;
        for (; behind < n && at(behind, level_direction) == at(first, level_direction); ++behind) {
            passed += static_cast<Index>(at(behind, border_lane));
        }
        if (first < n / 4 || n - behind < n / 4) continue;
        Real const cost =
            CutSizes{first, n - behind, behind - first, before, whole_border - passed}.cost();
        if (cost >= max_cost) continue;
        max_cost = cost;
        cut = {level_direction, at(first, level_direction) + 0.5f};
        found = true;
    }
    return found;
}

// The levels are close to the medians: they are medians of three medians of three, and so on (P. J.
// Rousseeuw, G. W. Bassett, J. Am. Stat. Assoc. 85 (1990) 97), of samples.
void CutSearch::set_medians(Index begin, Index n, float* level) const noexcept {
    Index count = n < 1024 ? few_samples : max_samples;
    Four sample[max_samples][halves];
    for (Index k = 0; k < count; ++k) {
        CutPosition const& position =
            coordinates_.position[order_[begin + static_cast<Index>(Offset{k} * n / count)]];
        for (Index half = 0; half < halves; ++half) sample[k][half] = four(position.at, half);
    }
    while (count > 1) {
        count /= 3;
        for (Index k = 0; k < count; ++k) {
            for (Index half = 0; half < halves; ++half) {
                sample[k][half] = lanes_median(sample[k][half], sample[k + count][half],
                                               sample[k + 2 * count][half]);
            }
        }
    }
    for (Index half = 0; half < halves; ++half) set_four(level, half, sample[0][half]);
    level[layer_direction] -= 0.5f;  // These levels lie between two whole numbers.
    level[across_direction] -= 0.5f;
}

}  // namespace harmorph
