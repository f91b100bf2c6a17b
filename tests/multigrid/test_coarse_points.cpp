// The coarse points of algebraic multigrid: how many there are, the interpolation from them, and
// their matrix.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/guarded.hpp>

#include "multigrid/coarse_points.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Offset;

namespace {

struct Levels {
    harmorph::CoarsePoints points;

    explicit Levels(harmorph::SymmetricRows const& finest, Index most = 0) {
        auto const lay_out = [&](harmorph::Arena& arena) {
            points.lay_out(arena, finest.n, finest.entries());
            points.lay_out_work(arena, finest.n, finest.entries());
        };
        block_ = laid_out(lay_out);
        points.build(finest, most);
        CHECK(block_->guards_intact());
    }

private:
    std::unique_ptr<Guarded> block_;
};

Case thin_cells() {
    Case setup = airfoil_case(20, 12, Cells::quads);
    setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-6, 60, 60)).mesh;
    return setup;
}

template <class Rows>
DenseMatrix dense_rows(Rows const& rows) {
    DenseMatrix out(std::size_t(rows.n));
    for (Index i = 0; i < rows.n; ++i) {
        out.at(std::size_t(i), std::size_t(i)) = rows.diagonal[i];
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            std::size_t const j = std::size_t(rows.column[e]);
            out.at(std::size_t(i), j) += rows.value[e];
            out.at(j, std::size_t(i)) += rows.value[e];
        }
    }
    return out;
}

double weight_sum(harmorph::Prolongation const& by, Index row) {
    double sum = 0;
    for (Offset e = by.start[row]; e < by.start[row + 1]; ++e) sum += by.weight[e];
    return sum;
}

}  // namespace

TEST_CASE("half of the points or fewer are coarse points, and rows have at most four weights") {
    for (bool const is_thin : {false, true}) {
        Case setup = is_thin ? thin_cells() : two_body_case(Cells::hybrid, 16, 10);
        Analysed const seen(setup);
        FrontMatrix const front(*seen.operator->());
        Levels const levels(front.rows);
        harmorph::CoarsePoints const& all = levels.points;
        CHECK(all.n(all.count - 1) <= harmorph::CoarsePoints::coarsest);
        Offset entries = 0;
        for (Index l = 0; l + 1 < all.count; ++l) {
            if (l == 0) CHECK(all.n(1) <= harmorph::CoarsePoints::most_first(all.n(0)));
            else CHECK(2 * all.n(l + 1) <= all.n(l));
            entries += all.entries(l + 1);
            std::vector<int> owners(std::size_t(all.n(l + 1)));
            for (Index i = 0; i < all.n(l); ++i) {
                Offset const begin = all.finer[l].start[i], end = all.finer[l].start[i + 1];
                CHECK(end - begin <= harmorph::Prolongation::most_weights);
                if (end - begin == 1 && all.finer[l].weight[begin] == 1)
                    ++owners[std::size_t(all.finer[l].column[begin])];
            }
            for (int const count : owners) CHECK(count >= 1);
        }
        CHECK(entries <= Offset{harmorph::CoarsePoints::entries_per_point} * all.finest.n);
    }
}

