// Merged cells: a partition into connected cells of bounded size, sums that stay symmetric and
// conservative, shapes that follow the strong couplings; and an end where a graph cannot be merged.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/graphs.hpp>

using namespace fixtures;
using harmorph::Index;
using harmorph::Merging;
using harmorph::Offset;

namespace {

constexpr Merging all_rules[] = {Merging::automatic, Merging::isotropic, Merging::directional};

void check_partition(Agglomerated const& agglomerated) {
    harmorph::Agglomeration const& a = agglomerated.levels;
    for (Index l = 0; l + 1 < a.count; ++l) {
        Index seen = 0;
        std::vector<int> members(static_cast<std::size_t>(a.level[l + 1].n), 0);
        for (Index i = 0; i < a.level[l].n; ++i) {
            Index const cell = a.cell_of[l][i];
            REQUIRE(cell >= 0);  // numbered by the first member: the order stays the front's
            REQUIRE(cell <= seen);
            seen = std::max(seen, cell + 1);
            ++members[static_cast<std::size_t>(cell)];
        }
        CHECK(seen == a.level[l + 1].n);
        CHECK(*std::max_element(members.begin(), members.end()) <= 16);
        CHECK(3 * a.level[l + 1].n <= a.level[l].n);
        CHECK(a.level[l + 1].entries() <= Offset{4} * a.level[l + 1].n);
    }
}

// Cells of a level that fall apart when only mesh edges inside them hold them together.
int disconnected(harmorph::SymmetricRows const& rows, std::vector<Index> const& cell) {
    std::vector<Index> head(cell.size());
    std::iota(head.begin(), head.end(), 0);
    auto const find = [&](Index i) {
        while (head[static_cast<std::size_t>(i)] != i) i = head[static_cast<std::size_t>(i)];
        return i;
    };
    rows.for_each([&](Index i, Index j, Offset e) {
        if (rows.faces[e] == 0 ||
            cell[static_cast<std::size_t>(i)] != cell[static_cast<std::size_t>(j)])
            return;
        head[static_cast<std::size_t>(find(i))] = find(j);
    });
    Index parts = 0;
    for (std::size_t i = 0; i < head.size(); ++i) parts += head[i] == static_cast<Index>(i);
    return parts - (1 + *std::max_element(cell.begin(), cell.end()));
}

// Mean over the cells of a level of the extents along x and y, in fine cells.
Point mean_extent(FrontMatrix const& front, Mesh const& mesh, std::vector<Index> const& cell,
                  double dx, double dy) {
    std::size_t const n = static_cast<std::size_t>(1 + *std::max_element(cell.begin(), cell.end()));
    std::vector<Point> low(n, {1e9, 1e9}), high(n, {-1e9, -1e9});
    for (std::size_t i = 0; i < cell.size(); ++i) {
        Point const p = front.point(mesh, static_cast<Index>(i));
        Point& l = low[static_cast<std::size_t>(cell[i])];
        Point& h = high[static_cast<std::size_t>(cell[i])];
        l = {std::min(l.x, p.x), std::min(l.y, p.y)};
        h = {std::max(h.x, p.x), std::max(h.y, p.y)};
    }
    Point mean{0, 0};
    for (std::size_t c = 0; c < n; ++c) {
        mean.x += (1 + (high[c].x - low[c].x) / dx) / static_cast<double>(n);
        mean.y += (1 + (high[c].y - low[c].y) / dy) / static_cast<double>(n);
    }
    return mean;
}

// Returns how much more work the smoother has, at most over all ways to split a merged cell in two,
// than with two equal cells.
double worst_split(harmorph::SymmetricRows const& rows, harmorph::Span<const Index> cell_of,
                   Index n) {
    std::vector<std::vector<Index>> members(static_cast<std::size_t>(n));
    std::vector<std::size_t> place(static_cast<std::size_t>(rows.n));
    for (Index i = 0; i < rows.n; ++i) {
        std::vector<Index>& list = members[static_cast<std::size_t>(cell_of[i])];
        place[static_cast<std::size_t>(i)] = list.size();
        list.push_back(i);
    }
    double worst = 0;
    auto const in_series = [](double a, double b) { return a > 0 && b > 0 ? a * b / (a + b) : 0; };
    for (std::vector<Index> const& list : members)
        for (unsigned split = 1; split < (1u << (list.size() - 1));
             ++split) {  // the last member is always on one side
            auto const side = [&](Index i) {
                return (split >> place[static_cast<std::size_t>(i)]) & 1u;
            };
            double diagonal[2] = {0, 0}, row_sum[2] = {0, 0}, cut = 0;
            for (Index const i : list) {
                diagonal[side(i)] += rows.diagonal[i];
                row_sum[side(i)] += rows.row_sum[i];
                for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
                    Index const j = rows.column[e];
                    if (cell_of[j] == cell_of[i] && side(j) != side(i)) cut -= rows.value[e];
                }
            }
            worst = std::max(worst, 2 * in_series(diagonal[0], diagonal[1]) /
                                        (cut + in_series(row_sum[0], row_sum[1])));
        }
    return worst;
}

