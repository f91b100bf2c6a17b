#include "basics/progress.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace cli {

ProgressBar::ProgressBar() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::wipe() {
    if (drawn_percent_ >= 0) std::fputs("\r\033[K", stderr);
    drawn_percent_ = -1;
}

void ProgressBar::draw(const char* what, double fraction) {
    constexpr int width = 40;
    const int percent = static_cast<int>(100 * fraction);
    if (!is_terminal_ || percent == drawn_percent_) return;
    drawn_percent_ = percent;
    const auto filled = static_cast<std::size_t>(percent * width / 100);
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r%-13s [%s] %3d %%", what, bar.c_str(), percent);
    std::fflush(stderr);
}

namespace {

constexpr const char* phase_names[] = {"structure", "ordering", "symbolic pass", "assembly",
                                       "factor",    "solve",    "residual"};

}  // namespace

void Progress::listen(hm_options& options) {
    options.progress = on_progress;
    options.progress_user = this;
}

std::int32_t Progress::on_progress(void* self, std::int32_t phase, double fraction) {
    if (phase >= 0 && phase < n_phases) static_cast<Progress*>(self)->report(phase, fraction);
    return 0;
}

void Progress::report(std::int32_t phase, double fraction) {
    if (fraction <= 0) phase_watch_ = Stopwatch();
    seconds_[static_cast<std::size_t>(phase)] = phase_watch_.seconds();
    bar_.draw(phase_names[phase], fraction);
}

}  // namespace cli
