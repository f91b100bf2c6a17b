#include "commands/commands.hpp"

#include "basics/print.hpp"
#include "commands/used_files.hpp"
#include "formats/format.hpp"

#include <harmorph.h>

#include <algorithm>

namespace cli {

namespace {

struct Command {
    const char* name;
    void (*run)(const Arguments&);
};
constexpr Command commands[] = {
    {"demo", run_demo},           {"fit", run_fit},           {"solve", run_solve},
    {"morph", run_morph},         {"displace", run_displace}, {"adjoint", run_adjoint},
    {"export", run_export},       {"check", run_check},       {"transfer", run_transfer},
    {"explore", run_explore},     {"convert", run_convert},   {"curve", run_curve},
    {"variables", run_variables}, {"sample", run_sample},     {"interpolate", run_interpolate},
    {"align", run_align}};

std::string command_table() {
    std::string table;
    for (const Command& command : commands)
        table += help_line(command.name, command_text(command.name).summary, 15);
    return table;
}

// The text harmorph.txt, in which two lines stand for the tables.
std::string program_help() {
    std::string text(embedded_text("harmorph"));
    const auto fill_in = [&text](const std::string& line, const std::string& table) {
        text.replace(text.find(line), line.size(), table);
    };
    fill_in("COMMANDS\n", command_table());
    fill_in("FORMATS\n", format_table());
    return text;
}

const Command& find_command(const std::string& name) {
    std::vector<std::string> names = {"help"};
    for (const Command& command : commands) {
        if (name == command.name) return command;
        names.emplace_back(command.name);
    }
    throw Failure(exit_usage, "the command " + in_quotes(name) + " is unknown" +
                                  did_you_mean(name, names) + "\nTry: harmorph --help");
}

std::string help_of(const Command& command) { return help_text(command_text(command.name)); }

// Prints the line that --paper stands for; beside an object of JSON, as a message.
void print_written_out(const Arguments& arguments) {
    const std::string line = arguments.written_out();
    if (line.empty()) return;
    if (arguments.has("--json")) print_error("the same as: " + line);
    else print("%s\n", line.c_str());
}

}  // namespace

void run_command(const std::vector<std::string>& words) {
    if (words.empty()) throw Failure(exit_usage, "a command is missing\n\n" + program_help());
    const auto asks_for_help = [](const std::string& word) {
        return word == "--help" || word == "-h";
    };
    if (asks_for_help(words[0]) || (words[0] == "help" && words.size() == 1))
        return print("%s", program_help().c_str());
    if (words[0] == "help") return print("%s", help_of(find_command(words[1])).c_str());
    if (words[0] == "--version") return print("harmorph %s\n", hm_version());
    const Command& command = find_command(words[0]);
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    if (std::any_of(rest.begin(), rest.end(), asks_for_help))
        return print("%s", help_of(command).c_str());
    const CommandText text = command_text(command.name);
    const Arguments arguments(text, rest);
    refuse_overwriting(arguments);
    print_written_out(arguments);
    command.run(arguments);
}

}  // namespace cli
