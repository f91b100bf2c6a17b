// Damaged tables of movements and of sensitivities. What the program accepts must mean what a
// second reader finds in the text: this one is written from the pages of the formats, splits lines
// by hand, and reads numbers by strtod. Two movements, one after the other, must add up. Lines
// whose meaning needs more than the text (names in quotes, patterns of names, the quarter chord,
// flaps) are not compared.
#include "commands/commands.hpp"
#include "failure.hpp"
#include "scratch_folder.hpp"
#include "silence.hpp"
#include "target.hpp"
#include "work/basis_file.hpp"
#include "work/moves_file.hpp"
#include "work/read_mesh.hpp"
#include "work/sensitivity.hpp"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fuzz {
namespace {

constexpr double pi = 3.14159265358979323846;

struct NotCompared {};  // the meaning needs more than the text
struct Wrong {
    std::string why;
};  // the page of the format does not allow this text

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// Lines end with LF, CR LF or CR. The empty line that this finds inside CR LF means nothing.
std::vector<std::string> lines_of(std::string const& text) {
    std::vector<std::string> lines(1);
    for (char const c : text) {
        if (c == '\n' || c == '\r') lines.emplace_back();
        else lines.back() += c;
    }
    return lines;
}

std::vector<std::string> words_of(std::string const& line) {
    std::vector<std::string> words;
    bool in_word = false;
    for (char const c : line) {
        if (c == '#') break;
        if (!is_blank(c)) {
            if (!in_word) words.emplace_back();
            words.back() += c;
        }
        in_word = !is_blank(c);
    }
    return words;
}

// A number in the notation of C or, with D, of Fortran; the whole word.
double number(std::string word) {
    if (word.empty() || word.find_first_not_of("0123456789+-.eEdD") != word.npos)
        throw Wrong{"no number: " + word};
    for (char& c : word)
        if (c == 'd' || c == 'D') c = 'e';
    char* end = nullptr;
    double const value = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value)) throw Wrong{"no finite number: " + word};
    return value;
}

int whole(std::string const& word) {
    if (word.empty() || word.find_first_not_of("0123456789-") != word.npos)
        throw Wrong{"no whole number: " + word};
    return static_cast<int>(number(word));
}

// ---- movements

struct Place {
    double x, y;
};

// Turns are taken out first, exactly: the product with pi would round by a part of many turns.
double radians(std::string const& degrees) {
    return std::remainder(number(degrees), 360.0) * pi / 180;
}

Place place_of(std::string const& word) {
    std::size_t const comma = word.find(',');
    if (comma == word.npos) throw Wrong{"no place: " + word};
    return {number(word.substr(0, comma)), number(word.substr(comma + 1))};
}

// What the lines of a file of moves do to the control points of one curve, or to one body.
class MovesByText {
public:
    // control: x, y of each control point; none for a body.
    explicit MovesByText(std::vector<double> control)
        : control_(std::move(control)),
          moves_(control_.empty() ? 4 : control_.size()),
          is_moved_(moves_.size() / 2) {}

