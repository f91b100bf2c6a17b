// harmorph interpolate: fields of one mesh at the points of another mesh.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "work/mesh_fields.hpp"
#include "work/read_mesh.hpp"

namespace cli {

namespace {

void write(const Arguments& arguments, const Mesh& to, const std::vector<Column>& fields) {
    OutputFiles files;
    write_fields(files, arguments.text("-o"), to, fields);
    files.commit();
}

void interpolate(const Arguments& arguments, const Mesh& from, const std::vector<Column>& fields,
                 const Mesh& to, const Threads& threads) {
    Field at(0);
    at.x = from.x;
    at.y = from.y;
    const Interpolated found = interpolated(from, at, fields, to, threads);
    judge_outside(arguments, found, from.file.path(), to.file.path());
    write(arguments, to, found.fields);
    if (arguments.has("--json")) {
        JsonObject object;
        object.add("fields", static_cast<std::int32_t>(fields.size())).add("points", to.points());
        object.add("outside", found.report.outside).add("max_distance", found.report.max_distance);
        print("%s\n", object.text().c_str());
        return;
    }
    print("%s from %s to %s, %d of them outside\n",
          plural(static_cast<std::int64_t>(fields.size()), "field").c_str(),
          plural(from.points(), "point").c_str(), plural(to.points(), "point").c_str(),
          found.report.outside);
    print("written  %s\n", arguments.text("-o").c_str());
}

void run_interpolate(const Arguments& arguments) {
    if (!arguments.has("-o")) arguments.refuse("-o is required");
    const Mesh from = read_mesh(arguments, 0), to = read_mesh(arguments.operand(2));
    const std::vector<Column> fields = read_fields(arguments.operand(1), arguments.all("--field"),
                                                   from, arguments.has("--in-order"));
    const Threads threads(threads_of(arguments));
    interpolate(arguments, from, fields, to, threads);
}

}  // namespace

const Command interpolate_command = {
    "interpolate",
    {{"FROM", FileUse::mesh}, {"FIELDS", FileUse::input}, {"TO", FileUse::mesh}},
    "Fields of one mesh at the points of another mesh",
    "Values are linear inside triangles; in quadrilaterals they are the mean of both divisions "
    "into triangles. Linear fields\n"
    "are exact to rounding. A point outside FROM gets the value of the nearest place of the "
    "boundary, linear by arc length.\n"
    "FIELDS is a file with one row for each point of FROM: a CSV file with the names of columns in "
    "the first line, a table\n"
    "\"point value value\", a binary restart file of SU2, a file .vtk or .vtu with arrays at the "
    "points, a\n"
    "pointVectorField of OpenFOAM, or a CGNS file with arrays at the vertices (programs made with "
    "CGNS=1). Rows are matched as in `harmorph adjoint`.\n",
    {{"--field", "NAME", "a column of FIELDS; may be repeated (default: all columns)"},
     in_order_option,
     {"-o", "FILE",
      "file to write (required): .vtu, with the mesh TO, or else a CSV table with the columns "
      "point, x, y and\nthe fields",
      FileUse::output},
     max_outside_option,
     format_option,
     zone_option,
     threads_option,
     {"--json", nullptr, "print one JSON object: fields, points, outside, max_distance"}},
    "  harmorph interpolate fine.su2 flow.vtu coarse.su2 -o coarse.vtu\n"
    "  harmorph interpolate fine.su2 flow.csv coarse.su2 --field Pressure -o pressure.csv\n",
    run_interpolate};

}  // namespace cli
