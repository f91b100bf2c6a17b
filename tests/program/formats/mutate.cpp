// Reads mesh files that are cut off, have some bytes changed, or have empty lists, and writes what
// can be read with other coordinates. Each must be read or refused with the file's name and a
// reason; sanitizers see the rest. Random, but always the same.
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
#include <string>
#include <vector>

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

bool is_row_of_numbers(const std::string& line) {
    return line.find_first_of("0123456789") != std::string::npos &&
           line.find_first_not_of("0123456789abcdefED+-. \t\r") == std::string::npos;
}

std::string with_zeros(std::string text, bool only_last) {
    bool in_number = false, is_done = false;
    std::string out;
    for (auto c = text.rbegin(); c != text.rend(); ++c) {
        const bool is_digit = *c >= '0' && *c <= '9' && !is_done;
        if (is_digit && in_number) continue;
        if (in_number && only_last) is_done = true;
        in_number = is_digit;
        out.insert(out.begin(), is_digit ? '0' : *c);
    }
    return out;
}

// Returns the text with lists of rows left out, where the counts before them stay or become 0, and
// with rows that have no items.
std::vector<std::string> without_rows(const std::string& text) {
    std::vector<std::string> lines, variants;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    const auto add = [&](std::size_t begin, std::size_t end, const std::string& instead,
                         std::size_t head, const std::string& as_head) {
        std::string variant;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            if (k == begin && !instead.empty()) variant += instead + '\n';
            if (k < begin || k >= end) variant += (k == head ? as_head : lines[k]) + '\n';
        }
        variants.push_back(variant);
    };
    const std::size_t none = lines.size();
    for (std::size_t end = 0, runs = 0; end < lines.size() && runs < 12; ++end) {
        const std::size_t begin = end;
        while (end < lines.size() && is_row_of_numbers(lines[end])) ++end;
        if (end == begin) continue;
        ++runs;
        add(begin, end, "", none, "");
        add(begin, end, with_zeros(lines[begin], false), none, "");
        add(begin + 1, end, "", begin, with_zeros(lines[begin], false));
        if (begin > 0) {
            for (const bool only_last : {true, false})
                add(begin, end, "", begin - 1, with_zeros(lines[begin - 1], only_last));
        }
        for (const std::size_t row : {begin, (begin + end) / 2, end - 1}) {
            add(row, row + 1, "", none, "");
            add(row, row + 1, "0", none, "");
            add(row, row + 1, with_zeros(lines[row], false), none, "");
            add(row, row + 1, with_zeros(lines[row], true), none, "");
        }
    }
    return variants;
}

// Returns the text with arrays of VTK XML or lists in brackets that have no items, each alone, and
// all of them.
std::vector<std::string> without_items(const std::string& text, char open, char close) {
    std::vector<std::string> variants;
    std::string all;
    std::size_t copied = 0;
    for (std::size_t begin = text.find(open); begin != std::string::npos && variants.size() < 80;
         begin = text.find(open, begin + 1)) {
        const std::size_t end = text.find(close, begin + 1);
        if (end == std::string::npos) break;
        const std::string inside = text.substr(begin + 1, end - begin - 1);
        if (inside.find_first_of("0123456789") == std::string::npos ||
            inside.find_first_of("(<>") != std::string::npos)
            continue;
        const std::string before = text.substr(0, begin + 1), after = text.substr(end);
        variants.push_back(before + after);
        variants.push_back(before + "0" + after);
        const std::size_t line = before.find_last_of('\n') + 1;
        variants.push_back(before.substr(0, line) + with_zeros(before.substr(line), true) + after);
        all += text.substr(copied, begin + 1 - copied);
        copied = end;
    }
    variants.push_back(all + text.substr(copied));
    return variants;
}

std::vector<std::string> with_empty_lists(const std::string& text) {
    std::vector<std::string> all = without_rows(text);
    for (const char* ends : {"()", "><", "\"\""}) {
        const std::vector<std::string> more = without_items(text, ends[0], ends[1]);
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
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
        const std::vector<std::string> emptied = with_empty_lists(whole);
        const int changes = times + static_cast<int>(emptied.size());
        for (int time = 0; time < changes; ++time) {
            std::string bytes = whole;
            if (time < times) change(bytes, random);
            else bytes = emptied[static_cast<std::size_t>(time - times)];
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
