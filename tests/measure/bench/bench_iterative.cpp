// The engines of harmorph beside PETSc's conjugate gradients with algebraic multigrid, in one run:
// iterations, processor time, memory, and how far the functions are from those of the direct
// engine.
#include <harmorph_study.h>
#include "clock.hpp"
#include "ours.hpp"
#include "peers.hpp"
#include "settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

constexpr Engine engines[] = {
    {"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}, {"improved FAS", HM_FAS}};

constexpr double max_points_of_fas = 150000;       // beyond, minutes for each row
constexpr double max_points_of_warm_ups = 500000;  // of peers: beyond, a run takes half a minute

struct Row {
    std::string name;
    bool is_ours;
    double setup, solution, bytes;  // seconds of processor time; bytes a point
    double whole() const { return setup + solution; }
};

double difference(Columns const& a, Columns const& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.data.size(); ++k)
        most = std::max(most, std::fabs(a.data[k] - b.data[k]));
    return most;
}

// One mesh and one number of functions, all solvers.
class Duel {
public:
    Duel(Case const& mesh_case, Laplacian const& matrix, Index functions, Settings const& settings,
         Table& table)
        : case_(mesh_case),
          matrix_(matrix),
          functions_(functions),
          settings_(settings),
          table_(table) {}

    void run() {
        for (Engine const& engine : engines) {
            if (engine.number == HM_FAS && points() > max_points_of_fas) continue;
            run_ours(engine);
        }
        for (auto const& peer : iterative_peers()) run_peer(*peer);
        tell_losses();
    }

private:
    Index points() const { return case_.mesh.n_points(); }

    void run_ours(Engine const& engine) {
        say(case_.name() + ": " + engine.name);
        Ours ours(case_, workspace_, functions_, settings_.executor, engine.number);
        ours.run();  // a warm-up
        Phases const p = ours.run(TimeKind::processor);
        Columns const values = matrix_.values_of(ours.basis(), functions_, points());
        if (direct_.data.empty()) {
            direct_ = values;
            b_.push_back(matrix_.right_hand_sides(ours.basis(), ours.fit().curves(), points()));
        }
        hm_solve_report const& report = ours.report();
        add({engine.name, true, p.ordering + p.symbolic + p.factor, p.solve,
             ours.plan_bytes() / points()},
            count(report.levels), count(report.iterations), values);
    }

    void run_peer(SolverPeer& peer) {
        if (matrix_.n > peer.largest()) return;
        say(case_.name() + ": " + peer.name());
        std::vector<Columns> x = b_;
        if (points() < max_points_of_warm_ups) peer.run(matrix_, b_, x);
        PeerTimes const times = peer.run(matrix_, b_, x);
        add({peer.name(), false, times.analysis + times.factor, times.solve[0],
             peer.bytes() / points()},
            "", count(peer.iterations()), x[0]);
    }

    void add(Row const& row, Value levels, Value iterations, Columns const& values) {
        table_.add({case_.name(), count(functions_), row.name, levels, iterations,
                    seconds(row.setup), seconds(row.solution), seconds(row.whole()),
                    count(row.bytes), residual(matrix_.worst_residual(b_[0], values)),
                    residual(difference(direct_, values))});
        rows_.push_back(row);
    }

    // Names what harmorph loses: an engine that takes more time or memory than the best peer.
    void tell_losses() {
        tell_losses("the time", [](Row const& row) { return row.whole(); });
        tell_losses("the memory", [](Row const& row) { return row.bytes; });
    }

    template <class Measure>
    void tell_losses(char const* what, Measure measure) {
        Row const* best = nullptr;
        for (Row const& row : rows_) {
            if (!row.is_ours && (best == nullptr || measure(row) < measure(*best))) best = &row;
        }
        for (Row const& row : rows_) {
            if (best == nullptr || !row.is_ours || measure(row) <= measure(*best)) continue;
            char times[16];
            std::snprintf(times, sizeof times, "%.2f", measure(row) / measure(*best));
            table_.notes.push_back("lost: " + case_.name() + ", " + std::to_string(functions_) +
                                   " functions: " + row.name + " takes " + times + " times " +
                                   what + " of " + best->name);
        }
    }

    Case const& case_;
    Laplacian const& matrix_;
    Index functions_;
    Settings const& settings_;
    Table& table_;
    Workspace workspace_;
    Columns direct_;
    std::vector<Columns> b_;
    std::vector<Row> rows_;
};

}  // namespace

void bench_iterative(Settings const& settings, Report& report) {
    Table table{"Engines, to 1e-10 (threads: " + std::to_string(settings.threads) + ")",
                {"mesh", "functions", "engine", "levels", "iterations", "set-up", "solution", "all",
                 "B/node", "residual", "from direct"},
                {},
                {}};
    table.begin();
    Others others;
    for (std::string const& kind : settings.kinds) {
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            Laplacian const matrix(mesh_case.mesh);
            for (Index const functions : settings.functions)
                Duel(mesh_case, matrix, functions, settings, table).run();
        }
    }
    table.notes.push_back(
        "Seconds of processor time, after a warm-up (of peers below 500000 points). set-up: "
        "direct: ordering, "
        "symbolic pass and factor; "
        "multigrid: levels. B/node: the plan (matrix, factor or levels, vectors); of a peer: "
        "memory "
        "in use after the solution, matrix included. Residual: the worst function's |b - A x| / "
        "|b|. FAS: up to "
        "150000 points.");
    if (iterative_peers().empty())
        table.notes.push_back("PETSc: not installed (petsc-dev), or the bench has other parts.");
    table.notes.push_back(others.text());
    report.finish(table);
}

}  // namespace bench
