// Progress, cancellation and calls out of order lose no results and leave no partial ones.
#include <fixtures/bodies.hpp>
#include <fixtures/memory.hpp>

#include <algorithm>
#include <limits>

using namespace fixtures;

namespace {

struct Event {
    std::int32_t phase;
    double fraction;
};

// A callback that records the events and stops at one of them.
struct Listener {
    std::vector<Event> events;
    std::size_t stop_at = std::numeric_limits<std::size_t>::max();

    static std::int32_t call(void* user, std::int32_t phase, double fraction) {
        Listener& self = *static_cast<Listener*>(user);
        self.events.push_back({phase, fraction});
        return self.events.size() - 1 == self.stop_at ? 42 : 0;
    }
    Options options() {
        Options out = laplace();
        out.progress = call;
        out.progress_user = this;
        return out;
    }
};

}  // namespace

TEST_CASE("a tolerance below rounding gives a warning, and the functions are there") {
    Case setup = airfoil_case();
    Options options = laplace();
    options.tolerance = 1e-18;
    Attempt const attempt(setup.problem(), &options);
    CHECK(attempt.status == HM_NOT_CONVERGED);
    CHECK(attempt.error.code == HM_NOT_CONVERGED);
    CHECK(attempt.error.value == attempt.report.residual);
    CHECK(attempt.report.residual > 1e-18);
    CHECK(attempt.report.residual < 1e-12);
    std::vector<double> values(setup.mesh.x.size());
    CHECK(hm_basis_values(attempt.basis, 0, 0, values.data(), nullptr) == HM_OK);
}

TEST_CASE("phases are reported in order, each from 0 to 1 and never backwards") {
    Case setup = ring_case(60, 300, 0.5, 2);  // large enough for reports in between
    Listener listener;
    Options const options = listener.options();
    Solved const solved(setup, &options);
    std::vector<Event> const& events = listener.events;
    REQUIRE(events.size() > 14);
    CHECK(events.front().phase == HM_PHASE_STRUCTURE);
    CHECK(events.back().phase == HM_PHASE_RESIDUAL);
    for (std::size_t k = 0; k < events.size(); ++k) {
        CHECK(events[k].fraction >= 0);
        CHECK(events[k].fraction <= 1);
        bool const starts = k == 0 || events[k].phase != events[k - 1].phase;
        if (starts) {
            CHECK(events[k].fraction == 0);
            CHECK(events[k].phase == (k == 0 ? HM_PHASE_STRUCTURE : events[k - 1].phase + 1));
            if (k > 0) CHECK(events[k - 1].fraction == 1);
        } else {
            CHECK(events[k].fraction >= events[k - 1].fraction);
        }
    }
    CHECK(events.back().fraction == 1);
    // The longest phase is reported on its way, but not for each of the thousands of fronts.
    auto const is_of_factor = [](Event const& event) { return event.phase == HM_PHASE_FACTOR; };
    auto const reports = std::count_if(events.begin(), events.end(), is_of_factor);
    CHECK(reports > 2);
    CHECK(reports < 100);
}

