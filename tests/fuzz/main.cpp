// Random cases without libFuzzer, always the same ones.
//
//   fuzzer TARGET CASES SEED [CASE [FILE]]   cases of a seed, or one of them; the last line counts
//   them. FILE receives
//                                            the bytes that this one takes: corpus/ keeps such
//                                            files
//   fuzzer TARGET FILE...                    the cases whose bytes are in these files
//
// Built with -DLIBFUZZER there is no main here, but libFuzzer's; HARMORPH_TARGET in the environment
// names the target.
#include "failure.hpp"
#include "target.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

fuzz::Target const& target_of(const char* name) {
    for (fuzz::Target const& target : fuzz::targets)
        if (name != nullptr && std::strcmp(name, target.name) == 0) return target;
    std::fprintf(stderr, "there is no target of this name\n");
    std::exit(2);
}

}  // namespace

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
std::size_t run(fuzz::Target const& target, std::vector<unsigned char> const& bytes,
                std::string const& which, Count& count) {
    fuzz::Input input(bytes.data(), bytes.data() + bytes.size());
    try {
        ++(target.run(input) == fuzz::Outcome::done ? count.done : count.refused);
    } catch (fuzz::Failure const& failure) {
        std::printf("fuzzer %s %s: %s\n", target.name, which.c_str(), failure.what());
        ++count.failed;
    }
    return bytes.size() - input.rest().size();
}

// Bits of a counter, stirred: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number
// generators (2014).
std::uint64_t stirred(std::uint64_t bits) {
    bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ bits >> 27) * 0x94D049BB133111EBu;
    return bits ^ bits >> 31;
}

std::vector<unsigned char> bytes_of_case(unsigned seed, long number) {
    std::uint64_t counter = stirred(std::uint64_t{seed} << 32 | static_cast<unsigned>(number));
    std::vector<unsigned char> bytes(4096);
    for (std::size_t k = 0; k < bytes.size(); k += 8) {
        std::uint64_t const bits = stirred(counter += 0x9E3779B97F4A7C15u);
        for (std::size_t byte = 0; byte < 8; ++byte)
            bytes[k + byte] = static_cast<unsigned char>(bits >> 8 * byte);
    }
    return bytes;
}

}  // namespace

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
        unsigned const seed =
            argc > 3 ? static_cast<unsigned>(std::strtoul(argv[3], nullptr, 10)) : 1;
        long const first = argc > 4 ? std::strtol(argv[4], nullptr, 10) : 0,
                   last = argc > 4 ? first + 1 : cases;
        for (long k = first; k < last; ++k) {
            std::vector<unsigned char> bytes = bytes_of_case(seed, k);
            bytes.resize(
                run(target, bytes, "1 " + std::to_string(seed) + " " + std::to_string(k), count));
            if (argc > 5)
                std::ofstream(argv[5], std::ios::binary) << std::string(bytes.begin(), bytes.end());
        }
    }
    std::printf("%s: %ld cases succeed, %ld are refused\n%ld passed, %ld failed\n", target.name,
                count.done, count.refused, count.done + count.refused, count.failed);
    return count.failed > 0;
}
#endif
