// Wall-clock time, the median of it, and whether others had the processor meanwhile.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace bench {

inline double const not_measured = std::numeric_limits<double>::quiet_NaN();

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    // The time since the last lap, or the start.
    double lap() {
        double const passed = seconds();
        start_ = Clock::now();
        return passed;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

// Processor time of the program, all threads together: programs beside this one hardly change it.
class ProcessorWatch {
public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }
    double lap() {
        double const passed = seconds();
        start_ = std::clock();
        return passed;
    }

private:
    std::clock_t start_ = std::clock();
};

// Returns the share of one processor that this program had since the start: less than 1 if other
// programs ran.
class ProcessorShare {
public:
    double value() const {
        double const wall = watch_.seconds();
        return wall > 0 ? static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC / wall : 1;
    }

private:
    std::clock_t start_ = std::clock();
    Stopwatch watch_;
};

// Returns the share of the machine that other programs had since the start; measurements beside
// them are less reliable.
class Others {
public:
    std::string text() const {
        double const wall = watch_.seconds(), busy = busy_seconds();
        if (!(busy >= 0) || wall <= 0) return "Whether other programs ran meanwhile is not known.";
        double const own = static_cast<double>(std::clock() - own_start_) / CLOCKS_PER_SEC;
        char line[128];
        std::snprintf(line, sizeof line, "Other programs had %.2f processors meanwhile.",
                      std::max(0.0, (busy - busy_start_ - own) / wall));
        return line;
    }

private:
    // The time of all processors since the start of the machine, in 1/100 s, from Linux; negative
    // if unknown.
    static double busy_seconds() {
        std::ifstream file("/proc/stat");
        std::string name;
        double user = -1, nice = 0, system = 0, idle = 0, wait = 0, interrupt = 0, soft = 0,
               stolen = 0;
        file >> name >> user >> nice >> system >> idle >> wait >> interrupt >> soft >> stolen;
        return file ? 0.01 * (user + nice + system + interrupt + soft + stolen) : -1;
    }

    Stopwatch watch_;
    std::clock_t own_start_ = std::clock();
    double busy_start_ = busy_seconds();
};

inline double median(std::vector<double> values) {
    if (values.empty()) return not_measured;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Seconds of one call: warmed up, then the median of at least 5 and at most 200 calls that fill
// `budget` seconds.
template <class Work>
double time_of(Work work, double budget = 0.3) {
    work();
    std::vector<double> seconds;
    Stopwatch whole;
    while (seconds.size() < 5 || (seconds.size() < 200 && whole.seconds() < budget)) {
        Stopwatch one;
        work();
        seconds.push_back(one.seconds());
    }
    return median(seconds);
}

inline double least(std::vector<double> const& values) {
    return values.empty() ? not_measured : *std::min_element(values.begin(), values.end());
}

// Seconds of many calls of each, in turn: what disturbs one disturbs the other. Turns last a
// millisecond at least, so that each finds what fits in a cache there; the first call of a turn
// warms up.
template <class One, class Other>
std::pair<std::vector<double>, std::vector<double>> in_turn(One one, Other other,
                                                            double budget = 1) {
    std::pair<std::vector<double>, std::vector<double>> seconds;
    auto const turn = [](auto& work, std::vector<double>& laps) {
        Stopwatch whole, watch;
        work();
        bool const is_long = watch.lap() > 1e-3;
        do {
            watch.lap();
            work();
            laps.push_back(watch.lap());
        } while (!is_long && whole.seconds() < 1e-3);
    };
    Stopwatch whole;
    for (int turns = 0; turns < 10 || (turns < 400 && whole.seconds() < budget); ++turns) {
        turn(one, seconds.first);
        turn(other, seconds.second);
    }
    return seconds;
}

// Returns the results of run(). While others have the processor too, one thread's run is repeated,
// twice at most; the least disturbed counts. disturbed: how many were so even then.
template <class Run>
auto undisturbed(Run run, int threads, int& disturbed) {
    double const enough = 0.97;
    ProcessorShare share;
    auto best = run();
    double best_share = share.value();
    for (int k = 0; k < 2 && threads == 1 && best_share < enough; ++k) {
        ProcessorShare again;
        auto another = run();
        if (again.value() <= best_share) continue;
        best_share = again.value();
        best = another;
    }
    if (threads == 1 && best_share < enough) ++disturbed;
    return best;
}

}  // namespace bench
