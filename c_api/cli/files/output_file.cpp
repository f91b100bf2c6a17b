#include "files/output_file.hpp"

#include "basics/failure.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace cli {

namespace {

// The handler may run at any time, so it reads arrays of fixed size only. A name that is too long,
// or for which there is no slot, is not remembered: the file then stays after a signal.
struct Slot {
    std::atomic<bool> is_used;
    std::array<char, 4096> path;
};
std::array<Slot, 32> all_slots;
std::atomic<bool> signals_wait;
std::atomic<int> waiting;  // the signal that has come meanwhile, or 0

constexpr int ending_signals[] = {
    SIGINT,  SIGTERM,
#ifdef SIGHUP
    SIGHUP,  SIGQUIT, SIGPIPE,
#endif
#ifdef SIGXCPU
    SIGXCPU, SIGXFSZ,
#endif
};

extern "C" void remove_and_end(int signal) {
    if (signals_wait) {
        waiting = signal;
        return;
    }
    remove_temporaries();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void listen_once() {
    static const bool listening = [] {
        for (const int signal : ending_signals) {
            const auto before = std::signal(signal, remove_and_end);
            if (before != SIG_DFL) std::signal(signal, before);
        }
        return true;
    }();
    static_cast<void>(listening);
}

}  // namespace

void remove_temporaries() {
    for (const Slot& slot : all_slots) {
        if (slot.is_used) unlink(slot.path.data());
    }
}

void remember_temporary(const std::string& path) {
    listen_once();
    for (Slot& slot : all_slots) {
        if (slot.is_used || path.size() >= slot.path.size()) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.is_used = true;
        return;
    }
}

void forget_temporary(const std::string& path) {
    for (Slot& slot : all_slots) {
        if (slot.is_used && path == slot.path.data()) slot.is_used = false;
    }
}

SignalsWait::SignalsWait() { signals_wait = true; }

SignalsWait::~SignalsWait() {
    signals_wait = false;
    if (waiting != 0) remove_and_end(waiting);
}

namespace {

namespace fs = std::filesystem;

bool files_are_written = false;

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

// The temporary file lies beside the final place, so that the renaming stays on one disk.
std::string temporary_name(const std::string& path, const char* kind) {
    std::ostringstream name;
    name << path << kind << std::hex << std::random_device()();
    return name.str();
}

// Copies owner and group, or the group alone, as far as the system allows that.
void copy_owner(const std::string& from, const std::string& to) {
#ifndef _WIN32
    struct stat owned;
    if (stat(from.c_str(), &owned) != 0) return;
    if (chown(to.c_str(), owned.st_uid, owned.st_gid) == 0) return;
    if (chown(to.c_str(), static_cast<uid_t>(-1), owned.st_gid) == 0) return;
#else
    static_cast<void>(from);
    static_cast<void>(to);
#endif
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
    const fs::file_status before = fs::status(path_, ignored);
    if (fs::is_directory(before))
        throw Failure(exit_file, path + ": cannot be written: it is a directory");
    if (is_device(path_)) {
        stream_.open(path_, std::ios::binary | std::ios::trunc);
        if (!stream_) fail();
        return;
    }
    temporary_ = temporary_name(path_, ".part");
    remember_temporary(temporary_);
    if (fs::exists(before)) {
        permissions_ = static_cast<unsigned>(before.permissions() & fs::perms::all);
        create_privately();
    }
    stream_.open(temporary_, std::ios::binary | std::ios::trunc);
    if (!stream_) fail();
}

// Only the owner may read the new file until it has the permissions of the file that it replaces.
void OutputFile::create_privately() const {
    constexpr int owner_reads_and_writes = 0600;
    const int file = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, owner_reads_and_writes);
    if (file < 0 || close(file) != 0) fail();
}

OutputFile::~OutputFile() {
    keep();
    if (temporary_.empty()) return;
    stream_.close();
    std::remove(temporary_.c_str());
    forget_temporary(temporary_);
}

void OutputFile::finish() {
    if (!stream_.is_open()) return;
    if (!stream_.flush()) fail_to_write();
    stream_.close();
    if (!stream_) fail();
    if (temporary_.empty() || !permissions_) return;
    copy_owner(path_, temporary_);
    std::error_code error;
    fs::permissions(temporary_, static_cast<fs::perms>(*permissions_), error);
    if (error) fail();
}

void OutputFile::replace(bool may_be_undone) {
    if (temporary_.empty()) return;
    if (may_be_undone && permissions_) {
        older_ = temporary_name(path_, ".older");
        std::error_code error;
        fs::create_hard_link(path_, older_, error);
        if (error) older_.clear();  // some file systems have no links
    }
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
    forget_temporary(temporary_);
    temporary_.clear();
    has_replaced_ = true;
}

void OutputFile::undo() noexcept {
    if (!has_replaced_) return;
    has_replaced_ = false;
    if (!permissions_) {
        std::remove(path_.c_str());
    } else if (!older_.empty() && std::rename(older_.c_str(), path_.c_str()) == 0) {
        older_.clear();
    }
}

void OutputFile::keep() noexcept {
    if (!older_.empty()) std::remove(older_.c_str());
    older_.clear();
}

void OutputFile::fail() const {
    throw Failure(exit_file, path_ + ": cannot be written: " + std::strerror(errno));
}

// After the first failure a stream does not try again, and other calls have changed errno since:
// the reason is that of another attempt.
void OutputFile::fail_to_write() {
    stream_.clear();
    errno = 0;
    stream_.put('\n').flush();
    if (errno == 0) throw Failure(exit_file, path_ + ": cannot be written: the disk was full");
    fail();
}

std::ostream& OutputFiles::add(const std::string& path) {
    for (const OutputFile& other : files_) {
        if (is_same_file(other.path(), path))
            throw Failure(exit_usage, path + ": two outputs need two files");
    }
    return files_.emplace_back(path).stream();
}

// Signals wait between the first and the last renaming.
void OutputFiles::commit() {
    for (OutputFile& file : files_) file.finish();
    const SignalsWait until_the_end;
    try {
        for (OutputFile& file : files_) file.replace(files_.size() > 1);
    } catch (const Failure&) {
        for (OutputFile& file : files_) file.undo();
        throw;
    }
    for (OutputFile& file : files_) file.keep();
    if (files_.empty()) return;
    files_are_written = true;
#ifdef SIGPIPE
    // From here on nobody need read what the command says.
    std::signal(SIGPIPE, SIG_IGN);
#endif
}

bool has_written_files() { return files_are_written; }

}  // namespace cli
