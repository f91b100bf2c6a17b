// What the size queries say: bytes of analysis, plan and functions with each engine for meshes from
// small to large, and the largest mesh that fits into a given memory. Nothing is solved.
#include "ours.hpp"
#include "settings.hpp"

#include <cmath>

namespace bench {
namespace {

constexpr Engine engines[] = {{"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}};

// Bytes, asked for on one mesh.
struct Needs {
    double points = 0, analysis = 0, plan = 0, basis = 0;
    double all() const { return analysis + plan + basis; }
};

Needs ask(Case const& mesh_case, Index functions, Engine const& engine) {
    Workspace workspace;
    Ours ours(mesh_case, workspace, functions, nullptr, engine.number);
    ours.query();
    return {static_cast<double>(mesh_case.mesh.n_points()), ours.analysis_bytes(),
            ours.plan_bytes(), ours.basis_bytes()};
}

// The largest mesh whose needs are at most `bytes`, to 1 % of its points: bytes grow nearly in
// proportion to the points, so that few meshes are asked.
Needs largest(std::string const& kind, Index functions, Engine const& engine, double bytes) {
    Needs best;
    double size = 1e6;
    for (int k = 0; k < 8; ++k) {
        Case const mesh_case = make_case(kind, static_cast<Index>(size));
        say(mesh_case.name() + ": " + engine.name);
        Needs const found = ask(mesh_case, functions, engine);
        if (found.all() <= bytes && found.points > best.points) best = found;
        if (best.all() > .99 * bytes) break;
        size = .997 * found.points * bytes / found.all();
    }
    return best;
}

}  // namespace

void bench_memory(Settings const& settings, Report& report) {
    std::vector<std::string> columns{"mesh", "functions"};
    for (Engine const& engine : engines) {
        columns.push_back(std::string(engine.name) + " MB");
        columns.push_back("B/node");
    }
    Table table{"Analysis, plan and functions, from the size queries", columns, {}, {}};
    table.begin();
    for (std::string const& kind : settings.kinds) {
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            for (Index const functions : settings.functions) {
                if (functions >= mesh_case.wall_points) continue;  // no fit has so many
                std::vector<Value> row{mesh_case.name(), count(functions)};
                for (Engine const& engine : engines) {
                    Needs const needs = ask(mesh_case, functions, engine);
                    row.push_back({1e-6 * needs.all(), "%.4g"});
                    row.push_back(count(needs.all() / needs.points));
                }
                table.add(row);
            }
        }
    }
    report.finish(table);

    double const bytes = settings.gibibytes * std::pow(2, 30);
    Table largest_of{
        "The largest mesh that fits into " + std::to_string(settings.gibibytes) +
            " GiB by the size queries (computed, not run)",
        {"mesh", "functions", "engine", "points", "analysis GiB", "plan GiB", "functions GiB"},
        {},
        {}};
    if (bytes <= 0) return;
    largest_of.begin();
    for (std::string const& kind : settings.kinds) {
        for (Engine const& engine : engines) {
            Index const functions = settings.functions.back();
            Needs const found = largest(kind, functions, engine, bytes);
            auto const gibibytes = [](double n) { return Value{n / std::pow(2, 30), "%.2f"}; };
            largest_of.add({kind, count(functions), engine.name, count(found.points),
                            gibibytes(found.analysis), gibibytes(found.plan),
                            gibibytes(found.basis)});
        }
    }
    report.finish(largest_of);
}

}  // namespace bench
