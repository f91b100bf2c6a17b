#include "basics/output_file.hpp"

#include "basics/failure.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <sstream>

namespace cli {

namespace {

namespace fs = std::filesystem;

// The file at the end of a chain of symbolic links, whether it exists or not: a link stays a link
// when the file is replaced.
fs::path target_of(fs::path path) {
    constexpr int longest_chain = 40;
    std::error_code error;
    for (int links = 0; links < longest_chain && fs::is_symlink(path, error); ++links) {
        const fs::path next = fs::read_symlink(path, error);
        if (error) break;
        path = path.parent_path() / next;
    }
    return path;
}

// One spelling for all paths to a file that need not exist.
fs::path one_spelling(const std::string& path) {
    std::error_code error;
    const fs::path target = fs::absolute(target_of(path), error);
    const fs::path folder = fs::weakly_canonical(target.parent_path(), error);
    return error ? target : folder / target.filename();
}

// Beside the final place, so that the renaming stays on one disk.
std::string temporary_name(const std::string& path) {
    std::ostringstream name;
    name << path << ".part" << std::hex << std::random_device()();
    return name.str();
}

}  // namespace

// Devices and pipes must not be renamed over: they are written to directly.
bool is_device(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool is_same_file(const std::string& path, const std::string& other) {
    if (is_device(path) || is_device(other)) return false;
    std::error_code ignored;
    return fs::equivalent(path, other, ignored) || one_spelling(path) == one_spelling(other);
}

OutputFile::OutputFile(const std::string& path)
    : path_(is_device(path) ? path : target_of(path).string()) {
    std::error_code ignored;
    if (fs::is_directory(path_, ignored))
        throw Failure(exit_file, path + ": cannot be written: it is a directory");
    const std::string opened = is_device(path_) ? path_ : temporary_name(path_);
    stream_.open(opened, std::ios::binary | std::ios::trunc);
    if (!stream_) fail();
    if (opened != path_) temporary_ = opened;
}

OutputFile::~OutputFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::remove(temporary_.c_str());
}

void OutputFile::finish() {
    if (!stream_.is_open()) return;
    if (!stream_.flush()) fail();
    stream_.close();
    if (!stream_) fail();
}

void OutputFile::commit() {
    finish();
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
    temporary_.clear();
}

void OutputFile::fail() const {
    throw Failure(exit_file, path_ + ": cannot be written: " + std::strerror(errno));
}

void OutputFiles::commit() {
    for (OutputFile& file : files_) file.finish();
    for (OutputFile& file : files_) file.commit();
}

}  // namespace cli
