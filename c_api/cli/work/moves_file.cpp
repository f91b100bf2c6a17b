#include "work/moves_file.hpp"

#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "curves/section_movement.hpp"
#include "files/text_file.hpp"
#include "mesh/named_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

class MovesReader {
public:
    MovesReader(const TextFile& file, const Movable& movable, const Mesh& mesh,
                std::vector<double>& moves, std::vector<MovementError>* errors)
        : movable_(movable),
          mesh_(mesh),
          lines_(file, '#', true),
          moves_(moves),
          errors_(errors),
          moved_(static_cast<std::size_t>(movable.functions())) {}

    void read() {
        while (lines_.next()) {
            if (lines_.words()[0] == "rigid") {
                read_body();
            } else if (is_section_movement(lines_.words()[0])) {
                read_section();
            } else if (lines_.words()[0] == "mode") {
                read_mode();
            } else {
                read_control_point();
            }
        }
    }

private:
    void read_control_point() {
        const auto& words = lines_.words();
        const std::int32_t n_control = movable_.n_control;
        std::int32_t index = 0;
        if (words.size() != 3) lines_.expected("index dx dy");
        if (!parse(words[0], index) || index < 1 || index > n_control) {
            lines_.expected("a control point between 1 and " + std::to_string(n_control), words[0]);
        }
        const auto point = static_cast<std::size_t>(index - 1);
        if (moved_[point])
            lines_.fail("control point " + std::to_string(index) + " is moved a second time");
        moved_[point] = true;
        for (std::size_t i = 0; i < 2; ++i) moves_[2 * point + i] += number(words[i + 1]);
    }

    void read_section() {
        SectionMovement line = section_movement_of(lines_);
        const hm_section section = section_of(line.marker);
        hm_curves curves = movable_.curves();
        const auto n = 2 * static_cast<std::size_t>(curves.n_control);
        std::vector<double> control(curves.control, curves.control + n);
        for (std::size_t k = 0; k < n; ++k) control[k] += moves_[k];
        curves.control = control.data();
        hm_error error = {};
        if (!line.has_centre &&
            !find_quarter_chord(curves, section, line.movement.x, line.movement.y, error)) {
            lines_.fail("the section of " + in_quotes(line.marker) +
                        " has no quarter chord; name the centre X,Y: " + error.text);
        }
        MovedSection moved;
        if (!move_section(curves, section, {line.movement}, line.values, moved, error))
            lines_.fail(error.text);
        if (errors_ != nullptr)
            errors_->push_back(movement_error(std::string(lines_.line()), curves, moved));
        for (std::size_t k = 0; k < n; ++k) moves_[k] += moved.move[k];
    }

    // Returns the curves of all conditions on the markers of this name.
    hm_section section_of(const std::string& name) const {
        auto section = sized<hm_section>();
        for (const hm_condition& condition :
             conditions_of(name, HM_ON_CURVE, "a marker on a curve")) {
            const bool is_first = section.n_curves == 0;
            const std::int32_t first = is_first
                                           ? condition.first_curve
                                           : std::min(section.first_curve, condition.first_curve);
            const std::int32_t end = std::max(is_first ? 0 : section.first_curve + section.n_curves,
                                              condition.first_curve + condition.n_curves);
            section.first_curve = first;
            section.n_curves = end - first;
        }
        return section;
    }

    // Returns at least one condition.
    std::vector<hm_condition> conditions_of(const std::string& name, std::int32_t kind,
                                            const char* what) const {
        std::vector<hm_condition> found;
        try {
            found = ConditionsOfMesh{mesh_, movable_.conditions, movable_.mover, movable_.n_curves}
                        .find(name, kind);
        } catch (const Failure&) {}
        if (found.empty()) lines_.expected(what, name);
        return found;
    }

    void read_body() {
        const auto& words = lines_.words();
        if (words.size() < 5 || words.size() > 6)
            lines_.expected("rigid MARKER dx dy degrees [scale]");
        const auto function = static_cast<std::size_t>(function_of(std::string(words[1])));
        if (moved_[function])
            lines_.fail("the body of " + in_quotes(std::string(words[1])) +
                        " is moved a second time");
        moved_[function] = true;
        const double angle = number(words[4]) * pi / 180,
                     scale = words.size() > 5 ? number(words[5]) : 1;
        if (!(scale > 0)) lines_.expected("a scale above 0", words[5]);
        moves_[2 * function] = number(words[2]);
        moves_[2 * function + 1] = number(words[3]);
        moves_[2 * function + 2] = scale * std::cos(angle) - 1;
        moves_[2 * function + 3] = scale * std::sin(angle);
    }

