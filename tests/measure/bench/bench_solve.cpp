// Compares this library with other direct solvers, from the matrix to the functions, on the same
// matrix and right-hand sides.
#include "clock.hpp"
#include "comparison.hpp"

namespace bench {

void bench_solve(Settings const& settings, Report& report) {
    std::string const threads = " (threads: " + std::to_string(settings.threads) + ")";
    Table against{"Ordering, symbolic pass, factorisation, solution [s]" + threads,
                  {"mesh", "functions", "ours", "peer", "analysis", "factor", "solve", "theirs",
                   "ratio", "our plan B/node", "their B/node", "our residual", "their residual"},
                  {},
                  {}};
    Table phases{
        "Our phases [s]" + threads,
        {"mesh", "nodes", "functions", "structure", "assembly", "ordering", "symbolic", "factor",
         "solve", "engine", "around %", "plan B/node", "factor B/node", "analysis B/node"},
        {},
        {}};
    Table trials{"Their orderings, tried once they are warm [s]" + threads,
                 {"mesh", "peer", "analysis", "factor", "with the first solve"},
                 {},
                 {}};
    Others others;
    int disturbed = 0;
    for (std::string const& kind : settings.kinds) {
        for (Index const size : settings.sizes) {
            say(kind + " " + std::to_string(size) + ": mesh");
            Case const mesh_case = make_case(kind, size);
            say(mesh_case.name() + ": solvers");
            Comparison comparison(mesh_case, settings);
            comparison.run();
            comparison.report_against(against);
            comparison.report_phases(phases);
            comparison.report_trials(trials);
            disturbed += comparison.disturbed();
        }
    }
    phases.notes.push_back(
        "engine = ordering + symbolic + factor + solve; symbolic includes hm_plan_init. "
        "around: structure and assembly, in % of all.");
    for (SolverPackage const& package : solver_packages())
        if (package.make == nullptr)
            against.notes.push_back(package.name + ": " + presence(package));
    against.notes.push_back(
        "Residual: the worst function's |b - A x| / |b|, with one matrix assembled here. Medians, "
        "warm.");
    against.notes.push_back(others.text());
    if (disturbed > 0)
        against.notes.push_back(std::to_string(disturbed) +
                                " runs had less than 97 % of a processor.");
    report.finish(phases);
    report.finish(trials);
    report.finish(against);
}

}  // namespace bench
