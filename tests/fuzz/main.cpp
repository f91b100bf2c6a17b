// Random cases without libFuzzer, always the same ones.
//
//   fuzzer TARGET CASES SEED [CASE [FILE]]   cases of a seed, or one of them; the last line counts them. FILE receives
//                                            the bytes that this one takes: corpus/ keeps such files
//   fuzzer TARGET FILE...                    the cases whose bytes are in these files
//
// Built with -DLIBFUZZER there is no main here, but libFuzzer's; HARMORPH_TARGET in the environment names the target.
#include "failure.hpp"
#include "target.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {

fuzz::Target const& target_of(const char* name) {
    for (fuzz::Target const& target : fuzz::targets)
        if (name != nullptr && std::strcmp(name, target.name) == 0) return target;
    std::fprintf(stderr, "there is no target of this name\n");
    std::exit(2);
}

}   // namespace

#ifdef LIBFUZZER
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    static fuzz::Target const& target = target_of(std::getenv("HARMORPH_TARGET"));
    fuzz::Input input(data, data + size);
    target.run(input);
    return 0;
}
#else
namespace {

struct Count {
    long done = 0, refused = 0, failed = 0;
};

// Returns how many bytes the case takes.
std::size_t run(fuzz::Target const& target, std::vector<unsigned char> const& bytes, std::string const& which,
                Count& count) {
    fuzz::Input input(bytes.data(), bytes.data() + bytes.size());
    try {
        ++(target.run(input) == fuzz::Outcome::done ? count.done : count.refused);
    } catch (fuzz::Failure const& failure) {
        std::printf("fuzzer %s %s: %s\n", target.name, which.c_str(), failure.what());
        ++count.failed;
    }
    return bytes.size() - input.rest().size();
}

std::vector<unsigned char> bytes_of_case(unsigned seed, long number) {
    std::seed_seq seeds{seed, static_cast<unsigned>(number)};
    std::mt19937 random(seeds);
    std::vector<unsigned char> bytes(4096);
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
    return bytes;
}

}   // namespace

int main(int argc, char** argv) {
    fuzz::Target const& target = target_of(argc > 1 ? argv[1] : nullptr);
    Count count;
    char* end = nullptr;
    long const cases = argc > 2 ? std::strtol(argv[2], &end, 10) : 1000;
    if (argc > 2 && *end != '\0') {
        for (int k = 2; k < argc; ++k) {
            std::ifstream file(argv[k], std::ios::binary);
            run(target, {std::istreambuf_iterator<char>(file), {}}, argv[k], count);
        }
    } else {
        unsigned const seed = argc > 3 ? static_cast<unsigned>(std::strtoul(argv[3], nullptr, 10)) : 1;
        long const first = argc > 4 ? std::strtol(argv[4], nullptr, 10) : 0, last = argc > 4 ? first + 1 : cases;
        for (long k = first; k < last; ++k) {
            std::vector<unsigned char> bytes = bytes_of_case(seed, k);
            bytes.resize(run(target, bytes, "1 " + std::to_string(seed) + " " + std::to_string(k), count));
            if (argc > 5)
                std::ofstream(argv[5], std::ios::binary) << std::string(bytes.begin(), bytes.end());
        }
    }
    std::printf("%s: %ld cases succeed, %ld are refused\n%ld passed, %ld failed\n", target.name, count.done,
                count.refused, count.done + count.refused, count.failed);
    return count.failed > 0;
}
#endif
