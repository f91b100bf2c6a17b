// The arguments, the present attempt and the goals that the strategies of a safe morph share.
#pragma once

#include "safe/safe_morph.hpp"

namespace harmorph {

struct SafeMorph::Work {
    Plan& plan;
    Basis const& basis;
    SafeOptions const& options;
    const Basis* derivative;
    SafeReport& report;
    Fault& fault;
    Outcome attempt;  // of the present mesh
    // The derivative belongs to the best mesh, and not to a later attempt.
    bool derivative_of_best = true;
    bool factored_again = false;
    // The part of the movement that the present strategies aim at.
    Real aim = 1;
    // The solutions of the functions before these strategies began.
    Index resolves_before = 0;
    // The largest part of the movement is searched for, and any mesh that is_usable() will do; the
    // steps go on from the best mesh.
    bool searches = false;
    // The largest part of the movement whose mesh was not usable.
    Real farthest_poor = 0;
    // No solution is made after so many.
    Index last_solution = SafeOptions::max_solutions;

    Mesh const& mesh() const noexcept { return plan.mesh(); }
    OrientedMesh const& cells() const noexcept { return plan.equations().cells(); }
    Executor const& executor() const noexcept { return plan.executor(); }
    Outcome& best() const noexcept { return report.outcome; }

    Index resolves() const noexcept { return report.resolves - resolves_before; }
    bool arrives(Outcome const& outcome) const noexcept { return outcome.fraction >= aim; }
    Index solutions_left() const noexcept {
        return max(last_solution - report.solutions(), Index{0});
    }
    Real goal() const noexcept { return options.min_quality * report.start_quality; }
    // Returns the quality in parts of the quality asked for; 1 is enough.
    Real score(Outcome const& outcome) const noexcept {
        Real const quality = goal() > 0 ? outcome.min_quality / goal() : 1;
        return min(min(quality, options.max_height_change / outcome.height_change), 1.0);
    }
    // Returns false if the mesh is short of the target and has less than the quality asked for.
    // Such a mesh is of less use than one that is good after a smaller part of the movement. With a
    // derivative, which only follows whole steps, the largest part counts.
    bool is_usable(Outcome const& outcome) const noexcept {
        return outcome.fraction >= 1 || derivative != nullptr || outcome.min_quality >= goal();
    }
    // Notes a mesh that was found, for the reason of a movement that ends before its target.
    void note(Outcome const& outcome) noexcept {
        if (!is_usable(outcome)) farthest_poor = max(farthest_poor, outcome.fraction);
    }
    bool is_good(Outcome const& outcome) const noexcept {
        return arrives(outcome) && (searches ? is_usable(outcome) : score(outcome) >= 1);
    }
    // Returns whether the mesh is so good that no further strategy is tried.
    bool is_fair(Outcome const& outcome) const noexcept {
        return is_good(outcome) &&
               (searches || outcome.min_quality >= options.fair_quality * report.start_quality);
    }
    bool is_fine(Outcome const& outcome) const noexcept {
        return is_good(outcome) &&
               outcome.min_quality >= options.fine_quality * report.start_quality &&
               outcome.mean_quality >= options.fine_quality * report.start_mean;
    }
    bool is_better(Outcome const& one, Outcome const& other) const noexcept {
        if (is_usable(one) != is_usable(other)) return is_usable(one);
        if (one.fraction != other.fraction) return one.fraction > other.fraction;
        if (score(one) != score(other)) return score(one) > score(other);
        return one.min_quality > other.min_quality;
    }
};

}  // namespace harmorph
