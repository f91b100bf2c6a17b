// The stack that calls take, as the head of harmorph.h states: measured on a thread whose stack is
// filled with a pattern before the call.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_fields.h>
#include <harmorph_quality.h>

#include <fixtures/bounded.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/fitted.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/memory.hpp>

#include <functional>
#include <cstdio>
#include <cstdlib>
#include <pthread.h>

using namespace fixtures;

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__OPTIMIZE__)

namespace {

constexpr std::size_t kib = 1024, stack_size = 512 * kib;

// Returns how many bytes of a new stack the call changes.
std::size_t touched_by(std::function<void()> const& call) {
    alignas(4096) static unsigned char stack[stack_size];
    for (unsigned char& byte : stack) byte = 0xA5;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    REQUIRE(pthread_attr_setstack(&attributes, stack, stack_size) == 0);
    pthread_t thread;
    auto const run = [](void* body) -> void* {
        (*static_cast<std::function<void()> const*>(body))();
        return nullptr;
    };
    REQUIRE(pthread_create(&thread, &attributes, run,
                           const_cast<void*>(static_cast<const void*>(&call))) == 0);
    REQUIRE(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
    std::size_t untouched = 0;
    while (untouched < stack_size && stack[untouched] == 0xA5) ++untouched;
    return stack_size - untouched;
}

// The same without what the thread itself takes.
std::size_t stack_of(std::function<void()> const& call) {
    return touched_by(call) - touched_by([] {});
}

void check_stack(const char* name, std::size_t allowed, std::function<void()> const& call) {
    std::size_t const used = stack_of(call);
    INFO(std::string(name) << " takes " << used << " bytes of stack");
    CHECK(used <= allowed);
    if (std::getenv("HARMORPH_STACK") != nullptr) std::printf("%8zu %s\n", used, name);
}

}  // namespace

TEST_CASE("analysis, factorisation and solution take at most the stated stack") {
    Case setup = two_body_case(Cells::hybrid, 30, 20);
    hm_problem const problem = setup.problem();
    struct Row {
        const char* name;
        std::int32_t operator_kind, scheme, engine;
    };
    for (Row const& row : {Row{"conformal", HM_CONFORMAL, HM_COMPACT, HM_DIRECT},
                           Row{"bounded", HM_WEIGHTED, HM_BOUNDED, HM_DIRECT},
                           Row{"nodal", HM_LAPLACE, HM_NODAL_GRADIENT, HM_DIRECT},
                           Row{"multigrid", HM_CONFORMAL, HM_COMPACT, HM_MULTIGRID},
                           Row{"fas", HM_LAPLACE, HM_NODAL_GRADIENT, HM_FAS}}) {
        for (std::int32_t const threads : {1, 64}) {
            Backwards backwards;
            hm_executor const executor = backwards.executor(threads);
            Options options = options_of(row.operator_kind);
            options.scheme = row.scheme;
            options.engine = row.engine;
            options.tolerance = 1e-3;  // fewer iterations take no less stack
            options.executor = &executor;
            Attempt attempt;
            check_stack(row.name, 56 * kib, [&] { attempt.run(problem, &options); });
            INFO(attempt.error.text);
            CHECK(attempt.status >= 0);
        }
    }
}

TEST_CASE("morphs, adjoints and safe morphs take at most the stated stack") {
    Case setup = two_body_case(Cells::hybrid, 20, 12);
    for (std::int32_t const threads : {1, 64}) {
        Backwards backwards;
        hm_executor const executor = backwards.executor(threads);
        Options options = options_of(HM_CONFORMAL);
        options.executor = &executor;
        Safe safe(setup, options);
        hm_basis* const basis = safe.solved().basis;
        hm_basis_info const info = info_of(basis);
        std::vector<double> const move = some_move(info.functions, 0.01, 3);
        std::vector<double> x = setup.mesh.x, y = setup.mesh.y, gradient(move.size());
        hm_points const at{x.data(), y.data(), 1};
        hm_points_out const to{x.data(), y.data(), 1};
        hm_status status = HM_OK;
        check_stack("hm_morph", 17 * kib,
                    [&] { status = hm_morph(basis, move.data(), &at, &to, &executor, nullptr); });
        CHECK(status == HM_OK);
        check_stack("hm_adjoint", 40 * kib,
                    [&] { status = hm_adjoint(basis, &at, gradient.data(), &executor, nullptr); });
        CHECK(status == HM_OK);
        hm_step_report step{};
        hm_quality_report quality{};
        step.struct_size = sizeof step;
        quality.struct_size = sizeof quality;
        check_stack("hm_assess", 56 * kib, [&] {
            status = hm_assess(basis, &setup.mesh_view(), nullptr, &at, nullptr, &executor, &step,
                               &quality, nullptr);
        });
        CHECK(status == HM_OK);
        Guarded room = block_of(fixtures::recover_movement_size, basis);
        std::vector<double> found(move.size());
        check_stack("hm_recover_movement", 56 * kib, [&] {
            status = hm_recover_movement(basis, &at, 0, found.data(), nullptr,
                                         fixtures::Memory(room.data(), room.size()), nullptr);
        });
        CHECK(status == HM_OK);
        // All strategies: a body turns by more than a right angle while the other one stays.
        std::vector<double> turn = similarity_move(setup.curves, std::polar(1.0, 2.2), {0.5, 0.5});
        for (std::size_t k = 22; k < turn.size(); ++k) turn[k] = 0;
        safe.safe_options.improve = 1;
        safe.safe_options.heights = 1;
        for (std::int32_t const skipped : {0, 1 << HM_STRATEGY_SUBSTEPS}) {
            safe.safe_options.skipped_strategies = skipped;
            check_stack("hm_move_safe", 56 * kib, [&] { safe.run(turn); });
            CHECK(safe.status >= 0);
        }
    }
}

TEST_CASE("fits, bounds and safe displacements take at most the stated stack") {
    std::vector<Point> const outline = naca4({}, 60).points;
    check_stack("hm_fit", 56 * kib, [&] { fitted_loop(outline, 20); });
    for (std::int32_t const threads : {1, 64}) {
        Backwards backwards;
        hm_executor const executor = backwards.executor(threads);
        Options options = options_of(HM_CONFORMAL);
        options.executor = &executor;
        Case setup = given_block();
        SafeDisplaced made(setup, options);
        Field const wall = made.similarity(std::polar(1.0, 2.4), Complex(0.5, 0.5));
        check_stack("hm_move_safe", 56 * kib, [&] { made.run(wall); });
        CHECK(made.safe_report.strategy > 0);
        Bounded const bounded(setup);
        std::vector<hm_bound> wanted;
        for (std::int32_t const kind : {HM_BOUND_QUALITY, HM_BOUND_AREA}) {
            wanted.push_back(sized<hm_bound>());
            wanted.back().kind = kind;
        }
        std::vector<hm_bound_value> values(2, sized<hm_bound_value>());
        std::vector<double> x(setup.mesh.x.size()), y = x, u = x, v = x;
        hm_points_out const gradients[] = {{x.data(), y.data(), 1}, {u.data(), v.data(), 1}};
        hm_status status = HM_OK;
        check_stack("hm_quality_bounds", 56 * kib, [&] {
            status = hm_quality_bounds(bounded.quality, nullptr, 2, wanted.data(), values.data(),
                                       gradients, &executor, nullptr);
        });
        CHECK(status == HM_OK);
    }
}

#endif
