#include "files/paths.hpp"

#include "basics/failure.hpp"

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace cli {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }
std::string last_name(const std::string& path) { return fs::path(path).filename().string(); }
std::string ending_of(const std::string& path) { return fs::path(path).extension().string(); }

std::string without_ending(const std::string& path) {
    return fs::path(path).replace_extension().string();
}

std::string without_gz(const std::string& path) {
    return ending_of(path) == ".gz" ? without_ending(path) : path;
}

std::string path_in(const std::string& folder, const std::string& name) {
    return (fs::path(folder) / name).string();
}

std::string normal_path(const std::string& path) {
    return fs::path(path).lexically_normal().string();
}

bool exists(const std::string& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool is_folder(const std::string& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_regular_file(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

void make_folders(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw Failure(exit_file, path + ": cannot be made: " + error.message());
}

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        std::error_code ignored;
        if (entry.is_regular_file(ignored)) names.push_back(entry.path().filename().string());
    }
    return names;
}

std::string temporary_copy(const std::string& path) {
    std::string copy = (fs::temp_directory_path() / "harmorph-XXXXXX").string();
    const int descriptor = ::mkstemp(copy.data());
    if (descriptor < 0) throw Failure(exit_file, copy + ": cannot be written");
    ::close(descriptor);
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    return copy;
}

}  // namespace cli
