#include "work/moves_file.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "curves/section_movement.hpp"
#include "curves/variables_file.hpp"
#include "files/text_file.hpp"
#include "mesh/loops.hpp"
#include "mesh/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

namespace {

// Finds the conditions that a list of markers names, where the conditions of one marker may hold on
// several pieces of the marker.

struct ConditionsOfMesh {
    const Mesh& mesh;
    const std::vector<hm_condition>& conditions;
    // [points] What moves each point, as in hm_basis_info.point_curve, or -1. If this is empty, the
    // mesh has not moved, so that the places of conditions are on the mesh.
    std::vector<std::int32_t> mover;
    std::int32_t n_curves = 0;

    // Returns the conditions of this kind on the markers and pieces of the list. The name of a
    // marker alone stands for all conditions of the marker, but for the condition without a piece
    // if the kind is HM_RIGID and the marker has such a condition. Refuses names as find_pieces().
    std::vector<hm_condition> find(const std::string& list, std::int32_t kind) const;

private:
    void add_of_marker(std::int32_t marker, std::int32_t kind,
                       std::vector<hm_condition>& found) const;
    void add_of_piece(const MarkerPiece& piece, std::int32_t kind,
                      std::vector<hm_condition>& found) const;
    bool moves_by(const hm_condition& condition, std::int32_t number) const;
};

// The pieces of a marker, which are chains of its faces.
class Pieces {
public:
    Pieces(const Mesh& mesh, std::int32_t marker) : mesh_(mesh) {
        const std::vector<std::int32_t> all = joined_ends(mesh, mesh.face_points);
        std::vector<std::int32_t> joined;
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            if (mesh.face_markers[face] != marker) continue;
            for (const std::size_t end : {2 * face, 2 * face + 1}) {
                ends_.push_back(mesh.face_points[end]);
                joined.push_back(all[end]);
            }
        }
        of_face_ = BoundaryLoops(joined, mesh.points()).of_edge;
    }

    // Returns the number of the piece that is nearest to the place, or -1 without faces.
    std::int32_t nearest(double x, double y) const {
        double smallest = HUGE_VAL;
        std::int32_t piece = -1;
        for (std::size_t face = 0; face < of_face_.size(); ++face) {
            const double found = distance(face, x, y);
            if (found >= smallest) continue;
            smallest = found;
            piece = of_face_[face];
        }
        return piece;
    }

    // Calls visit(a, b) for the ends of the faces of a piece.
    template <class Visit>
    void for_each_face(std::int32_t piece, const Visit& visit) const {
        for (std::size_t face = 0; face < of_face_.size(); ++face)
            if (of_face_[face] == piece) visit(ends_[2 * face], ends_[2 * face + 1]);
    }

private:
    double distance(std::size_t face, double x, double y) const {
        const std::size_t a = place(ends_[2 * face]), b = place(ends_[2 * face + 1]);
        const double dx = mesh_.x[b] - mesh_.x[a], dy = mesh_.y[b] - mesh_.y[a],
                     square = dx * dx + dy * dy,
                     along = (x - mesh_.x[a]) * dx + (y - mesh_.y[a]) * dy,
                     t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
        return length_of(mesh_.x[a] + t * dx - x, mesh_.y[a] + t * dy - y);
    }

    const Mesh& mesh_;
    std::vector<std::int32_t> ends_, of_face_;
};

std::vector<hm_condition> ConditionsOfMesh::find(const std::string& list, std::int32_t kind) const {
    std::vector<hm_condition> found;
    for (const MarkerPiece& piece : mesh.find_pieces(list)) {
        if (piece.is_piece) add_of_piece(piece, kind, found);
        else add_of_marker(piece.marker, kind, found);
    }
    return found;
}

void ConditionsOfMesh::add_of_marker(std::int32_t marker, std::int32_t kind,
                                     std::vector<hm_condition>& found) const {
    const auto is_named = [&](const hm_condition& condition) {
        return condition.marker == marker && condition.kind == kind;
    };
    const auto is_whole = [&](const hm_condition& condition) {
        return is_named(condition) && condition.piece == 0;
    };
    const bool has_whole = std::any_of(conditions.begin(), conditions.end(), is_whole);
    for (const hm_condition& condition : conditions) {
        if (kind == HM_RIGID && has_whole ? is_whole(condition) : is_named(condition))
            found.push_back(condition);
    }
}

