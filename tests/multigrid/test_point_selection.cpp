// The selection of coarse points: each fine point has strong coarse neighbours, and the second pass
// gives fine points that depend on each other a common one.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/guarded.hpp>

#include "multigrid/coarse_points.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::none;

namespace {

struct Selected {
    harmorph::FullRows rows;
    std::vector<Index> coarse;
    Index count = 0;

    Selected(harmorph::SymmetricRows const& half, Index most) {
        harmorph::PointSelection selection;
        block_ = laid_out([&](harmorph::Arena& arena) {
            rows.lay_out(arena, half.n, half.entries());
            selection.lay_out(arena, half.n);
        });
        rows.take(half);
        coarse.resize(std::size_t(half.n));
        count = selection.select(rows, most, span(coarse));
        CHECK(block_->guards_intact());
    }
    bool is_coarse(Index i) const { return coarse[std::size_t(i)] != none; }
    // The points on which a point depends.
    std::vector<Index> strong(Index i) const {
        std::vector<Index> out;
        rows.for_each(i, [&](Index j, double entry) {
            if (rows.depends(i, j, entry)) out.push_back(j);
        });
        return out;
    }
    bool share_a_coarse_point(Index i, Index j) const {
        std::vector<Index> const of_j = strong(j);
        for (Index const k : strong(i))
            if (is_coarse(k) && std::find(of_j.begin(), of_j.end(), k) != of_j.end()) return true;
        return false;
    }
    // The number of fine points that depend on a fine point without sharing a coarse point.
    int lonely() const {
        int out = 0;
        for (Index i = 0; i < rows.n; ++i)
            for (Index const j : strong(i))
                out += !is_coarse(i) && !is_coarse(j) && !share_a_coarse_point(i, j);
        return out;
    }

private:
    std::unique_ptr<Guarded> block_;
};

}  // namespace

TEST_CASE("the second pass gives fine points that depend on each other a common coarse point") {
    for (Cells const kind : {Cells::triangles, Cells::quads, Cells::hybrid}) {
        Case setup = two_body_case(kind, 16, 10);
        Analysed const seen(setup);
        FrontMatrix const front(*seen.operator->());
        Index const n = front.rows.n;
        Selected const first(front.rows, 0), both(front.rows, n);
        CHECK(2 * first.count <= n);
        CHECK(first.lonely() > 0);
        CHECK(both.lonely() == 0);
        CHECK(both.count > first.count);
        // The points of the first pass stay coarse points, and are numbered in their order.
        Index next = 0;
        for (Index i = 0; i < n; ++i) {
            if (first.is_coarse(i)) CHECK(both.is_coarse(i));
            if (both.is_coarse(i)) CHECK(both.coarse[std::size_t(i)] == next++);
        }
        CHECK(next == both.count);
        Index const most = (first.count + both.count) / 2;
        CHECK(Selected(front.rows, most).count == most);
    }
}
