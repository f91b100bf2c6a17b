// The front: each layer from the boundaries inwards before the next one, and quads before
// triangles.
#include <fixtures/agglomerated.hpp>
#include <fixtures/wrong.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

// Cells from each unknown to the nearest point that is not unknown, or to a free boundary.
std::vector<int> depth_of(harmorph::Analysis const& a) {
    std::vector<int> depth(std::size_t(a.graph().n), -1);
    int reached = 0;
    auto const set = [&](Index u, int to) {
        if (u == harmorph::none || depth[std::size_t(u)] >= 0) return;
        depth[std::size_t(u)] = to;
        ++reached;
    };
    harmorph::for_each_pair(a.topology(), [&](Index p, Index q) {
        if (!is_unknown(a.kinds()[p])) set(a.graph().unknown[q], 0);
        if (!is_unknown(a.kinds()[q])) set(a.graph().unknown[p], 0);
    });
    for (Index u = 0; u < a.graph().n; ++u)
        if (a.kinds()[a.graph().point(u)] == harmorph::PointKind::free) set(u, 0);
    for (int layer = 0; reached < a.graph().n; ++layer)
        for (Index u = 0; u < a.graph().n; ++u)
            if (depth[std::size_t(u)] == layer)
                for (Index const v : a.graph().neighbours(u)) set(v, layer + 1);
    return depth;
}

std::vector<char> quad_corners(harmorph::Analysis const& a) {
    std::vector<char> out(std::size_t(a.graph().n), 0);
    for (Index c = 0; c < a.problem().mesh.n_cells; ++c) {
        harmorph::Cell const cell = a.problem().mesh.cell(c);
        for (Index k = 0; cell.n == 4 && k < 4; ++k) {
            Index const u = a.graph().unknown[a.topology().representative[cell.point[k]]];
            if (u != harmorph::none) out[std::size_t(u)] = 1;
        }
    }
    return out;
}

}  // namespace

TEST_CASE("the front has every unknown once, layer after layer, from free boundaries too") {
    for (Cells const kind : {Cells::quads, Cells::triangles})
        for (bool const free : {false, true}) {
            Case setup = two_body_case(kind, 12, 8);
            if (free) setup.set_free(far_field);
            Analysed const seen(setup);
            FrontMatrix const front(*seen.operator->());
            std::vector<int> const depth = depth_of(*seen.operator->());
            std::vector<Index> sorted = front.order;
            std::sort(sorted.begin(), sorted.end());
            for (std::size_t k = 0; k < sorted.size(); ++k) REQUIRE(sorted[k] == Index(k));
            int last = 0;
            Wrong backwards;
            for (Index const u : front.order) {
                int const here = depth[std::size_t(u)];
                backwards.add(here < last, u, here);
                last = here;
            }
            CHECK(backwards == 0);
            CHECK(last >= 3);
        }
}

TEST_CASE("in hybrid meshes the front passes all quads at the wall before the triangles") {
    Case setup = airfoil_case(40, 12, Cells::hybrid);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    std::vector<char> const quads = quad_corners(*seen.operator->());
    std::size_t n_quads = 0;
    for (char const corner : quads) n_quads += corner != 0;
    REQUIRE(n_quads > 100);
    REQUIRE(n_quads + 100 < front.order.size());
    for (std::size_t k = 0; k < front.order.size(); ++k)
        REQUIRE((quads[std::size_t(front.order[k])] != 0) == (k < n_quads));
}
