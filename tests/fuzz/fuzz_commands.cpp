// Commands of the program with a damaged basis, or with a damaged table of fields. The library's
// own checksum is put into the damaged block, so that the program gets numbers that no solution
// has: in conditions, curves, counts and names. A command ends, or refuses the basis by a sentence;
// an exception of the language, as of an index out of range, is a failure, like memory that is not
// the program's own. Every file that a command has written is read again; a command that is refused
// leaves no other files than those that it may write, and a folder with files of somebody else as
// it is. In some cases another process shortens the mesh while the command runs.
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "failure.hpp"
#include "files/text_file.hpp"
#include "scratch_folder.hpp"
#include "silence.hpp"
#include "target.hpp"
#include "work/basis_file.hpp"
#include "work/moves_file.hpp"
#include "work/read_mesh.hpp"

#include "basis/basis.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace fuzz {
namespace {

// The mesh box(), and bases of it: of a curve with slipping sides, and of a rigid body between
// periodic sides.
struct Files {
    ScratchFolder folder;
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
        std::string const curve = folder.write("c.curve", block_curve);
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
        auto const joined = [](std::vector<std::string> words,
                               std::vector<std::string> const& more) {
            words.insert(words.end(), more.begin(), more.end());
            return words;
        };
        switch (which) {
            case 0:
                return joined(morph, {"-o", out("o.su2"), "--report", out("o.html"), "--force"});
            case 1:
                return joined(morph, {"--svg", out("o.svg"), "--boundary-svg", out("b.svg"),
                                      "--csv", out("o.csv")});
            case 2:
                return joined(morph,
                              {"--safe", "-o", out("o.su2"), "--reached", out("r.txt"), "--json"});
            case 3: return joined(morph, {"--improve", "--vtu", out("o.vtu")});
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

// The files of a case that are not written by its command.
bool is_input(std::string const& name) {
    static std::set<std::string> const names = {"m.su2", "0.txt",   "1.txt",   "a.dat",  "b.basis",
                                                "f.csv", "c.curve", "l.curve", "designs"};
    return names.count(name) > 0;
}

void remove_outputs(Files const& files) {
    for (std::string const& name : files.folder.names())
        if (!is_input(name)) std::filesystem::remove(files.folder.file(name.c_str()));
}

// Reads a file that a command has written, by the reader for files of its kind.
void read_again(std::string const& name, Files const& files) {
    std::string const path = files.folder.file(name.c_str());
    std::string const ending = name.substr(name.rfind('.'));
    if (ending == ".su2" || ending == ".msh" || ending == ".vtu") {
        cli::run_command({"check", path});
    } else if (ending == ".csv") {
        cli::TextFile const file(path);
        cli::CsvReader records(file);
        for (std::size_t n = 0; records.next(); n = records.cells().size())
            if (n > 0 && records.cells().size() != n) records.fail("another number of cells");
    } else if (ending == ".curve") {
        cli::read_curves(path);
    } else if (ending == ".basis") {
        cli::Basis(path, cli::read_mesh(files.mesh));
    } else if (ending == ".txt" || ending == ".reached") {
        cli::Mesh const mesh = cli::read_mesh(files.mesh);
        cli::Basis const basis(files.damaged, mesh);
        cli::read_moves({cli::text_of_moves(path)}, cli::movable_of(basis), mesh);
    } else {
        std::string const text = text_of(path);
        std::string const end = ending == ".svg" ? "</svg>\n" : "</html>\n";
        expect((ending == ".svg" || ending == ".html") && text.size() > end.size() &&
                   text.substr(text.size() - end.size()) == end,
               "a file that has no end: " + name);
    }
}

void read_outputs(Files const& files) {
    for (std::string const& name : files.folder.names()) {
        if (is_input(name)) continue;
        try {
            read_again(name, files);
        } catch (cli::Failure const& failure) {
            throw Failure("a file that the program has written is refused: " +
                          std::string(failure.what()));
        }
    }
}

// Runs a command in a process of its own, and makes the mesh shorter meanwhile: the process ends by
// itself, with an exit code, after any part of the work.
void run_while_the_mesh_shrinks(Files const& files, std::vector<std::string> words, Input& input) {
    words[1] = files.folder.write("shrinks.su2", text_of(files.mesh));
    std::size_t const size = text_of(files.mesh).size();
    std::int32_t const microseconds = input.from(0, 400);
    pid_t const child = fork();
    if (child == 0) {
        try {
            cli::run_command(words);
        } catch (cli::Failure const&) {
            _exit(1);
        } catch (std::exception const&) {
            abort();
        }
        _exit(0);
    }
    usleep(static_cast<useconds_t>(microseconds));
    bool const is_shorter =
        truncate(words[1].c_str(), static_cast<off_t>(input.below(std::uint32_t(size)))) == 0;
    int status = 0;
    pid_t ended = 0;
    do ended = waitpid(child, &status, 0);
    while (ended < 0 && errno == EINTR);  // by the clock of libFuzzer
    expect(ended == child && is_shorter, "the mesh of a command could not be made shorter");
    expect(WIFEXITED(status),
           "a command whose mesh becomes shorter ends with the status " + std::to_string(status));
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
    if (has_fields) damage_text(table, input);
    files.folder.write("b.basis", text);
    files.folder.write("f.csv", table);
    std::string const designs = files.folder.file("designs");
    bool const is_taken = command == sample && input.one_in(4);
    if (command == sample) {  // else the command continues in the folder of another case
        std::error_code ignored;
        std::filesystem::remove_all(designs, ignored);
        if (is_taken) {
            std::filesystem::create_directory(designs);
            files.folder.write("designs/notes.txt", "of somebody else\n");
        }
    }
    remove_outputs(files);
    std::vector<std::string> const words = files.command(command, basis);
    if (command != sample && input.one_in(32)) {
        run_while_the_mesh_shrinks(files, words, input);
        return Outcome::done;
    }
    try {
        cli::run_command(words);
        expect(!is_taken, "sample writes into a folder of somebody else");
        read_outputs(files);
    } catch (cli::Failure const& failure) {
        expect(*failure.what() != '\0', "a refusal without a sentence");
        expect(!is_taken || files.folder.names("designs").size() == 1,
               "a refusal changes a folder of somebody else");
        read_outputs(files);
        return Outcome::refused;
    } catch (std::exception const& error) {
        throw Failure("command " + std::to_string(command) + ": " + error.what());
    }
    return Outcome::done;
}

}  // namespace fuzz
