#include "commands/used_files.hpp"

#include "basics/output_file.hpp"
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

}  // namespace

void refuse_overwriting(const Arguments& arguments) {
    const std::vector<NamedFile> inputs = inputs_of(arguments);
    std::vector<NamedFile> outputs;
    for (const NamedFile& file : arguments.files()) {
        if (!is_output(file)) continue;
        refuse_inputs(arguments, file, inputs);
        for (const NamedFile& other : outputs) refuse_same(arguments, file, other);
        outputs.push_back(file);
    }
}

void refuse_overwriting(const Arguments& arguments, const NamedFile& output) {
    refuse_inputs(arguments, output, inputs_of(arguments));
}

}  // namespace cli
