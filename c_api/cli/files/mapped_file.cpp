#include "files/mapped_file.hpp"

#include "basics/failure.hpp"
#include "files/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#if !defined(_WIN32) && !defined(HARMORPH_READS_FILES)
#define HARMORPH_MAPS_FILES

#include <sys/mman.h>
#endif

namespace cli {

namespace {

// Files that are mapped into memory. If another program shortens such a file, the next access
// behind the new end is a signal (SIGBUS): the program then removes its temporary files, names the
// file on standard error, and ends with exit code 3.

#ifndef _WIN32

// The handler may run at any time, so it reads arrays of fixed size only. A mapping for which there
// is no slot is not watched: its file has no name in the message.
struct Mapping {
    std::atomic<const char*> begin;
    std::atomic<std::size_t> size;
    std::array<char, 1024> path;
};
std::array<Mapping, 64> all_mappings;

void say(const char* text) {
    const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
}

extern "C" void end_reading(int, siginfo_t* info, void*) {
    const char* const at = static_cast<const char*>(info->si_addr);
    const char* path = "a file";
    for (const Mapping& mapping : all_mappings) {
        const char* const begin = mapping.begin;
        if (begin != nullptr && at >= begin && at < begin + mapping.size)
            path = mapping.path.data();
    }
    remove_temporaries();
    say("harmorph: ");
    say(path);
    say(": cannot be read: another program has made the file shorter meanwhile\n");
    _exit(exit_file);
}

void watch_once() {
    static const bool listening = [] {
        struct sigaction action = {};
        action.sa_sigaction = end_reading;
        action.sa_flags = SA_SIGINFO;
        sigemptyset(&action.sa_mask);
        sigaction(SIGBUS, &action, nullptr);
        return true;
    }();
    static_cast<void>(listening);
}

void watch_mapping(const void* begin, std::size_t size, const std::string& path) {
    watch_once();
    for (Mapping& mapping : all_mappings) {
        if (mapping.begin != nullptr || path.size() >= mapping.path.size()) continue;
        std::memcpy(mapping.path.data(), path.c_str(), path.size() + 1);
        mapping.size = size;
        mapping.begin = static_cast<const char*>(begin);
        return;
    }
}

void forget_mapping(const void* begin) {
    for (Mapping& mapping : all_mappings) {
        if (mapping.begin == static_cast<const char*>(begin)) mapping.begin = nullptr;
    }
}

#endif

#ifdef O_BINARY
constexpr int as_bytes = O_RDONLY | O_BINARY;
#else
constexpr int as_bytes = O_RDONLY;
#endif

class Opened {
public:
    explicit Opened(const std::string& path) : path_(path), number_(open(path.c_str(), as_bytes)) {
        if (number_ < 0) fail();
    }
    ~Opened() { close(number_); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

    int number() const { return number_; }
    [[noreturn]] void fail() const {
        throw Failure(exit_file, path_ + ": cannot be read: " + std::strerror(errno));
    }

private:
    const std::string& path_;
    int number_;
};

}  // namespace

MappedFile::MappedFile(const std::string& path) {
    const Opened file(path);
    struct stat status;
    if (fstat(file.number(), &status) != 0) file.fail();
    const bool is_regular = (status.st_mode & S_IFMT) == S_IFREG && status.st_size > 0;
#ifdef HARMORPH_MAPS_FILES
    if (is_regular) {
        size_ = static_cast<std::size_t>(status.st_size);
        mapped_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number(), 0);
        if (mapped_ != MAP_FAILED) {
            watch_mapping(mapped_, size_, path);
            return;
        }
        mapped_ = nullptr;
    }
#endif
    // One byte more than a regular file has tells that the file has ended.
    constexpr std::size_t at_first = 1 << 16;
    std::size_t room = is_regular ? static_cast<std::size_t>(status.st_size) + 1 : at_first;
    for (size_ = 0;;) {
        if (size_ == read_.size()) {
            read_.resize(room);
            room = 2 * read_.size();
        }
        const ssize_t more = read(file.number(), &read_[size_], read_.size() - size_);
        if (more < 0 && errno != EINTR) file.fail();
        if (more == 0) return;
        if (more > 0) size_ += static_cast<std::size_t>(more);
    }
}

MappedFile::~MappedFile() {
#ifdef HARMORPH_MAPS_FILES
    if (mapped_ == nullptr) return;
    forget_mapping(mapped_);
    munmap(mapped_, size_);
#endif
}

}  // namespace cli
