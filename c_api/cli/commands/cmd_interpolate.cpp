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

}  // namespace

void run_interpolate(const Arguments& arguments) {
    if (!arguments.has("-o")) arguments.refuse("-o is required");
    const Mesh from = read_mesh(arguments, 0), to = read_mesh(arguments.operand(2));
    const std::vector<Column> fields = read_fields(arguments.operand(1), arguments.all("--field"),
                                                   from, arguments.has("--in-order"));
    const Threads threads(threads_of(arguments));
    interpolate(arguments, from, fields, to, threads);
}

}  // namespace cli