Case viscous_case(Cells kind) {
    Case setup = airfoil_case(40, 12, Cells::quads);
    setup.mesh = o_mesh(naca4({}, 40), stretched(1e-5, 8, 50), kind);
    return setup;
}

}  // namespace

TEST_CASE("cells are merged to connected cells of bounded size, down to a few, on every mesh") {
    for (Merging const merging : all_rules)
        for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
            for (int mesh = 0; mesh < 3; ++mesh) {
                Case setup = mesh == 0   ? two_body_case(kind, 24, 16)
                             : mesh == 1 ? airfoil_case(40, 12, kind)
                                         : viscous_case(kind);
                if (mesh == 0) setup.set_free(far_field);
                Analysed const seen(setup);
                FrontMatrix const front(*seen.operator->());
                Agglomerated const merged(front.rows, {merging, 0});
                INFO("rule " << static_cast<int>(merging) << ", cells " << static_cast<int>(kind)
                             << ", mesh " << mesh);
                check_partition(merged);
                REQUIRE(merged.levels.count >= 3);
                for (Index level = 1; level < merged.levels.count; ++level)
                    CHECK(disconnected(front.rows, merged.cells_at(level)) == 0);
                CHECK(merged.levels.level[merged.levels.count - 1].n <= 150);
            }
}

TEST_CASE("coarse rows are the sums of the fine rows, symmetric and positive definite") {
    Case setup = two_body_case(Cells::hybrid, 14, 9);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    Agglomerated const merged(front.rows);
    REQUIRE(merged.levels.count >= 2);
    DenseMatrix const fine = dense_of(front.rows);
    for (Index level = 1; level < merged.levels.count; ++level) {
        std::vector<Index> const cell = merged.cells_at(level);
        harmorph::SymmetricRows const& rows = merged.levels.level[level];
        DenseMatrix expected(static_cast<std::size_t>(rows.n));
        for (std::size_t i = 0; i < fine.n; ++i)
            for (std::size_t j = 0; j < fine.n; ++j)
                expected.at(static_cast<std::size_t>(cell[i]), static_cast<std::size_t>(cell[j])) +=
                    fine.at(i, j);
        DenseMatrix found = dense_of(rows);
        double worst = 0;
        for (std::size_t k = 0; k < found.entries.size(); ++k)
            worst = std::max(worst, std::fabs(found.entries[k] - expected.entries[k]));
        CHECK(worst < 1e-12);
        CHECK(found.factor());
    }
    // Inside, where every neighbour is unknown, conductances cancel.
    std::vector<Index> const cell = merged.cells_at(1);
    std::vector<double> sum(static_cast<std::size_t>(merged.levels.level[1].n), 0.0);
    std::vector<char> inside(sum.size(), 1);
    DenseMatrix const found = dense_of(merged.levels.level[1]);
    for (std::size_t i = 0; i < found.n; ++i)
        for (std::size_t j = 0; j < found.n; ++j) sum[i] += found.at(i, j);
    for (std::size_t i = 0; i < fine.n; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < fine.n; ++j) row += fine.at(i, j);
        if (std::fabs(row) > 1e-10) inside[static_cast<std::size_t>(cell[i])] = 0;
    }
    int n_inside = 0;
    for (std::size_t c = 0; c < sum.size(); ++c) {
        n_inside += inside[c];
        if (inside[c] != 0) CHECK(std::fabs(sum[c]) < 1e-12);
        else CHECK(sum[c] > 1e-3);
    }
    CHECK(n_inside > 10);
}

