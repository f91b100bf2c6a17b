// harmorph variables: writes design variables as a map to the control points, or as movements.
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "commands/design_variables.hpp"
#include "files/output_file.hpp"
#include "options/section_option.hpp"

namespace cli {

namespace {

void run_variables(const Arguments& arguments) {
    const MadeVariables made = make_variables(arguments);
    if (arguments.has("-o")) {
        OutputFiles files;
        write_variables(files.add(arguments.text("-o")), made.map);
        files.commit();
    }
    if (arguments.has("--json")) {
        const JsonObject all =
            JsonObject().add("points", made.map.points).add("variables", made.rows);
        print("%s\n", all.text().c_str());
        return;
    }
    print("%s", made.table.c_str());
    if (arguments.has("-o")) print("written   %s\n", arguments.text("-o").c_str());
}

}  // namespace

const Command variables_command = {
    "variables",
    {{"CURVE", FileUse::input}},
    "Design variables: shapes, movements such as flaps, PARSEC, metal angles, modes of a family",
    "Writes how one unit of each variable moves each control point: the least-squares "
    "approximation of the wanted movement\n"
    "of the outline, whose error is printed. `harmorph morph --variables` moves meshes by values "
    "of the variables. Shapes\n"
    "are in chords, normal to the chord; the nodes of an FFD box move by dx, dy themselves.\n"
    "Movements (--camber-thickness to --shift) are not linear: MAP names them, in the order in "
    "which they are applied, and\n"
    "`morph` and `adjoint` compute their values and derivatives. All values are changes: 0 moves "
    "nothing. The printed table\n"
    "has the values of CURVE: the parameters of PARSEC in chords and degrees, metal angles and "
    "stagger. harmorph_design.h\n"
    "defines each movement. The modes of a family are linear; one unit of each is a root mean "
    "square movement of 1 unit of\n"
    "length.\n",
    {{"--ffd", "I,J",
      "free-form deformation: a box of degrees I along x and J along y, (I+1)(J+1) nodes"},
     {"--cst", "N,M", "class and shape functions: N for the upper and M for the lower side"},
     {"--hicks-henne", "N,M", "bumps: N for the upper and M for the lower side"},
     {"--naca", "P[,P..]",
      "NACA four-digit sections: a camber line for each position P of the largest camber, then\n"
      "the thickness"},
     {"--box", "X,Y,X,Y",
      "for --ffd: the lower left and upper right corner (default: a little more than the control\n"
      "points)"},
     {"--peaks", "P[,P..]",
      "for --hicks-henne: the stations at which the bumps are largest, 0 to 1"},
     {"--camber-thickness", "N,M",
      "N shapes of the camber line, with which the thickness turns, and M shapes of half the "
      "thickness"},
     {"--parsec", nullptr, "the eleven parameters of PARSEC sections"},
     {"--blade", "X,Y",
      "metal angles at the leading and the trailing edge, and stagger about (X, Y) [degrees]"},
     {"--flap", "X,Y[,LENGTH]",
      "deflection behind the hinge (X, Y) [degrees]; smooth over LENGTH (default: a tenth of the\n"
      "chord); may be repeated"},
     {"--scale", "X,Y", "scale about (X, Y); the value is the factor minus 1"},
     {"--turn", "X,Y", "rotation about (X, Y) [degrees], counter-clockwise"},
     {"--shift", nullptr, "translation by dx, dy"},
     {"--family", "DAT",
      "an airfoil of a family, of which the modes are found (singular value decomposition); may "
      "be\n"
      "repeated, in place of all options above",
      FileUse::input},
     {"--modes", "K", "for --family: the first K modes (default: all)"},
     chord_option,
     {"-o", "MAP", "file to write", FileUse::output},
     {"--json", nullptr,
      "print one JSON object: points, variables (rms_error and max_error of each shape, name and\n"
      "start of each value of a movement, singular_value and share of each mode)"}},
    "  harmorph variables airfoil.curve --cst 6,6 -o cst.map\n"
    "  harmorph variables blade.curve --blade 0.3,0 --flap 0.8,0 -o blade.map\n"
    "  harmorph morph mesh.su2 airfoil.basis --variables cst.map --move values.txt -o "
    "morphed.su2\n",
    run_variables};

}  // namespace cli
