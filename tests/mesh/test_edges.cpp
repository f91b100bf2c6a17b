// Every edge once, with the cells at its two sides.
#include <fixtures/core.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/guarded.hpp>

#include <set>

using namespace fixtures;
using harmorph::Index;

namespace {

struct Edges {
    std::vector<Index> representative;
    harmorph::Edges edges;
    harmorph::Status status;
    harmorph::Fault fault;

    // join: a pair of points that are one.
    explicit Edges(Mesh const& mesh, bool listed = true, std::pair<Index, Index> join = {0, 0})
        : representative(listed ? mesh.x.size() : 0) {
        for (std::size_t k = 0; k < representative.size(); ++k) representative[k] = Index(k);
        if (listed) representative[std::size_t(join.second)] = join.first;
        harmorph::Mesh const view = core_mesh(mesh);
        block_ = laid_out_part(edges, view);
        status = edges.build(view, span(representative), fault);
        CHECK(block_->guards_intact());
    }

private:
    std::unique_ptr<Guarded> block_;
};

}  // namespace

TEST_CASE("all edges of all cells are found once, with their cells and the sense of the cells") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh mesh = two_bodies(6, 4, Ellipse{}, Ellipse{0.2, 0.05, 0.3}, kind);
        renumber_points(mesh, 2);
        reverse_some(mesh, 3);
        std::map<Edge, std::set<std::pair<Index, bool>>>
            expected;  // cell, and whether it runs from the larger point
        harmorph::Mesh const view = core_mesh(mesh);
        for (Index c = 0; c < view.n_cells; ++c) {
            harmorph::Cell const cell = view.cell(c);
            for (Index k = 0; k < cell.n; ++k) {
                Index const a = cell.point[k], b = cell.next(k);
                expected[{std::min(a, b), std::max(a, b)}].insert({c, a > b});
            }
        }
        Edges const found(mesh);
        REQUIRE(found.status == harmorph::Status::ok);
        CHECK(std::size_t(found.edges.count()) == expected.size());
        Index last = -1;
        Wrong wrong;
        found.edges.for_each([&](Index edge, Index low, Index high) {
            CHECK(edge == ++last);
            CHECK(low < high);
            std::set<std::pair<Index, bool>> cells;
            for (Index const code : {found.edges.first[edge].code, found.edges.second[edge]})
                if (code >= 0)
                    cells.insert({harmorph::cell_of_side(code), harmorph::runs_backwards(code)});
            wrong.add(cells != expected[{low, high}], edge,
                      double(cells.size()));  // cells of it
            CHECK(found.edges.is_boundary(edge) == (cells.size() == 1));
            CHECK(found.edges.find(low, high) == edge);
            CHECK(found.edges.find(high, low) == edge);
        });
        CHECK(wrong == 0);
        Index n_boundary = 0;
        bool agree = true;
        for (auto const& edge : expected) {
            n_boundary += edge.second.size() == 1 ? 1 : 0;
            agree = agree && (edge.second.size() == 1 ||
                              edge.second.begin()->second != edge.second.rbegin()->second);
        }
        CHECK(found.edges.n_boundary == n_boundary);
        CHECK(found.edges.agree == agree);
        for (Index a = 0; a < 40; ++a)
            for (Index b = 0; b < 40; ++b)
                CHECK((found.edges.find(a, b) == harmorph::none) ==
                      (expected.count({std::min(a, b), std::max(a, b)}) == 0));
    }
}

TEST_CASE("cells that all run one way agree, and one that is turned does not") {
    Mesh mesh = square(5);
    CHECK(Edges(mesh).edges.agree);
    reverse_some(mesh, 3);
    CHECK(!Edges(mesh).edges.agree);
}

TEST_CASE("a cell with two corners that a cut joins is refused and named") {
    Mesh const mesh = square(5);
    std::int32_t const one = mesh.cells[0], other = mesh.cells[1];
    Edges const found(mesh, true, {std::min(one, other), std::max(one, other)});
    CHECK(found.status == harmorph::Status::bad_mesh);
    CHECK(found.fault.item.number == 0);
    CHECK(std::string(found.fault.sentence) ==
          "cell # has two corners that a cut joins into one point");
}

TEST_CASE("points that represent themselves need no list") {
    Mesh mesh = two_bodies(6, 4, Ellipse{}, Ellipse{0.2, 0.05, 0.3}, Cells::hybrid);
    renumber_points(mesh, 2);
    Edges const listed(mesh), alone(mesh, false);
    REQUIRE(alone.edges.count() == listed.edges.count());
    for (Index edge = 0; edge < alone.edges.count(); ++edge) {
        CHECK(alone.edges.first[edge].end == listed.edges.first[edge].end);
        CHECK(alone.edges.first[edge].code == listed.edges.first[edge].code);
        CHECK(alone.edges.second[edge] == listed.edges.second[edge]);
    }
}

TEST_CASE("a point of hundreds of edges is handled") {
    int const n = 500;
    Mesh mesh;
    mesh.add_point({0, 0});
    for (int k = 0; k < n; ++k)
        mesh.add_point({std::cos(2 * pi * k / n), std::sin(2 * pi * k / n)});
    for (int k = 0; k < n; ++k) mesh.add_cell({0, 1 + k, 1 + (k + 1) % n});
    shuffle_cells(mesh, 4);
    Edges const found(mesh);
    CHECK(found.edges.count() == 2 * n);
    CHECK(found.edges.start[1] == n);
    for (Index edge = 0; edge < n; ++edge) CHECK(found.edges.first[edge].end == edge + 1);
}

TEST_CASE("an edge of three cells is refused and named") {
    Mesh mesh = square(3);
    mesh.add_point({-1, -1});
    mesh.add_cell({5, 6, 16});
    Edges const found(mesh);
    CHECK(found.status == harmorph::Status::bad_mesh);
    CHECK(found.fault.item.number == 5);
    CHECK(found.fault.other.number == 6);
    Mesh twice = square(3);
    twice.add_cell({0, 1, 5, 4});  // a cell given twice
    twice.add_cell({0, 1, 5, 4});
    CHECK(Edges(twice).status == harmorph::Status::bad_mesh);
}
