// Transfers that are refused: other domains, curves, operators and meshes, and blocks that are too
// small.
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/displaced.hpp>

using namespace fixtures;

TEST_CASE("transfers between other domains, curves, operators or meshes are refused") {
    Case coarse = ring_case(4, 32, 0.5, 2), fine = ring_case(9, 70, 0.5, 2);
    Solved const solved(coarse);
    auto const refused = [&](Case& setup, hm_mesh const& coarse_mesh,
                             Options const* options = nullptr) {
        TransferAttempt attempt;
        REQUIRE(attempt.open(setup.problem(), options));
        REQUIRE(!attempt.fill_from(solved.basis, coarse_mesh));
        CHECK(attempt.guards_intact());
        CHECK(attempt.block->guards_intact());
        std::vector<double> values(setup.mesh.x.size());
        CHECK(hm_basis_values(attempt.basis, 0, 0, values.data(), nullptr) ==
              HM_BAD_BASIS);  // not solved
        INFO(attempt.error.text);
        return attempt.error;
    };
    SUBCASE("a larger domain: the point and its distance") {
        Case large_ring = ring_case(9, 70, 0.5, 3);
        large_ring.index_base = 1;
        hm_error const error = refused(large_ring, coarse.mesh_view());
        CHECK(error.code == HM_BAD_MESH);
        Point const p = large_ring.mesh.point(error.item - 1);
        CHECK(error.value > 0.1);
        CHECK(error.value == doctest::Approx(std::sqrt(p.x * p.x + p.y * p.y) - 2).epsilon(0.02));
    }
    SUBCASE("a wall that is somewhere else") {
        Case shifted = fine;
        for (double& x : shifted.mesh.x) x += 0.5;
        CHECK(refused(shifted, coarse.mesh_view()).code == HM_BAD_MESH);
    }
    SUBCASE("other curves") {
        Case other = fine;
        other.curves = ring(3, 8, 0.5, 0.500001);
        hm_error const error = refused(other, coarse.mesh_view());
        CHECK(error.code == HM_BAD_BASIS);
        CHECK(std::string(error.text) == "the two bases were made with different curves");
        other.curves = ring(2, 8, 0.5, 0.5);
        CHECK(refused(other, coarse.mesh_view()).code == HM_BAD_BASIS);
        other = ring_case(9, 70, 0.5, 2, Cells::quads, 3, 9);
        CHECK(refused(other, coarse.mesh_view()).code == HM_BAD_BASIS);
    }
    SUBCASE("another operator") {
        Options options = laplace();
        options.operator_kind = HM_WEIGHTED;
        CHECK(refused(fine, coarse.mesh_view(), &options).code == HM_BAD_BASIS);
    }
    SUBCASE("a coarse mesh that is not the one of the coarse basis, or has moved") {
        CHECK(refused(fine, fine.mesh_view()).code == HM_BAD_BASIS);
        Case moved_coarse = coarse;
        moved_coarse.mesh.x[40] += 1e-9;
        hm_error const error = refused(fine, moved_coarse.mesh_view());
        CHECK(error.code == HM_BAD_BASIS);
        CHECK(std::string(error.text) ==
              "the coordinates of the coarse mesh are not those on which "
              "the coarse basis was solved");
    }
}

TEST_CASE("blocks that are too small for a transfer are refused, at any alignment") {
    Case coarse = ring_case(3, 16, 0.5, 2), fine = ring_case(5, 30, 0.5, 2);
    Solved const solved(coarse);
    TransferAttempt attempt;
    REQUIRE(attempt.open(fine.problem()));
    hm_mesh const mesh = coarse.mesh_view();
    std::size_t need = 0;
    REQUIRE(fixtures::transfer_size(attempt.analysis, &mesh, &need, nullptr) == HM_OK);
    for (std::size_t const shift : {0u, 1u, 40u, 63u}) {
        for (std::size_t give = 0; give <= need;
             give += give + 200 < need || give == need ? 61 : 1) {
            Guarded block(give, shift);
            hm_error error{};
            hm_status const status =
                hm_transfer(attempt.basis, fixtures::Memory(block.data(), give), attempt.analysis,
                            solved.basis, &mesh, nullptr, &error);
            CHECK(status == (give == need ? HM_OK : HM_BLOCK_TOO_SMALL));
            CHECK(block.guards_intact());
            if (give < need) CHECK(error.value == double(need - give));
        }
    }
}
