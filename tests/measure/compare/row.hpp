// One row of the comparison: what a method makes of a movement, the time and the memory.
#pragma once

#include "measures.hpp"
#include "motion.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace compare {

struct Row {
    bool valid = false;
    int steps = 1;
    double setup = 0;     // [s] of processor time, what is done once for a mesh
    double movement = 0;  // [s] of processor time, one movement of the mesh
    double memory = 0;    // [MB] the largest growth of the process
    Measures measures;
};

// Processor time, as the machine may have other things to do.
inline double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Moves the mesh in one step or, if that inverts cells, in max_steps steps on the mesh as it
// moves, of which each prepares the method anew.
template <class Method>
Row moved_by(const Motion& motion) {
    constexpr int max_steps = 10;
    Row row;
    std::vector<Point> at;
    for (row.steps = 1; row.steps <= max_steps; row.steps *= max_steps) {
        at = motion.start;
        const double begin = seconds();
        for (int step = 1; step <= row.steps; ++step) {
            const std::vector<Point> from = at;
            const Method method(motion, from);
            if (step == 1) row.setup = seconds() - begin;
            at = method.moved(motion.wall_at(1.0 * step / row.steps));
        }
        row.movement = seconds() - begin - row.setup;
        row.valid = motion.is_valid(at);
        if (row.valid || row.steps == max_steps) break;
    }
    row.measures = measure(motion, at);
    return row;
}

// Runs in a process of its own, so that the growth of the memory is that of this row.
template <class Run>
Row alone(const Run& run) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe can be opened");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        rusage before, after;
        getrusage(RUSAGE_SELF, &before);
        Row row = run();
        getrusage(RUSAGE_SELF, &after);
        row.memory = static_cast<double>(after.ru_maxrss - before.ru_maxrss) / 1024;
        const bool written = write(ends[1], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
        _exit(written ? 0 : 1);
    }
    Row row;
    close(ends[1]);
    const bool is_read = read(ends[0], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
    close(ends[0]);
    waitpid(child, nullptr, 0);
    if (!is_read) throw std::runtime_error("a method ended without a row");
    return row;
}

}  // namespace compare