    std::vector<double> const& read(std::string const& text) {
        for (std::string const& line : lines_of(text))
            if (auto const words = words_of(line); !words.empty()) apply(words);
        return moves_;
    }

private:
    void apply(std::vector<std::string> const& words) {
        std::string const& verb = words[0];
        std::size_t const n = words.size();
        auto const need = [&](bool has) {
            if (!has) throw Wrong{"the words of " + verb};
        };
        if (verb == "flap" || verb == "mode") throw NotCompared{};
        if (verb != "rigid" && verb != "turn" && verb != "shift" && verb != "scale") {
            need(n == 3);
            int const point = whole(verb);
            need(point >= 1 && 2 * std::size_t(point) <= control_.size());
            take_first(std::size_t(point) - 1);
            moves_[2 * std::size_t(point) - 2] += number(words[1]);
            moves_[2 * std::size_t(point) - 1] += number(words[2]);
            return;
        }
        need(n >= 2);
        if (words[1] != "block") throw NotCompared{};
        if (verb == "rigid") {
            need(control_.empty() && (n == 5 || n == 6));
            take_first(0);
            double const angle = radians(words[4]), scale = n == 6 ? number(words[5]) : 1;
            need(scale > 0);
            moves_ = {number(words[2]), number(words[3]), scale * std::cos(angle) - 1,
                      scale * std::sin(angle)};
            return;
        }
        need(!control_.empty());
        if (n == 3 && verb != "shift") throw NotCompared{};  // about the quarter chord
        need(n == 4);
        if (verb == "shift") {
            double const dx = number(words[2]), dy = number(words[3]);
            each([&](double& x, double& y) { x += dx, y += dy; });
            return;
        }
        bool const turns = verb == "turn";
        Place const at = place_of(words[3]);
        double const angle = turns ? radians(words[2]) : 0, scale = turns ? 1 : number(words[2]);
        need(scale > 0);
        // Only the change is rounded: a centre far away cancels in the product with the scale.
        double const half = std::sin(angle / 2), sine = scale * std::sin(angle),
                     cosine = scale - 1 - 2 * scale * half * half;  // less 1
        each([&](double& x, double& y) {
            double const a = x - at.x, b = y - at.y;
            x += cosine * a - sine * b;
            y += sine * a + cosine * b;
        });
    }
    void take_first(std::size_t function) {
        if (is_moved_[function]) throw Wrong{"a second line of the same number"};
        is_moved_[function] = true;
    }
    template <class Move>
    void each(Move const& move) {
        for (std::size_t k = 0; k < control_.size(); k += 2) {
            double x = control_[k] + moves_[k], y = control_[k + 1] + moves_[k + 1];
            move(x, y);
            moves_[k] = x - control_[k];
            moves_[k + 1] = y - control_[k + 1];
        }
    }

    std::vector<double> control_, moves_;
    std::vector<bool> is_moved_;
};

// ---- sensitivities

std::string trimmed(std::string text) {
    while (!text.empty() && is_blank(text.back())) text.pop_back();
    std::size_t begin = 0;
    while (begin < text.size() && is_blank(text[begin])) ++begin;
    return text.substr(begin);
}

std::vector<std::string> cells_of(std::string const& line) {
    std::vector<std::string> cells(1);
    for (char const c : line) {
        if (c == ',') cells.emplace_back();
        else cells.back() += c;
    }
    for (std::string& cell : cells) cell = trimmed(cell);
    return cells;
}

// The point of a row: by its number if the table has numbers, else by its place.
struct Row {
    std::optional<double> number, x, y;
    double by_x = 0, by_y = 0;
};

std::vector<Row> rows_with_names(std::vector<std::string> const& lines) {
    auto const names = cells_of(lines[0]);
    std::map<std::string, std::size_t> column;
    for (char const* const name : {"PointID", "x", "y", "Sensitivity_x", "Sensitivity_y"}) {
        if (std::count(names.begin(), names.end(), name) != 1) throw NotCompared{};
        column[name] = std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
    }
    if (names.size() != column.size()) throw NotCompared{};  // another spelling of these, perhaps
    std::vector<Row> rows;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        auto const cells = cells_of(lines[k]);
        if (cells.size() != names.size()) throw Wrong{"another number of cells"};
        std::map<std::string, double> value;
        for (auto const& [name, at] : column) value[name] = number(cells[at]);
        rows.push_back({value["PointID"], value["x"], value["y"], value["Sensitivity_x"],
                        value["Sensitivity_y"]});
    }
    return rows;
}

std::vector<Row> plain_rows(std::vector<std::string> const& lines) {
    std::vector<Row> rows;
    for (std::string const& line : lines) {
        auto const words = words_of(line);
        if (words.empty()) continue;
        if (words.size() != 3) throw Wrong{"not three words"};
        rows.push_back({number(words[0]), {}, {}, number(words[1]), number(words[2])});
    }
    return rows;
}

// Returns x, y of the derivatives by each point.
std::vector<double> sensitivities(std::string const& text, bool has_names, cli::Mesh const& mesh) {
    std::vector<std::string> lines;
    for (std::string const& line : lines_of(text)) {
        std::string const content = trimmed(line);
        if (!content.empty() && content[0] != '#') lines.push_back(line);
    }
    if (lines.empty()) throw Wrong{"nothing"};
    std::vector<double> derivatives(2 * mesh.x.size());
    std::vector<bool> is_there(mesh.x.size());
    for (Row const& row : has_names ? rows_with_names(lines) : plain_rows(lines)) {
        double const point = *row.number;
        if (!(point >= 0 && point < double(mesh.x.size())) || point != std::floor(point))
            throw Wrong{"no point"};
        auto const at = std::size_t(point);
        if (is_there[at]) throw Wrong{"a point occurs twice"};
        is_there[at] = true;
        if (row.x && std::hypot(*row.x - mesh.x[at], *row.y - mesh.y[at]) > 0.01)
            throw Wrong{"the place of another point"};
        derivatives[2 * at] = row.by_x;
        derivatives[2 * at + 1] = row.by_y;
    }
    return derivatives;
}

