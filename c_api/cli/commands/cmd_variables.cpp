// harmorph variables: writes design variables as a map to the control points.
#include <harmorph_design.h>
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "basics/json.hpp"
#include "basics/library.hpp"
#include "basics/number_list.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "basics/output_file.hpp"
#include "commands/section_option.hpp"
#include "curves/variables_file.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::int32_t whole(const Arguments& arguments, const std::string& option, double number) {
    if (number != std::floor(number) || std::fabs(number) > 1e6)
        arguments.refuse(option + " expects whole numbers");
    return static_cast<std::int32_t>(number);
}

// Reads two whole numbers, for example of the upper and the lower side.
void take_pair(const Arguments& arguments, const std::string& option, std::int32_t& first,
               std::int32_t& second) {
    const std::vector<double> numbers = number_list(arguments, option);
    if (numbers.size() != 2) arguments.refuse(option + " expects two numbers");
    first = whole(arguments, option, numbers[0]);
    second = whole(arguments, option, numbers[1]);
}

hm_variables variables_of(const Arguments& arguments, std::vector<double>& peaks) {
    auto variables = sized<hm_variables>();
    std::int32_t kinds = 0;
    const auto chosen = [&](const char* option, std::int32_t kind) {
        if (!arguments.has(option)) return false;
        variables.kind = kind;
        ++kinds;
        return true;
    };
    if (chosen("--ffd", HM_FFD))
        take_pair(arguments, "--ffd", variables.degree_x, variables.degree_y);
    if (chosen("--cst", HM_CST))
        take_pair(arguments, "--cst", variables.n_upper, variables.n_lower);
    if (chosen("--hicks-henne", HM_HICKS_HENNE)) {
        take_pair(arguments, "--hicks-henne", variables.n_upper, variables.n_lower);
    }
    if (chosen("--naca", HM_NACA4)) {
        peaks = number_list(arguments, "--naca");
        variables.n_upper = static_cast<std::int32_t>(peaks.size());
    }
    if (kinds != 1)
        arguments.refuse("exactly one of --ffd, --cst, --hicks-henne and --naca is needed");
    if (arguments.has("--peaks")) {
        if (variables.kind != HM_HICKS_HENNE) arguments.refuse("--peaks needs --hicks-henne");
        peaks = number_list(arguments, "--peaks");
        if (peaks.size() !=
            static_cast<std::size_t>(std::max(variables.n_upper + variables.n_lower, 0))) {
            arguments.refuse("--peaks expects as many numbers as there are bumps");
        }
    }
    if (!peaks.empty()) variables.peaks = peaks.data();
    if (arguments.has("--box")) {
        const std::vector<double> box = number_list(arguments, "--box");
        if (variables.kind != HM_FFD || box.size() != 4)
            arguments.refuse("--box needs --ffd and expects X,Y,X,Y");
        variables.x_min = box[0];
        variables.y_min = box[1];
        variables.x_max = box[2];
        variables.y_max = box[3];
    }
    return variables;
}

void run_variables(const Arguments& arguments) {
    const std::string path = arguments.operand(0);
    const Curves curves = read_curves(path);
    const CurvesView view(curves);
    std::vector<double> peaks;
    const hm_variables variables = variables_of(arguments, peaks);
    const hm_section section = section_of(arguments);
    VariableMap map;
    std::size_t bytes = 0;
    call(path, hm_variables_size, view.get(), &section, &variables, &map.variables, &bytes);
    map.points = curves.points();
    map.matrix.resize(2 * static_cast<std::size_t>(map.points) *
                      static_cast<std::size_t>(map.variables));
    std::vector<double> error(2 * static_cast<std::size_t>(map.variables));
    Block work(bytes);
    call(path, hm_variables_map, view.get(), &section, &variables, static_cast<void*>(work.data()),
         bytes, map.matrix.data(), error.data());
    if (arguments.has("-o")) {
        OutputFiles files;
        write_variables(files.add(arguments.text("-o")), map);
        files.commit();
    }
    std::vector<JsonObject> rows;
    if (!arguments.has("--json")) print("variable  error on the curve (rms, largest), per unit\n");
    for (std::size_t j = 0; j < static_cast<std::size_t>(map.variables); ++j) {
        if (!arguments.has("--json")) {
            print("%-9zu %-10s %s\n", j + 1, brief(error[2 * j]).c_str(),
                  brief(error[2 * j + 1]).c_str());
        }
        rows.push_back(
            JsonObject().add("rms_error", error[2 * j]).add("max_error", error[2 * j + 1]));
    }
    if (arguments.has("--json")) {
        print("%s\n", JsonObject().add("points", map.points).add("variables", rows).text().c_str());
    } else if (arguments.has("-o")) {
        print("written   %s\n", arguments.text("-o").c_str());
    }
}

}  // namespace

const Command variables_command = {
    "variables",
    {{"CURVE", FileUse::input}},
    "Design variables (FFD, CST, Hicks-Henne, NACA) as a map to the control points",
    "Writes what one unit of each variable does to each control point: the least-squares "
    "approximation of the wanted\n"
    "movement of the outline, whose error is printed. `harmorph morph --variables` moves meshes by "
    "values of the\n"
    "variables. Shapes are in chords, normal to the chord; the nodes of an FFD box move by dx, dy "
    "themselves.\n",
    {{"--ffd", "I,J",
      "free-form deformation: a box of degrees I along x and J along y, (I+1)(J+1) nodes"},
     {"--cst", "N,M", "class and shape functions: N of the upper and M of the lower side"},
     {"--hicks-henne", "N,M", "bumps: N of the upper and M of the lower side"},
     {"--naca", "P[,P..]",
      "NACA's four digits: a camber line for each position P of the largest camber, then "
      "thickness"},
     {"--box", "X,Y,X,Y",
      "of --ffd: lower left and upper right corner (default: a little more than the control "
      "points)"},
     {"--peaks", "P[,P..]", "of --hicks-henne: where the bumps are largest, 0 to 1"},
     chord_option,
     {"-o", "MAP", "file to write", FileUse::output},
     {"--json", nullptr,
      "print one JSON object: points, variables (rms_error, max_error of each)"}},
    "  harmorph variables airfoil.curve --cst 6,6 -o cst.map\n"
    "  harmorph morph mesh.su2 airfoil.basis --variables cst.map --move values.txt -o "
    "morphed.su2\n",
    run_variables};

}  // namespace cli
