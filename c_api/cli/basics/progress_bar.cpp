#include "basics/progress_bar.hpp"

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

}  // namespace cli