// ---- cases

// A locale in which numbers have a decimal comma, where the system has one, while this exists.
class DecimalComma {
public:
    explicit DecimalComma(bool is_set) {
        for (char const* const name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C"})
            if (is_set && std::setlocale(LC_NUMERIC, name) != nullptr) break;
    }
    ~DecimalComma() { std::setlocale(LC_NUMERIC, "C"); }
    DecimalComma(DecimalComma const&) = delete;
};

struct TableFiles {
    ScratchFolder folder;
    std::string mesh_path, curve_basis, body_basis, table;
    cli::Mesh mesh;

    TableFiles()
        : mesh_path(folder.write("m.su2", box())),
          curve_basis(folder.file("c.basis")),
          body_basis(folder.file("b.basis")),
          table(folder.file("table.txt")),
          mesh(cli::read_mesh(mesh_path)) {
        std::string const curve = folder.write("c.curve", block_curve);
        cli::run_command({"solve", mesh_path, "--curve", "block=" + curve, "-o", curve_basis});
        cli::run_command({"solve", mesh_path, "--rigid", "block", "-o", body_basis});
    }
};

[[noreturn]] void disagree(std::string const& why, std::string const& text) {
    throw Failure("the program accepts a table as the second reader does not, " + why + ":\n" +
                  text);
}

void compare(std::vector<double> const& found, std::vector<double> const& expected,
             double tolerance, std::string const& text) {
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (!(std::fabs(found[k] - expected[k]) <= tolerance * (1 + std::fabs(expected[k]))))
            disagree(shown(found[k]) + " is " + shown(expected[k]) + " there", text);
    }
}

template <class Read>
void compare_with(Read const& second_reader, std::vector<double> const& found, double tolerance,
                  std::string const& text) {
    try {
        compare(found, second_reader(), tolerance, text);
    } catch (Wrong const& wrong) {
        disagree(wrong.why, text);
    } catch (NotCompared const&) {}
}

void check_moves(TableFiles const& files, bool is_body, Input& input) {
    static cli::Basis const on_curve(files.curve_basis, files.mesh),
        of_body(files.body_basis, files.mesh);
    std::string text =
        is_body ? input.any_of({"rigid block .1 0 5\n", "rigid block -.25 1e-1 -5 1.01 # s\n"})
                : input.any_of({"1 .1 .05\n3 0 -.1\n", "turn block 3 2,2.5\n2 .1 -1D-1\n",
                                "# none\nshift block .1 0\n\nscale block 1.1 3,3\n4 1 1"});
    damage_text(text, input);
    cli::Basis const& basis = is_body ? of_body : on_curve;
    std::string const path = files.folder.write("table.txt", text);
    bool const has_comma = input.one_in(2);
    auto const found = [&] {
        DecimalComma const locale(has_comma);
        return cli::read_moves({cli::text_of_moves(path)}, cli::movable_of(basis), files.mesh);
    }();
    if (text.find_first_of("\"\0", 0, 2) != text.npos) return;
    std::vector<double> control;
    if (!is_body) {
        hm_curves const& curves = basis.curves_at_start();
        control.assign(curves.control, curves.control + 2 * curves.n_control);
    }
    double largest = 1;
    for (double const move : found) largest = std::max(largest, std::fabs(move));
    compare_with([&] { return MovesByText(control).read(text); }, found, 1e-12 * largest, text);
}

