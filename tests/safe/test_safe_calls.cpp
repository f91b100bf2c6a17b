// Calls of the safe morph: cancelled, with exact working space, on threads, refused.
#include <fixtures/safe.hpp>
#include <fixtures/executors.hpp>

using namespace fixtures;

TEST_CASE("a safe morph that the callback cancels writes nothing, and works when called again") {
    struct Listener {
        int calls = 0, stop_at = 1 << 30;
        static std::int32_t call(void* user, std::int32_t, double) {
            Listener& self = *static_cast<Listener*>(user);
            return self.calls++ >= self.stop_at ? 1 : 0;
        }
    };
    Case setup = block_in_square(Cells::quads, 15);
    Listener listener;
    Options options = options_of(HM_CONFORMAL);
    options.progress = Listener::call;
    options.progress_user = &listener;
    Safe safe(setup, options);
    std::vector<double> const move = turn_of(setup, 120);
    listener.calls = 0;
    REQUIRE(safe.run(move) == HM_OK);
    REQUIRE(safe.report.resolves > 0);
    int const all = listener.calls;
    std::vector<double> const expected = safe.x;
    CHECK(all > 4);
    for (int stop = 0; stop < all; stop += 1 + all / 20) {
        listener.calls = 0;
        listener.stop_at = stop;
        CHECK(safe.run(move) == HM_CANCELLED);
        CHECK(safe.untouched());
    }
    listener.stop_at = 1 << 30;
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(same_bits(safe.x, expected));
}

TEST_CASE("has_factor tells whether the plan solves without being factored again") {
    Case setup = block_in_square(Cells::quads, 15);
    Safe safe(setup);
    for (double const degrees : {3., 120., 3.}) {
        INFO(degrees);
        REQUIRE(safe.run(turn_of(setup, degrees)) == HM_OK);
        CHECK((safe.report.resolves > 0) == (degrees == 120));
        hm_error error{};
        hm_status const solved =
            hm_plan_solve(safe.solved().plan, safe.solved().basis, nullptr, &error);
        CHECK((safe.report.has_factor == 1) == (solved >= 0));
    }
}

TEST_CASE("working space of exactly the stated size suffices, and every smaller size is refused") {
    Case setup = tiny_case();
    Safe safe(setup);
    std::vector<double> const move = turn_of(setup, 20);
    std::size_t const bytes = safe.work().size();
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    for (std::size_t give = 0; give < bytes; give += give + 300 < bytes ? 251 : 1) {
        Guarded less(give);
        hm_error error{};
        hm_status const status =
            safe_move(safe.solved().plan, safe.solved().basis, move.data(), points_out(x, y),
                      nullptr, less.data(), give, nullptr, nullptr, &error);
        if (status == HM_OK) CHECK(bytes - give < 64);  // the slack for alignment
        else {
            REQUIRE(status == HM_BLOCK_TOO_SMALL);
            CHECK(error.value > 0);
            CHECK(error.value <= double(bytes - give));
        }
        CHECK(less.guards_intact());
        if (status == HM_OK) break;
    }
    for (std::size_t const shift : {std::size_t{1}, std::size_t{33}}) {
        Guarded other(bytes, shift);
        CHECK(safe_move(safe.solved().plan, safe.solved().basis, move.data(), points_out(x, y),
                        nullptr, other.data(), bytes, nullptr, nullptr, nullptr) >= HM_OK);
        CHECK(other.guards_intact());
    }
}

TEST_CASE("threads, input in place and other arrays do not change the bits") {
    Case setup = block_in_square();
    std::vector<double> const move = turn_of(setup, 110, {0.03, 0});
    for (std::int32_t const skipped : {0, without({HM_STRATEGY_SUBSTEPS})}) {
        Safe serial(setup);
        serial.safe_options.skipped_strategies = skipped;
        REQUIRE(serial.run(move) == HM_OK);
        for (std::int32_t const threads : {2, 5}) {
            Backwards backwards;
            hm_executor const executor = backwards.executor(threads);
            Options options = options_of(HM_CONFORMAL);
            options.executor = &executor;
            Safe safe(setup, options);
            safe.safe_options.skipped_strategies = skipped;
            REQUIRE(safe.run(move) == HM_OK);
            CHECK(same_bits(safe.x, serial.x));
            CHECK(same_bits(safe.y, serial.y));
            CHECK(safe.report.min_quality == serial.report.min_quality);
        }
    }
    Safe reference(setup);
    reference.safe_options.min_quality = 0;  // as without options
    REQUIRE(reference.run(move) == HM_OK);
    Case own = setup;
    hm_mesh view = own.mesh.view();
    hm_problem const problem = own.problem(view);
    Solved const solved(problem, options_of(HM_CONFORMAL));
    Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
    REQUIRE(safe_move(solved.plan, solved.basis, move.data(), points_out(own.mesh.x, own.mesh.y),
                      nullptr, work.data(), work.size(), nullptr, nullptr, nullptr) == HM_OK);
    CHECK(same_bits(own.mesh.x, reference.x));
    CHECK(same_bits(own.mesh.y, reference.y));
}

