// A bar on standard error when that is a terminal; else nothing.
#pragma once

namespace cli {

class ProgressBar {
public:
    ProgressBar();
    ~ProgressBar() { wipe(); }
    ProgressBar(const ProgressBar&) = delete;

    void draw(const char* what, double fraction);
    void wipe();  // takes the bar away

private:
    bool is_terminal_;
    int drawn_percent_ = -1;
};

}  // namespace cli
