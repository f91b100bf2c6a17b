// Commands of the program print results, which nobody reads in random cases.
#pragma once

#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

namespace fuzz {

// What is written to an open file, as to the standard output, goes nowhere while this exists.
class Silence {
public:
    explicit Silence(std::FILE* stream) : stream_(stream), kept_(dup(fileno(stream))) {
        std::fflush(stream_);
        int const nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, fileno(stream_));
        close(nowhere);
    }
    ~Silence() {
        std::fflush(stream_);
        dup2(kept_, fileno(stream_));
        close(kept_);
    }
    Silence(Silence const&) = delete;

private:
    std::FILE* stream_;
    int kept_;
};

}  // namespace fuzz