// Two lines, the second for the mesh that the first one has left: curves and bodies go on from
// their places, a body about its moved centre. The corners of the block are its control points.
void check_second_morph(TableFiles const& files, bool is_body, Input& input) {
    std::vector<double> const corners{2, 2, 4, 2, 4, 4, 2, 4};
    auto const some = [&](double low, double high) {
        return ' ' + shown(input.between(low, high));
    };
    auto const line = [&] {
        if (is_body)
            return "rigid block" + some(-.3, .3) + some(-.3, .3) + some(-9, 9) + some(.8, 1.2);
        std::string const at = some(2, 4) + ',' + shown(input.between(2, 4));
        switch (input.below(4)) {
            case 0: return "shift block" + some(-.3, .3) + some(-.3, .3);
            case 1: return "turn block" + some(-9, 9) + at;
            case 2: return "scale block" + some(.8, 1.2) + at;
            default: return shown(input.from(1, 4)) + some(-.3, .3) + some(-.3, .3);
        }
    };
    std::string from = files.mesh_path, texts;
    std::vector<double> expected = corners;
    Place centre{3, 3};
    for (char const* const name : {"1.su2", "2.su2"}) {
        std::string const text = line(), to = files.folder.file(name);
        texts += text + '\n';
        try {
            cli::run_command({"morph", from, is_body ? files.body_basis : files.curve_basis, "--by",
                              text, "-o", to, "--force"});
        } catch (cli::Failure const&) {
            return;  // a boundary that would cross itself, for instance
        }
        std::vector<double> const moves =
            MovesByText(is_body ? std::vector<double>() : expected).read(text);
        for (std::size_t k = 0; k < expected.size(); k += 2) {
            double const a = expected[k] - centre.x, b = expected[k + 1] - centre.y;
            expected[k] += is_body ? moves[0] + moves[2] * a - moves[3] * b : moves[k];
            expected[k + 1] += is_body ? moves[1] + moves[2] * b + moves[3] * a : moves[k + 1];
        }
        if (is_body) centre = {centre.x + moves[0], centre.y + moves[1]};
        from = to;
    }
    cli::Mesh const moved = cli::read_mesh(from);
    std::vector<double> found = corners;
    for (std::size_t point = 0; point < moved.x.size(); ++point)
        for (std::size_t k = 0; k < corners.size(); k += 2)
            if (files.mesh.x[point] == corners[k] && files.mesh.y[point] == corners[k + 1])
                found[k] = moved.x[point], found[k + 1] = moved.y[point];
    compare(found, expected, 1e-11, texts);
}

void check_sensitivities(TableFiles const& files, Input& input) {
    bool const has_names = input.one_in(2);
    std::string text = has_names ? "PointID,x,y,Sensitivity_x,Sensitivity_y\n" : "# plain\n";
    for (std::size_t k = 0; k < files.mesh.x.size(); k += 1 + input.below(12)) {
        text += std::to_string(k);
        std::string const between = has_names ? "," : " ";
        if (has_names) text += ',' + shown(files.mesh.x[k]) + ',' + shown(files.mesh.y[k]);
        text += between + shown(input.between(-2, 2)) + between + shown(input.between(-2, 2));
        text += '\n';
    }
    damage_text(text, input);
    std::string const path = files.folder.write("table.txt", text);
    bool const has_comma = input.one_in(2);
    auto const found = [&] {
        DecimalComma const locale(has_comma);
        return cli::read_sensitivity(path, {}, files.mesh, false);
    }();
    if (text.find_first_of("\"\0", 0, 2) != text.npos) return;
    std::vector<double> derivatives;
    for (std::size_t k = 0; k < files.mesh.x.size(); ++k)
        derivatives.insert(derivatives.end(), {found.by.x[k], found.by.y[k]});
    bool const is_plain = text.find(',') == text.npos;
    compare_with([&] { return sensitivities(text, !is_plain, files.mesh); }, derivatives, 0, text);
}

}  // namespace

Outcome run_tables(Input& input) {
    Silence const output(stdout);
#ifndef LIBFUZZER  // which writes to the standard error itself, as the sanitizers do
    Silence const warnings(stderr);
#endif
    static TableFiles const files;
    try {
        switch (input.below(8)) {
            case 0:
            case 1: check_moves(files, false, input); break;
            case 2:
            case 3: check_moves(files, true, input); break;
            case 4: check_second_morph(files, input.one_in(2), input); break;
            default: check_sensitivities(files, input);
        }
    } catch (cli::Failure const& failure) {
        expect(std::string(failure.what()).find("table.txt") != std::string::npos,
               std::string("no name: ") + failure.what());
        return Outcome::refused;
    }
    return Outcome::done;
}

}  // namespace fuzz