bool ConditionsOfMesh::moves_by(const hm_condition& condition, std::int32_t number) const {
    if (condition.kind == HM_RIGID) return number == n_curves + condition.body;
    return condition.first_curve <= number && number < condition.first_curve + condition.n_curves;
}

void ConditionsOfMesh::add_of_piece(const MarkerPiece& piece, std::int32_t kind,
                                    std::vector<hm_condition>& found) const {
    std::vector<hm_condition> of_marker;
    for (const hm_condition& condition : conditions) {
        if (condition.marker != piece.marker || condition.kind != kind) continue;
        if (condition.piece != 0 && condition.near_x == piece.x && condition.near_y == piece.y)
            return found.push_back(condition);
        of_marker.push_back(condition);
    }
    const Pieces pieces(mesh, piece.marker);
    const std::int32_t nearest = pieces.nearest(piece.x, piece.y);
    const hm_condition* on_piece = nullptr;
    for (const hm_condition& condition : of_marker) {
        bool is_here = condition.piece == 0 && on_piece == nullptr;
        if (mover.empty()) {
            is_here = is_here || (condition.piece != 0 &&
                                  pieces.nearest(condition.near_x, condition.near_y) == nearest);
        } else {
            // A shared point may be moved by the condition beside the piece; a whole face is not.
            is_here = false;
            pieces.for_each_face(nearest, [&](std::int32_t a, std::int32_t b) {
                is_here = is_here || (moves_by(condition, mover[place(a)]) &&
                                      moves_by(condition, mover[place(b)]));
            });
        }
        if (is_here) on_piece = &condition;
    }
    if (on_piece != nullptr) found.push_back(*on_piece);
}

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
        double first = 0;
        if (!parse(words[0], first)) refuse_verb(words[0]);
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

    [[noreturn]] void refuse_verb(std::string_view word) const {
        const std::string verb(word);
        lines_.expected("a control point (`index dx dy`), turn, shift, scale, flap, rigid or mode",
                        verb);
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
        const std::int32_t body = body_of(std::string(words[1]));
        const auto function = place(movable_.n_control + 2 * body);
        if (moved_[function])
            lines_.fail("the body of " + in_quotes(std::string(words[1])) +
                        " is moved a second time");
        moved_[function] = true;
        const double angle = std::fmod(number(words[4]), 360) * pi / 180,
                     scale = words.size() > 5 ? number(words[5]) : 1;
        if (!(scale > 0)) lines_.expected("a scale above 0", words[5]);
        moves_[2 * function] += number(words[2]);
        moves_[2 * function + 1] += number(words[3]);
        const auto [sine, cosine] = sine_cosine(angle);
        const std::complex<double> by = {scale * cosine - 1, scale * sine};
        if (by == 0.0) return;
        // The function turns the body of the mesh that was solved on, and so what the body has
        // turned by since then is turned, too.
        double* const to = &moves_[2 * function + 2];
        std::complex<double> turned = {1 + to[0], to[1]};
        if (movable_.body_rotation) turned += movable_.body_rotation(body) - 1.0;
        to[0] += (by * turned).real();
        to[1] += (by * turned).imag();
    }

    void read_mode() {
        const auto& words = lines_.words();
        const std::int32_t n_modes = movable_.n_modes;
        std::int32_t mode = 0;
        if (words.size() < 3 || words.size() > 4)
            lines_.expected("mode K amplitude, or mode K amplitude amplitude-y");
        if (n_modes == 0) lines_.fail("the basis has no modes (functions that a table gives)");
        if (!parse(words[1], mode) || mode < 1 || mode > n_modes) {
            lines_.expected("a mode between 1 and " + std::to_string(n_modes), words[1]);
        }
        const auto function = static_cast<std::size_t>(movable_.functions() - n_modes + mode - 1);
        if (moved_[function])
            lines_.fail("mode " + std::to_string(mode) + " is moved a second time");
        moved_[function] = true;
        moves_[2 * function] += number(words[2]);
        if (words.size() == 4) moves_[2 * function + 1] += number(words[3]);
    }

    // Returns the body to which all markers of this name belong.
    std::int32_t body_of(const std::string& name) const {
        std::int32_t body = -1;
        for (const hm_condition& condition :
             conditions_of(name, HM_RIGID, "a marker of a rigid body")) {
            if (body >= 0 && condition.body != body)
                lines_.expected("the markers of one rigid body, or a piece MARKER@X:Y", name);
            body = condition.body;
        }
        return body;
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
    if (!lines.empty()) texts.push_back(TextFile::of_option("--by", lines));
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
    Movable movable = {basis.n_control(),
                       info.bodies,
                       info.modes,
                       basis.conditions(),
                       [&basis]() -> const hm_curves& { return basis.curves(); },
                       [&basis](std::int32_t body) { return basis.body_rotation(body); }};
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
                const double* function, std::complex<double> before) {
    const std::complex<double> by = 1.0 + std::complex<double>(function[2], function[3]) / before;
    out << "rigid " << mesh.name_of(condition) << ' ' << exact(function[0]) << ' '
        << exact(function[1]) << ' ' << exact(angle_of(by.real(), by.imag()) * 180 / pi) << ' '
        << exact(length_of(by.real(), by.imag())) << '\n';
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
                   &moves[2 * (n_control + 2 * static_cast<std::size_t>(condition.body))],
                   basis.body_rotation(condition.body));
    });
    const std::int32_t n_modes = basis.info().modes;
    if (n_modes > 0) out << "# mode, amplitude, amplitude-y\n";
    for (std::int32_t mode = 1; mode <= n_modes; ++mode) {
        const double* const of_mode = &moves[2 * place(basis.functions() - n_modes + mode - 1)];
        out << "mode " << mode << ' ' << exact(of_mode[0]) << ' ' << exact(of_mode[1]) << '\n';
    }
}

