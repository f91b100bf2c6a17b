// Compares this library with other direct solvers, from the matrix to the functions, on the same
// matrix and right-hand sides.
#include "clock.hpp"
#include "comparison.hpp"

#include <map>

namespace bench {
namespace {

// Time per node from each size to the next of the same kind.
class Growth {
public:
    void add(Comparison const& comparison, Case const& mesh_case, Table& table) {
        for (std::size_t set = 0; set < comparison.sets(); ++set) {
            Index const functions = comparison.functions(set);
            double const per_node = comparison.our_seconds(set) / comparison.points();
            std::string const key = mesh_case.kind + " " + std::to_string(functions);
            double const before = last_.count(key) > 0 ? last_[key] : not_measured;
            table.add({mesh_case.name(),
                       count(functions),
                       {1e6 * per_node, "%.3f"},
                       ratio(per_node / before)});
            last_[key] = per_node;
        }
    }

private:
    std::map<std::string, double> last_;
};

}  // namespace

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
    Table growth{"Growth of our time per node, from each size to the next" + threads,
                 {"mesh", "functions", "us/node", "growth"},
                 {},
                 {}};
    Growth grown;
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
            grown.add(comparison, mesh_case, growth);
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
    report.finish(growth);
    report.finish(against);
}

}  // namespace bench
