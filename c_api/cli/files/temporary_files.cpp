#include "files/temporary_files.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
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

}  // namespace cli
