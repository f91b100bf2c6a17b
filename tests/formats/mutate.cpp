// Reads mesh files that are cut off, or have some bytes changed, and writes what can be read with
// other coordinates. Each must be read or refused with the file's name and a reason; sanitizers see
// the rest. Random, but always the same.
//
//   mutate SCRATCH TIMES FILES...
//
// A file of an OpenFOAM case is changed where it is, as the others are read beside it.
#include "basics/failure.hpp"
#include "formats/format.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

namespace {

std::string read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void change(std::string& bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    if (below(3) == 0) return bytes.resize(below(bytes.size()));
    // Sizes stand at the beginning of most files.
    const std::size_t range =
        below(2) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 200);
    for (std::size_t n = 1 + below(4); n > 0; --n) {
        static const char other[] = "0123456789-. \n$=\0\xff\x7f";
        bytes[below(range)] =
            below(2) == 0 ? other[below(sizeof other - 1)] : static_cast<char>(below(256));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string scratch = argv[1];
    const int times = std::atoi(argv[2]);
    int read = 0, refused = 0, failed = 0;
    std::mt19937 random(1);
    for (int file = 3; file < argc; ++file) {
        const std::string path = argv[file], whole = read_whole(path);
        const std::size_t folder = path.find("polyMesh/");
        const bool is_foam = folder != std::string::npos;
        const std::string copy = is_foam ? path : scratch + path.substr(path.find_last_of('.'));
        const std::string points = is_foam ? path.substr(0, folder + 9) + "points" : copy;
        const std::string named =
            is_foam ? path.substr(0, folder + 8) : copy;  // what a message must begin with
        for (int time = 0; time < times; ++time) {
            std::string bytes = whole;
            change(bytes, random);
            std::ofstream(copy, std::ios::binary) << bytes;
            try {
                cli::ReadOptions options;
                options.threads = time % 3 + 1;
                if (path.find("zones") != std::string::npos) options.zone = "2";
                const cli::Mesh mesh = cli::read_mesh_file(points, options);
                std::vector<double> x = mesh.x, y = mesh.y;
                for (double& value : x) value += .125;
                std::ostringstream out;
                cli::write_moved(out, mesh, x.data(), y.data());
                ++read;
            } catch (const cli::Failure& failure) {
                const std::string text = failure.what();
                const bool says =
                    text.compare(0, named.size(), named) == 0 && text.size() > named.size() + 10;
                if (!says)
                    std::printf("%s, change %d: no place or reason: %s\n", argv[file], time,
                                text.c_str());
                ++(says ? refused : failed);
            } catch (const std::exception& error) {
                std::printf("%s, change %d: %s\n", argv[file], time, error.what());
                ++failed;
            }
        }
        if (is_foam) std::ofstream(path, std::ios::binary) << whole;
    }
    std::printf("%d read, %d refused\n", read, refused);
    return failed > 0 || read == 0 || refused == 0;
}
