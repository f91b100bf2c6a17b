// The energy of Improvement and its derivatives, for the corners of a few cells at a time.
#pragma once

#include "safe/quality_energy.hpp"
#include "safe/targets.hpp"

namespace harmorph {

// Each corner has the energy 1 / q^2, with the quality q relative to the target, and if the power
// is not 0 also (least / Q)^(2 power), with the quality Q that the library reports. The functions
// are those that NewtonSystem::assemble_lists() calls.
struct CornerEnergies {
    static constexpr Index max_cells = CornerList::max_count / 4;
    // Curvatures are raised to this part of the curvature of scaling at the target; rotation, which
    // changes nothing at the target, has this curvature, too.
    static constexpr Real min_curvature = 0.02;

    Targets const& targets;
    QualityKernels const& kernels;
    Points at;
    Index power, taken = 0;
    CornerList relative, ideal;
    CornerForms by_relative, by_ideal;

    CornerEnergies(Targets const& of_cells, Kernel kernel, Points points,
                   Index power_of_ideal) noexcept
        : targets(of_cells), kernels(quality_kernels(kernel)), at(points), power(power_of_ideal) {
        ideal.power = power;
    }
    void clear() noexcept { taken = relative.n = ideal.n = 0; }
    void add(Index cell, CornerPoints const& point) noexcept {
        Targets::Cell const& target = targets.cell[cell];
        Triangle const now = triangle_of(point, at);
        Real const share = targets.share(cell);
        relative.add(now, targets.of(cell, point), target.any_ratio, share, 1);
        if (power == 0) return;
        ideal.add(now, targets.ideal(cell, point), target.is_quad && !target.is_part, share,
                  target.wanted * target.wanted);
    }
    void differentiate() noexcept {
        kernels.differentiate(relative, min_curvature, by_relative);
        if (power > 0) kernels.differentiate(ideal, min_curvature, by_ideal);
    }
    void next(Index, CornerPoints const&, CornerForm& form) noexcept {
        by_relative.add_to(form, taken);
        if (power > 0) by_ideal.add_to(form, taken);
        ++taken;
    }
    Real energy() noexcept {
        Real each[CornerList::max_count];
        Real const sum = kernels.energies(relative, each);
        return power > 0 ? sum + kernels.energies(ideal, each) : sum;
    }
};

}  // namespace harmorph
