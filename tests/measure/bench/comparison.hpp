// One mesh, all solvers: warmed up, run turn by turn, the medians put into tables.
#pragma once

#include "ours.hpp"
#include "peers.hpp"
#include "settings.hpp"

namespace bench {

class Comparison {
public:
    // Our first runs, which are the warm-up and give the right-hand sides, are made here.
    Comparison(Case const& mesh_case, Settings const& settings);
    void run();

    void report_phases(Table& table) const;
    void report_against(
        Table& table) const;  // of each package what was fastest with these functions
    void report_trials(Table& table) const;

    std::size_t sets() const { return ours_.size(); }
    Index functions(std::size_t set) const { return ours_[set]->functions(); }
    Index points() const { return case_.mesh.n_points(); }
    // Ordering, symbolic pass, factorisation and solution: the median.
    double our_seconds(std::size_t set) const;
    // Runs that are in the medians though others had a part of the processor.
    int disturbed() const { return disturbed_; }

private:
    // A peer that was found fast enough to be measured.
    struct Candidate {
        std::string package;
        std::unique_ptr<SolverPeer> peer;
        double trial = 0;  // seconds with the first set
        std::vector<PeerTimes> runs;
        std::vector<double> residual;

        double seconds(std::size_t set) const;
    };
    struct Trial {
        std::string name, package, ordering, error;
        double analysis = 0, factor = 0, whole = 0;
    };

    Case const& case_;
    Settings const& settings_;
    Laplacian matrix_;
    Workspace workspace_;
    std::vector<std::unique_ptr<Ours>> ours_;  // one for each number of functions
    std::vector<Columns> b_, x_;               // likewise; x_: what a peer has just solved
    std::vector<std::vector<Phases>> our_runs_;
    std::vector<Candidate> candidates_;
    std::vector<Trial> trials_;
    int disturbed_ = 0;

    int repeats() const;
    void choose(SolverPackage const& package);
    bool is_hopeless(SolverPackage const& package, SolverPeer const& peer, double best) const;
    Trial try_out(SolverPackage const& package, SolverPeer& peer);
    void run_peer(Candidate& candidate);
};

}  // namespace bench
