// Where to cut a part in two.
#pragma once

#include "harmorph/ordering/cut_coordinates.hpp"

namespace harmorph {

struct Cut {
    Index direction = none;  // none: halve the list as it stands
    float level = 0;
};

// What a cut makes of a part.
struct Parts {
    // Parts from this size on hold most of the multiplications: there it pays to look closely.
    static constexpr Index large = 1 << 16;

    Index left = 0, right = 0, separator = 0;
    Index left_border = 0, right_border = 0;  // unknowns next to separators above; only where the part is large

    Index size() const noexcept { return left + right + separator; }
    Real cost() const noexcept;
    // Longer, by this factor, than one through a square part of a mesh?
    bool is_longer(Real factor) const noexcept { return Real{1} * separator * separator > factor * factor * size(); }
};

// Searches in parts of the order that do not overlap may run at the same time.
class CutSearch {
public:
    CutSearch(Graph const& graph, Places const& where, Span<const Index> order) noexcept
        : graph_(graph), where_(where), order_(order) {}

    // The straight cut, in one of the directions 0 .. n_directions-1, that seems to cost least.
    Cut best(Index begin, Index end, Index n_directions) const noexcept;
    // The cut behind the level that costs least, if that is less than `least`. Where cells are much stretched or curved,
    // straight cuts run slantwise through thousands of them; steps from cell to cell do not see that.
    bool find_level_cut(Real least, Index begin, Index end, Cut& cut) const noexcept;
    // Unknowns at places begin .. end-1 that are next to separators above; 0 where a part of this size is not large.
    Index border(Index begin, Index end, Index size) const noexcept;

private:
    struct Counts;

    template <bool is_large>
    Cut best_of(Index begin, Index end, Index n_directions) const noexcept;
    void set_medians(Index begin, Index n, float* level) const noexcept;

    Graph const& graph_;
    Places const& where_;
    Span<const Index> order_;
};

}  // namespace harmorph