    void read_mode() {
        const auto& words = lines_.words();
        const std::int32_t n_modes = movable_.n_modes;
        std::int32_t mode = 0;
        if (words.size() < 3 || words.size() > 4)
            lines_.expected("mode K amplitude, or mode K amplitude amplitude-y");
        if (!parse(words[1], mode) || mode < 1 || mode > n_modes) {
            lines_.expected("a mode between 1 and " + std::to_string(n_modes), words[1]);
        }
        const auto function = static_cast<std::size_t>(movable_.functions() - n_modes + mode - 1);
        if (moved_[function])
            lines_.fail("mode " + std::to_string(mode) + " is moved a second time");
        moved_[function] = true;
        moves_[2 * function] = number(words[2]);
        if (words.size() == 4) moves_[2 * function + 1] = number(words[3]);
    }

    // Returns the first function of the body to which all markers of this name belong.
    std::int32_t function_of(const std::string& name) const {
        std::int32_t body = -1;
        for (const hm_condition& condition :
             conditions_of(name, HM_RIGID, "a marker of a rigid body")) {
            if (body >= 0 && condition.body != body)
                lines_.expected("the markers of one rigid body, or a piece MARKER@X:Y", name);
            body = condition.body;
        }
        return movable_.n_control + 2 * body;
    }

    template <class Word>
    double number(const Word& word) const {
        double value = 0;
        if (!parse(word, value)) lines_.expected("a finite number", word);
        return value;
    }

    const Movable& movable_;
    const Mesh& mesh_;
    LineReader lines_;
    std::vector<double>& moves_;
    std::vector<MovementError>* errors_;
    std::vector<bool> moved_;
};

}  // namespace

const Option by_option = {
    "--by", "LINE",
    "a line of a file of moves, such as \"turn airfoil 3 0.25,0\"; may be repeated"};

TextFile text_of_moves(const std::string& path) {
    TextFile file(path);
    if (trimmed(file.text()).empty())
        file.fail(0,
                  "the file of moves is empty; write a comment such as `# nothing moves` to it if "
                  "nothing "
                  "is to move");
    return file;
}

std::vector<TextFile> texts_of_moves(const Arguments& arguments) {
    std::vector<TextFile> texts;
    if (arguments.has("--move")) texts.push_back(text_of_moves(arguments.text("--move")));
    std::string lines;
    for (const std::string& line : arguments.all("--by")) lines += line + '\n';
    if (!lines.empty()) texts.emplace_back("--by", lines);
    return texts;
}

std::vector<double> read_moves(const std::vector<TextFile>& texts, const Movable& movable,
                               const Mesh& mesh, std::vector<MovementError>* errors) {
    std::vector<double> moves(2 * static_cast<std::size_t>(movable.functions()));
    for (const TextFile& text : texts) MovesReader(text, movable, mesh, moves, errors).read();
    return moves;
}

Movable movable_of(const Basis& basis) {
    const hm_basis_info& info = basis.info();
    Movable movable = {basis.n_control(), info.bodies, info.modes, basis.conditions(),
                       [&basis]() -> const hm_curves& { return basis.curves(); }};
    movable.n_curves = info.curves;
    movable.mover.assign(static_cast<std::size_t>(info.points), -1);
    for (std::int32_t k = 0; k < info.curve_points; ++k)
        movable.mover[static_cast<std::size_t>(info.curve_point[k])] = info.point_curve[k];
    return movable;
}

bool has_section_movements(const TextFile& text) {
    LineReader lines(text, '#', true);
    while (lines.next())
        if (is_section_movement(lines.words()[0])) return true;
    return false;
}

void write_body(std::ostream& out, const Mesh& mesh, const hm_condition& condition,
                const double* function) {
    out << "rigid " << mesh.name_of(condition) << ' ' << exact(function[0]) << ' '
        << exact(function[1]) << ' ' << exact(std::atan2(function[3], 1 + function[2]) * 180 / pi)
        << ' ' << exact(std::hypot(1 + function[2], function[3])) << '\n';
}

void write_moves(std::ostream& out, const std::vector<double>& moves, const Basis& basis,
                 const Mesh& mesh) {
    const auto n_control = static_cast<std::size_t>(basis.n_control());
    if (n_control > 0) out << "# control point, dx, dy\n";
    for (std::size_t point = 0; point < n_control; ++point) {
        out << point + 1 << ' ' << exact(moves[2 * point]) << ' ' << exact(moves[2 * point + 1])
            << '\n';
    }
    for_each_body(basis.conditions(), basis.info().bodies, [&](const hm_condition& condition) {
        out << "# body, dx, dy, degrees, scale\n";
        write_body(out, mesh, condition,
                   &moves[2 * (n_control + 2 * static_cast<std::size_t>(condition.body))]);
    });
}

}  // namespace cli
