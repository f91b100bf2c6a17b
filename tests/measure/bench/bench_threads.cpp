// One thread and several in turn, from the mesh to the functions: no peer, whose threads would wait
// beside ours.
#include "clock.hpp"
#include "ours.hpp"
#include "settings.hpp"

#include <cli/files/threads.hpp>

#include <stdexcept>

namespace bench {
namespace {

// The least time of each phase over all runs, and of whole runs, with the calls in between.
struct Least {
    Phases phases;
    double whole = 0;
    int runs = 0;

    void include(Phases const& run, double seconds) {
        auto take = [&](double& least, double found) {
            least = runs == 0 ? found : std::min(least, found);
        };
        for (double Phases::*phase :
             {&Phases::structure, &Phases::ordering, &Phases::symbolic, &Phases::assembly,
              &Phases::factor, &Phases::solve, &Phases::residual})
            take(phases.*phase, run.*phase);
        take(whole, seconds);
        ++runs;
    }
};

void run_once(Ours& ours, Least& least) {
    Stopwatch watch;
    Phases const phases = ours.run();
    least.include(phases, watch.seconds());
}

}  // namespace

void bench_threads(Settings const& settings, Report& report) {
    if (settings.threads < 2)
        throw std::runtime_error("compares one thread with --threads N: 2 or more");
    Table table{"One thread and " + std::to_string(settings.threads) +
                    " in turn [ms], the least of all runs",
                {"mesh", "nodes", "functions", "threads", "structure", "ordering", "symbolic",
                 "assembly", "factor", "solve", "residual", "mesh to basis", "ratio"},
                {},
                {}};
    table.begin();
    hm_executor alone = *settings.executor;
    alone.run = nullptr;
    alone.n_threads = 1;
    Others others;
    for (std::string const& kind : settings.kinds) {
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            for (Index const functions : settings.functions) {
                Workspace workspace;  // in turn, so that both have the same memory
                Ours one(mesh_case, workspace, functions, &alone),
                    all(mesh_case, workspace, functions, settings.executor);
                Least least[2], warm;
                run_once(one, warm);
                run_once(all, warm);
                int const usual = size < 50000 ? 60 : size < 500000 ? 30 : 7;
                int const repeats = settings.repeats > 0 ? settings.repeats : usual;
                for (int k = 0; k < repeats; ++k) {
                    run_once(one, least[0]);
                    run_once(all, least[1]);
                }
                for (int several = 0; several < 2; ++several) {
                    Phases const& p = least[several].phases;
                    table.add({mesh_case.name(),
                               count(static_cast<double>(mesh_case.mesh.x.size())),
                               count(functions), count(several == 0 ? 1 : settings.threads),
                               milliseconds(p.structure), milliseconds(p.ordering),
                               milliseconds(p.symbolic), milliseconds(p.assembly),
                               milliseconds(p.factor), milliseconds(p.solve),
                               milliseconds(p.residual), milliseconds(least[several].whole),
                               ratio(least[0].whole / least[several].whole)});
                }
            }
        }
    }
    table.notes.push_back(
        "mesh to basis: with what is between the phases, and the checks of the result.");
    table.notes.push_back(others.text());
    report.finish(table);
}

}  // namespace bench