TEST_CASE("both rules for stretched cells merge along the strong coupling alone") {
    for (Cells const kind : {Cells::quads, Cells::triangles})
        for (Merging const merging : all_rules) {
            Case setup = square_on_curve(36, kind, 0, 1);
            for (double& y : setup.mesh.y) y *= 1e-2;
            for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
                setup.curves.control[k] *= 1e-2;
            Analysed const seen(setup);
            FrontMatrix const front(*seen.operator->());
            Agglomerated const merged(front.rows, {merging, 0});
            REQUIRE(merged.levels.count >= 2);
            Point const extent =
                mean_extent(front, setup.mesh, merged.cells_at(1), 1.0 / 36, 1e-2 / 36);
            INFO("cells " << static_cast<int>(kind) << ", rule " << static_cast<int>(merging)
                          << ": " << extent.x << " x " << extent.y);
            if (merging == Merging::isotropic) {
                CHECK(extent.x > 1.5);
            } else {
                CHECK(extent.x == doctest::Approx(1));
                CHECK(extent.y > 3.5);
            }
        }
}

TEST_CASE("differences inside merged cells are bounded in units of the diagonals") {
    for (double const first : {1e-3, 1e-5, 1e-7}) {
        Case setup = airfoil_case(40, 12, Cells::quads);
        setup.mesh = c_mesh(naca4({}, 20), 12, 40, stretched(first, 60, 48)).mesh;
        Analysed const seen(setup);
        FrontMatrix const front(*seen.operator->());
        for (Merging const merging : {Merging::automatic, Merging::directional}) {
            Agglomerated const merged(front.rows, {merging, 0});
            CHECK(merged.levels.level[merged.levels.count - 1].n <= 150);
            for (Index l = 0; l + 1 < merged.levels.count; ++l) {
                // sum of d_i (v_i - mean)^2 <= bound (sum of c_ij (v_i - v_j)^2 + sum of e_i v_i^2)
                // inside each merged cell: for v = 1 in one of its cells and 0 in the others.
                harmorph::SymmetricRows const& rows = merged.levels.level[l];
                harmorph::Span<const Index> const cell = merged.levels.cell_of[l];
                std::size_t const n = static_cast<std::size_t>(rows.n);
                std::vector<double> whole(n, 0.0), energy(n, 0.0);
                for (Index i = 0; i < rows.n; ++i) {
                    whole[static_cast<std::size_t>(cell[i])] += rows.diagonal[i];
                    energy[static_cast<std::size_t>(i)] += rows.row_sum[i];
                }
                rows.for_each([&](Index i, Index j, Offset e) {
                    if (cell[i] != cell[j]) return;
                    energy[static_cast<std::size_t>(i)] -= rows.value[e];
                    energy[static_cast<std::size_t>(j)] -= rows.value[e];
                });
                double worst = 0;
                for (Index i = 0; i < rows.n; ++i) {
                    double const all = whole[static_cast<std::size_t>(cell[i])],
                                 own = rows.diagonal[i];
                    double const spread = own * (1 - own / all);
                    if (spread > 1e-9 * own)
                        worst = std::max(worst, spread / energy[static_cast<std::size_t>(i)]);
                }
                INFO("first cell " << first << ", level " << l);
                CHECK(worst < 12);
            }
        }
    }
}

TEST_CASE("on cells as long as high merged cells are about as long as high, and four to one") {
    for (Cells const kind : {Cells::quads, Cells::triangles})
        for (Merging const merging : all_rules) {
            Case setup = square_on_curve(48, kind, 0.2, 3);
            Analysed const seen(setup);
            FrontMatrix const front(*seen.operator->());
            Agglomerated const merged(front.rows, {merging, 0});
            harmorph::Agglomeration const& a = merged.levels;
            for (Index l = 0; l + 1 < a.count; ++l) {
                double const ratio = 1.0 * a.level[l].n / a.level[l + 1].n;
                INFO("cells " << static_cast<int>(kind) << ", rule " << static_cast<int>(merging)
                              << ", level " << l);
                CHECK(ratio > 3.5);
                CHECK(ratio < 6);
            }
            Point const extent =
                mean_extent(front, setup.mesh, merged.cells_at(1), 1.0 / 48, 1.0 / 48);
            CHECK(extent.x < 4);
            CHECK(extent.y < 4);
            CHECK(extent.x > 1.4);
            CHECK(extent.y > 1.4);
        }
}

