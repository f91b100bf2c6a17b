// The benchmark's command line. Run by `make bench` (run.sh), which builds it with the peers this
// machine has.
#include "peers.hpp"
#include "settings.hpp"

#include <cli/files/threads.hpp>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bench {
namespace {

char const* const usage =
    "usage: bench [--parts \"solve threads iterative iterations memory displace safe morph\"]\n"
    "             [--sizes \"10000 100000 1000000\"] [--functions \"20 60\"] [--threads N]\n"
    "             [--kinds \"iso viscous thin thinnest unstructured stretched10 stretched100 "
    "stretched1000\"]\n"
    "             [--repeats N] [--kernel 0..4] [--gibibytes N]\n";

template <class T>
std::vector<T> words(std::string const& text) {
    std::istringstream in(text);
    std::vector<T> out;
    for (T word; in >> word;) out.push_back(word);
    if (out.empty() || !in.eof()) throw std::invalid_argument("not understood: " + text);
    return out;
}

Settings read(int argc, char** argv) {
    Settings out;
    for (int k = 1; k < argc; k += 2) {
        std::string const name = argv[k];
        if (k + 1 == argc) throw std::invalid_argument(name + ": what?");
        std::string const text = argv[k + 1];
        if (name == "--parts") out.parts = words<std::string>(text);
        else if (name == "--sizes") out.sizes = words<std::int32_t>(text);
        else if (name == "--kinds") out.kinds = words<std::string>(text);
        else if (name == "--functions") out.functions = words<std::int32_t>(text);
        else if (name == "--threads") out.threads = words<int>(text)[0];
        else if (name == "--repeats") out.repeats = words<int>(text)[0];
        else if (name == "--kernel") out.kernel = words<int>(text)[0];
        else if (name == "--gibibytes") out.gibibytes = words<int>(text)[0];
        else throw std::invalid_argument("no such option: " + name);
    }
    return out;
}

// Libraries read these once, when they are loaded: so the program starts itself again with what the
// comparison needs. OpenMP's limit holds CHOLMOD, which asks for four threads, to the number given;
// waiting threads do not keep the processor from OpenBLAS's. What holds OpenBLAS back from the best
// kernels it has for this processor is taken away: the peer is to be at its best.
void start_with_environment(Settings const& settings, char** argv) {
    std::string const threads = std::to_string(settings.threads);
    char const* const limit = std::getenv("OMP_THREAD_LIMIT");
    bool const is_right = limit != nullptr && limit == threads &&
                          std::getenv("OPENBLAS_CORETYPE") == nullptr &&
                          std::getenv("OPENBLAS_L2_SIZE") == nullptr;
    if (is_right) return;
    setenv("OMP_THREAD_LIMIT", threads.c_str(), 1);
    setenv("OMP_NUM_THREADS", threads.c_str(), 1);
    setenv("OMP_WAIT_POLICY", "PASSIVE", 1);
    setenv("OPENBLAS_NUM_THREADS", threads.c_str(), 1);
    unsetenv("OPENBLAS_CORETYPE");
    unsetenv("OPENBLAS_L2_SIZE");
    execv("/proc/self/exe", argv);
    execvp(argv[0], argv);  // where there is no /proc
    throw std::runtime_error("the program cannot start itself again");
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.compare(0, 10, "model name") == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#else
    return "unknown";
#endif
}

std::string date() {
    std::time_t const now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

void run(Settings settings) {
    // Peers that allocate are to find their memory warm, as our blocks are: what is freed stays
    // with the program.
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
    cli::Threads const threads(settings.threads);
    hm_executor executor = *threads.executor();
    if (settings.kernel != HM_KERNEL_AUTO) executor.kernel = settings.kernel;
    settings.executor = &executor;
    Report report;
    report.fact("machine",
                processor() + ", " + std::to_string(sysconf(_SC_NPROCESSORS_ONLN)) + " processors");
    report.fact("date", date());
    report.fact("compiler", compiler() + ", " BENCH_FLAGS);
    report.fact("threads", std::to_string(settings.threads));
    for (SolverPackage const& package : solver_packages())
        report.fact(package.name, presence(package));
    report.fact("PETSc", iterative_peers().empty() ? "not linked" : "linked");

    // The other parts' tables speak of shares of what is measured here.
    Limits const limits = measure_machine(settings, report);
    std::string failures;
    auto part = [&](char const* name, auto measure) {
        if (!settings.has(name)) return;
        try {
            measure();
        } catch (std::runtime_error const& error) {  // the others are still worth knowing
            failures += std::string(name) + ": " + error.what() + "\n";
        }
    };
    part("solve", [&] { bench_solve(settings, report); });
    part("threads", [&] { bench_threads(settings, report); });
    part("iterative", [&] { bench_iterative(settings, report); });
    part("iterations", [&] { bench_iterations(settings, report); });
    part("memory", [&] { bench_memory(settings, report); });
    part("displace", [&] { bench_displace(settings, report); });
    part("safe", [&] { bench_safe(settings, report); });
    part("morph", [&] { bench_morph(settings, limits, report); });
    if (!failures.empty()) throw std::runtime_error(failures);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    try {
        bench::Settings const settings = bench::read(argc, argv);
        bench::start_with_environment(settings, argv);
        bench::run(settings);
        return 0;
    } catch (std::invalid_argument const& error) {
        std::fprintf(stderr, "%s\n%s", error.what(), bench::usage);
        return 2;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
