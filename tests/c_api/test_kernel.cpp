// The vector instructions that an executor names.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/wrong.hpp>

using namespace fixtures;

namespace {

// Numbers of x, then of y.
std::vector<double> morphed(Case const& setup, Solved const& solved,
                            std::vector<double> const& move, hm_executor const* executor) {
    std::size_t const n = setup.mesh.x.size();
    std::vector<double> out(2 * n);
    hm_points_out const to{out.data(), out.data() + n, 1};
    REQUIRE(hm_morph(solved.basis, move.data(), points_in(setup.mesh.x, setup.mesh.y), &to,
                     executor, nullptr) == HM_OK);
    return out;
}

std::vector<double> gradient(Case const& setup, Solved const& solved, hm_executor const* executor) {
    std::vector<double> out(2 * std::size_t(setup.curves.n_control()));
    REQUIRE(hm_adjoint(solved.basis, points_in(setup.mesh.y, setup.mesh.x), out.data(), executor,
                       nullptr) == HM_OK);
    return out;
}

}  // namespace

TEST_CASE("the best kernel is one that the processor has") {
    CHECK(hm_best_kernel() == std::int32_t(usable_kernels().back()));
}

TEST_CASE("every kernel that an executor may name gives the same bits of movements and gradients") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    std::vector<double> const move = some_move(setup.curves.n_control(), 0.01, 1);
    std::vector<double> const points = morphed(setup, solved, move, nullptr),
                              slopes = gradient(setup, solved, nullptr);
    for (harmorph::Kernel const kernel : usable_kernels()) {
        hm_executor const executor{sizeof executor, nullptr, nullptr, 1, std::int32_t(kernel)};
        CHECK(same_bits(morphed(setup, solved, move, &executor), points));
        CHECK(same_bits(gradient(setup, solved, &executor), slopes));
    }
}