TEST_CASE("arguments that do not belong together are refused, and nothing is written") {
    Case setup = tiny_case();
    Safe safe(setup);
    std::vector<double> const move = turn_of(setup, 10);
    hm_plan* const plan = safe.solved().plan;
    auto const refused = [&](const hm_basis* basis, std::vector<double> const& by) {
        Guarded work = block_of(safe_move_size, plan, nullptr);
        std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
        hm_status const status =
            safe_move(plan, basis, by.data(), points_out(x, y), nullptr, work.data(), work.size(),
                      &safe.safe_options, nullptr, nullptr);
        CHECK(same_bits(x, setup.mesh.x));
        CHECK(same_bits(y, setup.mesh.y));
        return status;
    };
    Options const conformal = options_of(HM_CONFORMAL), sharper = options_of(HM_CONFORMAL, 2);
    Options const paper = options_of(HM_LAPLACE);
    Solved const other_exponent(setup, &sharper), other_operator(setup, &paper);
    Case elsewhere = setup;
    elsewhere.give(17, 0.4);
    Solved const other_parameters(elsewhere, &conformal);
    CHECK(refused(other_exponent.basis, move) == HM_BAD_BASIS);
    CHECK(refused(other_operator.basis, move) == HM_BAD_BASIS);
    CHECK(refused(other_parameters.basis, move) == HM_BAD_BASIS);
    std::vector<double> wrong = move;
    wrong[3] = std::nan("");
    CHECK(refused(safe.solved().basis, wrong) == HM_BAD_ARGUMENT);
    // Among the others, another operator and exponent are accepted; other parameters and curves are
    // not.
    const hm_basis* others[] = {other_exponent.basis, other_operator.basis, nullptr};
    safe.safe_options.n_others = 2;
    safe.safe_options.others = others;
    CHECK(safe.run(move) == HM_OK);
    safe.safe_options.n_others = 3;
    others[2] = other_parameters.basis;
    CHECK(refused(safe.solved().basis, move) == HM_BAD_BASIS);
    Case knots = setup;  // the same points and parameters on a curve of another shape
    knots.curves.shapes[0].knots[2] += 0.01;
    knots.give(17, 0.5);
    Solved const other_knots(knots, &conformal);
    others[2] = other_knots.basis;
    CHECK(refused(safe.solved().basis, move) == HM_BAD_BASIS);
}

TEST_CASE("a plan gives the same bits after the block of the analysis is overwritten") {
    for (std::int32_t const engine :
         {std::int32_t{HM_DIRECT}, std::int32_t{HM_MULTIGRID}, std::int32_t{HM_FAS}}) {
        Case setup = block_in_square(Cells::quads, 15);
        Options options = options_of(engine == HM_FAS ? HM_LAPLACE : HM_CONFORMAL);
        options.engine = engine;
        Safe safe(setup, options);
        std::vector<double> const move = turn_of(setup, engine == HM_FAS ? 60 : 120);
        REQUIRE(safe.run(move) >= HM_OK);
        CHECK(safe.report.resolves > 0);
        std::vector<double> const expected = safe.x;
        Guarded& block = *safe.solved().analysis_block;
        std::memset(block.data(), 0xA5, block.size());
        REQUIRE(safe.run(move) >= HM_OK);
        CHECK(same_bits(safe.x, expected));
        REQUIRE(hm_plan_factor(safe.solved().plan, nullptr, nullptr) == HM_OK);
        CHECK(hm_plan_solve(safe.solved().plan, safe.solved().basis, nullptr, nullptr) == HM_OK);
    }
}
