// Sums of bases whose functions are multiplied by complex numbers: the derivative of a morph in
// several steps.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>

#include "morph/weighted_sum.hpp"

using namespace fixtures;
using harmorph::Vec2;

namespace {

// A copy of a solved basis whose values are all 0.
class Sum {
public:
    explicit Sum(Solved const& like) : block_(std::size_t(like.info().bytes)) {
        std::memcpy(block_.data(), like.basis, block_.size());
        view = harmorph::Basis::view(static_cast<void*>(block_.data()));
        fill(view.value, 0.0);
    }
    Field displacement(std::vector<double> const& move) {
        view.seal();
        return fixtures::displacement(reinterpret_cast<const hm_basis*>(block_.data()), move);
    }
    harmorph::Basis view;

private:
    Guarded block_;
};

harmorph::Basis view_of(Solved const& solved) {
    return harmorph::Basis::view(static_cast<const void*>(solved.basis));
}

}  // namespace

TEST_CASE("the sum moves points as its parts do by the movements times their weights") {
    struct Kind {
        std::int32_t operator_kind;
        bool slip, real;
    };
    for (Kind const kind : {Kind{HM_LAPLACE, false, true}, Kind{HM_CONFORMAL, false, false},
                            Kind{HM_CONFORMAL, true, false}, Kind{HM_LAPLACE, true, false}}) {
        Case setup = two_body_case(Cells::hybrid, 6, 4);
        if (kind.slip) setup.set_slip(far_field);
        Options const options = options_of(kind.operator_kind);
        Solved const first(setup, &options);
        Case elsewhere = setup;
        perturb(elsewhere.mesh, 0.3, 4);
        Solved const second(elsewhere, &options);
        Sum sum(first);
        std::vector<double> const move = some_move(20, 1, 5), seeds = some_move(40, 1, 6);
        Field expected(setup.mesh.x.size(), 0);
        std::size_t number = 0;
        for (Solved const* part : {&first, &second}) {
            std::vector<Vec2> weight;
            std::vector<double> weighted = move;
            for (std::size_t i = 0; i < 20; ++i, ++number) {
                Complex const w(seeds[2 * number],
                                kind.real ? 0 : seeds[2 * number + 1]);  // real values cannot turn
                weight.push_back({w.real(), w.imag()});
                Complex const by = w * Complex(move[2 * i], move[2 * i + 1]);
                weighted[2 * i] = by.real();
                weighted[2 * i + 1] = by.imag();
            }
            add_weighted(sum.view, view_of(*part), {weight.data(), weight.size()}, {});
            Field const part_sum = displacement(*part, weighted);
            for (std::size_t k = 0; k < expected.size(); ++k) expected[k] += part_sum[k];
        }
        CHECK(largest_difference(sum.displacement(move), expected) < 1e-13);
    }
}

TEST_CASE("weights 1 copy, weights 0 add nothing, and threads change no bit") {
    Case setup = ring_case(30, 300, 0.5, 2, Cells::quads);  // 9300 points: several ranges
    Options const options = options_of(HM_CONFORMAL);
    Solved const solved(setup, &options);
    std::vector<Vec2> const one(8, Vec2{1, 0}), nothing(8, Vec2{0, 0}), some(8, Vec2{0.3, -0.8});
    Sum copy(solved), serial(solved), threaded(solved);
    add_weighted(copy.view, view_of(solved), {one.data(), 8}, {});
    add_weighted(copy.view, view_of(solved), {nothing.data(), 8}, {});
    std::vector<double> const move = some_move(8, 1, 7);
    CHECK(copy.displacement(move) == displacement(solved, move));
    Backwards backwards;
    add_weighted(serial.view, view_of(solved), {some.data(), 8}, {});
    add_weighted(threaded.view, view_of(solved), {some.data(), 8}, {Backwards::run, &backwards, 3});
    CHECK(backwards.tasks > 1);
    CHECK(serial.displacement(move) == threaded.displacement(move));
}
