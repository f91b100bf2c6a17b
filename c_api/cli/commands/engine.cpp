#include <harmorph_study.h>
#include "commands/engine.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <ostream>

namespace cli {

const Option agglomeration_option = {"--agglomeration", "RULE",
                                     "of fas: auto (default), along strong couplings where cells "
                                     "are stretched; isotropic; directional"};

std::vector<Option> engine_options() {
    return {
        {"--engine", "ENGINE",
         "direct (default): the fastest; multigrid: conjugate gradients, less memory on large "
         "meshes;\n"
         "fas: the iteration of the paper, slow (the last two with laplace and weighted)"},
        {"--precision", "P",
         "of the direct engine's factor: double (default), or single: half the memory, refined in "
         "double"},
        {"--levels", "N",
         "multigrid and fas: levels at most (default: all there are, 5 or 6 at 10k "
         "points)"},
        agglomeration_option,
        {"--start", "START", "of fas: fmg (default), level by level from the coarsest, or zero"},
        {"--cycle", "CYCLE",
         "of fas: paper (default), V-cycles with plain corrections; improved, W-cycles with "
         "smoothed\n"
         "corrections of optimal length"},
        {"--history", "F.csv",
         "multigrid and fas: the largest residual of all functions, cycle by cycle",
         FileUse::output}};
}

void set_agglomeration(const Arguments& arguments, SolveOptions& options) {
    options.agglomeration =
        arguments.choice("--agglomeration", {{"auto", HM_AGGLOMERATE_AUTO},
                                             {"isotropic", HM_AGGLOMERATE_ISOTROPIC},
                                             {"directional", HM_AGGLOMERATE_DIRECTIONAL}});
}

void set_engine(const Arguments& arguments, SolveOptions& options) {
    options.engine = arguments.choice(
        "--engine", {{"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}, {"fas", HM_FAS}});
    options.precision =
        arguments.choice("--precision", {{"double", HM_DOUBLE}, {"single", HM_SINGLE}});
    if (options.engine != HM_DIRECT && arguments.has("--precision"))
        arguments.refuse("--precision needs --engine direct");
    set_agglomeration(arguments, options);
    options.start =
        arguments.choice("--start", {{"fmg", HM_START_COARSEST}, {"zero", HM_START_ZERO}});
    options.cycle =
        arguments.choice("--cycle", {{"paper", HM_CYCLE_PAPER}, {"improved", HM_CYCLE_IMPROVED}});
    for (const char* option : {"--agglomeration", "--start", "--cycle"}) {
        if (options.engine != HM_FAS && arguments.has(option))
            arguments.refuse(std::string(option) + " needs --engine fas");
    }
    if (arguments.has("--levels")) options.levels = arguments.whole("--levels", 0, 1, 20);
    for (const char* option : {"--levels", "--history"}) {
        if (options.engine == HM_DIRECT && arguments.has(option)) {
            arguments.refuse(std::string(option) + " needs --engine multigrid or fas");
        }
    }
}

void write_history(std::ostream& out, const std::vector<double>& residuals,
                   std::int32_t iterations) {
    const std::size_t n = std::min(residuals.size(), static_cast<std::size_t>(iterations) + 1);
    out << "cycle,residual\n";
    for (std::size_t cycle = 0; cycle < n; ++cycle)
        out << cycle << ',' << exact(residuals[cycle]) << '\n';
}

}  // namespace cli
