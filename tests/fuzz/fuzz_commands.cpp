// Commands of the program with a damaged basis, or with a damaged table of fields. The library's
// own checksum is put into the damaged block, so that the program gets numbers that no solution
// has: in conditions, curves, counts and names. A command ends, or refuses the basis by a sentence;
// an exception of the language, as of an index out of range, is a failure, like memory that is not
// the program's own.
#include "commands/commands.hpp"
#include "target.hpp"

#include "failure.hpp"

#include "basis/basis.hpp"

#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdlib.h>
#include <unistd.h>

namespace fuzz {
namespace {

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

// A folder of this process, which goes with it.
class Folder {
public:
    Folder() {
        for (const char* const parent : {"/dev/shm", "/tmp"}) {
            path_ = std::string(parent) + "/harmorph-fuzz-XXXXXX";
            if (mkdtemp(path_.data()) != nullptr) return;
        }
        expect(false, "no scratch folder");
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(Folder const&) = delete;
    std::string file(const char* name) const { return path_ + '/' + name; }
    std::string write(const char* name, std::string const& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }

private:
    std::string path_;
};

std::string text_of(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// 6 x 6 cells round a block of 2 x 2, each side and the block with a marker.
std::string box() {
    constexpr int n = 6;
    std::ostringstream cells, points, faces;
    int number[n + 1][n + 1], n_points = 0, n_cells = 0;
    auto const is_in_block = [](int i, int j) { return 2 <= i && i < 4 && 2 <= j && j < 4; };
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            if (i == 3 && j == 3) continue;
            number[i][j] = n_points++;
            points << i << ' ' << j << '\n';
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            if (is_in_block(i, j)) continue;
            cells << "9 " << number[i][j] << ' ' << number[i + 1][j] << ' ' << number[i + 1][j + 1]
                  << ' ' << number[i][j + 1] << '\n';
            ++n_cells;
        }
    }
    auto const side = [&](const char* name, int first, int last, auto const& point) {
        faces << "MARKER_TAG= " << name << "\nMARKER_ELEMS= " << last - first << '\n';
        for (int k = first; k < last; ++k) faces << "3 " << point(k) << ' ' << point(k + 1) << '\n';
    };
    side("low", 0, n, [&](int k) { return number[k][0]; });
    side("high", 0, n, [&](int k) { return number[k][n]; });
    side("in", 0, n, [&](int k) { return number[0][k]; });
    side("out", 0, n, [&](int k) { return number[n][k]; });
    int const around[9][2] = {{2, 2}, {3, 2}, {4, 2}, {4, 3}, {4, 4},
                              {3, 4}, {2, 4}, {2, 3}, {2, 2}};
    side("block", 0, 8, [&](int k) { return number[around[k][0]][around[k][1]]; });
    std::ostringstream all;
    all << "NDIME= 2\nNELEM= " << n_cells << '\n'
        << cells.str() << "NPOIN= " << n_points << '\n'
        << points.str() << "NMARK= 5\n"
        << faces.str();
    return all.str();
}

// That mesh, and bases of it: of a curve with sliding sides, and of a rigid body between periodic
// sides.
struct Files {
    Folder folder;
    std::string mesh, moves[2], airfoil, damaged, fields, basis_text[2], fields_text;

    Files()
        : mesh(folder.write("m.su2", box())),
          moves{folder.write("0.txt", "1 .1 .05\n3 0 -.1\n"),
                folder.write("1.txt", "rigid block .1 0 5\n")},
          airfoil(
              folder.write("a.dat", "section\n4.2 3\n3.5 4.2\n2 4\n1.8 3\n2 2\n3.5 1.8\n4.2 3\n")),
          damaged(folder.file("b.basis")),
          fields(folder.file("f.csv")) {
        std::ostringstream table;
        table << "PointID,x,y,Sensitivity_x,Sensitivity_y\n";
        int n = 0;
        for (int j = 0; j <= 6; ++j)
            for (int i = 0; i <= 6; ++i)
                if (i != 3 || j != 3)
                    table << n++ << ',' << i << ',' << j << ',' << i - j << ',' << 0.5 * j << '\n';
        fields_text = table.str();
        std::string const curve = folder.write(
            "c.curve",
            "degree 1\nclosed tied\npoints 4\n2 2\n4 2\n4 4\n2 4\nknots 7\n0 0 2 4 6 8 8\n");
        std::string const line = folder.write(
            "l.curve", "degree 1\nclosed open\npoints 2\n0 6\n6 6\nknots 4\n0 0 6 6\n");
        cli::run_command({"solve", mesh, "--curve", "block=" + curve, "--slip", "low", "--slip",
                          "high=" + line, "-o", damaged});
        basis_text[0] = text_of(damaged);
        cli::run_command(
            {"solve", mesh, "--rigid", "block", "--periodic", "in:out", "-o", damaged});
        basis_text[1] = text_of(damaged);
    }

