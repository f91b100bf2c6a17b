// Listens to the library's progress: seconds of each phase, and a bar.
#pragma once

#include <harmorph_study.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

namespace cli {

// Time measurement.

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

// There must be at least one value.
inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// A progress bar on standard error, drawn if standard error is a terminal.

class ProgressBar {
public:
    ProgressBar();
    ~ProgressBar() { wipe(); }
    ProgressBar(const ProgressBar&) = delete;

    void draw(const char* what, double fraction);
    void wipe();  // removes the bar

private:
    bool is_terminal_;
    int drawn_percent_ = -1;
};

class Progress {
public:
    Progress() = default;
    Progress(const Progress&) = delete;

    void listen(hm_options& options);
    void wipe() { bar_.wipe(); }  // removes the bar
    double seconds(std::int32_t phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

private:
    static constexpr std::int32_t n_phases = HM_PHASE_RESIDUAL + 1;

    static std::int32_t on_progress(void* self, std::int32_t phase, double fraction);
    void report(std::int32_t phase, double fraction);

    std::array<double, n_phases> seconds_ = {};  // the last run of each phase
    Stopwatch phase_watch_;
    ProgressBar bar_;
};

}  // namespace cli