TEST_CASE("the unit of length, the sense of cells and where they begin make no difference") {
    auto const merge = [](Case& setup) {
        Analysed const seen(setup);
        FrontMatrix const front(*seen.operator->());
        return Agglomerated(front.rows).cells_at(2);
    };
    for (Cells const kind : {Cells::quads, Cells::hybrid}) {
        Case setup = two_body_case(kind, 20, 14);
        std::vector<Index> const cells = merge(setup);
        Case changed = two_body_case(kind, 20, 14);
        for (std::vector<double>* numbers :
             {&changed.mesh.x, &changed.mesh.y, &changed.curves.control})
            for (double& number : *numbers) number *= 1024;
        CHECK(merge(changed) == cells);
        changed = two_body_case(kind, 20, 14);
        reverse_some(changed.mesh, 4);
        CHECK(merge(changed) == cells);
        changed = two_body_case(kind, 20, 14);
        reverse_all(changed.mesh);
        CHECK(merge(changed) == cells);
    }
}

TEST_CASE("the number of levels is a choice") {
    Case setup = two_body_case(Cells::hybrid, 24, 16);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    Index const all = Agglomerated(front.rows).levels.count;
    REQUIRE(all >= 3);
    for (Index levels = 1; levels <= all + 2; ++levels)
        CHECK(Agglomerated(front.rows, {Merging::automatic, levels}).levels.count ==
              std::min(levels, all));
}

TEST_CASE("graphs that cannot be merged end the levels, and nothing is written beside them") {
    for (HandMadeGraph& graph : nasty_graphs()) {
        harmorph::Graph const& view = graph.view();
        std::vector<double> diagonal, row_sum(static_cast<std::size_t>(view.n), 1.0), value;
        std::vector<Offset> start;
        std::vector<Index> column;
        for (Index u = 0; u < view.n; ++u) {
            start.push_back(static_cast<Offset>(column.size()));
            diagonal.push_back(static_cast<double>(view.neighbours(u).size()) + 1);
            for (Index const v : view.neighbours(u))
                if (v > u) column.push_back(v);
        }
        start.push_back(static_cast<Offset>(column.size()));
        value.assign(column.size(), -1.0);
        std::vector<std::uint8_t> faces(column.size(), 1);
        harmorph::SymmetricRows const rows{view.n,       span(diagonal), span(row_sum), span(start),
                                           span(column), span(value),    span(faces)};
        for (Merging const merging : all_rules) {
            Agglomerated const merged(rows, {merging, 0});
            check_partition(merged);
            for (Index level = 1; level < merged.levels.count; ++level)
                CHECK(disconnected(rows, merged.cells_at(level)) == 0);
        }
    }
}

TEST_CASE("no merged cell has two parts that smoothing cannot bring to one value") {
    for (int const n_wake : {18, 40}) {
        Case setup = airfoil_case(20, 12, Cells::quads);
        setup.mesh = c_mesh(naca4({}, 30), n_wake, 40, stretched(1e-8, 60, 80)).mesh;
        Analysed const seen(setup);
        FrontMatrix const front(*seen.operator->());
        Agglomerated const merged(front.rows);
        harmorph::Agglomeration const& a = merged.levels;
        for (Index l = 0; l + 1 < a.count; ++l) {
            INFO("wake " << n_wake << ", level " << l);
            CHECK(worst_split(a.level[l], a.cell_of[l], a.level[l + 1].n) <
                  64);  // 8 for each of the two passes
        }
    }
}

namespace {

// Rows made by hand.
struct HandMadeRows {
    struct Coupling {
        Index a, b;
        double strength;
    };
    std::vector<double> diagonal, row_sum, value;
    std::vector<Offset> start{0};
    std::vector<Index> column;
    std::vector<std::uint8_t> faces;
    harmorph::SymmetricRows rows;

