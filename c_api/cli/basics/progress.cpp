#include "basics/progress.hpp"

#include <cstdint>

namespace cli {

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
