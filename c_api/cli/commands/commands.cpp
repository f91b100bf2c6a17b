#include "commands/commands.hpp"

#include "basics/print.hpp"
#include "files/output_file.hpp"
#include "files/paths.hpp"
#include "formats/format.hpp"

#include <harmorph.h>

#include <algorithm>

namespace cli {

namespace {

bool is_output(const NamedFile& file) {
    return file.use == FileUse::output || file.use == FileUse::moved_mesh;
}

// The inputs first, in the order of the words; where a mesh is a folder, the files in it.
std::vector<NamedFile> inputs_of(const Arguments& arguments) {
    std::vector<NamedFile> inputs;
    for (const NamedFile& file : arguments.files()) {
        if (is_output(file)) continue;
        if (file.use != FileUse::mesh) {
            inputs.push_back(file);
            continue;
        }
        inputs.push_back({FileUse::mesh, file.name, mesh_file(file.path)});
        for (const std::string& path : files_beside_mesh(file.path))
            inputs.push_back({FileUse::input, file.name, path});
    }
    return inputs;
}

void refuse_same(const Arguments& arguments, const NamedFile& output, const NamedFile& other) {
    const std::string path =
        output.use == FileUse::moved_mesh ? mesh_file(output.path) : output.path;
    if (!is_same_file(path, other.path)) return;
    const std::string both = output.name + " " + output.path + " and " + other.name + " " +
                             other.path + " are the same file";
    arguments.refuse(both + (is_output(other) ? "; two outputs need two files"
                                              : "; an output must not replace an input"));
}

void refuse_inputs(const Arguments& arguments, const NamedFile& output,
                   const std::vector<NamedFile>& inputs) {
    bool is_first_mesh = true;
    for (const NamedFile& input : inputs) {
        const bool is_mesh_itself = input.use == FileUse::mesh && is_first_mesh;
        if (input.use == FileUse::mesh) is_first_mesh = false;
        if (output.use == FileUse::moved_mesh && is_mesh_itself) continue;
        refuse_same(arguments, output, input);
    }
}

// Outputs that are written in one format: the ending of another known format is refused, as the
// file would not contain what its name says.
struct OneFormat {
    const char *ending, *option, *content;
};
constexpr OneFormat one_format[] = {{".svg", "--svg", "an SVG picture"},
                                    {".svg", "--boundary-svg", "an SVG picture"},
                                    {".vtu", "--vtu", "a VTK XML file"},
                                    {".csv", "--csv", "a table"},
                                    {".html", "--report", "an HTML page"}};
constexpr const char* known_endings[] = {".svg", ".png",  ".jpg", ".jpeg", ".gif", ".pdf", ".eps",
                                         ".vtu", ".vtk",  ".csv", ".html", ".su2", ".msh", ".txt",
                                         ".dat", ".json", ".npz", ".tif",  ".bmp", ".ps"};

void refuse_other_ending(const Arguments& arguments, const NamedFile& file) {
    const std::string ending = ending_of(file.path);
    const bool is_known = std::find(std::begin(known_endings), std::end(known_endings), ending) !=
                          std::end(known_endings);
    for (const OneFormat& one : one_format) {
        if (file.name != one.option || !is_known || ending == one.ending) continue;
        arguments.refuse(file.name + " writes " + one.content + ", so the name of the file, " +
                         file.path + ", must end in " + one.ending);
    }
}

}  // namespace

void refuse_overwriting(const Arguments& arguments) {
    const std::vector<NamedFile> inputs = inputs_of(arguments);
    std::vector<NamedFile> outputs;
    for (const NamedFile& file : arguments.files()) {
        if (!is_output(file)) continue;
        refuse_inputs(arguments, file, inputs);
        for (const NamedFile& other : outputs) refuse_same(arguments, file, other);
        refuse_other_ending(arguments, file);
        outputs.push_back(file);
    }
}

void refuse_overwriting(const Arguments& arguments, const NamedFile& output) {
    refuse_inputs(arguments, output, inputs_of(arguments));
}

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
