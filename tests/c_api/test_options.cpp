// Options that do not go with the engine are refused, never left out: who sets one must not believe
// that it counts.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

using namespace fixtures;

namespace {

struct Wish {
    const char* name;
    void (*set)(hm_options&);
    bool by_engine[3];  // direct, multigrid, fas
};

double history[2000];

constexpr Wish wishes[] = {
    {"levels", [](hm_options& o) { o.levels = 3; }, {false, true, true}},
    {"agglomeration",
     [](hm_options& o) { o.agglomeration = HM_AGGLOMERATE_ISOTROPIC; },
     {false, true, true}},
    {"block_width", [](hm_options& o) { o.block_width = 4; }, {false, true, true}},
    {"max_iterations", [](hm_options& o) { o.max_iterations = 1000; }, {false, true, true}},
    {"history",
     [](hm_options& o) { o.history = history, o.history_length = 2000; },
     {false, true, true}},
    {"start", [](hm_options& o) { o.start = HM_START_ZERO; }, {false, false, true}},
    {"precision", [](hm_options& o) { o.precision = HM_SINGLE; }, {true, false, false}},
    {"tolerance", [](hm_options& o) { o.tolerance = 1e-9; }, {true, true, true}},
};

}  // namespace

TEST_CASE("each option with each engine: solved, or refused by name") {
    Case its = two_body_case(Cells::quads, 8, 6);
    for (std::int32_t engine = HM_DIRECT; engine <= HM_FAS; ++engine)
        for (Wish const& wish : wishes) {
            hm_options options = laplace();
            options.engine = engine;
            wish.set(options);
            Attempt const attempt(its.problem(), &options);
            INFO("engine " << engine << ", " << wish.name << ": " << attempt.error.text);
            if (wish.by_engine[engine]) {
                CHECK(attempt.status == HM_OK);
            } else {
                CHECK(attempt.status == HM_UNSUPPORTED);
                CHECK(attempt.reached == "analysis size");
                CHECK(std::string(attempt.error.text).find(wish.name) != std::string::npos);
            }
        }
}

TEST_CASE("nodal gradients with the direct engine: the same, though that iterates within") {
    Case its = two_body_case(Cells::quads, 8, 6);
    hm_options options = laplace();
    options.scheme = HM_NODAL_GRADIENT;
    CHECK(Attempt(its.problem(), &options).status == HM_OK);
    options.max_iterations = 1000;
    CHECK(Attempt(its.problem(), &options).status == HM_UNSUPPORTED);
}

TEST_CASE("options of a younger caller: nothing new set is fine, anything else is refused") {
    Case its = two_body_case(Cells::quads, 8, 6);
    struct {
        hm_options known = laplace();
        std::int32_t more[4] = {};
    } options;
    options.known.struct_size = sizeof options;
    CHECK(Attempt(its.problem(), &options.known).status == HM_OK);
    options.more[3] = 1;
    CHECK(Attempt(its.problem(), &options.known).status == HM_UNSUPPORTED);
    options.more[3] = 0;
    options.known.reserved = 1;
    CHECK(Attempt(its.problem(), &options.known).status == HM_BAD_ARGUMENT);
}