    HandMadeRows(std::vector<double> const& given_diagonal, std::vector<Coupling> couplings)
        : diagonal(given_diagonal) {
        row_sum.assign(diagonal.size(), 0.0);
        for (Coupling& one : couplings)
            if (one.b < one.a) std::swap(one.a, one.b);
        for (std::size_t row = 0; row < diagonal.size(); ++row) {
            for (Coupling const& one : couplings) {
                if (one.a != static_cast<Index>(row)) continue;
                column.push_back(one.b);
                value.push_back(-one.strength);
                faces.push_back(1);
            }
            start.push_back(static_cast<Offset>(column.size()));
        }
        rows = {static_cast<Index>(diagonal.size()),
                span(diagonal),
                span(row_sum),
                span(start),
                span(column),
                span(value),
                span(faces)};
    }
};

}  // namespace

TEST_CASE("a cell without a free neighbour joins the cell with the strongest coupling") {
    // Pairs a1 a2 and b1 b2, and a cell L that touches both pairs, more strongly the first one. L
    // joins a pair only if the smoother removes what differs: with the diagonals below for the
    // strong coupling (2.3) and not for the weak one (2). A third pair joins a1 a2 in the second
    // pass; with these four L would not go together. Numbers of a1, a2, b1, b2, L; and which cells
    // of the pairs L touches.
    struct Arrangement {
        const char* what;
        Index a[2], b[2], lone, touched_a, touched_b;
    };
    Arrangement const all[] = {
        {"both come before", {0, 1}, {2, 3}, 4, 1, 3},
        {"both come before, the weak one first", {2, 3}, {0, 1}, 4, 3, 1},
        {"both come behind, taken before", {0, 3}, {1, 4}, 2, 3, 4},
        {"both come behind, the weak one first", {1, 4}, {0, 3}, 2, 4, 3},
        {"the strong one before, the weak one behind", {0, 1}, {2, 4}, 3, 1, 4},
        {"the weak one before, the strong one behind", {2, 4}, {0, 1}, 3, 4, 1},
    };
    Index const module = 15, modules = 8,
                third[] = {13, 14};  // and two groups of four that go together easily
    for (Arrangement const& arrangement : all) {
        std::vector<double> diagonal(static_cast<std::size_t>(module * modules), 1.0);
        std::vector<HandMadeRows::Coupling> couplings;
        for (Index m = 0; m < modules; ++m) {
            Index const base = module * m;
            for (Index const cell : {arrangement.a[0], arrangement.a[1], arrangement.b[0],
                                     arrangement.b[1], third[0], third[1]})
                diagonal[static_cast<std::size_t>(base + cell)] = 40;
            diagonal[static_cast<std::size_t>(base + arrangement.lone)] = 10;
            couplings.push_back({base + arrangement.a[0], base + arrangement.a[1], 20});
            couplings.push_back({base + arrangement.b[0], base + arrangement.b[1], 20});
            couplings.push_back({base + third[0], base + third[1], 20});
            couplings.push_back({base + arrangement.a[1], base + third[0], 11});
            couplings.push_back({base + arrangement.lone, base + arrangement.touched_a, 2.3});
            couplings.push_back({base + arrangement.lone, base + arrangement.touched_b, 2});
            for (Index group = 5; group < third[0]; group += 4)
                for (Index k = 0; k < 3; ++k)
                    couplings.push_back({base + group + k, base + group + k + 1, 1});
        }
        HandMadeRows const made(diagonal, couplings);
        harmorph::MergingRules rules;
        rules.merging = Merging::directional;
        Agglomerated const merged(made.rows, rules);
        INFO(std::string(arrangement.what));
        REQUIRE(merged.levels.count > 1);
        for (Index m = 0; m < modules; ++m) {
            auto const cell = [&](Index k) { return merged.levels.cell_of[0][module * m + k]; };
            CHECK(cell(arrangement.a[0]) == cell(arrangement.a[1]));
            CHECK(cell(arrangement.a[0]) == cell(third[0]));
            CHECK(cell(arrangement.b[0]) == cell(arrangement.b[1]));
            CHECK(cell(arrangement.lone) == cell(arrangement.a[0]));
            CHECK(cell(arrangement.lone) != cell(arrangement.b[0]));
        }
    }
}
