// The stack that calls need is at most what the header says: a thread with a painted stack makes
// them, and the paint that is left is counted.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <harmorph_quality.h>

#include <pthread.h>

using namespace fixtures;

namespace {

constexpr std::size_t whole = std::size_t{1} << 20;
constexpr unsigned char paint = 0xA5;

// The bytes of stack that `call` uses, what starts the thread included.
template <class Call>
std::size_t stack_of(Call call) {
    alignas(4096) static unsigned char stack[whole];
    std::memset(stack, paint, whole);
    pthread_attr_t attributes;
    REQUIRE(pthread_attr_init(&attributes) == 0);
    REQUIRE(pthread_attr_setstack(&attributes, stack, whole) == 0);
    pthread_t thread;
    auto const run = [](void* context) -> void* {
        (*static_cast<Call*>(context))();
        return nullptr;
    };
    REQUIRE(pthread_create(&thread, &attributes, run, &call) == 0);
    REQUIRE(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
    std::size_t untouched = 0;
    while (untouched < whole && stack[untouched] == paint) ++untouched;
    return whole - untouched;
}

}  // namespace

TEST_CASE("hm_morph needs at most 16 KiB of stack, hm_adjoint on one thread 40, other calls 112") {
    std::size_t const of_thread = stack_of([] {});
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Case setup = two_body_case(Cells::hybrid, 16, 8);
        hm_mesh const mesh = setup.mesh.view();
        Options options = laplace();
        options.operator_kind = operator_kind;
        std::size_t used[4] = {};
        Solved const solved_once(setup.problem(mesh), &options);
        Attempt solved;
        used[0] = stack_of([&] { solved.run(setup.problem(mesh), &options); });
        REQUIRE(solved.status == HM_OK);
        std::int32_t const n = solved_once.info().functions;
        std::vector<double> const move = some_move(n, 1e-3, 4);
        std::vector<double> gradient(std::size_t(2 * n));
        std::vector<double> x(setup.mesh.x), y(setup.mesh.y);
        hm_quality_report quality;
        HM_INIT(quality);
        used[1] = stack_of([&] {
            CHECK(hm_adjoint(solved.basis, &mesh.points, gradient.data(), nullptr, nullptr) ==
                  HM_OK);
        });
        used[2] = stack_of([&] {
            CHECK(hm_assess(solved.basis, &mesh, nullptr, nullptr, nullptr, nullptr, nullptr,
                            &quality, nullptr) == HM_OK);
        });
        used[3] = stack_of([&] {
            CHECK(hm_morph(solved.basis, move.data(), nullptr, points_out(x, y), nullptr,
                           nullptr) == HM_OK);
        });
        std::size_t bytes_of_quality = 0;
        REQUIRE(hm_quality_size(solved.basis, &mesh, &bytes_of_quality, nullptr) == HM_OK);
        std::vector<char> block(bytes_of_quality);
        hm_quality* start = nullptr;
        CHECK(stack_of([&] {
                  CHECK(hm_quality_init(&start, block.data(), block.size(), solved.basis, &mesh,
                                        nullptr, nullptr) == HM_OK);
              }) - of_thread <=
              112 * 1024);
        hm_bound bounds[3] = {};
        hm_bound_value values[3] = {};
        for (std::int32_t k = 0; k < 3; ++k) {
            bounds[k] = {sizeof(hm_bound), HM_BOUND_AREA + k, 0, 0};
            values[k].struct_size = sizeof(hm_bound_value);
        }
        CHECK(stack_of([&] {
                  CHECK(hm_quality_bounds(start, nullptr, 3, bounds, values, nullptr, nullptr,
                                          nullptr) == HM_OK);
              }) - of_thread <=
              112 * 1024);
        for (std::size_t const bytes : used) CHECK(bytes - of_thread <= 112 * 1024);
        CHECK(used[1] - of_thread <= 40 * 1024);
        CHECK(used[3] - of_thread <= 16 * 1024);
        MESSAGE("solve " << used[0] - of_thread << ", adjoint " << used[1] - of_thread
                         << ", assess " << used[2] - of_thread << ", morph "
                         << used[3] - of_thread);
    }
}
