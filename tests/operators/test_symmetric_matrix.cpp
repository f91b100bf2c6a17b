// Contraction is P^T A P: of matrices with known row sums, of faces, and of what does not touch.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>

#include <set>

using namespace fixtures;
using harmorph::Index;
using harmorph::Offset;

namespace {

// Symmetric rows with random entries; every third one is no mesh edge.
struct RandomRows {
    std::vector<double> diagonal, row_sum, value;
    std::vector<Offset> start;
    std::vector<Index> column;
    std::vector<std::uint8_t> faces;

    RandomRows(Index n, double density, unsigned seed) {
        std::mt19937 random(seed);
        for (Index i = 0; i < n; ++i) {
            start.push_back(static_cast<Offset>(column.size()));
            row_sum.push_back(uniform(random));
            for (Index j = i + 1; j < n; ++j)
                if (uniform(random) < density) {
                    column.push_back(j);
                    value.push_back(2 * uniform(random) - 1);
                    faces.push_back(column.size() % 3 == 0 ? 0 : 1);
                }
        }
        start.push_back(static_cast<Offset>(column.size()));
        diagonal = row_sum;
        view().for_each([&](Index i, Index j, Offset e) {
            diagonal[static_cast<std::size_t>(i)] -= value[static_cast<std::size_t>(e)];
            diagonal[static_cast<std::size_t>(j)] -= value[static_cast<std::size_t>(e)];
        });
    }
    harmorph::SymmetricRows view() {
        return {static_cast<Index>(diagonal.size()),
                span(diagonal),
                span(row_sum),
                span(start),
                span(column),
                span(value),
                span(faces)};
    }
};

}  // namespace

TEST_CASE("P^T A P is the dense product without repeated entries, and faces sum up to 255") {
    for (Index const n : {1, 2, 7, 40})
        for (double const density : {0.0, 0.2, 1.0}) {
            RandomRows made(n, density, 11 + static_cast<unsigned>(n));
            harmorph::SymmetricRows const fine = made.view();
            Index const n_coarse = (n + 2) / 3;
            std::vector<Index> cell(static_cast<std::size_t>(n));
            for (Index i = 0; i < n; ++i)
                cell[static_cast<std::size_t>(i)] = (7 * i) % n_coarse;  // not in order
            RandomRows room(n, 1.0, 1);
            std::vector<Offset> last(static_cast<std::size_t>(n));
            harmorph::SymmetricRows coarse = room.view();
            contract(fine, span(cell), n_coarse, span(last), coarse);
            REQUIRE(coarse.n == n_coarse);

            DenseMatrix const a = dense_of(fine);
            DenseMatrix expected(static_cast<std::size_t>(n_coarse)),
                touching(static_cast<std::size_t>(n_coarse));
            for (std::size_t i = 0; i < a.n; ++i)
                for (std::size_t j = 0; j < a.n; ++j)
                    expected.at(static_cast<std::size_t>(cell[i]),
                                static_cast<std::size_t>(cell[j])) += a.at(i, j);
            fine.for_each([&](Index i, Index j, Offset e) {
                std::size_t const p = static_cast<std::size_t>(cell[static_cast<std::size_t>(i)]);
                std::size_t const q = static_cast<std::size_t>(cell[static_cast<std::size_t>(j)]);
                touching.at(std::min(p, q), std::max(p, q)) += fine.faces[e];
            });
            DenseMatrix const found = dense_of(coarse);
            for (std::size_t i = 0; i < found.n; ++i) {
                double sum = 0;
                for (std::size_t j = 0; j < found.n; ++j) sum += expected.at(i, j);
                CHECK(std::fabs(coarse.row_sum[i] - sum) < 1e-12);
            }
            for (std::size_t k = 0; k < found.entries.size(); ++k)
                CHECK(std::fabs(found.entries[k] - expected.entries[k]) < 1e-13);
            std::set<std::pair<Index, Index>> seen;
            coarse.for_each([&](Index i, Index j, Offset e) {
                CHECK(i < j);
                CHECK(seen.insert({i, j}).second);
                CHECK(coarse.faces[e] == std::min(255.0, touching.at(static_cast<std::size_t>(i),
                                                                     static_cast<std::size_t>(j))));
            });
        }
    RandomRows many(600, 1.0, 3);
    std::vector<Index> cell(600);
    for (std::size_t i = 0; i < 600; ++i) cell[i] = i < 300 ? 0 : 1;
    RandomRows room(600, 1.0, 1);
    std::vector<Offset> last(600);
    harmorph::SymmetricRows coarse = room.view();
    contract(many.view(), span(cell), 2, span(last), coarse);
    REQUIRE(coarse.entries() == 1);
    CHECK(coarse.faces[0] == 255);
}

TEST_CASE("the rows of a matrix are its unknowns' part, and its faces are the mesh's edges") {
    Case setup = two_body_case(Cells::hybrid, 8, 5);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    harmorph::Edges const& edges = seen->topology().edges;
    int faces = 0, diagonals = 0;
    front.rows.for_each([&](Index i, Index j, Offset e) {
        Index const p = seen->graph().point(front.order[static_cast<std::size_t>(i)]);
        Index const q = seen->graph().point(front.order[static_cast<std::size_t>(j)]);
        bool const is_edge = edges.find(p, q) != harmorph::none;
        CHECK(front.rows.faces[e] == (is_edge ? 1 : 0));
        ++(is_edge ? faces : diagonals);
    });
    CHECK(faces > 50);
    CHECK(diagonals > 20);
}
