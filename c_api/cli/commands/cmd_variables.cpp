// harmorph variables: writes design variables as a map to the control points, or as movements.
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "commands/design_variables.hpp"
#include "files/output_file.hpp"
#include "options/place_options.hpp"

namespace cli {

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

}  // namespace cli