TEST_CASE("a level that needs more entries than there are is interpolated with fewer weights") {
    // Each point is coupled to the next one and to four random ones: the neighbours of neighbours
    // of such a graph overlap far less than those of a mesh.
    constexpr std::size_t n = 4000, partners = 5;
    std::mt19937 random(5);
    std::vector<double> diagonal(n, 0.01), row_sum(n, 0.01), value;
    std::vector<Offset> start{0};
    std::vector<Index> column;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        for (std::size_t k = 0; k < partners; ++k) {
            std::size_t const j = k == 0 ? i + 1 : i + 1 + random() % (n - i - 1);
            Index const to = static_cast<Index>(j);
            auto const row = column.begin() + start.back();
            if (std::find(row, column.end(), to) != column.end()) continue;
            column.push_back(to);
            value.push_back(-1);
            diagonal[i] += 1;
            diagonal[j] += 1;
        }
        start.push_back(static_cast<Offset>(column.size()));
    }
    start.push_back(start.back());
    harmorph::SymmetricRows const rows{static_cast<Index>(n),
                                       {diagonal.data(), n},
                                       {row_sum.data(), n},
                                       {start.data(), n + 1},
                                       {column.data(), column.size()},
                                       {value.data(), value.size()},
                                       {}};
    Levels const levels(rows);  // checks that nothing is written behind the memory
    harmorph::CoarsePoints const& all = levels.points;
    REQUIRE(all.count >= 2);
    Offset entries = 0, widest = 0;
    for (Index l = 1; l < all.count; ++l) entries += all.entries(l);
    harmorph::Prolongation const& by = all.finer[0];
    for (Index i = 0; i < rows.n; ++i) widest = std::max(widest, by.start[i + 1] - by.start[i]);
    CHECK(widest < harmorph::Prolongation::most_weights);
    CHECK(entries <= Offset{harmorph::CoarsePoints::entries_per_point} * rows.n +
                         harmorph::CoarsePoints::coarsest * harmorph::CoarsePoints::coarsest);
}

TEST_CASE("constants are interpolated exactly on all levels if there are no known values") {
    Case setup = thin_cells();
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    Index const n = front.rows.n;
    for (bool const has_known_values : {true, false}) {
        std::vector<double> diagonal(front.rows.diagonal.data(), front.rows.diagonal.data() + n);
        std::vector<double> row_sum(front.rows.row_sum.data(), front.rows.row_sum.data() + n);
        for (std::size_t i = 0; i < row_sum.size() && !has_known_values; ++i) {
            diagonal[i] -= row_sum[i];
            row_sum[i] = 0;
        }
        harmorph::SymmetricRows rows = front.rows;
        rows.diagonal = span(diagonal);
        rows.row_sum = span(row_sum);
        Levels const levels(rows);
        REQUIRE(levels.points.count >= 3);
        int below = 0;
        for (Index l = 0; l + 1 < levels.points.count; ++l)
            for (Index i = 0; i < levels.points.n(l); ++i) {
                double const sum = weight_sum(levels.points.finer[l], i);
                if (!has_known_values) CHECK(sum == doctest::Approx(1).epsilon(1e-14));
                CHECK(sum <= 1 + 1e-14);
                CHECK(sum >= 0);
                below += sum < 0.99;
            }
        CHECK((below > 0) == has_known_values);
    }
}

TEST_CASE("the matrix of the coarse points is that of the interpolated functions") {
    Case setup = two_body_case(Cells::hybrid, 7, 4);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    Levels const levels(front.rows);
    harmorph::CoarsePoints const& all = levels.points;
    REQUIRE(all.count >= 3);
    for (Index l = 0; l + 1 < all.count; ++l) {
        DenseMatrix const fine = all.visit(l, [](auto const& rows) { return dense_rows(rows); });
        DenseMatrix const coarse = dense_rows(all.coarse[l + 1]);
        harmorph::Prolongation const& by = all.finer[l];
        DenseMatrix expected(coarse.n);
        for (std::size_t i = 0; i < fine.n; ++i)
            for (std::size_t j = 0; j < fine.n; ++j)
                for (Offset a = by.start[i]; a < by.start[i + 1]; ++a)
                    for (Offset b = by.start[j]; b < by.start[j + 1]; ++b)
                        expected.at(std::size_t(by.column[a]), std::size_t(by.column[b])) +=
                            by.weight[a] * fine.at(i, j) * by.weight[b];
        for (std::size_t i = 0; i < coarse.n; ++i)
            for (std::size_t j = 0; j < coarse.n; ++j)
                CHECK(std::fabs(coarse.at(i, j) - expected.at(i, j)) <
                      1e-12 * std::fabs(coarse.at(i, i)));
    }
}
