#include "commands/used_files.hpp"

#include "files/output_file.hpp"
#include "files/paths.hpp"
#include "formats/format.hpp"

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

}  // namespace cli
