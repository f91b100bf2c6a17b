#include "sampling/sample_folder.hpp"

#include "basics/failure.hpp"
#include "basics/output_file.hpp"
#include "basics/text_file.hpp"
#include "formats/format.hpp"
#include "sampling/crc32.hpp"

#include <cstdio>
#include <filesystem>

namespace cli {

namespace {

namespace fs = std::filesystem;

std::string numbered(std::int64_t number, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%0*lld", digits, static_cast<long long>(number));
    return text;
}

// Tells whether an option does not change the files of the set.
bool is_incidental(const std::string& option) {
    return option == "-o" || option == "--threads" || option == "--json";
}

}  // namespace

std::string settings_of_set(const Arguments& arguments, const std::vector<Option>& options) {
    std::string text = std::string("harmorph ") + hm_version() + " sample\n";
    for (const NamedFile& file : arguments.files()) {
        const TextFile content(mesh_file(file.path));
        text += "file " + file.name + " " + std::to_string(content.text().size()) + " bytes " +
                std::to_string(crc32_of(0, content.text().data(), content.text().size())) + "\n";
    }
    for (const Option& option : options) {
        if (is_incidental(option.name) || option.use != FileUse::none) continue;
        for (const std::string& value : arguments.all(option.name))
            text += std::string("option ") + option.name + (option.value ? " " + value : "") + "\n";
    }
    return text;
}

std::string SampleFolder::shard_file(std::int64_t shard, const char* ending) const {
    return file("shards/" + numbered(shard, 5) + ending);
}

std::string SampleFolder::mesh_of(std::int64_t design, const std::string& ending) const {
    return file("meshes/" + numbered(design + 1, 7) + ending);
}

std::string SampleFolder::vtk_of(std::int64_t design) const {
    return file("vtk/" + numbered(design + 1, 7) + ".vtu");
}

void SampleFolder::make(const std::string& folder) const {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Failure(exit_file, folder + ": cannot be made: " + error.message());
}

// Removes temporary files of OutputFile that are left if a program is killed.
void SampleFolder::remove_parts(const std::string& folder) const {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        const std::size_t ending = name.rfind(".part");
        const bool is_hexadecimal =
            ending != std::string::npos && ending > 0 && name.size() > ending + 5 &&
            name.find_first_not_of("0123456789abcdef", ending + 5) == std::string::npos;
        std::error_code ignored;
        if (is_hexadecimal && entry.is_regular_file(ignored)) fs::remove(entry.path(), ignored);
    }
}

void SampleFolder::open(const std::string& settings, bool has_meshes, bool has_vtk) {
    std::error_code error;
    const std::string set = file("set.txt");
    if (fs::exists(set, error)) {
        if (TextFile(set).text() != settings)
            throw Failure(exit_usage, path_ +
                                          " has designs of other options or files (see its "
                                          "set.txt): name another folder");
    } else if (fs::exists(file("shards"), error)) {
        throw Failure(exit_usage,
                      path_ + " has a folder `shards` but no set.txt: name another folder");
    }
    make(file("shards"));
    if (has_meshes) make(file("meshes"));
    if (has_vtk) make(file("vtk"));
    for (const char* const folder : {"", "shards", "meshes", "vtk"}) remove_parts(file(folder));
    if (fs::exists(set, error)) return;
    OutputFiles files;
    files.add(set) << settings;
    files.commit();
}

std::int64_t SampleFolder::complete_shards() const {
    std::error_code error;
    std::int64_t n = 0;
    while (fs::exists(arrays_of(n + 1), error) && fs::exists(table_of(n + 1), error)) ++n;
    return n;
}

}  // namespace cli
