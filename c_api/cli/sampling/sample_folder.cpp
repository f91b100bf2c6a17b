#include "sampling/sample_folder.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "files/output_file.hpp"
#include "files/paths.hpp"
#include "files/text_file.hpp"
#include "formats/format.hpp"
#include "formats/vtu.hpp"
#include "sampling/npz.hpp"

namespace cli {

namespace {

// Tells whether an option does not change the files of the set.
bool is_incidental(const std::string& option) {
    return option == "-o" || option == "--threads" || option == "--json";
}

}  // namespace

std::string settings_of_set(const Arguments& arguments) {
    std::string text = std::string("harmorph ") + hm_version() + " sample\n";
    for (const NamedFile& file : arguments.files()) {
        const TextFile content(mesh_file(file.path));
        text += "file " + file.name + " " + std::to_string(content.text().size()) + " bytes " +
                std::to_string(crc32_of(0, content.text().data(), content.text().size())) + "\n";
    }
    for (const Option& option : arguments.options()) {
        if (is_incidental(option.name) || option.use != FileUse::none) continue;
        for (const std::string& value : arguments.all(option.name))
            text += "option " + option.name + (option.value.empty() ? "" : " " + value) + "\n";
    }
    return text;
}

std::string SampleFolder::shard_file(std::int64_t shard, const char* ending) const {
    return file("shards/" + padded(shard, 5, '0') + ending);
}

std::string SampleFolder::mesh_of(std::int64_t design, const std::string& ending) const {
    return file("meshes/" + padded(design + 1, 7, '0') + ending);
}

std::string SampleFolder::vtk_of(std::int64_t design) const {
    return file("vtk/" + padded(design + 1, 7, '0') + ".vtu");
}

namespace {

// Tells whether the name is that of a file of a set before OutputFile renames the file: for
// example 00003.npz.part1a2b. `is_of_set` judges the name without this ending.
template <class Judge>
bool is_part_of(const std::string& name, const Judge& is_of_set) {
    const std::size_t ending = name.rfind(".part");
    return ending != std::string::npos && name.size() > ending + 5 &&
           name.find_first_not_of("0123456789abcdef", ending + 5) == std::string::npos &&
           is_of_set(name.substr(0, ending));
}

// Tells whether the name begins with this many digits, followed by a dot.
bool is_numbered(const std::string& name, std::size_t digits) {
    return name.size() > digits && name[digits] == '.' &&
           name.find_first_not_of("0123456789") == digits;
}

bool is_of_folder(const std::string& name) {
    return name == "set.txt" || name == "designs.csv" || name == "index.html" ||
           name == "README.md";
}

// Removes the files of a set that a run left under temporary names when it was killed. All other
// files stay, whatever their names are.
template <class Judge>
void remove_parts(const std::string& folder, const Judge& is_of_set) {
    for (const std::string& name : files_in(folder)) {
        if (is_part_of(name, is_of_set)) std::remove(path_in(folder, name).c_str());
    }
}

}  // namespace

void SampleFolder::open(const std::string& settings, bool has_meshes, bool has_vtk) {
    owned_.emplace(path_, "set.txt");
    const std::string set = file("set.txt");
    if (!exists(set)) {
        OutputFiles files;
        files.add(set) << settings;
        files.commit();
    } else if (TextFile(set).text() != settings) {
        throw Failure(exit_usage, path_ +
                                      " has designs of other options or files (see its set.txt): "
                                      "name another folder");
    }
    make_folders(file("shards"));
    if (has_meshes) make_folders(file("meshes"));
    if (has_vtk) make_folders(file("vtk"));
    const auto is_shard = [](const std::string& name) { return is_numbered(name, 5); };
    const auto is_design = [](const std::string& name) {
        return is_numbered(name, 7) || name == "series.pvd";
    };
    remove_parts(path_, is_of_folder);
    remove_parts(file("shards"), is_shard);
    if (has_meshes) remove_parts(file("meshes"), is_design);
    if (has_vtk) remove_parts(file("vtk"), is_design);
}

std::int64_t SampleFolder::complete_shards() const {
    std::int64_t n = 0;
    while (exists(arrays_of(n + 1)) && exists(table_of(n + 1))) ++n;
    return n;
}

namespace {

std::string all_endings_of(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1, dot = path.find('.', name);
    return dot == std::string::npos ? "" : path.substr(dot);
}

}  // namespace

DesignFiles::DesignFiles(const Arguments& arguments, const Mesh& mesh)
    : mesh_(mesh),
      ending_(all_endings_of(arguments.operand(0))),
      has_meshes_(arguments.has("--meshes")),
      has_vtk_(arguments.has("--vtk")) {
    const bool is_folder = mesh_file(arguments.operand(0)) != arguments.operand(0);
    if (has_meshes_ && is_folder)
        arguments.refuse("--meshes: a mesh in a folder cannot be written many times");
}

void DesignFiles::write(const SampleFolder& folder, const MorphedDesign& design,
                        std::int64_t number) const {
    if (!has_meshes_ && !has_vtk_) return;
    Field moved(mesh_.x.size());
    for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
        moved.x[k] = design.coordinates[2 * k];
        moved.y[k] = design.coordinates[2 * k + 1];
    }
    OutputFiles files;
    if (has_meshes_)
        write_moved(files, mesh_, folder.mesh_of(number, ending_), moved.x.data(), moved.y.data());
    if (has_vtk_) {
        Field displacement(mesh_.x.size());
        for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
            displacement.x[k] = moved.x[k] - mesh_.x[k];
            displacement.y[k] = moved.y[k] - mesh_.y[k];
        }
        write_vtu(files.add(folder.vtk_of(number)), mesh_, moved.x, moved.y,
                  {displacement_data(displacement)});
    }
    files.commit();
}

}  // namespace cli
