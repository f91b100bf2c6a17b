// A safe morph on the way of which the functions are solved again four times, against one whole
// solution: analysis, plan, factor and 20 conformal functions.
#include "fixtures/memory.hpp"
#include "clock.hpp"
#include "ours.hpp"
#include "settings.hpp"

#include <cmath>
#include <stdexcept>

namespace bench {
namespace {

constexpr Index functions = 20, wanted_resolves = 4;

class SafeCase {
public:
    SafeCase(Case const& mesh_case, Settings const& settings)
        : case_(mesh_case), fit_(mesh_case, functions), x_(mesh_case.mesh.x.size()), y_(x_.size()) {
        options_.executor = settings.executor;
        safe_.struct_size = sizeof safe_;
        safe_.max_resolves = wanted_resolves;
        safe_.skipped_strategies = 1 << HM_STRATEGY_UNTANGLED | 1 << HM_STRATEGY_IMPROVED;
        report_.struct_size = sizeof report_;
    }

    // Computes the functions from the mesh, in the same blocks each time.
    void solve() {
        Problem const problem(case_, fit_);
        std::size_t bytes = 0;
        done(fixtures::analysis_size(&problem.given, &options_, &bytes, &error_), "hm_analysis");
        void* block = analysis_block_.give(bytes);
        done(hm_analysis_init(&analysis_, fixtures::Memory(block, bytes), &problem.given, &options_,
                              &error_),
             "hm_analysis_init");
        done(fixtures::plan_size(analysis_, &bytes, &error_), "hm_plan");
        block = plan_block_.give(bytes);
        done(hm_plan_init(&plan_, fixtures::Memory(block, bytes), analysis_, &error_),
             "hm_plan_init");
        done(fixtures::basis_size(analysis_, &bytes, &error_), "hm_basis");
        block = basis_block_.give(bytes);
        done(hm_basis_init(&basis_, fixtures::Memory(block, bytes), analysis_, &error_),
             "hm_basis_init");
        solve_again();
    }
    // Repeats what each step of a safe morph repeats: the numbers, not the structure.
    void solve_again() {
        done(hm_plan_factor(plan_, nullptr, &error_), "hm_plan_factor");
        done(hm_plan_solve(plan_, basis_, nullptr, &error_), "hm_plan_solve");
    }
    // The section is bent: its points go up by height sin(3 x), x in chords.
    void bend(double height) {
        move_.assign(2 * at(functions), 0);
        const double* const control = fit_.curves().control;
        for (std::size_t i = 0; i < at(functions); ++i)
            move_[2 * i + 1] = height * std::sin(3 * control[2 * i]);
    }
    void morph() {
        std::size_t bytes = 0;
        done(fixtures::safe_move_size(plan_, basis_, &bytes, &error_), "hm_move_safe");
        void* const block = work_.give(bytes);
        hm_points_out const to{x_.data(), y_.data(), 1};
        done(fixtures::safe_move(plan_, basis_, move_.data(), &to, nullptr, block, bytes, &safe_,
                                 &report_, &error_),
             "hm_move_safe");
    }
    bool has_wanted_resolves() const {
        return report_.step_fraction == 1 && report_.resolves == wanted_resolves;
    }
    hm_safe_report const& report() const { return report_; }

private:
    Case const& case_;
    Fit fit_;
    Block analysis_block_, plan_block_, basis_block_, work_;
    hm_analysis* analysis_ = nullptr;
    hm_plan* plan_ = nullptr;
    hm_basis* basis_ = nullptr;
    Options options_{};
    hm_safe_options safe_{};
    hm_safe_report report_{};
    hm_error error_{};
    std::vector<double> x_, y_, move_;

    void done(hm_status status, char const* call) const { require(status, error_, call); }
};

}  // namespace

void bench_safe(Settings const& settings, Report& report) {
    Table table{"Safe morph with four solutions on the way, in whole solutions [s] (threads: " +
                    std::to_string(settings.threads) + ")",
                {"mesh", "height", "steps", "quality", "solution", "factor and functions",
                 "safe morph", "safe / solution", "of which the four"},
                {},
                {}};
    Others others;
    for (std::string const& kind : settings.kinds)
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            say(mesh_case.name() + ": safe");
            SafeCase safe_case(mesh_case, settings);
            safe_case.solve();
            double height = 0.2;
            for (; height < 2; height += 0.1) {
                safe_case.bend(height);
                safe_case.morph();
                if (safe_case.has_wanted_resolves()) break;
            }
            if (!safe_case.has_wanted_resolves())
                throw std::runtime_error(mesh_case.name() + ": no movement takes four solutions");
            auto const whole = in_turn([&] { safe_case.solve(); }, [&] { safe_case.morph(); });
            auto const again =
                in_turn([&] { safe_case.solve(); }, [&] { safe_case.solve_again(); });
            double const solution = least(whole.first), safe = least(whole.second),
                         part = least(again.second);
            table.add({mesh_case.name(),
                       {height, "%.2f"},
                       count(safe_case.report().steps),
                       {safe_case.report().min_quality, "%.3f"},
                       seconds(solution),
                       seconds(part),
                       seconds(safe),
                       ratio(safe / solution),
                       ratio(wanted_resolves * part / solution)});
        }
    table.notes.push_back(
        "20 conformal functions, warm, in turn, the least of each. solution: analysis, plan, "
        "factor "
        "and functions. of which the four: four times factor and functions.");
    table.notes.push_back(others.text());
    report.finish(table);
}

}  // namespace bench
