#include "comparison.hpp"

#include "clock.hpp"

#include <stdexcept>

namespace bench {
namespace {

Index const largest_for_many =
    2000000;  // points with more than 20 functions: beyond, 32 GB would not do
double const near_best =
    1.3;  // what took longer than this many times the best in its trial is not measured

template <class Runs, class Value>
double median_of(Runs const& runs, Value value) {
    std::vector<double> values;
    for (auto const& run : runs) values.push_back(value(run));
    return median(values);
}

}  // namespace

Comparison::Comparison(Case const& mesh_case, Settings const& settings)
    : case_(mesh_case), settings_(settings), matrix_(mesh_case.mesh) {
    for (Index const functions : settings.functions) {
        if (functions > 20 && points() > largest_for_many) continue;
        ours_.push_back(
            std::make_unique<Ours>(mesh_case, workspace_, functions, settings.executor));
        Ours& ours = *ours_.back();
        ours.run();
        b_.push_back(matrix_.right_hand_sides(ours.basis(), ours.fit().curves(), points()));
        x_.push_back(b_.back());
    }
    our_runs_.resize(ours_.size());
}

int Comparison::repeats() const {
    if (settings_.repeats > 0) return settings_.repeats;
    return points() < 50000 ? 15 : points() < 500000 ? 5 : 3;
}

// Turn by turn, so that both sides see the same machine.
void Comparison::run() {
    for (SolverPackage const& package : solver_packages())
        if (package.make != nullptr) choose(package);
    for (int k = 0; k < repeats(); ++k) {
        for (std::size_t set = 0; set < sets(); ++set)
            our_runs_[set].push_back(
                undisturbed([&] { return ours_[set]->run(); }, settings_.threads, disturbed_));
        for (Candidate& candidate : candidates_) run_peer(candidate);
    }
}

void Comparison::run_peer(Candidate& candidate) {
    auto const run = [&] { return candidate.peer->run(matrix_, b_, x_); };
    candidate.runs.push_back(undisturbed(run, settings_.threads, disturbed_));
    if (!candidate.residual.empty()) return;
    for (std::size_t set = 0; set < sets(); ++set)
        candidate.residual.push_back(matrix_.worst_residual(b_[set], x_[set]));
}

// Tries all orderings and ways to use threads, once the package's memory is warm.
void Comparison::choose(SolverPackage const& package) {
    double best = 0;
    bool is_warm = false;
    std::vector<Candidate> found;
    for (std::unique_ptr<SolverPeer>& peer : package.make(settings_.threads)) {
        std::unique_ptr<SolverPeer> solver = std::move(peer);
        if (solver->largest() < matrix_.n || is_hopeless(package, *solver, best)) continue;
        if (!is_warm) try_out(package, *solver);
        is_warm = true;
        Trial const trial = try_out(package, *solver);
        trials_.push_back(trial);
        if (!trial.error.empty() || (best > 0 && trial.whole > near_best * best)) continue;
        if (best == 0 || trial.whole < best) best = trial.whole;
        found.push_back({package.name, std::move(solver), trial.whole, {}, {}});
    }
    for (Candidate& candidate : found)
        if (candidate.trial <= near_best * best) candidates_.push_back(std::move(candidate));
}

// Small systems are tried several times: one run says little about them.
Comparison::Trial Comparison::try_out(SolverPackage const& package, SolverPeer& peer) {
    Trial trial{peer.name(),  package.name, peer.ordering(), "",
                not_measured, not_measured, not_measured};
    std::vector<PeerTimes> runs;
    try {
        for (int k = 0; k < (points() < 500000 ? 3 : 1); ++k)
            runs.push_back(peer.run(matrix_, b_, x_));
    } catch (std::runtime_error const& error) {
        trial.error = error.what();
        return trial;
    }
    trial.analysis = median_of(runs, [](PeerTimes const& run) { return run.analysis; });
    trial.factor = median_of(runs, [](PeerTimes const& run) { return run.factor; });
    trial.whole = median_of(runs, [](PeerTimes const& run) { return run.whole(0); });
    return trial;
}

// The ordering of this package alone took longer than all of another package.
bool Comparison::is_hopeless(SolverPackage const& package, SolverPeer const& peer,
                             double best) const {
    for (Trial const& trial : trials_) {
        bool const same = trial.package == package.name && trial.ordering == peer.ordering();
        if (best > 0 && same && trial.analysis > best) return true;
    }
    return false;
}

double Comparison::Candidate::seconds(std::size_t set) const {
    return median_of(runs, [&](PeerTimes const& run) { return run.whole(set); });
}

double Comparison::our_seconds(std::size_t set) const {
    return median_of(our_runs_[set], [](Phases const& run) { return run.engine(); });
}

void Comparison::report_phases(Table& table) const {
    for (std::size_t set = 0; set < sets(); ++set) {
        Phases const p = medians(our_runs_[set]);
        Ours const& ours = *ours_[set];
        table.add({case_.name(), count(points()), count(ours.functions()), seconds(p.structure),
                   seconds(p.assembly), seconds(p.ordering), seconds(p.symbolic), seconds(p.factor),
                   seconds(p.solve), seconds(p.engine()),
                   percent(p.around() / (p.around() + p.engine())),
                   count(ours.plan_bytes() / points()), count(8 * ours.factor_entries() / points()),
                   count(ours.analysis_bytes() / points())});
    }
}

void Comparison::report_against(Table& table) const {
    for (std::size_t set = 0; set < sets(); ++set) {
        double const ours = our_seconds(set), our_bytes = ours_[set]->plan_bytes() / points();
        Columns const our_values = matrix_.values_of(ours_[set]->basis(), functions(set), points());
        double const our_residual = matrix_.worst_residual(b_[set], our_values);
        for (SolverPackage const& package : solver_packages()) {
            Candidate const* best = nullptr;
            for (Candidate const& candidate : candidates_) {
                bool const is_its = candidate.package == package.name;
                if (is_its && (best == nullptr || candidate.seconds(set) < best->seconds(set)))
                    best = &candidate;
            }
            if (best == nullptr) continue;
            auto part = [&](auto value) { return seconds(median_of(best->runs, value)); };
            table.add({case_.name(), count(functions(set)), seconds(ours), best->peer->name(),
                       part([](PeerTimes const& run) { return run.analysis; }),
                       part([](PeerTimes const& run) { return run.factor; }),
                       part([&](PeerTimes const& run) { return run.solve[set]; }),
                       seconds(best->seconds(set)), ratio(best->seconds(set) / ours),
                       count(our_bytes), count(best->peer->bytes() / points()),
                       residual(our_residual), residual(best->residual[set])});
        }
    }
}

void Comparison::report_trials(Table& table) const {
    for (Trial const& trial : trials_)
        table.add({case_.name(), trial.error.empty() ? trial.name : trial.error,
                   seconds(trial.analysis), seconds(trial.factor), seconds(trial.whole)});
}

}  // namespace bench
