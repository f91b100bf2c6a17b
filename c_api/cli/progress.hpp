// Listens to the library's progress: seconds of each phase, and a bar on standard error when that is a terminal.
#pragma once

#include "harmorph.h"
#include "stopwatch.hpp"

#include <array>

namespace cli {

class Progress {
public:
    Progress();
    ~Progress() { wipe(); }
    Progress(const Progress&) = delete;

    void listen(hm_options& options);
    void wipe(); // takes the bar away
    double seconds(std::int32_t phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

private:
    static constexpr std::int32_t n_phases = HM_PHASE_RESIDUAL + 1;

    static std::int32_t on_progress(void* self, std::int32_t phase, double fraction);
    void report(std::int32_t phase, double fraction);
    void draw(std::int32_t phase, double fraction);

    std::array<double, n_phases> seconds_ = {}; // of each phase's latest run
    Stopwatch phase_watch_;
    bool has_bar_;
    int drawn_percent_ = -1;
};

} // namespace cli
