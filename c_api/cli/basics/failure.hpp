// Exit codes of the program, and the exception that carries a reason to main().
#pragma once

#include <stdexcept>
#include <string>

namespace cli {

enum ExitCode {
    exit_done = 0,
    exit_unusable = 1,  // the result cannot be used: inverted cells, not converged
    exit_usage = 2,     // the command line is wrong
    exit_file = 3       // a file cannot be read, understood or written
};

class Failure : public std::runtime_error {
public:
    Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

}  // namespace cli
