// The program harmorph. From here on upwards every error is an exception; here it becomes a
// sentence and an exit code.
#include "basics/failure.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"

#include <harmorph.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

namespace {

using namespace cli;

int complain(ExitCode code, const std::string& message) {
    print_error(message);
    return code;
}

void run(const std::vector<std::string>& words) {
    if (hm_abi_version() != HM_ABI)
        throw Failure(exit_unusable, "the program and its library are of different versions");
    run_command(words);
    if (std::fflush(stdout) != 0) {
        // A command that has written its files has done its work.
        const bool is_closed = errno == EPIPE || errno == EBADF;
        if (is_closed && has_written_files()) return;
        throw Failure(exit_file,
                      std::string("standard output cannot be written: ") + std::strerror(errno));
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run({argv + (argc > 0 ? 1 : 0), argv + argc});
        return exit_done;
    } catch (const Failure& failure) {
        return complain(failure.code(), failure.what());
    } catch (const std::bad_alloc&) {
        return complain(exit_unusable, "not enough memory");
    } catch (const std::exception& error) {
        return complain(exit_unusable, error.what());
    }
}
