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

// A link's target is replaced, not the link.
std::string real_path(const std::string& path) {
    std::error_code ignored;
    const fs::path target =
        fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : fs::path(path);
    return target.empty() ? path : target.string();
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

OutputFile::OutputFile(const std::string& path) : path_(is_device(path) ? path : real_path(path)) {
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