namespace {

// Reads moves of control points and bodies, or values of variables. With variables, bodies do not
// move.
AskedMoves moves_of_file(const Arguments& arguments, const Basis& basis, const Mesh& mesh) {
    AskedMoves asked;
    if (!arguments.has("--variables")) {
        if (!arguments.has("--by")) arguments.text("--move");  // one of the two options is needed
        asked.moves = read_moves(texts_of_moves(arguments), movable_of(basis), mesh, &asked.errors);
        return asked;
    }
    if (arguments.has("--by")) arguments.refuse("--by and --variables exclude each other");
    const std::string path = arguments.text("--move");
    const std::string map_path = arguments.text("--variables");
    const VariableMap map = read_variables(map_path);
    check_curves(map, basis.curves_at_start(), map_path);
    asked.moves =
        map.control_moves(basis.curves(), read_values(path, map), map_path, &asked.errors);
    asked.moves.resize(2 * static_cast<std::size_t>(basis.functions()));
    return asked;
}

}  // namespace

AskedMoves asked_moves(const Arguments& arguments, const Mesh& mesh, const Basis& basis) {
    if (!arguments.has("--to-airfoil")) {
        for (const char* option : {"--on-chord", "--airfoil-curve", "--element", "--moves-out"}) {
            if (arguments.has(option))
                arguments.refuse(std::string(option) + " needs --to-airfoil");
        }
        return moves_of_file(arguments, basis, mesh);
    }
    for (const char* option : {"--move", "--by"}) {
        if (arguments.has(option))
            arguments.refuse(std::string(option) +
                             " and --to-airfoil both state a movement; name one of them");
    }
    const std::string path = arguments.text("--to-airfoil");
    if (basis.info().curves == 0)
        arguments.refuse("--to-airfoil needs a curve, but the basis has no curve");
    const std::int32_t curve = arguments.whole("--airfoil-curve", 1, 1, basis.info().curves) - 1;
    const std::int32_t element =
        arguments.has("--element") ? arguments.whole("--element", 1, 1, INT32_MAX) : 0;
    const Section section = read_section(path, element);
    for (const std::string& warning : section.warnings) warn(warning);
    AskedMoves asked;
    asked.airfoil = moves_to_airfoil(basis, curve, section, path, arguments.has("--on-chord"));
    asked.airfoil->layout = section.layout;
    asked.moves = asked.airfoil->moves;
    return asked;
}

void warn_of_errors(const std::vector<MovementError>& errors) {
    constexpr double small = 1e-4;  // of the chord
    for (const MovementError& error : errors) {
        if (!(error.largest > small * error.chord)) continue;
        warn("the control points do not follow " + in_quotes(error.name) + ": the curve is up to " +
             brief(error.largest / error.chord) + " chord off; `harmorph curve --halve`, or " +
             "`harmorph fit --tolerance`, makes a curve with more control points");
    }
}

void print_errors(const std::vector<MovementError>& errors) {
    for (const MovementError& error : errors) {
        if (error.largest == 0) continue;
        print("movement error   %s chord at most, %s rms: %s\n",
              brief(error.largest / error.chord).c_str(), brief(error.rms / error.chord).c_str(),
              in_quotes(error.name).c_str());
    }
}

}  // namespace cli
