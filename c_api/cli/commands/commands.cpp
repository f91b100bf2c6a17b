#include "commands/commands.hpp"

#include "basics/print.hpp"
#include "commands/used_files.hpp"
#include "formats/format.hpp"

#include <harmorph.h>

#include <algorithm>

namespace cli {

namespace {

const Command* const commands[] = {
    &demo_command,      &fit_command,     &solve_command,       &morph_command,
    &displace_command,  &adjoint_command, &export_command,      &check_command,
    &transfer_command,  &explore_command, &convert_command,     &curve_command,
    &variables_command, &sample_command,  &interpolate_command, &align_command};

constexpr const char* introduction =
    "harmorph morphs an airfoil and its mesh together: the airfoil is a B-spline, "
    "and its control points move every point\n"
    "of the mesh through functions that are solved once.\n\n"
    "Usage: harmorph COMMAND ...\n\n"
    "Commands:\n";

constexpr const char* conclusion =
    "\n"
    "  harmorph help COMMAND     says more about a command, as COMMAND --help and -h do\n"
    "  harmorph --version        prints the version\n\n"
    "Meshes are files of two dimensions, or one cell thick; a morphed mesh is the same file with "
    "other coordinates.\n"
    "Exit codes: 0 done; 1 the result is not usable (inverted cells, not\n"
    "converged) and was not written; 2 wrong usage; 3 a file cannot be read, understood or "
    "written.\n\n"
    "Examples:\n"
    "  harmorph demo demo-output\n"
    "  harmorph fit   naca0012.su2 --marker airfoil -o airfoil.curve\n"
    "  harmorph solve naca0012.su2 --curve airfoil=airfoil.curve -o airfoil.basis\n"
    "  harmorph morph naca0012.su2 airfoil.basis --move moves.txt -o morphed.su2 --svg "
    "morphed.svg\n";

std::string program_help() {
    std::string text = introduction;
    for (const Command* command : commands) {
        std::string name = std::string("  ") + command->name;
        name.resize(15, ' ');
        text += name + command->summary + '\n';
    }
    return text + conclusion + "\nFormats of meshes:\n" + format_table();
}

const Command& find_command(const std::string& name) {
    for (const Command* command : commands) {
        if (name == command->name) return *command;
    }
    std::vector<std::string> names = {"help"};
    for (const Command* command : commands) names.emplace_back(command->name);
    throw Failure(exit_usage, "the command " + in_quotes(name) + " is unknown" +
                                  did_you_mean(name, names) + "\nTry: harmorph --help");
}

}  // namespace

void run_command(const std::vector<std::string>& words) {
    if (words.empty()) throw Failure(exit_usage, "a command is missing\n\n" + program_help());
    const auto asks_for_help = [](const std::string& word) {
        return word == "--help" || word == "-h";
    };
    if (asks_for_help(words[0]) || (words[0] == "help" && words.size() == 1))
        return print("%s", program_help().c_str());
    if (words[0] == "help") return print("%s", help_text(find_command(words[1])).c_str());
    if (words[0] == "--version") return print("harmorph %s\n", hm_version());
    const Command& command = find_command(words[0]);
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    if (std::any_of(rest.begin(), rest.end(), asks_for_help))
        return print("%s", help_text(command).c_str());
    const Arguments arguments(command, rest);
    refuse_overwriting(arguments);
    command.run(arguments);
}

}  // namespace cli
