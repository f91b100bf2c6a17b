// Where to cut a part in two.
#pragma once

#include "ordering/cut_coordinates.hpp"

namespace harmorph {

struct Cut {
    Index direction = none;  // none: halve the list as it stands
    float level = 0;
};

// What a cut makes of a part.
struct Parts {
    // Parts from this size on lead to most of the multiplications: there a more exact estimate of
    // the cost is worth the time.
    static constexpr Index large = 1 << 16;

    Index left = 0, right = 0, separator = 0;
    Index left_border = 0,
          right_border = 0;  // unknowns next to separators above; only where the part is large

    Index size() const noexcept { return left + right + separator; }
    Real cost() const noexcept;
    // Longer, by this factor, than one through a square part of a mesh?
    bool is_longer(Real factor) const noexcept {
        return Real{1} * separator * separator > factor * factor * size();
    }
};

// Searches in parts of the order that do not overlap may run at the same time.
class CutSearch {
public:
    CutSearch(Graph const& graph, CutCoordinates const& coordinates,
              Span<const Index> order) noexcept
        : graph_(graph), coordinates_(coordinates), order_(order) {}

    // The straight cut, in one of the directions 0 .. n_directions-1, that seems to cost least.
    Cut best(Index begin, Index end, Index n_directions) const noexcept;
    // The cut behind the level that costs least, if the cost is less than `least`. In strongly
    // stretched or curved cells straight cuts run obliquely through thousands of cells; steps from
    // cell to cell do not depend on their shape.
    bool find_level_cut(Real least, Index begin, Index end, Cut& cut) const noexcept;
    // How many unknowns of order [begin .. end-1] are next to separators above; 0 where a part of
    // this size is not large.
    Index border(Index begin, Index end, Index size) const noexcept;

private:
    struct Counts;

    template <bool is_large>
    Cut best_of(Index begin, Index end, Index n_directions) const noexcept;
    void set_medians(Index begin, Index n, float* level) const noexcept;

    Graph const& graph_;
    CutCoordinates const& coordinates_;
    Span<const Index> order_;
};

}  // namespace harmorph