TEST_CASE("a solution that is cancelled at any moment has the same bits when repeated") {
    Case setup = ring_case(40, 200, 0.5, 2, Cells::hybrid, 3, 10);
    Listener listener;
    Options options = listener.options();
    hm_problem const problem = setup.problem();
    Solved const reference(problem, &options);
    std::vector<double> const expected = all_numbers(reference.basis);
    std::vector<Event> const all = listener.events;

    for (std::size_t stop = 0; stop < all.size(); ++stop) {
        INFO("phase " << all[stop].phase << " at " << all[stop].fraction);
        listener.events.clear();
        listener.stop_at = stop;
        Attempt attempt;
        bool cancelled = false;
        auto const again_if_cancelled = [&](bool done) {
            if (done) return;
            CHECK(attempt.status == HM_CANCELLED);
            CHECK(attempt.error.code == HM_CANCELLED);
            CHECK(std::string(attempt.error.text) == "the progress callback stopped the call");
            CHECK(listener.events.size() == stop + 1);  // nothing was reported after that
            cancelled = true;
        };
        again_if_cancelled(attempt.analyse(problem, &options));
        if (cancelled) {
            CHECK(attempt.analysis == nullptr);
            hm_status const status = hm_analysis_init(
                &attempt.analysis,
                fixtures::Memory(attempt.analysis_block->data(), attempt.analysis_block->size()),
                &problem, &options, nullptr);
            REQUIRE(status >= HM_OK);  // in the same block
        }
        REQUIRE(attempt.prepare());
        hm_status status = hm_plan_factor(attempt.plan, nullptr, &attempt.error);
        if (status < 0) {
            CHECK(status == HM_CANCELLED);
            CHECK(!cancelled);
            cancelled = true;
            CHECK(hm_plan_solve(attempt.plan, attempt.basis, nullptr, nullptr) <
                  0);  // there is no factor
            REQUIRE(hm_plan_factor(attempt.plan, nullptr, nullptr) == HM_OK);
        }
        status = hm_plan_solve(attempt.plan, attempt.basis, nullptr, &attempt.error);
        if (status < 0) {
            CHECK(status == HM_CANCELLED);
            CHECK(!cancelled);
            cancelled = true;
            std::vector<double> values(setup.mesh.x.size());
            CHECK(hm_basis_values(attempt.basis, 0, 0, values.data(), nullptr) ==
                  HM_BAD_BASIS);  // not solved
            REQUIRE(hm_plan_solve(attempt.plan, attempt.basis, nullptr, nullptr) ==
                    HM_OK);  // the factor stays
        }
        CHECK(cancelled);
        CHECK(same_bits(all_numbers(attempt.basis), expected));
        CHECK(attempt.guards_intact());
    }
}

TEST_CASE("a plan without a factor and the basis of another analysis are refused") {
    Case setup = tiny_case(), other = two_body_case();
    Attempt attempt = prepared(setup.problem());
    CHECK(hm_plan_solve(attempt.plan, attempt.basis, nullptr, nullptr) < 0);
    REQUIRE(attempt.solve());
    Solved const foreign(other);
    CHECK(hm_plan_solve(attempt.plan, foreign.basis, nullptr, nullptr) < 0);

    hm_mesh const mesh = other.mesh.view();
    std::vector<double> const d(setup.mesh.x.size(), 0.0);
    auto step = sized<hm_step_report>();
    CHECK(hm_assess(attempt.basis, &mesh, nullptr, points_in(d, d), nullptr, nullptr, &step,
                    nullptr, nullptr) == HM_BAD_BASIS);
    Attempt only_mesh;
    hm_problem problem = setup.problem();
    problem.curves = nullptr;
    REQUIRE(only_mesh.analyse(problem));
    std::size_t bytes = 0;
    CHECK(fixtures::plan_size(only_mesh.analysis, &bytes, nullptr) == HM_BAD_ARGUMENT);
    CHECK(fixtures::basis_size(only_mesh.analysis, &bytes, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("functions solved again on moved coordinates are those of the moved mesh") {
    Case setup = ring_case(10, 60, 0.5, 2, Cells::hybrid);
    Case moved = setup;
    perturb(moved.mesh, 0.2, 4);
    Solved const first(setup), expected(moved);
    REQUIRE(hm_plan_factor(first.plan, points_in(moved.mesh.x, moved.mesh.y), nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(first.plan, first.basis, nullptr, nullptr) == HM_OK);
    CHECK(largest_difference(first.all_values(), expected.all_values()) < 1e-12);
    hm_mesh const on_moved = moved.mesh.view(), on_old = setup.mesh.view();
    const hm_basis* basis = nullptr;
    std::size_t const bytes = std::size_t(first.info().bytes);
    CHECK(hm_basis_attach(&basis, first.basis, bytes, &on_moved, nullptr) == HM_OK);
    CHECK(hm_basis_attach(&basis, first.basis, bytes, &on_old, nullptr) == HM_MOVED);
}
