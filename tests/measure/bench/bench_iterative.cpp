// The engines that iterate against the direct one: iterations, seconds, memory, and how far their
// functions are apart.
#include <harmorph_study.h>
#include "ours.hpp"
#include "settings.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

struct Engine {
    char const* name;
    std::int32_t number;
};
constexpr Engine engines[] = {
    {"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}, {"improved FAS", HM_FAS}};

// Beyond, minutes for each row.
constexpr double most_points_of_fas = 300000;

double difference(hm_basis const* a, hm_basis const* b, Index functions, std::size_t points) {
    std::vector<double> x(points), y(points);
    hm_error error{};
    double most = 0;
    for (Index function = 0; function < functions; ++function) {
        require(hm_basis_values(a, function, 0, x.data(), &error), error, "hm_basis_values");
        require(hm_basis_values(b, function, 0, y.data(), &error), error, "hm_basis_values");
        for (std::size_t k = 0; k < points; ++k) most = std::max(most, std::fabs(x[k] - y[k]));
    }
    return most;
}

}  // namespace

void bench_iterative(Settings const& settings, Report& report) {
    Table table{"Engines, to 1e-10 (threads: " + std::to_string(settings.threads) +
                    ", functions in blocks of 4)",
                {"mesh", "functions", "engine", "levels", "iterations", "work", "seconds",
                 "plan B/node", "residual", "from direct"},
                {},
                {}};
    table.begin();
    Index const functions = settings.functions[0];
    for (std::string const& kind : settings.kinds) {
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            double const points = mesh_case.mesh.n_points();
            Workspace workspace;
            Ours direct(mesh_case, workspace, functions, settings.executor);
            for (Engine const& engine : engines) {
                if (engine.number == HM_FAS && points > most_points_of_fas) continue;
                say(mesh_case.name() + ": " + engine.name);
                Ours iterative(mesh_case, workspace, functions, settings.executor, engine.number);
                Ours& ours = engine.number == HM_DIRECT ? direct : iterative;
                Phases const once = ours.run();
                hm_solve_report const& measured = ours.report();
                double const apart = engine.number == HM_DIRECT
                                         ? 0
                                         : difference(direct.basis(), ours.basis(), functions,
                                                      mesh_case.mesh.x.size());
                table.add({mesh_case.name(), count(functions), engine.name, count(measured.levels),
                           count(measured.iterations), count(measured.work), seconds(once.engine()),
                           count(ours.plan_bytes() / points), residual(measured.residual),
                           residual(apart)});
            }
        }
    }
    table.notes.push_back(
        "Seconds: direct: ordering, symbolic pass, factor and solution; others: levels and "
        "solution. One cold "
        "run, so only roughly.");
    table.notes.push_back("Improved FAS: up to 300000 points.");
    report.finish(table);
}

}  // namespace bench
