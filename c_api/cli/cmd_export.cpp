// harmorph export: one function of a basis as a table, for ParaView, or as a picture.
#include "basis_file.hpp"
#include "commands.hpp"
#include "csv.hpp"
#include "output_file.hpp"
#include "pictures.hpp"
#include "vtu.hpp"

#include <cstdio>
#include <ostream>

namespace cli {

namespace {

void run(const Arguments& arguments) {
    arguments.text("--function"); // there is no default
    if (!arguments.has("--csv") && !arguments.has("--vtu") && !arguments.has("--svg")) {
        arguments.refuse("nothing to write: name a file after --csv, --vtu or --svg");
    }
    const Mesh mesh = read_mesh(arguments.operand(0));
    const Basis basis(arguments.operand(1), mesh);
    if (basis.mesh_has_moved()) warn("the mesh is not where it was when the basis was solved");
    const std::int32_t number = arguments.whole("--function", 1, 1, basis.functions());
    const std::vector<double> values = basis.values(number - 1, mesh);
    OutputFiles files;
    if (arguments.has("--csv")) write_csv(files.add(arguments.text("--csv")), mesh, values);
    if (arguments.has("--vtu")) {
        write_vtu(files.add(arguments.text("--vtu")), mesh, mesh.x, mesh.y, {"function", 1, values});
    }
    if (arguments.has("--svg")) {
        files.add(arguments.text("--svg")) << function_picture(mesh, basis, number - 1, values);
    }
    files.commit();
}

} // namespace

const Command export_command = {
    "export",
    {"MESH", "BASIS"},
    "Writes one function of a basis for other programs and as a picture",
    "Functions are numbered from 1 as their control points are.\n",
    {{"--function", "I", "which function (required)"},
     {"--csv", "FILE", "table with the columns point,x,y,value; points as numbered in the mesh file"},
     {"--vtu", "FILE", "mesh and function for ParaView"},
     {"--svg", "FILE", "picture: filled cells with a colour bar"}},
    "  harmorph export naca0012.su2 airfoil.basis --function 7 --svg function.svg\n",
    run};

} // namespace cli
