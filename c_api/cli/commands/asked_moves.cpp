#include "commands/asked_moves.hpp"

#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "curves/variables_file.hpp"
#include "work/moves_file.hpp"

namespace cli {

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
    if (map.points != basis.n_control()) {
        throw Failure(exit_file, map_path + ": the variables move " +
                                     plural(map.points, "control point") +
                                     ", but the curves of the basis have " +
                                     std::to_string(basis.n_control()));
    }
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
