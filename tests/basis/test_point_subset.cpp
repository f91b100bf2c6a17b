// Rows of some points do what the whole basis does at these points.
#include "private.h"

#include <fixtures/solved.hpp>
#include <fixtures/parts.hpp>

#include "basis/basis.hpp"

using namespace fixtures;

namespace {

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE("a subset with ghosts and repeats has the values of the whole basis") {
    for (KindOfProblem& problem : kinds_of_problems())
        for (std::int32_t const base : {0, 1}) {
            problem.setup.index_base = base;
            Solved const solved(problem.setup, &problem.options);
            hm_basis_info const whole = solved.info();
            std::vector<std::int32_t> points =
                random_parts(whole.points, 3, 8)[1];  // counted from 0
            points.push_back(whole.curve_point[3]);
            points.push_back(points.front());  // repeats
            points.push_back(whole.curve_point[3]);
            std::vector<std::int32_t> numbered = points;
            for (std::int32_t& point : numbered) point += base;
            Rows const rows(solved.basis, numbered, 8);
            REQUIRE(rows.status == HM_OK);
            hm_basis_info const info = info_of(rows.basis);
            CHECK(info.solved == 1);
            CHECK(info.cells == 0);
            CHECK(info.points == std::int32_t(points.size()));
            CHECK(info.functions == whole.functions);
            CHECK(info.numbers_per_value == whole.numbers_per_value);
            CHECK(info.curves == whole.curves);
            CHECK(info.index_base == base);

            for (std::int32_t i = 0; i < info.functions; ++i)
                for (std::int32_t p = 0; p < info.numbers_per_value; ++p)
                    CHECK(same_bits(values_of(rows.basis, i, p),
                                    pick(values_of(solved.basis, i, p), points)));
            Numbers const move = some_move(info.functions, 0.05, 3);
            Moved const from{problem.setup.mesh.x, problem.setup.mesh.y},
                to = morphed(solved.basis, from, move);
            Moved const here{pick(from.x, points), pick(from.y, points)},
                there = morphed(rows.basis, here, move);
            CHECK(same_bits(there.x, pick(to.x, points)));
            CHECK(same_bits(there.y, pick(to.y, points)));

            // The points of the wall, each once, in the order in which the whole has them.
            std::int32_t slot = 0;
            for (std::int32_t k = 0; k < whole.curve_points; ++k) {
                auto const first = std::find(points.begin(), points.end(), whole.curve_point[k]);
                if (first == points.end()) continue;
                REQUIRE(slot < info.curve_points);
                CHECK(info.curve_point[slot] == first - points.begin());
                CHECK(info.point_curve[slot] == whole.point_curve[k]);
                CHECK(info.point_u[slot] == whole.point_u[k]);
                ++slot;
            }
            CHECK(slot == info.curve_points);
            CHECK(slot > 10);
            std::int32_t worst = -1;
            Moved wrong = there;
            wrong.x[std::size_t(info.curve_point[5])] += 0.01;
            CHECK(boundary_error(rows.basis, move, here, there) < 1e-14);
            CHECK(boundary_error(rows.basis, move, here, wrong, &worst) ==
                  doctest::Approx(0.01).epsilon(1e-9));
            CHECK(worst == info.curve_point[5] + base);
        }
}

TEST_CASE("the row of one point accepts x and y side by side, with any stride") {
    Case setup = tiny_case();
    Solved const solved(setup);
    std::vector<std::int32_t> one = {solved.info().curve_point[1]};
    Rows const row(solved.basis, one);
    REQUIRE(row.status == HM_OK);
    Numbers const move = some_move(solved.info().functions, 0.05, 3);
    double at[2] = {setup.mesh.x[std::size_t(one[0])], setup.mesh.y[std::size_t(one[0])]};
    Moved const to = morphed(row.basis, Moved{{at[0]}, {at[1]}}, move);
    Numbers gradient(move.size()), expected(move.size());
    double const dj[2] = {0.3, -0.7};
    REQUIRE(hm_adjoint(row.basis, points_in(dj, dj + 1, 2), expected.data(), nullptr, nullptr) ==
            HM_OK);
    REQUIRE(hm_adjoint(row.basis, points_in(dj, dj + 1, 1), gradient.data(), nullptr, nullptr) ==
            HM_OK);
    CHECK(same_bits(gradient, expected));
    REQUIRE(hm_morph(row.basis, move.data(), points_in(at, at + 1, 1), points_out(at, at + 1, 1),
                     nullptr, nullptr) == HM_OK);
    CHECK(at[0] == to.x[0]);
    CHECK(at[1] == to.y[0]);
}

TEST_CASE("rows can be moved, saved and attached like any basis, and extracted again") {
    Case setup = two_body_case();
    Solved const solved(setup);
    std::vector<std::int32_t> const points = random_parts(setup.mesh.n_points(), 2, 1)[0];
    Rows const rows(solved.basis, points);
    std::vector<unsigned char> const bytes = bytes_of(rows.basis);
    std::vector<double> copy(bytes.size() / sizeof(double));
    std::memcpy(copy.data(), bytes.data(), bytes.size());
    const hm_basis* attached = nullptr;
    REQUIRE(hm_basis_attach(&attached, copy.data(), bytes.size(), nullptr, nullptr) == HM_OK);
    CHECK(info_of(attached).points == std::int32_t(points.size()));

    std::vector<std::int32_t> every_other, direct;
    for (std::size_t k = 0; k < points.size(); k += 2) {
        every_other.push_back(std::int32_t(k));
        direct.push_back(points[k]);
    }
    // Only the fingerprint of the list tells them apart.
    std::vector<unsigned char> of_rows = bytes_of(Rows(attached, every_other).basis),
                               of_mesh = bytes_of(Rows(solved.basis, direct).basis);
    harmorph::BasisHeader first, second;
    std::memcpy(static_cast<void*>(&first), of_rows.data(), sizeof first);
    std::memcpy(static_cast<void*>(&second), of_mesh.data(), sizeof second);
    CHECK(first.list != second.list);
    first.list = second.list;
    first.checksum = second.checksum;
    std::memcpy(of_rows.data(), static_cast<const void*>(&first), sizeof first);
    CHECK(of_rows == of_mesh);
}

TEST_CASE("lists of points that are not in the mesh are refused with the place in the list") {
    Case setup = two_body_case();
    setup.index_base = 1;
    Solved const solved(setup);
    Rows const below(solved.basis, {1, 2, 0}), above(solved.basis, {setup.mesh.n_points() + 1});
    CHECK(below.status == HM_BAD_ARGUMENT);
    CHECK(below.error.item - below.error.item_base == 2);
    CHECK(above.status == HM_BAD_ARGUMENT);
    CHECK(above.error.item - above.error.item_base == 0);
    std::size_t bytes = 0;
    CHECK(hm_private_extract_size(solved.basis, -1, &bytes, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("the size suffices for any list, whatever share of the list is wall points or repeats") {
    Case setup = two_body_case();
    Solved const solved(setup);
    hm_basis_info const info = solved.info();
    for (std::size_t const n : {1u, 7u, 33u, 100u, 130u})
        for (std::size_t repeats = 0; repeats < n; ++repeats) {
            std::vector<std::int32_t> points(repeats + 1, info.curve_point[0]);
            for (std::size_t k = 1; points.size() < n; ++k)
                points.push_back(info.curve_point[k % 96]);
            CHECK(Rows(solved.basis, points, 40).status == HM_OK);
        }
}

TEST_CASE("blocks that are too small are refused, and the stated size suffices for any list") {
    Case setup = two_body_case();
    Solved const solved(setup);
    hm_basis_info const info = solved.info();
    std::vector<std::int32_t> const wall(info.curve_point, info.curve_point + info.curve_points);
    CHECK(info_of(Rows(solved.basis, wall, 24).basis).curve_points == info.curve_points);

    std::int32_t const n = std::int32_t(wall.size());
    std::size_t need = 0;
    REQUIRE(hm_private_extract_size(solved.basis, n, &need, nullptr) == HM_OK);
    std::size_t const slack = 64 + 256;  // for alignment, and for lists that repeat points
    for (std::size_t give = 0; give + slack < need; give += 1024) {
        Guarded block(give);
        hm_basis* made = nullptr;
        CHECK(hm_private_extract_init(&made, block.data(), give, solved.basis, n, wall.data(),
                                      nullptr) == HM_BLOCK_TOO_SMALL);
        CHECK(made == nullptr);
        CHECK(block.guards_intact());
    }
}
