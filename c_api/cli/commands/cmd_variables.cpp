// harmorph variables: writes design variables as a map to the control points, or as movements.
#include "basics/json.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "curves/section.hpp"
#include "curves/section_movement.hpp"
#include "curves/variables_file.hpp"
#include "files/output_file.hpp"
#include "options/arguments.hpp"
#include "options/place_options.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace cli {

namespace {

// The design variables that the options of `harmorph variables` ask for.

struct MadeVariables {
    VariableMap map;
    std::vector<JsonObject> rows;  // one for each variable or mode
    std::string table;             // the text to print without --json, with the same numbers
};

std::string in_column(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::int32_t whole(const Arguments& arguments, const std::string& option, double number) {
    if (number != std::floor(number) || std::fabs(number) > 1e6)
        arguments.refuse(option + " expects whole numbers");
    return static_cast<std::int32_t>(number);
}

// Reads two whole numbers, for example those of shapes on the upper and on the lower side.
void take_pair(const Arguments& arguments, const std::string& option, std::int32_t& first,
               std::int32_t& second) {
    const std::vector<double> numbers = arguments.number_list(option);
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
        peaks = arguments.number_list("--naca");
        variables.n_upper = static_cast<std::int32_t>(peaks.size());
    }
    if (kinds != 1)
        arguments.refuse(
            "exactly one of --ffd, --cst, --hicks-henne and --naca, a movement such as --turn, or "
            "--family is needed");
    if (arguments.has("--peaks")) {
        if (variables.kind != HM_HICKS_HENNE) arguments.refuse("--peaks needs --hicks-henne");
        peaks = arguments.number_list("--peaks");
        if (peaks.size() !=
            static_cast<std::size_t>(std::max(variables.n_upper + variables.n_lower, 0))) {
            arguments.refuse("--peaks expects as many numbers as there are bumps");
        }
    }
    if (!peaks.empty()) variables.peaks = peaks.data();
    if (arguments.has("--box")) {
        const std::vector<double> box = arguments.number_list("--box");
        if (variables.kind != HM_FFD || box.size() != 4)
            arguments.refuse("--box needs --ffd and expects X,Y,X,Y");
        variables.x_min = box[0];
        variables.y_min = box[1];
        variables.x_max = box[2];
        variables.y_max = box[3];
    }
    return variables;
}

// Reads the text X,Y or X,Y,LENGTH of an option. Returns the movement at this place.
hm_movement placed(const Arguments& arguments, const std::string& option, const std::string& text,
                   std::int32_t kind) {
    auto movement = sized<hm_movement>();
    movement.kind = kind;
    std::vector<double> number;
    const std::size_t most = kind == HM_FLAP ? 3 : 2;
    if (!parse_list(text, number) || number.size() < 2 || number.size() > most ||
        (number.size() == 3 && !(number[2] > 0)))
        arguments.refuse(option +
                         (kind == HM_FLAP ? " expects X,Y or X,Y,LENGTH" : " expects a place X,Y") +
                         ", found '" + text + "'");
    movement.x = number[0];
    movement.y = number[1];
    if (number.size() == 3) movement.length = number[2];
    return movement;
}

// Returns the movements of the options, in the order in which they are applied.
std::vector<hm_movement> movements_of(const Arguments& arguments) {
    std::vector<hm_movement> movements;
    const auto add = [&](const char* option, std::int32_t kind) {
        for (const std::string& text : arguments.all(option))
            movements.push_back(placed(arguments, option, text, kind));
    };
    if (arguments.has("--camber-thickness")) {
        auto movement = sized<hm_movement>();
        movement.kind = HM_CAMBER_THICKNESS;
        take_pair(arguments, "--camber-thickness", movement.n_camber, movement.n_thickness);
        movements.push_back(movement);
    }
    if (arguments.has("--parsec")) {
        movements.push_back(sized<hm_movement>());
        movements.back().kind = HM_PARSEC;
    }
    add("--blade", HM_BLADE);
    if (movements.size() > 1)
        arguments.refuse("--camber-thickness, --parsec and --blade exclude each other");
    add("--flap", HM_FLAP);
    add("--scale", HM_SCALE);
    add("--turn", HM_ROTATE);
    if (arguments.has("--shift")) {
        movements.push_back(sized<hm_movement>());
        movements.back().kind = HM_SHIFT;
    }
    return movements;
}

MadeVariables make_linear(const Arguments& arguments, const std::string& path,
                          const CurvesView& view) {
    std::vector<double> peaks;
    const hm_variables variables = variables_of(arguments, peaks);
    const hm_section section = section_of(arguments);
    auto movement = sized<hm_movement>();
    movement.kind = HM_LINEAR;
    movement.variables = &variables;
    MadeVariables made;
    VariableMap& map = made.map;
    auto result = sized<hm_section_move>();
    hm_memory memory = {};
    call(path, hm_move_section, view.get(), &section, 1, &movement, nullptr, &result, &memory);
    map.points = view.get()->n_control;
    map.knots = checksum_of_knots(*view.get());
    map.variables = result.n_variables;
    map.matrix.resize(2 * static_cast<std::size_t>(map.points) *
                      static_cast<std::size_t>(map.variables));
    std::vector<double> error(2 * static_cast<std::size_t>(map.variables));
    result.matrix = map.matrix.data();
    result.unit_errors = error.data();
    Block work(memory.bytes);
    memory.block = work.data();
    call(path, hm_move_section, view.get(), &section, 1, &movement, nullptr, &result, &memory);
    made.table = "variable  error on the curve (rms, largest), per unit\n";
    for (std::size_t j = 0; j < static_cast<std::size_t>(map.variables); ++j) {
        made.table += in_column(std::to_string(j + 1), 10) + in_column(brief(error[2 * j]), 11) +
                      brief(error[2 * j + 1]) + '\n';
        made.rows.push_back(
            JsonObject().add("rms_error", error[2 * j]).add("max_error", error[2 * j + 1]));
    }
    return made;
}

MadeVariables make_movements(const std::string& path, const CurvesView& view,
                             const hm_section& section, const std::vector<hm_movement>& movements) {
    MadeVariables made;
    made.map.points = view.get()->n_control;
    made.map.movements = movements;
    made.map.section = section;
    std::vector<std::string> names;
    for (const hm_movement& movement : movements) {
        const std::vector<std::string> own = value_names(movement);
        names.insert(names.end(), own.begin(), own.end());
    }
    made.map.variables = static_cast<std::int32_t>(names.size());
    MovedSection at;
    hm_error error = {};
    const std::vector<double> zero(names.size());
    if (!move_section(*view.get(), section, movements, zero, at, error)) refuse(error, path);
    made.table = "variable  of the curve  change of\n";
    for (std::size_t j = 0; j < names.size(); ++j) {
        made.table += in_column(std::to_string(j + 1), 10) + in_column(brief(at.start[j]), 14) +
                      names[j] + '\n';
        made.rows.push_back(JsonObject().add("name", names[j]).add("start", at.start[j]));
    }
    return made;
}

MadeVariables make_family(const Arguments& arguments, const std::string& path,
                          const CurvesView& view) {
    const std::vector<std::string> family = arguments.all("--family");
    const auto n = static_cast<std::int32_t>(family.size());
    const auto length = 2 * static_cast<std::size_t>(view.get()->n_control);
    std::vector<double> members(family.size() * length), singular(family.size());
    for (std::size_t k = 0; k < family.size(); ++k) {
        const Section section = read_section(family[k]);
        for (const std::string& warning : section.warnings) warn(warning);
        const auto points = static_cast<std::int32_t>(section.x.size());
        const hm_points at = {section.x.data(), section.y.data(), 1};
        Block work;
        with_memory(work, [&](hm_memory* memory) {
            return call(family[k], hm_refit, view.get(), std::int32_t{0}, &at, points,
                        std::int32_t{section.is_loop}, std::int32_t{1}, &members[k * length],
                        nullptr, memory);
        });
    }
    std::vector<double> modes(members.size());
    auto movement = sized<hm_movement>();
    movement.kind = HM_FAMILY;
    movement.n_members = n;
    movement.members = members.data();
    movement.singular = singular.data();
    auto result = sized<hm_section_move>();
    result.derivatives = modes.data();
    Block work;
    with_memory(work, [&](hm_memory* memory) {
        return call(path, hm_move_section, view.get(), nullptr, 1, &movement, nullptr, &result,
                    memory);
    });
    std::int32_t kept = 0;
    while (kept < n && singular[static_cast<std::size_t>(kept)] > 1e-12 * singular[0]) ++kept;
    const std::int32_t asked = arguments.whole("--modes", kept, 1, 1024);
    if (asked > kept) {
        arguments.refuse("--modes " + std::to_string(asked) + ": the family has only " +
                         plural(kept, "independent mode"));
    }
    MadeVariables made;
    made.map.points = view.get()->n_control;
    made.map.knots = checksum_of_knots(*view.get());
    made.map.variables = asked;
    made.map.matrix.resize(static_cast<std::size_t>(asked) * length);
    const auto columns = static_cast<std::size_t>(asked);
    double total = 0, captured = 0;
    for (const double s : singular) total += s * s;
    made.table = "mode  singular value  share of the family so far\n";
    for (std::size_t j = 0; j < columns; ++j) {
        captured += singular[j] * singular[j];
        made.table += in_column(std::to_string(j + 1), 6) + in_column(brief(singular[j]), 16) +
                      brief(captured / total) + '\n';
        made.rows.push_back(
            JsonObject().add("singular_value", singular[j]).add("share", captured / total));
        for (std::size_t k = 0; k < length; ++k)
            made.map.matrix[2 * (k / 2 * columns + j) + k % 2] = modes[j * length + k];
    }
    return made;
}

MadeVariables make_variables(const Arguments& arguments) {
    const std::string path = arguments.operand(0);
    const Curves curves = read_curves(path);
    const CurvesView view(curves);
    const std::vector<hm_movement> movements = movements_of(arguments);
    const bool is_linear = arguments.has("--ffd") || arguments.has("--cst") ||
                           arguments.has("--hicks-henne") || arguments.has("--naca");
    const bool is_family = arguments.has("--family");
    if (is_linear + is_family + !movements.empty() > 1) {
        arguments.refuse(
            "shapes (--ffd, --cst, --hicks-henne, --naca), movements (--turn, --parsec, ...) and "
            "--family exclude each other");
    }
    if (arguments.has("--modes") && !is_family) arguments.refuse("--modes needs --family");
    if (is_family) return make_family(arguments, path, view);
    if (!movements.empty()) return make_movements(path, view, section_of(arguments), movements);
    return make_linear(arguments, path, view);
}

}  // namespace

void run_variables(const Arguments& arguments) {
    const MadeVariables made = make_variables(arguments);
    if (arguments.has("-o")) {
        OutputFiles files;
        write_variables(files.add(arguments.text("-o")), made.map);
        files.commit();
    }
    if (arguments.has("--json")) {
        const JsonObject all =
            JsonObject().add("points", made.map.points).add("variables", made.rows);
        print("%s\n", all.text().c_str());
        return;
    }
    print("%s", made.table.c_str());
    if (arguments.has("-o")) print("written   %s\n", arguments.text("-o").c_str());
}

}  // namespace cli
