// The places of entries of fronts, and the addition of entries of a child to those of the parent.
#include <fixtures/front.hpp>
#include <fixtures/executors.hpp>

using namespace fixtures;
using namespace fixtures::fronts;

TEST_CASE("every entry on and above the diagonal has a place of its own") {
    using Number = double;
    constexpr Index slab = dense::slab;
    for (Index const pivots : {1, 7, 8, 15, 16, 17, 33, 128, 300})
        for (Index const border : {0, 1, 8, 17, 33, 200}) {
            std::vector<Number> times(std::size_t(dense::panel_entries(pivots, border)), Number{0});
            dense::Panel const panel{times.data(), pivots, border};
            for (Index k = 0; k < pivots; ++k)
                for (Index c = k; c < panel.front(); ++c) {
                    REQUIRE(panel.at(k, c) < times.data() + times.size());
                    *panel.at(k, c) += 1;
                }
            CHECK(*std::max_element(times.begin(), times.end()) == 1);
            double const least = pivots * (panel.front() - (pivots - 1) / 2.0);
            CHECK(double(times.size()) <= least + pivots * 2.5 * slab);

            times.assign(std::size_t(dense::update_entries(pivots)), Number{0});
            dense::UpdateMatrix const update{times.data(), pivots};
            for (Index r = 0; r < pivots; ++r)
                for (Index c = r; c < pivots; ++c) {
                    REQUIRE(update.at(r, c) < times.data() + times.size());
                    *update.at(r, c) += 1;
                }
            CHECK(*std::max_element(times.begin(), times.end()) == 1);
            CHECK(double(times.size()) <= pivots * ((pivots + 1) / 2.0 + 1.5 * slab));
        }
}

TEST_CASE_TEMPLATE("a child is added to its parent entry by entry, wherever its rows go", Its,
                   ALL_ARITHMETICS) {
    std::mt19937 random(11);
    for (Kernel const kernel : fixtures::usable_kernels())
        for (int round = 0; round < 60; ++round) {
            Index const pivots = 1 + Index(random() % 40), border = Index(random() % 70);
            double const kept = uniform(random);  // runs of neighbours, or scattered rows
            std::vector<Index> targets;
            for (Index t = 0; t < pivots + border; ++t)
                if (uniform(random) < kept) targets.push_back(t);
            auto const parent = some_matrix<Its>(std::size_t(pivots + border), 1);
            auto const child = some_matrix<Its>(targets.size(), 2);
            Front<Its> from(kernel, child, 0), to(kernel, parent, pivots);
            Front<Its> const before = to;
            dense::extend_add(kernel, from.update_matrix(), targets.data(), to.panel(),
                              to.update_matrix());
            double worst = 0;
            auto const compare = [&](auto const* found, auto const* old, Index i, Index j) {
                auto const row = std::find(targets.begin(), targets.end(), i),
                           column = std::find(targets.begin(), targets.end(), j);
                typename Its::Entry exact = Its::get(old, Front<Its>::slab);
                if (row != targets.end() && column != targets.end())
                    exact += Its::get(from.update_matrix().at(Index(row - targets.begin()),
                                                              Index(column - targets.begin())),
                                      Front<Its>::slab);
                worst = std::fmax(worst, std::abs(Its::get(found, Front<Its>::slab) - exact));
            };
            Front<Its> old = before;
            for (Index i = 0; i < pivots; ++i)
                for (Index j = i; j < pivots + border; ++j)
                    compare(to.panel().at(i, j), old.panel().at(i, j), i, j);
            for (Index i = 0; i < border; ++i)
                for (Index j = i; j < border; ++j)
                    compare(to.update_matrix().at(i, j), old.update_matrix().at(i, j), pivots + i,
                            pivots + j);
            INFO("kernel " << int(kernel) << ", " << pivots << " pivots, border " << border);
            CHECK(worst <= 1e3 * std::numeric_limits<typename Its::Number>::epsilon());
            CHECK(to.is_poisoned_behind());
            CHECK(from.is_poisoned_behind());
        }
}