    std::vector<std::string> command(std::uint32_t which, std::uint32_t basis) const {
        auto const out = [&](const char* name) { return folder.file(name); };
        std::vector<std::string> const morph = {"morph", mesh, damaged, "--move", moves[basis]};
        auto const with = [](std::vector<std::string> words, std::vector<std::string> const& more) {
            words.insert(words.end(), more.begin(), more.end());
            return words;
        };
        switch (which) {
            case 0: return with(morph, {"-o", out("o.su2"), "--report", out("o.html"), "--force"});
            case 1:
                return with(morph, {"--svg", out("o.svg"), "--boundary-svg", out("b.svg"), "--csv",
                                    out("o.csv")});
            case 2:
                return with(morph,
                            {"--safe", "-o", out("o.su2"), "--reached", out("r.txt"), "--json"});
            case 3: return with(morph, {"--improve", "--vtu", out("o.vtu")});
            case 4:
                return {"morph", mesh,          damaged,     "--to-airfoil",
                        airfoil, "--moves-out", out("r.txt")};
            case 5: return {"explore", mesh, damaged, "-o", out("o.html")};
            case 6:
                return {"export", mesh,         damaged, "--function", "1",
                        "--csv",  out("o.csv"), "--svg", out("o.svg")};
            case 7: return {"export", mesh, damaged, "--level", "0", "--svg", out("o.svg")};
            case 8:
                return {"sample",  mesh, damaged, "--range",     "-.1,.1",
                        "--count", "3",  "-o",    out("designs")};
            case 9: return {"adjoint", mesh, damaged, "--sensitivity", fields, "-o", out("g.csv")};
            case 10: return {"interpolate", mesh, fields, mesh, "-o", out("i.csv")};
            case 11: return {"interpolate", mesh, fields, mesh, "-o", out("i.vtu")};
            case 12:
                return {"align",    mesh, "--to",     mesh,   "--marker",     "block",
                        "--points", "6",  "--fields", fields, "--fields-out", out("i.csv")};
            default: return {"transfer", mesh, damaged, mesh, "-o", out("t.basis")};
        }
    }
};

// Some bytes of a text change, or a piece of the text goes, or stands there twice.
void damage_table(std::string& text, Input& input) {
    for (std::int32_t k = input.from(0, 3); k > 0; --k) {
        std::size_t const at = input.below(static_cast<std::uint32_t>(text.size())),
                          length = input.below(40);
        switch (input.below(4)) {
            case 0: text.erase(at, length); break;
            case 1: text.insert(at, text.substr(at, length)); break;
            case 2:
                text.insert(at, input.any_of({"nan", "inf", "-", "1e999", "2147483648", ",,", "\n",
                                              "\"", "1e-400", " 7 "}));
                break;
            default: text[at] = static_cast<char>(input.below(256));
        }
        if (text.empty()) return;
    }
}

// Numbers in the conditions, in the header or anywhere in the block; or text behind the block.
void damage(std::string& text, Input& input) {
    harmorph::BasisHeader header;
    std::memcpy(static_cast<void*>(&header), text.data(), sizeof header);
    std::vector<double> copy(header.bytes / sizeof(double) + 1);  // aligned
    std::memcpy(copy.data(), text.data(), header.bytes);
    harmorph::Basis const basis = harmorph::Basis::view(static_cast<const void*>(copy.data()));
    auto const first =
        static_cast<std::size_t>(reinterpret_cast<const char*>(basis.conditions.data()) -
                                 reinterpret_cast<const char*>(copy.data()));
    std::size_t const in_conditions =
        sizeof(harmorph::Condition) * static_cast<std::size_t>(basis.conditions.count());
    for (std::int32_t k = input.from(1, 3); k > 0; --k) {
        std::uint32_t const where = input.below(6);
        std::size_t const begin = where < 3 ? first : where == 5 ? header.bytes : 0;
        std::size_t const length = where < 3    ? in_conditions
                                   : where == 3 ? sizeof header
                                   : where == 4 ? header.bytes
                                                : text.size() - header.bytes;
        std::size_t const at = begin + input.below(static_cast<std::uint32_t>(length));
        if (where == 5 || input.one_in(2)) {
            text[at] = static_cast<char>(input.below(256));
        } else {
            std::int32_t const number = input.wild_index();
            std::memcpy(&text[std::min(at / 4 * 4, text.size() - 4)], &number, sizeof number);
        }
    }
    std::uint64_t const bytes = header.bytes;
    std::memcpy(copy.data(), text.data(), bytes);
    auto& changed = *reinterpret_cast<harmorph::BasisHeader*>(copy.data());
    changed.bytes = bytes;  // the checksum reads as far
    changed.checksum = harmorph::checksum_of(changed);
    std::memcpy(text.data(), copy.data(), bytes);
}

}  // namespace

Outcome run_commands(Input& input) {
    Silence const output(stdout);
#ifndef LIBFUZZER  // which writes to the standard error itself, as the sanitizers do
    Silence const warnings(stderr);
#endif
    static Files const files;
    std::uint32_t const basis = input.below(2), command = input.below(14);
    constexpr std::uint32_t sample = 8, adjoint = 9, last_with_fields = 12;
    bool const has_fields = command >= adjoint && command <= last_with_fields;
    std::string text = files.basis_text[basis], table = files.fields_text;
    if (!has_fields || (command == adjoint && input.one_in(2))) damage(text, input);
    if (has_fields) damage_table(table, input);
    files.folder.write("b.basis", text);
    files.folder.write("f.csv", table);
    if (command == sample) {  // else the command continues in the folder of another case
        std::error_code ignored;
        std::filesystem::remove_all(files.folder.file("designs"), ignored);
    }
    try {
        cli::run_command(files.command(command, basis));
    } catch (cli::Failure const& failure) {
        expect(*failure.what() != '\0', "a refusal without a sentence");
        return Outcome::refused;
    } catch (std::exception const& error) {
        throw Failure("command " + std::to_string(command) + ": " + error.what());
    }
    return Outcome::done;
}

}  // namespace fuzz
