// Options that do not go with the engine are refused, never left out: who sets one must not believe
// that it counts.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

using namespace fixtures;

namespace {

struct Wish {
    const char* name;
    void (*set)(Options&);
    bool by_engine[3];  // direct, multigrid, fas
};

double history[2000];

constexpr Wish wishes[] = {
    {"levels", [](Options& o) { o.levels = 3; }, {false, true, true}},
    {"agglomeration",
     [](Options& o) { o.agglomeration = HM_AGGLOMERATE_ISOTROPIC; },
     {false, false, true}},
    {"block_width", [](Options& o) { o.block_width = 4; }, {false, true, true}},
    {"max_iterations", [](Options& o) { o.max_iterations = 1000; }, {false, true, true}},
    {"history",
     [](Options& o) { o.history = history, o.history_length = 2000; },
     {false, true, true}},
    {"start", [](Options& o) { o.start = HM_START_ZERO; }, {false, false, true}},
    {"tolerance", [](Options& o) { o.tolerance = 1e-9; }, {true, true, true}},
};

}  // namespace

TEST_CASE("each option with each engine: solved, or refused by name") {
    Case setup = two_body_case(Cells::quads, 8, 6);
    for (std::int32_t engine = HM_DIRECT; engine <= HM_FAS; ++engine)
        for (Wish const& wish : wishes) {
            Options options = laplace();
            options.engine = engine;
            wish.set(options);
            Attempt const attempt(setup.problem(), &options);
            INFO("engine " << engine << ", " << wish.name << ": " << attempt.error.text);
            if (wish.by_engine[engine]) {
                CHECK(attempt.status == HM_OK);
            } else {
                CHECK(attempt.status == HM_UNSUPPORTED);
                CHECK(attempt.reached == "analysis size");
                CHECK(says(attempt.error, wish.name));
            }
        }
}

TEST_CASE("nodal gradients with the direct engine: the same, though that iterates within") {
    Case setup = two_body_case(Cells::quads, 8, 6);
    Options options = laplace();
    options.scheme = HM_NODAL_GRADIENT;
    CHECK(Attempt(setup.problem(), &options).status == HM_OK);
    options.max_iterations = 1000;
    CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
}

namespace {

hm_status size_with(Case& setup, hm_options const& options) {
    hm_problem const problem = setup.problem();
    std::size_t bytes = 0;
    return fixtures::analysis_size(&problem, &options, &bytes, nullptr);
}

}  // namespace

TEST_CASE("options of a younger caller: nothing new set is fine, anything else is refused") {
    Case setup = two_body_case(Cells::quads, 8, 6);
    struct {
        hm_options known = laplace();
        std::int32_t more[4] = {};
    } options;
    struct {
        hm_study_options known = laplace();
        std::int32_t more[4] = {};
    } study;
    options.known.struct_size = sizeof options;
    study.known.struct_size = sizeof study;
    options.known.study = &study.known;
    CHECK(size_with(setup, options.known) == HM_OK);
    options.more[3] = 1;
    CHECK(size_with(setup, options.known) == HM_UNSUPPORTED);
    options.more[3] = 0;
    study.more[3] = 1;
    CHECK(size_with(setup, options.known) == HM_UNSUPPORTED);
}
