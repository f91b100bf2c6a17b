// A progress bar on standard error, drawn if standard error is a terminal.
#pragma once

namespace cli {

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

}  // namespace cli
