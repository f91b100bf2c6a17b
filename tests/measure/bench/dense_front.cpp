#include "dense_front.hpp"

#include "dense/dense.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace bench {
namespace {

namespace dense = harmorph::dense;

harmorph::Kernel chosen(int kernel) {
    auto const wanted = static_cast<harmorph::Kernel>(kernel);
    if (wanted == harmorph::Kernel::automatic) return harmorph::best_kernel();
    if (!harmorph::has_kernel(wanted))
        throw std::invalid_argument("this processor lacks the kernel asked for");
    return wanted;
}

Numbers numbers(harmorph::Offset count, double value = 0) {
    return Numbers(static_cast<std::size_t>(count), value);
}

}  // namespace

struct DenseFront::Inside {
    harmorph::Kernel kernel;
    Numbers original, panel_data, update_data, sums, sides;
    double min_pivot_ratio = 1;
    dense::Panel panel;
    dense::UpdateMatrix update;

    dense::Workers workers() { return {harmorph::Executor{}, sums.data(), &min_pivot_ratio}; }
};

DenseFront::DenseFront(int kernel, int pivots, int front) : inside_(new Inside) {
    Inside& in = *inside_;
    in.kernel = chosen(kernel);
    in.original = numbers(dense::panel_entries(pivots, front - pivots));
    dense::Panel const panel{in.original.data(), pivots, front - pivots};
    for (int i = 0; i < pivots; ++i)
        for (int j = 0; j < front; ++j) {  // in the diagonal's place, the row's sum
            double const value = j < i ? entry(front, j, i) : entry(front, i, j);
            *panel.at(i, i) += value;
            if (j > i) *panel.at(i, j) = value;
        }
    in.panel_data = in.original;
    in.panel = {in.panel_data.data(), pivots, front - pivots};
    in.update_data = numbers(dense::update_entries(front - pivots));
    in.update = {in.update_data.data(), front - pivots};
    in.sums = numbers(dense::sum_entries(pivots, front - pivots));
    in.sides = numbers(harmorph::Offset{front} * right_hand_sides, 1);
}

DenseFront::~DenseFront() = default;

void DenseFront::restore() {
    std::copy(inside_->original.begin(), inside_->original.end(), inside_->panel_data.begin());
    std::fill(inside_->sides.begin(), inside_->sides.end(), 1.0);
}

void DenseFront::factor() {
    Inside& in = *inside_;
    if (dense::factor(in.kernel, in.panel, 1e-14, in.workers()) >= 0)
        throw std::runtime_error("our factor failed");
}

void DenseFront::update() {
    Inside& in = *inside_;
    dense::update_border(in.kernel, in.panel, in.update, in.workers());
}

void DenseFront::solve() {
    Inside& in = *inside_;
    dense::solve_forward(in.kernel, in.panel, in.sides.data(), right_hand_sides,
                         harmorph::Executor{});
    dense::solve_backward(in.kernel, in.panel, in.sides.data(), right_hand_sides,
                          harmorph::Executor{});
}

double DenseFront::factored(int i, int j) const { return *inside_->panel.at(i, j); }

std::string DenseFront::kernel_name(int kernel) {
    switch (chosen(kernel)) {
        case harmorph::Kernel::avx512: return "avx512";
        case harmorph::Kernel::avx2: return "avx2";
        case harmorph::Kernel::neon: return "neon";
        default: return "baseline";
    }
}

}  // namespace bench
