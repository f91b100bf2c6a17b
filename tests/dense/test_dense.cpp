// The dense kernels against plain loops, real and complex, in double and in single precision, for
// every size up to 60 and round the borders of blocks, tiles and strips, on every kind of processor
// at hand.
#include <fixtures/front.hpp>
#include <fixtures/executors.hpp>

using namespace fixtures;
using namespace fixtures::fronts;

namespace {

template <class Its>
class FrontCheck {
public:
    FrontCheck(Kernel kernel, Index pivots, Index border)
        : n_(std::size_t(pivots + border)),
          p_(std::size_t(pivots)),
          expected_(some_matrix<Its>(n_, unsigned(n_ * 1000 + p_))),
          front_(kernel, expected_, pivots) {
        REQUIRE(expected_.factor(p_));
        CHECK(front_.factor() == harmorph::none);
        front_.update_border();
        check_factor();
        for (Index const row : {1, 3, 5}) check_solves(row * dense::slab);
    }

private:
    using Number = typename Its::Number;
    using Entry = typename Its::Entry;
    static constexpr Index slab = dense::slab;

    void compare(const Number* found, harmorph::Offset plane, Entry exact) {
        double const error = std::abs(Its::get(found, plane) - exact) / std::sqrt(double(n_));
        if (!(error <= worst_)) worst_ = error;  // NaN stays
    }
    void check_factor() {
        worst_ = 0;
        auto const panel = front_.panel();
        for (Index k = 0; k < front_.pivots;
             ++k)  // behind each diagonal block, which holds its inverse
            for (Index c = std::min(panel.pivots, (k / slab + 1) * slab); c < front_.size; ++c)
                compare(panel.at(k, c), slab, expected_.at(std::size_t(k), std::size_t(c)));
        auto const update = front_.update_matrix();
        auto const left = [&](Index r, Index c) {
            return expected_.at(p_ + std::size_t(r), p_ + std::size_t(c));
        };
        for (Index r = 0; r < update.n; ++r) {
            Entry sum = 0;
            for (Index c = 0; c < update.n; ++c) sum += c < r ? conjugate(left(c, r)) : left(r, c);
            compare(update.at(r, r), slab, sum);
            for (Index c = r + 1; c < update.n; ++c) compare(update.at(r, c), slab, left(r, c));
        }
        CHECK(worst_ < Its::tolerance);
        CHECK(front_.is_poisoned_behind());
    }
    void check_solves(Index row) {
        std::size_t const width = std::size_t(row), length = Its::planes * width;
        std::vector<Entry> exact(n_ * width);
        std::vector<Number> y(n_ * length + behind, Its::poison);
        std::mt19937 random(9);
        auto const place = [&](std::size_t k) { return y.data() + k / width * length + k % width; };
        for (std::size_t k = 0; k < exact.size(); ++k) {
            exact[k] = Its::some_entry(random);
            Its::put(exact[k], place(k), row);
        }
        worst_ = 0;
        for (std::size_t k = 0; k < p_; ++k)
            for (std::size_t i = 0; i < width; ++i) {
                exact[k * width + i] /= expected_.at(k, k);
                for (std::size_t r = k + 1; r < n_; ++r)
                    exact[r * width + i] -= conjugate(expected_.at(k, r)) * exact[k * width + i];
            }
        dense::solve_forward(front_.kernel, front_.panel(), y.data(), row, front_.executor);
        for (std::size_t k = 0; k < exact.size(); ++k) compare(place(k), row, exact[k]);
        for (std::size_t k = p_; k-- > 0;)
            for (std::size_t i = 0; i < width; ++i) {
                for (std::size_t c = k + 1; c < n_; ++c)
                    exact[k * width + i] -= expected_.at(k, c) * exact[c * width + i];
                exact[k * width + i] /= expected_.at(k, k);
            }
        dense::solve_backward(front_.kernel, front_.panel(), y.data(), row, front_.executor);
        for (std::size_t k = 0; k < exact.size(); ++k) compare(place(k), row, exact[k]);
        CHECK(worst_ < Its::tolerance);
        CHECK(tail_is_poisoned(y));
    }

    std::size_t n_, p_;
    typename Its::Matrix expected_;
    Front<Its> front_;
    double worst_ = 0;
};

template <class Its>
void check_front(Kernel kernel, Index pivots, Index border) {
    INFO("kernel " << int(kernel) << ", " << pivots << " pivots, border " << border);
    FrontCheck<Its> const check(kernel, pivots, border);
}

}  // namespace

TEST_CASE_TEMPLATE("fronts of 1 to 60 pivots are factored with and without a border", Its,
                   ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels())
        for (Index pivots = 1; pivots <= 60; ++pivots) {
            check_front<Its>(kernel, pivots, 0);
            check_front<Its>(kernel, pivots, pivots % 23 + 1);
        }
}

TEST_CASE_TEMPLATE("fronts with borders of 0 to 60, and round whole tiles and bands, are factored",
                   Its, ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels()) {
        for (Index border = 0; border <= 60; ++border)
            check_front<Its>(kernel, border % 41 + 1, border);
        for (Index const border : {71, 72, 73, 95, 96, 97, 127, 128, 129, 136, 193})
            check_front<Its>(kernel, 9, border);
    }
}

TEST_CASE_TEMPLATE("large fronts of several strips of pivots and tiles of border are factored", Its,
                   ALL_ARITHMETICS) {
    Index const sizes[][2] = {{127, 130}, {128, 0}, {129, 64}, {100, 203}, {256, 29}, {257, 3}};
    for (Kernel const kernel : fixtures::usable_kernels())
        for (auto const& size : sizes) check_front<Its>(kernel, size[0], size[1]);
}

TEST_CASE_TEMPLATE("any number of threads in any order gives the same bits", Its, ALL_ARITHMETICS) {
    using Number = typename Its::Number;
    Index const sizes[][2] = {{300, 600}, {600, 0}, {40, 900}, {128, 500}};
    for (auto const& size : sizes) {
        auto const a = some_matrix<Its>(std::size_t(size[0] + size[1]), 5);
        std::size_t const n = a.n * std::size_t(Its::planes) * 32;
        for (Kernel const kernel : fixtures::usable_kernels()) {
            std::vector<Number> first[3];
            for (Index const threads : {1, 2, 7}) {
                Front<Its> front(kernel, a, size[0], threads);
                REQUIRE(front.factor() == harmorph::none);
                front.update_border();
                std::vector<Number> y(n);
                for (std::size_t k = 0; k < n; ++k) y[k] = static_cast<Number>(std::sin(double(k)));
                dense::solve_forward(kernel, front.panel(), y.data(), 32, front.executor);
                dense::solve_backward(kernel, front.panel(), y.data(), 32, front.executor);
                for (std::vector<Number>* array : {&front.data, &front.update})
                    array->resize(array->size() - behind);
                if (threads == 1) {
                    first[0] = front.data;
                    first[1] = front.update;
                    first[2] = y;
                }
                CHECK(same_bits(front.data, first[0]));
                CHECK(same_bits(front.update, first[1]));
                CHECK(same_bits(y, first[2]));
                CHECK((threads > 1) == (front.order.calls > 0));  // they were put to work
            }
        }
    }
}
