#include "files/ended_reading.hpp"

#include "basics/failure.hpp"
#include "files/temporary_files.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <unistd.h>

namespace cli {

#ifndef _WIN32

namespace {

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

}  // namespace

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

}  // namespace cli
